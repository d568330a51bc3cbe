// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_dual_number_h
#define quoin_joint_laws_dual_number_h

#include <cmath>

namespace quoin
{
  /**
   * A number with its derivatives by @p n variables, so that a law written
   * once for any number type gives its tangent too.
   */
  template <int n>
  struct DualNumber
  {
    double value = 0.;
    double by[n]{};

    DualNumber() = default;
    DualNumber(const double constant) : value(constant)
    {
    }
    /** The variable @p which itself, or what has another @p slope by it. */
    DualNumber(const double value, const int which, const double slope = 1.)
      : value(value)
    {
      by[which] = slope;
    }

    /** f(a), given its value and slope there. */
    friend DualNumber chain(const double value, const double slope,
                            const DualNumber &a)
    {
      DualNumber result = value;
      for (int i = 0; i < n; ++i)
        result.by[i] = slope * a.by[i];
      return result;
    }

    friend DualNumber operator-(const DualNumber &a)
    {
      return chain(-a.value, -1., a);
    }
    friend DualNumber operator+(const DualNumber &a, const DualNumber &b)
    {
      DualNumber result = a.value + b.value;
      for (int i = 0; i < n; ++i)
        result.by[i] = a.by[i] + b.by[i];
      return result;
    }
    friend DualNumber operator-(const DualNumber &a, const DualNumber &b)
    {
      return a + -b;
    }
    friend DualNumber operator*(const DualNumber &a, const DualNumber &b)
    {
      DualNumber result = a.value * b.value;
      for (int i = 0; i < n; ++i)
        result.by[i] = a.by[i] * b.value + a.value * b.by[i];
      return result;
    }
    friend DualNumber operator/(const DualNumber &a, const DualNumber &b)
    {
      DualNumber result = a.value / b.value;
      for (int i = 0; i < n; ++i)
        result.by[i] = (a.by[i] - result.value * b.by[i]) / b.value;
      return result;
    }
    /** Also of infinite numbers, such as the slip of new contacts, which the
        quotient of two would give no derivative. */
    friend DualNumber operator/(const DualNumber &a, const double b)
    {
      return chain(a.value / b, 1. / b, a);
    }
    friend DualNumber &operator+=(DualNumber &a, const DualNumber &b)
    {
      return a = a + b;
    }
    friend DualNumber &operator-=(DualNumber &a, const DualNumber &b)
    {
      return a = a - b;
    }

    friend DualNumber abs(const DualNumber &a)
    {
      return a.value < 0. ? -a : a;
    }
    friend DualNumber sqrt(const DualNumber &a)
    {
      const double value = std::sqrt(a.value);
      return chain(value, 0.5 / value, a);
    }
    friend DualNumber exp(const DualNumber &a)
    {
      const double value = std::exp(a.value);
      return chain(value, value, a);
    }
    friend DualNumber log(const DualNumber &a)
    {
      return chain(std::log(a.value), 1. / a.value, a);
    }
    friend DualNumber pow(const DualNumber &a, const double exponent)
    {
      const double value = std::pow(a.value, exponent);
      return chain(value, exponent * value / a.value, a);
    }
    friend DualNumber tan(const DualNumber &a)
    {
      const double value = std::tan(a.value);
      return chain(value, 1. + value * value, a);
    }
    friend DualNumber atan(const DualNumber &a)
    {
      return chain(std::atan(a.value), 1. / (1. + a.value * a.value), a);
    }
  };

  /** Value that decides which branch is taken. */
  inline double value_of(const double a)
  {
    return a;
  }
  template <int n>
  double value_of(const DualNumber<n> &a)
  {
    return a.value;
  }
} // namespace quoin

#endif
