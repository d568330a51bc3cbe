// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/number_text.h>
#include <quoin/mesh/mesh_report.h>

#include <deal.II/base/bounding_box.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

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

      std::tie(report.lower_left, report.upper_right)
          = dealii::BoundingBox<2>(mesh.vertices).get_boundary_points();
    }

    void add_joints(const BlockMesh<2> &mesh, MeshReport &report)
    {
      std::set<unsigned int> ends;
      for (const JointFace<2> &face : mesh.joint_faces)
      {
        const double length = mesh.vertices[face.lower[0]].distance(
            mesh.vertices[face.lower[1]]);
        report.joint_length[mesh.line_names[face.name]] += length;
        report.total_joint_length += length;
        unsigned int n_ends = 0;
        for (unsigned int k = 0; k < 2; ++k)
          if (face.lower[k] == face.upper[k])
          {
            ends.insert(face.lower[k]);
            ++n_ends;
          }
        if (n_ends == 2)
          ++report.n_tied_joint_faces;
      }
      report.n_joint_ends = ends.size();
    }

    /** The outer edges of a mesh and which of them are near. */
    class OuterEdges
    {
    public:
      OuterEdges(const BlockMesh<2> &mesh, const double tolerance) : mesh(mesh)
      {
        entries.reserve(mesh.boundary_faces.size());
        for (unsigned int f = 0; f < mesh.boundary_faces.size(); ++f)
        {
          const auto &p = end(f, 0), &q = end(f, 1);
          entries.push_back({ Box(Corner(std::min(p[0], q[0]) - tolerance,
                                         std::min(p[1], q[1]) - tolerance),
                                  Corner(std::max(p[0], q[0]) + tolerance,
                                         std::max(p[1], q[1]) + tolerance)),
                              f });
        }
        tree = Tree(entries);
      }

      unsigned int n() const
      {
        return entries.size();
      }
      const dealii::Point<2> &end(const unsigned int f,
                                  const unsigned int k) const
      {
        return mesh.vertices[mesh.boundary_faces[f].vertices[k]];
      }
      /** Calls @p act with each edge after @p f whose box meets its own. */
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
      /** How many blocks lie on each other at @p p: windings around it. */
      int coverage(const dealii::Point<2> &p, const double right)
      {
        met.clear();
        tree.query(
            bg::index::intersects(Box(Corner(p[0], p[1]), Corner(right, p[1]))),
            std::back_inserter(met));
        int windings = 0;
        for (const Entry &entry : met)
        {
          const auto &a = end(entry.second, 0), &b = end(entry.second, 1);
          if ((a[1] <= p[1]) == (b[1] <= p[1]))
            continue;
          const double side
              = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
          const bool up = b[1] > a[1];
          if (up ? side > 0. : side < 0.) // p is left of the crossing
            windings += up ? 1 : -1;
        }
        return windings;
      }

    private:
      using Corner = bg::model::point<double, 2, bg::cs::cartesian>;
      using Box    = bg::model::box<Corner>;
      using Entry  = std::pair<Box, unsigned int>;
      using Tree   = bg::index::rtree<Entry, bg::index::rstar<16>>;

      const BlockMesh<2> &mesh;
      std::vector<Entry> entries;
      Tree tree;
      std::vector<Entry> met;
    };

    /** Outer edges of opposite direction that share a part of a line. */
    void add_unmatched_edges(OuterEdges &edges, const double tolerance,
                             MeshReport &report)
    {
      for (unsigned int f = 0; f < edges.n(); ++f)
      {
        const auto &p       = edges.end(f, 0);
        const auto edge     = edges.end(f, 1) - p;
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
              if (off(edges.end(g, 0)) > tolerance
                  || off(edges.end(g, 1)) > tolerance)
                return;
              const double from = std::max(0., along(edges.end(g, 1)));
              const double to   = std::min(length, along(edges.end(g, 0)));
              if (to - from <= 2. * tolerance)
                return;
              if (report.unmatched_length == 0.)
                report.unmatched_position = p + 0.5 * (from + to) * t;
              report.unmatched_length += to - from;
            });
      }
    }

    /** Whether both ends of each edge are well beyond the other one. */
    bool cross(const OuterEdges &edges, const unsigned int f,
               const unsigned int g)
    {
      // Two meshes along an arc cross by less.
      constexpr double share = 0.1;
      const auto sides = [&](const unsigned int one, const unsigned int other)
      {
        const auto edge  = edges.end(one, 1) - edges.end(one, 0);
        const auto place = [&](const unsigned int k)
        {
          const auto d = edges.end(other, k) - edges.end(one, 0);
          return (edge[0] * d[1] - edge[1] * d[0]) / edge.norm();
        };
        const double a = place(0), b = place(1);
        return a * b < 0.
               && std::min(std::abs(a), std::abs(b))
                      > share
                            * edges.end(other, 0).distance(edges.end(other, 1));
      };
      return sides(f, g) && sides(g, f);
    }

    void add_overlaps(const BlockMesh<2> &mesh, OuterEdges &edges,
                      MeshReport &report)
    {
      const auto add = [&](const dealii::Point<2> &p)
      {
        if (!report.overlaps)
          report.overlap_position = p;
        report.overlaps = true;
      };
      for (unsigned int f = 0; f < edges.n() && !report.overlaps; ++f)
        edges.for_near(f,
                       [&](const unsigned int g)
                       {
                         if (cross(edges, f, g))
                           add(edges.end(f, 0)
                               + 0.5 * (edges.end(f, 1) - edges.end(f, 0)));
                       });
      // What lies within another block crosses nothing.
      for (unsigned int b = 0; b < mesh.n_blocks() && !report.overlaps; ++b)
      {
        const auto &cell = mesh.cells[mesh.block_first_cell[b]];
        const dealii::Point<2> middle((mesh.vertices[cell[0]]
                                       + mesh.vertices[cell[1]]
                                       + mesh.vertices[cell[2]])
                                      / 3.);
        if (edges.coverage(middle, report.upper_right[0]) > 1)
          add(middle);
      }
    }
  } // namespace

  MeshReport make_mesh_report(const BlockMesh<2> &mesh)
  {
    MeshReport report;
    report.n_blocks           = mesh.n_blocks();
    report.n_cells            = mesh.n_cells();
    report.n_nodes            = mesh.n_vertices();
    report.n_joint_faces      = mesh.joint_faces.size();
    report.quadratic          = mesh.quadratic;
    report.n_reoriented_cells = mesh.n_reoriented_cells;
    if (report.n_cells == 0)
      return report;
    add_quality(mesh, report);
    add_joints(mesh, report);
    // A node in the middle of each edge, of which inner ones have two cells.
    if (mesh.quadratic)
      report.n_nodes += (3 * mesh.n_cells() + mesh.boundary_faces.size()
                         + 2 * mesh.joint_faces.size())
                            / 2
                        - report.n_tied_joint_faces;
    const double tolerance = 1e-3 * report.shortest_edge;
    OuterEdges edges(mesh, tolerance);
    add_unmatched_edges(edges, tolerance, report);
    add_overlaps(mesh, edges, report);
    return report;
  }

  std::string MeshReport::to_text() const
  {
    std::ostringstream text;
    text << n_blocks << " blocks, " << n_cells
         << (quadratic ? " quadratic" : "") << " triangles, " << n_nodes
         << " nodes; x " << lower_left[0] << " to " << upper_right[0]
         << " m, y " << lower_left[1] << " to " << upper_right[1] << " m\n"
         << "edges " << shortest_edge << " to " << longest_edge
         << " m, smallest angle " << smallest_angle << " degrees\n"
         << n_joint_faces << " joint faces, " << total_joint_length << " m";
    const char *separator = ": ";
    for (const auto &[name, length] : joint_length)
    {
      text << separator << (name.empty() ? "unnamed" : name) << ' ' << length
           << " m";
      separator = ", ";
    }
    if (n_joint_ends > 0)
      text << '\n'
           << n_joint_ends << " joint ends inside blocks, kept as crack tips";
    if (n_tied_joint_faces > 0)
      text << '\n'
           << n_tied_joint_faces
           << " joint faces are tied at both ends and cannot open: they are "
              "single edges inside a block";
    if (n_reoriented_cells > 0)
      text << '\n' << n_reoriented_cells << " clockwise triangles turned over";
    return text.str();
  }

  std::vector<std::string> MeshReport::warnings() const
  {
    std::vector<std::string> result;
    if (unmatched_length > 0.)
      result.push_back(
          text_of("outer edges lie on each other over ", unmatched_length,
                  " m without matching nodes, the first near (",
                  unmatched_position[0], ", ", unmatched_position[1],
                  ") m: no joint is made there. Mesh both sides alike."));
    // A double has 16 digits.
    double farthest = 0.;
    for (unsigned int d = 0; d < 2; ++d)
      farthest = std::max(
          { farthest, std::abs(lower_left[d]), std::abs(upper_right[d]) });
    if (shortest_edge < 1e-8 * farthest)
      result.push_back(text_of(
          "coordinates of up to ", farthest, " m leave few digits to edges of ",
          shortest_edge, " m. Move the model nearer to the origin."));
    if (overlaps)
      result.push_back(text_of(
          "blocks overlap near (", overlap_position[0], ", ",
          overlap_position[1],
          ") m, where both then have their mass and stiffness. Take the "
          "surface out that is there twice, or cut it out of the other."));
    return result;
  }
} // namespace quoin
