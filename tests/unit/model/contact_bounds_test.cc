// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "test_models.h"

#include <quoin/model/contact_bounds.h>
#include <quoin/model/model_stability.h>

using namespace quoin;
using namespace quoin::test;

namespace
{
  JointSetParameters touching(const std::string &name, const std::string &a,
                              const std::string &b, const double stiffness)
  {
    JointSetParameters set = elastic_joint(stiffness, 0.5 * stiffness, name);
    set.curves.clear();
    set.new_contacts = { { a, b } };
    return set;
  }

  /** Two blocks on each other with the joint @p joint, which may touch others
      of their materials. Stiffnesses in [Pa/m]. */
  struct Stack
  {
    TestNodes nodes;
    Model<2> model;

    Stack(const double joint, const double lower, const double both,
          const double upper)
      : nodes(mesh()), model(nodes, parameters(joint, lower, both, upper))
    {
    }
    static BlockMesh<2> mesh()
    {
      return make_stack(2, 2);
    }
    static ModelParameters parameters(const double joint, const double lower,
                                      const double both, const double upper)
    {
      ModelParameters result     = two_blocks(joint, joint);
      result.large_displacements = true;
      result.joints.push_back(touching("ll", "lower", "lower", lower));
      result.joints.push_back(touching("lu", "lower", "upper", both));
      result.joints.push_back(touching("uu", "upper", "upper", upper));
      return result;
    }
    /** Largest S of the boundary node at the middle of the side of @p group
        [N/m]. */
    double bound(const std::string &group) const
    {
      const double y       = group == "lower" ? 1. : 3.;
      const auto stability = stability_at(model, model.initial_state());
      for (unsigned int i = 0; i < nodes->n_owned(); ++i)
        if (nodes->point(i).distance({ 0., y }) < 1e-9)
          return 4. * stability.mass_for(i, 1.);
      return 0.;
    }
  };
} // namespace

TEST(ContactBounds, AreThoseOfThePairsOfMaterialsThatMayMeet)
{
  // All contacts of the lower block have 1, the upper ones up to 9.
  const Stack stack(1e9, 1e9, 1e9, 9e9), soft(1e9, 1e9, 1e9, 1e9);
  const double thickness = 0.5, length = 1.;
  EXPECT_DOUBLE_EQ(stack.bound("lower"), soft.bound("lower"));
  EXPECT_NEAR(stack.bound("upper") - soft.bound("upper"),
              2. * 8e9 * length * thickness, 1.);
}

TEST(ContactBounds, CountContactsBetweenTwoMaterialsAtBoth)
{
  const Stack stack(1e9, 1e9, 5e9, 1e9), soft(1e9, 1e9, 1e9, 1e9);
  for (const std::string group : { "lower", "upper" })
    EXPECT_NEAR(stack.bound(group) - soft.bound(group), 2. * 4e9 * 0.5, 1.);
}

TEST(ContactBounds, CountTheJointsOfABlock)
{
  // Their histories go on where blocks slide around the corner.
  const Stack stack(7e9, 1e9, 1e9, 1e9), soft(1e9, 1e9, 1e9, 1e9);
  for (const std::string group : { "lower", "upper" })
    EXPECT_NEAR(stack.bound(group) - soft.bound(group), 2. * 6e9 * 0.5, 1.);
}

TEST(ContactBounds, FollowTheMaterialsOfAStage)
{
  Stack stack(1e9, 1e9, 1e9, 9e9);
  const Stack soft(1e9, 1e9, 1e9, 1e9);
  ModelProperties properties      = stack.model.properties();
  properties.material_of_group[1] = properties.material_of_group[0];
  stack.model.set_properties(properties, ConstructionState<2>());
  EXPECT_DOUBLE_EQ(stack.bound("upper"), soft.bound("upper"));
}

TEST(ContactBounds, DashpotsShortenTheStep)
{
  ModelParameters damped = Stack::parameters(1e9, 1e9, 1e9, 1e9);
  for (JointSetParameters &set : damped.joints)
    set.damping = { 0.5, 0.5 };
  const Stack springs(1e9, 1e9, 1e9, 1e9);
  const Model<2> model(springs.nodes, damped);
  EXPECT_GT(stability_at(model, model.initial_state())
                .largest_eigenvalue(model.mass()),
            stability_at(springs.model, springs.model.initial_state())
                .largest_eigenvalue(model.mass()));
}

TEST(ContactBounds, MassesOfBlocks)
{
  const Stack stack(1e9, 1e9, 1e9, 1e9);
  const auto masses = block_masses(*stack.nodes, stack.model.mass());
  ASSERT_EQ(masses.size(), 2U);
  for (const double mass : masses)
    EXPECT_NEAR(mass, 4. * 0.5 * 2500., 1e-9);
}
