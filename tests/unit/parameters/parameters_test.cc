// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "../output/temporary_directory.h"

#include <quoin/parameters/parameters.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>

using namespace quoin;

namespace
{
  const std::string good = R"(
set Title = A wall
set Plane assumption = plane stress
set Thickness = 0.1
set Output directory = results
subsection Mesh
  set File = wall.msh
  set Joints along = bed, head
  set Joints between = rock:brick
  set Joint ends inside blocks = refuse
end
subsection Materials
  set Names = brick, rock
  subsection brick
    set Groups = units, halves
    set Density = 1900
    set Young's modulus = 16.7e9
    set Poisson's ratio = 0.15
  end
  subsection rock
    set Density = 2700
    set Young's modulus = 30e9
    set Poisson's ratio = 0.25
  end
end
subsection Joints
  set Names = bed
  subsection bed
    set Normal stiffness = 82e9
    set Shear stiffness = 36e9
    set Friction angle = 30
  end
end
subsection Time stepping
  set Share of critical time step = 0.5
  set Time step = 1e-6
end
subsection Loads
  set Names = base, insitu, pull
  subsection base
    set Type = prescribed motion
    set Boundary = bottom
    set Horizontal = 0
    set Vertical = 0
  end
  subsection insitu
    set Type = initial stress
    set Stress = -1e6, -2e6, 0
  end
  subsection pull
    set Type = traction
    set Boundary = top
    set Vertical = 1e6 * t
  end
end
subsection Stages
  set Names = preload, shear, rest
  subsection preload
    set Loads = base
    set Duration = 0.25
  end
  subsection shear
    set Loads = base, pull
    set Duration = 0.5
    set Start time = 0.25
    set Damping = local
  end
  subsection rest
    set Loads = base
    set End = static ratio
    set Start time = 0.75
    set Damping = local
  end
end
subsection Histories
  set Names = ux, fy
  set Interval = 1e-3
  subsection ux
    set Quantity = displacement x
    set Point = 0.5, 1
  end
  subsection fy
    set Quantity = reaction y
    set Load = base
  end
end
subsection Output
  set Field interval = 0.1
  set Checkpoint interval = 5
end
)";

  /** A folder with a parameter file and the mesh it names. */
  struct Case
  {
    TemporaryDirectory directory;
    std::string file;

    explicit Case(const std::string &text) : file(directory / "case.prm")
    {
      std::ofstream(file) << text;
      std::ofstream(directory / "wall.msh") << "$MeshFormat\n";
    }

    Parameters read(const std::vector<std::string> &overrides = {}) const
    {
      return read_parameters(file, overrides);
    }
  };

  std::string with(const std::string &from, const std::string &to)
  {
    std::string text        = good;
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
  }

  /** The refusal must hold the file's name and all @p parts. */
  void expect_refused(const std::string &text,
                      const std::vector<std::string> &parts,
                      const std::vector<std::string> &overrides = {})
  {
    const Case it(text);
    const std::string message
        = message_of<InputError>([&] { it.read(overrides); });
    EXPECT_NE(message.find(it.file), std::string::npos) << message;
    for (const std::string &part : parts)
      EXPECT_NE(message.find(part), std::string::npos)
          << "'" << part << "' is not in: " << message;
  }
} // namespace

TEST(Parameters, GoodFile)
{
  const Case it(good);
  const Parameters p       = it.read();
  const std::string folder = it.directory.path() + "/";
  EXPECT_EQ(p.file, it.file);
  EXPECT_EQ(p.title, "A wall");
  EXPECT_EQ(p.output_directory, folder + "results");
  EXPECT_EQ(p.mesh_file, folder + "wall.msh");
  EXPECT_EQ(p.split.joints_along, (std::vector<std::string>{ "bed", "head" }));
  ASSERT_EQ(p.split.joints_between.size(), 1U);
  EXPECT_EQ(p.split.joints_between[0],
            std::make_pair(std::string("rock"), std::string("brick")));
  EXPECT_FALSE(p.split.between_all);
  EXPECT_EQ(p.split.joint_ends, SplitOptions::refuse);

  EXPECT_EQ(p.model.plane, PlaneAssumption::plane_stress);
  EXPECT_EQ(p.model.thickness, 0.1);
  ASSERT_EQ(p.model.materials.size(), 2U);
  EXPECT_EQ(p.model.materials[0].groups,
            (std::vector<std::string>{ "units", "halves" }));
  EXPECT_EQ(p.model.materials[0].elastic.density, 1900.);
  EXPECT_EQ(p.model.materials[0].elastic.young, 16.7e9);
  EXPECT_EQ(p.model.materials[0].elastic.poisson, 0.15);
  EXPECT_EQ(p.model.materials[1].groups, (std::vector<std::string>{ "rock" }));
  ASSERT_EQ(p.model.joints.size(), 1U);
  EXPECT_EQ(stiffness_bound(p.model.joints[0].law)[0], 82e9);
  ASSERT_EQ(p.model.initial_stresses.size(), 1U);
  EXPECT_EQ(p.model.initial_stresses[0].stress[1], -2e6);

  EXPECT_EQ(p.loads.size(), 3U);
  ASSERT_EQ(p.stages.size(), 3U);
  EXPECT_EQ(p.stages[1].loads, (std::vector<std::string>{ "base", "pull" }));
  EXPECT_EQ(p.stages[2].end, StageEnd::static_ratio);
  EXPECT_EQ(p.share_of_critical_step, 0.5);
  EXPECT_EQ(p.time_step, 1e-6);
  ASSERT_EQ(p.histories.size(), 2U);
  EXPECT_EQ(p.histories[0].point, (std::array<double, 3>{ { 0.5, 1., 0. } }));
  EXPECT_EQ(p.histories[1].quantity, HistoryQuantity::reaction);
  EXPECT_EQ(p.histories[1].component, 1U);
  EXPECT_EQ(p.histories[1].unit, "N");
  EXPECT_EQ(p.history_interval, 1e-3);
  EXPECT_EQ(p.field_interval, 0.1);
  EXPECT_EQ(p.checkpoint_interval, 5.);
}

TEST(Parameters, UsedParametersGiveTheSameRun)
{
  const Case it(good);
  const std::string used
      = it.read({ "Thickness=0.3", "Stages/shear/Duration=0.5" }).effective;
  const Case again(used);
  const Parameters p = again.read();
  EXPECT_EQ(p.model.thickness, 0.3);
  EXPECT_EQ(p.stages.size(), 3U);
  EXPECT_EQ(stiffness_bound(p.model.joints[0].law)[1], 36e9);
  EXPECT_EQ(p.effective, used);
}

TEST(Parameters, DescriptionNamesEverySection)
{
  const std::string text = describe_parameters();
  for (const std::string part :
       { "Joints along", "Young's modulus", "Critical shear displacement",
         "Incident shear velocity", "Rayleigh stiffness coefficient",
         "kinetic energy share", "Checkpoint interval" })
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST(Parameters, RigidMaterialsNeedOnlyADensity)
{
  const Case it(with("set Young's modulus = 30e9", "set Law = rigid"));
  const Parameters p = it.read();
  EXPECT_FALSE(p.model.materials[0].rigid);
  EXPECT_TRUE(p.model.materials[1].rigid);
  EXPECT_EQ(p.model.materials[1].elastic.density, 2700.);
  EXPECT_THROW(it.read({ "Materials/rock/Density=0" }), InputError);
}

TEST(Parameters, OverridesReplaceAndExtend)
{
  const Case it(good);
  const Parameters p = it.read({ "Thickness = 0.25", "Joints/bed/Cohesion=2e6",
                                 "Stages/rest/Damping=adaptive", "Title=a=b",
                                 "Histories/Names=ux,fy,vy",
                                 "Histories/vy/Quantity=velocity y" });
  EXPECT_EQ(p.model.thickness, 0.25);
  EXPECT_EQ(std::get<CoulombLaw>(p.model.joints[0].law).peak.cohesion, 2e6);
  EXPECT_EQ(p.stages[2].damping, DampingType::adaptive);
  EXPECT_EQ(p.title, "a=b");
  ASSERT_EQ(p.histories.size(), 3U);
  EXPECT_EQ(p.histories[2].quantity, HistoryQuantity::velocity);
}

TEST(Parameters, BadOverrides)
{
  const Case it(good);
  const auto refusal = [&](const std::string &text)
  { return message_of<InputError>([&] { it.read({ text }); }); };
  for (const std::string text : { "Thickness", "Thickness 3", "", "=3", " =3" })
  {
    const std::string message = refusal(text);
    EXPECT_NE(message.find("--set '" + text + "'"), std::string::npos)
        << message;
    EXPECT_NE(message.find("Section/Name=value"), std::string::npos);
  }
  // What is wrong is on the command line, not in the file.
  for (const std::string text :
       { "Thicknes=3", "Nowhere/Thickness=3", "Loads/pull/Type=tractions" })
  {
    const std::string message = refusal(text);
    EXPECT_NE(message.find("--set"), std::string::npos) << message;
    EXPECT_NE(message.find(text), std::string::npos) << message;
  }
  expect_refused(good, { "Thickness = -3", "positive" }, { "Thickness=-3" });
}

TEST(Parameters, MissingFiles)
{
  const std::string message = message_of<InputError>(
      [] { read_parameters("no_such_folder/case.prm", {}); });
  EXPECT_NE(message.find("no_such_folder/case.prm"), std::string::npos);
  const TemporaryDirectory directory;
  EXPECT_THROW(read_parameters(directory.path(), {}), InputError);

  expect_refused(with("wall.msh", "floor.msh"),
                 { "section 'Mesh'", "File = floor.msh", "/floor.msh'" });
  expect_refused(with("set File = wall.msh", ""),
                 { "section 'Mesh'", "'File = '", ".geo or .msh" });
}

TEST(Parameters, UnknownParameter)
{
  expect_refused(with("set Density = 1900", "set Densty = 1900"),
                 { "Materials", "brick", "Densty" });
  expect_refused(with("subsection Output", "subsection Outpt"), { "Outpt" });
  // One that is listed by another name.
  expect_refused(with("set Names = bed", "set Names = beds"),
                 { "section 'Joints'", "'bed'", "'beds'", "alike" });
}

// What no name lists and no stage uses is left out, with a warning.
TEST(Parameters, WhatIsNotUsed)
{
  const auto warnings = [](const std::string &from, const std::string &to)
  { return Case(with(from, to)).read().warnings; };
  EXPECT_TRUE(Case(good).read().warnings.empty());
  const auto subsection = warnings("set Names = bed", "set Names =");
  ASSERT_EQ(subsection.size(), 1U);
  EXPECT_NE(subsection[0].find("section 'Joints': 'Names' does not list its "
                               "subsection 'bed'"),
            std::string::npos);
  const auto load = warnings("set Loads = base, pull", "set Loads = base");
  ASSERT_EQ(load.size(), 1U);
  EXPECT_NE(load[0].find("load pull: no stage uses it"), std::string::npos);
}

TEST(Parameters, ImplausibleValues)
{
  const auto warning = [](const std::string &from, const std::string &to)
  {
    const auto all = Case(with(from, to)).read().warnings;
    return all.size() == 1 ? all[0] : text_of(all.size(), " warnings");
  };
  EXPECT_EQ(warning("set Density = 1900", "set Density = 19"),
            "material brick: 'Density = 19' kg/m^3 is far less than usual: as "
            "a unit weight in kN/m^3 it would be 1937 kg/m^3. Check the unit.");
  EXPECT_EQ(
      warning("set Young's modulus = 16.7e9", "set Young's modulus = 16700"),
      "material brick: 'Young's modulus = 1.67e+04' Pa is far less than "
      "usual: in MPa it would be 1.67e+10 Pa. Check the unit.");
}

TEST(Parameters, RayleighDampingThatDoesNotAct)
{
  const std::string local = "set Damping = local",
                    mass  = "\n    set Rayleigh mass coefficient = ";
  const auto warnings     = [&](const std::string &damping,
                            const std::vector<std::string> &overrides = {})
  { return Case(with(local, damping)).read(overrides).warnings; };
  const auto idle = warnings(local + mass + "3");
  ASSERT_EQ(idle.size(), 1U);
  for (const char *part :
       { "case.prm, line ", "section 'Stages/shear'",
         "'Rayleigh mass coefficient = 3' has no effect", "'Damping = local'" })
    EXPECT_NE(idle[0].find(part), std::string::npos) << idle[0];
  const auto none = warnings("set Damping = Rayleigh");
  ASSERT_EQ(none.size(), 1U);
  EXPECT_NE(none[0].find("'Damping = Rayleigh' dissipates nothing"),
            std::string::npos);
  EXPECT_TRUE(warnings("set Damping = Rayleigh" + mass + "3").empty());
  EXPECT_TRUE(warnings(local + mass + "0").empty());
  // A file that is made for Rayleigh damping, tried with another one.
  EXPECT_TRUE(warnings("set Damping = Rayleigh" + mass + "3",
                       { "Stages/shear/Damping=none" })
                  .empty());
}

TEST(Parameters, TimesThatMayBeMilliseconds)
{
  const auto warnings = [](const unsigned int n, const double step)
  {
    const Case it(
        with("set Vertical = 1e6 * t", "set Vertical = table t.csv times 1e6"));
    std::ofstream table(it.directory / "t.csv");
    for (unsigned int k = 0; k < n; ++k)
      table << step * k << ", " << k % 2 << "\n";
    table.close();
    return it.read().warnings;
  };
  // 0.75 s and a stage that ends at rest
  ASSERT_EQ(warnings(200, 1.).size(), 1U);
  EXPECT_NE(
      warnings(200, 1.)[0].find("t.csv' go on to 199 s, but the run ends "
                                "after 0.75 s, within 1 of its 200 lines"),
      std::string::npos);
  EXPECT_TRUE(warnings(200, 0.2).empty()); // four in the run
  EXPECT_TRUE(warnings(12, 1.).empty());   // it ends not much later
  EXPECT_TRUE(warnings(5, 100.).empty());  // a slow change
}

TEST(Parameters, WrongWord)
{
  expect_refused(with("plane stress", "plane strains"),
                 { "Plane assumption", "plane strains" });
  expect_refused(with("set Type = traction", "set Type = tractions"),
                 { "Loads", "pull", "Type", "tractions" });
  expect_refused(with("set Damping = local", "set Damping = locl"),
                 { "Stages", "shear", "Damping", "locl" });
  expect_refused(with("set Quantity = reaction y", "set Quantity = reaction w"),
                 { "Histories", "fy", "Quantity", "reaction w" });
  expect_refused(with("set Density = 1900", "set Density = heavy"),
                 { "Materials", "brick", "Density", "heavy" });
}

TEST(Parameters, WrongNumbers)
{
  expect_refused(
      with("set Normal stiffness = 82e9", "set Normal stiffness = -82e9"),
      { "section 'Joints/bed'", "Normal stiffness = -82e9" });
  expect_refused(with("set Density = 1900", "set Density = 0"),
                 { "section 'Materials/brick'", "Density = 0", "positive" });
  expect_refused(
      with("set Poisson's ratio = 0.15", "set Poisson's ratio = 0.5"),
      { "section 'Materials/brick'", "Poisson's ratio = 0.5" });
  expect_refused(
      with("set Young's modulus = 16.7e9", "set Young's modulus = -1"),
      { "section 'Materials/brick'", "Young's modulus = -1" });
  expect_refused(
      with("set Share of critical time step = 0.5",
           "set Share of critical time step = 1.5"),
      { "section 'Time stepping'", "Share of critical time step = 1.5" });
  expect_refused(
      with("set Stress = -1e6, -2e6, 0", "set Stress = -1e6, -2e6"),
      { "section 'Loads/insitu'", "Stress = -1e6, -2e6", "three numbers" });
  expect_refused(with("set Point = 0.5, 1", "set Point = 0.5"),
                 { "section 'Histories/ux'", "Point = 0.5", "2 numbers" });
  expect_refused(with("set Interval = 1e-3", "set Interval = -1"),
                 { "section 'Histories'", "Interval = -1" });
  expect_refused(with("set Field interval = 0.1", "set Field interval = -1"),
                 { "section 'Output'", "Field interval = -1" });
}

TEST(Parameters, StagesMustFollowOneAnother)
{
  expect_refused(
      with("set Start time = 0.25", "set Start time = 0.2"),
      { "section 'Stages/shear'", "Start time = 0.2", "overlap", "0.25 s" });
  expect_refused(with("set Start time = 0.25", "set Start time = 0.3"),
                 { "section 'Stages/shear'", "Start time = 0.3", "gap" });
  // When a static stage ends is not known beforehand.
  expect_refused(with("set Names = preload, shear, rest",
                      "set Names = preload, rest, shear"),
                 { "section 'Stages/rest'", "Start time = 0.75", "gap" });
  expect_refused(
      with("set Duration = 0.25",
           "set End = static ratio\nset Damping = local"),
      { "section 'Stages/shear'", "Start time = 0.25", "previous end" });
  expect_refused(with("set Names = preload, shear, rest", "set Names ="),
                 { "Stages" });
}

TEST(Parameters, LoadsAndStagesMustMatch)
{
  expect_refused(with("set Loads = base, pull", "set Loads = base, push, pull"),
                 { "section 'Stages/shear'", "'push'" });
}

TEST(Parameters, NamesMustDiffer)
{
  expect_refused(with("set Names = brick, rock", "set Names = brick,,rock"),
                 { "section 'Materials'", "Names = brick,,rock", "comma" });
  expect_refused(with("set Names = brick, rock", "set Names = brick, brick"),
                 { "section 'Materials'", "'brick' twice" });
  expect_refused(with("set Names = ux, fy", "set Names = ux, fy, ux"),
                 { "section 'Histories'", "'ux' twice" });
}

TEST(Parameters, ReactionsNeedALoad)
{
  expect_refused(with("    set Load = base\n", ""),
                 { "section 'Histories/fy'", "'Load = '" });
}

TEST(Parameters, PairsOfSurfaces)
{
  EXPECT_TRUE(Case(with("rock:brick", "all")).read().split.between_all);
  expect_refused(with("rock:brick", "rock:brick:clay"),
                 { "section 'Mesh'", "rock:brick:clay" });
}

TEST(Parameters, TablesAndRecordsAreKnown)
{
  const Case it(with("set Vertical = 1e6 * t",
                     "set Vertical = table of time.csv times 1e6 * t\n"
                     "    set Horizontal = record shock.txt delay 1"));
  std::ofstream(it.directory / "of time.csv") << "0, 0\n1, 1\n";
  std::ofstream(it.directory / "shock.txt") << "0, 0\n1, 1\n";
  const auto files = it.read().time_files;
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0], it.directory / "shock.txt");
  EXPECT_EQ(files[1], it.directory / "of time.csv");
}

TEST(Parameters, AllTablesOfAnEntryAreKnown)
{
  const Case it(with("set Vertical = 1e6 * t",
                     "set Vertical = -1e6\n"
                     "    set Moving shape = uniform\n"
                     "    set Moving width = 0.5\n"
                     "    set Moving centre = table a.csv; 2*t;"
                     "table b of two.csv times 2; table c.csv"));
  for (const std::string name : { "a.csv", "b of two.csv", "c.csv" })
    std::ofstream(it.directory / name) << "0, 0\n1, 1\n";
  const auto files = it.read().time_files;
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0], it.directory / "a.csv");
  EXPECT_EQ(files[1], it.directory / "b of two.csv");
  EXPECT_EQ(files[2], it.directory / "c.csv");
}
