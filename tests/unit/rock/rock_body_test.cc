// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/none.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/rock/block_borders.h>
#include <quoin/rock/rock_box.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

using namespace quoin;

namespace
{
  using SpacePoint = dealii::Point<3>;

  RockBoxParameters cube()
  {
    RockBoxParameters rock;
    rock.low           = SpacePoint(-6, 0, -6);
    rock.high          = SpacePoint(6, 12, 6);
    rock.element_size  = 3.;
    rock.shortest_edge = 0.03;
    return rock;
  }

  RockBody body_of(const std::string &name, const Polygon &section,
                   const SpacePoint &start, const SpacePoint &end)
  {
    RockBody body;
    body.name    = name;
    body.section = section;
    body.start   = start;
    body.end     = end;
    return body;
  }

  /** A tunnel of 24 corners from the front, in rounds of 3, 3 and 4 m. */
  RockBody tunnel()
  {
    RockBody body
        = body_of("tunnel", circle_polygon(dealii::Point<2>(), 2., 24),
                  SpacePoint(0, 0, 0), SpacePoint(0, 10, 0));
    body.rounds = { 3., 3. };
    return body;
  }

  void add_sets(RockBoxParameters &rock)
  {
    for (const auto &[name, dip, towards] :
         { std::tuple{ "a", 55., 250. }, std::tuple{ "b", 70., 115. },
           std::tuple{ "c", 15., 20. } })
    {
      SpaceJointSet set;
      set.name          = name;
      set.dip           = dip;
      set.dip_direction = towards;
      set.spacing       = Distribution::parse("3");
      set.origin        = SpacePoint(0.4, 5.1, 0.3);
      rock.sets.push_back(set);
    }
  }

  /** Volume of the pieces of each physical volume. */
  std::map<std::string, double> volumes(const RockBoxParameters &rock,
                                        const RockBox &box)
  {
    std::map<std::string, double> result;
    for (unsigned int b = 0; b < box.pieces.n_blocks(); ++b)
      result[box.part(b) ? box.part(b)->group : rock.group]
          += box.pieces.volume(b);
    return result;
  }

  struct Meshed
  {
    double volume = 0.;
    unsigned int n_blocks;
  };

  Meshed meshed(const RockBoxParameters &rock, const RockBox &box)
  {
    const auto geometry = rock_box_geometry(rock, box);
    const auto mesh     = std::get<MeshData<3>>(mesh_any_gmsh_geometry(
            geometry.text, "rock", MPI_COMM_SELF, MeshDimension::three));
    Meshed result;
    const auto &x = mesh.vertices;
    for (const auto &cell : mesh.cells)
      result.volume
          += std::abs(dealii::cross_product_3d(x[cell[1]] - x[cell[0]],
                                               x[cell[2]] - x[cell[0]])
                      * (x[cell[3]] - x[cell[0]]))
             / 6.;
    SplitOptions options;
    options.joints_along = geometry.joint_curves;
    BlockMesh<3> blocks  = split_into_blocks(mesh, options);
    result.n_blocks      = blocks.n_blocks();
    return result;
  }

  const double area_of_24 = 12. * 4. * std::sin(std::acos(-1.) / 12.);
} // namespace

TEST(RockBody, SectionIsUprightToWhoLooksAlongTheAxis)
{
  const auto place = [](const SpacePoint &end)
  {
    const RockBody body = body_of("b", {}, SpacePoint(), end);
    return std::pair(body.place(dealii::Point<2>(1, 0), 2.),
                     body.place(dealii::Point<2>(0, 1), 0.));
  };
  // north: east is on the right
  EXPECT_LT(place(SpacePoint(0, 5, 0)).first.distance(SpacePoint(1, 2, 0)),
            1e-14);
  EXPECT_LT(place(SpacePoint(0, 5, 0)).second.distance(SpacePoint(0, 0, 1)),
            1e-14);
  // west: north is on the right
  EXPECT_LT(place(SpacePoint(-5, 0, 0)).first.distance(SpacePoint(-2, 1, 0)),
            1e-14);
  // an incline to the north at 45 degrees
  const double r = std::sqrt(0.5);
  EXPECT_LT(place(SpacePoint(0, 5, 5)).second.distance(SpacePoint(0, -r, r)),
            1e-14);
  for (const double way : { -5., 5. }) // shafts
  {
    EXPECT_LT(place(SpacePoint(0, 0, way))
                  .first.distance(SpacePoint(1, 0, way > 0 ? 2 : -2)),
              1e-14);
    EXPECT_LT(place(SpacePoint(0, 0, way)).second.distance(SpacePoint(0, 1, 0)),
              1e-14);
  }
}

TEST(RockBody, ConvexPartsHaveTheAreaOfThePolygon)
{
  const Polygon square = { { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 } };
  EXPECT_EQ(convex_parts(square).size(), 1u);
  // steps of a slope, and a star
  Polygon steps = { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 2, 3 },
                    { 2, 2 }, { 1, 2 }, { 1, 1 }, { 0, 1 } };
  Polygon star;
  for (unsigned int i = 0; i < 10; ++i)
  {
    const double a = i * std::acos(-1.) / 5., r = i % 2 == 0 ? 2. : 0.7;
    star.emplace_back(r * std::cos(a), r * std::sin(a));
  }
  for (const Polygon &polygon : { steps, star })
  {
    double sum = 0.;
    for (const Polygon &part : convex_parts(polygon))
    {
      EXPECT_GT(signed_area(part), 0.);
      sum += signed_area(part);
    }
    EXPECT_NEAR(sum, signed_area(polygon), 1e-12);
  }
}

TEST(RockBody, RoundsHaveTheirVolumesInJointedRock)
{
  RockBoxParameters rock = cube();
  rock.bodies            = { tunnel() };
  add_sets(rock);
  const RockBox box = cut_rock_box(rock);
  auto of           = volumes(rock, box);
  EXPECT_NEAR(of["tunnel_1"], 3. * area_of_24, 1e-9);
  EXPECT_NEAR(of["tunnel_2"], 3. * area_of_24, 1e-9);
  EXPECT_NEAR(of["tunnel_3"], 4. * area_of_24, 1e-9);
  EXPECT_NEAR(of["rock"], 12. * 12. * 12. - 10. * area_of_24, 1e-8);
  // Joints are those of the rock without a tunnel.
  RockBoxParameters whole = rock;
  whole.bodies.clear();
  const RockBox without = cut_rock_box(whole);
  for (unsigned int s = 0; s < 3; ++s)
    EXPECT_NEAR(box.joint_area(s), without.joint_area(s), 1e-8);
  const std::vector<double> blocks = box.block_volumes();
  EXPECT_NEAR(std::accumulate(blocks.begin(), blocks.end(), 0.), 1728., 1e-8);
}

TEST(RockBody, BordersCloseBlocks)
{
  RockBoxParameters rock = cube();
  rock.bodies            = { tunnel() };
  add_sets(rock);
  const BlockBorders borders(rock, cut_rock_box(rock));
  std::vector<std::map<std::pair<unsigned int, unsigned int>, int>> edges(
      borders.n_blocks());
  for (const auto &border : borders.borders())
    for (const auto &loop : border.loops)
      for (std::size_t i = 0; i < loop.size(); ++i)
        for (const unsigned int b : border.blocks)
          if (b != none)
            ++edges[b][std::minmax(loop[i], loop[(i + 1) % loop.size()])];
  for (const auto &of : edges)
  {
    EXPECT_FALSE(of.empty());
    for (const auto &[edge, n] : of)
      EXPECT_EQ(n, 2); // each edge has two borders of a block
  }
}

TEST(RockBody, MeshesHaveTheBlocksAndTheVolume)
{
  RockBoxParameters rock = cube();
  rock.bodies            = { tunnel() };
  rock.bodies[0].size    = 1.;
  add_sets(rock);
  const RockBox box = cut_rock_box(rock);
  const Meshed mesh = meshed(rock, box);
  EXPECT_EQ(mesh.n_blocks, BlockBorders(rock, box).n_blocks());
  EXPECT_NEAR(mesh.volume, 1728., 1e-8);
}

TEST(RockBody, HolesOfAnyShapeAndBodiesWithinABlock)
{
  // A box without joints: a trench with steps, and a cavern within the rock.
  RockBoxParameters rock = cube();
  const Polygon steps    = { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 2, 3 },
                             { 2, 2 }, { 1, 2 }, { 1, 1 }, { 0, 1 } };
  rock.bodies
      = { body_of("trench", steps, SpacePoint(1, -1, 3), SpacePoint(1, 20, 3)),
          body_of("cavern", { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } },
                  SpacePoint(-2, 4, -2), SpacePoint(-2, 6, -2)) };
  rock.bodies[0].is_hole = true;
  const RockBox box      = cut_rock_box(rock);
  const double left      = 1728. - 12. * 6. - 8.;
  EXPECT_NEAR(box.rock_volume(), left + 8., 1e-9);
  auto of = volumes(rock, box);
  EXPECT_NEAR(of["rock"], left, 1e-9);
  EXPECT_NEAR(of["cavern"], 8., 1e-10);
  ASSERT_EQ(box.block_volumes().size(), 2u);
  const BlockBorders borders(rock, box);
  ASSERT_EQ(borders.n_blocks(), 2u);
  // That of the rock has a second closed surface, around the cavern.
  const auto shells = borders.shells();
  EXPECT_EQ(shells[0].size() + shells[1].size(), 3u);
  // Nothing is left of the cuts: there are the sides of the box, of which the
  // trench divides the top, its floor, steps and walls, and those of the
  // cavern.
  EXPECT_EQ(borders.borders().size(), 7u + 7u + 6u);
  const Meshed mesh = meshed(rock, box);
  EXPECT_EQ(mesh.n_blocks, 2u);
  EXPECT_NEAR(mesh.volume, left + 8., 1e-8);
}

TEST(RockBody, NoJointsInsideNorAtItsSurface)
{
  RockBoxParameters rock    = cube();
  rock.bodies               = { tunnel() };
  rock.bodies[0].has_joints = false;
  add_sets(rock);
  const RockBox box        = cut_rock_box(rock);
  unsigned int n_in_tunnel = 0;
  const BlockBorders borders(rock, box);
  for (unsigned int b = 0; b < borders.n_blocks(); ++b)
    n_in_tunnel += borders.group(b) != "rock";
  EXPECT_EQ(n_in_tunnel, 3u); // a block for each round
  // Where the surface is no joint, what is inside and outside is one block.
  rock.sets.clear();
  rock.bodies[0].is_outlined = false;
  EXPECT_EQ(cut_rock_box(rock).block_volumes().size(), 1u);
  EXPECT_TRUE(rock_box_geometry(rock, cut_rock_box(rock)).joint_curves.empty());
}

TEST(RockBody, EarlierBodiesPrevailAndThoseOutsideAreRefused)
{
  RockBoxParameters rock = cube();
  const Polygon square   = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
  rock.bodies
      = { body_of("north", square, SpacePoint(0, 0, 0), SpacePoint(0, 12, 0)),
          body_of("east", square, SpacePoint(-6, 6, 0), SpacePoint(6, 6, 0)) };
  auto of = volumes(rock, cut_rock_box(rock));
  EXPECT_NEAR(of["north"], 48., 1e-9);
  EXPECT_NEAR(of["east"], 40., 1e-9);
  rock.bodies.push_back(
      body_of("again", square, SpacePoint(0, 1, 0), SpacePoint(0, 5, 0)));
  EXPECT_THROW(cut_rock_box(rock), InputError);
}
