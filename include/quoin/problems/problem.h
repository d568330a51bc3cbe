// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_problem_h
#define quoin_problems_problem_h

#include <quoin/base/exceptions.h>
#include <quoin/results/log.h>
#include <quoin/results/progress.h>
#include <quoin/results/table_set.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace quoin
{
  /** What the command line adds to the parameter file. */
  struct RunOptions
  {
    bool resume = false;
    bool check  = false; /**< report and stop before the first step */
    bool quiet  = false;
  };

  /** What a run lends to its problem. */
  struct RunContext
  {
    const RunOptions options;
    const MPI_Comm communicator;
    const std::string output; /**< folder of all results */
    Log &log;
    Progress &progress;
    TableSet &tables;

    bool is_first_rank() const
    {
      return log.is_active();
    }
  };

  /**
   * A step has failed and the state is that before it, which is worth a
   * checkpoint: Problem::take_step() has written what there is to see.
   */
  class FailedStep : public RunError
  {
  public:
    using RunError::RunError;
  };

  /**
   * What is computed, in stages of steps: all that a run knows of it. Problems
   * are constructed from parameters and a RunContext, to whose tables they add
   * theirs, and throw InputErrors that name the parameter file. Members are
   * collective.
   */
  class Problem
  {
  public:
    virtual ~Problem() = default;

    /** What a resumed run must have in common with the one before. */
    virtual std::string fingerprint() const = 0;
    virtual unsigned int n_stages() const   = 0;

    /**
     * Says what the model is and warns of what is likely a mistake; with
     * RunOptions::check also what the run costs.
     */
    virtual void report() = 0;
    /** Begins the files beside the tables, or goes on with them after load().
     */
    virtual void open_outputs() = 0;

    /** Goes on with what load() has read: before stage @p stage, or within it
        if it has begun. */
    virtual void resume(unsigned int stage, bool has_begun) = 0;
    virtual void begin_stage(unsigned int stage)            = 0;
    virtual bool stage_is_over() const                      = 0;
    virtual void end_stage()                                = 0;

    /** Whether a checkpoint may follow a step. */
    enum class Checkpoint
    {
      no,
      possible, /**< if its time has come */
      wanted
    };
    /** The next step of the stage, with the rows and fields that are due. */
    virtual Checkpoint take_step() = 0;

    /** Time, steps and how far the stage is. */
    virtual ProgressFigures progress_figures() const = 0;
    /** Figures for summary.json; @p seconds that this process has computed. */
    virtual void summarise(nlohmann::json &summary, double seconds) const = 0;
    /** The last words of a run with this summary. */
    virtual void report_end(const nlohmann::json &summary) = 0;

    /** Called before save(): checks and completes the state. */
    virtual void complete_state()                        = 0;
    virtual void save(boost::archive::binary_oarchive &) = 0;
    virtual void load(boost::archive::binary_iarchive &) = 0;
  };

  /** Runs @p task and puts the name of the parameter file before its
      InputErrors. */
  template <typename Task>
  void naming(const std::string &file, const Task &task)
  {
    try
    {
      task();
    }
    catch (const InputError &error)
    {
      throw InputError(file + ", " + error.what());
    }
  }
} // namespace quoin

#endif
