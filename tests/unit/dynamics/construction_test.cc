// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../implicit/implicit_run.h"
#include "../joint_laws/rock_walk.h"
#include "../model/test_models.h"

#include <quoin/base/exceptions.h>
#include <quoin/dynamics/construction.h>
#include <quoin/dynamics/initial_energy.h>
#include <quoin/model/block_placement.h>
#include <quoin/water/joint_flow.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  StageParameters stage_of(const std::vector<std::string> &excavate,
                           const std::vector<std::string> &fill,
                           const double release = 1.)
  {
    StageParameters stage = stage_with({});
    stage.excavate        = excavate;
    stage.fill            = fill;
    stage.release         = release;
    return stage;
  }

  ModelParameters under_stress(const bool rigid = false)
  {
    ModelParameters parameters    = two_blocks();
    parameters.materials[1].rigid = rigid;
    LoadParameters stress;
    stress.name                 = "in situ";
    stress.type                 = LoadType::initial_stress;
    stress.stress               = { { -2e6, -3e6, 0.5e6 } };
    parameters.initial_stresses = { stress };
    return parameters;
  }

  ModelParameters without_stress(const bool rigid = false)
  {
    ModelParameters parameters = under_stress(rigid);
    parameters.initial_stresses.clear();
    return parameters;
  }

  /** What acts on each node at the positions of the state, without motion. */
  AlignedArray<dealii::Tensor<1, 2>> forces(const Model<2> &model,
                                            State<2> state)
  {
    AlignedArray<dealii::Tensor<1, 2>> result(state.nodes.size(),
                                              dealii::Tensor<1, 2>());
    model.joints().add_forces(state.nodes.data(), state.get<JointHistory>(),
                              state.energy, result.data());
    for (unsigned int tile = 0; tile < model.blocks().n_tiles(); ++tile)
      model.blocks().add_forces(tile, state.nodes.data(),
                                state.get<PlasticHistory>(), result.data());
    return result;
  }

  double largest(const AlignedArray<dealii::Tensor<1, 2>> &force)
  {
    double result = 0.;
    for (const dealii::Tensor<1, 2> &f : force)
      result = std::max({ result, std::abs(f[0]), std::abs(f[1]) });
    return result;
  }

  /** Throws the lower block and begins @p stages one after the other; the
      largest residual of the energy balance by what went through. */
  double residual_in_motion(TestRun &run, std::vector<StageParameters> stages)
  {
    stages.insert(stages.begin(), stage_with({}));
    Construction construction(run.model, stages);
    run.throw_at_random(1e-5);
    const NodeRange upper = block_nodes(run.model, 1);
    for (std::size_t i = upper.begin; i < upper.end; ++i)
      run.state.velocity[i] = dealii::Tensor<1, 2>();
    account_for_initial_motion(run.model, run.state);
    double result = 0.;
    for (unsigned int i = 0; i < stages.size(); ++i)
    {
      construction.begin_stage(i, run.solver, run.state);
      stages[i].release_duration = 1e-3;
      run.begin(stages[i], 0.5, i == 0 ? nullptr : &stages[i - 1]);
      for (unsigned int k = 0; k < 300; ++k)
      {
        run.solver.step(run.state, { true, false });
        const Energies &energies = run.solver.energies();
        const double residual
            = std::abs(energies.residual()) / energies.throughput();
        result = std::max(result, residual);
      }
    }
    return result;
  }
} // namespace

TEST(Construction, AbsenceIsTheShareOfStagesAndMoreInTheEnd)
{
  const BlockMesh<2> mesh = make_stack(3, 2);
  const auto absence_of   = [&](const std::vector<StageParameters> &stages,
                              const std::vector<std::string> &at_start = {})
  {
    ModelParameters parameters = without_stress();
    parameters.absent_groups   = at_start;
    TestRun run(mesh, parameters, {});
    return Construction<2>(run.model, stages).absence();
  };
  using Absence              = std::vector<double>;
  const StageParameters rest = stage_of({}, {}),
                        dig  = stage_of({ "upper" }, {}),
                        line = stage_of({}, { "upper" });
  EXPECT_EQ(absence_of({ rest, rest }), Absence({ 0., 0. }));
  EXPECT_EQ(absence_of({ rest, dig }), Absence({ 0., 2.5 }));
  EXPECT_EQ(absence_of({ rest, dig, rest, line }), Absence({ 0., 0.5 }));
  EXPECT_EQ(absence_of({ rest, line }, { "upper" }), Absence({ 0., 0.5 }));
}

TEST(Construction, ForcesOfWhatIsTakenStay)
{
  for (const bool rigid : { false, true })
  {
    TestRun run(make_stack(3, 2), under_stress(rigid), {});
    const std::vector<StageParameters> stages
        = { stage_of({ "upper" }, {}, 0.25), stage_of({}, {}, 1.) };
    Construction construction(run.model, stages);
    const auto before = forces(run.model, run.state);
    construction.begin_stage(0, run.solver, run.state);
    EXPECT_TRUE(run.state.is_absent(1));
    EXPECT_FALSE(run.state.is_absent(0));

    const auto after      = forces(run.model, run.state);
    const NodeRange lower = block_nodes(run.model, 0);
    for (const bool linear : { false, true })
    {
      // Over 4 s: as half a cosine, or straight.
      const double quarter = linear ? 0.25 : 0.5 * (1. - std::sqrt(0.5));
      const std::vector<std::array<double, 2>> shares = { { { 0., 0. } },
                                                          { { 1., quarter } },
                                                          { { 2., 0.5 } },
                                                          { { 4., 1. } },
                                                          { { 9., 1. } } };
      for (const auto &[time, share] : shares)
      {
        AlignedArray<dealii::Tensor<1, 2>> held(before.size(),
                                                dealii::Tensor<1, 2>());
        const Release<2> release(run.state, linear, 4.);
        release.add_loads({ time, time }, held.data());
        const double left = 1. - 0.25 * share;
        for (std::size_t i = lower.begin; i < lower.end; ++i)
          for (unsigned int d = 0; d < 2; ++d)
            EXPECT_NEAR(held[i][d], left * (before[i][d] - after[i][d]),
                        1e-9 * largest(before));
        // nothing acts on what is gone
        for (std::size_t i = lower.end; i < held.size(); ++i)
          EXPECT_EQ(std::abs(held[i][0]) + std::abs(held[i][1]), 0.);
      }
    }
    construction.begin_stage(1, run.solver, run.state);
    ASSERT_EQ(run.state.get<ConstructionState<2>>().held.size(), 1U);
    EXPECT_DOUBLE_EQ(run.state.get<ConstructionState<2>>().held[0].left, 0.75);
    EXPECT_EQ(run.state.get<ConstructionState<2>>().held[0].left_at_end, 0.);
  }
}

TEST(Construction, ASearchForTheFactorOfSafetyKeepsTheSupport)
{
  TestRun run(make_stack(3, 2), under_stress(), {});
  std::vector<StageParameters> stages
      = { stage_of({ "upper" }, {}, 0.25), stage_of({}, {}), stage_of({}, {}) };
  stages[1].safety.emplace();
  Construction construction(run.model, stages);
  const auto left = [&]()
  {
    const HeldForces<2> &item
        = run.state.get<ConstructionState<2>>().held.front();
    return std::array<double, 2>{ item.left, item.left_at_end };
  };
  construction.begin_stage(0, run.solver, run.state);
  EXPECT_EQ(left(), (std::array<double, 2>{ 1., 0.75 }));
  construction.begin_stage(1, run.solver, run.state);
  EXPECT_EQ(left(), (std::array<double, 2>{ 0.75, 0.75 }));
  construction.begin_stage(2, run.solver, run.state);
  EXPECT_EQ(left(), (std::array<double, 2>{ 0.75, 0. }));
}

TEST(Construction, PlacedBlocksAreFreeOfStress)
{
  TestRun run(make_stack(3, 2), under_stress(), {});
  for (NodeRecord<2> &node : run.state.nodes)
    node.u[1] += 1e-4 * node.X[0];
  Construction construction(
      run.model, { stage_of({ "upper" }, {}), stage_of({}, { "upper" }) });
  construction.begin_stage(0, run.solver, run.state);
  construction.begin_stage(1, run.solver, run.state);
  EXPECT_FALSE(run.state.is_absent(1));
  const NodeRange upper = block_nodes(run.model, 1);
  const auto force      = forces(run.model, run.state);
  for (std::size_t i = upper.begin; i < upper.end; ++i)
    for (unsigned int d = 0; d < 2; ++d)
    {
      EXPECT_EQ(run.state.nodes[i].u[d], 0.);
      EXPECT_NEAR(force[i][d], 0., 1e-9 * largest(force));
    }
}

TEST(Construction, EnergyOfMovingBlocksIsAccountedFor)
{
  for (const bool rigid : { false, true })
  {
    TestRun run(make_stack(3, 2), without_stress(rigid), {});
    EXPECT_LT(residual_in_motion(run, { stage_of({ "upper" }, {}, 0.6),
                                        stage_of({}, { "upper" }) }),
              1e-5); // what turns with the gaps of the placed joint
  }
}

TEST(Construction, WeightOfPlacedBlocksComesQuietly)
{
  // Without damping a column goes down much farther under a block whose weight
  // is there at once, and hardly farther under one whose weight grows.
  for (const bool sudden : { false, true })
  {
    BlockMesh<2> mesh     = make_stack(1, 8);
    LoadParameters weight = gravity("0", "-10");
    weight.groups         = { "upper" };
    if (sudden)
      weight.ramp_duration = 0.;
    TestRun run(mesh, without_stress(),
                { weight, motion("base", "bottom", "0", "0"),
                  motion("rollers", "sides", "0", "") });
    std::vector<StageParameters> stages
        = { stage_of({ "upper" }, {}), stage_of({}, { "upper" }) };
    for (StageParameters &stage : stages)
    {
      stage.loads = { "gravity", "base", "rollers" };
      stage.end   = StageEnd::static_ratio;
    }
    Construction construction(run.model, stages);
    construction.begin_stage(0, run.solver, run.state);
    construction.begin_stage(1, run.solver, run.state);
    run.begin(stages[1], 0.8, &stages[0]);
    const double quiet = run.solver.quiet_time();
    double lowest = 0., sum = 0., largest_residual = 0.;
    unsigned int n = 0;
    while (run.state.time < 5. * quiet)
    {
      run.solver.step(run.state, { true, false });
      largest_residual = std::max(largest_residual,
                                  std::abs(run.solver.energies().residual()));
      double top       = 0.;
      for (const NodeRecord<2> &node : run.state.nodes)
        top = std::min(top, node.u[1]);
      lowest = std::min(lowest, top);
      if (run.state.time <= quiet)
        continue;
      sum += top;
      ++n;
    }
    EXPECT_LT(largest_residual, 1e-6 * run.solver.energies().throughput());
    const double overshoot = lowest / (sum / n) - 1.;
    if (sudden)
      EXPECT_GT(overshoot, 0.5);
    else
      EXPECT_LT(overshoot, 0.05);
  }
}

namespace
{
  /** What @p run lets act vertically on the block @p block at the load time
      @p time of its stage [N]. */
  template <typename Run>
  double weight_of(const Run &run, const unsigned int block, const double time)
  {
    AlignedArray<dealii::Tensor<1, 2>> force(run.state.nodes.size(),
                                             dealii::Tensor<1, 2>());
    const TimePoint now{ time, run.state.load_start() + time };
    const StageLoads<2> &loads = run.solver.stage_loads();
    for (const NodalLoad<2> *load : loads.nodal)
      load->add_loads(now, force.data());
    loads.arrival.add_loads(now, force.data());
    if (loads.water)
      loads.water->add_loads(now, force.data());
    const NodeRange nodes = block_nodes(run.model, block);
    double sum            = 0.;
    for (std::size_t i = nodes.begin; i < nodes.end; ++i)
      sum += force[i][1];
    return sum;
  }
} // namespace

TEST(Construction, LoadsGoOnGrowingAfterAStageThatEndsEarly)
{
  // Gravity that begins, and weight on a block that is placed.
  for (const bool is_placed : { false, true })
  {
    TestRun run(make_stack(1, 8), without_stress(),
                { gravity("0", "-10"), motion("base", "bottom", "0", "0"),
                  motion("rollers", "sides", "0", "") });
    std::vector<StageParameters> stages
        = { stage_of({ "upper" }, {}), stage_of({}, { "upper" }),
            stage_of({}, {}), stage_of({}, {}) };
    if (!is_placed)
      stages[0].excavate = stages[1].fill = {};
    for (StageParameters &stage : stages)
    {
      stage.loads = { "gravity", "base", "rollers" };
      stage.end   = StageEnd::static_ratio;
    }
    stages[3].end = StageEnd::time;
    Construction construction(run.model, stages);
    construction.begin_stage(0, run.solver, run.state);
    if (is_placed)
      construction.begin_stage(1, run.solver, run.state);
    run.begin(stages[1], 0.8, is_placed ? &stages[0] : nullptr);
    const double quiet = run.solver.quiet_time(),
                 full  = -10. * 2500. * 8. * 0.5;
    EXPECT_NEAR(weight_of(run, 1, 0.), 0., 1e-9 * std::abs(full));
    for (unsigned int i = 2; i < 4; ++i)
    {
      while (run.state.load_time < 0.3 * quiet)
        run.solver.step(run.state, {});
      const double share  = half_cosine((i - 1) * 0.3 * quiet, quiet);
      const double before = weight_of(run, 1, run.state.load_time);
      EXPECT_NEAR(before, share * full, 1e-2 * std::abs(full));
      construction.begin_stage(i, run.solver, run.state);
      run.begin(stages[i], 0.8, &stages[i - 1]);
      EXPECT_NEAR(weight_of(run, 1, 0.), before, 1e-9 * std::abs(full));
      run.solver.resume_stage(stages[i], &stages[i - 1], run.state);
      EXPECT_NEAR(weight_of(run, 1, 0.), before, 1e-9 * std::abs(full));
    }
    EXPECT_LT(run.solver.stage_loads().growth(), 0.5 * quiet);
    EXPECT_NEAR(weight_of(run, 1, 0.5 * quiet), full, 1e-9 * std::abs(full));
  }
}

TEST(Construction, LoadsThatChangeDoNotJumpWhereAStageEndsEarly)
{
  // Gravity that rises with the time of the run, on a block that is placed.
  TestRun run(make_stack(1, 8), without_stress(),
              { gravity("0", "-10*(1+50*T)"),
                motion("base", "bottom", "0", "0"),
                motion("rollers", "sides", "0", "") });
  std::vector<StageParameters> stages
      = { stage_of({ "upper" }, {}), stage_of({}, { "upper" }),
          stage_of({}, {}) };
  for (StageParameters &stage : stages)
  {
    stage.loads = { "gravity", "base", "rollers" };
    stage.end   = StageEnd::static_ratio;
  }
  Construction construction(run.model, stages);
  construction.begin_stage(0, run.solver, run.state);
  construction.begin_stage(1, run.solver, run.state);
  run.begin(stages[1], 0.8, &stages[0]);
  const double quiet = run.solver.quiet_time(), full = -10. * 2500. * 8. * 0.5;
  while (run.state.load_time < 0.4 * quiet)
    run.solver.step(run.state, {});
  const double share  = half_cosine(run.state.load_time, quiet);
  const double before = weight_of(run, 1, run.state.load_time);
  EXPECT_NEAR(before, share * (1. + 50. * run.state.time) * full,
              1e-9 * std::abs(full));
  // Their power is that of the forces.
  const AlignedArray<dealii::Tensor<1, 2>> down(run.state.nodes.size(),
                                                dealii::Point<2>(0., -1.));
  const TimePoint now{ run.state.load_time, run.state.time };
  const StageLoads<2> &loads = run.solver.stage_loads();
  const auto all_of_it       = loads.nodal[0]->external_power(now, down.data());
  EXPECT_NEAR(loads.arrival.external_power(now, down.data()),
              (share - 1.) / 2. * all_of_it, 1e-9 * std::abs(full));
  construction.begin_stage(2, run.solver, run.state);
  run.begin(stages[2], 0.8, &stages[1]);
  EXPECT_NEAR(weight_of(run, 1, 0.), before, 1e-9 * std::abs(full));
}

TEST(Construction, LoadsInEquilibriumGoOnGrowingInTheNextStage)
{
  BlockMesh<2> mesh     = make_stack(1, 2);
  LoadParameters weight = gravity("0", "-10");
  weight.ramp_duration  = 2.5;
  ImplicitRun run(mesh, without_stress(),
                  { weight, motion("base", "bottom", "0", "0"),
                    motion("rollers", "sides", "0", "") });
  const StageParameters stage = stage_with({ "gravity", "base", "rollers" });
  const double full           = -10. * 2500. * 2. * 0.5;
  for (unsigned int i = 0; i < 3; ++i)
  {
    run.begin(stage.loads, i == 0 ? nullptr : &stage);
    EXPECT_TRUE(run.state.get<ImplicitState>().held.empty());
    run.finish();
    EXPECT_NEAR(weight_of(run, 1, 1.), half_cosine(i + 1., 2.5) * full,
                1e-9 * std::abs(full));
  }
}

TEST(Construction, WaterAtPlacedBlocksGrowsAsTheirWeight)
{
  TestRun run(make_stack(2, 8), without_stress(),
              { gravity("0", "-10"), motion("base", "bottom", "0", "0"),
                motion("rollers", "sides", "0", "") });
  WaterParameters given;
  given.flow = FlowKind::steady;
  HydraulicAperture aperture;
  aperture.name = "joint";
  given.joints  = { aperture };
  WaterBoundary source;
  source.name      = "source";
  source.curves    = { "joint" };
  source.value     = TimeFunction("1e5", "./");
  given.boundaries = { source };
  JointFlow water(given, run.nodes, run.model.joints(),
                  run.model.parameters().joints, run.model.thickness());
  run.solver.loads().water = &water;
  std::vector<StageParameters> stages
      = { stage_of({ "upper" }, {}), stage_of({}, { "upper" }),
          stage_of({}, {}) };
  for (StageParameters &stage : stages)
  {
    stage.loads = { "gravity", "base", "rollers" };
    stage.end   = StageEnd::static_ratio;
  }
  Construction construction(run.model, stages);
  run.solver.prepare(run.state);
  construction.begin_stage(0, run.solver, run.state);
  run.begin(stages[0]);
  // Gravity, which would go on growing itself, is all there.
  run.state.load_time = run.solver.quiet_time();
  construction.begin_stage(1, run.solver, run.state);
  run.begin(stages[1], 0.8, &stages[0]);
  const double quiet = run.solver.quiet_time();
  const double lift = 1e5 * 2. * 0.5, full = lift - 10. * 2500. * 16. * 0.5;
  const auto at
      = [&](const double share) { return weight_of(run, 1, share * quiet); };
  EXPECT_NEAR(at(0.), 0., 1e-9 * lift);
  EXPECT_NEAR(at(0.5), 0.5 * full, 1e-9 * lift);
  EXPECT_NEAR(at(1.), full, 1e-9 * lift);
  // So does what it bears on the block below, and its work.
  AlignedArray<dealii::Tensor<1, 2>> force(run.state.nodes.size(),
                                           dealii::Tensor<1, 2>()),
      velocity = force;
  const TimePoint half{ 0.5 * quiet, 0.5 * quiet };
  water.add_loads(half, force.data());
  const NodeRange lower = block_nodes(run.model, 0);
  double sum            = 0.;
  for (std::size_t i = lower.begin; i < lower.end; ++i)
  {
    sum += force[i][1];
    velocity[i][1] = 2.;
  }
  EXPECT_NEAR(sum, -0.5 * lift, 1e-9 * lift);
  EXPECT_NEAR(water.external_power(half, velocity.data()), -lift, 1e-9 * lift);
  // An excavation that comes so early holds what it has borne there.
  run.state.load_time = half.stage;
  const auto held     = [&]
  {
    std::fill(force.begin(), force.end(), dealii::Tensor<1, 2>());
    run.solver.add_water_between({ 1 }, run.state, force.data());
    double sum = 0.;
    for (std::size_t i = lower.begin; i < lower.end; ++i)
      sum += force[i][1];
    return sum;
  };
  EXPECT_NEAR(held(), -0.5 * lift, 1e-9 * lift);
  // So it does in a run that is resumed between the stages, and after trials
  // in which it was all there.
  JointFlow resumed(given, run.nodes, run.model.joints(),
                    run.model.parameters().joints, run.model.thickness());
  run.solver.loads().water = &resumed;
  EXPECT_NEAR(held(), -0.5 * lift, 1e-9 * lift);
  run.solver.loads().water = &water;
  water.let_grow({});
  EXPECT_NEAR(held(), -0.5 * lift, 1e-9 * lift);
}

namespace
{
  /** Two blocks, one on the other, with a wall along both of them. */
  BlockMesh<2> make_wall()
  {
    MeshData<2> data;
    for (const unsigned int i : { 0U, 1U })
    {
      const double y = 2. * i;
      add_grid(data, 3, 2, i == 0 ? "lower" : "upper", 0., y);
      add_curve(data, "wall", 0., y, 0., y + 2.);
    }
    add_curve(data, "bottom", 0., 0., 3., 0.);
    add_curve(data, "joint", 0., 2., 3., 2.);
    add_curve(data, "top", 0., 4., 3., 4.);
    return split_into_blocks(data, {});
  }

  /** A liner of that wall. */
  template <typename Run>
  void add_liner(Run &run)
  {
    BeamParameters liner;
    liner.name               = "liner";
    liner.boundary           = "wall";
    liner.interface          = "bond";
    liner.modulus            = 3e10;
    liner.area               = 0.1;
    liner.second_moment      = 1e-4;
    liner.density            = 2400.;
    run.solver.loads().beams = std::make_unique<Beams>(
        std::vector<BeamParameters>{ liner }, run.nodes,
        std::vector<JointSetParameters>{ elastic_joint(3e10, 1e10, "bond") },
        1., run.model.thickness());
  }
} // namespace

TEST(Construction, EnergyOfLinersIsAccountedFor)
{
  // The upper block goes and comes again.
  TestRun run(make_wall(), without_stress(), {});
  add_liner(run);
  EXPECT_LT(residual_in_motion(run, { stage_of({ "upper" }, {}, 0.6),
                                      stage_of({}, { "upper" }) }),
            1e-5);
  unsigned int n_attached = 0;
  for (const auto flag : run.state.get<BeamState>().attached)
    n_attached += flag;
  EXPECT_EQ(n_attached, 3u) << "nodes of the lower block";
}

TEST(Construction, EnergyOfLinersInEquilibriumIsAccountedFor)
{
  ImplicitRun run(make_wall(), without_stress(),
                  { motion("hold", "bottom", "0", "0"),
                    traction("press", "top", "", "-1e4*t") });
  add_liner(run);
  StageParameters pressed = stage_with({ "hold", "press" });
  StageParameters cut     = stage_of({ "upper" }, {});
  cut.loads               = { "hold" };
  Construction construction(run.model, { pressed, cut });
  run.solver.prepare(run.state);
  const StageParameters *previous = nullptr;
  for (const StageParameters *stage : { &pressed, &cut })
  {
    construction.begin_stage(previous ? 1 : 0, run.solver, run.state);
    run.solver.begin_stage(*stage, previous, run.state);
    run.finish();
    const Energies &energies = run.solver.energies();
    EXPECT_LT(std::abs(energies.residual()), 1e-6 * energies.throughput());
    previous = stage;
  }
}

TEST(Construction, LoadsOfBeamsGrowWithTheWeight)
{
  // A beam that the first stage places and one of the second stage, in which
  // weight still grows.
  TestRun run(make_stack(1, 8), without_stress(),
              { gravity("0", "-10"), motion("base", "bottom", "0", "0"),
                motion("rollers", "sides", "0", "") });
  std::vector<BeamParameters> beams(2);
  for (BeamParameters &beam : beams)
  {
    beam.name           = "beam";
    beam.points         = { { { 20., 0. } }, { { 22., 0. } } };
    beam.n_segments     = 2;
    beam.modulus        = 3e10;
    beam.area           = 0.1;
    beam.second_moment  = 1e-4;
    beam.density        = 2400.;
    beam.distributed[0] = TimeFunction("300", "./");
    beam.forces[0][0]   = TimeFunction("70", "./");
  }
  beams[1].stage           = "second";
  run.solver.loads().beams = std::make_unique<Beams>(
      beams, run.nodes, std::vector<JointSetParameters>{}, 1.,
      run.model.thickness());
  std::vector<StageParameters> stages = { stage_of({}, {}), stage_of({}, {}) };
  for (StageParameters &stage : stages)
  {
    stage.loads = { "gravity", "base", "rollers" };
    stage.end   = StageEnd::static_ratio;
  }
  stages[0].name = "first";
  stages[1].name = "second";
  run.solver.prepare(run.state);
  run.begin(stages[0]);
  const double quiet = run.solver.quiet_time();
  const auto load_at = [&](const unsigned int beam, const double time)
  {
    double sum = 0.; // along x, without weight
    for (const auto &load : run.solver.loads().beams->node_loads(
             beam, { time, run.state.load_start() + time }))
      sum += load[0];
    return sum;
  };
  EXPECT_NEAR(load_at(0, 0.), 0., 1e-9);
  EXPECT_NEAR(load_at(0, 0.5 * quiet), 335., 1e-9);
  EXPECT_NEAR(load_at(0, quiet), 670., 1e-9);
  // What is left grows in the next stage, with the weight, and so do the loads
  // of a beam that it places; after a resumption, too.
  while (run.state.load_time < 0.3 * quiet)
    run.solver.step(run.state, {});
  const double before = load_at(0, run.state.load_time);
  EXPECT_NEAR(before, half_cosine(0.3 * quiet, quiet) * 670., 7.);
  run.begin(stages[1], 0.8, &stages[0]);
  for (unsigned int i = 0; i < 2; ++i)
  {
    EXPECT_NEAR(load_at(0, 0.), before, 1e-9);
    EXPECT_NEAR(load_at(0, 0.8 * quiet), 670., 1e-9);
    EXPECT_NEAR(load_at(1, 0.), 0., 1e-9);
    EXPECT_NEAR(load_at(1, 0.8 * quiet), 670., 1e-9);
    run.solver.resume_stage(stages[1], &stages[0], run.state);
  }
}

TEST(Construction, ChangedPropertiesKeepStressAndEnergy)
{
  BlockMesh<2> mesh          = make_stack(3, 2);
  ModelParameters parameters = under_stress();
  MaterialParameters soft    = material("soft", 2500., 3e9, 0.3);
  soft.groups.clear();
  parameters.materials.push_back(soft);
  JointSetParameters weak = elastic_joint(5e9, 2e9, "weak");
  weak.curves.clear();
  parameters.joints.push_back(weak);
  StageParameters change  = stage_of({}, {});
  change.materials        = { { "upper", "soft" } };
  change.joint_properties = { { "joint", "weak" } };
  {
    TestRun run(mesh, parameters, {});
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1e-4, 1e-4);
    for (NodeRecord<2> &node : run.state.nodes)
      for (double &u : dealii::make_array_view(node.u))
        u = uniform(random);
    const auto before = forces(run.model, run.state);
    Construction construction(run.model, { change });
    construction.begin_stage(0, run.solver, run.state);
    const auto after = forces(run.model, run.state);
    for (std::size_t i = 0; i < before.size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        EXPECT_NEAR(after[i][d], before[i][d], 1e-10 * largest(before));

    // the new stiffness from there on
    const double stiff = run.model.blocks()
                             .cell_data()
                             .stiffness_of(run.nodes->cells().size() - 1)
                             .c33;
    EXPECT_DOUBLE_EQ(stiff, 3e9 / 2.6);
    construction.restart();
    EXPECT_DOUBLE_EQ(run.model.blocks()
                         .cell_data()
                         .stiffness_of(run.nodes->cells().size() - 1)
                         .c33,
                     1e10 / 2.4);
  }
  parameters.initial_stresses.clear();
  TestRun run(mesh, parameters, {});
  EXPECT_LT(residual_in_motion(run, { change }), 1e-7);
}

TEST(Construction, RockJointsFollowLawsOfRockJointsOnly)
{
  BlockMesh<2> mesh          = make_stack(3, 2);
  ModelParameters parameters = two_blocks();
  parameters.joints.push_back(elastic_joint(5e9, 2e9, "weak"));
  parameters.joints.back().curves.clear();
  StageParameters change    = stage_of({}, {});
  change.joint_properties   = { { "joint", "weak" } };
  JointSetParameters &joint = parameters.joints[0],
                     &weak  = parameters.joints[1];
  joint.law                 = rock_test::rough();
  weak.law                  = rock_test::yielding();
  {
    TestRun run(mesh, parameters, {});
    Construction construction(run.model, { change });
    construction.begin_stage(0, run.solver, run.state);
    const JointLaw &now = run.model.properties().joints[0].law;
    ASSERT_TRUE(std::holds_alternative<ContinuouslyYieldingLaw>(now));
    EXPECT_EQ(std::get<ContinuouslyYieldingLaw>(now).roughness,
              rock_test::yielding().roughness);
  }
  for (const bool from_rock : { false, true })
  {
    (from_rock ? weak : joint).law = elastic_joint(5e9, 2e9).law;
    (from_rock ? joint : weak).law = rock_test::rough();
    TestRun run(mesh, parameters, {});
    EXPECT_THROW(Construction(run.model, { change }), InputError);
  }
}
