// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/application/output_directory.h>
#include <quoin/application/run.h>
#include <quoin/base/parameter_file.h>
#include <quoin/base/wall_clock.h>
#include <quoin/block_problem/block_problem.h>
#include <quoin/boundary_problem/boundary_problem.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/output/atomic_file.h>
#include <quoin/output/checkpoint.h>
#include <quoin/output/json_file.h>

#include <nlohmann/json.hpp>

#include <cctype>
#include <cmath>
#include <fstream>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** The mesh of a file, or of a generated geometry. */
    AnyMeshData read_mesh_data(const Parameters &parameters,
                               const MPI_Comm communicator)
    {
      const GeneratedGeometry &made = parameters.generated;
      if (made.geometry.empty())
        return read_any_gmsh(parameters.mesh_file, communicator,
                             parameters.dimension, parameters.cells);
      std::string maker = parameters.mesh_file;
      if (maker.empty())
      {
        maker    = made.name;
        maker[0] = std::toupper(maker[0]);
        if (parameters.dimension == MeshDimension::three && !made.is_mesh)
          maker += " box";
        maker = "section " + maker;
      }
      return mesh_any_gmsh_geometry(made.geometry, maker, communicator,
                                    parameters.dimension, parameters.cells);
    }
  } // namespace

  Run::Run(const Parameters &parameters, const RunOptions &options,
           const MPI_Comm communicator)
    : parameters(parameters), options(options), communicator(communicator),
      output(parameters.output_directory),
      log(dealii::Utilities::MPI::this_mpi_process(communicator) == 0,
          options.quiet),
      progress(log),
      tables(output, communicator), context{ options, communicator, output,
                                             log,     progress,     tables },
      checkpoint_clock(parameters.checkpoint_interval, communicator)
  {
  }

  void Run::make_problem()
  {
    if (parameters.is_boundary_model)
    {
      problem = std::make_unique<BoundaryProblem>(parameters, context);
      return;
    }
    const auto start = WallClock::now();
    AnyMeshData mesh = read_mesh_data(parameters, communicator);
    mesh_time        = seconds_since(start);
    if (auto *plane = std::get_if<MeshData<2>>(&mesh))
    {
      problem = std::make_unique<BlockProblem<2>>(parameters, std::move(*plane),
                                                  context);
      return;
    }
    check_three_dimensions(parameters);
    problem = std::make_unique<BlockProblem<3>>(
        parameters, std::move(std::get<MeshData<3>>(mesh)), context);
  }

  int Run::run()
  {
    const auto start = WallClock::now();
    make_problem();
    set_up_time = seconds_since(start);
    problem->report();
    if (options.check)
    {
      log.message("set-up: ", set_up_text());
      return 0;
    }
    Interruption::begin_steps();
    open_outputs();
    if (has_ended())
    {
      log.message("the run had finished: nothing is left to do");
      return 0;
    }
    checkpoint_clock.restart();
    if (stage_begun)
    {
      stage = problem->make_stage(stage_index);
      stage->resume();
    }
    else if (options.resume)
      problem->restore(stage_index);
    set_up_time = seconds_since(start);
    while (!has_ended() && signal == 0)
      run_stage();
    return signal;
  }

  void Run::open_outputs()
  {
    context.on_first_rank<InputError>(
        [&]() { take_output(output, options.resume, lock); });
    CheckpointInfo info;
    unsigned int n_writers = 0;
    if (options.resume)
      info = load_checkpoint_archives(
          output, communicator, QUOIN_VERSION, problem->fingerprint(),
          [&](std::streambuf &buffer, const ArchiveOrigin &origin)
          {
            boost::archive::binary_iarchive archive(buffer);
            archive_progress(archive);
            problem->load(archive, origin);
            n_writers = origin.n_ranks;
          },
          changed_parameters());
    all_or_none<RunError>(communicator, [&]()
                          { log.open(output + "/log.txt", options.resume); });
    if (options.resume)
    {
      log.message("resumed at time ", info.time, " s, step ", info.step);
      if (n_writers != dealii::Utilities::MPI::n_mpi_processes(communicator))
        log.message("the checkpoint was written on ", n_writers,
                    n_writers == 1 ? " rank" : " ranks",
                    ": the results agree with those of an uninterrupted run "
                    "to rounding, not bit by bit");
    }
    tables.open(options.resume);
    context.on_first_rank(
        [&]() { write_text(used_parameters(), parameters.effective); });
    problem->open_outputs();
  }

  std::string Run::changed_parameters() const
  {
    std::ifstream before(used_parameters());
    if (!before)
      return "used_parameters.prm, which listed them, is gone";
    std::ostringstream text;
    text << before.rdbuf();
    return parameter_changes(text.str(), parameters.effective);
  }

  bool Run::has_ended() const
  {
    return stage_index == problem->n_stages();
  }

  void Run::run_stage()
  {
    if (!stage_begun)
    {
      const auto start = WallClock::now();
      stage            = problem->make_stage(stage_index);
      stage->begin();
      set_up_time += seconds_since(start);
    }
    stage_begun = true;
    progress.start(stage->figures());
    while (!stage->has_ended() && signal == 0)
      take_step();
    if (signal != 0)
      return;
    progress.finish(stage->figures());
    stage->end();
    stage_begun = false;
    ++stage_index;
    // Written before the checkpoint, which leaves nothing to resume.
    write_summary();
    save_checkpoint();
    if (!has_ended())
      end_at(checkpoint_clock.look().signal);
  }

  void Run::end_at(const int received)
  {
    if (received == 0)
      return;
    signal                        = received;
    const ProgressFigures figures = stage->figures();
    log.status("");
    log.message("interrupted by ", signal_name(signal), " at time ",
                figures.time, " s, step ", figures.step,
                ": the same command with --resume goes on from the checkpoint");
  }

  void Run::take_step()
  {
    const auto start = WallClock::now();
    const auto count = [&]()
    {
      const double passed = seconds_since(start);
      wall_time += passed;
      seconds += passed;
    };
    Stage::Checkpoint checkpoint{};
    try
    {
      checkpoint = stage->take_step();
    }
    catch (const FailedStep &)
    {
      count();
      write_summary();
      save_checkpoint();
      throw;
    }
    count();
    if (progress.due())
      progress.update(stage->figures());
    // The end of a stage has a checkpoint of its own.
    if (checkpoint == Stage::Checkpoint::no
        || (checkpoint == Stage::Checkpoint::possible && stage->has_ended()))
      return;
    const CheckpointClock::Look now = checkpoint_clock.look();
    if (checkpoint == Stage::Checkpoint::wanted
        || (checkpoint == Stage::Checkpoint::possible
            && (now.is_due || now.signal != 0)))
      save_checkpoint();
    if (now.signal == 0 || stage->has_ended())
      return;
    write_summary();
    end_at(now.signal);
  }

  void Run::write_summary()
  {
    nlohmann::ordered_json summary
        = { { "title", parameters.title },
            { "version", QUOIN_VERSION },
            { "finished", has_ended() },
            { "ranks", dealii::Utilities::MPI::n_mpi_processes(communicator) },
            { "wall time [s]", wall_time },
            { "set-up time [s]", set_up_time },
            { "mesh time [s]", mesh_time } };
    problem->summarise(summary, seconds);
    context.on_first_rank([&]()
                          { write_json(output + "/summary.json", summary); });
    if (!has_ended())
      return;
    const Problem::ClosingLines words = problem->closing_lines(summary);
    log.message("finished: ", words.what, " in ",
                duration_text(summary["wall time [s]"].get<double>()), ", ",
                words.figures, "\nset-up: ", set_up_text());
  }

  std::string Run::set_up_text() const
  {
    const auto seconds_text = [](const double seconds)
    { return text_of(std::round(100. * seconds) / 100., " s"); };
    return seconds_text(set_up_time)
           + (parameters.is_boundary_model
                  ? " besides steps"
                  : ", of which the mesh " + seconds_text(mesh_time));
  }

  template <typename Archive>
  void Run::archive_progress(Archive &archive)
  {
    archive &stage_index &stage_begun &wall_time &tables;
  }

  void Run::save_checkpoint()
  {
    problem->complete_state();
    tables.sync();
    const ProgressFigures figures = stage->figures();
    save_checkpoint_archives(
        output, communicator,
        { figures.step, figures.time, QUOIN_VERSION, problem->fingerprint() },
        [&](std::streambuf &buffer)
        {
          boost::archive::binary_oarchive archive(buffer);
          archive_progress(archive);
          problem->save(archive);
        });
    checkpoint_clock.restart();
  }
} // namespace quoin
