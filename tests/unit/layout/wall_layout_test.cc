// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/layout/wall_layout.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>

#include <gtest/gtest.h>

#include <map>
#include <set>

using namespace quoin;

namespace
{
  WallParameters small_wall(const WallBond bond)
  {
    WallParameters wall;
    wall.bond = bond;
    wall.storeys.resize(1);
    wall.length               = 1.;
    wall.storeys[0].n_courses = 2;
    wall.unit_length          = 0.25;
    wall.unit_height          = 0.1;
    wall.element_size         = 0.05;
    return wall;
  }

  /** Ends of units within a row, without those of the wall. */
  std::vector<double> joints(const WallLayout &layout, const unsigned int row)
  {
    std::vector<double> x;
    for (const WallUnit &unit : layout.units)
      if (unit.row == row && unit.right < layout.length)
        x.push_back(unit.right);
    return x;
  }

  void expect_joints(const WallLayout &layout, const unsigned int row,
                     const std::vector<double> &expected)
  {
    const auto x = joints(layout, row);
    ASSERT_EQ(x.size(), expected.size()) << "row " << row;
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_NEAR(x[i], expected[i], 1e-12) << "row " << row;
  }

  /** The mesh of a wall, split at all of its joints. */
  struct MeshedWall
  {
    BlockMesh<2> mesh;
    std::map<std::string, double> joint_length, outer_length;
    std::map<std::string, double> area_of; /**< by physical surface */
    double area = 0.;

    explicit MeshedWall(const WallParameters &wall)
    {
      const auto geometry = wall_geometry(wall, lay_wall(wall));
      SplitOptions options;
      options.joints_along = geometry.joint_curves;
      mesh                 = split_into_blocks(
                          mesh_gmsh_geometry(geometry.text, "wall", MPI_COMM_SELF), options);
      for (const JointFace<2> &face : mesh.joint_faces)
        joint_length[mesh.face_names[face.name]]
            += mesh.vertices[face.lower[0]].distance(
                mesh.vertices[face.lower[1]]);
      for (const auto &face : mesh.boundary_faces)
        outer_length[mesh.face_names[face.name]]
            += mesh.vertices[face.vertices[0]].distance(
                mesh.vertices[face.vertices[1]]);
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      {
        const auto &cell   = mesh.cells[c];
        const auto a       = mesh.vertices[cell[1]] - mesh.vertices[cell[0]];
        const auto b       = mesh.vertices[cell[2]] - mesh.vertices[cell[0]];
        const double share = 0.5 * (a[0] * b[1] - a[1] * b[0]);
        area += share;
        area_of[mesh.group_names[mesh.cell_group[c]]] += share;
      }
    }
  };
} // namespace

TEST(WallLayout, LaysEveryBondAsMasonsDo)
{
  auto layout = lay_wall(small_wall(WallBond::running));
  expect_joints(layout, 0, { 0.25, 0.5, 0.75 });
  expect_joints(layout, 1, { 0.125, 0.375, 0.625, 0.875 });

  layout = lay_wall(small_wall(WallBond::stack));
  expect_joints(layout, 1, { 0.25, 0.5, 0.75 });

  layout = lay_wall(small_wall(WallBond::header));
  expect_joints(layout, 0, { 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875 });
  expect_joints(
      layout, 1,
      { 0.0625, 0.1875, 0.3125, 0.4375, 0.5625, 0.6875, 0.8125, 0.9375 });

  // Header, queen closer, then every joint a quarter from those below.
  layout = lay_wall(small_wall(WallBond::english));
  expect_joints(layout, 0, { 0.25, 0.5, 0.75 });
  expect_joints(
      layout, 1,
      { 0.125, 0.1875, 0.3125, 0.4375, 0.5625, 0.6875, 0.8125, 0.9375 });

  // Headers centred on stretchers.
  layout = lay_wall(small_wall(WallBond::flemish));
  expect_joints(layout, 0, { 0.25, 0.375, 0.625, 0.75 });
  expect_joints(layout, 1, { 0.125, 0.1875, 0.4375, 0.5625, 0.8125, 0.9375 });
}

TEST(WallLayout, CoursesOfHeadersInAnotherBond)
{
  WallParameters wall            = small_wall(WallBond::running);
  wall.storeys[0].n_courses      = 3;
  wall.storeys[0].header_courses = { 2 };
  const auto layout              = lay_wall(wall);
  expect_joints(layout, 0, { 0.25, 0.5, 0.75 });
  // As in English bond: header, queen closer, headers.
  expect_joints(
      layout, 1,
      { 0.125, 0.1875, 0.3125, 0.4375, 0.5625, 0.6875, 0.8125, 0.9375 });
  expect_joints(layout, 2, { 0.25, 0.5, 0.75 });
  for (const WallUnit &unit : layout.units)
    EXPECT_EQ(unit.through, unit.row == 1);
}

TEST(WallLayout, TheFirstCourseMayBeTheShiftedOne)
{
  WallParameters wall = small_wall(WallBond::running);
  wall.begins_shifted = true;
  const auto layout   = lay_wall(wall);
  expect_joints(layout, 0, { 0.125, 0.375, 0.625, 0.875 });
  expect_joints(layout, 1, { 0.25, 0.5, 0.75 });
}

TEST(WallLayout, JoinsPiecesThatAreTooShort)
{
  WallParameters wall = small_wall(WallBond::running);
  wall.length         = 1.03; // 0.03 is left of a fifth unit
  const auto layout   = lay_wall(wall);
  expect_joints(layout, 0, { 0.25, 0.5, 0.75 });
  expect_joints(layout, 1, { 0.125, 0.375, 0.625, 0.875 });
  EXPECT_EQ(layout.n_joined, 1);
}

TEST(WallLayout, CutsUnitsAtOpeningsAndLaysLintels)
{
  WallParameters wall       = small_wall(WallBond::running);
  wall.storeys[0].n_courses = 4;
  wall.storeys[0].openings  = { { 0.4, 0.6, 2, 2 } };
  wall.lintel_bearing       = 0.1;
  const auto layout         = lay_wall(wall);
  // course 2: pieces of 0.025 m at the opening join their neighbours
  std::vector<std::pair<double, double>> units;
  for (const WallUnit &unit : layout.units)
    if (unit.row == 1)
      units.emplace_back(unit.left, unit.right);
  ASSERT_EQ(units.size(), 4);
  EXPECT_DOUBLE_EQ(units[1].first, 0.125);
  EXPECT_DOUBLE_EQ(units[1].second, 0.4);
  EXPECT_DOUBLE_EQ(units[2].first, 0.6);
  EXPECT_DOUBLE_EQ(units[2].second, 0.875);
  unsigned int n_lintels = 0;
  for (const WallUnit &unit : layout.units)
    if (unit.kind == WallUnit::lintel)
    {
      ++n_lintels;
      EXPECT_EQ(unit.row, 2);
      EXPECT_NEAR(unit.left, 0.3, 1e-12);
      EXPECT_NEAR(unit.right, 0.7, 1e-12);
    }
  EXPECT_EQ(n_lintels, 1);
}

TEST(WallLayout, RandomLengthsKeepTheirBoundsAndTheOverlap)
{
  WallParameters wall       = small_wall(WallBond::random);
  wall.structured           = false;
  wall.length               = 10.;
  wall.storeys[0].n_courses = 20;
  wall.random_shortest      = 0.15;
  wall.random_longest       = 0.45;
  wall.random_overlap       = 0.05;
  const auto layout         = lay_wall(wall);
  std::vector<double> below;
  std::set<double> lengths;
  for (unsigned int row = 0; row < wall.storeys[0].n_courses; ++row)
  {
    const auto here = joints(layout, row);
    double left     = 0.;
    for (const double x : here)
    {
      if (x < here.back()) // the last may have taken up a short piece
      {
        EXPECT_GE(x - left, 0.15 - 1e-12);
        EXPECT_LE(x - left, 0.45 + 1e-12);
      }
      lengths.insert(x - left);
      left = x;
      for (const double other : below)
        EXPECT_GE(std::abs(other - x), 0.05);
    }
    below = here;
  }
  EXPECT_GT(lengths.size(), 500);

  const auto again = lay_wall(wall);
  EXPECT_EQ(joints(again, 7), joints(layout, 7));
  wall.random_seed = 2;
  EXPECT_NE(joints(lay_wall(wall), 7), joints(layout, 7));
}

TEST(WallLayout, RandomJointsOverlapWithEndsOfOpeningsAndLintels)
{
  WallParameters wall       = small_wall(WallBond::random);
  wall.structured           = false;
  wall.length               = 2.;
  wall.unit_length          = 0.35;
  wall.storeys[0].n_courses = 6;
  wall.storeys[0].openings  = { { 0.8, 1.2, 1, 3 } };
  wall.random_shortest      = 0.2;
  wall.random_longest       = 0.5;
  wall.random_overlap       = 0.08;
  // Jambs and lintels end above each other, or as far apart as these.
  const auto expect_overlap = [&]()
  {
    unsigned int n_laid = 0;
    for (wall.random_seed = 1; wall.random_seed <= 30; ++wall.random_seed)
      try
      {
        std::vector<double> below;
        const WallLayout layout = lay_wall(wall);
        for (unsigned int row = 0; row < 6; ++row)
        {
          std::set<double> ends;
          for (const WallUnit &unit : layout.units)
            if (unit.row == row)
              ends.insert({ unit.left, unit.right });
          ends.erase(0.);
          ends.erase(wall.length);
          for (const double x : ends)
            for (const double other : below)
            {
              const double distance = std::abs(x - other);
              EXPECT_TRUE(distance < 1e-12
                          || distance >= wall.random_overlap - 1e-12)
                  << distance << " m, seed " << wall.random_seed << ", row "
                  << row;
            }
          below.assign(ends.begin(), ends.end());
        }
        ++n_laid;
      }
      catch (const InputError &)
      {
        // There was no place for a joint.
      }
    EXPECT_GE(n_laid, 25);
  };
  expect_overlap();
  wall.lintel_bearing = 0.15;
  expect_overlap();
}

TEST(WallGeometry, MeshesABlockForEveryHalfUnit)
{
  for (const bool structured : { true, false })
  {
    WallParameters wall       = small_wall(WallBond::running);
    wall.storeys[0].n_courses = 4;
    wall.cracks               = true;
    wall.bottom_platen        = 0.1;
    wall.top_platen           = 0.2;
    wall.structured           = structured;
    MeshedWall meshed(wall);
    // 2 x 4 and 2 x 5 units, 14 of them whole, and two platens
    EXPECT_EQ(meshed.mesh.n_blocks(), 2 * 4 + 2 * 5 + 14 + 2);
    EXPECT_NEAR(meshed.area, 0.7, 1e-12);
    EXPECT_NEAR(meshed.joint_length["bed"], 3., 1e-12);
    EXPECT_NEAR(meshed.joint_length["platen_joint"], 2., 1e-12);
    EXPECT_NEAR(meshed.joint_length["head"], 0.1 * (2 * 3 + 2 * 4), 1e-12);
    EXPECT_NEAR(meshed.joint_length["crack"], 1.4, 1e-12);
  }
}

TEST(WallGeometry, LeavesOpeningsOpen)
{
  WallParameters wall       = small_wall(WallBond::flemish);
  wall.storeys[0].n_courses = 6;
  wall.storeys[0].openings  = { { 0.375, 0.75, 2, 4 } };
  wall.lintel_bearing       = 0.125;
  MeshedWall meshed(wall);
  EXPECT_NEAR(meshed.area, 0.6 - 0.375 * 0.3, 1e-12);
  // The opening takes four beds' length within, two of them its rim.
  EXPECT_NEAR(meshed.joint_length["bed"], 5. - 4 * 0.375, 1e-12);
}

TEST(WallGeometry, NamesStoreysSlabsLintelsAndCourses)
{
  for (const bool structured : { true, false })
  {
    WallParameters wall  = small_wall(WallBond::running);
    wall.structured      = structured;
    wall.lintel_bearing  = 0.1;
    wall.lintel_courses  = 2;
    wall.storeys         = std::vector<WallStorey>(2);
    WallStorey &ground   = wall.storeys[0];
    ground.name          = "ground";
    ground.n_courses     = 6;
    ground.openings      = { { 0.4, 0.6, 2, 3 } };
    ground.slab          = 0.15;
    ground.named_courses = { { 1, "plinth" } };
    wall.storeys[1]      = { "upper", 2, {}, 0.2, {} };
    MeshedWall meshed(wall);
    auto &area  = meshed.area_of;
    auto &joint = meshed.joint_length;

    EXPECT_NEAR(area["unit_plinth"], 0.1, 1e-12);
    // five courses without the opening of two and the lintel of two
    EXPECT_NEAR(area["unit_ground"], 0.5 - 0.2 * 0.2 - 0.4 * 0.2, 1e-12);
    EXPECT_NEAR(area["lintel_ground"], 0.4 * 0.2, 1e-12);
    EXPECT_NEAR(area["slab_ground"], 0.15, 1e-12);
    EXPECT_NEAR(area["unit_upper"], 0.2, 1e-12);
    EXPECT_NEAR(area["slab_upper"], 0.2, 1e-12);
    EXPECT_EQ(area.count("unit"), 0U);

    // A lintel is one block: no joint between its courses.
    EXPECT_NEAR(joint["lintel_joint"], 2 * 0.1 + 2 * 0.2 + 0.4, 1e-12);
    EXPECT_NEAR(joint["slab_joint"], 3., 1e-12);
    // beside the opening below courses 2 and 3, the lintel below 4, 5 and 6
    EXPECT_NEAR(joint["bed_ground"], 2 * 0.8 + 3 * 0.6, 1e-12);
    EXPECT_NEAR(joint["bed_upper"], 1., 1e-12);
    EXPECT_NEAR(joint["head_plinth"], 0.3, 1e-12);
    // The bond begins anew on the slab: 3 and 4 joints.
    EXPECT_NEAR(joint["head_upper"], 0.7, 1e-12);
    EXPECT_EQ(joint.count("bed"), 0U);

    auto &outer = meshed.outer_length;
    EXPECT_NEAR(outer["slab_ground_left"], 0.15, 1e-12);
    EXPECT_NEAR(outer["slab_upper_right"], 0.2, 1e-12);
    EXPECT_NEAR(outer["left"], 0.8, 1e-12);
    EXPECT_NEAR(outer["base"], 1., 1e-12);
    EXPECT_NEAR(outer["top"], 1., 1e-12);
    EXPECT_NEAR(outer["opening"], 2 * 0.2 + 2 * 0.2, 1e-12);

    const std::string report = wall_report(lay_wall(wall));
    EXPECT_NE(report.find("1 lintel, 2 slabs"), std::string::npos) << report;
    EXPECT_NE(
        report.find("storey upper: 2 courses, y = 0.75 to 0.95 m, slab to "
                    "1.15 m"),
        std::string::npos)
        << report;
  }
}

TEST(WallLayout, TheBondGoesOnThroughStoreysWithoutASlab)
{
  for (const WallBond bond : { WallBond::running, WallBond::english,
                               WallBond::flemish, WallBond::header })
  {
    WallParameters wall       = small_wall(bond);
    wall.storeys[0].n_courses = 5;
    const WallLayout one      = lay_wall(wall);
    wall.storeys              = std::vector<WallStorey>(2);
    wall.storeys[0]           = { "low", 3, {}, 0., {} };
    wall.storeys[1]           = { "high", 2, {}, 0., {} };
    const WallLayout two      = lay_wall(wall);
    ASSERT_EQ(two.levels.size(), one.levels.size());
    for (unsigned int row = 0; row < 5; ++row)
      EXPECT_EQ(joints(two, row), joints(one, row)) << "row " << row;
    wall.storeys[0].slab = 0.2;
    EXPECT_EQ(joints(lay_wall(wall), 4), joints(one, 0)) << "on the slab";
  }
}

TEST(WallLayout, ARandomBondGoesOnThroughStoreysWithoutASlab)
{
  WallParameters wall  = small_wall(WallBond::random);
  wall.length          = 10.;
  wall.structured      = false;
  wall.random_shortest = 0.2;
  wall.random_longest  = 0.5;
  wall.random_overlap  = 0.08;
  wall.storeys         = std::vector<WallStorey>(2);
  wall.storeys[0]      = { "low", 3, { { 4., 5., 2, 3 } }, 0., {} };
  wall.storeys[1]      = { "high", 3, {}, 0., {} };
  unsigned int n_laid  = 0;
  for (wall.random_seed = 1; wall.random_seed <= 20; ++wall.random_seed)
    try
    {
      const WallLayout layout = lay_wall(wall);
      std::vector<double> below
          = joints(layout, 2); // with the left jamb of the opening
      below.push_back(5.);
      for (const double x : joints(layout, 3))
        for (const double other : below)
          EXPECT_GE(std::abs(x - other), 0.08 - 1e-12)
              << "seed " << wall.random_seed;
      ++n_laid;
    }
    catch (const InputError &)
    {
      // There was no place for a joint.
    }
  EXPECT_GT(n_laid, 10U);
}

TEST(WallLayout, RefusesLintelsThatReachIntoTheSlab)
{
  WallParameters wall = small_wall(WallBond::running);
  wall.lintel_bearing = 0.1;
  wall.lintel_courses = 2;
  wall.storeys[0]     = { "ground", 4, { { 0.4, 0.6, 2, 3 } }, 0.2, {} };
  try
  {
    lay_wall(wall);
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("course 3 of storey 'ground'"),
              std::string::npos);
  }
  // The slab itself bridges what ends below it.
  wall.storeys[0].openings[0].last_course = 4;
  EXPECT_EQ(lay_wall(wall).n_lintels, 0U);
}

TEST(WallGeometry, HasTheBlocksAndJointsOfTheTests)
{
  // Raijmakers & Vermeltfoort 1992
  WallParameters wall       = small_wall(WallBond::running);
  wall.length               = 0.99;
  wall.storeys[0].n_courses = 16;
  wall.unit_length          = 0.22;
  wall.unit_height          = 0.0625;
  wall.bottom_platen = wall.top_platen = 0.0625;
  wall.cracks                          = true;
  wall.element_size                    = 0.032;
  MeshedWall meshed(wall);
  const BlockMesh<2> &mesh = meshed.mesh;

  EXPECT_NEAR(meshed.area, 0.99 * (1. + 2 * 0.0625), 1e-12);
  EXPECT_EQ(mesh.n_blocks(), 16U * 9U + 2U);
  EXPECT_NEAR(meshed.joint_length["bed"], 15 * 0.99, 1e-9);
  EXPECT_NEAR(meshed.joint_length["platen_joint"], 2 * 0.99, 1e-9);
  EXPECT_NEAR(meshed.joint_length["head"], 64 * 0.0625, 1e-9);
  EXPECT_NEAR(meshed.joint_length["crack"], 64 * 0.0625, 1e-9);

  // Odd courses have their first head joint after a unit, even ones after
  // half a unit; the other columns of half units are cracks.
  std::map<std::string, std::set<std::pair<long, long>>> places;
  for (const JointFace<2> &face : mesh.joint_faces)
    for (const unsigned int v : face.lower)
    {
      const auto &p = mesh.vertices[v];
      if (std::abs(p[1] / 0.0625 - std::lround(p[1] / 0.0625)) < 1e-6)
        places[mesh.face_names[face.name]].insert(
            { std::lround(p[0] / 0.11), std::lround(p[1] / 0.0625) });
    }
  EXPECT_EQ(places["head"].size(), 128U);
  EXPECT_EQ(places["head"].count({ 2, 0 }), 1U);
  EXPECT_EQ(places["head"].count({ 2, 1 }), 1U);
  EXPECT_EQ(places["head"].count({ 1, 0 }), 0U);
  EXPECT_EQ(places["head"].count({ 1, 2 }), 1U);
  EXPECT_EQ(places["crack"].count({ 1, 0 }), 1U);

  // Two triangles in each corner of a half unit.
  std::vector<unsigned int> n_cells(mesh.n_vertices(), 0);
  for (const auto &cell : mesh.cells)
    for (const unsigned int v : cell)
      ++n_cells[v];
  for (const unsigned int n : n_cells)
    EXPECT_GE(n, 2U);
}

TEST(WallGeometry, RefusesSliversInStructuredMeshes)
{
  WallParameters wall = small_wall(WallBond::running);
  wall.offset         = 0.49;
  wall.cracks         = true; // at 0.5, next to joints at 0.49
  try
  {
    wall_geometry(wall, lay_wall(wall));
    FAIL();
  }
  catch (const InputError &error)
  {
    EXPECT_NE(std::string(error.what()).find("Elements = free"),
              std::string::npos);
  }
}
