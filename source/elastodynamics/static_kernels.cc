// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/elastodynamics/static_kernels.h>

#include <quoin/base/constants.h>
#include <quoin/elastodynamics/gauss_legendre.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace quoin
{
  namespace
  {
    using Complex = std::complex<double>;

    using constants::pi;

    Complex to_complex(const dealii::Tensor<1, 2> &v)
    {
      return { v[0], v[1] };
    }

    /**
     * ln z, 1/z, conj(z)/z and conj(z)/z^2, or integrals of them. Of the
     * logarithm only the real part is used in the end.
     */
    struct Terms
    {
      Complex logarithm = 0., inverse = 0., ratio = 0., dipole = 0.;

      void add(const double weight, const Terms &terms)
      {
        logarithm += weight * terms.logarithm;
        inverse += weight * terms.inverse;
        ratio += weight * terms.ratio;
        dipole += weight * terms.dipole;
      }
    };

    Terms values(const Complex z)
    {
      return { std::log(z), 1. / z, std::conj(z) / z, std::conj(z) / (z * z) };
    }

    /** ln z with the cut opposite to @p middle. */
    Complex logarithm(const Complex z, const Complex middle)
    {
      return std::log(z / middle) + std::log(middle);
    }

    /** Antiderivatives along the unit vector @p t. */
    Terms once(const Complex z, const Complex middle, const Complex t)
    {
      const Complex c = std::conj(t) / (t * t), bar = std::conj(z);
      const Complex L = logarithm(z, middle), Lz = z * L - z;
      return { Lz / t, L / t, bar * L / t - c * Lz, -bar / (z * t) + c * L };
    }

    /** Along @p t and @p v, one after the other. */
    Terms twice(const Complex z, const Complex middle, const Complex t,
                const Complex v)
    {
      if (z == 0.)
        return Terms();
      const Complex tv  = t * v;
      const double c    = 2. * (t * std::conj(v)).real();
      const Complex bar = std::conj(z);
      const Complex L = logarithm(z, middle), Lz = z * L - z;
      const Complex Lzz = z * z * (0.5 * L - 0.75);
      return { Lzz / tv, Lz / tv, bar * Lz / tv - c * Lzz / (tv * tv),
               -bar * L / tv + c * Lz / (tv * tv) };
    }

    /** Integrals over y on @p f, for @p x that is not on it. */
    Terms integrate(const dealii::Point<2> &x, const BoundaryElement &f)
    {
      const Complex t      = to_complex(f.tangent());
      const Complex middle = to_complex(f.middle() - x);
      Terms sum;
      sum.add(1., once(to_complex(f.b - x), middle, t));
      sum.add(-1., once(to_complex(f.a - x), middle, t));
      return sum;
    }

    /** Integrals over y on @p f, for x in the middle of e or in its mean. */
    Terms integrate(const BoundaryElement &e, const BoundaryElement &f,
                    const Projection projection)
    {
      const Complex t = to_complex(f.tangent()), v = to_complex(e.tangent());
      const Complex middle = to_complex(f.middle() - e.middle());
      const double length  = f.length();
      Terms sum;
      if (projection == Projection::collocation)
        return integrate(e.middle(), f);
      // Far apart the differences lose digits and a Gauss rule does not.
      if (std::abs(middle) > 6. * std::max(length, e.length()))
      {
        const GaussRule &rule = gauss_legendre(8);
        for (unsigned k = 0; k < 8; ++k)
          for (unsigned l = 0; l < 8; ++l)
            sum.add(rule.weights[k] * rule.weights[l] * length,
                    values(middle + (rule.points[k] - 0.5) * length * t
                           - (rule.points[l] - 0.5) * e.length() * v));
        return sum;
      }
      const double mean = 1. / e.length();
      // Common ends must be exactly that.
      const auto difference
          = [&](const dealii::Point<2> &y, const dealii::Point<2> &x)
      {
        const dealii::Tensor<1, 2> d = y - x;
        return d.norm() < 1e-14 * (x.norm() + y.norm()) ? Complex(0.)
                                                        : to_complex(d);
      };
      sum.add(mean, twice(difference(f.b, e.a), middle, t, v));
      sum.add(mean, twice(difference(f.a, e.b), middle, t, v));
      sum.add(-mean, twice(difference(f.b, e.b), middle, t, v));
      sum.add(-mean, twice(difference(f.a, e.a), middle, t, v));
      return sum;
    }

    /** Where e and f are the same: principal values. */
    Terms integrate_self(const BoundaryElement &e, const Projection projection)
    {
      const Complex t     = to_complex(e.tangent());
      const double length = e.length();
      Terms sum;
      sum.logarithm = length
                      * (projection == Projection::galerkin
                             ? std::log(length) - 1.5
                             : std::log(0.5 * length) - 1.);
      sum.ratio = length * std::conj(t) / t;
      return sum;
    }

    /** The real matrix of F -> direct F + conjugate conj(F), transposed. */
    Eigen::Matrix2d transposed_matrix(const Complex direct,
                                      const Complex conjugate)
    {
      Eigen::Matrix2d matrix;
      matrix << (direct + conjugate).real(), (direct + conjugate).imag(),
          (conjugate - direct).imag(), (direct - conjugate).real();
      return matrix;
    }

    /** G and H without free term, of integrals over @p element. */
    std::array<Eigen::Matrix2d, 2> blocks(const ElasticMedium &medium,
                                          const Terms &terms,
                                          const BoundaryElement &element,
                                          const double reference_length)
    {
      const double nu     = medium.poisson();
      const double a      = 1. / (8. * pi * medium.mu() * (1. - nu));
      const double b      = 1. / (4. * pi * (1. - nu));
      const Complex N     = to_complex(element.normal());
      const double length = element.length();
      const double log_sum
          = terms.logarithm.real() - length * std::log(reference_length);
      const Complex inverse    = std::conj(terms.inverse);
      const double normal_part = (N * terms.inverse).real();
      return {
        a
            * transposed_matrix(0.5 * length - (3. - 4. * nu) * log_sum,
                                0.5 * std::conj(terms.ratio)),
        -b
            * transposed_matrix(
                (1. - 2. * nu) * std::conj(N) * inverse + normal_part,
                0.5 * (std::conj(N) * std::conj(terms.dipole) + N * inverse))
      };
    }
  } // namespace

  Eigen::Matrix2d static_displacement_kernel(const ElasticMedium &medium,
                                             const dealii::Point<2> &d,
                                             const double reference_length)
  {
    const double nu = medium.poisson(), r = d.norm();
    return (-(3. - 4. * nu) * std::log(r / reference_length)
                * Eigen::Matrix2d::Identity()
            + dyad(d, d) / (r * r))
           / (8. * pi * medium.mu() * (1. - nu));
  }

  StaticMatrices static_matrices(const Boundary &boundary,
                                 const ElasticMedium &medium,
                                 const Projection projection,
                                 const double reference_length)
  {
    const unsigned n = unsigned(boundary.n_elements());
    StaticMatrices matrices;
    matrices.G.resize(2 * n, 2 * n);
    matrices.H.resize(2 * n, 2 * n);
    for (unsigned e = 0; e < n; ++e)
      for (unsigned f = 0; f < n; ++f)
      {
        const BoundaryElement &first  = boundary.elements[e];
        const BoundaryElement &second = boundary.elements[f];
        const auto [G, H]
            = blocks(medium,
                     e == f ? integrate_self(first, projection)
                            : integrate(first, second, projection),
                     second, reference_length);
        matrices.G.block<2, 2>(2 * e, 2 * f) = G;
        matrices.H.block<2, 2>(2 * e, 2 * f) = H;
        if (e == f)
          matrices.H.block<2, 2>(2 * e, 2 * f)
              += 0.5 * Eigen::Matrix2d::Identity();
      }
    return matrices;
  }

  StaticMatrices static_point_matrices(const Boundary &boundary,
                                       const ElasticMedium &medium,
                                       const dealii::Point<2> &x,
                                       const double reference_length)
  {
    const unsigned n = unsigned(boundary.n_elements());
    StaticMatrices matrices{ Eigen::MatrixXd(2, 2 * n),
                             Eigen::MatrixXd(2, 2 * n) };
    for (unsigned f = 0; f < n; ++f)
    {
      const BoundaryElement &element = boundary.elements[f];
      const auto [G, H]
          = blocks(medium, integrate(x, element), element, reference_length);
      matrices.G.block<2, 2>(0, 2 * f) = G;
      matrices.H.block<2, 2>(0, 2 * f) = H;
    }
    return matrices;
  }
} // namespace quoin
