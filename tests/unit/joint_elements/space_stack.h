// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_joint_elements_space_stack_h
#define quoin_tests_unit_joint_elements_space_stack_h

#include "../joint_laws/composite_walk.h"
#include "../joint_laws/rock_walk.h"
#include "../mesh/space_box.h"

#include <quoin/joint_elements/space_joints.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/operators/archive.h>

#include <deal.II/physics/transformations.h>

#include <functional>
#include <random>

namespace quoin::test::space_stack
{
  using Vector = dealii::Tensor<1, 3>;
  using Matrix = dealii::Tensor<2, 3>;

  constexpr double kn = 8e9, ks = 3e9;

  inline Matrix rotation(const Vector &vector)
  {
    const double angle = vector.norm();
    if (angle == 0.)
      return dealii::unit_symmetric_tensor<3>();
    return dealii::Physics::Transformations::Rotations::rotation_matrix_3d(
        vector / angle, angle);
  }

  inline JointSetParameters set_of(const JointLaw &law)
  {
    JointSetParameters set;
    set.name   = "joint";
    set.curves = { "unnamed" };
    set.law    = law;
    return set;
  }

  inline CoulombLaw elastic()
  {
    CoulombLaw law;
    law.normal_stiffness = kn;
    law.shear_stiffness  = ks;
    return law;
  }

  inline CoulombLaw coulomb()
  {
    CoulombLaw law = elastic();
    law.peak       = { 1e6, 0.75, 0.4e6 };
    law.residual   = { 0.1e6, 0.6, 0.05e6 };
    law.dilation   = 0.3;
    return law;
  }

  inline std::vector<JointLaw> all_laws()
  {
    SlipWeakeningLaw fault;
    fault.normal_stiffness  = kn;
    fault.shear_stiffness   = ks;
    fault.cohesion          = 0.5e6;
    fault.residual_cohesion = 0.1e6;
    fault.friction          = 0.7;
    fault.residual_friction = 0.4;
    fault.weakening_slip    = 5e-3;
    CoulombLaw no_tension   = elastic();
    no_tension.peak = no_tension.residual = { 0., 0.6, 0. };
    no_tension.is_no_tension              = true;
    CompositeLaw closing                  = composite_test::dilatant();
    closing.cracks_close                  = true;
    return { elastic(),
             coulomb(),
             no_tension,
             composite_test::wall(),
             composite_test::dilatant(),
             closing,
             fault,
             rock_test::rough(),
             rock_test::yielding() };
  }

  /** Two boxes of @p nx x 1 x 1 cubes on each other, @p placed in space. */
  inline BlockMesh<3>
  stack(const unsigned int nx,
        const std::function<dealii::Point<3>(dealii::Point<3>)> &placed)
  {
    MeshData<3> data;
    data.group_names = { "low", "high" };
    data.face_names  = { "" };
    const Count n    = { { nx, 1, 2 } };
    for (const auto &p : box_points(n, 0.5))
      data.vertices.push_back(placed(p));
    data.cells = box_cells(n);
    for (unsigned int c = 0; c < data.cells.size(); ++c)
      data.cell_group.push_back(c < data.cells.size() / 2 ? 0 : 1);
    SplitOptions options;
    options.between_all = true;
    return split_into_blocks(data, options);
  }

  /** An inclined joint that is not flat on the axes. */
  inline dealii::Point<3> inclined(const dealii::Point<3> &p)
  {
    const Matrix turn = rotation(Vector({ 0.5, -0.3, 0.2 }));
    return dealii::Point<3>(turn
                            * (p + Vector({ 0.2 * p[2], 0.1 * p[0], 0. })));
  }

  struct Stack
  {
    BlockMesh<3> mesh;
    BlockTriangulation<3> blocks;
    NodeMap<3> nodes;
    SpaceJoints joints;
    State<3> state;
    AlignedArray<dealii::Tensor<1, 3>> force;
    EnergyAccounts energy;

    explicit Stack(
        const JointLaw &law, const unsigned int nx = 2,
        const std::function<dealii::Point<3>(dealii::Point<3>)> &placed
        = inclined)
      : mesh(stack(nx, placed)),
        blocks(mesh, std::vector<unsigned int>(mesh.n_cells(), 0),
               std::vector<bool>(mesh.n_blocks(), false), MPI_COMM_SELF),
        nodes(blocks)
    {
      joints.prepare(nodes, { set_of(law) });
      joints.prepare(state);
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
      {
        const auto &p = nodes.point(i);
        state.nodes.push_back({ { p[0], p[1], p[2] }, {} });
      }
    }

    SpaceJointHistory &history()
    {
      return state.get<SpaceJointHistory>();
    }

    void update()
    {
      force.assign(state.nodes.size(), dealii::Tensor<1, 3>());
      joints.add_forces(state.nodes.data(), history(), energy, force.data());
    }

    double lost() const
    {
      return energy.friction + energy.fracture + energy.crushing;
    }

    Vector position(const unsigned int i) const
    {
      const auto &[X, u] = state.nodes[i];
      return Vector({ X[0] + u[0], X[1] + u[1], X[2] + u[2] });
    }
    void place(const unsigned int i, const Vector &p)
    {
      for (unsigned int d = 0; d < 3; ++d)
        state.nodes[i].u[d] = p[d] - state.nodes[i].X[d];
    }
    bool is_high(const unsigned int i) const
    {
      return nodes.block_of_node(i) == 1;
    }

    /** Displaces all nodes at random by up to @p size [m]. */
    void shake(const double size, const unsigned int seed = 3)
    {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> uniform(-size, size);
      for (NodeRecord<3> &node : state.nodes)
        for (double &u : dealii::make_array_view(node.u))
          u += uniform(random);
    }
  };
} // namespace quoin::test::space_stack

#endif
