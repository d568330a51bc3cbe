// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_application_run_h
#define quoin_application_run_h

#include <quoin/problems/problem.h>
#include <quoin/output/checkpoint_clock.h>
#include <quoin/output/output_lock.h>

#include <memory>
#include <string>

namespace quoin
{
  /**
   * One run: takes a problem through its stages and keeps log, lock, tables,
   * checkpoints and summary in the output directory.
   */
  class Run
  {
  public:
    Run(const Parameters &parameters, const RunOptions &options,
        MPI_Comm communicator);

    /** Returns the number of the signal that has interrupted the run; 0: none.
        Throws InputError or RunError. */
    int run();

  private:
    /** Makes the problem that the parameters describe. */
    void make_problem();
    void open_outputs();
    std::string used_parameters() const
    {
      return output + "/used_parameters.prm";
    }
    /** Differences from the parameters of the run in the output directory. */
    std::string changed_parameters() const;
    void run_stage();
    void take_step();
    /** Says that the signal @p received, if it is not 0, ends the run. */
    void end_at(int received);
    void write_summary();
    /** The set-up time and, of blocks, that of the mesh in words. */
    std::string set_up_text() const;
    void save_checkpoint();
    bool has_ended() const;

    /** Archives the progress of run, tables and problem. */
    template <typename Archive>
    void archive_progress(Archive &archive);

    const Parameters parameters;
    const RunOptions options;
    const MPI_Comm communicator;
    const std::string output;

    OutputLock lock;
    Log log;
    Progress progress;
    TableSet tables;
    const RunContext context;
    CheckpointClock checkpoint_clock;
    std::unique_ptr<Problem> problem;
    std::unique_ptr<Stage> stage; /**< current stage, or the last one */

    unsigned int stage_index = 0; /**< index of the current or next stage */
    bool stage_begun         = false;
    int signal               = 0;  /**< signal that ends the run; 0: none */
    double wall_time         = 0.; /**< wall-clock time of all steps [s] */
    /** Wall-clock time of this process before its first stage and of beginning
        stages, and that of reading or generating the mesh in it [s]. */
    double set_up_time = 0., mesh_time = 0.;
    /** Wall-clock time of the steps of this process [s]. */
    double seconds = 0.;
  };
} // namespace quoin

#endif
