// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/eigen_core.h>
#include <quoin/materials/space_mohr_coulomb.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace quoin
{
  namespace
  {
    Eigen::Matrix3d space_matrix(const SpaceTensor &t)
    {
      Eigen::Matrix3d result;
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
          result(r, c) = t[symmetric_index[r][c]];
      return result;
    }

    SpaceTensor space_tensor(const Eigen::Matrix3d &a)
    {
      return { a(0, 0),
               a(1, 1),
               a(2, 2),
               0.5 * (a(0, 1) + a(1, 0)),
               0.5 * (a(0, 2) + a(2, 0)),
               0.5 * (a(1, 2) + a(2, 1)) };
    }

    double product(const SpaceTensor &a, const SpaceTensor &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
             + 2. * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
    }

    /** det (I + t) */
    double jacobian(const SpaceTensor &t)
    {
      const double x = 1. + t[0], y = 1. + t[1], z = 1. + t[2];
      return x * (y * z - t[5] * t[5]) - t[3] * (t[3] * z - t[5] * t[4])
             + t[4] * (t[3] * t[5] - y * t[4]);
    }

    /** Mean and second and third invariant of the deviator. */
    struct Invariants
    {
      double mean, J2, J3;

      explicit Invariants(const SpaceTensor &t)
        : mean((t[0] + t[1] + t[2]) / 3.)
      {
        const double x = t[0] - mean, y = t[1] - mean, z = t[2] - mean;
        J2 = 0.5 * (x * x + y * y + z * z) + t[3] * t[3] + t[4] * t[4]
             + t[5] * t[5];
        J3 = x * (y * z - t[5] * t[5]) - t[3] * (t[3] * z - t[5] * t[4])
             + t[4] * (t[3] * t[5] - y * t[4]);
      }

      /** Bound of the principal values' distance from the mean. */
      double radius() const
      {
        return std::sqrt(4. / 3. * J2);
      }

      /** Largest and least principal value. */
      std::array<double, 2> extremes() const
      {
        const double r = radius();
        if (!(r > 0.))
          return { { mean, mean } };
        const double cosine = 4. * J3 / (r * r * r);
        const double third
            = std::acos(std::max(-1., std::min(1., cosine))) / 3.;
        return { { mean + r * std::cos(third),
                   mean + r * std::cos(third + 2. / 3. * constants::pi) } };
      }
    };

    /** Principal directions of a symmetric tensor, values falling. */
    struct SpaceAxes
    {
      std::array<double, 3> values;
      Eigen::Matrix3d directions; /**< in its columns */

      explicit SpaceAxes(const SpaceTensor &t)
      {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
            space_matrix(t));
        for (unsigned int i = 0; i < 3; ++i)
        {
          values[i]         = solver.eigenvalues()[2 - i];
          directions.col(i) = solver.eigenvectors().col(2 - i);
        }
      }

      SpaceTensor tensor(const std::array<double, 3> &s) const
      {
        return space_tensor(directions
                            * Eigen::Vector3d(s[0], s[1], s[2]).asDiagonal()
                            * directions.transpose());
      }
    };

    /** Changes the elastic strain of @p point from @p e to @p strain, as
        MohrCoulomb does in the plane. @p stress is that of @p strain. */
    void set_elastic_state(SpacePlasticPoint &point, const SpaceTensor &e,
                           const SpaceTensor &strain, const SpaceTensor &stress)
    {
      const Eigen::Matrix3d U = Eigen::Matrix3d::Identity() + space_matrix(e);
      const Eigen::Matrix3d change
          = (space_matrix(strain) - space_matrix(e)) * U.inverse();
      const Eigen::Matrix3d Q = space_matrix(point.inverse_stretch);
      const Eigen::Matrix3d A = change + Q + change * Q;
      double H[3][3];
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
          H[r][c] = A(r, c);
      const SpaceStrain turn(H);
      point.inverse_stretch = turn.e;
      point.stress          = turn.to_rotating(stress);
    }
  } // namespace

  SpaceTensor SpaceMohrCoulomb::compliance(const SpaceTensor &s) const
  {
    const Principal direct = inverse_hooke({ s[0], s[1], s[2] });
    const double shear     = (1. + poisson) / young;
    return { direct[0],    direct[1],    direct[2],
             shear * s[3], shear * s[4], shear * s[5] };
  }

  double SpaceMohrCoulomb::stored_energy(const SpaceTensor &stress) const
  {
    return 0.5 * product(stress, compliance(stress));
  }

  SpaceTensor SpaceMohrCoulomb::trial_stress(const SpacePlasticPoint &point,
                                             const SpaceTensor &e,
                                             const SpaceTensor &initial) const
  {
    SpaceTensor s       = point.state == 0 ? initial : SpaceTensor{};
    const double volume = stiffness.c12 * (e[0] + e[1] + e[2]);
    for (unsigned int i = 0; i < 6; ++i)
      s[i] += 2. * stiffness.c33 * e[i] + (i < 3 ? volume : 0.);
    return s;
  }

  SpaceMohrCoulomb::SpaceTrial
  SpaceMohrCoulomb::trial(const SpacePlasticPoint &point,
                          const SpaceStrain &strain,
                          const SpaceTensor &initial) const
  {
    SpaceTrial at;
    at.biot = trial_stress(point, strain.e, initial);
    // T U, symmetric by the choice of the skew part of T.
    double T[3][3];
    strain.turning_stress(at.biot, T);
    for (unsigned int r = 0; r < 3; ++r)
      for (unsigned int c = r; c < 3; ++c)
      {
        double &k = at.kirchhoff[symmetric_index[r][c]];
        k         = T[r][c];
        for (unsigned int i = 0; i < 3; ++i)
          k += T[r][i] * strain.e[symmetric_index[i][c]];
      }
    at.jacobian = jacobian(strain.e);
    if (point.state != 0)
      at.jacobian /= jacobian(point.inverse_stretch);
    return at;
  }

  bool SpaceMohrCoulomb::yields(const SpaceTrial &at) const
  {
    const double J = at.jacobian;
    if (!(J > 0.))
      return false;
    const Invariants stress(at.kirchhoff);
    const auto exceeds = [&](const double major, const double minor)
    {
      return n_phi * major - minor > J * limits.strength
             || major > J * limits.tension;
    };
    // Few cells pass the bound, and fewer the cosines.
    const double r = stress.radius();
    if (!exceeds(stress.mean + r, stress.mean - r))
      return false;
    const auto [major, minor] = stress.extremes();
    return exceeds(major, minor);
  }

  YieldFunctions
  SpaceMohrCoulomb::yield_functions(const SpaceTensor &stress) const
  {
    const auto [major, minor] = Invariants(stress).extremes();
    return { shear_function(major, minor), major - limits.tension };
  }

  SpaceTensor SpaceMohrCoulomb::cauchy_stress(const SpacePlasticPoint &point,
                                              const SpaceStrain &strain,
                                              const SpaceTensor &initial) const
  {
    const SpaceTrial at = trial(point, strain, initial);
    SpaceTensor result  = at.kirchhoff;
    for (double &component : result)
      component /= at.jacobian;
    return result;
  }

  SpacePlasticStep SpaceMohrCoulomb::update(SpacePlasticPoint &point,
                                            const SpaceStrain &strain,
                                            const SpaceTensor &initial) const
  {
    const SpaceTrial at = trial(point, strain, initial);
    if (yields(at))
      return update_yielding(point, strain, initial, at);
    point.stress = at.biot;
    point.state  = past(point.state);
    return { at.biot, 0. };
  }

  SpacePlasticStep SpaceMohrCoulomb::update_yielding(SpacePlasticPoint &point,
                                                     const SpaceStrain &strain,
                                                     const SpaceTensor &initial,
                                                     const SpaceTrial &at) const
  {
    const bool has_initial = point.state == 0 && initial != SpaceTensor{};
    SpaceAxes axes(has_initial ? at.kirchhoff : strain.e);
    if (has_initial)
      axes.values = strain_of_principal(axes.values);
    const Flow step = find_flow(axes.values, at.jacobian);

    const SpaceTensor &e        = strain.e;
    const SpaceTensor kirchhoff = axes.tensor(step.kirchhoff);
    const SpaceTensor stress    = axes.tensor(hooke(step.strain));
    const Eigen::Matrix3d U     = Eigen::Matrix3d::Identity() + space_matrix(e);
    SpacePlasticStep result;
    result.stress = space_tensor(space_matrix(kirchhoff) * U.inverse());

    // The work on the strain at constant Q less what is stored, as in the
    // plane.
    const SpaceTensor bears = point.state == 0 ? initial : SpaceTensor{};
    SpaceTensor elastic, change, sum, mean, rise;
    for (unsigned int i = 0; i < 6; ++i)
    {
      elastic[i] = point.stress[i] - bears[i];
      change[i]  = stress[i] - point.stress[i];
      sum[i]     = stress[i] + point.stress[i];
      mean[i]    = 0.5 * (point.stress[i] + result.stress[i]);
    }
    const SpaceTensor before = compliance(elastic);
    for (unsigned int i = 0; i < 6; ++i)
      rise[i] = e[i] - before[i];
    result.dissipated
        = product(mean, rise) - 0.5 * product(change, compliance(sum));

    set_elastic_state(point, e, axes.tensor(step.strain), stress);
    point.plastic_shear += shear_of(step.flowed);
    point.state = past(point.state) | yields_now(step.where);
    return result;
  }

  void SpaceMohrCoulomb::take_over(SpacePlasticPoint &point,
                                   const SpaceStrain &strain,
                                   const SpaceMohrCoulomb &before) const
  {
    SpaceAxes axes(before.trial(point, strain, {}).kirchhoff);
    axes.values = strain_of_principal(axes.values);
    set_elastic_state(point, strain.e, axes.tensor(axes.values),
                      axes.tensor(hooke(axes.values)));
  }
} // namespace quoin
