// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "../joint_laws/rock_walk.h"

#include <quoin/base/exceptions.h>
#include <quoin/contact_geometry/contact_search.h>
#include <quoin/operators/stored_energy.h>

#include "test_contacts.h"

using namespace quoin;
using namespace quoin::test;

namespace
{
  constexpr double degree  = 3.14159265358979323846 / 180.;
  constexpr double closing = 1e-4; // [m]

  /** Blocks, their contacts and joints, moved by hand. */
  struct Scene
  {
    const BlockMesh<2> mesh;
    TestNodes nodes;
    MatchedJoints joints;
    std::unique_ptr<BlockContacts> contacts;
    State<2> state;
    AlignedArray<dealii::Tensor<1, 2>> force;

    Scene(const std::function<BlockMesh<2>()> &make,
          const std::vector<JointSetParameters> &sets = { touching() })
      : mesh(make()), nodes(mesh)
    {
      joints.prepare(nodes, sets, thickness);
      contacts
          = std::make_unique<BlockContacts>(nodes, joints, contact_model(sets));
      joints.prepare(state);
      contacts->prepare(state);
      for (const auto &p : mesh.vertices)
        state.nodes.push_back({ { p[0], p[1] }, {} });
      state.velocity.assign(mesh.n_vertices(), dealii::Tensor<1, 2>());
    }

    explicit Scene(const std::vector<Rectangle> &rectangles,
                   const std::vector<JointSetParameters> &sets = { touching() })
      : Scene([&] { return make_blocks(rectangles); }, sets)
    {
    }

    /** Block that has a vertex at the reference position. */
    unsigned int block_at(const double x, const double y) const
    {
      return mesh.block_of_vertex(vertices_at(mesh, x, y).front());
    }

    void for_block(const unsigned int block,
                   const std::function<void(unsigned int)> &act) const
    {
      for (unsigned int v = mesh.block_first_vertex[block];
           v < mesh.block_first_vertex[block + 1]; ++v)
        act(v);
    }

    void move(const unsigned int block, const double x, const double y)
    {
      for_block(block,
                [&](const unsigned int v)
                {
                  state.nodes[v].u[0] += x;
                  state.nodes[v].u[1] += y;
                });
    }

    void turn(const unsigned int block, const double angle, const double x0,
              const double y0)
    {
      const double c = std::cos(angle), s = std::sin(angle);
      for_block(block,
                [&](const unsigned int v)
                {
                  NodeRecord<2> &node = state.nodes[v];
                  const double x      = node.X[0] + node.u[0] - x0;
                  const double y      = node.X[1] + node.u[1] - y0;
                  node.u[0]           = x0 + c * x - s * y - node.X[0];
                  node.u[1]           = y0 + s * x + c * y - node.X[1];
                });
    }

    /** @p look: whether motions are looked at before. */
    void find_forces(const bool look = true)
    {
      if (look)
        state.get<ContactState>().next_check = state.step;
      force.assign(mesh.n_vertices(), dealii::Tensor<1, 2>());
      joints.add_forces(state.nodes.data(), state.get<JointHistory>(),
                        state.energy, force.data());
      // A look hands over: the joints' forces are those before it.
      StepContext step{};
      step.dt = 1e-9;
      contacts->update(step, state);
      contacts->add_forces(step, state, { force.data(), nullptr });
      ++state.step;
    }

    /** Force x, y on a block and moment about the origin. */
    std::array<double, 3> total(const unsigned int block) const
    {
      std::array<double, 3> sum{};
      for_block(block,
                [&](const unsigned int v)
                {
                  const NodeRecord<2> &node = state.nodes[v];
                  sum[0] += force[v][0];
                  sum[1] += force[v][1];
                  sum[2] += (node.X[0] + node.u[0]) * force[v][1]
                            - (node.X[1] + node.u[1]) * force[v][0];
                });
      return sum;
    }
  };

  double pressing_area(const State<2> &state)
  {
    double area = 0.;
    for (const ContactPair &pair : state.get<ContactState>().pairs)
      for (const ContactPoint &point : pair.points)
        if (pair.active && point.normal_traction < -0.5 * kn * closing)
          area += point.area;
    return area;
  }
} // namespace

TEST(BlockContacts, TributaryLengthsAddUpToTheOverlap)
{
  // 3 edges below, 7 above, neither a multiple of the other.
  for (double x = -4.9; x < 3.; x += 0.37)
  {
    Scene scene({ { 0., 0., 3., 1., 3, 1 }, { x, 1., 4.9, 1., 7, 1 } });
    const unsigned int upper = scene.block_at(x, 2.);
    scene.move(upper, 0., -closing);
    scene.find_forces();
    const double overlap = std::min(3., x + 4.9) - std::max(0., x);
    EXPECT_NEAR(pressing_area(scene.state), thickness * overlap, 1e-12);
    EXPECT_NEAR(scene.total(upper)[1], kn * closing * thickness * overlap,
                1e-9 * kn * closing);
    EXPECT_NEAR(scene.total(upper)[0], 0., 2e-6 * scene.total(upper)[1]);
    // The pressure acts at the middle of the overlap.
    EXPECT_NEAR(scene.total(upper)[2],
                scene.total(upper)[1] * (std::max(0., x) + 0.5 * overlap),
                1e-5 * scene.total(upper)[1]);
  }
}

TEST(BlockContacts, UniformPressurePassesBetweenMeshesThatDoNotMatch)
{
  Scene scene({ { 0., 0., 3., 1., 3, 1 }, { 0., 1., 3., 1., 7, 1 } });
  scene.move(scene.block_at(0., 2.), 0., -closing);
  scene.find_forces();
  const double pressure = kn * closing * thickness;
  for (unsigned int i = 0; i <= 3; ++i)
  {
    const auto below = vertices_at(scene.mesh, i, 1.);
    for (const unsigned int v : below)
      if (scene.mesh.block_of_vertex(v) == scene.block_at(0., 0.))
      {
        EXPECT_NEAR(scene.force[v][1],
                    -pressure * (i == 0 || i == 3 ? 0.5 : 1.), 1e-9 * pressure);
      }
  }
  for (unsigned int i = 1; i < 7; ++i)
    for (const unsigned int v : vertices_at(scene.mesh, 3. * i / 7., 1.))
      if (scene.mesh.block_of_vertex(v) == scene.block_at(0., 2.))
      {
        EXPECT_NEAR(scene.force[v][1], pressure * 3. / 7., 1e-9 * pressure);
      }
}

TEST(BlockContacts, ForcesAreContinuousAsABlockSlidesOverCornersAndOff)
{
  // Two base blocks with flush tops; the slider passes their junction and
  // leaves the far end.
  Scene scene({ { 0., 0., 1., 1., 2, 1 },
                { 1., 0., 1., 1., 3, 2 },
                { 0.1, 1., 0.5, 0.5, 2, 1 } },
              { touching(0.) });
  const unsigned int slider = scene.block_at(0.1, 1.5);
  scene.move(slider, 0., -closing);
  const double step = 1e-4;
  double before     = 0.;
  // By which it is known how often to look.
  scene.for_block(slider,
                  [&](const unsigned int v) {
                    scene.state.velocity[v] = dealii::Point<2>(step / 1e-9, 0.);
                  });
  for (unsigned int i = 0; i < 20500; ++i)
  {
    scene.find_forces(i % 10 == 0);
    const auto now = scene.total(slider);
    if (i > 0)
    {
      ASSERT_NEAR(now[1], before, 1.01 * kn * closing * thickness * step)
          << "at " << 0.1 + i * step;
    }
    // Flush tops: nothing pushes sideways, but for a corner on its way off,
    // whose penetration counts in both directions.
    ASSERT_NEAR(now[0], 0., 1.01 * kn * thickness * closing * closing);
    before = now[1];
    scene.move(slider, step, 0.);
  }
  EXPECT_NEAR(before, 0., 1e-9 * kn * closing);
}

TEST(BlockContacts, ForcesAreContinuousAsABlockRocksAndTopples)
{
  // About its right corner, which stays pressed in by the same depth.
  Scene scene({ { -5.3, -1., 10., 1., 4, 1 }, { -1., 0., 1., 4., 1, 2 } },
              { touching(0.) });
  const unsigned int block = scene.block_at(-1., 4.);
  scene.move(block, 0., -closing);
  const double step = -0.02 * degree;
  std::array<double, 3> before{};
  const double full = kn * thickness * closing;
  for (unsigned int i = 0; i < 4400; ++i)
  {
    scene.find_forces(i % 5 == 0);
    const auto now     = scene.total(block);
    const double angle = -step * i;
    if (i > 0)
    {
      for (unsigned int d = 0; d < 2; ++d)
        // The left corner lifts off within closing / width; at 45 degrees
        // the side takes over: its half edge, 1 m, times cos theta times
        // d/dtheta tan^6 theta = 12 makes 8.5, and its cosine 0.7 more.
        ASSERT_NEAR(now[d], before[d],
                    (angle < 0.02 ? 2. * full : 10. * full * std::abs(step)))
            << "at " << angle / degree << " degrees, component " << d;
    }
    // A frictionless corner on a plane is pressed along the plane's normal.
    if (angle > 0.02 && angle < 1.4)
    {
      ASSERT_NEAR(now[0], 0., 1e-6 * now[1]) << angle / degree;
    }
    before = now;
    scene.turn(block, step, 0., -closing);
  }
}

TEST(BlockContacts, TurnWithTheBlocks)
{
  std::array<double, 3> reference{};
  for (const double angle : { 0., 25., 90., 145., 270. })
  {
    Scene scene({ { 0., 0., 3., 1., 3, 1 }, { 0.3, 1., 2., 1., 2, 1 } });
    const unsigned int upper = scene.block_at(0.3, 2.);
    scene.move(upper, 0., -closing);
    scene.find_forces();
    scene.move(upper, 1e-5, 0.); // sticking slip
    scene.find_forces();
    if (angle == 0.)
    {
      reference = scene.total(upper);
      EXPECT_NEAR(reference[0], -ks * 1e-5 * 2. * thickness, 1e-3);
      EXPECT_NEAR(reference[1], kn * closing * 2. * thickness, 1e-3);
    }
    for (unsigned int i = 0; i < 100; ++i)
    {
      for (const unsigned int block : { 0U, 1U })
        scene.turn(block, 0.01 * angle * degree, 0.7, -0.4);
      scene.find_forces();
    }
    const double c = std::cos(angle * degree), s = std::sin(angle * degree);
    const auto now = scene.total(upper);
    EXPECT_NEAR(now[0], c * reference[0] - s * reference[1],
                1e-6 * reference[1]);
    EXPECT_NEAR(now[1], s * reference[0] + c * reference[1],
                1e-6 * reference[1]);
  }
}

TEST(BlockContacts, FrictionStaysMobilisedFromEdgeToEdge)
{
  Scene scene({ { 0., 0., 4., 1., 8, 1 }, { 0., 1., 1.2, 1., 3, 1 } });
  const unsigned int upper = scene.block_at(0., 2.);
  scene.move(upper, 0., -closing);
  scene.find_forces();
  const double normal = kn * closing * 1.2 * thickness;
  for (unsigned int i = 0; i < 2500; ++i)
  {
    scene.move(upper, 1e-3, 0.);
    scene.find_forces();
    const auto now = scene.total(upper);
    ASSERT_NEAR(now[1], normal, 1e-9 * normal) << i;
    ASSERT_NEAR(now[0], -0.5 * normal, 1e-9 * normal) << i;
  }
  // And sticks again where it stops, without a trace of what it slid.
  for (unsigned int i = 0; i < 10; ++i)
  {
    scene.find_forces();
    EXPECT_NEAR(scene.total(upper)[0], -0.5 * normal, 1e-9 * normal);
  }
  scene.move(upper, -1e-5, 0.);
  scene.find_forces();
  EXPECT_NEAR(scene.total(upper)[0],
              -0.5 * normal + ks * 1e-5 * 1.2 * thickness, 1e-6 * normal);
}

TEST(BlockContacts, DilationIsNotForgottenFromEdgeToEdge)
{
  JointSetParameters set    = touching();
  coulomb_law(set).dilation = 0.1;
  Scene scene({ { 0., 0., 4., 1., 8, 1 }, { 0., 1., 1.2, 1., 3, 1 } }, { set });
  const unsigned int upper = scene.block_at(0., 2.);
  scene.move(upper, 0., -closing);
  scene.find_forces();
  const double normal = kn * closing * 1.2 * thickness;
  for (unsigned int i = 0; i < 8000; ++i)
  {
    scene.move(upper, 1e-4, 0.1e-4);
    scene.find_forces();
    // Rising by the dilation keeps the pressure, but for the elastic slip
    // that comes before: 0.1 * 0.5 * kn / ks of the closing.
    const double kept = 1. - 0.1 * 0.5 * kn / ks / (1. + 0.1 * 0.5 * kn / ks);
    if (i > 100)
    {
      ASSERT_NEAR(scene.total(upper)[1], kept * normal, 0.01 * normal) << i;
    }
  }
}

namespace
{
  /** A composite set for joints and new contacts that crushes under the
      pressure of the scenes. */
  JointSetParameters crushing_mortar()
  {
    JointSetParameters set = touching();
    set.name               = "mortar";
    CompositeLaw law;
    law.normal_stiffness       = kn;
    law.shear_stiffness        = ks;
    law.tension                = 1e4;
    law.tension_energy         = 5.;
    law.cohesion               = 2e4;
    law.shear_energy           = 2.;
    law.friction               = 0.5;
    law.residual_friction      = 0.4;
    law.cap.compression        = 9e5;
    law.cap.compression_energy = 1e3;
    law.cap.peak_crushing      = 1e-3;
    law.cap.shear              = 0.1;
    set.law                    = law;
    return set;
  }
} // namespace

TEST(BlockContacts, JointsAreHandedOverWithoutAJump)
{
  JointSetParameters weak = elastic_joint(kn, ks), strong = weak;
  coulomb_law(weak).peak       = { 1e4, 0.1, 0. };
  coulomb_law(weak).residual   = { 0., 0.1, 0. };
  coulomb_law(strong).peak     = { 1e4, 0.5, 0. };
  coulomb_law(strong).residual = { 0., 0.5, 0. };
  JointSetParameters rough = strong, yielding = strong;
  rough.law                 = rock_test::rough();
  yielding.law              = rock_test::yielding();
  JointSetParameters mortar = strong;
  mortar.law                = crushing_mortar().law;
  for (const JointSetParameters &joint :
       { weak, strong, rough, yielding, mortar })
    // Turned by more a joint that crushes would close by millimetres, and what
    // either frame takes for slip then differs by more than its elastic slip.
    for (const double angle :
         { 0., std::holds_alternative<CompositeLaw>(joint.law) ? 2e-4 : 0.008 })
    {
      Scene scene([] { return make_stack(3, 1); }, { joint, touching() });
      const unsigned int upper = scene.block_at(0., 2.);
      scene.move(upper, 0., -closing);
      scene.turn(upper, angle, 3., 1.);
      double shear = 0.;
      while (scene.state.get<ContactState>().n_searches < 2)
      {
        scene.find_forces();
        // Until it is handed over the joint is no contact.
        if (scene.state.get<ContactState>().n_searches == 1)
        {
          EXPECT_TRUE(scene.state.get<ContactState>().handed_over[0] == 0);
        }
        shear += 1e-4;
        scene.move(upper, 1e-4, 0.);
        ASSERT_LT(shear, 0.05);
      }
      // The forces of joints and those of contacts at one place.
      ASSERT_TRUE(scene.state.get<ContactState>().handed_over[0]);
      scene.find_forces(false);
      const auto general = scene.total(upper);
      State<2> matched   = scene.state;
      std::fill(matched.get<JointHistory>().handed_over.begin(),
                matched.get<JointHistory>().handed_over.end(), 0);
      for (unsigned int p = 0; p < scene.joints.n_points(); ++p)
      {
        // The history of point k of a segment goes on in its pair.
        const auto &segment = scene.joints.segments()[p / 2];
        const auto &face
            = scene.contacts->contact_edges().joint_edges(segment.face).edges;
        for (const ContactPair &pair : scene.state.get<ContactState>().pairs)
          if (pair.lower == face[0] && pair.upper == face[1])
          {
            const ContactPoint &point                   = pair.points[p % 2];
            matched.get<JointHistory>().plastic_slip[p] = point.plastic_slip;
            matched.get<JointHistory>().plastic_opening[p]
                = point.plastic_opening;
            matched.get<JointHistory>().normal_traction[p]
                = point.normal_traction;
            matched.get<JointHistory>().shear_traction[p]
                = point.shear_traction;
            matched.get<JointHistory>().state[p] = point.state;
            auto &internal = matched.get<JointHistory>().internal;
            for (unsigned int i = 0; i < internal.size(); ++i)
              if (!internal[i].empty())
              {
                EXPECT_TRUE(std::isfinite(point.internal[i]));
                internal[i][p] = point.internal[i];
              }
          }
      }
      scene.force.assign(scene.mesh.n_vertices(), dealii::Tensor<1, 2>());
      scene.joints.add_forces(scene.state.nodes.data(),
                              matched.get<JointHistory>(), scene.state.energy,
                              scene.force.data());
      const auto before = scene.total(upper);
      const double full = std::abs(before[1]);
      EXPECT_GT(full, 0.);
      for (unsigned int d = 0; d < 3; ++d)
        EXPECT_NEAR(general[d], before[d], 2e-3 * full)
            << "component " << d << ", angle " << angle << ", "
            << kind_of_law(joint.law);
      EXPECT_NEAR(stored_energy(scene.state, *scene.contacts),
                  stored_energy(matched, scene.joints),
                  2e-3 * stored_energy(matched, scene.joints));
    }
}

// The overlap of a joint of one face has become shorter by the slip when it is
// handed over, which its area still allows for.
TEST(BlockContacts, TheLengthOfAHandedOverJointDoesNotJump)
{
  JointSetParameters weak = elastic_joint(kn, ks);
  coulomb_law(weak).peak = coulomb_law(weak).residual = { 0., 0.1, 0. };
  Scene scene([] { return make_stack(1, 1); }, { weak, touching() });
  const unsigned int upper = scene.block_at(0., 2.);
  scene.move(upper, 0., -closing);
  scene.find_forces();
  const double before = scene.total(upper)[1];
  double slip         = 0.;
  while (!scene.state.get<ContactState>().handed_over[0])
  {
    slip += 1e-4;
    scene.move(upper, 1e-4, 0.);
    scene.find_forces();
    ASSERT_LT(slip, 0.05);
  }
  scene.find_forces(false);
  EXPECT_GT(slip, 4e-4);
  EXPECT_NEAR(scene.total(upper)[1], before, 0.1 * slip * before);
}

// A joint that has slipped is handed over and unloads, within its strength: its
// forces are those of a twin that has stayed a matched joint.
TEST(BlockContacts, HandedOverJointsGoOnFromTheirHistory)
{
  JointSetParameters plain = elastic_joint(kn, ks);
  CoulombLaw &law          = coulomb_law(plain);
  law.peak                 = { 1e4, 0.5, 0. };
  law.residual             = { 0., 0.5, 0. };
  law.dilation             = 0.01;
  Scene scene([] { return make_stack(3, 1); }, { plain, touching() });
  const unsigned int upper = scene.block_at(0., 2.);
  scene.move(upper, 0., -closing);
  JointHistory twin  = scene.state.get<JointHistory>();
  const auto of_twin = [&]()
  {
    EnergyAccounts unused;
    const auto force = scene.force;
    scene.force.assign(scene.mesh.n_vertices(), dealii::Tensor<1, 2>());
    scene.joints.add_forces(scene.state.nodes.data(), twin, unused,
                            scene.force.data());
    const auto sum = scene.total(upper);
    scene.force    = force;
    return sum;
  };
  while (scene.state.get<ContactState>().n_searches < 2)
  {
    scene.find_forces();
    of_twin();
    scene.move(upper, 1e-4, 0.);
  }
  ASSERT_TRUE(scene.state.get<ContactState>().handed_over[0]);
  scene.find_forces(false);
  const double slipping = of_twin()[0];
  const double back     = 0.2 * std::abs(slipping) / (ks * 3. * thickness);
  double last           = std::abs(slipping);
  for (unsigned int i = 0; i < 5; ++i)
  {
    scene.move(upper, -back, 0.);
    scene.find_forces(false);
    const auto general = scene.total(upper), matched = of_twin();
    EXPECT_LT(std::abs(matched[0]), last); // it unloads
    last = std::abs(matched[0]);
    for (unsigned int d = 0; d < 3; ++d)
      EXPECT_NEAR(general[d], matched[d], 2e-3 * std::abs(matched[1]))
          << "component " << d << ", step " << i;
  }
}

TEST(BlockContacts, NewContactsOfRockAreWorn)
{
  JointSetParameters rough = touching(), yielding = touching();
  rough.law            = rock_test::rough();
  yielding.law         = rock_test::yielding();
  const double angle[] = { 28., 30. };
  unsigned int i       = 0;
  for (const JointSetParameters &set : { rough, yielding })
  {
    Scene scene({ { 0., 0., 4., 1., 1, 1 }, { 1., 1., 1., 1., 1, 1 } },
                { set });
    const unsigned int upper = scene.block_at(1., 2.);
    scene.move(upper, 0., -1e-5);
    scene.find_forces();
    for (unsigned int step = 0; step < 200; ++step)
    {
      scene.move(upper, 2e-6, 0.);
      scene.find_forces();
    }
    const auto force = scene.total(upper);
    EXPECT_GT(force[1], 0.);
    EXPECT_NEAR(force[0], -std::tan(angle[i++] * rock_test::degree) * force[1],
                1e-3 * force[1]);
  }
}

// A joint crushes, slides and is handed over; beside a twin that has stayed a
// matched joint it goes on crushing, unloads and keeps what it closed by.
TEST(BlockContacts, HandedOverJointsStayCrushed)
{
  JointSetParameters mortar = crushing_mortar();
  mortar.curves             = { "joint" };
  Scene scene([] { return make_stack(3, 1); }, { mortar });
  const unsigned int upper = scene.block_at(0., 2.);
  const auto law           = std::get<CompositeLaw>(mortar.law);
  JointHistory twin        = scene.state.get<JointHistory>();
  EnergyAccounts of_twin;
  std::array<double, 3> matched;
  const auto step = [&](const double x, const double y)
  {
    scene.move(upper, x, y);
    scene.find_forces();
    const auto force = scene.force;
    scene.force.assign(scene.mesh.n_vertices(), dealii::Tensor<1, 2>());
    scene.joints.add_forces(scene.state.nodes.data(), twin, of_twin,
                            scene.force.data());
    matched     = scene.total(upper);
    scene.force = force;
  };
  for (unsigned int i = 0; i < 40; ++i)
    step(0., -0.05 * closing);
  while (!scene.state.get<ContactState>().handed_over[0])
    step(0.2 * closing, 0.);
  for (const double down : { -0.05, -0.05, -0.05, 0.04, 0.04 })
  {
    for (unsigned int i = 0; i < 20; ++i)
      step(0., down * closing);
    const auto general = scene.total(upper);
    for (unsigned int d = 0; d < 3; ++d)
      EXPECT_NEAR(general[d], matched[d], 2e-3 * std::abs(matched[1]))
          << "component " << d << ", after " << down;
  }
  const EnergyAccounts &energy = scene.state.energy;
  EXPECT_GT(of_twin.crushing, 0.);
  EXPECT_NEAR(energy.crushing, of_twin.crushing, 1e-3 * of_twin.crushing);
  EXPECT_NEAR(energy.fracture, of_twin.fracture, 1e-3 * of_twin.crushing);
  double crushed = 0.;
  for (const ContactPair &pair : scene.state.get<ContactState>().pairs)
    if (pair.was_joint)
      for (const ContactPoint &point : pair.points)
      {
        EXPECT_LT(point.internal[0], 0.05); // bond
        EXPECT_GT(point.internal[1], 2. * closing);
        crushed = point.plastic_opening;
      }
  // Lifted to where the joint has closed by it bears neither load nor tension.
  step(0., 0.5 * crushed - scene.state.nodes.back().u[1]);
  EXPECT_NEAR(scene.total(upper)[1], 0., 0.05 * law.tension);
}

// Blocks that were never joined have no bond, and the set's cap.
TEST(BlockContacts, NewCompositeContactsHaveNoBond)
{
  const JointSetParameters mortar = crushing_mortar();
  const auto law                  = std::get<CompositeLaw>(mortar.law);
  Scene scene({ { 0., 0., 4., 1., 1, 1 }, { 1., 1., 1., 1., 1, 1 } },
              { mortar });
  const unsigned int upper = scene.block_at(1., 2.);
  scene.move(upper, 0., -0.2 * closing);
  scene.find_forces();
  for (unsigned int step = 0; step < 200; ++step)
  {
    scene.move(upper, 2e-6, 0.);
    scene.find_forces();
  }
  const auto slid = scene.total(upper);
  EXPECT_GT(slid[1], 0.);
  EXPECT_NEAR(slid[0], -law.residual_friction * slid[1], 1e-6 * slid[1]);
  for (unsigned int step = 0; step < 200; ++step)
  {
    scene.move(upper, 0., -1e-5);
    scene.find_forces();
  }
  // What the shear traction takes of the cap is little once it has softened.
  double crushing = 0., sigma = 0., tau = 0.;
  for (const ContactPair &pair : scene.state.get<ContactState>().pairs)
    if (pair.active)
    {
      crushing = pair.points[0].internal[1];
      sigma    = pair.points[0].normal_traction;
      tau      = pair.points[0].shear_traction;
      EXPECT_EQ(pair.points[0].internal[0], 0.);
    }
  EXPECT_GT(crushing, 1e-3);
  EXPECT_NEAR(law.cap.load(sigma, tau),
              law.cap.limit(crushing) * law.cap.limit(crushing),
              1e-9 * law.cap.compression * law.cap.compression);
  scene.move(upper, 0., 2. * crushing);
  scene.find_forces();
  EXPECT_EQ(scene.total(upper)[1], 0.);
}

// A block slides with friction over a corner while it tips: the work of its
// nodes is stored, lost to friction or to areas that change. Kinks within the
// steps are in the accounts; what is left falls with the square of the step.
namespace
{
  /** Turn, x and y of a block at a share of its way from 0 to 1. */
  using Way = std::function<std::array<double, 3>(double)>;

  /** Moves the block @p upper, which turns about the point (@p x0, @p y0) that
      goes with it, on its @p way: work must have been stored or booked. */
  void expect_work_is_booked(Scene &scene, const unsigned int upper,
                             const double x0, const double y0, const Way &way)
  {
    std::array<double, 3> now = way(0.);
    scene.turn(upper, now[0], x0, y0);
    scene.move(upper, now[1], now[2]);
    scene.find_forces();
    const double at_start = stored_energy(scene.state, *scene.contacts);
    const unsigned int n  = 40000;
    double work = 0., throughput = 0.;
    for (unsigned int i = 1; i <= n; ++i)
    {
      const auto nodes = scene.state.nodes;
      const auto force = scene.force;
      const auto next  = way(static_cast<double>(i) / n);
      scene.turn(upper, next[0] - now[0], x0 + now[1], y0 + now[2]);
      scene.move(upper, next[1] - now[1], next[2] - now[2]);
      now = next;
      scene.find_forces(i % 20 == 0);
      for (unsigned int v = 0; v < nodes.size(); ++v)
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double w = 0.5 * (force[v][d] + scene.force[v][d])
                           * (scene.state.nodes[v].u[d] - nodes[v].u[d]);
          work += w;
          throughput += std::abs(w);
        }
    }
    const EnergyAccounts &lost = scene.state.energy;
    const double stored
        = stored_energy(scene.state, *scene.contacts) - at_start;
    EXPECT_NEAR(work + stored + lost.friction + lost.contact, 0.,
                1e-5 * throughput)
        << "work " << work << ", stored " << stored << ", friction "
        << lost.friction << ", contact " << lost.contact;
  }
} // namespace

TEST(BlockContacts, WorkIsStoredOrDissipated)
{
  for (const double friction : { 0., 0.4 })
  {
    SCOPED_TRACE(friction);
    Scene scene({ { 0., 0., 2., 1., 2, 1 }, { 1.2, 1., 1., 1., 2, 1 } },
                { touching(friction) });
    // Tips over its own corner and over that of the block below in turn.
    expect_work_is_booked(scene, scene.block_at(1.2, 2.), 2., 1.,
                          [](const double p)
                          {
                            return std::array<double, 3>{
                              0.02 * std::sin(20. * p),
                              0.1 * std::sin(3. * p) + 1e-3 * p,
                              closing * (0.1 - 4. * std::sin(9. * p))
                            };
                          });
  }
}

TEST(BlockContacts, WorkOfDeepCornersIsStoredOrBooked)
{
  // A square on its tip goes over the tip of another and over its side, many
  // times as deep as corners are rounded.
  for (const double friction : { 0., 0.4 })
  {
    SCOPED_TRACE(friction);
    Scene scene({ { 0., -std::sqrt(2.), 1., 1., 1, 1, 45. * degree },
                  { 0., 0., 1., 1., 1, 1, 45. * degree } },
                { touching(friction) });
    expect_work_is_booked(scene, scene.block_at(0., std::sqrt(2.)), 0., 0.,
                          [](const double p)
                          {
                            return std::array<double, 3>{
                              0.3 * std::sin(5. * p), 0.02 * std::sin(6. * p),
                              0.002 - 0.02 * std::sin(3.14 * p)
                            };
                          });
  }
}

TEST(BlockContacts, SearchesChangeNothing)
{
  Scene scene({ { 0., 0., 4., 1., 8, 1 }, { 0.1, 1., 1.2, 1., 3, 1 } });
  const unsigned int upper = scene.block_at(0.1, 2.);
  scene.move(upper, 0., -closing);
  scene.find_forces();
  for (unsigned int i = 0; i < 40; ++i)
    scene.move(upper, 1e-3, 0.), scene.find_forces();
  scene.move(upper, -1e-5, 0.);
  scene.find_forces(false);
  const auto before            = scene.total(upper);
  const std::uint64_t searches = scene.state.get<ContactState>().n_searches;
  scene.state.get<ContactState>().search_positions.assign(
      scene.state.get<ContactState>().search_positions.size(),
      dealii::Tensor<1, 2>({ 1e3, 0. }));
  scene.find_forces();
  EXPECT_EQ(scene.state.get<ContactState>().n_searches, searches + 1);
  const auto after = scene.total(upper);
  for (unsigned int d = 0; d < 3; ++d)
    EXPECT_NEAR(after[d], before[d], 1e-9 * std::abs(before[1]));
}

TEST(BlockContacts, CornersOnCornersPushApart)
{
  // Squares standing on their corners, tip on tip.
  Scene scene({ { 0., -std::sqrt(2.), 1., 1., 1, 1, 45. * degree },
                { 0., 0., 1., 1., 1, 1, 45. * degree } },
              { touching(0.) });
  const unsigned int upper = scene.block_at(0., std::sqrt(2.));
  double before            = 0.;
  for (unsigned int i = 0; i < 100; ++i)
  {
    scene.move(upper, 0., -1e-4);
    scene.find_forces();
    const auto now = scene.total(upper);
    EXPECT_NEAR(now[0], 0., 1e-9 * kn * closing);
    EXPECT_GT(now[1], before);
    before = now[1];
  }
}

TEST(BlockContacts, DeepOverlapStopsAndNamesTheBlocks)
{
  Scene scene({ { 0., 0., 3., 1., 3, 1 }, { 0.3, 1., 2., 1., 2, 1 } });
  const unsigned int upper = scene.block_at(0.3, 2.);
  scene.find_forces();
  try
  {
    for (unsigned int i = 0; i < 100; ++i)
    {
      scene.move(upper, 0., -0.01);
      scene.find_forces();
    }
    FAIL() << "no error";
  }
  catch (const RunError &error)
  {
    EXPECT_NE(std::string(error.what()).find("blocks 0 and 1 overlap by 0.2"),
              std::string::npos)
        << error.what();
  }
}

TEST(BlockContacts, WhatGoesDeepWithinAStepStops)
{
  // By 0.3 m, more than a quarter of the cells' height.
  Scene scene({ { 0., 0., 3., 1., 3, 1 }, { 0.3, 1.01, 2., 1., 2, 1 } });
  const unsigned int upper = scene.block_at(0.3, 2.01);
  scene.find_forces();
  scene.move(upper, 0., -0.31);
  scene.find_forces(false);
  EXPECT_NE(message_of<RunError>([&] { scene.find_forces(); })
                .find("blocks 0 and 1 overlap by 0.3"),
            std::string::npos);
}

TEST(BlockContacts, EveryPairOfMaterialsNeedsASet)
{
  const TestNodes nodes(make_blocks({ { 0., 0., 1., 1., 1, 1 } }));
  const MatchedJoints joints;
  ContactModel model = contact_model({ elastic_joint(kn, ks) });
  EXPECT_THROW(BlockContacts(nodes, joints, model), InputError);
  JointSetParameters set = touching();
  set.all_new_contacts   = false;
  set.new_contacts       = { { "stone", "stone" } };
  model.sets             = { set };
  EXPECT_NO_THROW(BlockContacts(nodes, joints, model));
  model.sets = { set, set };
  EXPECT_THROW(BlockContacts(nodes, joints, model), InputError);
  set.new_contacts = { { "stone", "wood" } };
  model.sets       = { set };
  EXPECT_THROW(BlockContacts(nodes, joints, model), InputError);
}

TEST(ContactSearch, FindsWhatAllPairsAgainstAllFind)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0., 5.), angle(0., 6.28),
      size(0.1, 3.);
  std::vector<Rectangle> rectangles;
  for (unsigned int i = 0; i < 20; ++i)
    rectangles.push_back({ place(random), place(random), size(random),
                           size(random), 1 + i % 4, 1 + i % 3, angle(random) });
  BlockMesh<2> mesh = make_blocks(rectangles);
  const TestNodes nodes(mesh);
  const ContactEdges edges(nodes);
  std::vector<EdgeEnds> ends;
  for (unsigned int e = 0; e < edges.n_global(); ++e)
  {
    const auto &p = mesh.vertices[edges[e].nodes[0]];
    const auto &q = mesh.vertices[edges[e].nodes[1]];
    ends.push_back({ e, { p[0], q[0] }, { p[1], q[1] } });
  }
  const double skin = 0.2;
  // Sampled segments: nearer than the skin for sure, or farther for sure.
  std::vector<std::array<unsigned int, 2>> found;
  for (const NearEdges &pair : near_edges(edges, ends, skin))
    found.push_back(pair.places);
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  unsigned int checked = 0;
  for (unsigned int i = 0; i < ends.size(); ++i)
    for (unsigned int j = i + 1; j < ends.size(); ++j)
    {
      const double ax = ends[i].x[1] - ends[i].x[0],
                   ay = ends[i].y[1] - ends[i].y[0],
                   bx = ends[j].x[1] - ends[j].x[0],
                   by = ends[j].y[1] - ends[j].y[0];
      const double la = std::hypot(ax, ay), lb = std::hypot(bx, by);
      const double cosine = (ax * bx + ay * by) / (la * lb);
      // What turns them until they face each other by the least cosine.
      const double least = std::asin(least_contact_cosine);
      const double turn  = std::max(0., std::asin(cosine) + least) * M_2_PI
                          / (1. / la + 1. / lb);
      double nearest = 1e9;
      const int n    = 60;
      for (int s = 0; s <= n; ++s)
        for (int t = 0; t <= n; ++t)
          nearest
              = std::min(nearest, std::hypot(ends[i].x[0] + ax * s / n
                                                 - ends[j].x[0] - bx * t / n,
                                             ends[i].y[0] + ay * s / n
                                                 - ends[j].y[0] - by * t / n));
      const bool share = edges[i].nodes[0] == edges[j].nodes[1]
                         || edges[i].nodes[1] == edges[j].nodes[0];
      const bool is_found = std::binary_search(
          found.begin(), found.end(), std::array<unsigned int, 2>{ { i, j } });
      if (share || turn > 1.01 * skin)
        EXPECT_FALSE(is_found);
      else if (turn < 0.99 * skin && (nearest < 0.19 || nearest > 0.25))
      {
        EXPECT_EQ(is_found, nearest < skin) << nearest;
        ++checked;
      }
    }
  EXPECT_GT(checked, 5000U);
}

TEST(ContactEdges, RunAroundTheirBlocks)
{
  BlockMesh<2> mesh = make_stack(3, 2);
  const TestNodes nodes(mesh);
  const ContactEdges edges(nodes);
  ASSERT_EQ(edges.n_global(), 20U);
  ASSERT_EQ(edges.own().size(), 20U);
  EXPECT_FALSE(edges.has_tip(0));
  for (unsigned int b = 0; b < 2; ++b)
  {
    double length = 0.;
    for (unsigned int e = 10 * b; e < 10 * (b + 1); ++e)
    {
      EXPECT_EQ(edges[e].number, e);
      EXPECT_EQ(edges[e].block, b);
      EXPECT_EQ(edges[edges[e].next].previous, e);
      EXPECT_EQ(edges[edges[e].next].nodes[0], edges[e].nodes[1]);
      EXPECT_NEAR(edges[e].height, 1., 1e-12);
      length += edges[e].length;
    }
    EXPECT_NEAR(length, 10., 1e-12);
  }
  for (unsigned int f = 0; f < mesh.joint_faces.size(); ++f)
  {
    const auto &[lower, upper] = edges.joint_edges(f).edges;
    EXPECT_EQ(edges[lower].nodes[0], mesh.joint_faces[f].lower[0]);
    EXPECT_EQ(edges[upper].nodes[1], mesh.joint_faces[f].upper[0]);
    EXPECT_EQ(edges[upper].interface, 0U);
  }
}
