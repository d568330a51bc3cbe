// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// A bar with a joint that softens faster than the bar can follow.

#include "implicit_run.h"

#include <quoin/operators/archive.h>

#include <boost/archive/binary_oarchive.hpp>
#include <boost/math/tools/roots.hpp>

#include <sstream>

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr auto displacement = LoadQuantity::displacement;
  constexpr auto velocity     = LoadQuantity::velocity;
  constexpr auto given_force  = LoadQuantity::force;

  constexpr double strength = 1e6, energy = 100.; // Pa, J/m^2
  constexpr double section    = 1.;               // m^2
  constexpr double young      = 1e10;
  constexpr double stiffness  = 1e11; // of either joint
  constexpr double compliance = 2. / young + 2. / stiffness;
  constexpr double speed      = 4e-4; // of the end [m/s]

  /** Displacement of the end on the softening branch [m]. */
  double softening(const double sigma)
  {
    return compliance * sigma + energy / strength * std::log(strength / sigma);
  }

  /** The stress on the branch that snapped back, of a displacement [Pa]. */
  double stress_after(const double u)
  {
    const double turn = energy / strength / compliance; // where it turns
    const auto range  = boost::math::tools::bisect(
        [&](const double s) { return softening(s) - u; }, 1e-6 * turn, turn,
        boost::math::tools::eps_tolerance<double>(50));
    return 0.5 * (range.first + range.second);
  }

  /** A joint with the given tensile strength and the same fracture energy. */
  JointSetParameters softening_joint(const std::string &curve,
                                     const double tension)
  {
    CompositeLaw law;
    law.normal_stiffness = law.shear_stiffness = stiffness;
    law.tension                                = tension;
    law.tension_energy                         = energy;
    law.cohesion                               = 2e6;
    law.shear_energy                           = 400.;
    JointSetParameters joint = elastic_joint(stiffness, stiffness, curve);
    joint.law                = law;
    return joint;
  }

  /**
   * A bar of 2 m, held at the left, glued to a block that cannot turn, and
   * after the joint that softens a block that is pulled away.
   */
  struct PulledBar
  {
    BlockMesh<2> mesh;
    std::unique_ptr<ImplicitRun> run;

    /** @p weak: that strength the lower half of the joint has. */
    explicit PulledBar(const ImplicitParameters &numbers,
                       const double weak = strength)
    {
      const std::string groups[] = { "bar", "middle", "end" };
      const std::string curves[] = { "left", "glue", "joint" };
      MeshData<2> data;
      for (unsigned int i = 0; i < 3; ++i)
      {
        add_grid(data, 2, 2, groups[i], 2. * i, 0.);
        add_curve(data, curves[i], 2. * i, 1., 2. * i, 2.);
        add_curve(data, i == 2 ? "weak" : curves[i], 2. * i, 0., 2. * i, 1.);
      }
      mesh = split_into_blocks(data, {});
      ModelParameters parameters;
      parameters.plane     = PlaneAssumption::plane_stress;
      parameters.thickness = 0.5;
      for (const std::string &name : groups)
        parameters.materials.push_back(material(name, 2500., young, 0.));
      parameters.joints  = { elastic_joint(stiffness, stiffness, "glue"),
                             softening_joint("joint", strength),
                             softening_joint("weak", weak) };
      const auto at_rest = component(velocity, "0");
      run                = std::make_unique<ImplicitRun>(
          mesh, parameters,
          std::vector<LoadParameters>{
                             load("left", LoadType::prescribed_motion, "left", displacement,
                                  "0", "0"),
                             platen("guide", "middle", component(given_force, "0"), at_rest,
                                    at_rest),
                             platen("pull", "end", component(displacement, "4e-4*t"), at_rest,
                                    at_rest) },
          numbers);
    }

    void begin() const
    {
      run->begin({ "left", "guide", "pull" });
    }
    double stress() const
    {
      return run->solver.resultant("pull")[0] / section;
    }
    double moved() const
    {
      return run->state.get<PlatenState>("pull").displacement[0];
    }
  };

  ImplicitParameters numbers(const PathFollowing path, const bool jumps)
  {
    ImplicitParameters result;
    result.force_ratio = 1e-9;
    result.path        = path;
    result.path_joints = { "joint", "weak" };
    result.jumps       = jumps;
    return result;
  }

  std::string bytes(const State<2> &state)
  {
    std::ostringstream stream;
    boost::archive::binary_oarchive(stream) << state;
    return stream.str();
  }
} // namespace

TEST(SnapBack, AJumpLosesWhatTheSpringsHadTooMuch)
{
  PulledBar bar(numbers(PathFollowing::never, true));
  bar.begin();
  bar.run->finish();
  // Below the peak a short way may lead to the next equilibrium; one jumps.
  const auto jumps = bar.run->solver.record().jumps;
  ASSERT_GE(jumps.size(), 1U);
  double short_ways = 0.;
  for (unsigned int i = 0; i + 1 < jumps.size(); ++i)
    short_ways += jumps[i].loss;
  const JumpReport jump = jumps.back();
  EXPECT_LT(std::abs(short_ways), 1e-3 * jump.loss);
  // From the peak, where the branch ends, to the other at the same place.
  const double peak = strength * compliance;
  const double u = speed * jump.load_time, after = stress_after(u);
  EXPECT_NEAR(u, peak, 1e-2 * peak);
  // So near to the peak a step of the drag crosses what is left to climb.
  EXPECT_GE(u, peak * (1. - 1e-3));
  const double loss = 0.5 * compliance * (strength * strength - after * after)
                      + strength * (u - peak)
                      - energy * (1. - after / strength);
  EXPECT_NEAR(jump.loss, loss * section, 0.05 * loss * section);
  // Fracture by finite steps of the softening curve; the sum is exact.
  const double left = bar.run->state.energy.fracture
                      - energy * (1. - bar.stress() / strength) * section;
  EXPECT_LT(std::abs(left), 0.02 * energy);
  EXPECT_NEAR(bar.run->state.energy.damping, jump.loss + short_ways,
              1e-6 * jump.loss);
  EXPECT_NEAR(bar.stress(), stress_after(speed), 1e-6 * strength);
  const Energies &energies = bar.run->solver.energies();
  EXPECT_LT(std::abs(energies.residual()), 1e-6 * energies.throughput());
}

TEST(SnapBack, WithoutEitherTheRunFailsAtThePeak)
{
  PulledBar bar(numbers(PathFollowing::never, false));
  bar.begin();
  try
  {
    bar.run->finish();
    ADD_FAILURE() << "it went past the peak";
  }
  catch (const RunError &error)
  {
    const std::string text = error.what();
    for (const std::string part :
         { "no equilibrium", "load time 0.5", "block", "joint of the set",
           "between the blocks", "limit load", "'Path following = automatic'",
           "last equilibrium is kept" })
      EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
  }
  EXPECT_NEAR(bar.moved(), strength * compliance, 1e-3 * strength * compliance);
  EXPECT_LE(bar.moved(), strength * compliance * (1. + 1e-9));
}

TEST(SnapBack, ARunThatIsResumedIsBitwiseTheSame)
{
  const auto values = numbers(PathFollowing::never, true);
  const double weak = 0.3 * strength;
  PulledBar whole(values, weak);
  whole.begin();
  std::vector<State<2>> states;
  while (!whole.run->solver.has_ended(whole.run->state))
  {
    states.push_back(whole.run->state);
    whole.run->solver.save(states.back());
    whole.run->solver.step(whole.run->state);
  }
  ASSERT_GT(states.size(), 20U);
  // On the way up, where it jumps, and late.
  for (const double share : { 0.1, 0.5, 0.6, 0.9 })
  {
    PulledBar other(values, weak);
    other.begin();
    other.run->state = states[share * states.size()];
    other.run->solver.resume_stage(stage_with({ "left", "guide", "pull" }),
                                   nullptr, other.run->state);
    other.run->finish();
    EXPECT_EQ(bytes(other.run->state), bytes(whole.run->state)) << share;
  }
}

TEST(SnapBack, AStageDoesNotEndWithinAJump)
{
  // The stage ends so soon after the peak that the jump is one to its end.
  PulledBar bar(numbers(PathFollowing::never, true));
  StageParameters stage = stage_with({ "left", "guide", "pull" });
  stage.duration        = 1.0005 * strength * compliance / speed;
  bar.run->solver.begin_stage(stage, nullptr, bar.run->state);
  bar.run->finish();
  EXPECT_FALSE(bar.run->state.get<ImplicitState>().jumps);
  EXPECT_NEAR(bar.stress(), stress_after(speed * stage.duration),
              1e-6 * strength);
}
