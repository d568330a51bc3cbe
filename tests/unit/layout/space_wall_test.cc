// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/layout/space_wall.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

using namespace quoin;

namespace
{
  /** 1 m long, 0.25 m thick, two courses of 0.1 m, units of 0.25 m. */
  WallParameters thick_wall(const WallBond bond, const unsigned int n_wythes)
  {
    WallParameters wall;
    wall.bond = bond;
    wall.storeys.resize(1);
    wall.storeys[0].n_courses = 2;
    wall.unit_length          = 0.25;
    wall.unit_height          = 0.1;
    wall.element_size         = 0.07;
    wall.thickness            = 0.25;
    wall.n_wythes             = n_wythes;
    wall.length               = 1.;
    wall.segments.resize(1);
    wall.segments[0].length = 1.;
    wall.segments[0].openings.resize(1);
    return wall;
  }

  /** The same in one wythe of 0.125 m with another segment along y, of
      0.75 m. */
  WallParameters two_segments(const double x, const double y)
  {
    WallParameters wall   = thick_wall(WallBond::running, 1);
    wall.thickness        = 0.125;
    wall.segments[0].name = "south";
    WallSegment west      = wall.segments[0];
    west.name             = "west";
    west.start            = { x, y };
    west.along            = 1;
    west.length           = 0.75;
    wall.segments.push_back(west);
    return wall;
  }

  double triangle(const BlockMesh<3> &mesh,
                  const std::array<unsigned int, 3> &v)
  {
    return 0.5
           * dealii::cross_product_3d(mesh.vertices[v[1]] - mesh.vertices[v[0]],
                                      mesh.vertices[v[2]] - mesh.vertices[v[0]])
                 .norm();
  }

  /** The mesh of a wall, split at all of its joints. */
  struct MeshedSpaceWall
  {
    BlockMesh<3> mesh;
    std::map<std::string, double> joints, outside; /**< areas */
    std::map<std::string, double> volume_of;       /**< by physical volume */
    double longest_edge = 0.;

    explicit MeshedSpaceWall(const WallParameters &wall,
                             const unsigned int refinements = 0)
    {
      const auto made = space_wall_mesh(wall, lay_space_wall(wall));
      SplitOptions options;
      options.joints_along = made.joint_curves;
      mesh                 = split_into_blocks(
                          std::get<MeshData<3>>(mesh_any_gmsh_geometry(
                              made.text, "wall", MPI_COMM_SELF, MeshDimension::three,
                              { TriangleKind::plain, refinements })),
                          options);
      for (const JointFace<3> &face : mesh.joint_faces)
        joints[mesh.face_names[face.name]] += triangle(mesh, face.lower);
      for (const auto &face : mesh.boundary_faces)
        outside[mesh.face_names[face.name]] += triangle(mesh, face.vertices);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto &v      = mesh.cells[c];
        const auto &origin = mesh.vertices[v[0]];
        volume_of[mesh.group_names[mesh.cell_group[c]]]
            += dealii::cross_product_3d(mesh.vertices[v[1]] - origin,
                                        mesh.vertices[v[2]] - origin)
               * (mesh.vertices[v[3]] - origin) / 6.;
        for (unsigned int i = 0; i < 4; ++i)
          longest_edge = std::max(
              longest_edge,
              mesh.vertices[v[i]].distance(mesh.vertices[v[(i + 1) % 4]]));
      }
    }
  };

  /** Compares @p made with @p expected, which has all names. */
  void expect_areas(const std::map<std::string, double> &made,
                    const std::map<std::string, double> &expected)
  {
    EXPECT_EQ(made.size(), expected.size());
    for (const auto &[name, area] : made)
      EXPECT_EQ(expected.count(name), 1u) << "unexpected: " << name;
    for (const auto &[name, area] : expected)
    {
      ASSERT_EQ(made.count(name), 1u) << "missing: " << name;
      EXPECT_NEAR(made.at(name), area, 1e-12) << name;
    }
  }
} // namespace

TEST(SpaceWall, RunningBondInOneWythe)
{
  WallParameters wall = thick_wall(WallBond::running, 1);
  wall.cracks         = true;
  const MeshedSpaceWall made(wall);
  expect_areas(made.volume_of, { { "unit", 1. * 0.25 * 0.2 } });
  // Whole units: four in the first course, three in the second.
  const double face = 0.25 * 0.1;
  expect_areas(made.joints, { { "bed", 0.25 },
                              { "head", (3 + 4) * face },
                              { "crack", (4 + 3) * face } });
  EXPECT_EQ(made.mesh.n_blocks(), 4 + 5 + 7u);
  EXPECT_EQ(made.mesh.n_reoriented_cells, 0u);
  // Triangles that did not match would be outside, without a name.
  expect_areas(made.outside, { { "base", 0.25 },
                               { "top", 0.25 },
                               { "front", 0.2 },
                               { "back", 0.2 },
                               { "left", 0.05 },
                               { "right", 0.05 } });
}

TEST(SpaceWall, BricksAreNoLongerThanTheElementSize)
{
  WallParameters wall = thick_wall(WallBond::running, 1);
  // Cells of 0.125 x 0.25 x 0.1 m, of 2 x 4 x 2 bricks of five tetrahedra.
  const MeshedSpaceWall made(wall);
  EXPECT_EQ(made.mesh.n_cells(), (8 * 2) * 4 * (2 * 2) * 5u);
  EXPECT_NEAR(made.longest_edge, std::hypot(0.0625, 0.0625), 1e-12);
  wall.element_size = 0.3;
  EXPECT_EQ(MeshedSpaceWall(wall).mesh.n_cells(), 8 * 2 * 5u);
  // gmsh refines what was generated.
  const MeshedSpaceWall refined(wall, 1);
  EXPECT_EQ(refined.mesh.n_cells(), 8 * 2 * 5 * 8u);
  EXPECT_NEAR(refined.joints.at("bed"), 0.25, 1e-12);
  EXPECT_EQ(refined.mesh.n_blocks(), 4 + 5u);
}

TEST(SpaceWall, WythesWithCollarJoints)
{
  WallParameters wall = thick_wall(WallBond::running, 3);
  MeshedSpaceWall made(wall);
  EXPECT_EQ(made.mesh.n_blocks(), 3 * (4 + 5u));
  expect_areas(made.joints, { { "bed", 0.25 },
                              { "head", 7 * 0.25 * 0.1 },
                              { "collar", 2 * 1. * 0.2 } });
  // The middle one is that of the other course.
  wall.wythe_offset = 0.5;
  made              = MeshedSpaceWall(wall);
  EXPECT_EQ(made.mesh.n_blocks(), (4 + 5 + 4) + (5 + 4 + 5u));
  expect_areas(made.joints, { { "bed", 0.25 },
                              { "head", (3 + 4 + 3 + 4 + 3 + 4) * 0.1 / 12. },
                              { "collar", 2 * 1. * 0.2 } });
}

TEST(SpaceWall, HeadersGoThroughTheWall)
{
  WallParameters wall            = thick_wall(WallBond::running, 2);
  wall.storeys[0].n_courses      = 3;
  wall.storeys[0].header_courses = { 2 };
  wall.cracks                    = true;
  MeshedSpaceWall made(wall);
  // Header, closer, seven headers, of which the last is half of one.
  EXPECT_EQ(made.mesh.n_blocks(), 2 * (2 * 8 + 9u));
  expect_areas(made.joints, { { "bed", 2 * 0.25 },
                              { "head", (3 + 8 + 3) * 0.25 * 0.1 },
                              { "collar", 2 * 0.1 },
                              { "crack", 2 * 8 * 0.125 * 0.1 + 1. * 0.1 } });

  wall = thick_wall(WallBond::english, 2);
  made = MeshedSpaceWall(wall);
  EXPECT_EQ(made.mesh.n_blocks(), 2 * 4 + 9u);
  expect_areas(
      made.joints,
      { { "bed", 0.25 }, { "head", (3 + 8) * 0.25 * 0.1 }, { "collar", 0.1 } });

  // Stretcher and header in turn; closers go through, too.
  wall = thick_wall(WallBond::flemish, 2);
  made = MeshedSpaceWall(wall);
  EXPECT_EQ(made.mesh.n_blocks(), (2 * 3 + 2) + (2 * 2 + 5u));
  expect_areas(made.joints, { { "bed", 0.25 },
                              { "head", (4 + 6) * 0.25 * 0.1 },
                              { "collar", (0.75 + 0.5) * 0.1 } });
}

TEST(SpaceWall, OpeningsSlabsAndPlatens)
{
  WallParameters wall          = thick_wall(WallBond::running, 2);
  wall.storeys[0].n_courses    = 5;
  wall.storeys[0].name         = "low";
  wall.storeys[0].slab         = 0.15;
  wall.bottom_platen           = 0.08;
  wall.lintel_bearing          = 0.125;
  wall.lintel_courses          = 2;
  wall.segments[0].openings[0] = { { 0.375, 0.625, 2, 3 } };
  const MeshedSpaceWall made(wall);
  expect_areas(made.volume_of,
               { { "unit_low", 0.25 * (0.5 - 0.25 * 0.2 - 0.5 * 0.2) },
                 { "lintel_low", 0.25 * 0.5 * 0.2 },
                 { "slab_low", 0.25 * 0.15 },
                 { "bottom_platen", 0.25 * 0.08 } });
  // The lintel of 0.5 m takes courses 4 and 5, up to the slab.
  expect_areas(made.joints, { { "platen_joint", 0.25 },
                              { "bed_low", 0.25 * (0.75 + 0.75 + 0.5 + 0.5) },
                              { "head_low", (3 + 2 + 2 + 2 + 0) * 0.25 * 0.1 },
                              { "collar_low", 0.5 - 0.25 * 0.2 - 0.5 * 0.2 },
                              { "lintel_joint", 0.25 * 0.25 + 4 * 0.25 * 0.1 },
                              { "slab_joint", 0.25 } });
  const double side = 0.08 + 0.5 - 0.25 * 0.2;
  expect_areas(made.outside, { { "base", 0.25 },
                               { "top", 0.25 },
                               { "front", side },
                               { "back", side },
                               { "left", 0.25 * 0.58 },
                               { "right", 0.25 * 0.58 },
                               { "opening", 0.25 * 2 * (0.25 + 0.2) },
                               { "slab_low_front", 0.15 },
                               { "slab_low_back", 0.15 },
                               { "slab_low_left", 0.25 * 0.15 },
                               { "slab_low_right", 0.25 * 0.15 } });
}

TEST(SpaceWall, ACornerInterlocksCourseByCourse)
{
  const WallParameters wall = two_segments(0., 0.);
  const MeshedSpaceWall made(wall);
  const double plan = (1. + 0.75 - 0.125) * 0.125, face = 0.125 * 0.1;
  expect_areas(made.volume_of, { { "unit", 0.2 * plan } });
  // South runs through first: 4 units, and 3 of the west; then 4 and 3.
  EXPECT_EQ(made.mesh.n_blocks(), 4 + 3 + 4 + 3u);
  expect_areas(made.joints, { { "bed", plan },
                              { "head", ((3 + 1 + 2) + (3 + 1 + 2)) * face } });
  expect_areas(made.outside, { { "base", plan },
                               { "top", plan },
                               { "front_south", 1. * 0.2 },
                               { "back_south", 0.875 * 0.2 },
                               { "front_west", 0.75 * 0.2 },
                               { "back_west", 0.625 * 0.2 },
                               { "right_south", 2 * face },
                               { "right_west", 2 * face } });
}

TEST(SpaceWall, ACornerAsThickAsAUnitIsLongInterlocks)
{
  WallParameters wall = two_segments(0., 0.);
  wall.thickness      = 0.25;
  wall.n_wythes       = 2;
  const MeshedSpaceWall made(wall);
  // South has no joint at 0.25 m where it runs through, in the second course:
  // 3 units and 4 of the west, then 5 and 2, each in two wythes.
  EXPECT_EQ(made.mesh.n_blocks(), 2 * (3 + 4 + 5 + 2u));
  expect_areas(made.joints,
               { { "bed", 0.25 * 1.5 },
                 { "head", ((2 + 1 + 3) + (4 + 1 + 1)) * 0.25 * 0.1 },
                 { "collar", ((0.75 + 0.75) + (1. + 0.5)) * 0.1 } });
  for (const WallBond bond : { WallBond::running, WallBond::header,
                               WallBond::english, WallBond::flemish })
  {
    // In one course, and in no other, a unit lies across the end that the
    // segment has in the next.
    wall.bond = bond;
    for (const unsigned int s : { 0u, 1u })
    {
      std::set<unsigned int> rows;
      for (const WallBox &box : lay_space_wall(wall).boxes)
        if (box.segment == s && box.unit.left < 0.24 && box.unit.right > 0.26)
          rows.insert(box.unit.row);
      EXPECT_EQ(rows, std::set<unsigned int>{ 1 - s });
    }
  }
}

TEST(SpaceWall, ASlabLiesOnAllSegments)
{
  WallParameters wall  = two_segments(0., 0.);
  wall.storeys[0].name = "low";
  wall.storeys[0].slab = 0.1;
  const MeshedSpaceWall made(wall);
  const double plan = (1. + 0.75 - 0.125) * 0.125;
  EXPECT_EQ(made.mesh.n_blocks(), 14 + 1u);
  EXPECT_NEAR(made.joints.at("slab_joint"), plan, 1e-12);
  EXPECT_NEAR(made.volume_of.at("slab_low"), 0.1 * plan, 1e-12);
  EXPECT_NEAR(made.outside.at("slab_low_front_west"), 0.75 * 0.1, 1e-12);
}

TEST(SpaceWall, CrossWallsAndStraightJoints)
{
  // A wall that ends in the other, at its front.
  const MeshedSpaceWall bonded(two_segments(0.375, 0.));
  const double plan = (1. + 0.75 - 0.125) * 0.125, face = 0.125 * 0.1;
  EXPECT_EQ(bonded.mesh.n_blocks(), (4 + 3) + (5 + 3u));
  expect_areas(
      bonded.joints,
      { { "bed", plan }, { "head", ((3 + 2 + 1) + (1 + 2 + 2 + 2)) * face } });
  EXPECT_NEAR(bonded.outside.at("front_south"), 0.2, 1e-12);
  EXPECT_NEAR(bonded.outside.at("back_south"), 0.875 * 0.2, 1e-12);

  // One that crosses it.
  const MeshedSpaceWall crossed(two_segments(0.375, -0.25));
  EXPECT_NEAR(crossed.volume_of.at("unit"), 0.2 * plan, 1e-12);
  EXPECT_NEAR(crossed.outside.at("front_south"), 0.875 * 0.2, 1e-12);
  EXPECT_NEAR(crossed.outside.at("left_west"), 2 * face, 1e-12);

  // One that only touches it: a straight joint over both courses.
  const MeshedSpaceWall touching(two_segments(0.375, 0.125));
  EXPECT_NEAR(touching.volume_of.at("unit"), 0.2 * 1.75 * 0.125, 1e-12);
  EXPECT_EQ(touching.mesh.n_blocks(), (4 + 4) + (5 + 3u));
  EXPECT_NEAR(touching.joints.at("head"), (3 + 3 + 1 + 4 + 2 + 1) * face,
              1e-12);
}

TEST(SpaceWall, RefusesLintelsInAnotherWallAndThinLayers)
{
  WallParameters wall          = two_segments(0.375, 0.);
  wall.storeys[0].n_courses    = 4;
  wall.lintel_bearing          = 0.125;
  wall.segments[0].openings[0] = { { 0.5, 0.75, 1, 1 } };
  EXPECT_THROW(lay_space_wall(wall), InputError);
  wall.segments[0].openings[0] = { { 0.5, 0.75, 1, 2 } };
  EXPECT_NO_THROW(lay_space_wall(wall));

  wall = two_segments(0.38, 0.);
  EXPECT_THROW(space_wall_mesh(wall, lay_space_wall(wall)), InputError);
}
