// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/base/constants.h>
#include <quoin/elastodynamics/cut_kernels.h>
#include <quoin/elastodynamics/gauss_legendre.h>

#include <boost/math/special_functions/bessel.hpp>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Double precision is enough. */
    using Policy = boost::math::policies::policy<
        boost::math::policies::promote_double<false>>;

    /** I_n(x) / x^n, functions of y = x^2 of either sign. */
    struct EntireBessel
    {
      double i0, i1, i2;

      explicit EntireBessel(const double y)
      {
        if (std::abs(y) < 4.)
        {
          // Power series; the quotients of terms are below 1/k^2.
          const double z = 0.25 * y;
          double term    = 1.;
          i0 = i1 = i2 = 0.;
          for (unsigned k = 0; k < 14; ++k)
          {
            i0 += term;
            i1 += 0.5 * term / (k + 1.);
            i2 += 0.25 * term / ((k + 1.) * (k + 2.));
            term *= z / ((k + 1.) * (k + 1.));
          }
          return;
        }
        const double x = std::sqrt(std::abs(y));
        if (y > 0.)
        {
          i0 = boost::math::cyl_bessel_i(0, x, Policy());
          i1 = boost::math::cyl_bessel_i(1, x, Policy()) / x;
        }
        else
        {
          i0 = boost::math::cyl_bessel_j(0, x, Policy());
          i1 = boost::math::cyl_bessel_j(1, x, Policy()) / x;
        }
        i2 = (i0 - 2. * i1) / y;
      }
    };
  } // namespace

  CutKernels::CutKernels(const ElasticMedium &medium, const double lambda,
                         const RayleighDamping &damping)
    : ratio2(medium.c2 * medium.c2 / (medium.c1 * medium.c1)),
      square(lambda * (lambda - damping.mass)
             / ((1. - damping.stiffness * lambda) * medium.c2 * medium.c2)),
      modulus(medium.mu() * (1. - damping.stiffness * lambda)),
      weight(lambda < damping.mass ? 0.5 : 1.)
  {
  }

  CutKernels::Radial CutKernels::radial(const double r) const
  {
    const double y2 = square * r * r, y1 = ratio2 * y2;
    const EntireBessel S(y2), P(y1);
    const double psi = S.i0 - S.i1 + ratio2 * P.i1;
    const double chi = y2 * S.i2 - ratio2 * y1 * P.i2;
    // Derivatives times r; x d/dx I_2 = x^2 (i_1 - 2 i_2).
    const double psi1 = y2 * (S.i1 - S.i2) + ratio2 * y1 * P.i2;
    const double chi1
        = y2 * (S.i1 - 2. * S.i2) - ratio2 * y1 * (P.i1 - 2. * P.i2);

    // The tractions over r^2, which cancels with that of y2 and y1.
    const double u = weight / (2. * constants::pi * modulus);
    const double p = r > 0. ? weight / (2. * constants::pi * r * r) : 0.;
    return { u * psi, -u * chi, p * (psi1 - chi),
             p * (-2. * chi + (1. / ratio2 - 2.) * (psi1 - chi1 - chi)),
             p * (4. * chi - 2. * chi1) };
  }

  void CutKernels::integrate(const Boundary &boundary, const ElementRange &rows,
                             const ElementRange &columns,
                             const Projection projection, Eigen::MatrixXd &G,
                             Eigen::MatrixXd &H) const
  {
    G.resize(2 * rows.size(), 2 * columns.size());
    H.resize(2 * rows.size(), 2 * columns.size());
    const auto rule_for = [&](const BoundaryElement &element) -> const auto &
    {
      const double growth = std::sqrt(std::abs(square)) * element.length();
      return gauss_legendre(std::min(16u, 2 + unsigned(growth)));
    };
    static const GaussRule middle{ { 0.5 }, { 1. } };

    for (unsigned k = 0; k < rows.size(); ++k)
      for (unsigned l = 0; l < columns.size(); ++l)
      {
        const BoundaryElement &e = boundary.elements[rows.begin + k];
        const BoundaryElement &f = boundary.elements[columns.begin + l];
        const GaussRule &outer
            = projection == Projection::galerkin ? rule_for(e) : middle;
        const GaussRule &inner       = rule_for(f);
        const dealii::Tensor<1, 2> n = f.normal();
        Eigen::Matrix2d U = Eigen::Matrix2d::Zero(), P = U;
        for (std::size_t a = 0; a < outer.points.size(); ++a)
          for (std::size_t b = 0; b < inner.points.size(); ++b)
          {
            const dealii::Tensor<1, 2> d = f.a + inner.points[b] * (f.b - f.a)
                                           - e.a
                                           - outer.points[a] * (e.b - e.a);
            const double r       = d.norm();
            const double w       = outer.weights[a] * inner.weights[b];
            const Radial terms   = radial(r);
            const double inverse = r > 0. ? 1. / (r * r) : 0.;
            const Eigen::Matrix2d square_d = dyad(d, d) * inverse;
            const double dn                = d * n;
            U.diagonal().array() += w * terms.u_delta;
            U += w * terms.u_rr * square_d;
            P.diagonal().array() += w * terms.p_sum * dn;
            P += w
                 * (terms.p_sum * dyad(d, n) + terms.p_nr * dyad(n, d)
                    + terms.p_rrn * dn * square_d);
          }
        // Row: direction of the force; column: component on the element.
        G.block<2, 2>(2 * k, 2 * l) = f.length() * U;
        H.block<2, 2>(2 * k, 2 * l) = f.length() * P.transpose();
      }
  }
} // namespace quoin
