// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_dual_number_h
#define quoin_joint_laws_dual_number_h

#include <cmath>

namespace quoin
{
  /**
   * A number with its derivatives by two variables, so that a law written
   * once for any number type gives its tangent too.
   */
  struct DualNumber
  {
    double value = 0.;
    double by[2]{};

    DualNumber() = default;
    DualNumber(const double constant) : value(constant)
    {
    }
    DualNumber(const double value, const double by_first,
               const double by_second)
      : value(value), by{ by_first, by_second }
    {
    }
  };

  /** f(a), given its value and slope there. */
  inline DualNumber chain(const double value, const double slope,
                          const DualNumber &a)
  {
    return { value, slope * a.by[0], slope * a.by[1] };
  }

  inline DualNumber operator-(const DualNumber &a)
  {
    return { -a.value, -a.by[0], -a.by[1] };
  }
  inline DualNumber operator+(const DualNumber &a, const DualNumber &b)
  {
    return { a.value + b.value, a.by[0] + b.by[0], a.by[1] + b.by[1] };
  }
  inline DualNumber operator-(const DualNumber &a, const DualNumber &b)
  {
    return { a.value - b.value, a.by[0] - b.by[0], a.by[1] - b.by[1] };
  }
  inline DualNumber operator*(const DualNumber &a, const DualNumber &b)
  {
    return { a.value * b.value, a.by[0] * b.value + a.value * b.by[0],
             a.by[1] * b.value + a.value * b.by[1] };
  }
  inline DualNumber operator/(const DualNumber &a, const DualNumber &b)
  {
    const double ratio = a.value / b.value;
    return { ratio, (a.by[0] - ratio * b.by[0]) / b.value,
             (a.by[1] - ratio * b.by[1]) / b.value };
  }
  inline DualNumber operator*(const double a, const DualNumber &b)
  {
    return chain(a * b.value, a, b);
  }
  inline DualNumber operator*(const DualNumber &a, const double b)
  {
    return b * a;
  }
  inline DualNumber operator/(const DualNumber &a, const double b)
  {
    return { a.value / b, a.by[0] / b, a.by[1] / b };
  }
  inline DualNumber &operator+=(DualNumber &a, const DualNumber &b)
  {
    return a = a + b;
  }
  inline DualNumber &operator-=(DualNumber &a, const DualNumber &b)
  {
    return a = a - b;
  }

  inline DualNumber abs(const DualNumber &a)
  {
    return a.value < 0. ? -a : a;
  }
  inline DualNumber exp(const DualNumber &a)
  {
    const double value = std::exp(a.value);
    return chain(value, value, a);
  }
  inline DualNumber log(const DualNumber &a)
  {
    return chain(std::log(a.value), 1. / a.value, a);
  }
  inline DualNumber pow(const DualNumber &a, const double exponent)
  {
    const double value = std::pow(a.value, exponent);
    return chain(value, exponent * value / a.value, a);
  }
  inline DualNumber tan(const DualNumber &a)
  {
    const double value = std::tan(a.value);
    return chain(value, 1. + value * value, a);
  }
  inline DualNumber atan(const DualNumber &a)
  {
    return chain(std::atan(a.value), 1. / (1. + a.value * a.value), a);
  }

  /** Value that decides which branch is taken. */
  inline double value_of(const double a)
  {
    return a;
  }
  inline double value_of(const DualNumber &a)
  {
    return a.value;
  }
} // namespace quoin

#endif
