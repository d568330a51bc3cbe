// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/materials/mohr_coulomb.h>

#include <gtest/gtest.h>

#include <vector>

// Salencon's hole in one dimension: linear elements along the radius, strains
// xx = u', yy = u/r, implicit with the law's own tangent. What it should give
// is in parameter_files/verification/salencon/make_reference.py.

using namespace quoin;

namespace
{
  // A million times as stiff as that rock, for small strains.
  constexpr double stiffer = 1e6;
  constexpr double shear = stiffer * 2.8e9, bulk = stiffer * 3.9e9;
  constexpr double pressure = 30e6;
  constexpr double cohesion = 3.45e6, degree = 0.017453292519943295;
  constexpr double wall = 1., outer = 4.;

  class Hole
  {
  public:
    Hole(const double psi, const double out_of_plane, const int n_elements)
      : law({ 2500., 9. * bulk * shear / (3. * bulk + shear),
              (3. * bulk - 2. * shear) / (2. * (3. * bulk + shear)) },
            { cohesion, 30. * degree, psi }, PlaneAssumption::plane_strain),
        initial{ -pressure, -pressure, 0., out_of_plane }, r(n_elements + 1),
        u(n_elements + 1, 0.), points(n_elements)
    {
      for (int i = 0; i <= n_elements; ++i)
        r[i] = wall
               * std::pow(outer / wall, static_cast<double>(i) / n_elements);
      for (PlasticPoint &point : points)
        point.stress = initial;
    }

    /** Newton's method at the support @p inside [Pa]; number of steps. */
    int solve(const double inside)
    {
      const std::size_t n = points.size();
      std::vector<PlasticPoint> next;
      for (int iteration = 1;; ++iteration)
      {
        // Elastic rock beyond the outer radius, support at the wall.
        std::vector<double> force(n + 1, 0.), diagonal(n + 1, 0.), side(n, 0.),
            other(n, 0.);
        force[0]    = inside * wall;
        force[n]    = -pressure * outer - 2. * shear * u[n];
        diagonal[n] = 2. * shear;
        next        = points;
        for (std::size_t i = 0; i < n; ++i)
        {
          const double h = r[i + 1] - r[i], middle = 0.5 * (r[i] + r[i + 1]);
          const double volume = h * middle;
          const double b[2][2]
              = { { -1. / h, 0.5 / middle }, { 1. / h, 0.5 / middle } };
          const std::array<double, 3> whole{
            b[0][0] * u[i] + b[1][0] * u[i + 1],
            b[0][1] * u[i] + b[1][1] * u[i + 1], 0.
          };
          const auto &q = points[i].inverse_stretch;
          const std::array<double, 3> e{ whole[0] + q[0] + whole[0] * q[0],
                                         whole[1] + q[1] + whole[1] * q[1],
                                         0. };
          const auto K      = law.tangent(points[i], e, initial);
          const auto stress = law.update(next[i], e, initial).stress;
          double k[2][2]    = {};
          for (int p = 0; p < 2; ++p)
            for (int c = 0; c < 2; ++c)
            {
              force[i + p] -= volume * b[p][c] * stress[c];
              for (int q = 0; q < 2; ++q)
                for (int d = 0; d < 2; ++d)
                  k[p][q] += volume * b[p][c] * K[c][d] * b[q][d];
            }
          diagonal[i] += k[0][0];
          diagonal[i + 1] += k[1][1];
          side[i]  = k[0][1];
          other[i] = k[1][0];
        }
        double unbalanced = 0.;
        for (const double f : force)
          unbalanced = std::max(unbalanced, std::abs(f));
        if (unbalanced < 1e-9 * pressure || iteration == 50)
        {
          points = next;
          return iteration;
        }
        for (std::size_t i = 0; i < n; ++i)
        {
          const double factor = other[i] / diagonal[i];
          diagonal[i + 1] -= factor * side[i];
          force[i + 1] -= factor * force[i];
        }
        double step = force[n] / diagonal[n];
        u[n] += step;
        for (std::size_t i = n; i-- > 0;)
        {
          step = (force[i] - side[i] * step) / diagonal[i];
          u[i] += step;
        }
      }
    }

    double plastic_radius() const
    {
      std::size_t i = 0;
      while (i < points.size() && points[i].state != 0)
        ++i;
      return r[i];
    }

    double displacement(const double at) const
    {
      std::size_t i = 0;
      while (r[i + 1] < at)
        ++i;
      return stiffer
             * (u[i] + (at - r[i]) / (r[i + 1] - r[i]) * (u[i + 1] - u[i]));
    }

  private:
    MohrCoulomb law;
    std::array<double, 4> initial;
    std::vector<double> r, u;
    std::vector<PlasticPoint> points;
  };
} // namespace

namespace
{
  /** Takes the support away; the most iterations that a step took. */
  int excavate(Hole &hole)
  {
    constexpr int n_steps = 60;
    int most              = 0;
    for (int step = n_steps; step-- > 0;)
      most = std::max(most, hole.solve(pressure * step / n_steps));
    return most;
  }

  /** psi and the displacement of the wall [m]. */
  constexpr double expected[2][2]
      = { { 30. * degree, -28.1035e-3 }, { 0., -12.1671e-3 } };
} // namespace

TEST(MohrCoulombHole, Salencon)
{
  for (const auto &[psi, at_wall] : expected)
  {
    Hole hole(psi, -0.5 * pressure, 400);
    EXPECT_LT(excavate(hole), 8);
    EXPECT_NEAR(hole.plastic_radius(), 1.735, 0.005);
    EXPECT_NEAR(hole.displacement(1.735), -5.573e-3, 2e-6);
    EXPECT_NEAR(hole.displacement(wall), at_wall, 1e-3 * std::abs(at_wall));
  }
}

TEST(MohrCoulombHole, YieldsOutOfPlaneUnderAllRoundPressure)
{
  // The stress along the hole stays larger than the hoop stress at the wall,
  // what the closed form excludes: the edge sigma_2 = sigma_3 is reached and
  // the wall moves more, the border of the plastic zone does not.
  for (const auto &[psi, at_wall] : expected)
  {
    Hole hole(psi, -pressure, 400);
    EXPECT_LT(excavate(hole), 8);
    EXPECT_NEAR(hole.plastic_radius(), 1.735, 0.005);
    EXPECT_NEAR(hole.displacement(1.735), -5.573e-3, 2e-6);
    EXPECT_LT(hole.displacement(wall), 1.005 * at_wall);
    EXPECT_GT(hole.displacement(wall), 1.02 * at_wall);
  }
}
