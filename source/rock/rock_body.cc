// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/rock/region_shape.h>
#include <quoin/rock/rock_body.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace quoin
{
  namespace
  {
    using SpacePoint  = dealii::Point<3>;
    using SpaceVector = dealii::Tensor<1, 3>;

    enum class BodyUse
    {
      body,
      hole
    };

    std::vector<double> read_rounds(const ParameterSection &section)
    {
      std::vector<double> rounds;
      for (const auto &row :
           number_rows(section, "Rounds", 1,
                       "must be lengths along the axis [m], separated by "
                       "semicolons, such as '3; 3; 2.5'."))
      {
        if (!(row[0] > 0.))
          section.fail("Rounds", "must be positive lengths [m].");
        rounds.push_back(row[0]);
      }
      return rounds;
    }

    void check_body(const ParameterSection &section, const RockBody &body)
    {
      if (body.start == body.end)
        section.fail("End", "must be another point than 'Start': the two are "
                            "the ends of the axis of the body.");
      const double sum
          = std::accumulate(body.rounds.begin(), body.rounds.end(), 0.);
      if (sum > body.length() * (1. + 1e-9))
        section.fail("Rounds", "are " + number_text(sum)
                                   + " m together, longer than the axis from "
                                     "'Start' to 'End', "
                                   + number_text(body.length())
                                   + " m: take fewer or shorter ones.");
      if (body.is_hole && !body.rounds.empty())
        section.fail("Rounds", "are for a body that is excavated in rounds, "
                               "not for 'Use = hole': leave them empty.");
    }

    void enter_body(ParameterEntries &entries, RockBody &body)
    {
      enter_region_shape(entries, body.section);
      std::array<double, 3> start{}, end{};
      entries.numbers(
          "Start", start,
          "Point x, y, z in space of the origin of the section at one end of "
          "the body. The section is across the axis from here to 'End'; its x "
          "is horizontal, to the right for who looks along the axis, its y "
          "upwards. Of a vertical axis x is east and y north [m]");
      entries.numbers("End", end,
                      "Point x, y, z in space of the origin of the section at "
                      "the other end of the body [m]");
      body.start = SpacePoint(start[0], start[1], start[2]);
      body.end   = SpacePoint(end[0], end[1], end[2]);
      entries.other("Rounds", "",
                    "Lengths of the rounds in which the body is excavated, "
                    "from 'Start' on, with semicolons between them; each is a "
                    "physical volume NAME_1, NAME_2 and so on, and what is "
                    "left up to 'End' is the last one. Empty: the body is one "
                    "volume with its own name [m]",
                    [&](const ParameterSection &section)
                    {
                      if (!section.text("Rounds").empty())
                        body.rounds = read_rounds(section);
                    });
      BodyUse use = BodyUse::body;
      entries.choice(
          "Use", use, { { "body", BodyUse::body }, { "hole", BodyUse::hole } },
          "Use of the body. body: a physical volume with the body's name, for "
          "a material of its own or for excavation; hole: a void, whose "
          "surface has the body's name. Where bodies overlap, the earlier one "
          "prevails.");
      body.is_hole = use == BodyUse::hole;
      entries.flag("Outline is a joint", body.is_outlined,
                   "Whether the surface of a body and the faces between its "
                   "rounds, the physical surface with the body's name, are "
                   "joints, as excavation needs.");
      entries.flag("Joints inside", body.has_joints,
                   "Whether joints pass through a body.");
      entries.nonnegative("Element size", body.size,
                          "Longest edge of elements at the surface of the "
                          "body; 0: that of section 'Rock box' [m]");
      if (const ParameterSection *section = entries.read_section())
        check_body(*section, body);
    }

    double turn(const dealii::Point<2> &a, const dealii::Point<2> &b,
                const dealii::Point<2> &c)
    {
      const dealii::Tensor<1, 2> u = b - a, v = c - a;
      return u[0] * v[1] - u[1] * v[0];
    }
  } // namespace

  void RockBody::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_body);
  }

  RockBody RockBody::read(const ParameterSection &section,
                          const std::string &name)
  {
    RockBody body = read_entries(section, enter_body);
    body.name     = name;
    return body;
  }

  double RockBody::length() const
  {
    return start.distance(end);
  }

  unsigned int RockBody::n_parts() const
  {
    const double sum = std::accumulate(rounds.begin(), rounds.end(), 0.);
    return rounds.size() + (sum < length() * (1. - 1e-9) ? 1 : 0);
  }

  std::string RockBody::group(const unsigned int i) const
  {
    return rounds.empty() ? name : name + "_" + std::to_string(i + 1);
  }

  SpacePoint RockBody::place(const dealii::Point<2> &corner,
                             const double along) const
  {
    const SpaceVector axis = (end - start) / length();
    SpaceVector x;
    x[0] = axis[1];
    x[1] = -axis[0];
    if (x.norm() < 1e-9)
    {
      x    = SpaceVector();
      x[0] = 1.;
    }
    x /= x.norm();
    SpaceVector y = dealii::cross_product_3d(x, axis);
    if (std::abs(y[2]) < 1e-9 && y[1] < 0.)
      y = -y; // of a shaft that goes down y is north, too
    return start + along * axis + corner[0] * x + corner[1] * y;
  }

  std::vector<Polygon> convex_parts(const Polygon &polygon)
  {
    const std::size_t n = polygon.size();
    bool is_convex      = true;
    for (std::size_t i = 0; i < n; ++i)
      is_convex
          = is_convex
            && turn(polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n])
                   >= 0.;
    if (is_convex)
      return { polygon };
    // Ears are cut off one by one: triangles of neighbouring corners that
    // contain no other corner.
    std::vector<Polygon> parts;
    Polygon rest = polygon;
    while (rest.size() > 3)
    {
      const std::size_t m = rest.size();
      std::size_t ear     = m;
      for (std::size_t i = 0; i < m && ear == m; ++i)
      {
        const auto &a = rest[(i + m - 1) % m], &b = rest[i],
                   &c = rest[(i + 1) % m];
        if (turn(a, b, c) <= 0.)
          continue;
        const bool is_free = std::none_of(rest.begin(), rest.end(),
                                          [&](const dealii::Point<2> &p)
                                          {
                                            return p != a && p != b && p != c
                                                   && turn(a, b, p) >= 0.
                                                   && turn(b, c, p) >= 0.
                                                   && turn(c, a, p) >= 0.;
                                          });
        if (is_free)
          ear = i;
      }
      if (ear == m) // only corners on straight lines are left
        break;
      parts.push_back(
          { rest[(ear + m - 1) % m], rest[ear], rest[(ear + 1) % m] });
      rest.erase(rest.begin() + ear);
    }
    if (turn(rest[0], rest[1], rest[2]) > 0.)
      parts.push_back(rest);
    return parts;
  }
} // namespace quoin
