// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_checkpoint_clock_h
#define quoin_output_checkpoint_clock_h

#include <quoin/base/wall_clock.h>
#include <quoin/output/interruption.h>

#include <deal.II/base/mpi.h>

#include <cstdint>

namespace quoin
{
  /** Tells when the next checkpoint is due, and that a signal asks the run to
      end. */
  class CheckpointClock
  {
  public:
    /** Short steps between looks, which are collective and cost more with more
        ranks. */
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

    /** Decision that all ranks share. */
    struct Look
    {
      bool is_due = false; /**< a checkpoint */
      int signal  = 0;     /**< signal that a rank has received; 0: none */
    };
    /** Collective: the first rank's clock counts for all, and a signal to any
        of them. */
    Look look() const
    {
      const bool is_due
          = dealii::Utilities::MPI::this_mpi_process(communicator) == 0
            && interval > 0. && seconds_since(last) > interval;
      int values[2] = { is_due, Interruption::received() };
      MPI_Allreduce(MPI_IN_PLACE, values, 2, MPI_INT, MPI_MAX, communicator);
      return { values[0] != 0, values[1] };
    }

  private:
    double interval;
    MPI_Comm communicator;
    WallClock::time_point last = WallClock::now();
  };
} // namespace quoin

#endif
