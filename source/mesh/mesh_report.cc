// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/mesh_report.h>

#include <deal.II/base/numbers.h>

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

namespace quoin
{
  namespace
  {
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
      // A quadratic triangle is its cells at twice the size.
      if (mesh.quadratic)
      {
        report.shortest_edge *= 2.;
        report.longest_edge *= 2.;
      }
      report.smallest_angle = std::acos(std::min(1., largest_cosine)) * 180.
                              / dealii::numbers::PI;

      report.lower_left = report.upper_right = mesh.vertices[0];
      for (const auto &p : mesh.vertices)
        for (unsigned int d = 0; d < 2; ++d)
        {
          report.lower_left[d]  = std::min(report.lower_left[d], p[d]);
          report.upper_right[d] = std::max(report.upper_right[d], p[d]);
        }
    }

    void add_joints(const BlockMesh<2> &mesh, MeshReport &report)
    {
      std::set<unsigned int> ends;
      for (const JointFace &face : mesh.joint_faces)
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

    /** Outer edges of opposite direction that share a part of a line. */
    void add_unmatched_edges(const BlockMesh<2> &mesh, MeshReport &report)
    {
      namespace bg = boost::geometry;
      using Point  = bg::model::point<double, 2, bg::cs::cartesian>;
      using Box    = bg::model::box<Point>;
      using Entry  = std::pair<Box, unsigned int>;

      const double tolerance = 1e-3 * report.shortest_edge;
      const auto end
          = [&mesh](const unsigned int f, const unsigned int k) -> const auto &
      {
        return mesh.vertices[mesh.boundary_faces[f].vertices[k]];
      };

      std::vector<Entry> entries;
      entries.reserve(mesh.boundary_faces.size());
      for (unsigned int f = 0; f < mesh.boundary_faces.size(); ++f)
      {
        const auto &p = end(f, 0), &q = end(f, 1);
        entries.push_back({ Box(Point(std::min(p[0], q[0]) - tolerance,
                                      std::min(p[1], q[1]) - tolerance),
                                Point(std::max(p[0], q[0]) + tolerance,
                                      std::max(p[1], q[1]) + tolerance)),
                            f });
      }
      const bg::index::rtree<Entry, bg::index::rstar<16>> tree(entries);

      std::vector<Entry> met;
      for (const auto &[box, f] : entries)
      {
        met.clear();
        tree.query(bg::index::intersects(box), std::back_inserter(met));
        const auto &p       = end(f, 0);
        const auto edge     = end(f, 1) - p;
        const double length = edge.norm();
        const auto t        = edge / length;
        const auto along    = [&](const auto &x) { return t * (x - p); };
        const auto off      = [&](const auto &x)
        {
          const auto d = x - p;
          return std::abs(t[0] * d[1] - t[1] * d[0]);
        };
        for (const auto &entry : met)
        {
          const unsigned int g = entry.second;
          if (g <= f || off(end(g, 0)) > tolerance
              || off(end(g, 1)) > tolerance)
            continue;
          const double from = std::max(0., along(end(g, 1)));
          const double to   = std::min(length, along(end(g, 0)));
          if (to - from <= 2. * tolerance)
            continue;
          if (report.unmatched_length == 0.)
            report.unmatched_position = p + 0.5 * (from + to) * t;
          report.unmatched_length += to - from;
        }
      }
    }
  } // namespace

  MeshReport make_mesh_report(const BlockMesh<2> &mesh)
  {
    MeshReport report;
    report.n_blocks           = mesh.n_blocks();
    report.n_cells            = mesh.n_cells();
    report.n_vertices         = mesh.n_vertices();
    report.n_joint_faces      = mesh.joint_faces.size();
    report.quadratic          = mesh.quadratic;
    report.n_reoriented_cells = mesh.n_reoriented_cells;
    if (report.n_cells == 0)
      return report;
    add_quality(mesh, report);
    add_joints(mesh, report);
    add_unmatched_edges(mesh, report);
    return report;
  }

  std::string MeshReport::to_text() const
  {
    std::ostringstream text;
    text << n_blocks << " blocks, " << n_cells / (quadratic ? 4 : 1)
         << (quadratic ? " quadratic" : "") << " triangles, " << n_vertices
         << " nodes; x " << lower_left[0] << " to " << upper_right[0]
         << " m, y " << lower_left[1] << " to " << upper_right[1] << " m\n"
         << "edges " << shortest_edge << " to " << longest_edge
         << " m, smallest angle " << smallest_angle << " degrees\n"
         << n_joint_faces / (quadratic ? 2 : 1) << " joint faces, "
         << total_joint_length << " m";
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
    if (unmatched_length > 0.)
      text << '\n'
           << "outer edges lie on each other along " << unmatched_length
           << " m without matching, first at (" << unmatched_position[0] << ", "
           << unmatched_position[1]
           << "): there is no joint there. Give both sides the same nodes";
    return text.str();
  }
} // namespace quoin
