// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/tdbem/laplace_matrices.h>

#include <quoin/base/exceptions.h>
#include <quoin/elastodynamics/gauss_legendre.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace quoin
{
  namespace
  {
    using Complex = std::complex<double>;
    using Vector  = dealii::Tensor<1, 2>;
    using Point   = dealii::Point<2>;

    /** Part of an element; a single point if both ends are the same. */
    struct Segment
    {
      Point a, b;

      double length() const
      {
        return (b - a).norm();
      }

      bool is_point() const
      {
        return a == b;
      }

      Segment half(const unsigned which) const
      {
        const Point middle = 0.5 * (a + b);
        return which == 0 ? Segment{ a, middle } : Segment{ middle, b };
      }
    };

    double distance(const Point &x, const Segment &segment)
    {
      return segment.is_point() ? (x - segment.a).norm()
                                : distance_to_segment(x, segment.a, segment.b);
    }

    /** Distance of segments that do not cross [m]. */
    double distance(const Segment &e, const Segment &f)
    {
      return std::min({ distance(e.a, f), distance(e.b, f), distance(f.a, e),
                        distance(f.b, e) });
    }

    /** What the integrals over a pair of elements add up to. */
    struct PairIntegral
    {
      Eigen::Matrix2cd U = Eigen::Matrix2cd::Zero();
      Eigen::Matrix2cd P = Eigen::Matrix2cd::Zero();
      /** Force on the second element, traction on the first. */
      Eigen::Matrix2cd P_reverse = Eigen::Matrix2cd::Zero();
    };

    /** The integrals of U and P over the points x of e and y of f. */
    class PairIntegrator
    {
    public:
      PairIntegrator(const LaplaceKernels &kernels, const Vector &normal_e,
                     const Vector &normal_f, const bool both_ways)
        : kernels_(kernels), wave_number_(std::abs(kernels.k2())),
          normal_e_(normal_e), normal_f_(normal_f), both_ways_(both_ways)
      {
      }

      /** Over two segments that have at most an end in common. */
      void integrate(const Segment &e, const Segment &f)
      {
        if (e.is_point())
          return integrate_apart(e, f, 0);
        for (const bool end_e : { false, true })
          for (const bool end_f : { false, true })
          {
            const Point corner_e = end_e ? e.b : e.a;
            const Point corner_f = end_f ? f.b : f.a;
            // Neighbours may have got their common end from different
            // roundings.
            if ((corner_e - corner_f).norm()
                < 1e-12 * (e.length() + f.length()))
              return integrate_corner(corner_e, end_e ? e.a : e.b,
                                      end_f ? f.a : f.b);
          }
        integrate_apart(e, f, 0);
      }

      const PairIntegral &result() const
      {
        return sum_;
      }

    private:
      const LaplaceKernels &kernels_;
      const double wave_number_;
      const Vector normal_e_, normal_f_;
      const bool both_ways_;
      PairIntegral sum_;

      void add(const Vector &d, const double weight)
      {
        const double r                 = d.norm();
        const LaplaceKernels::Radial f = kernels_.radial(r);
        const Vector n                 = d / r;
        const double xx = n[0] * n[0], xy = n[0] * n[1], yy = n[1] * n[1];
        sum_.U(0, 0) += weight * (f.u_delta + f.u_rr * xx);
        sum_.U(0, 1) += weight * (f.u_rr * xy);
        sum_.U(1, 1) += weight * (f.u_delta + f.u_rr * yy);
        add_traction(f, n, normal_f_, weight, sum_.P);
        if (both_ways_)
          add_traction(f, -n, normal_e_, weight, sum_.P_reverse);
      }

      static void add_traction(const LaplaceKernels::Radial &f, const Vector &r,
                               const Vector &n, const double weight,
                               Eigen::Matrix2cd &sum)
      {
        const double rn = r * n;
        for (unsigned i = 0; i < 2; ++i)
          for (unsigned j = 0; j < 2; ++j)
            sum(i, j)
                += weight
                   * (f.p_sum * ((i == j ? rn : 0.) + r[i] * n[j])
                      + f.p_nr * (n[i] * r[j]) + f.p_rrn * (r[i] * r[j] * rn));
      }

      /**
       * For an error of e^-30, times e^{-k_1 gap} of the integrand itself,
       * over a panel of length @p size at the distance @p gap. Gauss' rule
       * errs by less than the largest value in a Bernstein ellipse times
       * ellipse^{-2n}; the kernels are singular from a certain ellipse on and
       * grow in the others like the exponential function.
       */
      const GaussRule &rule(const double size, const double gap) const
      {
        if (size == 0.)
          return gauss_legendre(1);
        const double ratio    = 2. * gap / size;
        const double singular = ratio + std::sqrt(ratio * ratio + 1.);
        const double digits   = 30. - 0.9 * kernels_.k1().real() * gap;
        double points         = 64.;
        for (double ellipse = std::min(singular, 64.); ellipse > 2.;
             ellipse *= 0.6)
          points = std::min(
              points,
              (digits + 0.25 * wave_number_ * size * (ellipse + 1. / ellipse))
                  / (2. * std::log(ellipse)));
        // Far away nothing is left to integrate.
        return gauss_legendre(unsigned(std::max(2., std::ceil(points))));
      }

      void integrate_apart(const Segment &e, const Segment &f,
                           const unsigned depth)
      {
        const double gap = distance(e, f);
        // Both waves have died out by 1e-16.
        if (kernels_.k1().real() * gap > 36.)
          return;
        const double size_e = e.length(), size_f = f.length();
        const double size = std::max(size_e, size_f);
        if (size > gap || wave_number_ * size > 8.)
        {
          if (depth > 60)
            throw InputError("Boundary elements cross or overlap near ("
                             + std::to_string(f.a[0]) + ", "
                             + std::to_string(f.a[1])
                             + ") m. Boundaries may meet only end to end: move "
                               "one of them.");
          for (const unsigned k : { 0u, 1u })
            if (size_f >= size_e)
              integrate_apart(e, f.half(k), depth + 1);
            else
              integrate_apart(e.half(k), f, depth + 1);
          return;
        }
        const GaussRule &rule_e = rule(size_e, gap);
        const GaussRule &rule_f = rule(size_f, gap);
        const double weight     = (e.is_point() ? 1. : size_e) * size_f;
        for (unsigned k = 0; k < rule_e.points.size(); ++k)
          for (unsigned l = 0; l < rule_f.points.size(); ++l)
            add(f.a + rule_f.points[l] * (f.b - f.a) - e.a
                    - rule_e.points[k] * (e.b - e.a),
                weight * rule_e.weights[k] * rule_f.weights[l]);
      }

      /**
       * Elements from @p corner to @p end_e and @p end_f. On the first parts
       * of both, of the same length h, one of the points is a h from the
       * corner and the other a b h, 0 <= a, b <= 1, whence a factor a that
       * tames 1/r.
       */
      void integrate_corner(const Point &corner, const Point &end_e,
                            const Point &end_f)
      {
        const double size_e  = (end_e - corner).norm();
        const double size_f  = (end_f - corner).norm();
        const double h       = std::min(size_e, size_f);
        const Vector along_e = (h / size_e) * (end_e - corner);
        const Vector along_f = (h / size_f) * (end_f - corner);
        integrate_wedge(along_e, along_f, h, 0., 1., 0);
        // Then what is left of the longer one.
        if (size_f > h * (1. + 1e-12))
          integrate_apart({ corner, end_e }, { corner + along_f, end_f }, 0);
        else if (size_e > h * (1. + 1e-12))
          integrate_apart({ corner + along_e, end_e }, { corner, end_f }, 0);
      }

      /** Adds the integral from b = @p begin to @p end. */
      void integrate_wedge(const Vector &along_e, const Vector &along_f,
                           const double h, const double begin, const double end,
                           const unsigned depth)
      {
        // In the complex plane of b the distance vanishes at exp(+-i angle).
        const double cosine = (along_e * along_f) / (h * h);
        const double nearest
            = std::min(1., std::max(begin, std::min(end, cosine)));
        const double gap = std::sqrt(
            std::max(0., 1. - 2. * nearest * cosine + nearest * nearest));
        if (end - begin > 2. * gap || wave_number_ * h * (end - begin) > 8.)
        {
          if (depth > 40)
            throw InputError("Boundary elements that meet lie on each other. "
                             "Look for a boundary that turns back on itself.");
          const double middle = 0.5 * (begin + end);
          integrate_wedge(along_e, along_f, h, begin, middle, depth + 1);
          integrate_wedge(along_e, along_f, h, middle, end, depth + 1);
          return;
        }
        const GaussRule &rule_b
            = gauss_legendre(16 + unsigned(wave_number_ * h * (end - begin)));
        const GaussRule &rule_a = graded_rule(h);
        for (unsigned k = 0; k < rule_a.points.size(); ++k)
        {
          const double t = rule_a.points[k], t3 = t * t * t;
          const double a = t * t3;
          for (unsigned l = 0; l < rule_b.points.size(); ++l)
          {
            const double b      = begin + (end - begin) * rule_b.points[l];
            const double weight = h * h * (end - begin) * rule_b.weights[l]
                                  * rule_a.weights[k] * 4. * t3 * a;
            add(a * (b * along_f - along_e), weight);
            add(a * (along_f - b * along_e), weight);
          }
        }
      }

      /** Gauss rule for functions of t^4 with a logarithm, over the length @p
       * h. */
      const GaussRule &graded_rule(const double h) const
      {
        return gauss_legendre(
            unsigned(std::min(64., 18. + 2. * wave_number_ * h)));
      }
    };

    /** The integral of U over an element, for its own middle or in the mean. */
    Eigen::Matrix2cd self_integral(const LaplaceKernels &kernels,
                                   const BoundaryElement &element,
                                   const Projection projection)
    {
      const bool galerkin = projection == Projection::galerkin;
      const double length = element.length();
      const double reach  = galerkin ? length : 0.5 * length;
      Complex along = 0., across = 0.;
      // Error n^-16 for r = t^8.
      const GaussRule &rule = gauss_legendre(
          unsigned(std::min(64., 32. + 3. * std::abs(kernels.k2()) * reach)));
      for (unsigned k = 0; k < rule.points.size(); ++k)
      {
        const double t7     = std::pow(rule.points[k], 7);
        const double part   = rule.points[k] * t7;
        const double weight = 2. * reach * rule.weights[k] * 8. * t7
                              * (galerkin ? 1. - part : 1.);
        const LaplaceKernels::Radial f = kernels.radial(reach * part);
        along += weight * (f.u_delta + f.u_rr);
        across += weight * f.u_delta;
      }
      const Vector t = element.tangent(), n = element.normal();
      return along * dyad(t, t) + across * dyad(n, n);
    }
  } // namespace

  LaplaceMatrices laplace_matrices(const Boundary &boundary,
                                   const ElasticMedium &medium,
                                   const std::complex<double> s,
                                   const Projection projection,
                                   const RayleighDamping &damping)
  {
    const LaplaceKernels kernels(medium, s, damping);
    const bool galerkin = projection == Projection::galerkin;
    const unsigned n    = unsigned(boundary.n_elements());
    LaplaceMatrices matrices;
    matrices.G.resize(2 * n, 2 * n);
    matrices.H.resize(2 * n, 2 * n);

    for (unsigned e = 0; e < n; ++e)
    {
      const BoundaryElement &first = boundary.elements[e];
      matrices.G.block<2, 2>(2 * e, 2 * e)
          = self_integral(kernels, first, projection);
      matrices.H.block<2, 2>(2 * e, 2 * e) = 0.5 * Eigen::Matrix2cd::Identity();
      for (unsigned f = galerkin ? e + 1 : 0; f < n; ++f)
      {
        if (f == e)
          continue;
        const BoundaryElement &second = boundary.elements[f];
        PairIntegrator pair(kernels, first.normal(), second.normal(), galerkin);
        const Segment source = galerkin
                                   ? Segment{ first.a, first.b }
                                   : Segment{ first.middle(), first.middle() };
        pair.integrate(source, { second.a, second.b });

        PairIntegral result = pair.result();
        result.U(1, 0)      = result.U(0, 1);
        const double mean   = galerkin ? 1. / first.length() : 1.;
        // The row is the direction of the force, the second index.
        matrices.G.block<2, 2>(2 * e, 2 * f) = mean * result.U;
        matrices.H.block<2, 2>(2 * e, 2 * f) = mean * result.P.transpose();
        if (galerkin)
        {
          const double mean_f                  = 1. / second.length();
          matrices.G.block<2, 2>(2 * f, 2 * e) = mean_f * result.U;
          matrices.H.block<2, 2>(2 * f, 2 * e)
              = mean_f * result.P_reverse.transpose();
        }
      }
    }
    return matrices;
  }
} // namespace quoin
