// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/none.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/rock/rock_layout.h>

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>

namespace quoin
{
  namespace
  {
    using Point = dealii::Point<2>;
    class Writer
    {
    public:
      Writer(const RockParameters &rock, const RockLayout &layout)
        : rock(rock), layout(layout), network(*layout.network)
      {
      }

      GmshGeometry write()
      {
        write_head();
        write_points_and_lines();
        write_surfaces();
        write_cracks();
        write_sizes();
        text << physical_names(surfaces, curves);
        return { text.str(), joint_curves };
      }

    private:
      void write_head();
      void write_points_and_lines();
      void write_surfaces();
      void write_cracks();
      void write_sizes();
      /** Name of the curve along edge @p e; empty: it has none. */
      std::string curve_name(unsigned int e);
      /** Regions whose outlines part what is on both sides of a border. */
      std::vector<unsigned int> regions_of_border(unsigned int e) const;
      void add_joint_curve(const std::string &name);
      unsigned int region_of(const unsigned int face) const
      {
        return face == BlockFaces::outside ? none : layout.region[face];
      }
      std::string side_name(const Point &p) const;
      bool is_block(const unsigned int face) const
      {
        return face != BlockFaces::outside && layout.group[face] != none;
      }
      void write_line(unsigned int number, const JointNetwork::Edge &edge);

      const RockParameters &rock;
      const RockLayout &layout;
      const JointNetwork &network;
      std::map<std::string, GmshNumbers> curves, surfaces;
      std::vector<std::string> joint_curves;
      std::vector<bool> has_point;
      GmshNumbers refined; /**< lines from which sizes grow */
      std::ostringstream text;
    };

    void Writer::write_head()
    {
      text.precision(17);
      text
          << "// Blocks of rock; lengths in metres. Joints have no thickness:\n"
             "// names of physical curves say which lines are joints.\n\n"
             "DefineConstant[ size = {"
          << rock.element_size
          << ", Name \"Element size\"} ]; // edges are no longer\n\n";
    }

    void Writer::write_line(const unsigned int number,
                            const JointNetwork::Edge &edge)
    {
      for (const unsigned int v : { edge.from, edge.to })
        if (!has_point[v])
        {
          has_point[v] = true;
          text << "Point(" << v + 1 << ") = {" << network.point(v)[0] << ", "
               << network.point(v)[1] << ", 0, size};\n";
        }
      text << "Line(" << number << ") = {" << edge.from + 1 << ", "
           << edge.to + 1 << "};\n";
    }

    std::string Writer::side_name(const Point &p) const
    {
      double nearest = std::numeric_limits<double>::max();
      std::string name;
      for (std::size_t i = 0; i < rock.outline.size(); ++i)
      {
        const double distance = distance_to_segment(
            p, rock.outline[i], rock.outline[(i + 1) % rock.outline.size()]);
        if (distance < nearest)
        {
          nearest = distance;
          name    = rock.sides[i];
        }
      }
      return name;
    }

    std::vector<unsigned int>
    Writer::regions_of_border(const unsigned int e) const
    {
      // Where outlines coincide the edge bears the earliest one's number. The
      // later region of the two beside it always ends there.
      const unsigned int left  = region_of(layout.faces->face(2 * e));
      const unsigned int right = region_of(layout.faces->face(2 * e + 1));
      if (left == right)
        return {};
      const unsigned int later
          = left == none || (right != none && right > left) ? right : left;
      const unsigned int earlier = left == later ? right : left;
      if (earlier != none && network.edges()[e].line == 1 + earlier)
        return { earlier, later };
      return { later };
    }

    void Writer::add_joint_curve(const std::string &name)
    {
      if (std::find(joint_curves.begin(), joint_curves.end(), name)
          == joint_curves.end())
        joint_curves.push_back(name);
    }

    std::string Writer::curve_name(const unsigned int e)
    {
      const auto &edge       = network.edges()[e];
      const bool left_there  = is_block(layout.faces->face(2 * e));
      const bool right_there = is_block(layout.faces->face(2 * e + 1));
      if (edge.line == 0)
        return side_name(network.middle(edge));
      if (edge.border == JointNetwork::none)
      {
        const std::string &name = layout.line_names[edge.line];
        if (left_there && right_there)
          add_joint_curve(name);
        return name;
      }
      if (left_there != right_there)
      {
        // A wall of the hole, whatever is beside it.
        const unsigned int hole
            = region_of(layout.faces->face(left_there ? 2 * e + 1 : 2 * e));
        return rock.regions[hole].name;
      }
      for (const unsigned int r : regions_of_border(e))
        if (rock.regions[r].is_outlined)
        {
          add_joint_curve(rock.regions[r].name);
          return rock.regions[r].name;
        }
      return "";
    }

    void Writer::write_points_and_lines()
    {
      has_point.assign(network.n_vertices(), false);
      for (unsigned int e = 0; e < network.edges().size(); ++e)
      {
        const auto &edge = network.edges()[e];
        if (!is_block(layout.faces->face(2 * e))
            && !is_block(layout.faces->face(2 * e + 1)))
          continue;
        write_line(e + 1, edge);
        const std::string name = curve_name(e);
        if (!name.empty())
          curves[name].push_back(e + 1);
        const auto regions = edge.border == JointNetwork::none
                                 ? std::vector<unsigned int>()
                                 : regions_of_border(e);
        if (std::any_of(regions.begin(), regions.end(),
                        [&](const unsigned int r)
                        { return rock.regions[r].refines_mesh; }))
          refined.push_back(e + 1);
      }
    }

    void Writer::write_surfaces()
    {
      int next_loop       = 1;
      const auto &faces   = layout.faces->faces();
      const auto add_loop = [&](const BlockFaces::Loop &loop)
      {
        GmshNumbers lines;
        for (const unsigned int h : loop)
          lines.push_back(h % 2 == 0 ? int(h / 2 + 1) : -int(h / 2 + 1));
        text << "Curve Loop(" << next_loop << ") = " << braces(lines) << ";\n";
        return next_loop++;
      };
      for (unsigned int f = 0; f < faces.size(); ++f)
      {
        if (!is_block(f))
          continue;
        GmshNumbers loops = { add_loop(faces[f].outer) };
        for (const auto &loop : faces[f].inner)
          loops.push_back(add_loop(loop));
        text << "Plane Surface(" << f + 1 << ") = " << braces(loops) << ";\n";
        surfaces[layout.group[f] == 0 ? rock.group
                                      : rock.regions[layout.group[f] - 1].name]
            .push_back(f + 1);
      }
    }

    void Writer::write_cracks()
    {
      unsigned int number = network.edges().size() + 1;
      for (const JointNetwork::Edge &crack : layout.cracks)
      {
        const unsigned int f = layout.faces->find(network.middle(crack));
        if (!is_block(f))
          continue;
        write_line(number, crack);
        text << "Line{" << number << "} In Surface{" << f + 1 << "};\n";
        const std::string &name = layout.line_names[crack.line];
        curves[name].push_back(number++);
        add_joint_curve(name);
      }
    }

    void Writer::write_sizes()
    {
      if (refined.empty())
        return;
      text << "Field[1] = Distance;\nField[1].CurvesList = " << braces(refined)
           << ";\nField[1].NumPointsPerCurve = 20;\nField[2] = MathEval;\n"
              "Field[2].F = Sprintf(\"Min(%g, "
           << rock.finest_size << " + " << rock.size_growth
           << " * F1)\", size);\nBackground Field = 2;\n"
              "Mesh.MeshSizeFromPoints = 0;\n"
              "Mesh.MeshSizeExtendFromBoundary = 0;\n";
    }
  } // namespace

  GmshGeometry rock_geometry(const RockParameters &rock,
                             const RockLayout &layout)
  {
    return Writer(rock, layout).write();
  }
} // namespace quoin
