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

    /** Openings, lintels and other walls as what interrupts the bond. */
    struct Interruption
    {
      Stretch where;
      enum
      {
        opening,
        lintel,
        wall
      } kind;
    };

    bool is_within(const std::vector<Interruption> &interruptions,
                   const double x)
    {
      return std::any_of(interruptions.begin(), interruptions.end(),
                         [&](const Interruption &gap) {
                           return gap.where.left <= x && x <= gap.where.right;
                         });
    }

    /** A course: of its storey, and of the bond, which goes on through storeys
        without a slab between them; both counted from 0. */
    struct Course
    {
      const WallStorey &storey;
      unsigned int number;
      unsigned int of_bond;
    };

    /** Whether @p course of the bond begins with a cut unit or header. */
    bool is_shifted(const WallParameters &wall, const unsigned int course)
    {
      return (course % 2 == 1) != wall.begins_shifted;
    }

    /** Whether all units of @p course are headers. */
    bool is_header_course(const WallParameters &wall, const Course &course)
    {
      return wall.bond == WallBond::header
             || (wall.bond == WallBond::english
                 && is_shifted(wall, course.of_bond))
             || course.storey.header_courses.count(course.number + 1) > 0;
    }

    std::string in_course(const WallStorey &storey, const unsigned int course)
    {
      return "in course " + std::to_string(course + 1)
             + (storey.name.empty() ? "" : " of storey '" + storey.name + "'");
    }

    /** Head joints of every course as the bond alone has them. */
    class Bond
    {
    public:
      Bond(const WallParameters &wall, const double shift)
        : wall(wall), shift(shift), generator(wall.random_seed)
      {
      }

      /** Positions in (0, length), ascending, of @p course. @p below: those one
          below; @p gaps: what interrupts the courses of the bond. */
      std::vector<double>
      joints(const Course &course, const std::vector<double> &below,
             const std::vector<std::vector<Interruption>> &gaps)
      {
        const bool shifted = is_shifted(wall, course.of_bond);
        const double L     = wall.unit_length;
        if (is_header_course(wall, course) && wall.bond != WallBond::header)
          return periodic({ 0.5 * L, 0.75 * L }, { 0.5 * L });
        switch (wall.bond)
        {
        case WallBond::running:
          return periodic(
              { std::fmod((shifted ? wall.offset : 0.) + shift, 1.) * L },
              { L });
        case WallBond::stack:
          return periodic({ shift * L }, { L });
        case WallBond::header:
          return periodic({ shifted ? 0.25 * L : 0. }, { 0.5 * L });
        case WallBond::english:
          return periodic({ 0. }, { L });
        case WallBond::flemish:
          return shifted ? periodic({ 0.5 * L, 0.75 * L }, { L, 0.5 * L })
                         : periodic({ 0. }, { L, 0.5 * L });
        case WallBond::random:
          return random(below, course, gaps);
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

      bool overlaps(const double x, const double other) const
      {
        return std::abs(other - x) >= wall.random_overlap;
      }

      /** Whether a joint at @p x in @p course overlaps with the joints @p below
          and with the ends of what interrupts the courses below and above. */
      bool is_bonded(const double x, const unsigned int course,
                     const std::vector<double> &below,
                     const std::vector<std::vector<Interruption>> &gaps) const
      {
        if (is_within(gaps[course], x))
          return true; // There is no joint.
        const auto is_clear = [&](const Interruption &gap)
        { return overlaps(x, gap.where.left) && overlaps(x, gap.where.right); };
        const auto is_clear_of = [&](const std::vector<Interruption> &others)
        { return std::all_of(others.begin(), others.end(), is_clear); };
        const auto overlaps_with = [&](const double other)
        { return is_within(gaps[course - 1], other) || overlaps(x, other); };
        return std::all_of(below.begin(), below.end(), overlaps_with)
               && (course == 0 || is_clear_of(gaps[course - 1]))
               && (course + 1 == gaps.size() || is_clear_of(gaps[course + 1]));
      }

      std::vector<double>
      random(const std::vector<double> &below, const Course &course,
             const std::vector<std::vector<Interruption>> &gaps)
      {
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
            if (is_bonded(next, course.of_bond, below, gaps))
              break;
            next = x;
          }
          if (next == x)
            throw InputError("section 'Wall': 'Random overlap' leaves no place "
                             "for the joint that follows x = "
                             + number_text(x) + " m "
                             + in_course(course.storey, course.number)
                             + ". Lower it, widen 'Random lengths', or take "
                               "another 'Random seed'.");
          result.push_back(next);
          x = next;
        }
        return result;
      }

      const WallParameters &wall;
      const double shift; /**< of unit_length */
      std::mt19937_64 generator;
    };

    void check_interruptions(const std::vector<Interruption> &all,
                             const WallStorey &storey,
                             const unsigned int course)
    {
      for (std::size_t i = 1; i < all.size(); ++i)
        if (all[i].where.left < all[i - 1].where.right * (1. - coincident))
        {
          const bool at_wall = all[i].kind == Interruption::wall
                               || all[i - 1].kind == Interruption::wall;
          throw InputError(
              "section 'Wall': " + in_course(storey, course) + " a lintel "
              + (at_wall ? "reaches into the wall that ends or crosses there"
                         : "meets an opening or another lintel")
              + ". Lower 'Lintel bearing' or move the openings.");
        }
    }

    std::vector<Interruption> interruptions(const WallParameters &wall,
                                            const WallRun &run,
                                            const Course &of)
    {
      const WallStorey &storey  = of.storey;
      const unsigned int course = of.number;
      std::vector<Interruption> result;
      if (is_shifted(wall, of.of_bond) == run.yields_shifted)
        for (const auto &[left, right] : run.junctions)
          result.push_back({ { left, right }, Interruption::wall });
      for (const WallOpening &opening : storey.openings)
      {
        if (opening.first_course <= course + 1
            && course + 1 <= opening.last_course)
          result.push_back(
              { { opening.left, opening.right }, Interruption::opening });
        if (wall.lintel_bearing > 0. && course >= opening.last_course
            && course < opening.last_course + wall.lintel_courses)
          result.push_back(
              { { std::max(0., opening.left - wall.lintel_bearing),
                  std::min(wall.length, opening.right + wall.lintel_bearing) },
                Interruption::lintel });
      }
      std::sort(result.begin(), result.end(),
                [](const Interruption &a, const Interruption &b)
                { return a.where.left < b.where.left; });
      check_interruptions(result, storey, course);
      return result;
    }

    /** What interrupts the courses from storey @p first up to the next slab. */
    std::vector<std::vector<Interruption>>
    interruptions_of_bond(const WallParameters &wall, const WallRun &run,
                          std::vector<WallStorey>::const_iterator first)
    {
      std::vector<std::vector<Interruption>> result;
      bool goes_on = true;
      for (; goes_on && first != wall.storeys.end(); ++first)
      {
        for (unsigned int number = 0; number < first->n_courses; ++number)
          result.push_back(interruptions(
              wall, run,
              { *first, number, static_cast<unsigned int>(result.size()) }));
        goes_on = first->slab == 0.;
      }
      return result;
    }

    /** An opening up to the slab, platen or top of its storey has no lintel;
        all others have the whole of it. */
    void check_lintels(const WallParameters &wall, const WallStorey &storey)
    {
      for (const WallOpening &opening : storey.openings)
        if (wall.lintel_bearing > 0. && opening.last_course < storey.n_courses
            && opening.last_course + wall.lintel_courses > storey.n_courses)
          throw InputError(
              "section 'Wall': 'Lintel courses = "
              + std::to_string(wall.lintel_courses)
              + "' above the opening that ends "
              + in_course(storey, opening.last_course - 1)
              + " reach beyond the " + std::to_string(storey.n_courses)
              + " courses that are there. Lower 'Lintel courses' or the "
                "opening.");
    }

    /** Appends the units of @p stretch, cut at @p joints: @p headers, or those
        of the bond. */
    void lay_units(const WallParameters &wall, const Stretch &stretch,
                   const std::vector<double> &joints, const bool headers,
                   const std::string &name, const unsigned int row,
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
        const bool through
            = headers
              || (wall.bond == WallBond::flemish
                  && right - left < (0.5 + coincident) * wall.unit_length);
        layout.units.push_back(
            { WallUnit::unit, row, left, right, cracks, name, through });
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

    void lay_course(const WallParameters &wall, const Course &course,
                    const std::vector<Interruption> &gaps,
                    const std::vector<double> &joints, WallLayout &layout)
    {
      const WallStorey &storey = course.storey;
      const unsigned int row   = layout.levels.size();
      const std::string &name  = storey.course_name(course.number + 1);
      const bool headers       = is_header_course(wall, course);
      double left              = 0.;
      for (const Interruption &gap : gaps)
      {
        lay_units(wall, { left, gap.where.left }, joints, headers, name, row,
                  layout);
        if (gap.kind == Interruption::lintel)
          layout.units.push_back({ WallUnit::lintel, row, gap.where.left,
                                   gap.where.right, false, storey.name });
        left = gap.where.right;
      }
      lay_units(wall, { left, wall.length }, joints, headers, name, row,
                layout);
    }

    std::string storey_line(const WallStorey &storey, const double bottom,
                            const double top)
    {
      std::string text = "storey " + storey.name + ": "
                         + std::to_string(storey.n_courses)
                         + " courses, y = " + number_text(bottom) + " to "
                         + number_text(top) + " m";
      if (storey.slab > 0.)
        text += ", slab to " + number_text(top + storey.slab) + " m";
      return text;
    }
  } // namespace

  WallLayout lay_wall(const WallParameters &wall, const WallRun &run)
  {
    WallLayout layout;
    layout.length = wall.length;
    double y      = -wall.bottom_platen;
    // A block over the whole wall.
    const auto add_layer = [&](const WallUnit::Kind kind,
                               const double thickness, const std::string &name)
    {
      if (!(thickness > 0.))
        return;
      layout.units.push_back({ kind,
                               static_cast<unsigned int>(layout.levels.size()),
                               0., wall.length, false, name });
      layout.levels.push_back(y);
      y += thickness;
    };

    add_layer(WallUnit::bottom_platen, wall.bottom_platen, "");
    Bond bond(wall, run.shift);
    y = 0.;
    for (const WallStorey &storey : wall.storeys)
      check_lintels(wall, storey);
    std::vector<std::vector<Interruption>> gaps; // of the courses of the bond
    std::vector<double> joints;                  // of the course below
    unsigned int of_bond = 0;
    for (auto storey_of = wall.storeys.begin(); storey_of != wall.storeys.end();
         ++storey_of)
    {
      const WallStorey &storey = *storey_of;
      const double bottom      = y;
      if (of_bond == 0)
        gaps = interruptions_of_bond(wall, run, storey_of);
      for (unsigned int number = 0; number < storey.n_courses; ++number)
      {
        const Course course{ storey, number, of_bond };
        joints = bond.joints(course, joints, gaps);
        lay_course(wall, course, gaps[of_bond], joints, layout);
        layout.levels.push_back(y);
        y = bottom + (number + 1) * wall.unit_height;
        ++of_bond;
      }
      if (storey.slab > 0.)
      {
        of_bond = 0;
        joints.clear();
      }
      for (const WallOpening &opening : storey.openings)
        layout.n_lintels += wall.lintel_bearing > 0.
                            && opening.last_course < storey.n_courses;
      if (!storey.name.empty())
        layout.storeys.push_back(storey_line(storey, bottom, y));
      add_layer(WallUnit::slab, storey.slab, storey.name);
    }
    add_layer(WallUnit::top_platen, wall.top_platen, "");
    layout.levels.push_back(y);
    return layout;
  }

  std::string wall_report(const WallLayout &layout)
  {
    unsigned int n_units = 0, n_slabs = 0, n_cracks = 0;
    for (const WallUnit &unit : layout.units)
    {
      n_units += unit.kind == WallUnit::unit;
      n_slabs += unit.kind == WallUnit::slab;
      n_cracks += unit.cracks;
    }
    const auto count = [](const unsigned int n, const std::string &what)
    {
      return n == 0
                 ? ""
                 : ", " + std::to_string(n) + " " + what + (n == 1 ? "" : "s");
    };
    std::string text = "wall of " + std::to_string(n_units) + " units"
                       + count(layout.n_lintels, "lintel")
                       + count(n_slabs, "slab")
                       + count(n_cracks, "potential crack");
    if (layout.n_joined > 0)
      text += "; " + std::to_string(layout.n_joined)
              + (layout.n_joined == 1 ? " piece was" : " pieces were")
              + " too short and joined to the next unit";
    for (const std::string &storey : layout.storeys)
      text += "\n" + storey;
    return text;
  }
} // namespace quoin
