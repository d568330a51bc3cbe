// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/materials/mohr_coulomb.h>

namespace quoin
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** N of an angle [rad]. */
    double flow_number(const double angle)
    {
      return (1. + std::sin(angle)) / (1. - std::sin(angle));
    }
  } // namespace

  MohrCoulomb::MohrCoulomb(const LinearElastic &material,
                           const MohrCoulombStrength &strength,
                           const PlaneAssumption plane_assumption)
    : assumption(plane_assumption),
      stiffness(plane_stiffness(material, assumption)), young(material.young),
      poisson(material.poisson),
      thinning(assumption == PlaneAssumption::plane_stress
                   ? -poisson / (1. - poisson)
                   : 0.),
      n_phi(flow_number(strength.friction_angle)),
      n_psi(flow_number(strength.dilation_angle))
  {
    const double cube = 2. * strength.cohesion * std::sqrt(n_phi);
    const double apex = n_phi > 1. ? cube / (n_phi - 1.) : infinity;
    const double cut  = std::min(strength.tension, apex);
    limits            = { cube, cut, std::min(cut, cube / n_phi),
                          std::min(cut, n_phi * cut - cube) };

    const double c11 = stiffness.c11, c12 = stiffness.c12;
    const double shear = stiffness.c33;
    if (assumption == PlaneAssumption::plane_stress)
    {
      flow          = { c11 * n_psi - c12, c12 * n_psi - c11, 0. };
      plane_modulus = n_phi * flow[0] - flow[1];
      major_modulus = minor_modulus = 0.;
      return;
    }
    const double volume = c12 * (n_psi - 1.);
    const double nn     = n_phi * n_psi;
    flow = { volume + 2. * shear * n_psi, volume, volume - 2. * shear };
    plane_modulus     = n_phi * flow[0] - flow[2];
    const double both = 2. * volume * (n_phi - 1.);
    major_modulus     = both + 2. * shear * (nn + 2.);
    minor_modulus     = both + 2. * shear * (2. * nn + 1.);
  }

  MohrCoulomb::PrincipalAxes
  MohrCoulomb::principal(const std::array<double, 4> &tensor) const
  {
    const double mean = 0.5 * (tensor[0] + tensor[1]);
    const double half = 0.5 * (tensor[0] - tensor[1]);
    PrincipalAxes p;
    p.radius        = std::sqrt(half * half + tensor[2] * tensor[2]);
    p.cos2          = p.radius > 0. ? half / p.radius : 1.;
    p.sin2          = p.radius > 0. ? tensor[2] / p.radius : 0.;
    const double zz = tensor[3];

    p.major = 0;
    p.minor = 1;
    p.out   = 2;
    if (assumption == PlaneAssumption::plane_strain)
    {
      if (zz > mean + p.radius)
        p.out = 0;
      else if (zz > mean - p.radius)
        p.out = 1;
      p.major = p.out == 0 ? 1 : 0;
      p.minor = p.out == 2 ? 1 : 2;
    }
    p.s[p.major] = mean + p.radius;
    p.s[p.minor] = mean - p.radius;
    p.s[p.out]   = zz;
    return p;
  }

  // Which yield planes act is settled by signs. The stress that satisfies all
  // conditions is unique, and a return to the tension planes never violates
  // the shear plane if the trial stress did not. So: if the tension planes
  // alone do, that is it; else, if the shear planes alone do; else both act.
  MohrCoulomb::Region
  MohrCoulomb::region_plane_strain(const Principal &trial) const
  {
    const auto to = [&](const Region r)
    { return returned_plane_strain(r, trial, limits); };

    if (trial[0] > limits.tension)
    {
      Region cut  = Region::tension;
      Principal s = to(cut);
      if (s[1] > limits.tension)
      {
        cut = Region::tension_two;
        s   = to(cut);
        if (s[2] > limits.tension)
          cut = Region::tension_three;
      }
      if (cut == Region::tension_three || shear_function(s[0], s[2]) <= 0.)
        return cut;
    }

    Region shear = Region::shear;
    Principal s  = to(shear);
    if (s[0] < s[1])
      shear = Region::shear_major;
    else if (s[1] < s[2])
      shear = Region::shear_minor;
    if (to(shear)[0] <= limits.tension)
      return shear;

    const double middle = to(Region::shear_tension)[1];
    if (middle > limits.tension)
      return Region::vertex_major;
    return middle < limits.minor ? Region::vertex_minor : Region::shear_tension;
  }

  MohrCoulomb::Principal MohrCoulomb::returned_plane_strain(
      const Region region, const Principal &trial, const Limits &to) const
  {
    const auto [s1, s2, s3] = trial;
    switch (region)
    {
    case Region::shear:
    {
      const double rate  = (n_phi * s1 - s3 - to.strength) / plane_modulus;
      const double major = s1 - rate * flow[0];
      return { major, s2 - rate * flow[1], n_phi * major - to.strength };
    }
    case Region::shear_major:
    {
      const double rate
          = (n_phi * (s1 + s2) - 2. * (s3 + to.strength)) / major_modulus;
      const double minor = s3 - rate * flow[2];
      const double major = (minor + to.strength) / n_phi;
      return { major, major, minor };
    }
    case Region::shear_minor:
    {
      const double rate
          = (2. * (n_phi * s1 - to.strength) - s2 - s3) / minor_modulus;
      const double major = s1 - rate * flow[0];
      const double minor = n_phi * major - to.strength;
      return { major, minor, minor };
    }
    case Region::tension:
    {
      const double side = poisson / (1. - poisson) * (s1 - to.tension);
      return { to.tension, s2 - side, s3 - side };
    }
    case Region::tension_two:
      return { to.tension, to.tension,
               s3 - poisson * (s1 + s2 - 2. * to.tension) };
    case Region::shear_tension:
      return { to.tension, s2 - poisson * (s1 - to.tension + s3 - to.minor),
               to.minor };
    case Region::vertex_major:
      return { to.tension, to.tension, to.minor };
    case Region::vertex_minor:
      return { to.tension, to.minor, to.minor };
    default: // tension_three
      return { to.tension, to.tension, to.tension };
    }
  }

  // The return in plane stress, where the third principal stress is zero: the
  // elastic domain of the two others is a polygon. Yielding with the free
  // direction limits the major one from above ('tension', too) and the minor
  // one from below ('squeeze'). The latter may violate a shear plane that the
  // trial stress did not, if nu > 1 / N_phi; the shear return then ends beyond
  // the vertex, too.
  MohrCoulomb::Region
  MohrCoulomb::region_plane_stress(const Principal &trial) const
  {
    const auto to = [&](const Region r)
    { return returned_plane_stress(r, trial, limits); };

    if (trial[0] > limits.in_plane)
    {
      const Principal s = to(Region::tension);
      if (s[1] > limits.in_plane)
        return Region::tension_two;
      if (shear_function(s[0], s[1]) <= 0.)
        return Region::tension;
    }
    if (trial[1] < -limits.strength)
    {
      const Principal s = to(Region::squeeze);
      if (s[0] < -limits.strength)
        return Region::squeeze_two;
      if (shear_function(s[0], s[1]) <= 0.)
        return Region::squeeze;
    }
    const Principal s = to(Region::shear);
    if (s[0] > limits.in_plane)
      return Region::shear_tension;
    return s[1] < -limits.strength ? Region::shear_squeeze : Region::shear;
  }

  MohrCoulomb::Principal MohrCoulomb::returned_plane_stress(
      const Region region, const Principal &trial, const Limits &to) const
  {
    const double a = trial[0], b = trial[1];
    switch (region)
    {
    case Region::shear:
    {
      const double rate  = (n_phi * a - b - to.strength) / plane_modulus;
      const double major = a - rate * flow[0];
      return { major, n_phi * major - to.strength, 0. };
    }
    case Region::tension:
      return { to.in_plane, b - poisson * (a - to.in_plane), 0. };
    case Region::tension_two:
      return { to.in_plane, to.in_plane, 0. };
    case Region::squeeze:
      return { a - poisson * (b + to.strength), -to.strength, 0. };
    case Region::squeeze_two:
      return { -to.strength, -to.strength, 0. };
    case Region::shear_tension:
      return { to.in_plane, n_phi * to.in_plane - to.strength, 0. };
    default: // shear_squeeze
      return { 0., -to.strength, 0. };
    }
  }

  MohrCoulomb::Region MohrCoulomb::region(const Principal &trial) const
  {
    return assumption == PlaneAssumption::plane_strain
               ? region_plane_strain(trial)
               : region_plane_stress(trial);
  }

  MohrCoulomb::Principal MohrCoulomb::returned(const Region region,
                                               const Principal &trial,
                                               const Limits &to) const
  {
    return assumption == PlaneAssumption::plane_strain
               ? returned_plane_strain(region, trial, to)
               : returned_plane_stress(region, trial, to);
  }

  MohrCoulomb::Principal
  MohrCoulomb::plastic_increment(const Region region, const Principal &trial,
                                 const Principal &end) const
  {
    // What the elastic strain loses.
    Principal strain = inverse_hooke(
        { trial[0] - end[0], trial[1] - end[1], trial[2] - end[2] });
    if (assumption == PlaneAssumption::plane_stress)
      strain[2] = plane_stress_thinning(region, strain[0], strain[1]);
    return strain;
  }

  double MohrCoulomb::plane_stress_thinning(const Region region,
                                            const double major,
                                            const double minor) const
  {
    // Where the limit of the major stress is that of shear with the free
    // direction, N_psi of it stand against 1 out of the plane.
    const double thinning = limits.in_plane < limits.tension ? -1. / n_psi : 0.;
    switch (region)
    {
    case Region::tension:
      return thinning * major;
    case Region::tension_two:
      return thinning * (major + minor);
    case Region::shear_tension:
      return thinning * (major + n_psi * minor);
    case Region::squeeze:
      return -n_psi * minor;
    case Region::squeeze_two:
      return -n_psi * (major + minor);
    case Region::shear_squeeze:
      return -n_psi * minor - major;
    default: // shear in the plane
      return 0.;
    }
  }

  std::uint8_t MohrCoulomb::yields_now(const Region region) const
  {
    const bool cut_is_shear = assumption == PlaneAssumption::plane_stress
                              && limits.in_plane < limits.tension;
    const std::uint8_t cut
        = cut_is_shear ? yielding::shear_now : yielding::tension_now;
    switch (region)
    {
    case Region::tension:
    case Region::tension_two:
    case Region::tension_three:
      return cut;
    case Region::shear_tension:
    case Region::vertex_major:
    case Region::vertex_minor:
      return yielding::shear_now | cut;
    default:
      return yielding::shear_now;
    }
  }
} // namespace quoin
