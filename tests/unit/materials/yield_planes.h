// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_materials_yield_planes_h
#define quoin_tests_materials_yield_planes_h

#include <quoin/base/eigen_core.h>
#include <quoin/materials/mohr_coulomb.h>

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <vector>

/**
 * The Mohr-Coulomb domain with tension cut-off by its nine planes in unsorted
 * principal stresses, and by brute force what returns to it must fulfil.
 */
namespace quoin
{
  using Vector3 = Eigen::Vector3d;

  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double degree   = 0.017453292519943295;

  inline std::vector<MohrCoulombStrength> strengths(const bool associated)
  {
    std::vector<MohrCoulombStrength> result;
    for (const double phi : { 0., 20. * degree, 50. * degree })
      for (const double ft : { infinity, 0.5e6, 0. })
        for (const double psi : { 0., 0.4 * phi, phi })
          if (!associated || psi == phi)
          {
            result.push_back({ 2e6, phi, psi, ft });
            if (phi == 0.)
              break;
          }
    return result;
  }

  /** normal . s <= limit, with the flow of the plane. */
  struct Plane
  {
    Vector3 normal;
    Vector3 flow;
    double limit;
  };

  struct Domain
  {
    std::vector<Plane> planes;
    double scale; /**< [Pa] */

    explicit Domain(const MohrCoulombStrength &strength)
    {
      const auto number = [](const double angle)
      { return (1. + std::sin(angle)) / (1. - std::sin(angle)); };
      const double n     = number(strength.friction_angle);
      const double n_psi = number(strength.dilation_angle);
      const double cube  = 2. * strength.cohesion * std::sqrt(n);
      scale              = std::max(cube, 1.);
      for (int i = 0; i < 3; ++i)
      {
        for (int j = 0; j < 3; ++j)
          if (i != j)
          {
            Plane plane{ Vector3::Zero(), Vector3::Zero(), cube };
            plane.normal[i] = n;
            plane.normal[j] = -1.;
            plane.flow[i]   = n_psi;
            plane.flow[j]   = -1.;
            planes.push_back(plane);
          }
        // The apex bears tension by the cut-off through it.
        const double cut
            = std::min(strength.tension, n > 1. ? cube / (n - 1.) : infinity);
        if (cut < infinity)
          planes.push_back({ Vector3::Unit(i), Vector3::Unit(i), cut });
      }
    }

    double excess(const Vector3 &s) const
    {
      double worst = -infinity;
      for (const Plane &plane : planes)
        worst = std::max(worst, plane.normal.dot(s) - plane.limit);
      return worst;
    }
  };

  /** All subsets of at most three planes. */
  template <typename Visit>
  void subsets(const std::size_t n, const Visit &visit)
  {
    for (std::size_t i = 0; i < n; ++i)
    {
      visit(std::vector<std::size_t>{ i });
      for (std::size_t j = i + 1; j < n; ++j)
      {
        visit(std::vector<std::size_t>{ i, j });
        for (std::size_t k = j + 1; k < n; ++k)
          visit(std::vector<std::size_t>{ i, j, k });
      }
    }
  }

  /**
   * The point of the domain next to @p trial in the energy of @p compliance,
   * among the points of the plane stress if @p n is 2.
   */
  inline Vector3 closest(const Domain &domain, const Vector3 &trial,
                         const Eigen::Matrix3d &compliance, const int n)
  {
    Vector3 best                    = Vector3::Zero();
    double least                    = infinity;
    const Eigen::MatrixXd stiffness = compliance.topLeftCorner(n, n).inverse();
    subsets(domain.planes.size(),
            [&](const std::vector<std::size_t> &chosen)
            {
              const int m = chosen.size();
              if (m > n)
                return;
              Eigen::MatrixXd A(m, n);
              Eigen::VectorXd excess(m);
              for (int i = 0; i < m; ++i)
              {
                const Plane &plane = domain.planes[chosen[i]];
                A.row(i)           = plane.normal.head(n).transpose();
                excess[i]          = plane.normal.dot(trial) - plane.limit;
              }
              const Eigen::FullPivLU<Eigen::MatrixXd> lu(A * stiffness
                                                         * A.transpose());
              if (!lu.isInvertible())
                return;
              Vector3 s = trial;
              const Eigen::VectorXd step
                  = stiffness * A.transpose() * lu.solve(excess);
              for (int i = 0; i < n; ++i)
                s[i] -= step[i];
              if (domain.excess(s) > 1e-9 * domain.scale)
                return;
              const Vector3 d     = trial - s;
              const double energy = d.dot(compliance * d);
              if (energy < least)
              {
                least = energy;
                best  = s;
              }
            });
    EXPECT_LT(least, infinity);
    return best;
  }

  /**
   * How far @p flowed is from a sum, with weights that are not negative, of
   * the flows of planes that are active at @p s.
   */
  inline double koiter_distance(const Domain &domain, const Vector3 &s,
                                const Vector3 &flowed)
  {
    std::vector<Vector3> flows;
    for (const Plane &plane : domain.planes)
      if (plane.normal.dot(s) - plane.limit > -1e-7 * domain.scale)
        flows.push_back(plane.flow);
    double best = flowed.norm();
    subsets(flows.size(),
            [&](const std::vector<std::size_t> &chosen)
            {
              Eigen::MatrixXd B(3, chosen.size());
              for (std::size_t i = 0; i < chosen.size(); ++i)
                B.col(i) = flows[chosen[i]];
              const Eigen::VectorXd weights
                  = B.colPivHouseholderQr().solve(flowed);
              if (weights.minCoeff() >= -1e-12 * flowed.norm() - 1e-18)
                best = std::min(best, (B * weights - flowed).norm());
            });
    return best / flowed.norm();
  }

  inline Eigen::Matrix3d compliance(const LinearElastic &rock)
  {
    return ((1. + rock.poisson) * Eigen::Matrix3d::Identity()
            - rock.poisson * Eigen::Matrix3d::Ones())
           / rock.young;
  }
} // namespace quoin

#endif
