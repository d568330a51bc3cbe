// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/none.h>
#include <quoin/rock/block_borders.h>
#include <quoin/rock/rock_box.h>

#include <map>
#include <set>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** The points and lines of a geometry, written when they are needed. */
    class Lines
    {
    public:
      Lines(const BlockBorders &borders, const double size,
            std::ostringstream &text)
        : borders(borders), usual_size(size), text(text)
      {
      }

      /** Numbers of the lines around @p loop, with the sign of direction. */
      GmshNumbers around(const BlockBorders::Loop &loop)
      {
        GmshNumbers result;
        for (std::size_t i = 0; i < loop.size(); ++i)
        {
          const unsigned int a = loop[i];
          const unsigned int b = loop[(i + 1) % loop.size()];
          const auto [it, is_new]
              = numbers.try_emplace(std::minmax(a, b), numbers.size() + 1);
          if (is_new)
          {
            write_point(std::min(a, b));
            write_point(std::max(a, b));
            text << "Line(" << it->second << ") = {" << std::min(a, b) + 1
                 << ", " << std::max(a, b) + 1 << "};\n";
          }
          result.push_back(a < b ? it->second : -it->second);
        }
        return result;
      }

    private:
      void write_point(const unsigned int v)
      {
        if (!written.insert(v).second)
          return;
        const dealii::Point<3> &p = borders.vertices()[v];
        text << "Point(" << v + 1 << ") = {" << p[0] << ", " << p[1] << ", "
             << p[2] << ", ";
        if (borders.size(v) < usual_size)
          text << borders.size(v) << "};\n";
        else
          text << "size};\n";
      }

      const BlockBorders &borders;
      const double usual_size;
      std::ostringstream &text;
      std::map<std::pair<unsigned int, unsigned int>, int> numbers;
      std::set<unsigned int> written;
    };
  } // namespace

  GmshGeometry rock_box_geometry(const RockBoxParameters &rock,
                                 const RockBox &box)
  {
    const BlockBorders borders(rock, box);
    std::ostringstream text;
    text.precision(17);
    text << "// Blocks of rock; x east, y north, z up [m]. Joints have no "
            "thickness:\n// names of physical surfaces say which are joints.\n"
            "DefineConstant[ size = {"
         << rock.element_size << ", Name \"Element size\"} ];\n";
    Lines lines(borders, rock.element_size, text);
    std::map<std::string, GmshNumbers> surfaces;
    int n_loops = 0;
    for (unsigned int i = 0; i < borders.borders().size(); ++i)
    {
      const BlockBorders::Border &border = borders.borders()[i];
      GmshNumbers loops;
      for (const BlockBorders::Loop &loop : border.loops)
      {
        const std::string around = braces(lines.around(loop));
        loops.push_back(++n_loops);
        text << "Curve Loop(" << n_loops << ") = " << around << ";\n";
      }
      text << "Plane Surface(" << i + 1 << ") = " << braces(loops) << ";\n";
      if (!border.name.empty())
        surfaces[border.name].push_back(i + 1);
    }
    std::map<std::string, GmshNumbers> volumes;
    int n_shells          = 0;
    const auto all_shells = borders.shells();
    for (unsigned int b = 0; b < all_shells.size(); ++b)
    {
      GmshNumbers shells;
      for (const auto &shell : all_shells[b])
      {
        GmshNumbers of;
        for (const unsigned int i : shell)
          of.push_back(i + 1);
        shells.push_back(++n_shells);
        text << "Surface Loop(" << n_shells << ") = " << braces(of) << ";\n";
      }
      text << "Volume(" << b + 1 << ") = " << braces(shells) << ";\n";
      volumes[borders.group(b)].push_back(b + 1);
    }
    for (const auto &[name, of] : volumes)
      text << "Physical Volume(\"" << name << "\") = " << braces(of) << ";\n";
    text << physical_names(surfaces, {});
    GmshGeometry geometry;
    for (const SpaceJointSet &set : rock.sets)
      if (surfaces.count(set.name) > 0)
        geometry.joint_curves.push_back(set.name);
    for (const RockBody &body : rock.bodies)
      if (body.is_outlined && !body.is_hole && surfaces.count(body.name) > 0)
        geometry.joint_curves.push_back(body.name);
    geometry.text = text.str();
    return geometry;
  }
} // namespace quoin
