// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// MohrCoulomb at finite strain: from elastic stretches to the returns of
// mohr_coulomb.cc and back.

#include <quoin/base/eigen_core.h>
#include <quoin/materials/mohr_coulomb.h>

#include <Eigen/LU>

namespace quoin
{
  namespace
  {
    Eigen::Matrix2d matrix(const double xx, const double yy, const double xy)
    {
      Eigen::Matrix2d result;
      result << xx, xy, xy, yy;
      return result;
    }

    PlaneTensor symmetric_part(const Eigen::Matrix2d &a)
    {
      return { a(0, 0), a(1, 1), 0.5 * (a(0, 1) + a(1, 0)) };
    }

    PlaneTensor in_plane(const std::array<double, 4> &t)
    {
      return { t[0], t[1], t[2] };
    }

    double product(const std::array<double, 4> &a,
                   const std::array<double, 4> &b)
    {
      return a[0] * b[0] + a[1] * b[1] + 2. * a[2] * b[2] + a[3] * b[3];
    }

    double largest(const std::array<double, 3> &a)
    {
      return std::max({ std::abs(a[0]), std::abs(a[1]), std::abs(a[2]) });
    }
  } // namespace

  MohrCoulomb::Principal MohrCoulomb::hooke(const Principal &strain) const
  {
    if (assumption == PlaneAssumption::plane_stress)
      return { stiffness.c11 * strain[0] + stiffness.c12 * strain[1],
               stiffness.c12 * strain[0] + stiffness.c11 * strain[1], 0. };
    const double volume = stiffness.c12 * (strain[0] + strain[1] + strain[2]);
    const double twice  = 2. * stiffness.c33;
    return { volume + twice * strain[0], volume + twice * strain[1],
             volume + twice * strain[2] };
  }

  MohrCoulomb::Principal
  MohrCoulomb::inverse_hooke(const Principal &stress) const
  {
    const double side = poisson * (stress[0] + stress[1] + stress[2]);
    const auto strain
        = [&](const double s) { return ((1. + poisson) * s - side) / young; };
    return { strain(stress[0]), strain(stress[1]), strain(stress[2]) };
  }

  std::array<double, 4>
  MohrCoulomb::compliance(const std::array<double, 4> &s) const
  {
    const Principal direct = inverse_hooke({ s[0], s[1], s[3] });
    return { direct[0], direct[1], (1. + poisson) / young * s[2], direct[2] };
  }

  double MohrCoulomb::stored_energy(const std::array<double, 4> &stress) const
  {
    return 0.5 * product(stress, compliance(stress));
  }

  MohrCoulomb::Principal MohrCoulomb::kirchhoff(const Principal &strain) const
  {
    const Principal s = hooke(strain);
    return { (1. + strain[0]) * s[0], (1. + strain[1]) * s[1],
             (1. + strain[2]) * s[2] };
  }

  MohrCoulomb::Trial
  MohrCoulomb::trial(const PlasticPoint &point, const PlaneTensor &e,
                     const std::array<double, 4> &initial) const
  {
    Trial at;
    at.biot        = trial_stress(point, e, initial);
    const auto &s  = at.biot;
    const double m = 0.5 * (s[0] + s[1]), h = 0.5 * (s[0] - s[1]);
    const double u = 1. + 0.5 * (e[0] + e[1]), d = 0.5 * (e[0] - e[1]);
    // (S + turn J) U, symmetric by the choice of the turn: see piola_stress().
    const double turn  = (h * e[2] - s[2] * d) / u;
    const double mean  = m * u + h * d + s[2] * e[2];
    const double half  = m * d - turn * e[2] + h * u;
    const auto &q      = point.inverse_stretch;
    const double thick = 1. + q[3];
    at.kirchhoff = { mean + half, mean - half, m * e[2] + turn * d + s[2] * u,
                     thick * s[3] };
    at.jacobian  = (u * u - d * d - e[2] * e[2])
                  / ((1. + q[0]) * (1. + q[1]) - q[2] * q[2]);
    if (assumption == PlaneAssumption::plane_stress)
      at.jacobian *= (1. + thinning * (e[0] + e[1])) / thick;
    return at;
  }

  bool MohrCoulomb::yields(const Trial &at) const
  {
    const auto &t  = at.kirchhoff;
    const double J = at.jacobian;
    return J > 0. && !is_elastic({ t[0] / J, t[1] / J, t[2] / J, t[3] / J });
  }

  std::array<double, 4>
  MohrCoulomb::cauchy_stress(const PlasticPoint &point, const PlaneTensor &e,
                             const std::array<double, 4> &initial) const
  {
    const Trial at = trial(point, e, initial);
    std::array<double, 4> result;
    for (unsigned int i = 0; i < 4; ++i)
      result[i] = at.kirchhoff[i] / at.jacobian;
    return result;
  }

  MohrCoulomb::Principal
  MohrCoulomb::strain_of_principal(const Principal &kirchhoff) const
  {
    // The stretches differ from 1 by as little as strength by stiffness: each
    // round gains as many digits.
    Principal strain{};
    for (unsigned int round = 0; round < 100; ++round)
    {
      const Principal before = strain;
      strain                 = inverse_hooke({ kirchhoff[0] / (1. + before[0]),
                                               kirchhoff[1] / (1. + before[1]),
                                               kirchhoff[2] / (1. + before[2]) });
      if (largest({ strain[0] - before[0], strain[1] - before[1],
                    strain[2] - before[2] })
          <= 4e-16 * largest(strain))
        break;
    }
    return strain;
  }

  MohrCoulomb::PrincipalAxes
  MohrCoulomb::strain_of_kirchhoff(const std::array<double, 4> &kirchhoff) const
  {
    PrincipalAxes axes = principal(kirchhoff);
    axes.s             = strain_of_principal(axes.s);
    return axes;
  }

  MohrCoulomb::PrincipalAxes
  MohrCoulomb::elastic_strain(const PlasticPoint &point, const PlaneTensor &e,
                              const std::array<double, 4> &initial,
                              const Trial &at) const
  {
    if (point.state == 0 && initial != no_stress)
      return strain_of_kirchhoff(at.kirchhoff);
    return principal({ e[0], e[1], e[2],
                       assumption == PlaneAssumption::plane_stress
                           ? thinning * (e[0] + e[1])
                           : point.inverse_stretch[3] });
  }

  // The return of small strains, from the stress that Hooke's law gives to all
  // logarithmic strain which has not flowed off, is the first guess. Then the
  // trial stress is what the stretches have now and Hooke's for what has flowed
  // off: the error falls by a factor of the size of the elastic strain. A
  // stiffness above that of the stretched material lets it fall at any.
  MohrCoulomb::Flow MohrCoulomb::find_flow(const Principal &trial_strain,
                                           const double jacobian) const
  {
    const Principal all{ std::log1p(trial_strain[0]),
                         std::log1p(trial_strain[1]),
                         std::log1p(trial_strain[2]) };
    const bool is_free = assumption == PlaneAssumption::plane_stress;
    Flow step{ Region::shear, {}, {}, all, jacobian };
    if (is_free)
      step.flowed[2] = 0.;
    for (unsigned int round = 0; round < 100; ++round)
    {
      const double stretch
          = 1. + std::max({ 0., step.strain[0], step.strain[1] });
      const double stiffer = stretch * stretch;
      const Principal lost = hooke(step.flowed);
      Principal stress;
      for (unsigned int i = 0; i < 3; ++i)
        stress[i] = (step.kirchhoff[i] + stiffer * lost[i]) / step.jacobian;
      // Hooke's law may be elastic where the stretches are not.
      Principal end = stress;
      step.flowed   = {};
      if (!is_elastic({ stress[0], stress[1], 0., stress[2] }))
      {
        step.where  = region(stress);
        end         = returned(step.where, stress, limits);
        step.flowed = plastic_increment(step.where, stress, end);
      }
      for (unsigned int i = 0; i < 3; ++i)
      {
        step.flowed[i] *= step.jacobian / stiffer;
        step.strain[i] = std::expm1(all[i] - step.flowed[i]);
      }
      if (is_free)
      {
        step.strain[2] = thinning * (step.strain[0] + step.strain[1]);
        step.jacobian  = jacobian * std::exp(step.flowed[2])
                        * (1. + step.strain[2]) / (1. + trial_strain[2]);
      }
      step.kirchhoff = kirchhoff(step.strain);
      Principal off;
      for (unsigned int i = 0; i < 3; ++i)
        off[i] = step.kirchhoff[i] - step.jacobian * end[i];
      if (largest(off)
          <= 1e-13 * largest(step.kirchhoff) + 1e-15 * young * largest(all))
        break;
    }
    return step;
  }

  PlasticStep MohrCoulomb::update(PlasticPoint &point, const PlaneTensor &e,
                                  const std::array<double, 4> &initial) const
  {
    const Trial at = trial(point, e, initial);
    if (yields(at))
      return update_yielding(point, e, initial, at);
    point.stress = at.biot;
    point.state  = past(point.state);
    return { in_plane(at.biot), 0. };
  }

  CorotatedStrain
  MohrCoulomb::change_elastic_strain(PlasticPoint &point, const PlaneTensor &e,
                                     const std::array<double, 4> &strain) const
  {
    // F_e = R U (I + Q)^-1 (I + Q') with the stretch U' instead of U.
    const Eigen::Matrix2d change
        = matrix(strain[0] - e[0], strain[1] - e[1], strain[2] - e[2])
          * matrix(1. + e[0], 1. + e[1], e[2]).inverse();
    auto &q = point.inverse_stretch;
    const CorotatedStrain turn(stretched_gradient(
        { change(0, 0), change(0, 1), change(1, 0), change(1, 1) }, q));
    std::copy_n(turn.e.begin(), 3, q.begin());
    return turn;
  }

  double MohrCoulomb::shear_of(const Principal &flowed)
  {
    const double mean = (flowed[0] + flowed[1] + flowed[2]) / 3.;
    double deviator   = 0.;
    for (const double component : flowed)
      deviator += (component - mean) * (component - mean);
    return std::sqrt(0.5 * deviator);
  }

  PlasticStep MohrCoulomb::update_yielding(PlasticPoint &point,
                                           const PlaneTensor &e,
                                           const std::array<double, 4> &initial,
                                           const Trial &at) const
  {
    const PrincipalAxes axes = elastic_strain(point, e, initial, at);
    const Flow step          = find_flow(axes.s, at.jacobian);
    const auto kirchhoff     = axes.tensor(step.kirchhoff);
    const auto stress        = axes.tensor(hooke(step.strain));

    PlasticStep result;
    result.stress
        = symmetric_part(matrix(kirchhoff[0], kirchhoff[1], kirchhoff[2])
                         * matrix(1. + e[0], 1. + e[1], e[2]).inverse());

    // What a cell stores is 1/2 S : C^-1 S less that of its initial stress,
    // also before it yields; its work is done on the strain at constant Q.
    const auto &bears = point.state == 0 ? initial : no_stress;
    std::array<double, 4> elastic, change, sum;
    for (unsigned int i = 0; i < 4; ++i)
    {
      elastic[i] = point.stress[i] - bears[i];
      change[i]  = stress[i] - point.stress[i];
      sum[i]     = stress[i] + point.stress[i];
    }
    const auto before = compliance(elastic);
    double work       = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      work += (i == 2 ? 2. : 1.) * 0.5 * (point.stress[i] + result.stress[i])
              * (e[i] - before[i]);
    result.dissipated = work - 0.5 * product(change, compliance(sum));

    auto &zz = point.inverse_stretch[3];
    if (assumption == PlaneAssumption::plane_stress)
      zz += (1. + zz)
            * std::expm1(std::log1p(axes.s[2]) - step.flowed[2]
                         - std::log1p(thinning * (e[0] + e[1])));
    else
      zz = step.strain[axes.out];
    const auto turned
        = change_elastic_strain(point, e, axes.tensor(step.strain))
              .to_rotating(in_plane(stress));
    std::copy_n(turned.begin(), 3, point.stress.begin());
    point.stress[3] = stress[3];

    point.plastic_shear += shear_of(step.flowed);
    point.state = past(point.state) | yields_now(step.where);
    return result;
  }

  void MohrCoulomb::take_over(PlasticPoint &point, const PlaneTensor &e,
                              const MohrCoulomb &before) const
  {
    const auto wanted        = before.trial(point, e, no_stress).kirchhoff;
    const PrincipalAxes axes = strain_of_kirchhoff(wanted);
    auto &zz                 = point.inverse_stretch[3];
    if (assumption == PlaneAssumption::plane_stress)
      zz += (1. + zz)
            * std::expm1(std::log1p(axes.s[2])
                         - std::log1p(before.thinning * (e[0] + e[1])));
    else
      zz = axes.s[axes.out];
    const auto stress = axes.tensor(hooke(axes.s));
    const auto turned = change_elastic_strain(point, e, axes.tensor(axes.s))
                            .to_rotating(in_plane(stress));
    std::copy_n(turned.begin(), 3, point.stress.begin());
    point.stress[3] = stress[3];
  }

  // With D the derivative of a Kirchhoff stress by logarithmic strains, the
  // return r = M s + J r_0 of a trial stress s and the strains x at its end and
  // y at its begin, d r = D dx = M ((D - C) dx + C dy) + r_0 dJ. In plane
  // stress J depends on the thickness, hence on both.
  MohrCoulomb::FlowRates MohrCoulomb::flow_rates(const Principal &trial_strain,
                                                 const Flow &step) const
  {
    const bool is_free = assumption == PlaneAssumption::plane_stress;
    Eigen::Matrix3d C, M;
    Eigen::Vector3d thins;
    for (unsigned int j = 0; j < 3; ++j)
    {
      Principal unit{};
      unit[j]              = 1.;
      const Principal rise = hooke(unit);
      const Principal end  = returned(step.where, unit, Limits{});
      for (unsigned int i = 0; i < 3; ++i)
      {
        C(i, j) = is_free && j == 2 ? 0. : rise[i];
        M(i, j) = end[i];
      }
      thins[j]
          = is_free ? plane_stress_thinning(step.where, unit[0], unit[1]) : 0.;
    }
    const auto slope = [&](const Principal &strain)
    {
      const Eigen::Vector3d stretch(1. + strain[0], 1. + strain[1],
                                    1. + strain[2]);
      const Principal t = kirchhoff(strain);
      Eigen::Matrix3d D = stretch.asDiagonal() * C * stretch.asDiagonal();
      D += Eigen::Vector3d(t[0], t[1], is_free ? 1. : t[2]).asDiagonal();
      return D;
    };
    // Of the logarithm of the thickness.
    const auto elastic_thins = [&](const Principal &strain) -> Eigen::Vector3d
    {
      return thinning / (1. + strain[2])
             * Eigen::Vector3d(1. + strain[0], 1. + strain[1], 0.);
    };
    const Principal rest = returned(step.where, Principal{}, limits);
    const Eigen::Vector3d by_volume
        = step.jacobian * Eigen::Vector3d(rest[0], rest[1], rest[2]);
    const Eigen::Matrix3d D = slope(step.strain);
    const Eigen::Matrix3d at_end
        = D - M * (D - C)
          - by_volume * (elastic_thins(step.strain) - thins).transpose();
    const Eigen::Matrix3d at_begin
        = M * C + by_volume * (thins - elastic_thins(trial_strain)).transpose();
    const auto solver = at_end.partialPivLu();
    const Eigen::Matrix3d by_trial
        = solver.solve(at_begin * slope(trial_strain).inverse());
    const Eigen::Vector3d by_logarithm = D * solver.solve(by_volume);
    const Eigen::Matrix3d of_stress    = D * by_trial;
    FlowRates rates;
    for (unsigned int i = 0; i < 3; ++i)
    {
      rates.by_volume[i] = by_logarithm[i];
      for (unsigned int j = 0; j < 3; ++j)
        rates.by_trial[i][j] = of_stress(i, j);
    }
    return rates;
  }

  std::array<PlaneTensor, 3>
  MohrCoulomb::tangent(const PlasticPoint &point, const PlaneTensor &e,
                       const std::array<double, 4> &initial) const
  {
    const double c11 = stiffness.c11, c12 = stiffness.c12;
    const Trial at = trial(point, e, initial);
    if (!yields(at))
      return {
        { { c11, c12, 0. }, { c12, c11, 0. }, { 0., 0., stiffness.c33 } }
      };

    const PrincipalAxes axes = elastic_strain(point, e, initial, at);
    const Flow step          = find_flow(axes.s, at.jacobian);
    const FlowRates rates    = flow_rates(axes.s, step);
    const auto through       = [&](const Principal &rise, const double volume)
    {
      Principal result;
      for (unsigned int i = 0; i < 3; ++i)
        result[i]
            = rates.by_trial[i][0] * rise[0] + rates.by_trial[i][1] * rise[1]
              + rates.by_trial[i][2] * rise[2] + rates.by_volume[i] * volume;
      return result;
    };

    // Turning of the principal axes: the shear stress between them keeps the
    // ratio of the principal differences, whose limit is that of the rates.
    const auto &T  = at.kirchhoff;
    const double c = axes.cos2, s = axes.sin2;
    const double radius = 0.5 * (T[0] - T[1]) * c + T[2] * s;
    Principal apart{};
    apart[axes.major]       = 0.5;
    apart[axes.minor]       = -0.5;
    const Principal opposed = through(apart, 0.);
    const double turning
        = std::abs(radius)
                  > 1e-12 * (largest({ T[0], T[1], T[3] }) + limits.strength)
              ? (step.kirchhoff[axes.major] - step.kirchhoff[axes.minor])
                    / (2. * radius)
              : opposed[axes.major] - opposed[axes.minor];

    const Eigen::Matrix2d U       = matrix(1. + e[0], 1. + e[1], e[2]);
    const Eigen::Matrix2d inverse = U.inverse();
    const Eigen::Matrix2d before  = matrix(T[0], T[1], T[2]) * inverse;
    const auto end                = axes.tensor(step.kirchhoff);
    const Eigen::Matrix2d after   = matrix(end[0], end[1], end[2]) * inverse;
    std::array<PlaneTensor, 3> result;
    for (unsigned int j = 0; j < 3; ++j)
    {
      const Eigen::Matrix2d dU = matrix(j == 0, j == 1, j == 2 ? 0.5 : 0.);
      // The trial's Kirchhoff stress stays symmetric by a turn.
      Eigen::Matrix2d dT = matrix(j == 0   ? c11
                                  : j == 1 ? c12
                                           : 0.,
                                  j == 0   ? c12
                                  : j == 1 ? c11
                                           : 0.,
                                  j == 2 ? stiffness.c33 : 0.)
                               * U
                           + before * dU;
      Eigen::Matrix2d quarter;
      quarter << 0., -1., 1., 0.;
      dT += (dT(0, 1) - dT(1, 0)) / U.trace() * quarter * U;
      const double mean = 0.5 * dT.trace(), half = 0.5 * (dT(0, 0) - dT(1, 1));
      const double along = half * c + dT(0, 1) * s;
      const double shear = turning * (dT(0, 1) * c - half * s);
      Principal rise{};
      rise[axes.major] = mean + along;
      rise[axes.minor] = mean - along;
      if (assumption == PlaneAssumption::plane_strain)
        rise[axes.out] = (1. + point.inverse_stretch[3]) * c12 * dU.trace();
      Principal stress = through(
          rise, (dU * inverse).trace()
                    + thinning * dU.trace() / (1. + thinning * (e[0] + e[1])));
      const auto turned         = axes.tensor(stress);
      const Eigen::Matrix2d end = matrix(
          turned[0] - shear * s, turned[1] + shear * s, turned[2] + shear * c);
      const auto column = symmetric_part((end - after * dU) * inverse);
      for (unsigned int i = 0; i < 3; ++i)
        result[i][j] = column[i];
    }
    return result;
  }
} // namespace quoin
