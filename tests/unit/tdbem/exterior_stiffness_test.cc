// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/base/packed_vectors.h>
#include <quoin/base/eigen_core.h>
#include <quoin/tdbem/exterior_stiffness.h>

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace quoin;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace
{
  const ElasticMedium rock = ElasticMedium::from_young(2500., 10e9, 0.2);

  std::vector<unsigned int> all(const Boundary &boundary)
  {
    std::vector<unsigned int> unknowns(boundary.n_unknowns());
    std::iota(unknowns.begin(), unknowns.end(), 0U);
    return unknowns;
  }

  ExteriorStiffness stiffness(const Boundary &boundary)
  {
    return exterior_stiffness(boundary, rock, Projection::galerkin,
                              all(boundary),
                              std::vector<bool>(boundary.n_unknowns(), false));
  }

  /** Displacement and traction all over a boundary. */
  template <typename Field>
  VectorXd on_boundary(const Boundary &boundary, const Field &field)
  {
    VectorXd values(boundary.n_unknowns());
    for (unsigned int e = 0; e < boundary.n_elements(); ++e)
      set_vector(values, e, dealii::Tensor<1, 2>(field(boundary.elements[e])));
    return values;
  }
} // namespace

TEST(ExteriorStiffness, StoresEnergyButNoneOfATranslation)
{
  const Boundary square = Boundary::polygon(
      { { -2., -1. }, { 2., -1. }, { 2., 1. }, { -2., 1. } }, 0.25, true);
  const ExteriorStiffness exterior = stiffness(square);
  MatrixXd forces                  = exterior.traction;
  for (Eigen::Index k = 0; k < forces.rows(); ++k)
    forces.row(k) *= square.elements[k / 2].length();
  const double largest = forces.cwiseAbs().maxCoeff();
  EXPECT_LT((forces - forces.transpose()).cwiseAbs().maxCoeff(),
            1e-13 * largest);
  EXPECT_LT(exterior.asymmetry, 0.05);

  const VectorXd along = on_boundary(square, [](const BoundaryElement &)
                                     { return dealii::Point<2>(1., 0.5); });
  EXPECT_LT((forces * along).cwiseAbs().maxCoeff(), 1e-10 * largest);
  const VectorXd values
      = Eigen::SelfAdjointEigenSolver<MatrixXd>(forces).eigenvalues();
  EXPECT_GT(values(0), -1e-12 * largest);
  EXPECT_LT(values(1), 1e-10 * largest); // the second translation
  EXPECT_GT(values(2), 1e-3 * largest);  // no rotation
}

TEST(ExteriorStiffness, CircleUnderPressureAndTurned)
{
  const double radius   = 2.;
  const Boundary circle = Boundary::circle({ 1., -3. }, radius, 64, true);
  const MatrixXd K      = stiffness(circle).traction;
  const dealii::Point<2> centre(1., -3.);
  const VectorXd outward
      = on_boundary(circle, [&](const BoundaryElement &element)
                    { return dealii::Point<2>(element.middle() - centre); });
  // u = 1/r around a hole: p = 2 mu u / r on the domain.
  const VectorXd pressure = K * outward;
  EXPECT_LT((pressure - 2. * rock.mu() / radius * outward).norm(),
            3e-3 * pressure.norm());
  const VectorXd turned = on_boundary(circle,
                                      [&](const BoundaryElement &element)
                                      {
                                        const dealii::Tensor<1, 2> r
                                            = element.middle() - centre;
                                        return dealii::Point<2>(-r[1], r[0]);
                                      });
  // u_t = 1/r: a shear strain of -2/r^2.
  const VectorXd torque = K * turned;
  EXPECT_LT((torque - 2. * rock.mu() / radius * turned).norm(),
            3e-3 * torque.norm());
}

TEST(ExteriorStiffness, SquareAroundAHoleUnderShear)
{
  // What a hole of radius 1 adds to pure shear, @cite Kirsch1898.
  const double nu   = rock.poisson();
  const auto motion = [&](const dealii::Point<2> &x)
  {
    const double r = x.norm(), t = std::atan2(x[1], x[0]);
    const double ur
        = (4. * (1. - nu) / r - std::pow(r, -3)) * std::cos(2. * t),
        ut = -(2. * (1. - 2. * nu) / r + std::pow(r, -3)) * std::sin(2. * t);
    return dealii::Point<2>(ur * std::cos(t) - ut * std::sin(t),
                            ur * std::sin(t) + ut * std::cos(t));
  };
  const auto traction = [&](const BoundaryElement &element)
  {
    const dealii::Point<2> x = element.middle();
    const double r = x.norm(), t = std::atan2(x[1], x[0]), q = 1. / (r * r);
    const double rr = (-4. * q + 3. * q * q) * std::cos(2. * t),
                 tt = -3. * q * q * std::cos(2. * t),
                 rt = -(2. * q - 3. * q * q) * std::sin(2. * t);
    Eigen::Matrix2d stress, turn;
    stress << rr, rt, rt, tt;
    turn << std::cos(t), -std::sin(t), std::sin(t), std::cos(t);
    return to_tensor(turn * stress * turn.transpose()
                     * to_eigen(element.normal()));
  };
  const auto error = [&](const double element_length)
  {
    const Boundary square = Boundary::polygon(
        { { -2., -2. }, { 2., -2. }, { 2., 2. }, { -2., 2. } }, element_length,
        true);
    const VectorXd u = on_boundary(
        square,
        [&](const BoundaryElement &e)
        {
          return dealii::Point<2>(
              (motion(e.a) + 4. * motion(e.middle()) + motion(e.b))
              / (12. * rock.mu()));
        });
    const VectorXd exact = on_boundary(square, traction);
    return (stiffness(square).traction * u - exact).norm() / exact.norm();
  };
  const double coarse = error(0.2), fine = error(0.1);
  EXPECT_LT(fine, 0.03);
  EXPECT_LT(fine, 0.8 * coarse);
}

TEST(ExteriorStiffness, BarWithAFixedEnd)
{
  // Of 2 m by 1 m, free sides; stiffness of the mean motion of its end.
  const Boundary bar = Boundary::polygon(
      { { 0., 0. }, { 2., 0. }, { 2., 1. }, { 0., 1. } }, 0.05, false);
  std::vector<unsigned int> end;
  std::vector<bool> free(bar.n_unknowns(), true);
  for (unsigned int e = 0; e < bar.n_elements(); ++e)
  {
    const double x = bar.elements[e].middle()[0];
    for (unsigned int k = 2 * e; k < 2 * e + 2; ++k)
      if (x < 1e-9)
        free[k] = false;
      else if (x > 2. - 1e-9 && k % 2 == 0)
      {
        end.push_back(k);
        free[k] = false;
      }
  }
  const MatrixXd K
      = exterior_stiffness(bar, rock, Projection::galerkin, end, free).traction;
  const double mean
      = (K * VectorXd::Ones(K.cols())).mean() * 2.; // by strain [Pa]
  // Between free and hindered lateral strain at the fixed end.
  const double young = 10e9 / (1. - 0.04);
  EXPECT_GT(mean, young);
  EXPECT_LT(mean, 1.02 * young);
}

TEST(ExteriorStiffness, HalfPlaneAroundASemicircle)
{
  // Surfaces that end: a translation moves what is beyond them, too.
  Boundary ground;
  std::vector<dealii::Point<2>> points;
  for (int i = -20; i <= -5; ++i)
    points.push_back({ 0.2 * i, 0. });
  for (int i = 1; i < 16; ++i)
    points.push_back({ -std::cos(M_PI * i / 16.), -std::sin(M_PI * i / 16.) });
  for (int i = 5; i <= 20; ++i)
    points.push_back({ 0.2 * i, 0. });
  std::reverse(points.begin(), points.end());
  ground.add_curve(points, false);
  std::vector<unsigned int> interface;
  std::vector<bool> free(ground.n_unknowns(), true);
  for (unsigned int k = 0; k < ground.n_unknowns(); ++k)
    if (ground.elements[k / 2].middle()[1] < -1e-9)
    {
      interface.push_back(k);
      free[k] = false;
    }
  const ExteriorStiffness result
      = exterior_stiffness(ground, rock, Projection::galerkin, interface, free);
  const double largest = result.traction.cwiseAbs().maxCoeff();
  VectorXd along(result.traction.cols());
  for (Eigen::Index k = 0; k < along.size(); ++k)
    along(k) = k % 2 == 0 ? 1. : -2.;
  EXPECT_LT((result.traction * along).cwiseAbs().maxCoeff(), 1e-9 * largest);
  EXPECT_LT(result.asymmetry, 0.05);
}

TEST(ExteriorStiffness, ValuesGivenOnTheRestOfTheBoundary)
{
  // A ring, held outside, with a traction or a displacement inside:
  // u = A (r - b^2 / r).
  const double a = 1., b = 2., lambda = rock.lambda(), mu = rock.mu();
  Boundary ring        = Boundary::circle({ 0., 0. }, b, 96, false);
  const Boundary inner = Boundary::circle({ 0., 0. }, a, 64, true);
  std::vector<unsigned int> interface = all(ring);
  ring.elements.insert(ring.elements.end(), inner.elements.begin(),
                       inner.elements.end());
  const VectorXd outward
      = on_boundary(ring, [](const BoundaryElement &element)
                    { return element.middle() / element.middle().norm(); });
  const VectorXd outside = outward.head(Eigen::Index(interface.size()));
  for (const bool is_traction : { true, false })
  {
    std::vector<bool> traction_is_given(ring.n_unknowns(), is_traction);
    std::fill_n(traction_is_given.begin(), interface.size(), false);
    const VectorXd traction
        = exterior_stiffness(ring, rock, Projection::galerkin, interface,
                             traction_is_given)
              .traction_by_given
          * outward;
    const double A = is_traction ? -0.5 / (lambda + mu + mu * b * b / (a * a))
                                 : a / (a * a - b * b);
    const VectorXd exact = 2. * A * (lambda + 2. * mu) * outside;
    EXPECT_LT((traction - exact).norm(), 5e-3 * exact.norm()) << is_traction;
  }
}
