// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/rock/rock_box.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace quoin
{
  namespace
  {
    using SpacePoint  = dealii::Point<3>;
    using SpaceVector = dealii::Tensor<1, 3>;

    /** More planes than that make no blocks that could be computed. */
    constexpr unsigned int most_planes = 100000;

    double draw_spacing(const RockBoxParameters &rock, const SpaceJointSet &set,
                        const int number)
    {
      RandomStream random(rock.seed, set.name + " spacing", number);
      double spacing = set.spacing.draw(random);
      while (!(spacing > 0.))
        spacing = set.spacing.draw(random);
      return spacing;
    }

    std::vector<JointPlane> draw_planes(const RockBoxParameters &rock,
                                        const SpaceJointSet &set)
    {
      const SpaceVector mean  = set.mean_normal();
      const SpacePoint centre = rock.low + 0.5 * (rock.high - rock.low);
      const double middle     = mean * (centre - set.origin);
      // Scattered planes turn about points on the normal through the centre.
      double reach = 0.5 * rock.low.distance(rock.high);
      if (set.concentration == 0.)
      {
        reach = 0.;
        for (unsigned int d = 0; d < 3; ++d)
          reach += 0.5 * std::abs(mean[d]) * (rock.high[d] - rock.low[d]);
      }
      std::map<int, double> positions = { { 0, 0. } };
      for (const int way : { 1, -1 })
      {
        double s = 0.;
        for (int k = way; way * (s - middle) < reach; k += way)
        {
          s += way * draw_spacing(rock, set, k);
          positions[k] = s;
          if (positions.size() > most_planes)
            throw InputError("Joint set '" + set.name
                             + "' has more than 100000 planes between its "
                               "'Origin' and the far side of the box: take a "
                               "larger 'Spacing' or an origin in the box.");
        }
      }
      std::vector<JointPlane> planes;
      for (const auto &[k, s] : positions)
      {
        if (std::abs(s - middle) >= reach)
          continue;
        RandomStream random(rock.seed, set.name + " direction", k);
        const SpaceVector normal
            = set.concentration > 0.
                  ? draw_fisher(mean, set.concentration, random)
                  : mean;
        const SpacePoint pivot = centre + (s - middle) * mean;
        planes.push_back({ normal, normal * (pivot - SpacePoint()) });
      }
      return planes;
    }

    void cut(const RockBoxParameters &rock, const unsigned int s, RockBox &box)
    {
      const SpaceJointSet &set = rock.sets[s];
      for (unsigned int p = 0; p < box.planes[s].size(); ++p)
      {
        RandomStream random(rock.seed, set.name + " persistence", p);
        const unsigned int n = box.blocks.n_blocks();
        for (unsigned int b = 0; b < n; ++b)
        {
          if (set.persistence < 1. && random.uniform() >= set.persistence)
            continue;
          if (box.blocks.cut_block(b, box.planes[s][p], RockBox::surface(s))
              == BlockCutter::refused)
          {
            ++box.n_refused;
            box.refused_area[s] += box.blocks.section(b, box.planes[s][p]);
          }
        }
        if (box.blocks.n_blocks() > rock.most_blocks)
          throw InputError(
              "The joint sets cut the rock into more than "
              + std::to_string(rock.most_blocks)
              + " blocks, the 'Most blocks' of section 'Rock box', at set '"
              + set.name
              + "': take larger values of 'Spacing' or of 'Most blocks'.");
      }
    }

    /** Whether the segment a-b passes through a convex face. */
    bool crosses(const BlockCutter &blocks, const BlockCutter::Face &face,
                 const SpacePoint &a, const SpacePoint &b)
    {
      const auto &x = blocks.vertices();
      SpaceVector normal;
      const auto &loop = face.loop;
      for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        normal += dealii::cross_product_3d(x[loop[i]] - x[loop[0]],
                                           x[loop[i + 1]] - x[loop[0]]);
      const double da = normal * (a - x[loop[0]]);
      const double db = normal * (b - x[loop[0]]);
      if ((da < 0.) == (db < 0.))
        return false;
      const SpacePoint p = a + da / (da - db) * (b - a);
      for (std::size_t i = 0; i < loop.size(); ++i)
      {
        const SpacePoint &from = x[loop[i]],
                         &to   = x[loop[(i + 1) % loop.size()]];
        if (dealii::cross_product_3d(to - from, p - from) * normal < 0.)
          return false;
      }
      return true;
    }
  } // namespace

  SpaceVector plane_normal(const double dip, const double dip_direction)
  {
    const double d = dip * constants::degree;
    const double a = dip_direction * constants::degree;
    SpaceVector normal;
    normal[0] = std::sin(d) * std::sin(a);
    normal[1] = std::sin(d) * std::cos(a);
    normal[2] = std::cos(d);
    return normal;
  }

  SpaceVector draw_fisher(const SpaceVector &mean, const double kappa,
                          RandomStream &random)
  {
    const double u      = random.uniform();
    const double cosine = std::clamp(
        1. + std::log(u + (1. - u) * std::exp(-2. * kappa)) / kappa, -1., 1.);
    const double angle = 2. * constants::pi * random.uniform();
    const double sine  = std::sqrt(1. - cosine * cosine);
    unsigned int least = 0;
    for (unsigned int d = 1; d < 3; ++d)
      if (std::abs(mean[d]) < std::abs(mean[least]))
        least = d;
    SpaceVector axis;
    axis[least]   = 1.;
    SpaceVector e = dealii::cross_product_3d(mean, axis);
    e /= e.norm();
    const SpaceVector f = dealii::cross_product_3d(mean, e);
    return cosine * mean + sine * (std::cos(angle) * e + std::sin(angle) * f);
  }

  SpaceVector SpaceJointSet::mean_normal() const
  {
    return plane_normal(dip, dip_direction);
  }

  double RockBox::box_volume() const
  {
    double sum = 0.;
    for (unsigned int b = 0; b < blocks.n_blocks(); ++b)
      sum += blocks.volume(b);
    return sum;
  }

  double RockBox::joint_area(const unsigned int set) const
  {
    double sum = 0.;
    for (unsigned int f = 0; f < blocks.faces().size(); ++f)
      if (blocks.faces()[f].surface == surface(set))
        sum += blocks.area(f).norm();
    return sum;
  }

  double RockBox::joint_frequency(const unsigned int set,
                                  const SpaceVector &direction) const
  {
    double sum = 0.;
    for (unsigned int f = 0; f < blocks.faces().size(); ++f)
      if (blocks.faces()[f].surface == surface(set))
        sum += std::abs(blocks.area(f) * direction);
    return sum / box_volume();
  }

  unsigned int RockBox::n_crossings(const unsigned int set, const SpacePoint &a,
                                    const SpacePoint &b) const
  {
    return std::count_if(blocks.faces().begin(), blocks.faces().end(),
                         [&](const BlockCutter::Face &face) {
                           return face.surface == surface(set)
                                  && crosses(blocks, face, a, b);
                         });
  }

  RockBox cut_rock_box(const RockBoxParameters &rock)
  {
    RockBox box{ BlockCutter(rock.low, rock.high, rock.shortest_edge,
                             rock.smallest_block),
                 {},
                 0 };
    for (unsigned int s = 0; s < rock.sets.size(); ++s)
    {
      box.planes.push_back(draw_planes(rock, rock.sets[s]));
      box.refused_area.push_back(0.);
      cut(rock, s, box);
    }
    if (box.blocks.n_blocks() == 1)
    {
      double longest = 0.;
      for (unsigned int d = 0; d < 3; ++d)
        longest = std::max(longest, rock.high[d] - rock.low[d]);
      if (rock.shortest_edge > 0.5 * longest)
        throw InputError("section 'Rock box': no plane can cut the rock, as "
                         "'Shortest edge', by default a share of 'Element "
                         "size', is "
                         + number_text(rock.shortest_edge)
                         + " m, and the longest edge of the rock "
                         + number_text(longest)
                         + " m. Check the unit of both.");
      throw InputError("No plane of section 'Rock joint sets' cuts the rock: "
                       "take a smaller 'Spacing', a larger 'Persistence' or an "
                       "'Origin' in the box.");
    }
    return box;
  }

  std::string rock_box_report(const RockBoxParameters &rock, const RockBox &box)
  {
    double least = box.box_volume(), most = 0.;
    const double total = least;
    for (unsigned int b = 0; b < box.blocks.n_blocks(); ++b)
    {
      least = std::min(least, box.blocks.volume(b));
      most  = std::max(most, box.blocks.volume(b));
    }
    std::string text = "rock of " + std::to_string(box.blocks.n_blocks())
                       + " blocks, volumes from " + number_text(least) + " to "
                       + number_text(most) + " m^3, mean "
                       + number_text(total / box.blocks.n_blocks());
    for (unsigned int s = 0; s < rock.sets.size(); ++s)
      text += "\njoint set '" + rock.sets[s].name + "': "
              + std::to_string(box.planes[s].size()) + " planes, joints of "
              + number_text(box.joint_area(s)) + " m^2, "
              + number_text(box.joint_area(s) / total) + " m^2 per m^3";
    if (box.n_refused == 0)
      return text;
    text += "\n" + std::to_string(box.n_refused)
            + " cuts of blocks left out, which would make edges below "
              "'Shortest edge', "
            + number_text(rock.shortest_edge)
            + " m, or blocks below 'Smallest block', "
            + number_text(rock.smallest_block) + " m^3: joints of";
    std::string separator = " ";
    for (unsigned int s = 0; s < rock.sets.size(); ++s)
      if (const double area = box.refused_area[s]; area > 0.)
      {
        text += separator + number_text(area) + " m^2 of set '"
                + rock.sets[s].name + "', "
                + std::to_string(
                    std::lround(100. * area / (area + box.joint_area(s))))
                + " % of the set's joints";
        separator = ", ";
      }
    text += "; smaller values of these two entries leave out fewer";
    return text;
  }

  std::string rock_box_statistics(const RockBoxParameters &rock,
                                  const RockBox &box)
  {
    std::ostringstream text;
    text.precision(10);
    text << "kind,name,dip [deg],dip direction [deg],P32 asked [1/m],"
            "P32 made [1/m],P10 made [1/m],volume [m^3]\n";
    const double total = box.box_volume();
    for (unsigned int s = 0; s < rock.sets.size(); ++s)
    {
      const SpaceJointSet &set = rock.sets[s];
      text << "set," << set.name << "," << set.dip << "," << set.dip_direction
           << "," << set.persistence / set.spacing.mean << ","
           << box.joint_area(s) / total << ","
           << box.joint_frequency(s, plane_normal(set.dip, set.dip_direction))
           << ",\n";
      for (const JointPlane &plane : box.planes[s])
      {
        const SpaceVector n
            = plane.normal[2] < 0. ? -plane.normal : plane.normal;
        double direction = std::atan2(n[0], n[1]) / constants::degree;
        if (direction < 0.)
          direction += 360.;
        text << "plane," << set.name << ","
             << std::acos(std::min(n[2], 1.)) / constants::degree << ","
             << direction << ",,,,\n";
      }
    }
    for (unsigned int b = 0; b < box.blocks.n_blocks(); ++b)
      text << "block," << b + 1 << ",,,,,," << box.blocks.volume(b) << "\n";
    return text.str();
  }

  GmshGeometry rock_box_geometry(const RockBoxParameters &rock,
                                 const RockBox &box)
  {
    std::ostringstream text;
    text.precision(17);
    text << "// Blocks of rock; x east, y north, z up [m]. Joints have no "
            "thickness:\n// names of physical surfaces say which are joints.\n"
            "DefineConstant[ size = {"
         << rock.element_size << ", Name \"Element size\"} ];\n";
    const auto &points = box.blocks.vertices();
    for (unsigned int v = 0; v < points.size(); ++v)
      text << "Point(" << v + 1 << ") = {" << points[v][0] << ", "
           << points[v][1] << ", " << points[v][2] << ", size};\n";
    std::map<std::pair<unsigned int, unsigned int>, int> lines;
    std::map<std::string, GmshNumbers> surfaces;
    GmshGeometry geometry;
    for (unsigned int f = 0; f < box.blocks.faces().size(); ++f)
    {
      const BlockCutter::Face &face = box.blocks.faces()[f];
      GmshNumbers loop;
      for (std::size_t i = 0; i < face.loop.size(); ++i)
      {
        const unsigned int a = face.loop[i];
        const unsigned int b = face.loop[(i + 1) % face.loop.size()];
        const auto [line, is_new]
            = lines.try_emplace(std::minmax(a, b), lines.size() + 1);
        if (is_new)
          text << "Line(" << line->second << ") = {" << std::min(a, b) + 1
               << ", " << std::max(a, b) + 1 << "};\n";
        loop.push_back(a < b ? line->second : -line->second);
      }
      text << "Curve Loop(" << f + 1 << ") = " << braces(loop)
           << ";\nPlane Surface(" << f + 1 << ") = {" << f + 1 << "};\n";
      surfaces[face.surface < 6 ? rock.sides[face.surface]
                                : rock.sets[face.surface - 6].name]
          .push_back(f + 1);
    }
    GmshNumbers volumes;
    for (unsigned int b = 0; b < box.blocks.n_blocks(); ++b)
    {
      GmshNumbers shell;
      for (const unsigned int f : box.blocks.faces_of(b))
        shell.push_back(f + 1);
      text << "Surface Loop(" << b + 1 << ") = " << braces(shell)
           << ";\nVolume(" << b + 1 << ") = {" << b + 1 << "};\n";
      volumes.push_back(b + 1);
    }
    text << "Physical Volume(\"" << rock.group << "\") = " << braces(volumes)
         << ";\n"
         << physical_names(surfaces, {});
    for (const SpaceJointSet &set : rock.sets)
      if (surfaces.count(set.name) > 0)
        geometry.joint_curves.push_back(set.name);
    geometry.text = text.str();
    return geometry;
  }
} // namespace quoin
