// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/layout/wall_layout.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace quoin
{
  namespace
  {
    constexpr double coincident = 1e-9; // of a unit's length

    /** Part of a course without openings and lintels. */
    struct Stretch
    {
      double left;
      double right;
    };

    /** Head joints of every course as the bond alone has them. */
    class Bond
    {
    public:
      explicit Bond(const WallParameters &wall)
        : wall(wall), generator(wall.random_seed)
      {
      }

      /** Positions in (0, length), ascending. @p below: those one below. */
      std::vector<double> joints(const unsigned int course,
                                 const std::vector<double> &below)
      {
        const bool shifted = (course % 2 == 1) != wall.begins_shifted;
        const double L     = wall.unit_length;
        switch (wall.bond)
        {
        case WallBond::running:
          return periodic({ shifted ? wall.offset * L : 0. }, { L });
        case WallBond::stack:
          return periodic({ 0. }, { L });
        case WallBond::header:
          return periodic({ shifted ? 0.25 * L : 0. }, { 0.5 * L });
        case WallBond::english:
          return shifted ? periodic({ 0.5 * L, 0.75 * L }, { 0.5 * L })
                         : periodic({ 0. }, { L });
        case WallBond::flemish:
          return shifted ? periodic({ 0.5 * L, 0.75 * L }, { L, 0.5 * L })
                         : periodic({ 0. }, { L, 0.5 * L });
        case WallBond::random:
          return random(below, course);
        case WallBond::none:
          break;
        }
        return {};
      }

    private:
      /** @p first joints, then after the last of them @p lengths in turn. */
      std::vector<double> periodic(const std::vector<double> &first,
                                   const std::vector<double> &lengths) const
      {
        const double end = wall.length - coincident * wall.unit_length;
        std::vector<double> result;
        double x = 0.;
        for (const double joint : first)
        {
          x = joint;
          if (coincident * wall.unit_length < x && x < end)
            result.push_back(x);
        }
        for (unsigned int i = 0; x < end; ++i)
        {
          x += lengths[i % lengths.size()];
          if (x < end)
            result.push_back(x);
        }
        return result;
      }

      /** Uniform in [0, 1), the same with every library. */
      double uniform()
      {
        return std::ldexp(static_cast<double>(generator() >> 11), -53);
      }

      std::vector<double> random(const std::vector<double> &below,
                                 const unsigned int course)
      {
        const auto overlaps = [&](const double x)
        {
          return std::all_of(
              below.begin(), below.end(),
              [&](const double other)
              { return std::abs(other - x) >= wall.random_overlap; });
        };
        std::vector<double> result;
        double x = 0.;
        while (x + wall.random_longest < wall.length)
        {
          constexpr unsigned int most_trials = 1000;
          double next                        = x;
          for (unsigned int trial = 0; trial < most_trials; ++trial)
          {
            next = x + wall.random_shortest
                   + uniform() * (wall.random_longest - wall.random_shortest);
            if (overlaps(next))
              break;
            next = x;
          }
          if (next == x)
            throw InputError("section 'Wall': 'Random overlap' leaves no place "
                             "for the joint that follows x = "
                             + number_text(x) + " m in course "
                             + std::to_string(course + 1)
                             + ". Lower it, or widen 'Random lengths'.");
          result.push_back(next);
          x = next;
        }
        return result;
      }

      const WallParameters &wall;
      std::mt19937_64 generator;
    };

    /** Openings and lintels of a course as what interrupts the bond. */
    struct Interruption
    {
      Stretch where;
      bool lintel;
    };

    std::vector<Interruption> interruptions(const WallParameters &wall,
                                            const unsigned int course)
    {
      std::vector<Interruption> result;
      for (const WallOpening &opening : wall.openings)
      {
        if (opening.first_course <= course + 1
            && course + 1 <= opening.last_course)
          result.push_back({ { opening.left, opening.right }, false });
        if (wall.lintel_bearing > 0. && course == opening.last_course)
          result.push_back(
              { { std::max(0., opening.left - wall.lintel_bearing),
                  std::min(wall.length, opening.right + wall.lintel_bearing) },
                true });
      }
      std::sort(result.begin(), result.end(),
                [](const Interruption &a, const Interruption &b)
                { return a.where.left < b.where.left; });
      for (std::size_t i = 1; i < result.size(); ++i)
        if (result[i].where.left < result[i - 1].where.right)
          throw InputError("section 'Wall': in course "
                           + std::to_string(course + 1)
                           + " a lintel meets an opening or another lintel. "
                             "Lower 'Lintel bearing' or move the openings.");
      return result;
    }

    /** Appends the units of @p stretch, cut at @p joints. */
    void lay_units(const WallParameters &wall, const Stretch &stretch,
                   const std::vector<double> &joints, const unsigned int row,
                   WallLayout &layout)
    {
      const double exact = coincident * wall.unit_length;
      if (stretch.right - stretch.left <= exact)
        return;
      const double shortest = std::max(
          wall.shortest * wall.unit_length * (1. - coincident), exact);
      double left      = stretch.left;
      const auto place = [&](const double right)
      {
        const bool cracks
            = wall.cracks && right - left > 0.75 * wall.unit_length;
        layout.units.push_back({ WallUnit::unit, row, left, right, cracks });
        left = right;
      };
      for (const double x : joints)
      {
        if (x <= stretch.left + exact || x >= stretch.right - exact)
          continue;
        if (x - stretch.left >= shortest && stretch.right - x >= shortest)
          place(x);
        else
          ++layout.n_joined;
      }
      place(stretch.right);
    }

    void lay_course(const WallParameters &wall, const unsigned int course,
                    const std::vector<double> &joints, const unsigned int row,
                    WallLayout &layout)
    {
      double left = 0.;
      for (const Interruption &gap : interruptions(wall, course))
      {
        lay_units(wall, { left, gap.where.left }, joints, row, layout);
        if (gap.lintel)
          layout.units.push_back({ WallUnit::lintel, row, gap.where.left,
                                   gap.where.right, false });
        left = gap.where.right;
      }
      lay_units(wall, { left, wall.length }, joints, row, layout);
    }
  } // namespace

  WallLayout lay_wall(const WallParameters &wall)
  {
    WallLayout layout;
    layout.length = wall.length;
    const auto add_platen
        = [&](const WallUnit::Kind kind, const double level, const double next)
    {
      layout.units.push_back({ kind,
                               static_cast<unsigned int>(layout.levels.size()),
                               0., wall.length, false });
      layout.levels.push_back(level);
      return next;
    };

    double y = 0.;
    if (wall.bottom_platen > 0.)
      y = add_platen(WallUnit::bottom_platen, -wall.bottom_platen, 0.);
    Bond bond(wall);
    std::vector<double> joints;
    for (unsigned int course = 0; course < wall.n_courses; ++course)
    {
      joints = bond.joints(course, joints);
      lay_course(wall, course, joints, layout.levels.size(), layout);
      layout.levels.push_back(y);
      y = (course + 1) * wall.unit_height;
    }
    if (wall.top_platen > 0.)
      y = add_platen(WallUnit::top_platen, y, y + wall.top_platen);
    layout.levels.push_back(y);
    return layout;
  }

  std::string wall_report(const WallLayout &layout)
  {
    unsigned int n_units = 0, n_lintels = 0, n_cracks = 0;
    for (const WallUnit &unit : layout.units)
    {
      n_units += unit.kind == WallUnit::unit;
      n_lintels += unit.kind == WallUnit::lintel;
      n_cracks += unit.cracks;
    }
    std::string text = "wall of " + std::to_string(n_units) + " units";
    if (n_lintels > 0)
      text += ", " + std::to_string(n_lintels)
              + (n_lintels == 1 ? " lintel" : " lintels");
    if (n_cracks > 0)
      text += ", " + std::to_string(n_cracks) + " potential cracks";
    if (layout.n_joined > 0)
      text += "; " + std::to_string(layout.n_joined)
              + (layout.n_joined == 1 ? " piece was" : " pieces were")
              + " too short and joined to the next unit";
    return text;
  }
} // namespace quoin
