// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/rock/rock_layout.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace quoin;

namespace
{
  using Point                 = dealii::Point<2>;
  constexpr unsigned int none = -1;

  RockParameters square_rock(const double size)
  {
    RockParameters rock;
    rock.outline
        = { Point(0, 0), Point(size, 0), Point(size, size), Point(0, size) };
    rock.sides        = { "base", "right", "top", "left" };
    rock.element_size = rock.finest_size = 1.;
    rock.shortest_edge                   = 0.02;
    rock.smallest_block                  = 0.01;
    rock.narrowest_block                 = 0.02;
    rock.size_growth                     = 0.2;
    return rock;
  }

  RockJoints joint_set(const std::string &name, const std::string &dip,
                       const std::string &spacing)
  {
    RockJoints joints;
    joints.name          = name;
    joints.dip           = Distribution::parse(dip);
    joints.spacing       = Distribution::parse(spacing);
    joints.is_persistent = true;
    return joints;
  }

  RockJoints traces(RockJoints joints, const std::string &length,
                    const std::string &gap)
  {
    joints.is_persistent = false;
    joints.length        = Distribution::parse(length);
    joints.gap           = Distribution::parse(gap);
    return joints;
  }

  RockRegion region(const std::string &name, const RockRegion::Use use,
                    const Polygon &polygon)
  {
    RockRegion result;
    result.name    = name;
    result.use     = use;
    result.polygon = polygon;
    return result;
  }

  struct Sample
  {
    double sum = 0., squares = 0.;
    std::size_t n = 0;

    void add(const std::vector<double> &values)
    {
      for (const double v : values)
      {
        sum += v;
        squares += v * v;
      }
      n += values.size();
    }
    double mean() const
    {
      return sum / n;
    }
    double deviation() const
    {
      return std::sqrt(squares / n - mean() * mean());
    }
    /** Within four sampling errors of what was asked. */
    void expect(const Distribution &asked, const std::string &what) const
    {
      ASSERT_GT(n, 1000u) << what;
      const double error = asked.deviation / std::sqrt(double(n));
      EXPECT_NEAR(mean(), asked.mean, 4. * error) << what;
      EXPECT_NEAR(deviation(), asked.deviation, 0.06 * asked.deviation) << what;
    }
  };

  using TestPoint = boost::geometry::model::d2::point_xy<double>;
  using TestPolygon
      = boost::geometry::model::polygon<TestPoint, /*clockwise*/ false,
                                        /*closed*/ false>;

  TestPolygon test_polygon(const BlockFaces &faces,
                           const BlockFaces::Face &face)
  {
    TestPolygon polygon;
    for (const Point &p : faces.polygon(face.outer))
      polygon.outer().emplace_back(p[0], p[1]);
    for (const auto &loop : face.inner)
    {
      polygon.inners().emplace_back();
      for (const Point &p : faces.polygon(loop))
        polygon.inners().back().emplace_back(p[0], p[1]);
    }
    return polygon;
  }
} // namespace

TEST(RockLayout, draws_what_is_asked_for_over_many_seeds)
{
  // Each property with another distribution in turn, 40 seeds.
  const struct
  {
    const char *dip, *spacing, *length, *gap;
  } kinds[] = {
    { "uniform 20, 5", "uniform 1, 0.2", "uniform 5, 1", "uniform 1, 0.3" },
    { "normal 20, 5", "normal 1, 0.2", "normal 5, 1", "normal 1, 0.2" },
    { "Fisher 20, 8", "log-normal 1, 0.6", "log-normal 5, 3",
      "log-normal 1, 0.5" },
    { "20", "exponential 1", "exponential 5", "exponential 1" },
  };
  for (const auto &kind : kinds)
  {
    Sample dip, spacing, length, gap;
    RockParameters rock = square_rock(20.);
    rock.joints = { traces(joint_set("a", kind.dip, kind.spacing), kind.length,
                           kind.gap) };
    for (rock.seed = 1; rock.seed <= 40; ++rock.seed)
    {
      const JointTraces made = make_joint_traces(rock, 0);
      dip.add(made.drawn.dip);
      spacing.add(made.drawn.spacing);
      length.add(made.drawn.length);
      gap.add(made.drawn.gap);
    }
    const RockJoints &asked = rock.joints[0];
    spacing.expect(asked.spacing, kind.spacing);
    length.expect(asked.length, kind.length);
    gap.expect(asked.gap, kind.gap);
    if (asked.dip.deviation > 0.)
      dip.expect(asked.dip, kind.dip);
  }
}

TEST(RockLayout, traces_in_the_outline_are_as_dense_as_asked_for)
{
  // Length per area: trace / (trace + gap) / spacing, in the mean over seeds.
  RockParameters rock = square_rock(20.);
  rock.joints   = { traces(joint_set("a", "Fisher 35, 6", "log-normal 1, 0.4"),
                           "exponential 4", "exponential 2") };
  double length = 0.;
  constexpr int seeds = 400;
  for (rock.seed = 1; rock.seed <= seeds; ++rock.seed)
    for (const Piece &piece : make_joint_traces(rock, 0).pieces)
      length += piece[0].distance(piece[1]);
  EXPECT_NEAR(length / seeds / 400., 4. / 6., 0.03 * 4. / 6.);
}

TEST(RockLayout, regular_sets_make_regular_blocks)
{
  RockParameters rock = square_rock(10.);
  rock.joints         = { joint_set("a", "0", "1"), joint_set("b", "90", "2") };
  rock.joints[0].origin = rock.joints[1].origin = Point(1., 0.5);
  const RockLayout layout                       = lay_rock(rock);
  // y = 0.5 ... 9.5: ten lines, eleven strips; x = 1, 3, ... 9: six strips.
  EXPECT_EQ(layout.n_blocks(), 66u);
  EXPECT_EQ(layout.changes.n_joined, 0u);
  EXPECT_EQ(layout.changes.n_slivers, 0u);
  EXPECT_NEAR(layout.block_area(), 100., 1e-10);
  const std::string table = rock_statistics(rock, layout);
  EXPECT_NE(table.find("a,spacing,m,1,0,"), std::string::npos) << table;
  EXPECT_NE(table.find("b,length per area,1/m,0.5,"), std::string::npos);
}

TEST(RockLayout, keeps_the_area_and_overlaps_nowhere)
{
  for (const auto ends :
       { RockParameters::cut, RockParameters::extend, RockParameters::keep })
    for (unsigned int seed = 1; seed <= 6; ++seed)
    {
      RockParameters rock = square_rock(30.);
      rock.outline        = { Point(0, 0),   Point(30, 0),  Point(30, 10),
                              Point(20, 10), Point(12, 25), Point(0, 25) };
      rock.sides.assign(6, "outline");
      rock.seed      = seed;
      rock.dead_ends = ends;
      rock.regions   = { region("tunnel", RockRegion::body,
                                arch_polygon(Point(6, 8), 5., 2., 2.5, 12)),
                         region("shaft", RockRegion::hole,
                                circle_polygon(Point(22, 5), 2., 20)) };
      rock.joints
          = { traces(joint_set("a", "Fisher 20, 8", "normal 1.5, 0.4"),
                     "exponential 8", "exponential 2"),
              traces(joint_set("b", "normal 100, 10", "log-normal 2, 1"),
                     "uniform 5, 2", "1") };
      const RockLayout layout = lay_rock(rock);
      const double hole       = signed_area(rock.regions[1].polygon);
      const double area       = signed_area(rock.outline) - hole;
      EXPECT_NEAR(layout.block_area(), area, 1e-12 * area) << seed;

      // Euler's formula for the network: V - E + F = 1 + C.
      const BlockFaces &faces = *layout.faces;
      std::set<unsigned int> vertices;
      for (const auto &edge : layout.network->edges())
      {
        vertices.insert(edge.from);
        vertices.insert(edge.to);
      }
      EXPECT_EQ(vertices.size() + faces.faces().size() + 1,
                layout.network->edges().size() + 1 + faces.n_parts());

      std::vector<TestPolygon> polygons;
      for (const auto &face : faces.faces())
      {
        polygons.push_back(test_polygon(faces, face));
        EXPECT_TRUE(boost::geometry::is_valid(polygons.back())) << seed;
      }
      for (std::size_t i = 0; i < polygons.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
        {
          if (boost::geometry::disjoint(
                  boost::geometry::return_envelope<
                      boost::geometry::model::box<TestPoint>>(polygons[i]),
                  boost::geometry::return_envelope<
                      boost::geometry::model::box<TestPoint>>(polygons[j])))
            continue;
          std::vector<TestPolygon> common;
          boost::geometry::intersection(polygons[i], polygons[j], common);
          double overlap = 0.;
          for (const auto &part : common)
            overlap += boost::geometry::area(part);
          EXPECT_LT(overlap, 1e-9) << seed;
        }

      const std::string report = rock_report(rock, layout);
      const auto says          = [&](const std::string &words)
      { return report.find(words) != std::string::npos; };
      EXPECT_EQ(says("kept as cracks"), ends == RockParameters::keep);
      EXPECT_EQ(says("lengthened"), ends == RockParameters::extend);
      const double cut = layout.changes.dead_length;
      EXPECT_EQ(says("cut back"), layout.changes.n_dead_ends > 0);
      if (ends == RockParameters::cut)
      {
        EXPECT_GT(cut, 0.);
      }
      if (ends == RockParameters::keep)
      {
        EXPECT_EQ(cut, 0.);
        EXPECT_GT(layout.changes.n_cracks, 0u);
      }
      if (ends == RockParameters::extend)
      {
        EXPECT_GT(layout.changes.n_extended, 0u);
        EXPECT_LT(cut, 1e-9);
      }
    }
}

TEST(RockLayout, joins_slivers_to_the_neighbour_with_the_longest_joint)
{
  RockParameters rock  = square_rock(10.);
  rock.narrowest_block = 0.3;
  RockJoints line;
  line.kind   = RockJoints::polyline;
  line.name   = "upper";
  line.points = { Point(0, 5.2), Point(10, 5.2) };
  rock.joints.push_back(line);
  line.name   = "lower";
  line.points = { Point(0, 5.), Point(10, 5.) };
  rock.joints.push_back(line);
  const RockLayout layout = lay_rock(rock);
  EXPECT_EQ(layout.n_blocks(), 2u);
  EXPECT_EQ(layout.changes.n_slivers, 1u);
  EXPECT_NEAR(layout.changes.sliver_area, 2., 1e-12);
  EXPECT_NE(rock_report(rock, layout)
                .find("0.3 m: 1 block, 2 m^2 in "
                      "all, joined to a neighbour"),
            std::string::npos);
}

TEST(RockLayout, finely_drawn_joints_do_not_vanish)
{
  RockParameters rock = square_rock(10.);
  rock.shortest_edge  = 0.1;
  RockJoints line;
  line.kind = RockJoints::polyline;
  line.name = "fault";
  for (double x = -0.03; x < 10.1; x += 0.08)
    line.points.emplace_back(x, 5. + std::sin(x));
  rock.joints             = { line };
  const RockLayout layout = lay_rock(rock);
  EXPECT_EQ(layout.n_blocks(), 2u);
  EXPECT_EQ(layout.changes.n_short, 0u);
  double lower = 0.; // the area below
  for (const auto &face : layout.faces->faces())
    lower = std::max(lower, face.area);
  EXPECT_NEAR(lower, 50. + 1. - std::cos(10.), 0.05);
}

TEST(RockLayout, joints_keep_to_their_region_and_out_of_others)
{
  RockParameters rock = square_rock(10.);
  rock.regions
      = { region("lining", RockRegion::body,
                 circle_polygon(Point(5, 5), 2., 24)),
          region("upper", RockRegion::zone,
                 { Point(0, 6), Point(10, 6), Point(10, 10), Point(0, 10) }) };
  rock.regions[0].has_joints = false;
  rock.joints = { joint_set("a", "0", "1"), joint_set("b", "90", "1") };
  rock.joints[0].origin   = Point(0, 0.5);
  rock.joints[1].origin   = Point(0.5, 0);
  rock.joints[1].region   = "upper";
  const RockLayout layout = lay_rock(rock);
  unsigned int in_lining  = 0;
  for (const unsigned int g : layout.group)
    in_lining += g == 1;
  EXPECT_EQ(in_lining, 1u);
  for (const auto &edge : layout.network->edges())
  {
    const Point p = layout.network->middle(edge);
    if (layout.line_names[edge.line] == "b")
    {
      EXPECT_GT(p[1], 6.);
    }
    if (edge.border == JointNetwork::none)
    {
      EXPECT_FALSE(contains(rock.regions[0].polygon, p));
    }
  }
}

TEST(RockLayout, seed_makes_it_reproducible_and_sets_independent)
{
  RockParameters rock = square_rock(20.);
  rock.joints         = { joint_set("a", "Fisher 20, 5", "exponential 2"),
                          joint_set("b", "normal 110, 5", "exponential 2") };
  const auto first    = make_joint_traces(rock, 0);
  EXPECT_EQ(make_joint_traces(rock, 0).pieces, first.pieces);
  std::swap(rock.joints[0], rock.joints[1]);
  EXPECT_EQ(make_joint_traces(rock, 1).pieces, first.pieces);
  rock.seed = 2;
  EXPECT_NE(make_joint_traces(rock, 1).pieces, first.pieces);
}

TEST(RockLayout, voronoi_blocks_have_the_size_asked_for)
{
  RockParameters rock = square_rock(30.);
  RockJoints joints;
  joints.kind       = RockJoints::voronoi;
  joints.name       = "v";
  joints.block_size = 1.5;
  rock.joints       = { joints };
  double spread[2];
  for (const unsigned int relaxation : { 0u, 5u })
  {
    rock.joints[0].relaxation = relaxation;
    const RockLayout layout   = lay_rock(rock);
    // Blocks at the outline are cut: about perimeter / size of them more.
    EXPECT_NEAR(layout.n_blocks(), 900. / 2.25 + 0.5 * 120. / 1.5, 60.);
    EXPECT_NEAR(layout.block_area(), 900., 1e-9);
    double squares = 0.;
    for (const auto &face : layout.faces->faces())
      squares += face.area * face.area;
    spread[relaxation > 0] = squares * layout.n_blocks() / (900. * 900.) - 1.;
  }
  // Poisson's have a variance of 0.28; relaxed ones a small one.
  EXPECT_LT(spread[1], 0.5 * spread[0]);
}

TEST(RockGeometry, borders_that_a_body_and_a_hole_share)
{
  const Polygon tunnel = { Point(3, 3), Point(7, 3), Point(7, 7), Point(3, 7) };
  const Polygon invert = { Point(3, 3), Point(7, 3), Point(7, 4), Point(3, 4) };
  const Polygon below  = { Point(3, 2), Point(7, 2), Point(7, 3), Point(3, 3) };
  const RockRegion hole = region("tunnel", RockRegion::hole, tunnel);
  // A body beside the hole or, on its floor, within it; first and last.
  for (const std::vector<RockRegion> &regions :
       { std::vector<RockRegion>{ region("slab", RockRegion::body, below),
                                  hole },
         std::vector<RockRegion>{ hole,
                                  region("slab", RockRegion::body, below) },
         std::vector<RockRegion>{ hole,
                                  region("slab", RockRegion::body, invert) } })
  {
    RockParameters rock     = square_rock(10.);
    rock.regions            = regions;
    const RockLayout layout = lay_rock(rock);
    const auto geometry     = rock_geometry(rock, layout);
    EXPECT_EQ(geometry.joint_curves, std::vector<std::string>{ "slab" });
    SplitOptions options;
    options.joints_along = geometry.joint_curves;
    BlockMesh<2> mesh    = split_into_blocks(
           mesh_gmsh_geometry(geometry.text, "rock", MPI_COMM_SELF), options);
    EXPECT_EQ(mesh.n_blocks(), 2u);
    // The hole's walls go round it, on whatever they are.
    double length = 0.;
    for (const BlockFace<2> &face : mesh.boundary_faces)
      if (face.name < mesh.face_names.size()
          && mesh.face_names[face.name] == "tunnel")
        length += mesh.vertices[face.vertices[0]].distance(
            mesh.vertices[face.vertices[1]]);
    EXPECT_NEAR(length, regions[1].polygon == invert ? 14. : 16., 1e-9);
  }
}

TEST(RockGeometry, gmsh_makes_the_blocks_of_the_layout)
{
  for (const auto ends : { RockParameters::cut, RockParameters::keep })
  {
    RockParameters rock          = square_rock(20.);
    rock.dead_ends               = ends;
    rock.finest_size             = 0.4;
    rock.regions                 = { region("tunnel", RockRegion::body,
                                            arch_polygon(Point(10, 8), 5., 2., 2.5, 12)),
                                     region("shaft", RockRegion::hole,
                                            circle_polygon(Point(16, 15), 1., 12)) };
    rock.regions[0].refines_mesh = true;
    rock.joints = { traces(joint_set("a", "Fisher 20, 8", "normal 3, 0.5"),
                           "exponential 9", "exponential 2"),
                    joint_set("b", "normal 100, 5", "uniform 4, 0.5") };
    const RockLayout layout     = lay_rock(rock);
    const GmshGeometry geometry = rock_geometry(rock, layout);
    SplitOptions options;
    options.joints_along = geometry.joint_curves;
    BlockMesh<2> mesh    = split_into_blocks(
           mesh_gmsh_geometry(geometry.text, "rock", MPI_COMM_SELF), options);
    EXPECT_EQ(mesh.n_blocks(), layout.n_blocks());
    double area = 0.;
    for (const auto &cell : mesh.cells)
    {
      const Polygon triangle = { mesh.vertices[cell[0]], mesh.vertices[cell[1]],
                                 mesh.vertices[cell[2]] };
      area += signed_area(triangle);
    }
    EXPECT_NEAR(area, layout.block_area(), 1e-9);
  }
}
