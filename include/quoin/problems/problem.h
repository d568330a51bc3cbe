// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_problem_h
#define quoin_problems_problem_h

#include <quoin/base/phase_clock.h>
#include <quoin/mesh/mesh_data.h>
#include <quoin/parameters/parameters.h>
#include <quoin/output/checkpoint.h>
#include <quoin/output/log.h>
#include <quoin/output/progress.h>
#include <quoin/output/table_set.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <string>

namespace quoin
{
  /** Options of the command line. */
  struct RunOptions
  {
    bool resume = false;
    bool check  = false; /**< report and stop before the first step */
    bool quiet  = false;
  };

  /** Resources of a run for its problem. */
  struct RunContext
  {
    const RunOptions options;
    const MPI_Comm communicator;
    const std::string output; /**< folder of all results */
    Log &log;
    Progress &progress;
    TableSet &tables;

    /** Runs @p task on the first rank; all throw what it throws, anything
        unknown as an @p Error. Collective. */
    template <typename Error = RunError, typename Task>
    void on_first_rank(const Task &task) const
    {
      all_or_none<Error>(communicator,
                         [&]()
                         {
                           if (log.is_active())
                             task();
                         });
    }
  };

  /**
   * A step has failed and the state is that before it, fit for a checkpoint;
   * Stage::take_step() has written its outputs.
   */
  class FailedStep : public RunError
  {
  public:
    using RunError::RunError;
  };

  /** A stage of a problem, which consists of steps. Members are collective. */
  class Stage
  {
  public:
    virtual ~Stage() = default;

    /** Begins the stage. */
    virtual void begin() = 0;
    /** Continues within the stage with the state that was loaded. */
    virtual void resume()          = 0;
    virtual bool has_ended() const = 0;

    /** Whether a checkpoint may follow a step. */
    enum class Checkpoint
    {
      no,
      kept,     /**< the last one is where a resumed run begins: the run may
                     end here */
      possible, /**< written if due */
      wanted
    };
    /** Takes the next step and writes the rows and fields that are due. */
    virtual Checkpoint take_step() = 0;

    /** Time, steps and completed share of the stage. */
    virtual ProgressFigures figures() const = 0;
    /** Called when the stage has ended. */
    virtual void end() = 0;
  };

  /**
   * A problem, solved in stages of steps: the interface to Run. Problems are
   * constructed from parameters and a RunContext, to whose tables they add
   * theirs, and throw InputErrors that name the parameter file. Members are
   * collective.
   */
  class Problem
  {
  public:
    /** @p parameters and @p run must outlive this object. */
    Problem(const Parameters &parameters, const RunContext &run)
      : parameters(parameters), run(run)
    {
    }
    virtual ~Problem() = default;

    /**
     * Reports the model and warns of likely mistakes; with RunOptions::check
     * also reports the cost of the run.
     */
    void report();

    virtual unsigned int n_stages() const                         = 0;
    virtual std::unique_ptr<Stage> make_stage(unsigned int index) = 0;
    /** After load(), restores model and solver as before stage @p index. */
    virtual void restore(unsigned int /*index*/)
    {
    }

    /** Begins the files beside the tables, or continues them after load(). */
    virtual void open_outputs() = 0;
    /** Adds figures to summary.json; @p seconds that this process has computed.
     */
    virtual void summarise(nlohmann::ordered_json &summary,
                           double seconds) const = 0;
    /** Last line of the log from this summary: "3 steps", and the text after
        the run time. */
    struct ClosingLines
    {
      std::string what, figures;
    };
    virtual ClosingLines
    closing_lines(const nlohmann::ordered_json &summary) const = 0;

    /** Called before save(): checks and completes the state. */
    virtual void complete_state()                        = 0;
    virtual void save(boost::archive::binary_oarchive &) = 0;
    /** Called for the archive of this rank or, if the run had another number of
        ranks, for those of all, see load_checkpoint_archives(). */
    virtual void load(boost::archive::binary_iarchive &, const ArchiveOrigin &)
        = 0;

    /** Fingerprint of the input that a resumed run must share with the
        interrupted one; see run_fingerprint(). */
    virtual const std::string &fingerprint() const = 0;

  protected:
    virtual void report_model() = 0;
    /** Reports time, memory and disk space of the run; measures for half a
        second and leaves the model changed. */
    virtual void report_costs() = 0;

    /** Adds the shares of @p clock in @p seconds of this process to
        @p summary. Collective. */
    void summarise_time(const PhaseClock &clock, double seconds,
                        nlohmann::ordered_json &summary) const;
    /** These shares as a last line of the log. */
    static std::string time_line(const nlohmann::ordered_json &summary);

    const Parameters &parameters;
    const RunContext &run;
  };

  /**
   * fingerprint() of all parameters, of the mesh as it was read or generated,
   * and of the files of tables and records.
   */
  template <int dim>
  std::string run_fingerprint(const Parameters &parameters,
                              const MeshData<dim> &mesh);
} // namespace quoin

#endif
