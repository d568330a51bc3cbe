// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_block_histories_h
#define quoin_results_block_histories_h

#include <quoin/contact/block_contacts.h>
#include <quoin/model/named_blocks.h>
#include <quoin/operators/state.h>
#include <quoin/results/history_parameters.h>

#include <array>
#include <vector>

namespace quoin
{
  /**
   * The columns of histories.csv of named blocks: how they move as a whole, and
   * the forces between them.
   *
   * The motion of a rigid block is its degrees of freedom. That of a deformable
   * one, with lumped masses m_i, arms r_i from the centroid at rest and
   * displacements u_i of which U is the mean, is U, the rotation by which R r_i
   * is nearest to r_i + u_i - U in the mean weighted by mass, and the spin that
   * has its angular momentum.
   *
   * A force is the sum over the joints between both blocks, with their
   * tractions on the edges where these were, and over the general contacts.
   */
  class BlockHistories
  {
  public:
    /**
     * @p columns: their quantities are of blocks; @p blocks: all that have
     * names; @p contacts: null if displacements are small. Collective.
     */
    BlockHistories(const std::vector<HistoryParameters> &columns,
                   const std::vector<NamedBlock> &blocks, const Model<2> &model,
                   const BlockContacts *contacts);

    /** Whether column @p column has no value if @p block is deleted. */
    bool is_of(unsigned int column, unsigned int block) const;

    void before_step(const State<2> &state);
    /** Values of all columns for the time before the step; collective. */
    std::vector<double> after_step(const State<2> &state);

    /** The rotations that were counted, for a checkpoint. */
    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &counted;
    }

  private:
    /** Sums over the nodes of a block, on all ranks in the end; of a rigid
        block the first three are x, y [m] and rotation [rad], momentum and
        spin are velocities. */
    struct Sums
    {
      dealii::Tensor<1, 2> displacement; /**< sum of m u [kg m] */
      double sine   = 0.;                /**< sum of m r x u [kg m^2] */
      double cosine = 0.;                /**< sum of m r . u [kg m^2] */
      dealii::Tensor<1, 2> momentum;     /**< sum of m v [kg m/s] */
      double spin   = 0.;                /**< sum of m (r + u) x v [kg m^2/s] */
      double square = 0.;                /**< sum of m |r + u|^2 [kg m^2] */
    };
    /** Forces x, y [N] and moment about the centroid at rest [N m]. */
    using Force = std::array<double, 3>;

    struct Block
    {
      unsigned int number; /**< number in the whole mesh */
      bool is_rigid;
      BlockInertia rest;
      std::vector<unsigned int> nodes; /**< nodes that this rank owns */
      /** Masses of these nodes at the start of the run, by which the motion of
          the block is weighted whatever its density becomes [kg]. */
      std::vector<double> mass;
    };
    /** A side of a joint's segment that belongs to a block. */
    struct Side
    {
      unsigned int segment;
      bool is_lower;
    };
    struct Pair
    {
      unsigned int block;         /**< index into blocks */
      unsigned int first, second; /**< numbers in the mesh; or any_block */
      std::vector<Side> sides;    /**< sides on this rank */
    };
    struct Column
    {
      HistoryQuantity quantity;
      unsigned int component;
      unsigned int block; /**< index into blocks */
      unsigned int pair;  /**< index into pairs, for a force */
    };

    unsigned int add_block(unsigned int number);
    unsigned int add_pair(unsigned int first, unsigned int second);
    /** Whether a force of the block @p on by the block @p by is one of
        @p pair. */
    static bool acts(const Pair &pair, unsigned int on, unsigned int by);
    /** Adds @p share of the velocities of @p state to the sums. */
    void add_velocities(const State<2> &state, double share);
    void add_force(const Pair &pair, double share,
                   const dealii::Tensor<1, 2> &place,
                   const dealii::Tensor<1, 2> &force, Force &sum) const;
    Force joint_force(const Pair &pair);
    void add_contact_forces(const ContactState &all,
                            std::vector<Force> &forces) const;
    /** Sums of all ranks of @p sums and @p forces. */
    void add_up(std::vector<Force> &forces);
    /** x, y [m] and rotation [rad], or x, y [m/s] and spin [rad/s]. */
    std::array<double, 3> motion(unsigned int block, bool is_velocity) const;
    void count_rotations(const State<2> &state);

    static constexpr unsigned int any_block = -1;

    const Model<2> &model;
    const BlockContacts *contacts;
    std::vector<Block> blocks;
    std::vector<Pair> pairs;
    std::vector<Column> columns;
    std::vector<double> counted; /**< rotation of each block [rad] */
    std::vector<Sums> sums;      /**< sums of each block */
    State<2> before; /**< positions and joints at the time of the row */
    AlignedArray<dealii::Tensor<1, 2>>
        node_force; /**< zero but while it is used */
  };
} // namespace quoin

#endif
