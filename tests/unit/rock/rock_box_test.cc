// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/gmsh_reader.h>
#include <quoin/base/exceptions.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/rock/rock_box.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace quoin;

namespace
{
  using SpacePoint = dealii::Point<3>;

  RockBoxParameters box_of(const SpacePoint &high)
  {
    RockBoxParameters rock;
    rock.high           = high;
    rock.element_size   = 2.;
    rock.shortest_edge  = 0.;
    rock.smallest_block = 0.;
    return rock;
  }

  SpaceJointSet space_set(const std::string &name, const double dip,
                          const double dip_direction,
                          const std::string &spacing,
                          const SpacePoint &origin = SpacePoint())
  {
    SpaceJointSet set;
    set.name          = name;
    set.dip           = dip;
    set.dip_direction = dip_direction;
    set.spacing       = Distribution::parse(spacing);
    set.origin        = origin;
    return set;
  }

  RockBoxParameters three_orthogonal_sets()
  {
    RockBoxParameters rock = box_of(SpacePoint(6, 4, 3));
    rock.sets
        = { space_set("east", 90, 90, "1"), space_set("north", 90, 0, "1"),
            space_set("flat", 0, 0, "1") };
    return rock;
  }

  RockBoxParameters scattered_sets()
  {
    RockBoxParameters rock = box_of(SpacePoint(10, 10, 10));
    rock.sets              = { space_set("a", 40, 130, "log-normal 2, 0.5"),
                               space_set("b", 60, 220, "exponential 2"),
                               space_set("c", 10, 20, "2") };
    for (SpaceJointSet &set : rock.sets)
    {
      set.concentration = 50.;
      set.persistence   = 0.7;
    }
    return rock;
  }
} // namespace

TEST(RockBox, OrthogonalSetsMakeCubes)
{
  const RockBoxParameters rock = three_orthogonal_sets();
  const RockBox box            = cut_rock_box(rock);
  ASSERT_EQ(box.pieces.n_blocks(), 6u * 4u * 3u);
  for (unsigned int b = 0; b < box.pieces.n_blocks(); ++b)
    EXPECT_NEAR(box.pieces.volume(b), 1., 1e-12);
  EXPECT_EQ(box.n_refused, 0u);
  EXPECT_NEAR(box.joint_area(0), 5. * 4. * 3., 1e-10);
  EXPECT_NEAR(box.joint_area(1), 3. * 6. * 3., 1e-10);
  EXPECT_NEAR(box.joint_area(2), 2. * 6. * 4., 1e-10);
}

TEST(RockBox, AreaPerVolumeIsTheInverseOfSpacing)
{
  // Planes in the middle of spacings: the box holds whole numbers of them.
  RockBoxParameters rock = box_of(SpacePoint(6, 4, 3));
  const SpacePoint half(0.25, 0.25, 0.25);
  rock.sets         = { space_set("east", 90, 90, "0.5", half),
                        space_set("north", 90, 0, "0.5", half),
                        space_set("flat", 0, 0, "0.5", half) };
  const RockBox box = cut_rock_box(rock);
  for (unsigned int s = 0; s < 3; ++s)
    EXPECT_NEAR(box.joint_area(s) / 72., 1. / 0.5, 1e-10);
  EXPECT_EQ(
      box.n_crossings(0, SpacePoint(0, 1.1, 1.1), SpacePoint(6, 1.1, 1.1)),
      12u);
}

TEST(RockBox, ScanlineAtAnAngleMeetsFewerJoints)
{
  RockBoxParameters rock = box_of(SpacePoint(100, 100, 1));
  rock.sets              = { space_set("east", 90, 90, "0.5") };
  const RockBox box      = cut_rock_box(rock);
  const SpacePoint a(0.1, 0.1, 0.5), b(60.1, 80.1, 0.5);
  // 100 m at a cosine of 0.6 to the normal
  EXPECT_EQ(box.n_crossings(0, a, b),
            static_cast<unsigned int>(100 * 0.6 / 0.5));
  const dealii::Tensor<1, 3> direction = b - a;
  EXPECT_NEAR(box.joint_frequency(0, direction / direction.norm()),
              box.joint_area(0) / box.rock_volume() * 0.6, 1e-12);
}

TEST(RockBox, VolumesSumUpAndFacesCloseBlocks)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    RockBoxParameters rock = scattered_sets();
    rock.seed              = seed;
    rock.shortest_edge     = seed % 2 == 0 ? 0.1 : 0.;
    const RockBox box      = cut_rock_box(rock);
    EXPECT_GT(box.pieces.n_blocks(), 20u);
    EXPECT_NEAR(box.rock_volume(), 1000., 1e-9);
    for (unsigned int b = 0; b < box.pieces.n_blocks(); ++b)
    {
      std::map<std::pair<unsigned int, unsigned int>, int> edges;
      for (const unsigned int f : box.pieces.faces_of(b))
      {
        const auto &face = box.pieces.faces()[f];
        for (std::size_t i = 0; i < face.loop.size(); ++i)
        {
          unsigned int u = face.loop[i];
          unsigned int v = face.loop[(i + 1) % face.loop.size()];
          if (face.inner != b)
            std::swap(u, v);
          ++edges[{ u, v }];
        }
      }
      for (const auto &[edge, n] : edges)
      {
        ASSERT_EQ(n, 1);
        ASSERT_EQ(edges.count({ edge.second, edge.first }), 1u);
      }
    }
    const auto &x = box.pieces.vertices();
    for (const auto &face : box.pieces.faces())
      for (std::size_t i = 0; i < face.loop.size(); ++i)
      {
        const unsigned int v = face.loop[(i + 1) % face.loop.size()];
        EXPECT_GE(x[face.loop[i]].distance(x[v]), rock.shortest_edge - 1e-12);
      }
  }
}

TEST(RockBox, FisherScatterHasItsMeanAndResultant)
{
  const double kappa = 20.;
  const auto mean    = plane_normal(40, 130);
  constexpr int n    = 20000;
  dealii::Tensor<1, 3> sum;
  RandomStream random(3, "fisher", 0);
  for (int i = 0; i < n; ++i)
    sum += draw_fisher(mean, kappa, random);
  // The mean cosine is coth(kappa) - 1/kappa, its variance 1/kappa^2 nearly.
  EXPECT_NEAR(sum * mean / n, 1. / std::tanh(kappa) - 1. / kappa,
              4. / kappa / std::sqrt(n));
  // A component across has the variance 1/kappa nearly.
  const auto across = sum - (sum * mean) * mean;
  EXPECT_LT(across.norm() / n, 5. / std::sqrt(kappa * n));
}

TEST(RockBox, PersistenceIsTheShareOfJointArea)
{
  double made = 0.;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    RockBoxParameters rock = three_orthogonal_sets();
    rock.high              = SpacePoint(20, 2, 2);
    rock.sets.resize(1);
    rock.sets[0].persistence = 0.5;
    rock.seed                = seed;
    made += cut_rock_box(rock).joint_area(0) / 4.;
  }
  // 20 x 19 cuts with the probability a half each, four deviations
  EXPECT_NEAR(made, 190., 4. * std::sqrt(380. * 0.25));
}

TEST(RockBox, TwoPlanesMeetInTheLineOfTheWedge)
{
  // Line of intersection of 40/130 and 60/220, at right angles in direction:
  // tan(plunge) = 1 / sqrt(cot(40)^2 + cot(60)^2).
  RockBoxParameters rock = box_of(SpacePoint(10, 10, 10));
  const SpacePoint centre(5, 5, 5);
  rock.sets         = { space_set("a", 40, 130, "100", centre),
                        space_set("b", 60, 220, "100", centre) };
  const RockBox box = cut_rock_box(rock);
  ASSERT_EQ(box.pieces.n_blocks(), 4u);
  const double degree = std::acos(-1.) / 180.;
  const double plunge = std::atan(
      1.
      / std::hypot(1. / std::tan(40. * degree), 1. / std::tan(60. * degree)));
  double found = 0.;
  for (const auto &face : box.pieces.faces())
    if (face.surface == RockBox::surface(0))
      for (std::size_t i = 0; i < face.loop.size(); ++i)
      {
        const auto &x       = box.pieces.vertices();
        const SpacePoint &p = x[face.loop[i]];
        const SpacePoint &q = x[face.loop[(i + 1) % face.loop.size()]];
        const auto normal   = rock.sets[1].mean_normal();
        if (std::abs(normal * (p - centre)) < 1e-9
            && std::abs(normal * (q - centre)) < 1e-9)
          found = std::asin(std::abs(p[2] - q[2]) / p.distance(q));
      }
  EXPECT_NEAR(found, plunge, 1e-10);
}

TEST(RockBox, SeedMakesItReproducible)
{
  RockBoxParameters rock = scattered_sets();
  const std::string text = rock_box_geometry(rock, cut_rock_box(rock)).text;
  EXPECT_EQ(rock_box_geometry(rock, cut_rock_box(rock)).text, text);
  rock.seed = 2;
  EXPECT_NE(rock_box_geometry(rock, cut_rock_box(rock)).text, text);
}

TEST(RockBox, MeshesIntoBlocksWithTheJointsOfItsFaces)
{
  for (RockBoxParameters rock : { three_orthogonal_sets(), scattered_sets() })
  {
    rock.shortest_edge  = 0.1;
    rock.smallest_block = 0.01;
    const RockBox box   = cut_rock_box(rock);
    const auto geometry = rock_box_geometry(rock, box);
    SplitOptions options;
    options.joints_along = geometry.joint_curves;
    const auto mesh      = std::get<MeshData<3>>(mesh_any_gmsh_geometry(
             geometry.text, "rock", MPI_COMM_SELF, MeshDimension::three));
    double volume        = 0.;
    for (const auto &cell : mesh.cells)
    {
      const SpacePoint &a = mesh.vertices[cell[0]];
      volume += dealii::cross_product_3d(mesh.vertices[cell[1]] - a,
                                         mesh.vertices[cell[2]] - a)
                * (mesh.vertices[cell[3]] - a) / 6.;
    }
    const SpacePoint size(rock.high);
    EXPECT_NEAR(volume, size[0] * size[1] * size[2], 1e-8);
    BlockMesh<3> blocks = split_into_blocks(mesh, options);
    EXPECT_EQ(blocks.n_blocks(), box.pieces.n_blocks());
  }
}

TEST(RockBox, SaysHowMuchOfTheJointsIsLeftOut)
{
  RockBoxParameters rock = box_of(SpacePoint(6, 4, 3));
  rock.smallest_block    = 15.;
  rock.sets = { space_set("east", 90, 90, "3"), space_set("flat", 0, 0, "2") };
  // At z = 2 m both halves would lose 12 of their 36 m^3.
  const RockBox box = cut_rock_box(rock);
  EXPECT_EQ(box.n_refused, 2u);
  EXPECT_NEAR(box.refused_area[0], 0., 1e-12);
  EXPECT_NEAR(box.refused_area[1], 24., 1e-12);
  EXPECT_NE(rock_box_report(rock, box).find(
                "joints of 24 m^2 of set 'flat', 100 % of the set's joints"),
            std::string::npos);
}

TEST(RockBox, MovesPlanesThatWouldLeaveOutALargeBlock)
{
  // A plane at 45 degrees, 7 mm from an edge of the box: the cut would be
  // refused because of edges of 1 cm.
  RockBoxParameters rock = box_of(SpacePoint(10, 10, 10));
  rock.shortest_edge     = 0.1;
  rock.sets   = { space_set("a", 45, 90, "100", SpacePoint(0.01, 5, 10)) };
  RockBox box = cut_rock_box(rock);
  EXPECT_EQ(box.n_refused, 0u);
  EXPECT_EQ(box.n_moved, 1u);
  EXPECT_NEAR(box.largest_move, 0.1, 1e-12);
  // away from the edge, by which it becomes shorter on both sides
  EXPECT_NEAR(box.joint_area(0), 10. * (std::sqrt(2.) * 9.99 - 0.2), 1e-10);
  EXPECT_NE(rock_box_report(rock, box).find("1 plane moved by up to 0.1 m"),
            std::string::npos);
  // One that passes further away stays where it is.
  rock.sets[0].origin = SpacePoint(0.2, 5, 10);
  box                 = cut_rock_box(rock);
  EXPECT_EQ(box.n_moved, 0u);
  EXPECT_NEAR(box.joint_area(0), 10. * std::sqrt(2.) * 9.8, 1e-10);
}

TEST(RockBox, RefusesTooManyBlocksAndNone)
{
  RockBoxParameters rock = three_orthogonal_sets();
  rock.most_blocks       = 50;
  EXPECT_THROW(cut_rock_box(rock), InputError);
  rock.most_blocks = 72;
  EXPECT_NO_THROW(cut_rock_box(rock));
  rock.sets = { space_set("far", 0, 0, "1000", SpacePoint(0, 0, 500)) };
  EXPECT_THROW(cut_rock_box(rock), InputError);
}
