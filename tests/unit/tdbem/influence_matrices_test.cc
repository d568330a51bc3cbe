// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_core.h>
#include <quoin/tdbem/element_integrals.h>
#include <quoin/tdbem/influence_matrices.h>
#include <quoin/elastodynamics/static_kernels.h>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include "adaptive_quadrature.h"

using namespace quoin;
using Eigen::Matrix2d;
using Eigen::MatrixXd;

namespace
{
  const ElasticMedium medium = ElasticMedium::from_young(2., 2.5, 0.25);

  /** With elements of different lengths and an acute corner. */
  Boundary wedge(const bool exterior)
  {
    return Boundary::polygon(
        { { 0., 0. }, { 1., 0. }, { 1.2, 0.7 }, { 0.1, 0.25 } }, 0.15,
        exterior);
  }

  InfluenceMatrices::Options options(const Projection projection,
                                     const double decay = 0.)
  {
    InfluenceMatrices::Options result;
    result.projection = projection;
    result.decay      = decay;
    return result;
  }

  double norm(const MatrixXd &matrix)
  {
    return matrix.cwiseAbs().maxCoeff();
  }

  /** Greatest difference of the sums over all elements from @p sum I. */
  double row_sum_error(const MatrixXd &H, const double sum)
  {
    double error = 0.;
    for (unsigned i = 0; i < 2; ++i)
    {
      Eigen::VectorXd motion = Eigen::VectorXd::Zero(H.cols());
      for (Eigen::Index k = i; k < motion.size(); k += 2)
        motion[k] = 1.;
      error
          = std::max(error, (H * motion - sum * motion).cwiseAbs().maxCoeff());
    }
    return error;
  }
} // namespace

/** A rigid motion needs no tractions: inside, H u = 0; outside, H u = u. */
TEST(InfluenceMatrices, rigid_motions_in_the_static_limit)
{
  const double time = 1e7;
  for (const Projection projection :
       { Projection::galerkin, Projection::collocation })
    for (const bool exterior : { false, true })
    {
      const double tolerance
          = projection == Projection::galerkin ? 1e-6 : 1e-12;
      for (const Boundary &boundary :
           { wedge(exterior), Boundary::circle({ 3., 1. }, 2., 24, exterior) })
      {
        const InfluenceMatrices matrices(boundary, medium, 1.,
                                         options(projection));
        MatrixXd H = matrices.integrals(time).B / time;
        H.diagonal().array() += 0.5;
        EXPECT_LT(row_sum_error(H, exterior ? 1. : 0.), tolerance);
      }
    }
}

/** Both matrices against those of statics, which are exact. */
TEST(InfluenceMatrices, static_limit)
{
  const double time     = 1e7;
  const Boundary domain = wedge(false);
  for (const Projection projection :
       { Projection::galerkin, Projection::collocation })
  {
    const double tolerance = projection == Projection::galerkin ? 1e-6 : 1e-12;
    const InfluenceMatrices matrices(domain, medium, 1., options(projection));
    InfluenceMatrices::Integrals integrals = matrices.integrals(time);
    MatrixXd H                             = integrals.B / time;
    H.diagonal().array() += 0.5;
    const StaticMatrices exact = static_matrices(domain, medium, projection);
    EXPECT_LT(norm(H - exact.H), tolerance);

    // But for a uniform displacement that grows with the logarithm of time.
    const double q1     = 1. / (medium.c1 * medium.c1);
    const double q2     = 1. / (medium.c2 * medium.c2);
    const double growth = (q1 * std::log(2. * medium.c1 * time)
                           + q2 * std::log(2. * medium.c2 * time) - q2 + q1)
                          / (4. * M_PI * medium.density);
    const double constant = integrals.A(0, 0) - exact.G(0, 0);
    const double length   = domain.elements[0].length();
    EXPECT_NEAR(constant / length, growth, 0.1 * growth);
    MatrixXd difference = integrals.A - exact.G;
    for (Eigen::Index k = 0; k < difference.rows(); ++k)
      for (Eigen::Index l = k % 2; l < difference.cols(); l += 2)
        difference(k, l) -= constant / length * domain.elements[l / 2].length();
    EXPECT_LT(norm(difference), 1e-6 * norm(exact.G));
  }
}

/** Betti: the work of one element's tractions on another is mutual. */
TEST(InfluenceMatrices, A_is_symmetric)
{
  const Boundary domain               = wedge(true);
  InfluenceMatrices::Options as_it_is = options(Projection::galerkin);
  as_it_is.symmetrise                 = false;
  for (const double time : { 0.03, 0.1, 0.25, 0.6, 1.1, 5., 100. })
  {
    MatrixXd A
        = InfluenceMatrices(domain, medium, 1., as_it_is).integrals(time).A;
    for (unsigned e = 0; e < domain.n_elements(); ++e)
      A.middleRows(2 * e, 2) *= domain.elements[e].length();
    EXPECT_LT(norm(A - A.transpose()), 1e-6 * norm(A)) << time;

    MatrixXd S = InfluenceMatrices(domain, medium, 1.).integrals(time).A;
    for (unsigned e = 0; e < domain.n_elements(); ++e)
      S.middleRows(2 * e, 2) *= domain.elements[e].length();
    EXPECT_LT(norm(S - S.transpose()), 1e-15 * norm(S));
    EXPECT_LT(norm(S - A), 1e-6 * norm(A));
  }
}

/** The outer integral against adaptive quadrature of the inner one. */
TEST(InfluenceMatrices, outer_integrals)
{
  const Boundary domain = wedge(false);
  const InfluenceMatrices matrices(domain, medium, 1.);
  double worst_A = 0., worst_B = 0.;
  for (const double time : { 0.04, 0.2, 0.45, 0.8, 3. })
  {
    const InfluenceMatrices::Integrals integrals = matrices.integrals(time);
    const double scale_A = norm(integrals.A), scale_B = norm(integrals.B);
    for (unsigned e = 0; e < domain.n_elements(); e += 2)
    {
      const BoundaryElement &outer = domain.elements[e];
      for (unsigned f = 0; f < domain.n_elements(); ++f)
      {
        const TimeKernels expected = integrate_adaptively(
            [&](const double s)
            {
              return element_integrals(medium, time,
                                       outer.a + s * (outer.b - outer.a),
                                       domain.elements[f]);
            },
            0., 1., 1e-11, 14);
        const auto error = [&](const MatrixXd &matrix, const Matrix2d &exact)
        { return norm(matrix.block<2, 2>(2 * e, 2 * f) - exact.transpose()); };
        worst_A = std::max(worst_A, error(integrals.A, expected.A) / scale_A);
        // Of an element on itself it is a principal value, zero.
        if (e != f)
          worst_B = std::max(worst_B, error(integrals.B, expected.B) / scale_B);
        else
          EXPECT_EQ(norm(integrals.B.block<2, 2>(2 * e, 2 * e)), 0.);
      }
    }
  }
  EXPECT_LT(worst_A, 1e-6);
  EXPECT_LT(worst_B, 1e-6);
}

/** Elements that the P wave does not reach do not know of each other. */
TEST(InfluenceMatrices, causality)
{
  const unsigned n_elements = 40;
  const Boundary boundary = Boundary::circle({ 0., 0. }, 1., n_elements, true);
  const double dt         = 0.97 * boundary.elements[0].length() / medium.c1;
  const InfluenceMatrices matrices(boundary, medium, dt);
  MatrixXd G, H;
  for (unsigned n = 0; n < 12; ++n)
  {
    matrices.lag(n, G, H);
    for (unsigned e = 0; e < n_elements; ++e)
      for (unsigned f = 0; f < n_elements; ++f)
      {
        const BoundaryElement &E = boundary.elements[e];
        const BoundaryElement &F = boundary.elements[f];
        const double distance
            = std::min({ (E.a - F.a).norm(), (E.a - F.b).norm(),
                         (E.b - F.a).norm(), (E.b - F.b).norm() });
        const bool reached = norm(G.block<2, 2>(2 * e, 2 * f)) > 0.
                             || norm(H.block<2, 2>(2 * e, 2 * f)) > 0.;
        EXPECT_EQ(reached, distance < (n + 1) * dt * medium.c1)
            << e << ' ' << f << ' ' << n;
      }
  }
}

/** In any order, against the differences of integrals. */
TEST(InfluenceMatrices, lags)
{
  const Boundary boundary = Boundary::circle({ 0., 0. }, 1., 8, false);
  const double dt         = 0.5;
  const InfluenceMatrices matrices(boundary, medium, dt);
  const InfluenceMatrices decaying(boundary, medium, dt,
                                   options(Projection::galerkin, 0.3));
  std::vector<InfluenceMatrices::Integrals> at;
  for (unsigned n = 0; n < 8; ++n)
    at.push_back(matrices.integrals((n + 1) * dt));
  MatrixXd G, H, G_decaying, H_decaying;
  for (const unsigned n : { 5, 0, 1, 2, 3, 7, 6, 2 })
  {
    matrices.lag(n, G, H);
    MatrixXd A = at[n].A, B = at[n].B;
    if (n > 0)
    {
      A -= at[n - 1].A;
      B -= 2. * at[n - 1].B;
    }
    else
      B += 0.5 * dt * MatrixXd::Identity(16, 16);
    if (n > 1)
      B += at[n - 2].B;
    EXPECT_LT(norm(G - A), 1e-15);
    EXPECT_LT(norm(H - B / dt), 1e-14);

    decaying.lag(n, G_decaying, H_decaying);
    const double factor = std::exp(-0.3 * n * dt);
    EXPECT_LT(norm(G_decaying - factor * G), 1e-15);
    EXPECT_LT(norm(H_decaying - factor * H), 1e-14);
  }
}

/** Of some elements and lags, against whole lags. */
TEST(InfluenceMatrices, blocks)
{
  const Boundary boundary = Boundary::circle({ 0., 0. }, 1., 8, false);
  const InfluenceMatrices matrices(boundary, medium, 0.5,
                                   options(Projection::galerkin, 0.3));
  const ElementRange rows{ 1, 4 }, columns{ 2, 7 };
  for (const unsigned begin : { 0, 1, 3 })
  {
    const unsigned end = 5;
    MatrixXd G, H, some_G, some_H;
    matrices.blocks(rows, columns, begin, end, some_G, some_H);
    ASSERT_EQ(some_G.cols(), 10 * (end - begin));
    for (unsigned n = begin; n < end; ++n)
    {
      matrices.lag(n, G, H);
      EXPECT_LT(
          norm(some_G.middleCols(10 * (n - begin), 10) - G.block(2, 4, 6, 10)),
          1e-14);
      EXPECT_LT(
          norm(some_H.middleCols(10 * (n - begin), 10) - H.block(2, 4, 6, 10)),
          1e-13);
    }
  }
}

/** On a regular polygon all elements see the same. */
TEST(InfluenceMatrices, regular_polygon)
{
  const unsigned n = 12;
  for (const Projection projection :
       { Projection::galerkin, Projection::collocation })
  {
    const InfluenceMatrices matrices(
        Boundary::circle({ 1., -2. }, 1.5, n, true), medium, 1.,
        options(projection));
    for (const double time : { 0.2, 1.3, 4. })
    {
      const InfluenceMatrices::Integrals integrals = matrices.integrals(time);
      const auto check                             = [&](const MatrixXd &matrix)
      {
        for (unsigned e = 0; e < n; ++e)
          for (unsigned f = 0; f < n; ++f)
          {
            const Matrix2d turn = Eigen::Rotation2D<double>(-2. * M_PI * e / n)
                                      .toRotationMatrix();
            const Matrix2d expected
                = turn * matrix.block<2, 2>(0, 2 * ((f + n - e) % n))
                  * turn.transpose();
            EXPECT_LT(norm(matrix.block<2, 2>(2 * e, 2 * f) - expected),
                      1e-8 * norm(matrix) + 1e-15);
          }
      };
      check(integrals.A);
      check(integrals.B);
    }
  }
}

/** The second differences decay like n^-3 and keep their digits. */
TEST(InfluenceMatrices, late_lags)
{
  const Boundary boundary = Boundary::circle({ 0., 0. }, 1., 16, true);
  const double dt         = boundary.elements[0].length() / medium.c1;
  const InfluenceMatrices matrices(boundary, medium, dt);
  MatrixXd G, H, G2, H2;
  matrices.lag(500, G, H);
  matrices.lag(1000, G2, H2);
  EXPECT_LT(norm(G - 1001.5 / 501.5 * G2), 0.01 * norm(G));
  EXPECT_LT(norm(H - std::pow(1000. / 500., 3) * H2), 0.01 * norm(H));
  matrices.lag(10000, G, H);
  EXPECT_LT(norm(H), 1e-10);
}
