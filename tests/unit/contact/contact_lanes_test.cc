// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Contacts in SIMD lanes against the same contacts one by one, under the joint
// laws themselves.

#include "../joint_laws/composite_walk.h"
#include "../joint_laws/rock_walk.h"

#include "test_contacts.h"

using namespace quoin;
using namespace quoin::test;

namespace
{
  /** Blocks that move as they are told, and contacts between them. */
  struct Assembly
  {
    const TestNodes nodes;
    MatchedJoints joints;
    std::array<std::unique_ptr<BlockContacts>, 2> contacts;
    State<2> state;

    Assembly(BlockMesh<2> mesh, const std::vector<JointSetParameters> &sets,
             const unsigned int lanes)
      : nodes(std::move(mesh))
    {
      joints.prepare(nodes, sets, thickness);
      joints.prepare(state);
      const unsigned int n_blocks = nodes->table().n_blocks();
      DashpotBlocks blocks;
      blocks.communicator = MPI_COMM_WORLD;
      blocks.inverse_mass.assign(n_blocks, 1. / 200.);
      blocks.is_divided.assign(n_blocks, false);
      blocks.impedance.assign(n_blocks + 2, { { 1e6, 1e6 } });
      ContactModel model = contact_model(sets);
      for (const unsigned int i : { 0, 1 })
      {
        model.n_lanes = i == 0 ? lanes : 1;
        contacts[i]   = std::make_unique<BlockContacts>(nodes, joints, model);
        contacts[i]->set_blocks(blocks);
      }
      contacts[0]->prepare(state);
      for (unsigned int v = 0; v < nodes->n_local(); ++v)
        state.nodes.push_back(
            { { nodes->point(v)[0], nodes->point(v)[1] }, {} });
      state.velocity.assign(nodes->n_local(), dealii::Tensor<1, 2>());
    }

    /** Each block goes round in a circle of @p radius [m] and turns to and fro,
        at its own speed, @p drift [m] further to the right than the one before
        it; all are strained. */
    void place(const double time, const double radius, const double drift)
    {
      for (unsigned int v = 0; v < nodes->n_local(); ++v)
      {
        const unsigned int block = nodes->block_of_node(v);
        const double phase       = time * (1. + 0.37 * block) + block;
        const double angle       = 3. * radius * std::sin(0.7 * phase);
        const double strain      = 1e-3 * std::sin(0.3 * phase);
        NodeRecord<2> &node      = state.nodes[v];
        const double x = node.X[0], y = node.X[1];
        const double to[2]
            = { drift * time * block + radius * std::cos(phase) - angle * y
                    + strain * x,
                radius * std::sin(phase) + angle * x - strain * y };
        for (unsigned int d = 0; d < 2; ++d)
        {
          state.velocity[v][d] = 10. * (to[d] - node.u[d]);
          node.u[d]            = to[d];
        }
      }
    }
  };

  struct Forces
  {
    AlignedArray<dealii::Tensor<1, 2>> force, viscous;

    Forces(BlockContacts &contacts, State<2> &state)
      : force(state.nodes.size(), dealii::Tensor<1, 2>()), viscous(force)
    {
      StepContext step{};
      step.dt                              = 1e-9;
      step.stiffness_damping               = 1e-4;
      state.get<ContactState>().next_check = state.step;
      contacts.update(step, state);
      contacts.add_forces(step, state, { force.data(), viscous.data() });
    }
  };

  /** What is compared: the largest value, and the largest difference. */
  struct Difference
  {
    double size = 0., error = 0.;

    void take(const double a, const double b)
    {
      size  = std::max({ size, std::abs(a), std::abs(b) });
      error = std::max(error, a == b ? 0. : std::abs(a - b));
    }
    void take(const AlignedArray<dealii::Tensor<1, 2>> &a,
              const AlignedArray<dealii::Tensor<1, 2>> &b)
    {
      for (unsigned int i = 0; i < a.size(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
          take(a[i][d], b[i][d]);
    }
    double share() const
    {
      return error / size;
    }
  };

  struct Comparison
  {
    Difference force, viscous, traction, gap, internal, place, energy;
    unsigned int n_slipping = 0, n_open = 0, n_begun = 0, n_ended = 0,
                 n_joints = 0, n_shifted = 0, n_turning = 0, n_states = 0;

    void take(const State<2> &before, const State<2> &state,
              const State<2> &reference)
    {
      const auto &old  = before.get<ContactState>().pairs;
      const auto &now  = state.get<ContactState>().pairs;
      const auto &same = reference.get<ContactState>().pairs;
      ASSERT_EQ(now.size(), same.size());
      for (unsigned int i = 0; i < now.size(); ++i)
      {
        ASSERT_EQ(now[i].edges(), same[i].edges());
        ASSERT_EQ(now[i].active, same[i].active);
        EXPECT_EQ(now[i].was_open, same[i].was_open);
        if (now.size() == old.size())
        {
          n_begun += now[i].active && !old[i].active;
          n_ended += old[i].active && !now[i].active;
        }
        n_joints += now[i].active && now[i].was_joint;
        n_shifted += now[i].active && now[i].shift != 0.;
        for (unsigned int k = 0; k < 2 && now[i].active; ++k)
          compare(now[i].points[k], same[i].points[k]);
      }
      const EnergyAccounts &a = state.energy, &b = reference.energy;
      energy.take(a.friction, b.friction);
      energy.take(a.fracture, b.fracture);
      energy.take(a.crushing, b.crushing);
      energy.take(a.contact, b.contact);
    }

    void compare(const ContactPoint &a, const ContactPoint &b)
    {
      n_slipping += a.state == JointState::slipping;
      n_open += a.state == JointState::open;
      n_turning += std::abs(a.lean) < 1.;
      n_states += a.state != b.state;
      traction.take(a.normal_traction, b.normal_traction);
      traction.take(a.shear_traction, b.shear_traction);
      gap.take(a.plastic_slip, b.plastic_slip);
      gap.take(a.plastic_opening, b.plastic_opening);
      gap.take(a.slip_offset, b.slip_offset);
      gap.take(a.opening, b.opening);
      gap.take(a.sideways, b.sideways);
      place.take(a.anchor_lower, b.anchor_lower);
      place.take(a.anchor_upper, b.anchor_upper);
      place.take(a.area, b.area);
      place.take(a.lean, b.lean);
      for (unsigned int i = 0; i < ContactPoint::most_internal; ++i)
        internal.take(a.internal[i], b.internal[i]);
    }
  };

  /** The lanes go on from what they have come to, the reference too: errors do
      not add up. */
  Comparison compare(const BlockMesh<2> &mesh,
                     const std::vector<JointSetParameters> &sets,
                     const unsigned int lanes, const double radius,
                     const double drift)
  {
    Assembly assembly(mesh, sets, lanes);
    Comparison result;
    for (unsigned int i = 0; i < 1500; ++i)
    {
      State<2> &state = assembly.state;
      assembly.place(0.01 * i, radius, drift);
      // Joints that have slipped or opened too far become contacts.
      AlignedArray<dealii::Tensor<1, 2>> of_joints(state.nodes.size());
      assembly.joints.add_forces(state.nodes.data(), state.get<JointHistory>(),
                                 state.energy, of_joints.data());
      state.energy          = EnergyAccounts();
      const State<2> before = state;
      State<2> reference    = state;
      const Forces now(*assembly.contacts[0], state);
      const Forces same(*assembly.contacts[1], reference);
      result.force.take(now.force, same.force);
      result.viscous.take(now.viscous, same.viscous);
      result.take(before, state, reference);
      ++state.step;
    }
    return result;
  }

  /** Sets of the joints on @p curve and of contacts. */
  std::vector<JointSetParameters> with_law(const JointLaw &law,
                                           const std::string &curve)
  {
    JointSetParameters joint   = elastic_joint(kn, ks, curve),
                       contact = touching();
    joint.law = contact.law = law;
    contact.damping         = { 0.1, 0.1 };
    return { joint, contact };
  }

  CompositeLaw mortar()
  {
    CompositeLaw law     = composite_test::wall();
    law.normal_stiffness = kn;
    law.shear_stiffness  = ks;
    return law;
  }

  CoulombLaw dilating()
  {
    CoulombLaw law;
    law.normal_stiffness = kn;
    law.shear_stiffness  = ks;
    law.peak             = { 1e4, 0.5, 1e4 };
    law.residual         = { 0., 0.4, 0. };
    law.dilation         = 0.05;
    return law;
  }

  SlipWeakeningLaw weakening()
  {
    SlipWeakeningLaw law;
    law.normal_stiffness  = kn;
    law.shear_stiffness   = ks;
    law.cohesion          = 1e4;
    law.friction          = 0.5;
    law.residual_friction = 0.3;
    law.weakening_slip    = 1e-3;
    return law;
  }

  /** Two rows of squares beside and on each other, cut differently. */
  BlockMesh<2> rows()
  {
    std::vector<Rectangle> rectangles;
    for (unsigned int i = 0; i < 5; ++i)
    {
      rectangles.push_back({ 0.5 * i, 0., 0.5, 0.5, 1 + i % 3, 2 });
      rectangles.push_back(
          { 0.5 * i + 0.2, 0.5, 0.5, 0.5, 2 + i % 2, 1 + i % 2 });
    }
    return make_blocks(rectangles);
  }

  BlockMesh<2> stack()
  {
    return make_stack(5, 2);
  }

  void expect_same(const Comparison &all, const std::string &name,
                   const double tolerance)
  {
    EXPECT_EQ(all.n_states, 0U) << name;
    EXPECT_GT(all.n_slipping, 100U) << name;
    EXPECT_GT(all.n_open, 100U) << name;
    for (const unsigned int n : { all.n_begun, all.n_ended, all.n_joints,
                                  all.n_shifted, all.n_turning })
      EXPECT_GT(n, 3U) << name;
    // Dashpots bear at most what makes the traction zero, and that is as
    // accurate as the largest tractions before.
    EXPECT_LE(all.viscous.error,
              1e-14 * std::max(all.viscous.size, all.force.size))
        << name << ", viscous";
    for (const auto &[word, d] : { std::make_pair("force", all.force),
                                   std::make_pair("traction", all.traction),
                                   std::make_pair("gap", all.gap),
                                   std::make_pair("internal", all.internal),
                                   std::make_pair("place", all.place),
                                   std::make_pair("energy", all.energy) })
      EXPECT_LE(d.error, tolerance * d.size) << name << ", " << word;
  }

  template <int lanes>
  void expect_lanes_as_one()
  {
    for (const JointLaw &law :
         { JointLaw(touching().law), JointLaw(dilating()), JointLaw(mortar()),
           JointLaw(weakening()), JointLaw(rock_test::rough()),
           JointLaw(rock_test::yielding()) })
    {
      // The traction of continuously yielding joints may stand above their
      // strength by a hundred times, as the pressure falls, and comes down by
      // a function that takes rounding that many times, in each of some steps.
      const double tolerance
          = std::holds_alternative<ContinuouslyYieldingLaw>(law) ? 5e-13
                                                                 : 1e-14;
      expect_same(compare(rows(), with_law(law, "unnamed"), lanes, 2e-3, 2e-3),
                  kind_of_law(law), tolerance);
      expect_same(compare(stack(), with_law(law, "joint"), lanes, 1e-3, 2e-3),
                  kind_of_law(law) + " from a joint", tolerance);
    }
  }
} // namespace

TEST(ContactLanes, FourAreAsOne)
{
  expect_lanes_as_one<4>();
}

TEST(ContactLanes, EightAreAsOne)
{
  expect_lanes_as_one<8>();
}
