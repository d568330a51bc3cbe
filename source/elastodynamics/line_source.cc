// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/elastodynamics/line_source.h>

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  using constants::pi;

  LineSource::LineSource(const ElasticMedium &medium,
                         const dealii::Point<2> &position,
                         const std::function<double(double)> &moment,
                         const SignalRange &range)
    : medium(medium), position(position)
  {
    const double n = std::ceil((range.end - range.begin) / range.step);
    if (!(range.step > 0. && n >= 1. && n < 1e8))
      throw InputError("the moment of a line source needs the range of times "
                       "in which it is evaluated, and samples of it.");
    std::vector<double> value{ 0. };
    double peak = 0.;
    for (long k = 0; k <= long(n); ++k)
    {
      value.push_back(moment(range.begin + k * range.step));
      peak = std::max(peak, std::abs(value.back()));
    }
    value.push_back(value.back());
    double slope = 0.;
    for (std::size_t k = 0; k + 1 < value.size(); ++k)
    {
      const double change = (value[k + 1] - value[k]) / range.step - slope;
      // What is less is rounding; the slope is that of the knots so far.
      if (std::abs(change) * range.step > 1e-12 * peak)
      {
        knots.push_back(
            { range.begin + (double(k) - 1.) * range.step, change });
        slope += change;
      }
    }
  }

  dealii::Tensor<1, 2> LineSource::displacement(const dealii::Point<2> &x,
                                                const double t) const
  {
    const dealii::Tensor<1, 2> from = x - position;
    const double r                  = from.norm();
    const double travel             = r / medium.c1;
    double sum                      = 0.;
    for (const Knot &knot : knots)
    {
      const double age = t - knot.time;
      if (age <= travel)
        break;
      sum += knot.change * std::sqrt((age - travel) * (age + travel));
    }
    return sum / (2. * pi * medium.density * medium.c1 * medium.c1 * r * r)
           * from;
  }

  dealii::Tensor<1, 2> LineSource::mean_traction(const dealii::Point<2> &x,
                                                 const dealii::Tensor<1, 2> &n,
                                                 const double t0,
                                                 const double t1) const
  {
    const dealii::Tensor<1, 2> from = x - position;
    const double r                  = from.norm();
    const double travel             = r / medium.c1;
    // Of S and of 1/S, integrated over time. Differences are taken knot by
    // knot, since sums grow with the square of time.
    double of_root = 0., of_inverse = 0.;
    for (const Knot &knot : knots)
    {
      const double age1 = t1 - knot.time;
      if (age1 <= travel)
        break;
      const double age0 = std::max(t0 - knot.time, travel);
      const double s0   = std::sqrt((age0 - travel) * (age0 + travel));
      const double s1   = std::sqrt((age1 - travel) * (age1 + travel));
      const double arc  = std::log((age1 + s1) / (age0 + s0));
      of_inverse += knot.change * arc;
      of_root += knot.change * 0.5
                 * (age1 * s1 - age0 * s0 - travel * travel * arc);
    }
    const double factor
        = 1. / (2. * pi * medium.density * medium.c1 * medium.c1 * (t1 - t0));
    const double hoop   = factor * of_root / (r * r);
    const double volume = -factor * of_inverse / (medium.c1 * medium.c1);
    const double radial = volume - hoop;
    const dealii::Tensor<1, 2> e = from / r;
    const double en              = e * n;
    return medium.lambda() * volume * n
           + 2. * medium.mu() * (radial * en * e + hoop * (n - en * e));
  }
} // namespace quoin
