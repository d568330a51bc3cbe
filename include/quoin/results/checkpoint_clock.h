// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_checkpoint_clock_h
#define quoin_results_checkpoint_clock_h

#include <quoin/base/wall_clock.h>

#include <deal.II/base/mpi.h>

#include <cstdint>

namespace quoin
{
  /** Tells when the next checkpoint is due. */
  class CheckpointClock
  {
  public:
    /** Short steps between readings of the clock, which are collective and cost
        more with more ranks. */
    static constexpr std::uint64_t steps_between_looks = 16;

    /** @p interval: from one checkpoint to the next [s]; 0: none is due. */
    CheckpointClock(const double interval, const MPI_Comm communicator)
      : interval(interval), communicator(communicator)
    {
    }

    /** Begins a new interval. */
    void restart()
    {
      last = WallClock::now();
    }

    /** Collective: the first rank's clock counts for all. */
    bool is_due() const
    {
      return interval > 0.
             && dealii::Utilities::MPI::broadcast(
                 communicator, seconds_since(last) > interval);
    }

  private:
    double interval;
    MPI_Comm communicator;
    WallClock::time_point last = WallClock::now();
  };
} // namespace quoin

#endif
