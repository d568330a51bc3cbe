// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_blocks_rigid_blocks_h
#define quoin_blocks_rigid_blocks_h

#include <quoin/base/thickness.h>
#include <quoin/operators/state.h>
#include <quoin/blocks/node_update.h>
#include <quoin/operators/step_context.h>
#include <quoin/materials/material_parameters.h>
#include <quoin/mesh/node_map.h>

#include <array>
#include <vector>

namespace quoin
{
  /**
   * Whether all cells of each block of @p mesh are of rigid materials. Throws
   * an InputError about a block that is rigid in part.
   */
  template <int dim>
  std::vector<bool>
  find_rigid_blocks(const BlockMesh<dim> &mesh,
                    const std::vector<MaterialParameters> &materials);

  /** Motion of a rigid block: x [m], y [m], rotation [rad, anticlockwise]. */
  struct RigidBlockState
  {
    /** Displacement of the centroid from the reference [m]. */
    dealii::Tensor<1, 2> displacement;
    double rotation = 0.; /**< counts full turns */
    /** Velocity of the centroid and spin at time - dt/2. */
    double velocity[3]{};

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &displacement &rotation &velocity;
    }
  };

  /** The rigid blocks of a rank. */
  struct RigidBlockStates : std::vector<RigidBlockState>
  {
    static constexpr const char *slice_name = "rigid blocks";

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.own(static_cast<std::vector<RigidBlockState> &>(*this));
    }
  };

  /** Motion of the rigid blocks of a rank in a stage. */
  struct RigidBlockStage
  {
    std::vector<double> mass_factor; /**< mass scaling factor of each block */
    std::vector<bool> held;          /**< whether a platen moves the block */
  };

  /** Contributions of the rigid blocks to the solver's sums. */
  struct RigidBlockWork
  {
    DampingWork damping;
    double unbalanced = 0.; /**< force and moment by radius of gyration [N] */
  };

  /**
   * The rigid blocks of a rank: triangulated as all blocks, but with three
   * degrees of freedom each, the displacement of the centroid and the rotation
   * (@cite ZhugeHunt2003, Eqs. 1-4),
   * @f[ m \ddot x = \sum f_i, \quad I \ddot\theta = \sum r_i \times f_i , @f]
   * with the mass m, the centroid and the moment of inertia I of the area, not
   * of masses lumped to nodes, and the sums over the forces on its nodes.
   * Rotation is a scalar in the plane, so the scheme is that of the nodes.
   *
   * Nodes move by u_i = d + (R - I) r_i, r_i the arms in the reference
   * configuration, so a block keeps its shape exactly.
   */
  class RigidBlocks
  {
  public:
    struct Block
    {
      unsigned int begin, end; /**< local nodes */
      double mass;             /**< [kg] */
      double inertia;          /**< moment about the centroid [kg m^2] */
      double lumped_inertia; /**< moment of the nodes' lumped masses [kg m^2] */
      dealii::Tensor<1, 2> centre; /**< centroid in the reference [m] */
    };

    /**
     * Sets up the rigid blocks of @p nodes. @p density: of each cell group
     * [kg/m^3]; @p thickness: the same.
     */
    void prepare(const NodeMap<2> &nodes, const std::vector<double> &density,
                 const Thickness &thickness);

    unsigned int n_blocks() const
    {
      return blocks.size();
    }
    const Block &block(const unsigned int b) const
    {
      return blocks[b];
    }
    /** Local nodes of all of them. */
    unsigned int first_node() const
    {
      return node_begin;
    }

    /**
     * Largest omega^2 [1/s^2] of block @p b by itself with the stiffness
     * @p bound, xx, yy, xy [N/m] of each local node: with the motion
     * J = (1, 0, -r_y; 0, 1, r_x) of a node the largest eigenvalue of
     * sum_i J^T S_i J in the metric m, m, I.
     */
    double
    largest_eigenvalue(unsigned int b,
                       const std::vector<std::array<double, 3>> &bound) const;

    /**
     * Advances one central difference step with the forces on the nodes, which
     * it clears; damping as in advance_nodes_damped(). Held blocks do not move.
     * @p viscous may be null. Blocks go through SIMD lanes together, but for
     * their nodes.
     */
    RigidBlockWork advance(const StepContext &step,
                           const RigidBlockStage &stage,
                           dealii::Tensor<1, 2> *force,
                           dealii::Tensor<1, 2> *viscous,
                           State<2> &state) const;

    /**
     * Sum over the blocks that are not held of F^2 / m + M^2 / I [N^2/kg], with
     * force F and moment M of @p force on their nodes with the arms before the
     * last step of @p dt [s]: the rate at which push() adds power.
     */
    double mobility(const RigidBlockStage &stage,
                    const dealii::Tensor<1, 2> *force, double dt,
                    const State<2> &state) const;

    /**
     * Adds @p duration [s] times @p force on the nodes, with these arms, to the
     * momentum in the last step of @p dt [s], and moves the blocks accordingly.
     */
    void push(const RigidBlockStage &stage, const dealii::Tensor<1, 2> *force,
              double duration, double dt, State<2> &state) const;

    /**
     * Sets displacement, rotation and velocity of held blocks from the motion
     * that a platen gave their nodes.
     */
    void follow_nodes(const RigidBlockStage &stage, State<2> &state) const;

    /**
     * Kinetic energy [J] of all blocks, 1/2 v m w, where w is @p share of the
     * way from the velocities @p before to those of @p after.
     */
    double kinetic_energy(const RigidBlockStage &stage,
                          const std::vector<RigidBlockState> &before,
                          const std::vector<RigidBlockState> &after,
                          double share) const;

    /** Sum of mass times squared change of velocity [J]. */
    double squared_change(const RigidBlockStage &stage,
                          const std::vector<RigidBlockState> &before,
                          const std::vector<RigidBlockState> &after) const;

  private:
    struct Arm
    {
      double x, y; /**< position from the centroid in the reference [m] */
      /** Fraction of the block's mass that is lumped to the node. */
      double share;
    };

    /** Cosine and sine of a block's rotation. */
    struct Direction
    {
      double c, s;
      explicit Direction(double angle);
      Direction(const double c, const double s) : c(c), s(s)
      {
      }
    };
    /** Blocks that advance() brings through the lanes together. */
    struct Pack;
    /** Force [N] and moment about the centroid [N m] of @p force on a block's
        nodes. */
    std::array<double, 3> resultant(const Block &block, const Direction &now,
                                    const dealii::Tensor<1, 2> *force) const;
    /** Sets the positions and velocities of a block's nodes. */
    void place_nodes(const Block &block, const RigidBlockState &rigid,
                     const Direction &before, const Direction &after,
                     State<2> &state) const;

    const Arm *arms_of(const Block &block) const
    {
      return &arms[block.begin - node_begin];
    }

    /** Mass, mass and moment of inertia, with mass scaling. */
    std::array<double, 3> inertia(const RigidBlockStage &stage,
                                  const unsigned int b) const
    {
      const double factor = stage.mass_factor[b];
      return { factor * blocks[b].mass, factor * blocks[b].mass,
               factor * blocks[b].inertia };
    }

    unsigned int node_begin = 0;
    std::vector<Block> blocks;
    std::vector<Arm> arms; /**< arms of the nodes from node_begin on */
  };
} // namespace quoin

#endif
