// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../output/temporary_directory.h"

#include <quoin/base/exceptions.h>
#include <quoin/results/block_output.h>
#include <quoin/results/joint_output.h>
#include <quoin/output/json_file.h>

#include <nlohmann/json.hpp>

#include <cmath>

using namespace quoin;

TEST(PrincipalStress, RebuildsTheTensor)
{
  const double states[][3]
      = { { 1., 2., 3. }, { -5e6, 2e6, 0. }, { 2e6, -5e6, 0. },
          { 4., 4., 0. }, { 0., 0., -1. },   { 1., 1. + 1e-14, 1e-15 } };
  for (const auto &state : states)
  {
    const PrincipalStress<2> p = principal_stress(
        std::array<double, 4>{ { state[0], state[1], state[2], 0. } });
    const auto &[s1, s2] = p.value;
    const auto &[a, b]   = p.direction;
    const double scale   = std::abs(s1) + std::abs(s2);
    EXPECT_GE(s1, s2);
    EXPECT_NEAR(std::hypot(a[0], a[1]), 1., 1e-15);
    EXPECT_NEAR(a[0] * b[0] + a[1] * b[1], 0., 1e-15);
    EXPECT_NEAR(s1 * a[0] * a[0] + s2 * b[0] * b[0], state[0], 1e-14 * scale);
    EXPECT_NEAR(s1 * a[1] * a[1] + s2 * b[1] * b[1], state[1], 1e-14 * scale);
    EXPECT_NEAR(s1 * a[0] * a[1] + s2 * b[0] * b[1], state[2], 1e-14 * scale);
  }
}

TEST(PrincipalStress, RebuildsTheTensorInSpace)
{
  const std::array<double, 6> states[] = { { { 1., 2., 3., 4., 5., 6. } },
                                           { { -5e6, 2e6, 1e6, 0., 0., 0. } },
                                           { { 3., 3., 3., 0., 0., 0. } },
                                           { { 0., 0., 0., -1., 0., 2. } } };
  constexpr unsigned int index[3][3]
      = { { 0, 3, 4 }, { 3, 1, 5 }, { 4, 5, 2 } };
  for (const auto &state : states)
  {
    const PrincipalStress<3> p = principal_stress(state);
    EXPECT_GE(p.value[0], p.value[1]);
    EXPECT_GE(p.value[1], p.value[2]);
    const double scale = std::abs(p.value[0]) + std::abs(p.value[2]);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
      {
        double entry = 0.;
        for (unsigned int k = 0; k < 3; ++k)
          entry += p.value[k] * p.direction[k][i] * p.direction[k][j];
        EXPECT_NEAR(entry, state[index[i][j]], 1e-14 * scale);
      }
  }
}

TEST(JointOutput, WorstState)
{
  using S = JointState;
  EXPECT_EQ(worst(S::intact, S::slipped), S::slipped);
  EXPECT_EQ(worst(S::slipping, S::slipped), S::slipping);
  EXPECT_EQ(worst(S::slipping, S::open), S::open);
  EXPECT_EQ(worst(S::intact, S::intact), S::intact);
}

TEST(BlockOutput, SeriesOfFiles)
{
  const TemporaryDirectory directory;
  BlockFields<2> fields;
  fields.position     = { dealii::Point<2>(0., 0.), dealii::Point<2>(1., 0.),
                          dealii::Point<2>(0., 1.) };
  fields.displacement = { dealii::Point<2>(0., 0.), dealii::Point<2>(.1, 0.),
                          dealii::Point<2>(0., 0.) };
  fields.velocity     = fields.displacement;
  fields.cells        = { { { 0, 1, 2 } } };
  fields.stress       = { { { 1., 2., 3., 0. } } };
  fields.strain       = { { { .1, .2, .3 } } };
  fields.block        = { 0 };
  fields.material     = { 1 };

  BlockOutput output(directory.path(), MPI_COMM_SELF);
  output.start();
  output.write(0., fields);
  output.write(0.25, fields);
  EXPECT_EQ(output.n_written(), 2U);
  EXPECT_TRUE(std::filesystem::exists(directory / "fields/blocks_0001_0.vtu"));
  EXPECT_NE(contents(directory / "blocks.pvd")
                .find("timestep=\"0.25\" part=\"0\" "
                      "file=\"fields/blocks_0001_0.vtu\""),
            std::string::npos);
}

TEST(JointOutput, SeriesOfFiles)
{
  const TemporaryDirectory directory;
  JointFields fields;
  fields.position     = { dealii::Point<2>(0., 0.), dealii::Point<2>(3., 4.) };
  fields.displacement = { dealii::Point<2>(1., 0.), dealii::Point<2>(1., 0.) };
  fields.opening      = { 0., 1e-3 };
  fields.slip         = { 0., 0. };
  fields.normal_traction = { -1., 0. };
  fields.shear_traction  = { 0., 0. };
  fields.state           = { JointState::intact, JointState::open };
  fields.joint_set       = { 2 };
  fields.handed_over     = { 0 };

  JointOutput output(directory.path(), MPI_COMM_SELF);
  output.start();
  output.write(0., fields);
  EXPECT_TRUE(std::filesystem::exists(directory / "fields/joints_0000_0.vtu"));
}

TEST(BlockOutput, UnwritableDirectory)
{
  const TemporaryDirectory directory;
  std::ofstream(directory / "file") << "not a directory";
  BlockOutput output(directory / "file", MPI_COMM_SELF);
  EXPECT_THROW(output.start(), RunError);
}

TEST(JsonFile, RoundTrip)
{
  const TemporaryDirectory directory;
  nlohmann::ordered_json object;
  object["energy residual"] = 1e-12;
  object["steps"]           = 5;
  object["ratio"]           = std::nan("");
  write_json(directory / "summary.json", object);
  const nlohmann::ordered_json back
      = nlohmann::ordered_json::parse(contents(directory / "summary.json"));
  EXPECT_EQ(back["steps"], 5);
  EXPECT_EQ(back["energy residual"], 1e-12);
  EXPECT_TRUE(back["ratio"].is_null());
  EXPECT_EQ(std::next(back.begin()).key(), "steps"); // the order is kept
  EXPECT_THROW(write_json(directory / "summary.json/x.json", object), RunError);
}
