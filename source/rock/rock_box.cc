// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/disjoint_sets.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/rock/block_borders.h>
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
    using Face        = BlockCutter::Face;

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

    /** Blocks in the way of plane @p p of a set that it cuts as far as
        persistence goes. */
    std::vector<unsigned int> chosen_blocks(const RockBoxParameters &rock,
                                            const SpaceJointSet &set,
                                            const unsigned int p,
                                            const RockBox &box)
    {
      RandomStream random(rock.seed, set.name + " persistence", p);
      std::vector<unsigned int> chosen;
      for (unsigned int b = 0; b < box.pieces.n_blocks(); ++b)
        if (set.persistence >= 1. || random.uniform() < set.persistence)
          chosen.push_back(b);
      return chosen;
    }

    /** Area of @p plane in those of @p blocks that refuse its cut [m^2]. */
    double refused_area(const RockBox &box,
                        const std::vector<unsigned int> &blocks,
                        const JointPlane &plane)
    {
      double area = 0.;
      for (const unsigned int b : blocks)
        if (box.pieces.try_cut(b, plane) == BlockCutter::refused)
          area += box.pieces.section(b, plane);
      return area;
    }

    /** Moves @p plane, by twice the shortest edge at the most, to where the
        fewest cuts are refused: a large block would stay whole because of one
        of its corners. Returns by how much [m]. */
    double move_aside(const RockBoxParameters &rock, const RockBox &box,
                      const std::vector<unsigned int> &blocks,
                      JointPlane &plane)
    {
      constexpr unsigned int steps = 4;
      double least                 = refused_area(box, blocks, plane);
      const double offset          = plane.offset;
      for (unsigned int i = 1; i <= steps && least > 0.; ++i)
        for (const double way : { 1., -1. })
        {
          JointPlane moved = plane;
          moved.offset     = offset + way * i * 2. * rock.shortest_edge / steps;
          const double area = refused_area(box, blocks, moved);
          if (area < least)
          {
            least = area;
            plane = moved;
          }
        }
      return std::abs(plane.offset - offset);
    }

    void cut(const RockBoxParameters &rock, const unsigned int s, RockBox &box)
    {
      const SpaceJointSet &set = rock.sets[s];
      for (unsigned int p = 0; p < box.planes[s].size(); ++p)
      {
        const auto blocks = chosen_blocks(rock, set, p, box);
        if (const double move = move_aside(rock, box, blocks, box.planes[s][p]);
            move > 0.)
        {
          ++box.n_moved;
          box.largest_move = std::max(box.largest_move, move);
        }
        for (const unsigned int b : blocks)
          if (box.pieces.cut_block(b, box.planes[s][p], RockBox::surface(s))
              == BlockCutter::refused)
          {
            ++box.n_refused;
            box.refused_area[s] += box.pieces.section(b, box.planes[s][p]);
          }
        if (box.pieces.n_blocks() > rock.most_blocks)
          throw InputError(
              "The joint sets cut the rock into more than "
              + std::to_string(rock.most_blocks)
              + " blocks, the 'Most blocks' of section 'Rock box', at set '"
              + set.name
              + "': take larger values of 'Spacing' or of 'Most blocks'.");
      }
    }

    /** The planes of a prism, whose normals point outwards: those of its sides,
        then its two ends. */
    std::vector<JointPlane> planes_of(const RockBody &body,
                                      const Polygon &section)
    {
      const SpaceVector axis = (body.end - body.start) / body.length();
      SpacePoint centre;
      for (const dealii::Point<2> &corner : section)
        centre += (body.place(corner, 0.5 * body.length()) - SpacePoint())
                  / double(section.size());
      std::vector<JointPlane> planes;
      const auto add = [&](const SpacePoint &at, SpaceVector normal)
      {
        normal /= normal.norm();
        if (normal * (at - centre) < 0.)
          normal = -normal;
        planes.push_back({ normal, normal * (at - SpacePoint()) });
      };
      for (std::size_t i = 0; i < section.size(); ++i)
      {
        const SpacePoint a = body.place(section[i], 0.);
        const SpacePoint b = body.place(section[(i + 1) % section.size()], 0.);
        add(a, dealii::cross_product_3d(b - a, axis));
      }
      add(body.start, axis);
      add(body.end, axis);
      return planes;
    }

    /** Cuts @p block; a new block belongs to the same part. */
    BlockCutter::Result cut_by_body(RockBox &box, const unsigned int block,
                                    const JointPlane &plane)
    {
      const auto result
          = box.pieces.cut_block(block, plane, RockBox::of_bodies);
      if (result == BlockCutter::cut)
        box.part_of.push_back(box.part_of[block]);
      return result;
    }

    /** Whether a convex piece lies above one of @p planes. */
    bool is_beyond(const RockBox &box, const unsigned int piece,
                   const std::vector<JointPlane> &planes,
                   const double tolerance)
    {
      return std::any_of(
          planes.begin(), planes.end(),
          [&](const JointPlane &plane)
          {
            for (const unsigned int f : box.pieces.faces_of(piece))
              for (const unsigned int v : box.pieces.faces()[f].loop)
                if (plane.distance(box.pieces.vertices()[v]) < -tolerance)
                  return false;
            return true;
          });
    }

    /** Cuts the pieces of the rock mass by @p body and, along its axis, those
        inside by its rounds. */
    void cut(const RockBoxParameters &rock, const RockBody &body, RockBox &box)
    {
      const double tolerance = 1e-9 * rock.low.distance(rock.high);
      const SpaceVector axis = (body.end - body.start) / body.length();
      const auto first       = static_cast<unsigned int>(box.parts.size());
      const unsigned int n   = body.n_parts();
      for (unsigned int i = 0; i < n; ++i)
        box.parts.push_back({ body.name, body.group(i),
                              body.is_hole || body.is_outlined ? body.name : "",
                              body.is_hole, body.has_joints, body.size });
      bool is_found = false;
      for (const Polygon &section : convex_parts(body.section))
      {
        const std::vector<JointPlane> planes = planes_of(body, section);
        std::vector<unsigned int> inside;
        for (unsigned int b = 0; b < box.pieces.n_blocks(); ++b)
          if (box.part_of[b] == none)
            inside.push_back(b);
        for (const JointPlane &plane : planes)
        {
          std::vector<unsigned int> left;
          for (const unsigned int b : inside)
            if (!is_beyond(box, b, planes, tolerance))
            {
              // What is above the plane is new.
              cut_by_body(box, b, plane);
              left.push_back(b);
            }
          inside = left;
        }
        for (const unsigned int b : inside)
          if (!is_beyond(box, b, planes, tolerance))
          {
            box.part_of[b] = first;
            is_found       = true;
          }
      }
      if (!is_found)
        throw InputError("section 'Rock bodies', '" + body.name
                         + "': nothing of it lies in the box of section 'Rock "
                           "box' and outside of earlier bodies. Check 'Start', "
                           "'End' and the shape.");
      double along = 0.;
      for (unsigned int i = 0; i + 1 < n; ++i)
      {
        along += body.rounds[i];
        const JointPlane plane{ axis,
                                axis * (body.start - SpacePoint()) + along };
        const unsigned int n_pieces = box.pieces.n_blocks();
        for (unsigned int b = 0; b < n_pieces; ++b)
          if (box.part_of[b] == first + i)
          {
            if (cut_by_body(box, b, plane) == BlockCutter::cut)
              box.part_of.back() = first + i + 1;
            else if (is_beyond(box, b, { plane }, tolerance))
              box.part_of[b] = first + i + 1;
          }
      }
    }

    /** Whether the segment a-b passes through a convex face. */
    bool crosses(const BlockCutter &blocks, const Face &face,
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

  const RockBox::Part *RockBox::part(const unsigned int piece) const
  {
    return piece == BlockCutter::none || part_of[piece] == none
               ? nullptr
               : &parts[part_of[piece]];
  }

  bool RockBox::is_void(const unsigned int piece) const
  {
    const Part *of = part(piece);
    return piece == BlockCutter::none || (of && of->is_hole);
  }

  bool RockBox::is_between_blocks(const unsigned int f) const
  {
    const Face &face = pieces.faces()[f];
    const bool in = !is_void(face.inner), out = !is_void(face.outer);
    if (!in || !out)
      return in || out;
    if (part_of[face.inner] != part_of[face.outer])
      return true;
    const Part *of = part(face.inner);
    return face.surface != of_bodies && !(of && !of->has_joints);
  }

  bool RockBox::is_joint(const unsigned int f, const unsigned int set) const
  {
    const Face &face = pieces.faces()[f];
    return face.surface == surface(set) && !is_void(face.inner)
           && !is_void(face.outer) && is_between_blocks(f);
  }

  std::pair<std::vector<unsigned int>, unsigned int>
  RockBox::blocks(const bool apart) const
  {
    DisjointSets sets(pieces.n_blocks());
    for (unsigned int f = 0; f < pieces.faces().size(); ++f)
    {
      const Face &face = pieces.faces()[f];
      if (is_void(face.inner) || is_void(face.outer))
        continue;
      // The name of a surface between two parts is that of either of them.
      const Part *of = part(face.inner) ? part(face.inner) : part(face.outer);
      const bool is_closed = face.surface == of_bodies && !apart
                             && part_of[face.inner] != part_of[face.outer]
                             && of->surface.empty();
      if (is_closed || !is_between_blocks(f))
        sets.unite(face.inner, face.outer);
    }
    std::vector<unsigned int> number(pieces.n_blocks(), none);
    std::vector<unsigned int> of_set(pieces.n_blocks(), none);
    unsigned int n = 0;
    for (unsigned int b = 0; b < number.size(); ++b)
    {
      if (is_void(b))
        continue;
      unsigned int &of = of_set[sets.find(b)];
      if (of == none)
        of = n++;
      number[b] = of;
    }
    return { number, n };
  }

  std::vector<double> RockBox::block_volumes() const
  {
    const auto [number, n] = blocks();
    std::vector<double> volumes(n, 0.);
    for (unsigned int b = 0; b < number.size(); ++b)
      if (number[b] != none)
        volumes[number[b]] += pieces.volume(b);
    return volumes;
  }

  double RockBox::rock_volume() const
  {
    double sum = 0.;
    for (unsigned int b = 0; b < pieces.n_blocks(); ++b)
      if (!is_void(b))
        sum += pieces.volume(b);
    return sum;
  }

  double RockBox::joint_area(const unsigned int set) const
  {
    double sum = 0.;
    for (unsigned int f = 0; f < pieces.faces().size(); ++f)
      if (is_joint(f, set))
        sum += pieces.area(f).norm();
    return sum;
  }

  double RockBox::joint_frequency(const unsigned int set,
                                  const SpaceVector &direction) const
  {
    double sum = 0.;
    for (unsigned int f = 0; f < pieces.faces().size(); ++f)
      if (is_joint(f, set))
        sum += std::abs(pieces.area(f) * direction);
    return sum / rock_volume();
  }

  unsigned int RockBox::n_crossings(const unsigned int set, const SpacePoint &a,
                                    const SpacePoint &b) const
  {
    unsigned int n = 0;
    for (unsigned int f = 0; f < pieces.faces().size(); ++f)
      n += is_joint(f, set) && crosses(pieces, pieces.faces()[f], a, b);
    return n;
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
    box.part_of.assign(box.pieces.n_blocks(), none);
    box.pieces.refuse_none();
    for (const RockBody &body : rock.bodies)
      cut(rock, body, box);
    if (box.pieces.n_blocks() == 1)
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
    const std::vector<double> volumes = box.block_volumes();
    const double total                = box.rock_volume();
    const auto [least, most]
        = std::minmax_element(volumes.begin(), volumes.end());
    std::string text = "rock of " + std::to_string(volumes.size())
                       + " blocks, volumes from " + number_text(*least) + " to "
                       + number_text(*most) + " m^3, mean "
                       + number_text(total / volumes.size());
    for (unsigned int s = 0; s < rock.sets.size(); ++s)
      text += "\njoint set '" + rock.sets[s].name + "': "
              + std::to_string(box.planes[s].size()) + " planes, joints of "
              + number_text(box.joint_area(s)) + " m^2, "
              + number_text(box.joint_area(s) / total) + " m^2 per m^3";
    for (const RockBody &body : rock.bodies)
    {
      double volume = 0.;
      for (unsigned int b = 0; b < box.pieces.n_blocks(); ++b)
        if (box.part_of[b] != none
            && box.parts[box.part_of[b]].body == body.name)
          volume += box.pieces.volume(b);
      text += "\n" + std::string(body.is_hole ? "hole" : "body") + " '"
              + body.name + "': " + number_text(volume) + " m^3";
      if (!body.rounds.empty())
        text += " in " + std::to_string(body.n_parts()) + " rounds";
    }
    if (!rock.bodies.empty())
      text += "\nshortest edge of a block "
              + number_text(BlockBorders(rock, box).shortest_edge())
              + " m; it may limit the step of an explicit run: another "
                "'Start' of a body or 'Origin' of a set may make it longer";
    if (box.n_moved > 0)
      text += "\n" + std::to_string(box.n_moved)
              + (box.n_moved == 1 ? " plane" : " planes") + " moved by up to "
              + number_text(box.largest_move)
              + " m, to cut blocks that would have been left whole for "
                "'Shortest edge' or 'Smallest block'";
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
    const double total = box.rock_volume();
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
    unsigned int n = 0;
    for (const double volume : box.block_volumes())
      text << "block," << ++n << ",,,,,," << volume << "\n";
    return text.str();
  }
} // namespace quoin
