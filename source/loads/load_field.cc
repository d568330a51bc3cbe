// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/loads/load_field.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Height at @p x of the line through @p points, level beyond its ends. */
    double height_of_line(const std::vector<std::array<double, 2>> &points,
                          const double x)
    {
      if (x <= points.front()[0])
        return points.front()[1];
      for (std::size_t i = 1; i < points.size(); ++i)
        if (x <= points[i][0])
        {
          const auto &[before, low] = points[i - 1];
          const auto &[after, high] = points[i];
          return low + (high - low) * (x - before) / (after - before);
        }
      return points.back()[1];
    }
  } // namespace

  double LoadField::operator()(const dealii::Point<3> &place,
                               const TimePoint &time, const unsigned int up,
                               const double crack) const
  {
    if (is_function_of_place() && water_line.empty())
      return function(place, time);
    const double level
        = water_level      ? (*water_level)(time)
          : uplift_diagram ? uplift_diagram->level(
                uplift_diagram->distance({ place[0], place[1] }), time, crack)
                           : height_of_line(water_line, place[0]);
    const double depth = level - place[up];
    // A depth that is no number must not pass for 0.
    return depth < 0. ? 0. : weight_of_water * depth;
  }

  TimeFunction mixture(const LoadField &field,
                       const std::vector<dealii::Point<3>> &places,
                       const unsigned int up)
  {
    if (field.level())
      return *field.level();
    return TimeFunction(
        [=](const TimePoint &time)
        {
          double sum = 0.;
          for (unsigned int i = 0; i < places.size(); ++i)
            sum += field(places[i], time, up) / (i + 1.);
          return sum;
        });
  }

  std::vector<double> MovingShape::at(const TimePoint &time) const
  {
    std::vector<double> places;
    for (const TimeFunction &centre : centres)
      places.push_back(centre(time));
    return places;
  }

  double MovingShape::factor(const double s,
                             const std::vector<double> &places) const
  {
    double sum = 0.;
    for (const double centre : places)
    {
      const double u = std::abs(s - centre) / width;
      if (u > 0.5)
        continue;
      sum += kind == Kind::uniform      ? 1.
             : kind == Kind::triangular ? 2. - 4. * u
                                        : 1. + std::cos(2. * constants::pi * u);
    }
    return sum;
  }

  void MovingShape::add_kinks(const std::vector<double> &places,
                              std::vector<double> &kinks) const
  {
    for (const double centre : places)
    {
      kinks.insert(kinks.end(), { centre - 0.5 * width, centre + 0.5 * width });
      if (kind != Kind::uniform)
        kinks.push_back(centre);
      if (kind == Kind::cosine)
        kinks.insert(kinks.end(),
                     { centre - 0.25 * width, centre + 0.25 * width });
    }
  }
} // namespace quoin
