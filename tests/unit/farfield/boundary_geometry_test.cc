// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/base/exceptions.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace quoin;

namespace
{

  BoundaryCurveParameters circle(const double radius, const unsigned int n)
  {
    BoundaryCurveParameters curve;
    curve.name       = "circle";
    curve.shape      = BoundaryShape::circle;
    curve.radius     = radius;
    curve.angles     = { { 0., 2. * M_PI } };
    curve.n_elements = n;
    return curve;
  }

  BoundaryCurveParameters line(const std::string &name,
                               const std::vector<std::array<double, 2>> &points,
                               const DomainSide side = DomainSide::left)
  {
    BoundaryCurveParameters curve;
    curve.name   = name;
    curve.shape  = points.size() > 2 && side != DomainSide::left
                          && side != DomainSide::right
                       ? BoundaryShape::polygon
                       : BoundaryShape::line;
    curve.points = points;
    curve.domain = side;
    return curve;
  }

  Boundary make(const std::vector<BoundaryCurveParameters> &curves,
                const double length     = 0.,
                const MeshData<2> &mesh = MeshData<2>())
  {
    BoundaryElementParameters parameters;
    parameters.boundaries     = curves;
    parameters.element_length = length;
    return make_boundary_geometry(parameters, mesh).boundary;
  }

  std::string complaint(const std::vector<BoundaryCurveParameters> &curves,
                        const double length     = 0.,
                        const MeshData<2> &mesh = MeshData<2>())
  {
    return message_of<InputError>([&] { make(curves, length, mesh); });
  }

  /** Twice the area on the left of the elements is their sum. */
  double area(const Boundary &boundary)
  {
    double sum = 0.;
    for (const BoundaryElement &e : boundary.elements)
      sum += 0.5 * (e.a[0] * e.b[1] - e.a[1] * e.b[0]);
    return sum;
  }

  /** A square with the side 2 and edges of 1 m, and a line across. */
  MeshData<2> square_mesh()
  {
    MeshData<2> mesh;
    mesh.vertices   = { { 0., 0. }, { 1., 0. }, { 2., 0. }, { 2., 1. },
                        { 2., 2. }, { 1., 2. }, { 0., 2. }, { 0., 1. } };
    mesh.face_names = { "", "lower", "upper", "across" };
    const auto add =
        [&](const unsigned int a, const unsigned int b, const unsigned int name)
    {
      mesh.faces.push_back({ { a, b } });
      mesh.face_name.push_back(name);
    };
    // Not in order, nor all in one direction.
    add(1, 2, 1);
    add(0, 1, 1);
    add(4, 3, 2);
    add(2, 3, 2);
    add(4, 5, 2);
    add(6, 7, 2);
    add(6, 5, 2);
    add(0, 7, 2);
    add(1, 5, 3);
    return mesh;
  }

  BoundaryCurveParameters curves(const std::vector<std::string> &names,
                                 const DomainSide side)
  {
    BoundaryCurveParameters curve;
    curve.name   = "ring";
    curve.shape  = BoundaryShape::mesh;
    curve.curves = names;
    curve.domain = side;
    return curve;
  }
} // namespace

TEST(BoundaryGeometry, Circles)
{
  BoundaryCurveParameters hole = circle(2., 24);
  Boundary boundary            = make({ hole });
  EXPECT_EQ(boundary.n_elements(), 24u);
  EXPECT_LT(area(boundary), 0.) << "clockwise, the domain outside";
  EXPECT_NEAR(boundary.elements.front().a.norm(), 2., 1e-14);

  hole.polygon = CirclePolygon::equal_area;
  EXPECT_NEAR(area(make({ hole })), -4. * M_PI, 1e-12);
  hole.polygon = CirclePolygon::equal_perimeter;
  EXPECT_NEAR(make({ hole }).lengths().sum(), 4. * M_PI, 1e-12);

  hole.domain     = DomainSide::inside;
  hole.n_elements = 0;
  hole.angles[0]  = 0.1;
  boundary        = make({ hole }, 0.5);
  EXPECT_EQ(boundary.n_elements(), 26u); // 25.1 from the length
  EXPECT_GT(area(boundary), 0.);
  EXPECT_NEAR(std::atan2(boundary.elements[0].a[1], boundary.elements[0].a[0]),
              0.1, 1e-14);
}

TEST(BoundaryGeometry, Polygons)
{
  auto box = line("box", { { 0., 0. }, { 0., 2. }, { 3., 2. }, { 3., 0. } },
                  DomainSide::inside);
  Boundary boundary = make({ box }, 1.);
  EXPECT_EQ(boundary.n_elements(), 10u);
  EXPECT_NEAR(area(boundary), 6., 1e-14) << "whatever the order of corners";
  box.domain     = DomainSide::outside;
  box.n_elements = 7;
  boundary       = make({ box });
  EXPECT_EQ(boundary.n_elements(), 7u);
  EXPECT_NEAR(area(boundary), -6., 1e-14);
  box.n_elements = 3;
  EXPECT_NE(complaint({ box }).find("'Elements = 3'"), std::string::npos);
}

TEST(BoundaryGeometry, LinesAreGraded)
{
  auto surface    = line("surface", { { 0., 0. }, { 10., 0. } });
  surface.grading = 4.;
  Boundary b      = make({ surface }, 0.5);
  EXPECT_LE(b.elements.front().length(), 0.5 * (1. + 1e-9));
  EXPECT_NEAR(b.elements.back().length() / b.elements.front().length(), 4.,
              1e-9);
  const std::size_t n = b.n_elements();
  surface.n_elements  = unsigned(n - 1);
  EXPECT_GT(make({ surface }).elements.front().length(), 0.5)
      << "no fewer would do";
  surface.domain = DomainSide::right;
  b              = make({ surface });
  EXPECT_EQ(b.elements.front().a, dealii::Point<2>(10., 0.));
  EXPECT_GT(b.elements.front().length(), b.elements.back().length());
}

TEST(BoundaryGeometry, ArcsMeetLines)
{
  // A half-plane with a canyon; the ends differ by rounding.
  BoundaryCurveParameters canyon = circle(1., 16);
  canyon.name                    = "canyon";
  canyon.shape                   = BoundaryShape::arc;
  canyon.angles                  = { { 2. * M_PI, M_PI } };
  canyon.domain                  = DomainSide::right;
  const auto east = line("east", { { 1., 0. }, { 4., 0. } }, DomainSide::right);
  const auto west
      = line("west", { { -4., 0. }, { -1., 0. } }, DomainSide::right);
  // The arc runs from east to west.
  EXPECT_NE(
      complaint({ canyon, west }, 0.5).find("have the domain on different"),
      std::string::npos);
  canyon.angles           = { { M_PI, 2. * M_PI } };
  const Boundary boundary = make({ west, canyon, east }, 0.5);
  EXPECT_EQ(boundary.n_elements(), 6u + 16u + 6u);
  // All of it in one chain.
  unsigned int joined = 0;
  for (const auto &e : boundary.elements)
    for (const auto &f : boundary.elements)
      joined += e.b == f.a;
  EXPECT_EQ(joined, boundary.n_elements() - 1);
  EXPECT_TRUE(nearest_element(boundary, { 0., -1.5 }).inside_domain);
  EXPECT_FALSE(nearest_element(boundary, { 0., -0.5 }).inside_domain);
  EXPECT_TRUE(nearest_element(boundary, { 3., -0.5 }).inside_domain);
  EXPECT_FALSE(nearest_element(boundary, { 3., 0.5 }).inside_domain);
}

TEST(BoundaryGeometry, NearestElement)
{
  const Boundary boundary
      = make({ line("box", { { 0., 0. }, { 2., 0. }, { 2., 2. }, { 0., 2. } },
                    DomainSide::outside) },
             0.5);
  const auto corner = nearest_element(boundary, { 2.3, 2.4 });
  EXPECT_TRUE(corner.inside_domain);
  EXPECT_NEAR(corner.distance, 0.5, 1e-14);
  EXPECT_FALSE(nearest_element(boundary, { 1.9, 1.8 }).inside_domain);
  EXPECT_TRUE(nearest_element(boundary, { -0.1, 1. }).inside_domain);
}

TEST(BoundaryGeometry, CurvesOfAMesh)
{
  const MeshData<2> mesh = square_mesh();
  Boundary b
      = make({ curves({ "lower", "upper" }, DomainSide::inside) }, 0., mesh);
  EXPECT_EQ(b.n_elements(), 8u) << "the edges of the mesh";
  EXPECT_NEAR(area(b), 4., 1e-14);
  b = make({ curves({ "upper", "lower" }, DomainSide::outside) }, 0.8, mesh);
  EXPECT_EQ(b.n_elements(), 12u) << "three on each straight side";
  EXPECT_NEAR(area(b), -4., 1e-14);
  b = make({ curves({ "lower" }, DomainSide::left) }, 0., mesh);
  EXPECT_EQ(b.elements.front().a, dealii::Point<2>(0., 0.));
  EXPECT_EQ(b.elements.back().b, dealii::Point<2>(2., 0.));
  b = make({ curves({ "lower" }, DomainSide::right) }, 0., mesh);
  EXPECT_EQ(b.elements.front().a, dealii::Point<2>(2., 0.));
}

TEST(BoundaryGeometry, BlocksThatTouchMakeOneCurve)
{
  // Two vertices at the same place but for rounding, one on either side of
  // half a unit of 1e-9 of the size.
  MeshData<2> mesh = square_mesh();
  mesh.vertices[1] = { 1. + 1e-9 - 4e-16, 0. };
  mesh.vertices.push_back({ 1. + 1e-9 + 4e-16, 0. });
  mesh.faces[0][0] = 8; // the edge from 1 to 2
  EXPECT_EQ(
      make({ curves({ "lower" }, DomainSide::left) }, 0., mesh).n_elements(),
      2u);
}

// They span whole edges, as evenly as these allow.
TEST(BoundaryGeometry, ElementsAlongBlocksAreAboutAsLongAsWanted)
{
  constexpr unsigned int n = 40;
  MeshData<2> mesh;
  mesh.face_names = { "", "ring" };
  for (unsigned int k = 0; k < n; ++k)
  {
    const double angle = 2. * M_PI * k / n;
    mesh.vertices.emplace_back(2. * std::cos(angle), 2. * std::sin(angle));
    mesh.faces.push_back({ { k, (k + 1) % n } });
    mesh.face_name.push_back(1);
  }
  const double edge            = 4. * std::sin(M_PI / n); // 0.314 m
  BoundaryCurveParameters ring = curves({ "ring" }, DomainSide::outside);
  ring.shape                   = BoundaryShape::interface;
  const auto n_elements        = [&](const double length)
  { return make({ ring }, length, mesh).n_elements(); };
  EXPECT_EQ(n_elements(1.02 * edge), 40U);
  EXPECT_EQ(n_elements(1.45 * edge), 40U); // two are 1.38 as long
  EXPECT_EQ(n_elements(2. * edge), 20U);
  EXPECT_EQ(n_elements(2.4 * edge), 20U);
  // twelve of three edges, two of two
  EXPECT_EQ(n_elements(3.1 * edge), 14U);
  EXPECT_NEAR(make({ ring }, 3.1 * edge, mesh).lengths().minCoeff(),
              4. * std::sin(2. * M_PI / n), 1e-12);
  EXPECT_EQ(n_elements(0.5 * edge), 40U);
  // A number is kept, whatever the lengths.
  ring.n_elements = 38;
  EXPECT_EQ(n_elements(0.), 38U);
}

TEST(BoundaryGeometry, Complaints)
{
  const MeshData<2> mesh = square_mesh();
  const auto says = [](const std::string &message, const std::string &word)
  { EXPECT_NE(message.find(word), std::string::npos) << message; };
  says(complaint({ curves({ "middle" }, DomainSide::left) }, 0., mesh),
       "lower, upper, across");
  says(complaint({ curves({ "lower", "upper", "across" }, DomainSide::inside) },
                 0., mesh),
       "branch");
  says(complaint({ curves({ "lower" }, DomainSide::inside) }, 0., mesh),
       "left or right");
  says(complaint({ curves({ "lower", "upper" }, DomainSide::left) }, 0., mesh),
       "inside or outside");

  // Crossing, coinciding, touching, and back on itself.
  auto other      = circle(1., 16);
  other.name      = "other";
  other.centre[0] = 1.5;
  says(complaint({ circle(1., 16), other }), "have points in common");
  says(complaint({ circle(1., 16), circle(1., 16) }), "have points in common");
  says(complaint({ line("a", { { 0., 0. }, { 2., 0. } }),
                   line("b", { { 1., 0. }, { 1., 2. } }) },
                 2.),
       "have points in common");
  says(complaint({ line("a", { { 0., 0. }, { 2., 0. }, { 1., 0. } }) }, 5.),
       "have points in common");
  says(complaint({ line("a", { { 0., 0. }, { 2., 0. } }),
                   line("b", { { 2., 0. }, { 4., 0. } }, DomainSide::right) },
                 1.),
       "different sides");
  says(complaint({ circle(1., 16), circle(3., 32) }), "is not on the side of");

  // Given by their number, of all boundaries.
  other.centre[0]  = 5.;
  other.n_elements = 15000;
  says(complaint({ circle(1., 15000), other }), "30000 elements");
}
