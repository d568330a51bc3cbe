// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/tdbem/element_integrals.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <quoin/elastodynamics/wave_fronts.h>

namespace quoin
{
  namespace
  {
    /** The antiderivatives at one end, without their common factors. */
    struct EndTerms
    {
      double A_tt, A_nn, A_tn;
      double B_tt, B_nn, B_tn, B_nt;
    };

    struct Angles
    {
      double psi, phi;
    };

    Angles angles(const double c, const double time, const double R,
                  const double d, const double s)
    {
      // With R = 0, beyond the front, both become +-pi/2, unless the front
      // does not reach the line of the element at all.
      if (c * time <= std::abs(d))
        return { 0., 0. };
      const double phi = d == 0. ? 0. : std::atan2(s * time, std::abs(d) * R);
      return { std::atan2(s, c * R), d < 0. ? -phi : phi };
    }

    EndTerms end_terms(const ElasticMedium &medium, const double time,
                       const double d, const double s)
    {
      const double c1 = medium.c1, c2 = medium.c2;
      const double q1 = 1. / (c1 * c1), q2 = 1. / (c2 * c2);
      const double mu = c2 * c2; // over density

      const double q = std::max(s * s + d * d, // exact terms vanish at zero
                                std::numeric_limits<double>::min());
      const double r = std::sqrt(q);
      const WaveFronts w(medium, time, r);
      const double L1 = WaveFronts::arcosh(c1, time, w.R1, r);
      const double L2 = WaveFronts::arcosh(c2, time, w.R2, r);
      const double O1 = w.R1 - time * L1, O2 = w.R2 - time * L2;
      const Angles a1 = angles(c1, time, w.R1, d, s);
      const Angles a2 = angles(c2, time, w.R2, d, s);

      const double sum  = s * (q1 * L1 + q2 * L2);
      const double skew = time * s * w.D1;
      const double even = 2. / 3. * mu * w.D3 * ((d * d - s * s) / q);
      const double odd  = 4. / 3. * mu * w.D3 * (d * s / q);

      EndTerms end;
      end.A_tt = sum - skew + 2. * q2 * (c2 * time * a2.psi - d * a2.phi);
      end.A_nn = sum + skew + 2. * q1 * (c1 * time * a1.psi - d * a1.phi);
      end.A_tn = d * (q1 * L1 - q2 * L2 - time * w.D1);
      end.B_tt = odd - 2. * (time * a2.phi - d * a2.psi / c2);
      end.B_nn = -odd - 2. * (time * a1.phi - d * a1.psi / c1);
      end.B_tn = even - 2. * mu * q1 * O1;
      end.B_nt = even - 2. * (1. - mu * q1) * O1 + 2. * O2;
      return end;
    }
  } // namespace

  TimeKernels local_element_integrals(const ElasticMedium &medium,
                                      const double time, const double d,
                                      const double s1, const double s2)
  {
    const EndTerms e1 = end_terms(medium, time, d, s1);
    const EndTerms e2 = end_terms(medium, time, d, s2);

    const double factor = 1. / (4. * constants::pi);
    const double a      = factor / medium.density;
    const double A_tn   = a * (e2.A_tn - e1.A_tn);

    TimeKernels integrals;
    integrals.A << a * (e2.A_tt - e1.A_tt), A_tn, A_tn, a * (e2.A_nn - e1.A_nn);
    integrals.B << factor * (e2.B_tt - e1.B_tt), factor * (e2.B_tn - e1.B_tn),
        factor * (e2.B_nt - e1.B_nt), factor * (e2.B_nn - e1.B_nn);
    return integrals;
  }

  TimeKernels element_integrals(const ElasticMedium &medium, const double time,
                                const dealii::Point<2> &source,
                                const BoundaryElement &element)
  {
    const dealii::Tensor<1, 2> n   = element.normal();
    const dealii::Tensor<1, 2> t   = element.tangent();
    const dealii::Tensor<1, 2> arm = element.a - source;
    const double s1                = arm * t;
    const double length            = element.length();

    // A source on the element's line to within rounding is on it.
    double d = arm * n;
    if (std::abs(d) < 8. * std::numeric_limits<double>::epsilon()
                          * (length + arm.norm() + source.norm()))
      d = 0.;

    TimeKernels result
        = local_element_integrals(medium, time, d, s1, s1 + length);
    Eigen::Matrix2d frame;
    frame << t[0], n[0], t[1], n[1];
    result.A = frame * result.A * frame.transpose();
    result.B = frame * result.B * frame.transpose();
    return result;
  }
} // namespace quoin
