// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_operators_state_h
#define quoin_operators_state_h

#include <quoin/base/archive_members.h>
#include <quoin/base/node_record.h>
#include <quoin/operators/energy_accounts.h>
#include <quoin/operators/state_slices.h>

#include <cmath>
#include <cstdint>

namespace quoin
{
  /** Marks of State::block_marks. */
  namespace block_mark
  {
    constexpr std::uint8_t present  = 0;
    constexpr std::uint8_t left_box = 1; /**< present, outside the box */
    constexpr std::uint8_t removed  = 2; /**< deleted outside the box */
    constexpr std::uint8_t absent   = 3; /**< excavated, or not filled yet */
  }                                      // namespace block_mark

  /**
   * All that changes in time. Everything else is constant once prepared, so a
   * checkpoint is this and the parameters.
   *
   * Members are what every solver needs: time, the motion of the nodes, which
   * blocks are present, and the energy accounts. Other data of operators, such
   * as the internal variables of joints, are slices that the operators add: see
   * StateSlices.
   *
   * Nodes have the local numbers of a NodeMap.
   */
  template <int dim>
  struct State : StateSlices
  {
    double time              = 0.; /**< [s] */
    std::uint64_t step       = 0;  /**< since the start of the run */
    unsigned int stage       = 0;
    double stage_start       = 0.; /**< [s] */
    std::uint64_t stage_step = 0;  /**< steps done in this stage */
    double load_time         = 0.; /**< in the stage, by the loads' clock [s] */
    /** By how much that clock was behind the time as the stage began, after
        stages that slowed loads down or followed a path back and forth [s]. */
    double load_lag         = 0.;
    double load_rate        = 1.; /**< of that clock [-] */
    double load_rate_growth = 1.; /**< factor by step [-] */

    AlignedArray<NodeRecord<dim>> nodes;
    AlignedArray<dealii::Tensor<1, dim>> velocity; /**< at time - dt/2 */
    /** block_mark of each block of the mesh; empty: all are present. */
    AlignedArray<std::uint8_t> block_marks;
    double adaptive_damping   = 0.; /**< [1/s] */
    double previous_time_step = 0.; /**< [s] */
    double unbalanced_ratio   = 1.; /**< as last measured [-] */

    /** Complete at time, and the part of the step up to time + dt/2. */
    EnergyAccounts energy, pending;

    /** Whether @p block of the mesh is excavated or not filled yet. */
    bool is_absent(const unsigned int block) const
    {
      return !block_marks.empty() && block_marks[block] >= block_mark::removed;
    }

    /** T, the total time of the loads' clock, at the start of the stage [s]. */
    double load_start() const
    {
      return stage_start - load_lag;
    }

    /** load_lag of a stage that begins now [s]. */
    double next_load_lag() const
    {
      constexpr double rounding = 1e-12;
      const double lost         = time - stage_start - load_time;
      return std::abs(lost) > rounding * time ? load_lag + lost : load_lag;
    }

    /** load_start() of a stage that begins now [s]. */
    double next_load_start() const
    {
      return time - next_load_lag();
    }

    /** Begins a stage: its clocks. */
    void begin_clocks()
    {
      load_lag    = next_load_lag();
      stage_start = time;
      stage_step  = 0;
      load_time   = 0.;
    }

    /** Lists all but the slices; see Redistribution. */
    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(time, step, stage, stage_start, stage_step, load_time,
                   load_lag, load_rate, load_rate_growth);
      visitor.nodes(nodes);
      visitor.nodes(velocity);
      visitor.same(block_marks, adaptive_damping, previous_time_step,
                   unbalanced_ratio);
      visitor.sums(energy, pending);
    }

    /** Copies entries of this rank from @p part, with the same slices. */
    template <typename Moves>
    void take(State &part, Moves &moves)
    {
      moves.take("", *this, part);
      take_slices(part, moves);
    }
  };

  /** As that of any part, with the slices. */
  template <typename Archive, int dim>
  void serialize(Archive &archive, State<dim> &state,
                 const boost::serialization::version_type)
  {
    ArchiveMembers<Archive> members(archive);
    state.visit(members);
    state.archive_slices(archive);
  }
} // namespace quoin

#endif
