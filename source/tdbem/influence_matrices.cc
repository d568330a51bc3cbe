// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/base/constants.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/elastodynamics/cut_kernels.h>
#include <quoin/tdbem/element_integrals.h>
#include <quoin/tdbem/graded_rule.h>
#include <quoin/tdbem/influence_matrices.h>

#include <algorithm>
#include <cmath>

#include <quoin/elastodynamics/wave_fronts.h>

namespace quoin
{
  namespace
  {
    using Eigen::Matrix2d;

    /** Distance from the source and the fronts, in units of the longer element,
        beyond which quadrature is used for both integrals. */
    constexpr double far_distance = 1.5;
    /** Distance between elements, in the same unit, below which integrals are
        nearly singular at all times. */
    constexpr double near_distance = 1.6;

    bool same(const dealii::Point<2> &a, const dealii::Point<2> &b,
              const double length)
    {
      return (a - b).norm() < 1e-10 * length;
    }
  } // namespace

  InfluenceMatrices::InfluenceMatrices(const Boundary &boundary,
                                       const ElasticMedium &medium,
                                       const double time_step)
    : InfluenceMatrices(boundary, medium, time_step, Options())
  {
  }

  InfluenceMatrices::InfluenceMatrices(const Boundary &boundary,
                                       const ElasticMedium &medium,
                                       const double time_step,
                                       const Options &options)
    : boundary(boundary), medium(medium), dt(time_step), options(options)
  {
    for (const BoundaryElement &e : boundary.elements)
      elements.push_back({ e, e.a, e.b, e.tangent(), e.normal(), e.length() });
  }

  unsigned InfluenceMatrices::size() const
  {
    return 2 * elements.size();
  }

  double InfluenceMatrices::time_step() const
  {
    return dt;
  }

  void InfluenceMatrices::lag(const unsigned n, Eigen::MatrixXd &G,
                              Eigen::MatrixXd &H) const
  {
    const Integrals &present = at_step(n);
    G                        = present.A;
    H                        = present.B;
    if (n > 0)
    {
      const Integrals &last = at_step(n - 1);
      G -= last.A;
      H -= 2. * last.B;
    }
    if (n > 1)
      H += at_step(n - 2).B;
    H /= dt;
    if (n == 0)
      H.diagonal().array() += 0.5;
    if (options.decay != 0.)
    {
      const double factor = std::exp(-options.decay * n * dt);
      G *= factor;
      H *= factor;
    }
  }

  const InfluenceMatrices::Integrals &
  InfluenceMatrices::at_step(const unsigned step) const
  {
    Recent &entry = recent[step % recent.size()];
    if (!entry.integrals || entry.step != step)
      entry = { step,
                std::make_unique<const Integrals>(integrals((step + 1) * dt)) };
    return *entry.integrals;
  }

  InfluenceMatrices::Integrals
  InfluenceMatrices::integrals(const double time) const
  {
    Integrals result{ Eigen::MatrixXd::Zero(size(), size()),
                      Eigen::MatrixXd::Zero(size(), size()) };
    const bool mutual = options.projection == Projection::galerkin;
    for (unsigned e = 0; e < elements.size(); ++e)
      for (unsigned f = 0; f < (mutual ? e + 1 : elements.size()); ++f)
      {
        const PairIntegrals part           = integrate(pair(e, f), time);
        result.A.block<2, 2>(2 * e, 2 * f) = part.A_ef;
        result.B.block<2, 2>(2 * e, 2 * f) = part.B_ef;
        if (!mutual)
          continue;
        result.A.block<2, 2>(2 * f, 2 * e) = part.A_fe;
        result.B.block<2, 2>(2 * f, 2 * e) = part.B_fe;
      }
    return result;
  }

  void InfluenceMatrices::blocks(const ElementRange &rows,
                                 const ElementRange &columns,
                                 const unsigned begin, const unsigned end,
                                 Eigen::MatrixXd &G, Eigen::MatrixXd &H) const
  {
    G.setZero(2 * rows.size(), 2 * columns.size() * (end - begin));
    H.setZero(2 * rows.size(), 2 * columns.size() * (end - begin));
    for (unsigned e = 0; e < rows.size(); ++e)
      for (unsigned f = 0; f < columns.size(); ++f)
      {
        const Pair ef       = pair(rows.begin + e, columns.begin + f);
        Matrix2d A          = Matrix2d::Zero(); // of the step before
        Matrix2d B          = Matrix2d::Zero();
        Matrix2d growth     = Matrix2d::Zero(); // of B, in the step before
        const unsigned from = begin > 2 ? begin - 2 : 0;
        for (unsigned n = from; n < end; ++n)
        {
          const PairIntegrals present = integrate(ef, (n + 1) * dt);
          const Matrix2d change       = present.B_ef - B;
          if (n >= begin)
          {
            const unsigned column = 2 * ((n - begin) * columns.size() + f);
            const double factor   = std::exp(-options.decay * n * dt);
            G.block<2, 2>(2 * e, column) = factor * (present.A_ef - A);
            H.block<2, 2>(2 * e, column) = factor / dt * (change - growth);
          }
          A      = present.A_ef;
          B      = present.B_ef;
          growth = change;
        }
        if (begin == 0 && rows.begin + e == columns.begin + f)
          H.block<2, 2>(2 * e, 2 * f) += 0.5 * Matrix2d::Identity();
      }
  }

  unsigned InfluenceMatrices::first_lag(const ElementRange &,
                                        const ElementRange &,
                                        const double distance) const
  {
    return unsigned(std::min(most_lags, distance / (medium.c1 * dt)));
  }

  unsigned InfluenceMatrices::first_decaying_lag(const double distance,
                                                 const double share) const
  {
    // The displacements' shape in time reaches one step back.
    return unsigned(std::min(
        most_lags, std::ceil((1. + share) * distance / (medium.c2 * dt)) + 1.));
  }

  void InfluenceMatrices::cut_blocks(const ElementRange &rows,
                                     const ElementRange &columns,
                                     const double lambda, Eigen::MatrixXd &G,
                                     Eigen::MatrixXd &H) const
  {
    CutKernels(medium, lambda)
        .integrate(boundary, rows, columns, options.projection, G, H);
  }

  DecayFactors InfluenceMatrices::decay_factors(const double lambda) const
  {
    // Integrals over the step and over the hat function of two steps.
    const double x    = lambda * dt;
    const double half = std::sinh(0.5 * x);
    return { std::exp(-x - options.decay * dt), -std::expm1(-x) / lambda,
             4. * half * half / (x * lambda) };
  }

  TimeKernels InfluenceMatrices::near_integral(const Element &outer,
                                               const Element &inner,
                                               const double time,
                                               const bool close) const
  {
    static const GaussRule graded        = graded_rule(16);
    static const GaussRule strong_graded = strongly_graded_rule(32);
    const GaussRule &rule                = close ? strong_graded : graded;

    std::array<double, 16> cuts;
    unsigned n_cuts    = 0;
    const double ends  = 1e-9 * outer.length;
    const auto add_cut = [&](const double s)
    {
      if (s > ends && s < outer.length - ends)
        cuts[n_cuts++] = s;
    };
    cuts[n_cuts++] = 0.;
    for (const dealii::Point<2> &end : { inner.a, inner.b })
    {
      const double foot   = (end - outer.a) * outer.tangent;
      const double height = (end - outer.a) * outer.normal;
      if (close)
        add_cut(foot);
      for (const double c : { medium.c1, medium.c2 })
        if (c * time > std::abs(height))
        {
          const double half
              = std::sqrt((c * time - height) * (c * time + height));
          add_cut(foot - half);
          add_cut(foot + half);
        }
    }
    // Where the front is tangent to the inner element.
    const double slope  = outer.tangent * inner.normal;
    const double offset = (outer.a - inner.a) * inner.normal;
    if (std::abs(slope) > 1e-12)
      for (const double c : { medium.c1, medium.c2 })
      {
        add_cut((c * time - offset) / slope);
        add_cut((-c * time - offset) / slope);
      }
    std::sort(cuts.begin(), cuts.begin() + n_cuts);

    TimeKernels sum{ Matrix2d::Zero(), Matrix2d::Zero() };
    for (unsigned k = 0; k < n_cuts; ++k)
    {
      const double begin = cuts[k];
      const double end   = k + 1 < n_cuts ? cuts[k + 1] : outer.length;
      const double share = (end - begin) / outer.length;
      if (share < 1e-12)
        continue;
      for (std::size_t i = 0; i < rule.points.size(); ++i)
      {
        const double s          = begin + (end - begin) * rule.points[i];
        const TimeKernels value = element_integrals(
            medium, time, outer.a + s * outer.tangent, inner.shape);
        sum.A += share * rule.weights[i] * value.A;
        sum.B += share * rule.weights[i] * value.B;
      }
    }
    return sum;
  }

  InfluenceMatrices::Pair InfluenceMatrices::pair(const unsigned e,
                                                  const unsigned f) const
  {
    const Element &E = elements[e], &F = elements[f];
    const double length = std::max(E.length, F.length);
    const bool touching = e == f || same(E.a, F.b, length)
                          || same(E.b, F.a, length) || same(E.a, F.a, length)
                          || same(E.b, F.b, length);
    const double nearest
        = touching ? 0.
                   : std::min({ distance_to_segment(E.a, F.a, F.b),
                                distance_to_segment(E.b, F.a, F.b),
                                distance_to_segment(F.a, E.a, E.b),
                                distance_to_segment(F.b, E.a, E.b) });
    const double farthest
        = std::max({ (E.a - F.a).norm(), (E.a - F.b).norm(), (E.b - F.a).norm(),
                     (E.b - F.b).norm() });
    return { E, F, nearest, farthest };
  }

  InfluenceMatrices::PairIntegrals
  InfluenceMatrices::integrate(const Pair &pair, const double time) const
  {
    const Element &E = pair.e, &F = pair.f;
    PairIntegrals result{ Matrix2d::Zero(), Matrix2d::Zero(), Matrix2d::Zero(),
                          Matrix2d::Zero() };
    if (medium.c1 * time <= pair.nearest)
      return result;
    if (options.projection == Projection::collocation)
    {
      const TimeKernels part
          = element_integrals(medium, time, E.shape.middle(), F.shape);
      result.A_ef = part.A.transpose();
      result.B_ef = part.B.transpose();
      return result;
    }
    if (&E == &F)
    {
      // B is odd in the distance along the element and averages to zero.
      result.A_ef = result.A_fe = near_integral(E, E, time, true).A;
      return result;
    }

    // Distance from the singularities at the source and at the fronts. A
    // wave that has not arrived yet does not contribute.
    const double length = std::max(E.length, F.length);
    double smoothness   = pair.nearest;
    for (const double c : { medium.c1, medium.c2 })
      if (c * time > pair.nearest)
        smoothness = std::min(smoothness, c * time - pair.farthest);
    smoothness /= length;
    if (smoothness > far_distance && pair.nearest > near_distance * length)
      return far_integrals(pair, time,
                           smoothness > 16.  ? 2
                           : smoothness > 5. ? 3
                                             : 4);

    const bool close     = pair.nearest < 0.5 * length;
    const TimeKernels ef = near_integral(E, F, time, close);
    const TimeKernels fe = near_integral(F, E, time, close);
    result = { ef.A.transpose(), ef.B.transpose(), fe.A.transpose(),
               fe.B.transpose() };
    if (options.symmetrise)
    {
      const Matrix2d mean
          = 0.5 * (E.length * ef.A + F.length * fe.A.transpose());
      result.A_ef = mean.transpose() / E.length;
      result.A_fe = mean / F.length;
    }
    return result;
  }

  InfluenceMatrices::PairIntegrals
  InfluenceMatrices::far_integrals(const Pair &pair, const double time,
                                   const unsigned n_points) const
  {
    const GaussRule &rule = gauss_legendre(n_points);
    const Element &E = pair.e, &F = pair.f;

    // Sums of the terms of RadialTerms; those of B without the normal, which
    // serve both the normal on F, seen from E, and that on E, seen from F.
    double a_cos = 0., a_sin = 0., b = 0.;
    double yx = 0., yy = 0., zx = 0., zy = 0.;
    double sum_x3 = 0., sum_x2y = 0., sum_xy2 = 0., sum_y3 = 0.;
    for (unsigned k = 0; k < n_points; ++k)
    {
      const dealii::Point<2> source
          = E.a + E.length * rule.points[k] * E.tangent;
      for (unsigned l = 0; l < n_points; ++l)
      {
        const double weight = rule.weights[k] * rule.weights[l];
        const dealii::Tensor<1, 2> distance
            = F.a + F.length * rule.points[l] * F.tangent - source;
        const double r = distance.norm();
        const double x = distance[0] / r, y = distance[1] / r;
        const RadialTerms terms(medium, time, r);
        a_cos += weight * terms.a * (x * x - y * y);
        a_sin += weight * terms.a * 2. * x * y;
        b += weight * terms.b;
        yx += weight * terms.y * x;
        yy += weight * terms.y * y;
        zx += weight * terms.z * x;
        zy += weight * terms.z * y;
        sum_x3 += weight * terms.x * x * x * x;
        sum_x2y += weight * terms.x * x * x * y;
        sum_xy2 += weight * terms.x * x * y * y;
        sum_y3 += weight * terms.x * y * y * y;
      }
    }

    Matrix2d A;
    A << b + a_cos, a_sin, a_sin, b - a_cos;
    A /= 4. * constants::pi * medium.density;
    const auto B = [&](const dealii::Tensor<1, 2> &n) -> Matrix2d
    {
      const dealii::Tensor<1, 2> y({ yx, yy }), z({ zx, zy });
      Matrix2d cubic;
      cubic << sum_x3 * n[0] + sum_x2y * n[1], sum_x2y * n[0] + sum_xy2 * n[1],
          sum_x2y * n[0] + sum_xy2 * n[1], sum_xy2 * n[0] + sum_y3 * n[1];
      return (cubic + (y * n) * Matrix2d::Identity() + dyad(y, n) + dyad(n, z))
             / (4. * constants::pi);
    };
    return { F.length * A, F.length * B(F.normal).transpose(), E.length * A,
             -E.length * B(E.normal).transpose() };
  }
} // namespace quoin
