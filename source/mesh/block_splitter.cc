// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/disjoint_sets.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/mesh/block_numbering.h>
#include <quoin/mesh/block_splitter.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <sstream>
#include <tuple>
#include <utility>

namespace quoin
{
  namespace
  {
    constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

    /**
     * Cuts one mesh. Half-edge 3 c + k of cell c runs from its corner k to the
     * next one, counter-clockwise; corner 3 c + k has the same number.
     */
    class Splitter
    {
    public:
      Splitter(const MeshData &data, const SplitOptions &options,
               BlockMesh<2> &mesh)
        : data(data), options(options), mesh(mesh),
          n_half_edges(3 * data.triangles.size())
      {
      }

      void run();

    private:
      unsigned int first(const unsigned int h) const
      {
        return data.triangles[h / 3][h % 3];
      }
      unsigned int second(const unsigned int h) const
      {
        return data.triangles[h / 3][(h + 1) % 3];
      }
      static unsigned int next_corner(const unsigned int h)
      {
        return h - h % 3 + (h + 1) % 3;
      }
      dealii::Point<2> middle(const unsigned int h) const
      {
        return dealii::Point<2>(
            0.5 * (data.vertices[first(h)] + data.vertices[second(h)]));
      }

      [[noreturn]] void fail(const std::string &what) const
      {
        throw InputError("Mesh '" + data.source + "': " + what);
      }
      static std::string at(const dealii::Point<2> &p)
      {
        std::ostringstream text;
        text << " at (" << p[0] << ", " << p[1] << ")";
        return text.str();
      }
      std::string curve(const unsigned int name) const
      {
        return name == 0 ? "a joint between surfaces"
                         : "curve '" + data.line_names[name] + "'";
      }

      unsigned int index_of(const std::string &name,
                            const std::vector<std::string> &names,
                            const std::string &parameter,
                            const std::string &kind) const;
      void resolve_names();
      void find_neighbours();
      void name_edges();
      void mark_joints();
      void unite_corners();
      void check_joint_ends() const;
      void match_outer_edges();
      void check_curves_on_boundary() const;
      void fill_faces();

      const MeshData &data;
      const SplitOptions &options;
      BlockMesh<2> &mesh;
      const unsigned int n_half_edges;

      /** By line name: does options.joints_along hold it? */
      std::vector<bool> is_joint_curve;
      /** By pair of groups: do options split there? */
      std::vector<bool> is_joint_pair;

      /** Half-edges by the smaller of their vertices. */
      std::vector<unsigned int> bucket_begin, bucket;

      std::vector<unsigned int> neighbour; /**< the same edge, other cell */
      std::vector<unsigned int> name;      /**< of the curve on a half-edge */
      std::vector<bool> is_joint;          /**< if it has a neighbour */
      std::vector<unsigned int> partner;   /**< across a joint of any kind */
      std::vector<unsigned int> vertex_of_corner, block_of_cell;
      unsigned int n_blocks = 0;
    };

    unsigned int Splitter::index_of(const std::string &wanted,
                                    const std::vector<std::string> &names,
                                    const std::string &parameter,
                                    const std::string &kind) const
    {
      const auto place = std::find(names.begin(), names.end(), wanted);
      if (!wanted.empty() && place != names.end())
        return place - names.begin();

      const auto quoted
          = [](const std::string &n) { return n.empty() ? n : "'" + n + "'"; };
      fail("there is no physical " + kind + " '" + wanted + "', which Mesh/"
           + parameter + " names. The mesh has " + known_names(names, quoted)
           + ".");
    }

    void Splitter::resolve_names()
    {
      is_joint_curve.assign(data.line_names.size(), false);
      for (const std::string &n : options.joints_along)
        is_joint_curve[index_of(n, data.line_names, "Joints along", "curve")]
            = true;

      const std::size_t n_groups = data.group_names.size();
      is_joint_pair.assign(n_groups * n_groups, options.between_all);
      for (std::size_t g = 0; g < n_groups; ++g)
        is_joint_pair[g * n_groups + g] = false;
      for (const auto &[a, b] : options.joints_between)
      {
        const unsigned int i
            = index_of(a, data.group_names, "Joints between", "surface");
        const unsigned int j
            = index_of(b, data.group_names, "Joints between", "surface");
        if (i == j)
          fail("Mesh/Joints between pairs surface '" + a
               + "' with itself. Name two different surfaces; for joints "
                 "inside a surface, draw a curve and use Joints along.");
        is_joint_pair[i * n_groups + j] = is_joint_pair[j * n_groups + i]
            = true;
      }
    }

    void Splitter::find_neighbours()
    {
      // 1. Half-edges by the smaller of their vertices: counting sort.
      const auto smaller
          = [&](const unsigned int h) { return std::min(first(h), second(h)); };
      bucket_begin.assign(data.vertices.size() + 1, 0);
      for (unsigned int h = 0; h < n_half_edges; ++h)
        ++bucket_begin[smaller(h) + 1];
      std::partial_sum(bucket_begin.begin(), bucket_begin.end(),
                       bucket_begin.begin());
      bucket.resize(n_half_edges);
      std::vector<unsigned int> end(bucket_begin.begin(),
                                    bucket_begin.end() - 1);
      for (unsigned int h = 0; h < n_half_edges; ++h)
        bucket[end[smaller(h)]++] = h;

      // 2. Pairs of opposite direction within the few of each vertex.
      neighbour.assign(n_half_edges, none);
      for (unsigned int v = 0; v < data.vertices.size(); ++v)
        for (unsigned int i = bucket_begin[v]; i < bucket_begin[v + 1]; ++i)
          for (unsigned int j = bucket_begin[v]; j < i; ++j)
          {
            const unsigned int a = bucket[i], b = bucket[j];
            const bool same = first(a) == first(b) && second(a) == second(b);
            const bool opposite
                = first(a) == second(b) && second(a) == first(b);
            if (same
                || (opposite && (neighbour[a] != none || neighbour[b] != none)))
              fail("triangles overlap at the edge" + at(middle(a))
                   + ": it has more than one of them on a side. Remove the "
                     "surface that is there twice.");
            if (opposite)
            {
              neighbour[a] = b;
              neighbour[b] = a;
            }
          }
    }

    void Splitter::name_edges()
    {
      name.assign(n_half_edges, 0);
      std::vector<bool> has_lines(data.line_names.size(), false);
      for (std::size_t l = 0; l < data.lines.size(); ++l)
      {
        const unsigned int a = data.lines[l][0], b = data.lines[l][1];
        const unsigned int line_name = data.line_name[l];
        has_lines[line_name]         = true;
        bool found                   = false;
        const unsigned int v         = std::min(a, b);
        for (unsigned int i = bucket_begin[v]; i < bucket_begin[v + 1]; ++i)
        {
          const unsigned int h = bucket[i];
          if (std::max(first(h), second(h)) != std::max(a, b))
            continue;
          if (name[h] != 0 && name[h] != line_name)
            fail("the curves '" + data.line_names[name[h]] + "' and '"
                 + data.line_names[line_name] + "' lie on each other"
                 + at(middle(h)) + ". Leave one of them there.");
          name[h] = line_name;
          found   = true;
        }
        if (!found && is_joint_curve[line_name])
          fail(curve(line_name) + " is no edge of the mesh"
               + at(dealii::Point<2>(0.5
                                     * (data.vertices[a] + data.vertices[b])))
               + ". Let it bound the surfaces there, or embed it: Curve{...} "
                 "In Surface{...};");
      }
      for (unsigned int n = 1; n < data.line_names.size(); ++n)
        if (is_joint_curve[n] && !has_lines[n])
          fail(curve(n)
               + " has no line elements, so that there is no joint "
                 "along it. Save the mesh with its curves.");
    }

    void Splitter::mark_joints()
    {
      const std::size_t n_groups = data.group_names.size();
      is_joint.assign(n_half_edges, false);
      partner.assign(n_half_edges, none);
      for (unsigned int h = 0; h < n_half_edges; ++h)
        if (neighbour[h] != none
            && (is_joint_curve[name[h]]
                || is_joint_pair[data.triangle_group[h / 3] * n_groups
                                 + data.triangle_group[neighbour[h] / 3]]))
        {
          is_joint[h] = true;
          partner[h]  = neighbour[h];
        }
    }

    void Splitter::unite_corners()
    {
      DisjointSets corners(n_half_edges);
      DisjointSets cells(data.triangles.size());
      for (unsigned int h = 0; h < n_half_edges; ++h)
      {
        const unsigned int g = neighbour[h];
        if (g == none || g < h || is_joint[h])
          continue;
        corners.unite(h, next_corner(g));
        corners.unite(next_corner(h), g);
        cells.unite(h / 3, g / 3);
      }
      unsigned int n_vertices                = 0;
      std::tie(vertex_of_corner, n_vertices) = corners.numbers();
      std::tie(block_of_cell, n_blocks)      = cells.numbers();

      mesh.vertices.resize(n_vertices);
      mesh.cells.resize(data.triangles.size());
      for (unsigned int h = 0; h < n_half_edges; ++h)
      {
        mesh.vertices[vertex_of_corner[h]] = data.vertices[first(h)];
        mesh.cells[h / 3][h % 3]           = vertex_of_corner[h];
      }
      mesh.cell_group = data.triangle_group;

      mesh.quadratic = data.quadratic;
    }

    void Splitter::check_joint_ends() const
    {
      if (options.joint_ends == SplitOptions::keep)
        return;
      for (unsigned int h = 0; h < n_half_edges; ++h)
        if (is_joint[h]
            && vertex_of_corner[h] == vertex_of_corner[next_corner(partner[h])])
          fail(
              curve(name[h]) + " ends inside a block"
              + at(data.vertices[first(h)])
              + ". Lead the joint on to another one or to the boundary, or set "
                "Mesh/Joint ends inside blocks = keep.");
    }

    /**
     * Blocks that are apart already: the outer edges whose ends coincide, found
     * by their middles in a grid of the size of the shortest edge.
     */
    void Splitter::match_outer_edges()
    {
      std::vector<unsigned int> outer;
      double shortest         = std::numeric_limits<double>::max();
      dealii::Point<2> origin = data.vertices[first(0)];
      for (unsigned int h = 0; h < n_half_edges; ++h)
      {
        const auto &p = data.vertices[first(h)];
        shortest = std::min(shortest, p.distance(data.vertices[second(h)]));
        for (unsigned int d = 0; d < 2; ++d)
          origin[d] = std::min(origin[d], p[d]);
        if (neighbour[h] == none)
          outer.push_back(h);
      }
      const double tolerance = options.coincidence_tolerance * shortest;
      const double width     = std::max(shortest, 4. * tolerance);

      const auto column = [&](const double x, const unsigned int d) {
        return static_cast<std::int64_t>(std::floor((x - origin[d]) / width));
      };
      using Box = std::pair<std::int64_t, std::int64_t>;
      std::vector<std::pair<Box, unsigned int>> grid;
      grid.reserve(outer.size());
      for (const unsigned int h : outer)
      {
        const auto m = middle(h);
        grid.push_back({ { column(m[0], 0), column(m[1], 1) }, h });
      }
      std::sort(grid.begin(), grid.end());

      const auto close = [&](const unsigned int v, const unsigned int w)
      { return data.vertices[v].distance(data.vertices[w]) <= tolerance; };
      for (const unsigned int h : outer)
      {
        const auto m = middle(h);
        for (auto x = column(m[0] - tolerance, 0);
             x <= column(m[0] + tolerance, 0); ++x)
          for (auto y = column(m[1] - tolerance, 1);
               y <= column(m[1] + tolerance, 1); ++y)
          {
            const Box box(x, y);
            for (auto it = std::lower_bound(grid.begin(), grid.end(),
                                            std::make_pair(box, 0U));
                 it != grid.end() && it->first == box; ++it)
            {
              const unsigned int g = it->second;
              if (g <= h)
                continue;
              const bool opposite
                  = close(first(h), second(g)) && close(second(h), first(g));
              const bool same
                  = close(first(h), first(g)) && close(second(h), second(g));
              if (same
                  || (opposite && (partner[h] != none || partner[g] != none)))
                fail("blocks overlap at the edge" + at(m)
                     + ": more than one of them is on a side of it. "
                       "Remove the one that is there twice.");
              if (opposite)
              {
                partner[h] = g;
                partner[g] = h;
              }
            }
          }
      }
    }

    void Splitter::check_curves_on_boundary() const
    {
      for (unsigned int h = 0; h < n_half_edges; ++h)
        if (is_joint_curve[name[h]] && partner[h] == none)
          fail(curve(name[h]) + " dangles" + at(middle(h))
               + ": it lies on the outer boundary, with no block on the other "
                 "side. Take this part out of the physical curve, or the curve "
                 "out of Mesh/Joints along.");
    }

    void Splitter::fill_faces()
    {
      // For edges this close to vertical the normal is taken as horizontal.
      constexpr double vertical = 1e-6;

      mesh.boundary_faces.clear();
      mesh.joint_faces.clear();
      for (unsigned int h = 0; h < n_half_edges; ++h)
      {
        const unsigned int g = partner[h];
        const unsigned int a = vertex_of_corner[h];
        const unsigned int b = vertex_of_corner[next_corner(h)];
        if (g == none)
        {
          if (neighbour[h] == none)
            mesh.boundary_faces.push_back({ { { a, b } }, h / 3, name[h] });
          continue;
        }

        // Each joint comes by twice; it is taken from its lower side. With
        // n = (t_y, -t_x) lower means t_x < 0, or vertical and t_y > 0.
        // Coincident edges differ within the tolerance: the direction is
        // that of both.
        const auto t = (data.vertices[second(h)] - data.vertices[first(h)])
                       - (data.vertices[second(g)] - data.vertices[first(g)]);
        const bool is_lower
            = std::abs(t[0]) > vertical * t.norm() ? t[0] < 0. : t[1] > 0.;
        if (!is_lower)
          continue;
        unsigned int joint_name = name[h];
        if (joint_name == 0
            || (is_joint_curve[name[g]] && !is_joint_curve[name[h]]))
          joint_name = name[g];
        mesh.joint_faces.push_back(
            { { { a, b } },
              { { vertex_of_corner[next_corner(g)], vertex_of_corner[g] } },
              { { h / 3, g / 3 } },
              joint_name,
              { { data.triangle_group[h / 3], data.triangle_group[g / 3] } } });
      }
    }

    void Splitter::run()
    {
      if (data.triangles.empty())
        fail("there are no triangles in it.");
      mesh.group_names        = data.group_names;
      mesh.line_names         = data.line_names;
      mesh.n_reoriented_cells = data.n_reoriented;

      resolve_names();
      find_neighbours();
      name_edges();
      mark_joints();
      unite_corners();
      check_joint_ends();
      match_outer_edges();
      check_curves_on_boundary();
      fill_faces();
      number_blocks(mesh, block_of_cell, n_blocks);
    }
  } // namespace

  void split_into_blocks(const MeshData &data, const SplitOptions &options,
                         BlockMesh<2> &mesh,
                         const std::vector<unsigned int> *block_order)
  {
    Splitter(data, options, mesh).run();
    if (block_order != nullptr)
      renumber_blocks(mesh, *block_order);
  }
} // namespace quoin
