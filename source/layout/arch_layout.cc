// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/layout/arch_layout.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace quoin
{
  namespace
  {
    using Point   = dealii::Point<2>;
    using Corners = std::vector<unsigned int>;

    class ArchBuilder
    {
    public:
      ArchBuilder(const ArchParameters &arch, ArchLayout &layout)
        : arch(arch), layout(layout), side(0.5 * arch.span + arch.abutment[0])
      {
      }

      void build()
      {
        lay_ring();
        lay_abutments();
        if (arch.backing > 0.)
          lay_backing();
        if (arch.cover > 0.)
          lay_fill();
      }

    private:
      void lay_ring();
      void lay_abutments();
      void lay_backing();
      void lay_fill();

      unsigned int add(const double x, const double y)
      {
        layout.points.emplace_back(x, y);
        return layout.points.size() - 1;
      }
      double y(const unsigned int point) const
      {
        return layout.points[point][1];
      }
      /** A block on the left and its image on the right, whose corners have
          the opposite order. */
      void add_both(const ArchBlock::Kind kind, const Corners &left,
                    Corners right)
      {
        std::reverse(right.begin(), right.end());
        layout.blocks.push_back({ kind, "", left });
        layout.blocks.push_back({ kind, "", right });
      }

      const ArchParameters &arch;
      ArchLayout &layout;
      const double side;
      Corners inner, outer; /**< ends of the joints */
      /** From the left: the extrados, cut at the top of the backing. */
      Corners extrados;
      /** Upper outer corners of abutments, then of backing. */
      std::array<unsigned int, 2> shoulder{};
    };

    void ArchBuilder::lay_ring()
    {
      const unsigned int n = arch.n_voussoirs;
      const double radius
          = (0.25 * arch.span * arch.span + arch.rise * arch.rise)
            / (2. * arch.rise);
      const double centre = arch.rise - radius;
      const double half   = 2. * std::atan2(2. * arch.rise, arch.span);
      for (unsigned int k = 0; k <= n; ++k)
      {
        const double angle = half * (2. * k / n - 1.);
        const bool is_end  = k == 0 || k == n;
        // Not a rounding below the springings.
        inner.push_back(add(is_end ? (k == 0 ? -0.5 : 0.5) * arch.span
                                   : radius * std::sin(angle),
                            is_end ? 0. : centre + radius * std::cos(angle)));
        outer.push_back(
            add((radius + arch.ring) * std::sin(angle),
                is_end ? std::max(0., -arch.ring * centre / radius)
                       : centre + (radius + arch.ring) * std::cos(angle)));
      }
      for (unsigned int k = 0; k < n; ++k)
      {
        const auto name = arch.named_voussoirs.find(k + 1);
        layout.blocks.push_back(
            { ArchBlock::voussoir,
              name == arch.named_voussoirs.end() ? "" : name->second,
              { inner[k], inner[k + 1], outer[k + 1], outer[k] } });
      }
      extrados = outer;
    }

    void ArchBuilder::lay_abutments()
    {
      const double low = -arch.abutment[1];
      const bool has_step
          = side > layout.points[outer.back()][0] + 1e-9 * arch.abutment[0];
      std::array<Corners, 2> corners;
      for (unsigned int s = 0; s < 2; ++s)
      {
        const double sign      = s == 0 ? -1. : 1.;
        const unsigned int in  = s == 0 ? inner.front() : inner.back();
        const unsigned int out = s == 0 ? outer.front() : outer.back();
        shoulder[s]            = has_step ? add(sign * side, y(out)) : out;
        corners[s]             = { in, out };
        if (has_step)
          corners[s].push_back(shoulder[s]);
        corners[s].push_back(add(sign * side, low));
        corners[s].push_back(add(sign * 0.5 * arch.span, low));
      }
      add_both(ArchBlock::abutment, corners[0], corners[1]);
    }

    void ArchBuilder::lay_backing()
    {
      // The voussoir on the left whose extrados its top cuts.
      unsigned int k = 0;
      while (y(outer[k + 1]) <= arch.backing)
        ++k;
      const Point &a = layout.points[outer[k]], b = layout.points[outer[k + 1]];
      const double share       = (arch.backing - a[1]) / (b[1] - a[1]);
      const double edge        = a.distance(b) * std::min(share, 1. - share);
      const bool is_cut        = edge > 0.1 * arch.element_size;
      const double x           = a[0] + share * (b[0] - a[0]);
      const unsigned int first = share < 0.5 ? k : k + 1; // if it is not cut
      const unsigned int n     = arch.n_voussoirs;
      if (!is_cut && first == 0)
        throw InputError("section 'Arch': 'Backing = "
                         + number_text(arch.backing)
                         + "' is nearer to the springing of the extrados than "
                           "a tenth of 'Element size'. Raise it, or set it to "
                           "0.");
      std::array<unsigned int, 2> cut{ { outer[first], outer[n - first] } };
      if (is_cut)
      {
        cut = { { add(x, arch.backing), add(-x, arch.backing) } };
        for (const unsigned int s : { 0U, 1U })
        {
          auto &corners = layout.blocks[s == 0 ? k : n - 1 - k].corners;
          corners.insert(corners.begin() + 3, cut[s]);
        }
        extrados.insert(extrados.begin() + k + 1, cut[0]);
        extrados.insert(extrados.end() - k - 1, cut[1]);
      }
      const std::size_t n_below
          = std::find(extrados.begin(), extrados.end(), cut[0])
            - extrados.begin() + 1;
      Corners left(extrados.begin(), extrados.begin() + n_below);
      Corners right(extrados.rbegin(), extrados.rbegin() + n_below);
      for (const unsigned int s : { 0U, 1U })
      {
        Corners &corners         = s == 0 ? left : right;
        const unsigned int below = shoulder[s];
        shoulder[s]              = add(s == 0 ? -side : side, y(cut[s]));
        corners.push_back(shoulder[s]);
        if (below != corners.front())
          corners.push_back(below);
      }
      add_both(ArchBlock::backing, left, right);
      extrados = Corners(extrados.begin() + n_below - 1,
                         extrados.end() - n_below + 1);
    }

    void ArchBuilder::lay_fill()
    {
      const double top = arch.rise + arch.ring + arch.cover;
      Corners corners  = extrados;
      if (shoulder[1] != corners.back())
        corners.push_back(shoulder[1]);
      corners.push_back(add(side, top));
      corners.push_back(add(-side, top));
      if (shoulder[0] != corners.front())
        corners.push_back(shoulder[0]);
      layout.blocks.push_back({ ArchBlock::fill, "", corners });
    }

    const std::map<ArchBlock::Kind, std::string> kind_words
        = { { ArchBlock::voussoir, "voussoir" },
            { ArchBlock::abutment, "abutment" },
            { ArchBlock::backing, "backing" },
            { ArchBlock::fill, "fill" } };

    class ArchWriter
    {
    public:
      ArchWriter(const ArchParameters &arch, const ArchLayout &layout)
        : arch(arch), layout(layout), side(0.5 * arch.span + arch.abutment[0]),
          exact(1e-9 * arch.span)
      {
      }

      GmshGeometry write()
      {
        find_edges();
        write_points();
        write_lines();
        write_surfaces();
        text << physical_names(surfaces, curves);
        return { text.str(), { joints.begin(), joints.end() } };
      }

    private:
      using Edge = std::array<unsigned int, 2>; /**< ascending points */

      static Edge edge(const unsigned int a, const unsigned int b)
      {
        return { { std::min(a, b), std::max(a, b) } };
      }
      void find_edges();
      void write_points();
      void write_lines();
      void write_surfaces();
      std::string joint_name(const ArchBlock &a, const ArchBlock &b) const;
      std::string outer_name(const ArchBlock &block, unsigned int a,
                             unsigned int b) const;

      const ArchParameters &arch;
      const ArchLayout &layout;
      const double side, exact;
      std::map<Edge, int> lines;
      std::map<Edge, std::vector<unsigned int>> blocks_of;
      std::map<std::string, GmshNumbers> curves, surfaces;
      std::set<std::string> joints; /**< joint curves */
      std::ostringstream text;
    };

    void ArchWriter::find_edges()
    {
      for (unsigned int b = 0; b < layout.blocks.size(); ++b)
      {
        const Corners &corners = layout.blocks[b].corners;
        for (std::size_t i = 0; i < corners.size(); ++i)
        {
          const Edge e = edge(corners[i], corners[(i + 1) % corners.size()]);
          lines.emplace(e, int(lines.size()) + 1);
          blocks_of[e].push_back(b);
        }
      }
    }

    void ArchWriter::write_points()
    {
      text.precision(15);
      text << "// An arch of " << arch.n_voussoirs << " voussoirs, span "
           << arch.span << " m, rise " << arch.rise << " m, ring " << arch.ring
           << " m; lengths in metres.\n// Joints have no thickness: names of "
              "physical curves say which lines are joints.\n\n";
      std::vector<bool> is_of_ring(layout.points.size(), false);
      for (const ArchBlock &block : layout.blocks)
        if (block.kind == ArchBlock::voussoir)
          for (const unsigned int corner : block.corners)
            is_of_ring[corner] = true;
      for (unsigned int p = 0; p < layout.points.size(); ++p)
        text << "Point(" << p + 1 << ") = {" << layout.points[p][0] << ", "
             << layout.points[p][1] << ", 0, "
             << (is_of_ring[p] ? arch.element_size : arch.fill_element_size)
             << "};\n";
    }

    std::string ArchWriter::joint_name(const ArchBlock &a,
                                       const ArchBlock &b) const
    {
      for (const auto kind : { ArchBlock::fill, ArchBlock::backing })
        if (a.kind == kind || b.kind == kind)
          return kind_words.at(kind) + "_joint";
      return "ring_joint";
    }

    /** Name of the outer edge from @p a to @p b of a block. */
    std::string ArchWriter::outer_name(const ArchBlock &block,
                                       const unsigned int a,
                                       const unsigned int b) const
    {
      const Point &p = layout.points[a], &q = layout.points[b];
      if (block.kind == ArchBlock::voussoir)
      {
        // Counter-clockwise its intrados runs to the right.
        return with_name(q[0] > p[0] ? "intrados" : "extrados", block.name);
      }
      const auto is_on = [&](const unsigned int d, const double place) {
        return std::abs(p[d] - place) < exact && std::abs(q[d] - place) < exact;
      };
      for (const double sign : { -1., 1. })
        if (is_on(0, sign * side))
          return kind_words.at(block.kind) + (sign < 0. ? "_left" : "_right");
      if (block.kind == ArchBlock::abutment && is_on(1, -arch.abutment[1]))
        return "base";
      if (block.kind == ArchBlock::fill)
        return "road";
      return "";
    }

    void ArchWriter::write_lines()
    {
      std::map<int, GmshNumbers> lines_of_count;
      for (const auto &[e, line] : lines)
      {
        text << "Line(" << line << ") = {" << e[0] + 1 << ", " << e[1] + 1
             << "};\n";
        const auto &beside     = blocks_of.at(e);
        const ArchBlock &block = layout.blocks[beside[0]];
        std::string name;
        if (beside.size() == 2)
        {
          name = joint_name(block, layout.blocks[beside[1]]);
          joints.insert(name);
        }
        else
        {
          const Corners &corners = block.corners;
          const auto place = std::find(corners.begin(), corners.end(), e[0]);
          const bool is_forward
              = (place + 1 == corners.end() ? corners.front() : place[1])
                == e[1];
          name
              = outer_name(block, e[is_forward ? 0 : 1], e[is_forward ? 1 : 0]);
        }
        if (!name.empty())
          curves[name].push_back(line);
      }
    }

    void ArchWriter::write_surfaces()
    {
      // Voussoirs are quadrangles in rows and columns; those that the top of
      // the backing cuts are meshed as the other blocks are.
      GmshNumbers radial, along, regular;
      for (unsigned int b = 0; b < layout.blocks.size(); ++b)
      {
        const ArchBlock &block = layout.blocks[b];
        GmshNumbers loop;
        for (std::size_t i = 0; i < block.corners.size(); ++i)
        {
          const unsigned int from = block.corners[i];
          const unsigned int to = block.corners[(i + 1) % block.corners.size()];
          const int line        = lines.at(edge(from, to));
          loop.push_back(from < to ? line : -line);
        }
        text << "Curve Loop(" << b + 1 << ") = " << braces(loop)
             << ";\nPlane Surface(" << b + 1 << ") = {" << b + 1 << "};\n";
        surfaces[with_name(kind_words.at(block.kind), block.name)].push_back(
            b + 1);
        if (block.kind != ArchBlock::voussoir)
          continue;
        radial.push_back(std::abs(loop[1]));
        radial.push_back(std::abs(loop.back()));
        if (block.corners.size() > 4)
          continue;
        along.push_back(std::abs(loop[0]));
        along.push_back(std::abs(loop[2]));
        regular.push_back(b + 1);
      }
      const auto count = [&](const double length) {
        return std::max(1., std::ceil(length / arch.element_size - 1e-6)) + 1;
      };
      const auto &points = layout.points;
      const auto &first  = layout.blocks[0].corners;
      text << "Transfinite Curve " << braces(radial) << " = "
           << count(arch.ring) << ";\n";
      if (!regular.empty())
        text << "Transfinite Curve " << braces(along) << " = "
             << count(points[first[2]].distance(points[first.back()]))
             << ";\nTransfinite Surface " << braces(regular)
             << " AlternateLeft;\n";
    }
  } // namespace

  double ArchLayout::area(const ArchBlock::Kind kind) const
  {
    double sum = 0.;
    for (const ArchBlock &block : blocks)
      if (block.kind == kind)
      {
        Polygon polygon;
        for (const unsigned int corner : block.corners)
          polygon.push_back(points[corner]);
        sum += signed_area(polygon);
      }
    return sum;
  }

  ArchLayout lay_arch(const ArchParameters &arch)
  {
    ArchLayout layout;
    ArchBuilder(arch, layout).build();
    return layout;
  }

  std::string arch_report(const ArchLayout &layout)
  {
    const auto n_voussoirs
        = std::count_if(layout.blocks.begin(), layout.blocks.end(),
                        [](const ArchBlock &block)
                        { return block.kind == ArchBlock::voussoir; });
    std::string text = "arch of " + std::to_string(n_voussoirs) + " voussoirs";
    for (const auto &[kind, word] : kind_words)
      if (layout.area(kind) > 0.)
        text += ", " + word + " " + number_text(layout.area(kind)) + " m^2";
    return text;
  }

  GmshGeometry arch_geometry(const ArchParameters &arch,
                             const ArchLayout &layout)
  {
    return ArchWriter(arch, layout).write();
  }
} // namespace quoin
