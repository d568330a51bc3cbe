// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../model/test_models.h"
#include "../output/temporary_directory.h"

#include <quoin/problems/planned_output.h>
#include <quoin/results/field_output.h>
#include <quoin/results/measurements.h>

#include <filesystem>

using namespace quoin;
using namespace quoin::test;

TEST(CostEstimate, CountsMomentsAndRows)
{
  Parameters parameters;
  parameters.model            = two_blocks();
  parameters.loads            = { motion("base", "bottom", "0", "0") };
  parameters.stages           = { stage_with({ "base" }) };
  parameters.field_interval   = 0.25;
  parameters.history_interval = 0.01;
  PlannedOutput planned       = planned_output(parameters, { 1e-4 });
  EXPECT_EQ(planned.fields, 5U);
  EXPECT_EQ(planned.rows, 101U);
  EXPECT_FALSE(planned.is_least);
  parameters.history_interval        = 0.;
  parameters.stages[0].kinetic_limit = 0.1;
  planned                            = planned_output(parameters, { 1e-3 });
  EXPECT_EQ(planned.rows, 1001U);
  EXPECT_TRUE(planned.is_least);
}

TEST(CostEstimate, FieldsAreAsLargeAsTheyAreWritten)
{
  ModelParameters parameters = two_blocks();
  for (const bool yields : { false, true })
  {
    if (yields)
    {
      parameters.materials[0].strength = MohrCoulombStrength();
      CompositeLaw law;
      law.normal_stiffness = law.shear_stiffness = 1e10;
      parameters.joints[0].law                   = law;
    }
    const TestNodes nodes(make_stack(60, 40));
    const Model<2> model(nodes, parameters);
    const TemporaryDirectory directory;
    BlockOutput blocks(directory.path(), MPI_COMM_SELF);
    JointOutput joints(directory.path(), MPI_COMM_SELF);
    blocks.start();
    joints.start();
    blocks.write(0., block_fields(model, model.initial_state()));
    joints.write(0., joint_fields(model, model.initial_state()));
    double written = 0.;
    for (const auto &file :
         std::filesystem::recursive_directory_iterator(directory.path()))
      if (file.is_regular_file())
        written += double(file.file_size());
    EXPECT_NEAR(bytes_of_fields(model), written, 0.01 * written);
  }
}

TEST(CostEstimate, Texts)
{
  EXPECT_EQ(bytes_text(400.), "1 kB");
  EXPECT_EQ(bytes_text(12345.), "12.3 kB");
  EXPECT_EQ(bytes_text(2.34e9), "2.3 GB");
  EXPECT_EQ(seconds_text(0.1234), "0.12 s");
}
