// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../contact/test_contacts.h"
#include "../joint_elements/space_stack.h"

#include <quoin/farfield/boundary_report.h>
#include <quoin/advice/contact_advice.h>
#include <quoin/advice/load_advice.h>
#include <quoin/advice/model_summary.h>
#include <quoin/loads/load_field.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  /** Two blocks on a base that are pushed, in plane strain. */
  Parameters good_parameters()
  {
    Parameters parameters;
    parameters.model       = two_blocks();
    parameters.model.plane = PlaneAssumption::plane_strain;
    parameters.loads       = { motion("base", "bottom", "0", "0"),
                               traction("push", "top", "1e3 * sin(pi*t)", "") };
    parameters.stages      = { stage_with({ "base", "push" }) };
    return parameters;
  }

  /** Advice about the model and stage @p stage, in one text. */
  std::string advice(const Parameters &parameters, const unsigned int stage = 0)
  {
    BlockMesh<2> mesh = make_stack(3, 2);
    const TestNodes nodes(mesh);
    const Model<2> model(nodes, parameters.model);
    std::string text;
    const State<2> state = model.initial_state();
    for (const auto &list :
         { model_advice(parameters, make_mesh_report(mesh), model, state),
           stage_advice(parameters, stage, model, state, 1e-4) })
      for (const std::string &line : list)
        text += line + "\n";
    return text;
  }

  void expect(const Parameters &parameters, const std::string &word,
              const unsigned int stage = 0)
  {
    const std::string text = advice(parameters, stage);
    EXPECT_NE(text.find(word), std::string::npos) << text;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  }
} // namespace

TEST(InputAdvice, NoneForWhatIsRight)
{
  EXPECT_EQ(advice(good_parameters()), "");
}

TEST(InputAdvice, MeshTooCoarseForItsWaves)
{
  // S waves have sqrt(1e10 / 2.4 / 2500) = 1291 m/s; edges are 1 m, for the
  // diagonals of squares do not count.
  Parameters parameters = good_parameters();
  const auto shake      = [&](const double frequency)
  {
    parameters.loads[1].components[0].value
        = TimeFunction("sin(2*pi*" + std::to_string(frequency) + "*t)", "./");
  };
  shake(240.);
  EXPECT_EQ(advice(parameters), "");
  shake(270.);
  expect(parameters, "Refine the mesh");
  // What comes to rest has no waves.
  parameters.stages[0].damping = DampingType::local;
  EXPECT_EQ(advice(parameters), "");
}

TEST(InputAdvice, FrequenciesAreThoseOfVelocities)
{
  // Of the velocity of a pulse exp(-(t/w)^2) 99 % of the energy is below
  // sqrt(11.345) / (2 pi w), as in the tests of SignalFrequency, and of that
  // pulse as a velocity below sqrt(6.635) / (2 pi w); to a hertz, as in 1 s.
  const double w        = 0.02;
  Parameters parameters = good_parameters();
  parameters.loads[0] = motion("base", "bottom", "exp(-((t-0.5)/0.02)^2)", "0");
  EXPECT_NEAR(fastest_load(parameters, 0).frequency,
              std::sqrt(6.635) / (2. * M_PI * w), 1.);
  parameters.loads[0].components[0].quantity = LoadQuantity::displacement;
  const Shaking shaking                      = fastest_load(parameters, 0);
  EXPECT_EQ(shaking.name, "the load base");
  EXPECT_NEAR(shaking.frequency, std::sqrt(11.345) / (2. * M_PI * w), 1.);
  // A pulse of gravity is the derivative of a velocity.
  parameters.loads[0]
      = gravity("-2 * (t-0.5) / 0.02^2 * exp(-((t-0.5)/0.02)^2)", "");
  parameters.stages[0].loads = { "gravity" };
  EXPECT_NEAR(fastest_load(parameters, 0).frequency,
              std::sqrt(6.635) / (2. * M_PI * w), 1.);
}

TEST(InputAdvice, ForcesThatJump)
{
  Parameters parameters = good_parameters();
  auto &push            = parameters.loads[1].components[0].value;
  push                  = TimeFunction("1e3", "./");
  expect(parameters, "jumps by 1000 at 0 s");
  push = TimeFunction("if(t < 0.25, 1e3 * t, 2e3 * t)", "./");
  EXPECT_EQ(advice(parameters), ""); // by less than a fifth
  push = TimeFunction("if(t < 0.25, 0, 2e3 * t)", "./");
  expect(parameters, "jumps by 500 at 0.25 s");
  // The same force by another load in the stage before.
  push                   = TimeFunction("1e3", "./");
  StageParameters before = parameters.stages[0];
  parameters.loads.push_back(traction("ramp", "top", "1e3 * t", ""));
  before.loads = { "base", "ramp" };
  parameters.stages.insert(parameters.stages.begin(), before);
  EXPECT_EQ(advice(parameters, 1), "");
  parameters.stages[0].duration = 0.5;
  expect(parameters, "jumps by 500 at 0 s", 1);
  parameters.stages.erase(parameters.stages.begin());
  parameters.stages[0].damping               = DampingType::rayleigh;
  parameters.stages[0].stiffness_coefficient = 1e-5;
  EXPECT_EQ(advice(parameters), "");
}

TEST(InputAdvice, LocalDampingOfWavesThatComeIn)
{
  Parameters parameters                      = good_parameters();
  parameters.loads[1].type                   = LoadType::viscous_boundary;
  parameters.loads[1].components[0].quantity = LoadQuantity::velocity;
  const auto wave                            = [&](const std::string &velocity)
  { parameters.loads[1].components[0].value = TimeFunction(velocity, "./"); };
  wave("1e3 * sin(pi*t)");
  expect(parameters, "particle velocity comes to 1000 m/s");
  wave("sin(pi*t)");
  EXPECT_EQ(advice(parameters), "");
  parameters.stages[0] = stage_with({ "base", "push" }, DampingType::local);
  expect(parameters, "waves come in");
}

TEST(InputAdvice, GravityThatBeginsAnewOrTwice)
{
  for (const std::string weight :
       { "-9.81 * min(1, t / 0.5)", "-9.81 * min(1, T / 0.5)", "-9.81" })
  {
    Parameters parameters = good_parameters();
    parameters.loads.push_back(gravity("", weight));
    parameters.stages[0].name = "settle";
    parameters.stages[0].loads.push_back("gravity");
    parameters.stages.push_back(parameters.stages[0]);
    parameters.stages[1].name = "shake";
    const std::string text    = advice(parameters);
    EXPECT_EQ(text.find("stage shake: the load gravity begins anew at 0 m/s^2, "
                        "after -9.81 in stage settle")
                  != std::string::npos,
              weight == "-9.81 * min(1, t / 0.5)")
        << text;
  }
  Parameters parameters = good_parameters();
  parameters.stages[0].loads.push_back("gravity");
  parameters.stages[0].loads.push_back("other");
  for (const std::string name : { "gravity", "other" })
  {
    parameters.loads.push_back(gravity("", "-9.81"));
    parameters.loads.back().name = name;
  }
  EXPECT_NE(advice(parameters).find("the loads gravity and other are the same"),
            std::string::npos);
  parameters.loads.back() = gravity("9.81", "");
  EXPECT_EQ(advice(parameters).find("are the same"), std::string::npos);
}

TEST(InputAdvice, RecordsThatEndInMotion)
{
  Parameters parameters = good_parameters();
  const auto ends       = [&](const std::string &velocity)
  {
    parameters.loads[0] = motion("base", "bottom", velocity, "0");
    return advice(parameters).find("stays at ") != std::string::npos;
  };
  EXPECT_TRUE(ends("if(t < 0.45, sin(4*pi*t), -0.5878)"));
  EXPECT_FALSE(ends("if(t < 0.5, sin(4*pi*t), 0)"));
  EXPECT_FALSE(ends("min(1, t / 0.1)"));
  EXPECT_FALSE(ends("0"));
}

TEST(InputAdvice, MassProportionalDampingOnMovingGround)
{
  Parameters parameters = good_parameters();
  parameters.loads[0]   = motion("base", "bottom", "sin(4*pi*t)", "0");
  const auto is_warned  = [&]()
  {
    return advice(parameters).find("'Rayleigh mass coefficient' resists")
           != std::string::npos;
  };
  parameters.stages[0].damping               = DampingType::rayleigh;
  parameters.stages[0].stiffness_coefficient = 1e-5;
  EXPECT_FALSE(is_warned());
  parameters.stages[0].mass_coefficient = 3.;
  EXPECT_TRUE(is_warned());
  parameters.loads[0] = motion("base", "bottom", "0", "0");
  EXPECT_FALSE(is_warned());
}

TEST(InputAdvice, RowsFartherApartThanTheRun)
{
  Parameters parameters = good_parameters();
  parameters.histories.emplace_back();
  parameters.history_interval = 0.5;
  EXPECT_EQ(advice(parameters), "");
  parameters.history_interval = 2.;
  expect(parameters, "is longer than the run");
}

TEST(InputAdvice, WhatTakesAStagesMotionAway)
{
  Parameters parameters = good_parameters();

  // A dashpot on a curve that is held; on rollers it still works along them.
  parameters.loads.push_back(viscous("open", "bottom"));
  parameters.stages[0].loads.push_back("open");
  expect(parameters, "the load open there does nothing");
  parameters.loads[0] = motion("base", "bottom", "", "0");
  EXPECT_EQ(advice(parameters), "");
}

TEST(InputAdvice, WeightThatAStageForgets)
{
  Parameters parameters    = good_parameters();
  StageParameters before   = parameters.stages[0];
  before.name              = "settle";
  before.damping           = DampingType::local;
  before.local_coefficient = 0.8;
  before.loads             = { "base", "gravity" };
  parameters.loads.push_back(gravity("0", "-9.81"));
  parameters.stages.insert(parameters.stages.begin(), before);
  expect(parameters, "becomes weightless", 1);
  parameters.stages[1].loads.push_back("gravity");
  EXPECT_EQ(advice(parameters, 1), "");
}

TEST(InputAdvice, JointsAndMaterials)
{
  Parameters parameters = good_parameters();
  // E/h is 1e10 Pa/m, E/L 1e10 / sqrt(13).
  CoulombLaw &law      = coulomb_law(parameters.model.joints[0]);
  law.normal_stiffness = 1.1e12;
  expect(parameters, "times E/h");
  law.normal_stiffness = 2e6;
  expect(parameters, "thousandth");
  law.normal_stiffness   = 3e19;
  parameters.is_implicit = true;
  expect(parameters, "rounding");
  // Joints that fail one after the other need softer ones.
  law.normal_stiffness = 31. * 1e10 / std::sqrt(13.);
  EXPECT_EQ(advice(parameters), "");
  law.peak.tension = law.residual.tension = 0.;
  law.peak.friction = law.residual.friction = 0.6;
  expect(parameters, "the run may not finish");
  law.normal_stiffness = 29. * 1e10 / std::sqrt(13.);
  EXPECT_EQ(advice(parameters), "");
  // One block of two that is soft is what is named.
  parameters.model.materials[1].elastic.young = 0.9e10;
  expect(parameters, "material upper: E/L of its softest block");
  parameters.model.materials[1].elastic.young = 1e10;
  law                                         = CoulombLaw();
  law.shear_stiffness                         = 1e10;
  parameters.is_implicit                      = false;
  law.normal_stiffness                        = 2e10;
  // A curve on the outside has no joint.
  parameters.model.joints.push_back(elastic_joint(1e10, 1e10, "sides"));
  expect(parameters, "act on nothing");
  parameters.stages[0].joint_properties = { { "joint", "sides" } };
  EXPECT_EQ(advice(parameters), "");

  parameters                                    = good_parameters();
  parameters.model.materials[1].elastic.poisson = 0.47;
  expect(parameters, "lock");
  parameters.cells.kind = TriangleKind::crossed;
  EXPECT_EQ(advice(parameters), "");
}

TEST(InputAdvice, OutputThatIsTooFrequent)
{
  Parameters parameters     = good_parameters();
  parameters.field_interval = 1e-5;
  expect(parameters, "writes fields");
  parameters.field_interval   = 0.;
  parameters.history_interval = 1e-5;
  expect(parameters, "shorter than the time step");
}

TEST(InputAdvice, BoundaryElementsTooLong)
{
  const Shaking shaking{ "the incident wave w", 100. };
  EXPECT_TRUE(element_advice(shaking, 2000., 3.9, false).empty());
  EXPECT_EQ(element_advice(shaking, 2000., 4.1, false).size(), 1U);
  EXPECT_TRUE(element_advice({}, 2000., 4.1, false).empty());
}

TEST(InputAdvice, BoundaryElementsTooLongForStress)
{
  // S waves of 20 m.
  const Shaking shaking{ "the incident wave w", 100. };
  EXPECT_TRUE(element_advice(shaking, 2000., 1.6, true).empty());
  EXPECT_TRUE(element_advice(shaking, 2000., 2., false).empty());
  const auto advice = element_advice(shaking, 2000., 2., true);
  ASSERT_EQ(advice.size(), 1U);
  EXPECT_NE(advice[0].find("too low by about 5 %"), std::string::npos)
      << advice[0];
  EXPECT_NE(advice[0].find("elements of 1 m"), std::string::npos) << advice[0];
  // Too long for displacements, too: that is said.
  const auto too_long = element_advice(shaking, 2000., 4.1, true);
  ASSERT_EQ(too_long.size(), 1U);
  EXPECT_NE(too_long[0].find("eight to ten"), std::string::npos);
}

TEST(InputAdvice, BendingWithFewCellsAcross)
{
  // A cantilever, held at its left end.
  MeshData<2> data = grid(12, 2, "lower", 0., 0.);
  add_curve(data, "bottom", 0., 0., 0., 2.);
  add_curve(data, "top", 0., 2., 12., 2.);
  BlockMesh<2> mesh     = split_into_blocks(data, {});
  Parameters parameters = good_parameters();
  parameters.model.joints.clear();
  parameters.model.materials.resize(1);
  const TestNodes nodes(mesh);
  const auto warns = [&]()
  {
    const Model<2> model(nodes, parameters.model);
    const Advice all = model_advice(parameters, make_mesh_report(mesh), model,
                                    model.initial_state());
    return std::any_of(all.begin(), all.end(),
                       [](const std::string &line)
                       {
                         return line.find("about 2 linear triangles across")
                                    != std::string::npos
                                && line.find("39 %") != std::string::npos;
                       });
  };
  EXPECT_FALSE(warns()) << "pulled along";
  EXPECT_EQ(bending_lines(parameters, make_mesh_report(mesh), { 0 }).size(),
            1U);
  parameters.loads[1] = traction("push", "top", "0", "1e3");
  EXPECT_TRUE(warns());
  parameters.loads[1].boundaries = { "bottom" };
  EXPECT_FALSE(warns()) << "loaded at its end";
  parameters.loads[1] = gravity("-9.81", "0");
  EXPECT_FALSE(warns()) << "upright";
  parameters.loads[1] = gravity("0", "-9.81");
  EXPECT_TRUE(warns());
  parameters.cells = TriangleKind::crossed;
  EXPECT_FALSE(warns());
  parameters.cells                      = TriangleKind::plain;
  parameters.loads[0].boundaries.back() = "top";
  EXPECT_FALSE(warns()) << "bedded";
  parameters.loads[0].boundaries.back() = "bottom";
  parameters.model.materials[0].rigid   = true;
  EXPECT_TRUE(bending_lines(parameters, make_mesh_report(mesh), { 0 }).empty());
}

TEST(InputAdvice, GroundThatHasMovedBelowWater)
{
  // Two blocks, from 0 to 4 m, in water up to 3 m.
  Parameters parameters   = good_parameters();
  LoadParameters water    = traction("water", "sides", "", "");
  water.pressure.quantity = LoadQuantity::force;
  const auto press        = [&](const std::string &pressure)
  {
    water.pressure.field = std::make_shared<LoadField>(
        SpaceTimeFunction(pressure, "./", 3, true));
    parameters.loads[1] = water;
  };
  press("9810*max(0, 3*min(1, t) - y)");
  parameters.stages[0].loads = { "base", "water" };
  const BlockMesh<2> mesh    = make_stack(3, 2);
  const TestNodes nodes(mesh);
  const auto warnings = [&](const double displacement)
  {
    Advice advice;
    check_moved_water<2>(parameters, 0, 1.5, displacement, nodes, advice);
    return advice;
  };
  // The highest place of the mesh below water is at 2 m.
  EXPECT_TRUE(warnings(0.0099).empty());
  ASSERT_EQ(warnings(0.0101).size(), 1U);
  EXPECT_EQ(warnings(0.0101)[0].find("stage stage: the ground has moved by "
                                     "0.0101 m where it comes to rest at the "
                                     "factor 1.5, and the load water, whose "
                                     "pressure is that of water, presses"),
            0U);
  press("5000*max(0, 3 - y)");
  EXPECT_TRUE(warnings(1.).empty()) << "no water";
  water.pressure.field = std::make_shared<LoadField>(TimeFunction("3", "./"));
  parameters.loads[1]  = water;
  EXPECT_TRUE(warnings(1.).empty()) << "follows the ground";
  press("9810*max(0, 3 - y)");
  parameters.stages[0].loads = { "base" };
  EXPECT_TRUE(warnings(1.).empty()) << "left out";
}

TEST(ModelSummary, SaysWhatThereIs)
{
  const Parameters parameters = good_parameters();
  BlockMesh<2> mesh           = make_stack(3, 2);
  const TestNodes nodes(mesh);
  const Model<2> model(nodes, parameters.model);
  const auto materials = material_lines<2>(
      parameters, nodes, model.properties().material_of_group);
  ASSERT_EQ(materials.size(), 2U);
  EXPECT_EQ(materials[0],
            "material lower: 1 block, 12 triangles; elastic, E 1e+10 Pa, nu "
            "0.2, density 2500 kg/m^3, P waves 2108 m/s, S waves 1291 m/s");
  const auto joints = joint_lines(parameters, make_mesh_report(mesh));
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_EQ(joints[0],
            "joints joint: 3 m; elastic, kn 2e+10 Pa/m, ks 1e+10 Pa/m");
  const auto faces = face_lines<2>(parameters, nodes);
  ASSERT_EQ(faces.size(), 1U);
  EXPECT_EQ(faces[0], "joints joint: 3 faces between two blocks, which while "
                      "they are closed make a joint 22.2 % too stiff when its "
                      "blocks rotate");
  const auto loads = load_lines<2>(parameters, nodes);
  ASSERT_EQ(loads.size(), 2U);
  EXPECT_EQ(loads[0], "load base: prescribed motion on 4 nodes of bottom, "
                      "horizontal 0 m/s, vertical 0 m/s");
  EXPECT_EQ(loads[1], "load push: traction on 4 nodes of top, horizontal from "
                      "0 to 1000 Pa");
  EXPECT_EQ(parameters.stages[0].text(false),
            "stage stage: loads base, push; lasts 1 s; no damping");
}

TEST(ModelSummary, PeaksOfPulsesThatAreMuchShorterThanTheirStage)
{
  Parameters parameters = good_parameters();
  parameters.loads[1]   = traction(
        "push", "top", "pulse exponential 1e-4 2e-3 0.7 times -5e6", "");
  parameters.stages[0].duration = 20.;
  const BlockMesh<2> mesh       = make_stack(3, 2);
  const auto loads              = load_lines<2>(parameters, TestNodes(mesh));
  ASSERT_EQ(loads.size(), 2U);
  EXPECT_EQ(loads[1], "load push: traction on 4 nodes of top, horizontal from "
                      "-5e+06 to 0 Pa");
}

TEST(ModelSummary, FacesOfJointsInThreeDimensions)
{
  // Two squares of two triangles.
  const quoin::test::space_stack::Stack stack(
      quoin::test::space_stack::elastic(), 2);
  Parameters parameters;
  parameters.model.joints = { quoin::test::space_stack::set_of(
      quoin::test::space_stack::elastic()) };
  const auto faces        = face_lines<3>(parameters, stack.nodes);
  ASSERT_EQ(faces.size(), 1U);
  EXPECT_EQ(faces[0], "joints joint: 4 faces between two blocks, which while "
                      "they are closed make a joint 215.1 % too stiff when its "
                      "blocks rotate");
}

TEST(ModelSummary, FewFacesBetweenRigidBlocks)
{
  Parameters parameters = good_parameters();
  const TestNodes few(make_stack(3, 2)), many(make_stack(5, 2));
  EXPECT_TRUE(rigid_face_lines<2>(parameters, few).empty());
  LoadParameters platen;
  platen.name   = "foot";
  platen.type   = LoadType::platen;
  platen.groups = { "lower" };
  parameters.loads.push_back(platen);
  EXPECT_TRUE(rigid_face_lines<2>(parameters, few).empty());
  platen.name   = "head";
  platen.groups = { "upper" };
  parameters.loads.push_back(platen);
  const auto lines = rigid_face_lines<2>(parameters, few);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("'joint' has 3 faces"), std::string::npos);
  EXPECT_NE(lines[0].find("22.2 % too stiff"), std::string::npos);
  EXPECT_NE(lines[0].find("too little, up to 18.2 %"), std::string::npos);
  EXPECT_TRUE(rigid_face_lines<2>(parameters, many).empty());
}

TEST(ModelSummary, LoadsWhoseFactorIsSought)
{
  Parameters parameters        = good_parameters();
  parameters.loads[1]          = traction("push", "top", "1e3", "");
  parameters.stages[0].loads   = { "base" };
  parameters.stages[0].pattern = PatternParameters{ { "push" }, {}, {} };
  BlockMesh<2> mesh            = make_stack(3, 2);
  const auto loads             = load_lines<2>(parameters, TestNodes(mesh));
  ASSERT_EQ(loads.size(), 2U);
  EXPECT_EQ(loads[1], "load push: traction on 4 nodes of top, horizontal 1000 "
                      "Pa, times the factor that stage stage seeks");
}

namespace
{
  /** Warnings about two blocks of 1 m, 10 mm apart, of 2500 kg, whose contacts
      have 1e7 Pa/m: 1250 kg on a spring of 1e7 N/m, 89.4 rad/s. */
  Advice soft_contacts(const Agitation &loads)
  {
    BlockMesh<2> mesh
        = make_blocks({ { 0., 0., 1., 1., 2, 2 }, { 1.01, 0., 1., 1., 3, 3 } });
    ModelParameters parameters;
    parameters.plane     = PlaneAssumption::plane_stress;
    parameters.materials = { material("stone") };
    parameters.joints    = { touching() };
    coulomb_law(parameters.joints[0]).normal_stiffness = 1e7;
    parameters.large_displacements                     = true;
    parameters.contact.large_displacements             = true;
    const TestNodes nodes(mesh, parameters.materials);
    const Model<2> model(nodes, parameters);
    Advice advice;
    Checks checks(advice, "");
    check_soft_contacts(model, model.initial_state(), loads, checks);
    const auto lines = contact_lines(model, model.initial_state());
    EXPECT_EQ(lines.back(),
              "2 blocks have a gap beside, 0.01 m wide, half of them below "
              "0.01 m");
    return advice;
  }
} // namespace

TEST(ModelSummary, SlenderBlocksInJointsAreNoneOfCoarseOnes)
{
  // Of 2 m of faces this much is no joint.
  const auto n_coarse
      = [](const double outer, const bool is_rigid, const TriangleKind kind)
  {
    Parameters parameters               = good_parameters();
    parameters.cells.kind               = kind;
    parameters.model.materials[0].rigid = is_rigid;
    SlenderBlock block;
    block.faces = 2.;
    block.outer = { { "left", 0.25 * outer }, { "", 0.75 * outer } };
    MeshReport report;
    report.slender   = { block };
    const auto found = coarse_slender_blocks(parameters, report,
                                             std::vector<unsigned int>{ 0 });
    return found.size();
  };
  EXPECT_EQ(n_coarse(2., false, TriangleKind::plain), 1U);
  EXPECT_EQ(n_coarse(1.52, false, TriangleKind::plain), 1U);
  EXPECT_EQ(n_coarse(1.48, false, TriangleKind::plain), 0U);
  EXPECT_EQ(n_coarse(0., false, TriangleKind::plain), 0U);
  EXPECT_EQ(n_coarse(2., true, TriangleKind::plain), 0U);
  EXPECT_EQ(n_coarse(2., false, TriangleKind::quadratic), 0U);
}

TEST(ContactAdvice, OverlapAgainstGaps)
{
  // At 0.08 m/s 0.894 mm, at 0.1 m/s 1.118 mm.
  EXPECT_TRUE(soft_contacts({ {}, 0.08, 0. }).empty());
  const Advice fast = soft_contacts({ {}, 0.1, 0. });
  ASSERT_EQ(fast.size(), 1U);
  EXPECT_NE(fast[0].find("overlap by 0.001118 m"), std::string::npos)
      << fast[0];
  EXPECT_NE(fast[0].find("1.25 times"), std::string::npos) << fast[0];
  // Through 10 mm at 0.1 m/s^2: 0.0447 m/s. Their weight: 25 microns.
  EXPECT_TRUE(soft_contacts({ {}, 0., 0.1 }).empty());
  // 0.447 m/s: 5 mm, and 2.5 mm by the weight of 1 m.
  const Advice heavy = soft_contacts({ {}, 0., 10. });
  ASSERT_EQ(heavy.size(), 2U);
  EXPECT_NE(heavy[0].find("overlap by 0.005 m"), std::string::npos) << heavy[0];
  EXPECT_NE(heavy[1].find("close by 0.0025 m"), std::string::npos) << heavy[1];
}

TEST(ContactAdvice, PeriodOfTheLoad)
{
  // A contact of pi/89.4 s = 0.0351 s.
  EXPECT_TRUE(soft_contacts({ { "the load push", 2.8 }, 0., 0. }).empty());
  const Advice advice = soft_contacts({ { "the load push", 2.9 }, 0., 0. });
  ASSERT_EQ(advice.size(), 1U);
  EXPECT_NE(advice[0].find("a tenth of the shortest period of the load push"),
            std::string::npos)
      << advice[0];
}

TEST(ContactAdvice, ContactsAgainstBlocks)
{
  // E/L is 1e10 Pa/m.
  for (const double kn : { 0.9e7, 1.1e7 })
  {
    ModelParameters parameters;
    parameters.materials                               = { material("stone") };
    parameters.joints                                  = { touching() };
    coulomb_law(parameters.joints[0]).normal_stiffness = kn;
    parameters.large_displacements                     = true;
    const TestNodes nodes(make_blocks({ { 0., 0., 1., 1., 2, 2 } }),
                          parameters.materials);
    const Model<2> model(nodes, parameters);
    Advice advice;
    check_contacts(model, advice);
    ASSERT_EQ(advice.size(), kn < 1e7 ? 1U : 0U);
    for (const std::string &line : advice)
      EXPECT_NE(line.find("hardly deform"), std::string::npos) << line;
  }
}
