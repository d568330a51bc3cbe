// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_dual_slip_h
#define quoin_joint_laws_dual_slip_h

#include <quoin/joint_laws/dual_number.h>
#include <quoin/joints/joint_point.h>

#include <array>
#include <type_traits>

// What joint_point.h has of slips and shear tractions, with derivatives by
// opening and slip, so that a law reads the same with and without these.

namespace quoin
{
  /** A slip or shear traction in three dimensions. */
  struct DualSlip
  {
    using Number = DualNumber<3>;

    std::array<Number, 2> components;

    const Number &operator[](const unsigned int i) const
    {
      return components[i];
    }
    friend DualSlip operator*(const Number &a, const DualSlip &b)
    {
      return { { { a * b[0], a * b[1] } } };
    }
    friend DualSlip operator/(const DualSlip &a, const Number &b)
    {
      return { { { a[0] / b, a[1] / b } } };
    }
    friend DualSlip operator+(const DualSlip &a, const DualSlip &b)
    {
      return { { { a[0] + b[0], a[1] + b[1] } } };
    }
    friend DualSlip operator-(const DualSlip &a, const DualSlip &b)
    {
      return { { { a[0] - b[0], a[1] - b[1] } } };
    }
    friend Number operator*(const DualSlip &a, const DualSlip &b)
    {
      return a[0] * b[0] + a[1] * b[1];
    }
  };

  /** Slip<dim> of @p Number: double or DualNumber<dim>. */
  template <int dim, typename Number>
  using SlipOf = std::conditional_t<
      std::is_same_v<Number, double>, Slip<dim>,
      std::conditional_t<dim == 2, DualNumber<2>, DualSlip>>;

  /** @p slip, which depends on nothing. */
  template <int dim, typename Number>
  SlipOf<dim, Number> constant_slip(const Slip<dim> &slip)
  {
    if constexpr (dim == 2 || std::is_same_v<Number, double>)
      return slip;
    else
      return { { { slip[0], slip[1] } } };
  }

  /** @p slip as the variables behind the opening. */
  template <int dim>
  SlipOf<dim, DualNumber<dim>> variable_slip(const Slip<dim> &slip)
  {
    if constexpr (dim == 2)
      return { slip, 1 };
    else
      return { { { { slip[0], 1 }, { slip[1], 2 } } } };
  }

  /** Length of @p slip; its derivative, which zero slip does not have, is given
      as zero there. */
  inline DualNumber<2> magnitude(const DualNumber<2> &slip)
  {
    return abs(slip);
  }
  inline DualNumber<3> magnitude(const DualSlip &slip)
  {
    const DualNumber<3> square = slip * slip;
    return square.value > 0. ? sqrt(square) : 0.;
  }

  inline double direction_of(const DualNumber<2> &slip)
  {
    return direction_of(slip.value);
  }
  inline DualSlip direction_of(const DualSlip &slip)
  {
    const DualNumber<3> size = magnitude(slip);
    return size.value > 0. ? slip / size : DualSlip{ { { 1., 0. } } };
  }

  inline DualNumber<2> growth(const double direction,
                              const DualNumber<2> &before,
                              const DualNumber<2> &after)
  {
    const DualNumber<2> size = magnitude(before) + magnitude(after);
    return size.value > 0. ? direction * (before + after) / size : 1.;
  }
  inline DualNumber<3> growth(const DualSlip &direction, const DualSlip &before,
                              const DualSlip &after)
  {
    const DualNumber<3> size = magnitude(before) + magnitude(after);
    return size.value > 0. ? direction * (before + after) / size : 1.;
  }

  /** Distance from the origin of the line through @p place along @p way, which
      is not zero; in two dimensions it passes through. */
  inline double distance_of_line(const double, const double)
  {
    return 0.;
  }
  inline DualNumber<2> distance_of_line(const DualNumber<2> &,
                                        const DualNumber<2> &)
  {
    return 0.;
  }
  template <typename Vector>
  auto distance_of_line(const Vector &place, const Vector &way)
  {
    using std::abs;
    return abs(place[0] * way[1] - place[1] * way[0]) / magnitude(way);
  }

  /** Derivatives of the tractions @p sigma and @p tau [Pa]. */
  inline JointTangent<2> tangent_of(const DualNumber<2> &sigma,
                                    const DualNumber<2> &tau)
  {
    return { sigma.by[0], sigma.by[1], tau.by[0], tau.by[1] };
  }
  inline JointTangent<3> tangent_of(const DualNumber<3> &sigma,
                                    const DualSlip &tau)
  {
    JointTangent<3> tangent;
    tangent.normal_opening = sigma.by[0];
    for (unsigned int d = 0; d < 2; ++d)
    {
      tangent.normal_slip[d]   = sigma.by[1 + d];
      tangent.shear_opening[d] = tau[d].by[0];
      for (unsigned int e = 0; e < 2; ++e)
        tangent.shear_slip[d][e] = tau[d].by[1 + e];
    }
    return tangent;
  }
} // namespace quoin

#endif
