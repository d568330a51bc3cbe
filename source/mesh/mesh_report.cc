// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/number_text.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/base/point_text.h>
#include <quoin/base/rtree.h>
#include <quoin/mesh/mesh_report.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/boost_adaptors/point.h>

#include <boost/geometry.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>
#include <tuple>

namespace quoin
{
  namespace
  {
    namespace bg = boost::geometry;

    template <int dim>
    dealii::Point<3> in_space(const dealii::Point<dim> &p)
    {
      dealii::Point<3> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = p[d];
      return result;
    }

    template <int dim>
    dealii::Point<dim> middle_of(const BlockMesh<dim> &mesh,
                                 const std::array<unsigned int, dim + 1> &cell)
    {
      dealii::Point<dim> middle;
      for (const unsigned int vertex : cell)
        middle += mesh.vertices[vertex] / (dim + 1.);
      return middle;
    }

    void add_quality(const BlockMesh<2> &mesh, MeshReport &report)
    {
      report.shortest_edge  = std::numeric_limits<double>::max();
      double largest_cosine = -1.;
      for (const auto &cell : mesh.cells)
        for (unsigned int k = 0; k < 3; ++k)
        {
          const auto &p        = mesh.vertices[cell[k]];
          const auto a         = mesh.vertices[cell[(k + 1) % 3]] - p;
          const auto b         = mesh.vertices[cell[(k + 2) % 3]] - p;
          const double length  = a.norm();
          report.shortest_edge = std::min(report.shortest_edge, length);
          report.longest_edge  = std::max(report.longest_edge, length);
          largest_cosine
              = std::max(largest_cosine, a * b / (length * b.norm()));
        }
      report.smallest_angle
          = std::acos(std::min(1., largest_cosine)) / constants::degree;
    }

    void add_quality(const BlockMesh<3> &mesh, MeshReport &report)
    {
      // Pairs of vertices, and of the faces opposite to them.
      constexpr unsigned int pairs[6][2]
          = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } };
      report.shortest_edge  = std::numeric_limits<double>::max();
      double largest_cosine = -1.;
      for (const auto &cell : mesh.cells)
      {
        const auto x
            = [&](const unsigned int i) { return mesh.vertices[cell[i]]; };
        std::array<dealii::Tensor<1, 3>, 4> normals;
        for (unsigned int i = 0; i < 4; ++i)
        {
          const auto p = x((i + 1) % 4);
          normals[i]   = dealii::cross_product_3d(x((i + 2) % 4) - p,
                                                  x((i + 3) % 4) - p);
          normals[i] *= (p - x(i)) * normals[i] > 0. ? 1. : -1.;
        }
        for (const auto &[i, j] : pairs)
        {
          const double length  = x(i).distance(x(j));
          report.shortest_edge = std::min(report.shortest_edge, length);
          report.longest_edge  = std::max(report.longest_edge, length);
          const double cosine  = -(normals[i] * normals[j]) / normals[i].norm()
                                / normals[j].norm();
          if (cosine > largest_cosine)
          {
            largest_cosine        = cosine;
            report.angle_position = in_space(middle_of(mesh, cell));
          }
        }
      }
      report.smallest_angle
          = std::acos(std::min(1., largest_cosine)) / constants::degree;
    }

    /** Height of the corner @p k of the simplex @p x above the opposite side
        [m]. */
    double height(const std::array<dealii::Point<2>, 3> &x,
                  const unsigned int k)
    {
      const auto &a = x[(k + 1) % 3], &b = x[(k + 2) % 3];
      return std::abs(twice_area(a, b, x[k])) / a.distance(b);
    }
    double height(const std::array<dealii::Point<3>, 4> &x,
                  const unsigned int k)
    {
      const auto &a = x[(k + 1) % 4];
      const auto normal
          = dealii::cross_product_3d(x[(k + 2) % 4] - a, x[(k + 3) % 4] - a);
      return std::abs(normal * (x[k] - a)) / normal.norm();
    }

    /** Median of edges and the lowest of all cells. */
    template <int dim>
    void add_heights(const BlockMesh<dim> &mesh, MeshReport &report)
    {
      report.smallest_height = std::numeric_limits<double>::max();
      std::vector<double> edges; // one of each cell
      edges.reserve(mesh.cells.size());
      for (const auto &cell : mesh.cells)
      {
        std::array<dealii::Point<dim>, dim + 1> x;
        for (unsigned int k = 0; k <= dim; ++k)
          x[k] = mesh.vertices[cell[k]];
        edges.push_back(x[0].distance(x[1]));
        for (unsigned int k = 0; k <= dim; ++k)
          if (const double h = height(x, k); h < report.smallest_height)
          {
            report.smallest_height   = h;
            report.smallest_position = in_space(middle_of(mesh, cell));
          }
      }
      const auto half = edges.begin() + edges.size() / 2;
      std::nth_element(edges.begin(), half, edges.end());
      report.median_edge = *half;
    }

    template <int dim>
    double size_of(const BlockMesh<dim> &mesh,
                   const std::array<unsigned int, dim> &face)
    {
      const auto &p = mesh.vertices[face[0]];
      const auto a  = mesh.vertices[face[1]] - p;
      if constexpr (dim == 2)
        return a.norm();
      else
        return 0.5
               * dealii::cross_product_3d(a, mesh.vertices[face[2]] - p).norm();
    }

    template <int dim>
    void add_joints(const BlockMesh<dim> &mesh, MeshReport &report)
    {
      std::set<unsigned int> ends;
      for (const JointFace<dim> &face : mesh.joint_faces)
      {
        const double size = size_of<dim>(mesh, face.lower);
        report.joint_size[mesh.face_names[face.name]] += size;
        report.total_joint_size += size;
        unsigned int n_ends = 0;
        for (unsigned int k = 0; k < dim; ++k)
          if (face.lower[k] == face.upper[k])
          {
            ends.insert(face.lower[k]);
            ++n_ends;
          }
        if (n_ends == dim)
          ++report.n_tied_joint_faces;
      }
      report.n_joint_ends = ends.size();
    }

    /** The two components of a position in which lines are examined. */
    struct PlanePoint
    {
      double x, y;
    };

    /**
     * How the line from @p a to @p b crosses the ray from @p p in the direction
     * of x: 1 towards greater values of y, -1 towards lower ones, 0 not at all.
     * What it says of the reversed line is the opposite, without rounding.
     */
    int crossing_of_line(const PlanePoint &p, const PlanePoint &a,
                         const PlanePoint &b)
    {
      if ((a.y <= p.y) == (b.y <= p.y))
        return 0;
      const bool up  = b.y > a.y;
      const auto &lo = up ? a : b, &hi = up ? b : a;
      const double side
          = (hi.x - lo.x) * (p.y - lo.y) - (hi.y - lo.y) * (p.x - lo.x);
      if (!(side > 0.)) // p is right of the crossing
        return 0;
      return up ? 1 : -1;
    }

    /** The outer faces of a mesh and which of them are near. */
    template <int dim>
    class OuterFaces
    {
    public:
      OuterFaces(const BlockMesh<dim> &mesh, const double tolerance)
        : mesh(mesh)
      {
        entries.reserve(mesh.boundary_faces.size());
        for (unsigned int f = 0; f < mesh.boundary_faces.size(); ++f)
        {
          dealii::Point<dim> low = corner(f, 0), high = low;
          for (unsigned int k = 1; k < dim; ++k)
            for (unsigned int d = 0; d < dim; ++d)
            {
              low[d]  = std::min(low[d], corner(f, k)[d]);
              high[d] = std::max(high[d], corner(f, k)[d]);
            }
          for (unsigned int d = 0; d < dim; ++d)
          {
            low[d] -= tolerance;
            high[d] += tolerance;
          }
          entries.push_back({ Box(low, high), f });
        }
        tree = Tree(entries);
      }

      unsigned int n() const
      {
        return entries.size();
      }
      const dealii::Point<dim> &corner(const unsigned int f,
                                       const unsigned int k) const
      {
        return mesh.vertices[mesh.boundary_faces[f].vertices[k]];
      }
      /** Calls @p act with each face after @p f whose box meets its own. */
      template <typename Act>
      void for_near(const unsigned int f, const Act &act)
      {
        met.clear();
        tree.query(bg::index::intersects(entries[f].first),
                   std::back_inserter(met));
        for (const Entry &entry : met)
          if (entry.second > f)
            act(entry.second);
      }
      /** How many blocks lie on each other at @p p: crossings of the ray from
          there to @p right, outwards less inwards. */
      int coverage(const dealii::Point<dim> &p, const double right)
      {
        met.clear();
        dealii::Point<dim> end = p;
        end[0]                 = right;
        tree.query(bg::index::intersects(Box(p, end)), std::back_inserter(met));
        int crossings = 0;
        for (const Entry &entry : met)
          crossings += crossing(p, entry.second);
        return crossings;
      }

    private:
      using Box   = bg::model::box<dealii::Point<dim>>;
      using Entry = std::pair<Box, unsigned int>;
      using Tree  = bg::index::rtree<Entry, bg::index::rstar<16>>;

      /** 1 where the ray from @p p in the direction of x leaves a block by face
          @p f, -1 where it enters one, 0 elsewhere. */
      int crossing(const dealii::Point<dim> &p, const unsigned int f) const
      {
        // The face as it is seen in the plane of the ray, in three dimensions
        // against the ray.
        const auto seen = [](const dealii::Point<dim> &q) {
          return PlanePoint{ q[dim - 2], q[dim - 1] };
        };
        if constexpr (dim == 2)
          return crossing_of_line(seen(p), seen(corner(f, 0)),
                                  seen(corner(f, 1)));
        else
        {
          const auto normal = dealii::cross_product_3d(
              corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0));
          if (!(normal[0] * ((corner(f, 0) - p) * normal) > 0.))
            return 0; // it is behind p
          // Whether p is within the face, seen in the direction of x.
          int windings = 0;
          for (unsigned int k = 0; k < 3; ++k)
            windings += crossing_of_line(seen(p), seen(corner(f, k)),
                                         seen(corner(f, (k + 1) % 3)));
          return windings;
        }
      }

      const BlockMesh<dim> &mesh;
      std::vector<Entry> entries;
      Tree tree;
      std::vector<Entry> met;
    };

    /** Outer edges of opposite direction that share a part of a line. */
    void add_unmatched(OuterFaces<2> &edges, const double tolerance,
                       MeshReport &report)
    {
      for (unsigned int f = 0; f < edges.n(); ++f)
      {
        const auto &p       = edges.corner(f, 0);
        const auto edge     = edges.corner(f, 1) - p;
        const double length = edge.norm();
        const auto t        = edge / length;
        const auto along    = [&](const auto &x) { return t * (x - p); };
        const auto off      = [&](const auto &x)
        {
          const auto d = x - p;
          return std::abs(t[0] * d[1] - t[1] * d[0]);
        };
        edges.for_near(
            f,
            [&](const unsigned int g)
            {
              if (off(edges.corner(g, 0)) > tolerance
                  || off(edges.corner(g, 1)) > tolerance)
                return;
              const double from = std::max(0., along(edges.corner(g, 1)));
              const double to   = std::min(length, along(edges.corner(g, 0)));
              if (to - from <= 2. * tolerance)
                return;
              if (report.unmatched_size == 0.)
                report.unmatched_position
                    = in_space(dealii::Point<2>(p + 0.5 * (from + to) * t));
              report.unmatched_size += to - from;
            });
      }
    }

    /** Outer faces of opposite normals that share a part of a plane. */
    void add_unmatched(OuterFaces<3> &faces, const double tolerance,
                       MeshReport &report)
    {
      using Point = dealii::Point<3>;
      for (unsigned int f = 0; f < faces.n(); ++f)
      {
        const Point &p    = faces.corner(f, 0);
        const auto normal = dealii::cross_product_3d(faces.corner(f, 1) - p,
                                                     faces.corner(f, 2) - p);
        const auto n      = normal / normal.norm();
        faces.for_near(
            f,
            [&](const unsigned int g)
            {
              // 1. What of face g lies inside of the edges of f.
              std::vector<Point> part;
              for (unsigned int k = 0; k < 3; ++k)
              {
                part.push_back(faces.corner(g, k));
                if (std::abs(n * (part.back() - p)) > tolerance)
                  return;
              }
              for (unsigned int k = 0; k < 3; ++k)
              {
                const Point &a  = faces.corner(f, k);
                const auto edge = faces.corner(f, (k + 1) % 3) - a;
                const auto in   = dealii::cross_product_3d(n, edge);
                std::vector<Point> rest;
                for (std::size_t i = 0; i < part.size(); ++i)
                {
                  const Point &q = part[i], &r = part[(i + 1) % part.size()];
                  const double from = in * (q - a), to = in * (r - a);
                  if (from >= 0.)
                    rest.push_back(q);
                  if ((from >= 0.) != (to >= 0.))
                    rest.push_back(q + from / (from - to) * (r - q));
                }
                part = std::move(rest);
              }

              // 2. Its area, negative if the normals are alike.
              dealii::Tensor<1, 3> twice, sum;
              double perimeter = 0.;
              for (std::size_t i = 0; i < part.size(); ++i)
              {
                const Point &q = part[i], &r = part[(i + 1) % part.size()];
                twice += dealii::cross_product_3d(q - part[0], r - part[0]);
                sum += q;
                perimeter += q.distance(r);
              }
              const double area = -0.5 * (twice * n);
              if (area <= tolerance * perimeter)
                return;
              if (report.unmatched_size == 0.)
                report.unmatched_position = Point(sum / double(part.size()));
              report.unmatched_size += area;
            });
      }
    }

    /** Depth of an overlap, by the size of what overlaps, up to which it is one
        of rounding. */
    constexpr double rounding = 1e-3;

    /** By how much blocks overlap where two edges cross: that of the inner ends
        of both which is less far behind the other edge [m]; 0: not at all. */
    double crossing_depth(const OuterFaces<2> &edges, const unsigned int f,
                          const unsigned int g)
    {
      // Two meshes along an arc cross at angles of up to half of their chords'
      // angles, and their ends lie behind each other by less than the chord
      // times half of the angle.
      constexpr double largest_angle = 0.8, share_of_chord = 0.6;
      const auto way = [&](const unsigned int e)
      { return edges.corner(e, 1) - edges.corner(e, 0); };
      const double lengths[2] = { way(f).norm(), way(g).norm() };
      const auto inner = [&](const unsigned int one, const unsigned int other,
                             const double length)
      {
        const auto edge  = way(one);
        const auto place = [&](const unsigned int k)
        {
          const auto d = edges.corner(other, k) - edges.corner(one, 0);
          return (edge[0] * d[1] - edge[1] * d[0]) / length;
        };
        const double a = place(0), b = place(1);
        return a * b < 0. ? std::max(a, b) : 0.; // blocks are on the left
      };
      const double depth
          = std::min(inner(f, g, lengths[0]), inner(g, f, lengths[1]));
      if (depth <= rounding * std::min(lengths[0], lengths[1]))
        return 0.;
      const double angle = std::acos(
          std::clamp(-(way(f) * way(g)) / (lengths[0] * lengths[1]), -1., 1.));
      return angle < largest_angle
                     && depth <= share_of_chord * angle
                                     * std::max(lengths[0], lengths[1])
                 ? 0.
                 : depth;
    }

    /** By how far the nearer end of an edge lies behind the face of the other
        block that it goes well through [m]; 0: none does. */
    double crossing_depth(const OuterFaces<3> &faces, const unsigned int f,
                          const unsigned int g)
    {
      // Two meshes of a curved surface cross by less.
      constexpr double share = 0.1;
      const auto through = [&](const unsigned int one, const unsigned int other)
      {
        const auto &p     = faces.corner(one, 0);
        const auto normal = dealii::cross_product_3d(faces.corner(one, 1) - p,
                                                     faces.corner(one, 2) - p);
        for (unsigned int k = 0; k < 3; ++k)
        {
          const auto &a     = faces.corner(other, k);
          const auto edge   = faces.corner(other, (k + 1) % 3) - a;
          const double from = normal * (a - p), to = normal * (a + edge - p);
          if (!(from * to < 0.
                && std::min(std::abs(from), std::abs(to))
                       > share * edge.norm() * normal.norm()))
            continue;
          const auto q = a + from / (from - to) * edge;
          bool within  = true;
          for (unsigned int i = 0; i < 3; ++i)
          {
            const auto &b = faces.corner(one, i);
            within        = within
                     && dealii::cross_product_3d(
                            faces.corner(one, (i + 1) % 3) - b, q - b)
                                * normal
                            > share * normal.norm_square();
          }
          if (within)
            return std::min(std::abs(from), std::abs(to)) / normal.norm();
        }
        return 0.;
      };
      return std::max(through(f, g), through(g, f));
    }

    template <int dim>
    void add_overlaps(const BlockMesh<dim> &mesh, OuterFaces<dim> &faces,
                      MeshReport &report)
    {
      constexpr double within = std::numeric_limits<double>::infinity();
      const auto add = [&](const dealii::Point<dim> &p, const double depth)
      {
        if (!report.overlaps || depth > report.overlap_depth)
        {
          report.overlap_position = in_space(p);
          report.overlap_depth    = depth;
        }
        report.overlaps = true;
      };
      for (unsigned int f = 0; f < faces.n(); ++f)
        faces.for_near(
            f,
            [&](const unsigned int g)
            {
              if (const double depth = crossing_depth(faces, f, g); depth > 0.)
                add(faces.corner(f, 0)
                        + 0.5 * (faces.corner(f, 1) - faces.corner(f, 0)),
                    depth);
            });
      // What lies within another block crosses nothing.
      for (unsigned int b = 0; b < mesh.n_blocks() && !report.overlaps; ++b)
      {
        const auto &cell = mesh.cells[mesh.block_first_cell[b]];
        dealii::Point<dim> middle;
        for (const unsigned int v : cell)
          middle += mesh.vertices[v];
        middle = middle / (dim + 1.);
        if (faces.coverage(middle, report.box[1][0]) > 1)
          add(middle, within);
      }
    }
  } // namespace

  template <int dim>
  MeshReport make_mesh_report(const BlockMesh<dim> &mesh)
  {
    MeshReport report;
    report.dimension          = dim;
    report.n_blocks           = mesh.n_blocks();
    report.n_cells            = mesh.n_cells();
    report.n_nodes            = mesh.n_vertices();
    report.n_joint_faces      = mesh.joint_faces.size();
    report.quadratic          = mesh.quadratic;
    report.mixed              = mesh.mixed;
    report.n_reoriented_cells = mesh.n_reoriented_cells;
    report.largest_shift      = mesh.largest_shift;
    if (report.n_cells == 0)
      return report;
    const auto corners
        = dealii::BoundingBox<dim>(mesh.vertices).get_boundary_points();
    report.box = { { in_space(corners.first), in_space(corners.second) } };
    add_quality(mesh, report);
    add_heights(mesh, report);
    add_joints(mesh, report);
    report.slender = slender_blocks(mesh);
    // A node in the middle of each edge, of which inner ones have two cells.
    if (mesh.quadratic)
      report.n_nodes += (3 * mesh.n_cells() + mesh.boundary_faces.size()
                         + 2 * mesh.joint_faces.size())
                            / 2
                        - report.n_tied_joint_faces;
    const double tolerance = 1e-3 * report.shortest_edge;
    OuterFaces<dim> faces(mesh, tolerance);
    add_unmatched(faces, tolerance, report);
    add_overlaps(mesh, faces, report);
    return report;
  }

  template MeshReport make_mesh_report(const BlockMesh<2> &);
  template MeshReport make_mesh_report(const BlockMesh<3> &);

  std::string MeshReport::to_text() const
  {
    std::ostringstream text;
    const bool is_plane = dimension == 2;
    const char *unit    = is_plane ? " m" : " m2";
    text << n_blocks << " blocks, " << n_cells
         << (quadratic ? " quadratic" : "")
         << (is_plane ? " triangles, "
             : mixed  ? " parts of mixed tetrahedra, "
                      : " tetrahedra, ")
         << n_nodes << " nodes; ";
    // Far from the origin six digits would not tell a model's ends apart.
    const double far  = std::max({ 1., box[0].norm(), box[1].norm() });
    const double size = box[0].distance(box[1]);
    const std::streamsize digits = text.precision();
    if (size > 0.)
      text.precision(digits
                     + std::streamsize(std::max(0., std::log10(far / size))));
    text << "x " << box[0][0] << " to " << box[1][0] << " m, y " << box[0][1]
         << " to " << box[1][1] << " m";
    if (!is_plane)
      text << ", z " << box[0][2] << " to " << box[1][2] << " m";
    text.precision(digits);
    text << "\nedges " << shortest_edge << " to " << longest_edge
         << " m, smallest angle " << smallest_angle << " degrees"
         << (is_plane
                 ? "\n"
                 : " between faces at " + position(angle_position) + " m\n")
         << n_joint_faces << " joint faces, " << total_joint_size << unit;
    const char *separator = ": ";
    for (const auto &[name, size] : joint_size)
    {
      text << separator << (name.empty() ? "unnamed" : name) << ' ' << size
           << unit;
      separator = ", ";
    }
    if (n_joint_ends > 0)
      text << '\n'
           << n_joint_ends
           << (is_plane ? " joint ends inside blocks, kept as crack tips"
                        : " nodes where joints end inside blocks, kept as "
                          "crack fronts");
    if (n_tied_joint_faces > 0)
      text << '\n'
           << n_tied_joint_faces
           << (is_plane
                   ? " joint faces are tied at both ends and cannot open: they "
                     "are single edges inside a block"
                   : " joint faces are tied at all corners and cannot open: "
                     "joints inside a block are one face wide there");
    if (n_reoriented_cells > 0)
      text << '\n'
           << n_reoriented_cells
           << (is_plane ? " clockwise triangles" : " tetrahedra")
           << " turned over";
    // Beyond the digits that a file has.
    if (largest_shift > 1e-6 * shortest_edge)
      text << "\nblocks drawn apart: nodes moved by up to " << largest_shift
           << " m to meet those across the joint";
    return text.str();
  }

  std::string MeshReport::position(const dealii::Point<3> &p) const
  {
    return dimension == 2 ? point_text(dealii::Point<2>(p[0], p[1]))
                          : point_text(p);
  }

  std::string MeshReport::overlap_text() const
  {
    return std::isinf(overlap_depth)
               ? text_of("a block lies within another near ",
                         position(overlap_position), " m")
               : text_of("blocks overlap by ", overlap_depth, " m near ",
                         position(overlap_position), " m");
  }

  std::string MeshReport::overlap_cure() const
  {
    return text_of("Take the ", dimension == 2 ? "surface" : "volume",
                   " out that is there twice, or cut it out of the other.");
  }

  std::vector<std::string> MeshReport::warnings() const
  {
    std::vector<std::string> result;
    if (unmatched_size > 0. && !unmatched_touch)
      result.push_back(
          text_of("outer ", dimension == 2 ? "edges" : "faces",
                  " lie on each other over ", unmatched_size,
                  dimension == 2 ? " m" : " m2",
                  " without matching nodes, the first near ",
                  position(unmatched_position),
                  " m: no joint is made there. Mesh both sides alike."));
    // A double has 16 digits.
    double farthest = 0.;
    for (const dealii::Point<3> &corner : box)
      for (unsigned int d = 0; d < 3; ++d)
        farthest = std::max(farthest, std::abs(corner[d]));
    if (shortest_edge < 1e-8 * farthest)
      result.push_back(text_of(
          "coordinates of up to ", farthest, " m leave few digits to edges of ",
          shortest_edge, " m. Move the model nearer to the origin."));
    if (overlaps)
      result.push_back(overlap_text()
                       + ", where both then have their mass and stiffness. "
                       + overlap_cure());
    return result;
  }

  std::string MeshReport::sliver_text() const
  {
    /** Height of a sliver by the median of edges. */
    constexpr double least = 1e-3;
    if (n_cells == 0 || smallest_height >= least * median_edge)
      return "";
    // The stiffness of a sliver goes with the inverse of its height, and its
    // nodes have the mass of the cells around it.
    const double longer = std::sqrt(median_edge / smallest_height);
    return text_of("the ", dimension == 2 ? "triangle" : "tetrahedron", " at ",
                   position(smallest_position), " m is only ", smallest_height,
                   " m high, where edges are ", median_edge,
                   " m long in the median: explicit time steps would be about ",
                   longer,
                   " times as long without such slivers, and equilibria lose "
                   "digits. Unite the points of the geometry that nearly "
                   "coincide there, or move the curve that a point nearly lies "
                   "on.");
  }
} // namespace quoin
