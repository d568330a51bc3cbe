// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/absorbing/plane_waves.h>

#include <gtest/gtest.h>

using namespace quoin;

namespace
{
  using Vector = dealii::Tensor<1, 3>;

  const Impedance rock
      = impedance_of({ 2500., 18e9, 0.25 }, PlaneAssumption::plane_strain);

  /** A load with the waves @p signals. */
  LoadParameters load_of(const dealii::Point<3> &direction,
                         const std::vector<unsigned int> &signals)
  {
    LoadParameters load;
    load.name           = "open";
    load.type           = LoadType::viscous_boundary;
    load.wave_direction = direction;
    load.wave_origin    = dealii::Point<3>(-1., 2., -30.);
    for (const unsigned int k : signals)
      load.components[k].quantity = LoadQuantity::velocity;
    return load;
  }
} // namespace

// On a horizontal base below waves that rise vertically: twice the impedance,
// along z for P, x for SV and y for SH waves.
TEST(PlaneWaves, VerticalWavesPushAsThoseAlongTheNormal)
{
  const PlaneWaves waves(load_of({ 0., 0., 2. }, { 0, 1, 2 }), rock);
  ASSERT_EQ(waves.components().size(), 3U);
  const unsigned int axis[] = { 2, 0, 1 };
  for (unsigned int k = 0; k < 3; ++k)
  {
    const Vector q
        = waves.traction(waves.components()[k], dealii::Point<3>(0., 0., -1.));
    for (unsigned int d = 0; d < 3; ++d)
      EXPECT_NEAR(q[d],
                  d == axis[k] ? 2. * (k == 0 ? rock.normal : rock.shear) : 0.,
                  1e-9 * rock.normal);
  }
}

// The traction is that of the wave's stress, by central differences of its
// displacement, and that of the dashpots on its velocity.
TEST(PlaneWaves, TractionOfStressAndDashpots)
{
  const PlaneWaves waves(load_of({ 0.48, -0.6, 0.64 }, { 0, 1, 2 }), rock);
  const double mu = 18e9 / 2.5, lambda = mu; // Poisson's ratio 0.25
  const Vector n = dealii::Point<3>(2. / 3., 1. / 3., 2. / 3.);
  for (const auto &wave : waves.components())
  {
    // u = a g with the velocity 1 where the signal's derivative is 1.
    const auto u = [&](const dealii::Point<3> &x)
    { return -waves.arrival(wave, x) * wave.amplitude; };
    const dealii::Point<3> here(3., 4., 5.);
    dealii::Tensor<2, 3> gradient;
    for (unsigned int d = 0; d < 3; ++d)
    {
      Vector step;
      step[d]            = 1e-2;
      const Vector slope = (u(here + step) - u(here - step)) / 2e-2;
      for (unsigned int c = 0; c < 3; ++c)
        gradient[c][d] = slope[c];
    }
    const Vector stress = lambda * trace(gradient) * n
                          + mu * (gradient * n + transpose(gradient) * n);
    const Vector &v = wave.amplitude;
    const Vector dashpot
        = rock.normal * (v * n) * n + rock.shear * (v - (v * n) * n);
    EXPECT_LT((waves.traction(wave, n) - stress - dashpot).norm(),
              1e-8 * rock.normal);
  }
}

// Nothing pulls at the surface, and all waves are there at the same time.
TEST(PlaneWaves, TheFreeSurfaceIsFree)
{
  for (const unsigned int signal : { 0, 1, 2 })
  {
    LoadParameters load = load_of({ 0.3, 0.2, 0.9 }, { signal });
    load.free_surface   = 4.;
    const PlaneWaves waves(load, rock);
    EXPECT_EQ(waves.components().size(), signal == 2 ? 2U : 3U);
    const Vector up = dealii::Point<3>(0., 0., 1.);
    const dealii::Point<3> place(7., -3., 4.);
    Vector sum, velocity;
    for (const auto &wave : waves.components())
    {
      sum += waves.traction(wave, up);
      velocity += wave.amplitude;
      EXPECT_NEAR(waves.arrival(wave, place),
                  waves.arrival(waves.components()[0], place), 1e-12);
    }
    const Vector dashpot = rock.shear * velocity
                           + (rock.normal - rock.shear) * (velocity * up) * up;
    EXPECT_LT((sum - dashpot).norm(), 1e-9 * rock.normal);
    if (signal == 2)
    {
      EXPECT_NEAR(velocity.norm(), 2., 1e-12);
    }
  }
}

TEST(PlaneWaves, RefusesSteepAnglesOfSurfaceWaves)
{
  LoadParameters load = load_of({ 1., 0., 1. }, { 1 });
  load.free_surface   = 0.;
  EXPECT_THROW(PlaneWaves(load, rock), InputError);
  load.components[1].quantity = LoadQuantity::free;
  load.components[2].quantity = LoadQuantity::velocity;
  EXPECT_EQ(PlaneWaves(load, rock).components().size(), 2U);
  load.wave_direction = dealii::Point<3>(1., 0., -1.);
  EXPECT_THROW(PlaneWaves(load, rock), InputError);
}
