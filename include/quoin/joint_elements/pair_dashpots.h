// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_pair_dashpots_h
#define quoin_joint_elements_pair_dashpots_h

#include <quoin/joints/joint_damping.h>

#include <deal.II/base/tensor.h>

#include <mpi.h>

#include <array>
#include <vector>

namespace quoin
{
  /** Data of the blocks for the dashpots of joints and contacts. */
  struct DashpotBlocks
  {
    MPI_Comm communicator = MPI_COMM_NULL;
    /** One by the mass of each block of the mesh [1/kg]; 0: a load holds or
        moves the block. */
    std::vector<double> inverse_mass;
    /** One by the mass of each block, held or not [1/kg]. It counts between
        two blocks that are held, as parts of them may move. Empty: such blocks
        have no dashpots. */
    std::vector<double> own_inverse_mass;
    /** Whether several ranks have cells of the block. */
    std::vector<bool> is_divided;
    /** P and S wave impedance of each cell group [Pa s/m]; infinite: rigid. */
    std::vector<std::array<double, 2>> impedance;
  };

  /**
   * The dashpots of joints or contacts between two blocks a and b. With K the
   * sum of the springs of all points at which the two press on each other now
   * [N/m] and m = m_a m_b / (m_a + m_b), each point has beside its spring k the
   * dashpot c = T k, with the time T = 2 xi sqrt(m / K): together they are the
   * share xi of critical damping of the masses on these springs, whatever the
   * mesh. Per area c is at most the wave impedance of the blocks, which takes
   * all that comes.
   *
   * Where a block is divided, ranks add up their parts of K.
   */
  class PairDashpots
  {
  public:
    /** Something with springs between two blocks, an edge or a pair of edges.
     */
    struct Item
    {
      std::array<unsigned int, 2> blocks; /**< blocks of the mesh */
      std::array<unsigned int, 2> groups; /**< groups of the adjacent cells */
    };

    void set_blocks(const DashpotBlocks &new_blocks)
    {
      blocks = new_blocks;
    }
    /** Whether set_blocks() was called. */
    bool knows_blocks() const
    {
      return !blocks.inverse_mass.empty();
    }

    /** Sets the items of this rank. Collective. */
    void bind(const std::vector<Item> &items);

    // In each step, in this order.

    /** Forgets all springs. */
    void clear();
    /** Item @p item presses on springs kn and ks [N/m]; @p share: what of it
        this rank counts, of whose blocks one is divided. */
    void add_springs(unsigned int item, double share, double kn, double ks);
    /** Collective. */
    void sum_over_ranks();
    /** Times T [s] of a point of item @p item with the springs per area
        @p stiffness [Pa/m]: normal, shear. */
    std::array<double, 2> times(unsigned int item, const JointDamping &damping,
                                const std::array<double, 2> &stiffness) const;

  private:
    /** Two blocks, of which the items here are. */
    struct Pair
    {
      std::array<unsigned int, 2> blocks; /**< ascending */
      double mass;                        /**< m [kg]; 0: both are held */
      bool is_divided;
      dealii::Tensor<1, 2> springs; /**< K, normal and shear [N/m] */
    };

    DashpotBlocks blocks;
    std::vector<Pair> pairs;              /**< ascending */
    std::vector<unsigned int> item_pairs; /**< pair of each item */
    std::vector<std::array<double, 2>> item_impedance;
    /** Pairs of divided blocks of all ranks, ascending; local number or -1. */
    std::vector<unsigned int> divided_pairs;
  };
} // namespace quoin

#endif
