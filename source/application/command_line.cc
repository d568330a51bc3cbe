// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/application/command_line.h>
#include <quoin/application/run.h>
#include <quoin/parameters/parameters.h>
#include <quoin/parameters/schema.h>
#include <quoin/base/blas_kernels.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/lone_process.h>
#include <quoin/output/collective.h>
#include <quoin/output/interruption.h>

#include <deal.II/base/mpi.h>

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

namespace quoin
{
  namespace
  {
    struct Arguments
    {
      std::string file;
      std::vector<std::string> overrides;
      std::string output;
      bool print_parameters = false;
      bool print_schema     = false;
      RunOptions run;
    };

    /** Parses the command line; returns the exit status, or -1 to continue. */
    int parse(Arguments &arguments, int argc, char **argv)
    {
      CLI::App app("quoin: blocks on joints, by distinct elements or in "
                   "equilibrium, and boundary elements");
      app.add_option("CASE.prm", arguments.file, "The parameter file");
      app.add_option("--set", arguments.overrides,
                     "\"Section/Name=value\": overrides the parameter file; "
                     "may be repeated")
          ->allow_extra_args(false);
      app.add_option("--output", arguments.output,
                     "Output directory, instead of that of the file");
      app.add_flag("--resume", arguments.run.resume,
                   "Go on from the last checkpoint in the output directory");
      app.add_flag("--check", arguments.run.check,
                   "Read everything, report sizes and steps, do not run");
      app.add_flag("--print-parameters", arguments.print_parameters,
                   "Print all parameters with defaults and meaning");
      app.add_flag("--print-schema", arguments.print_schema,
                   "Print all parameters as JSON, for other programs");
      app.add_flag("--quiet", arguments.run.quiet,
                   "Warnings and errors alone on the screen; log.txt has all");
      app.set_version_flag("--version", std::string(QUOIN_VERSION));
      try
      {
        app.parse(argc, argv);
      }
      catch (const CLI::ParseError &error)
      {
        return app.exit(error) == 0 ? 0 : 1;
      }
      if (arguments.print_parameters)
      {
        std::cout << describe_parameters();
        return 0;
      }
      if (arguments.print_schema)
      {
        std::cout << parameter_schema();
        return 0;
      }
      if (arguments.file.empty())
      {
        std::cerr << "Error: no parameter file given. Use: quoin CASE.prm\n";
        return 1;
      }
      return -1;
    }

    /** A separate communicator for ranks that have failed. */
    class Errors
    {
    public:
      Errors()
      {
        MPI_Comm_dup(MPI_COMM_WORLD, &communicator);
      }
      ~Errors()
      {
        MPI_Comm_free(&communicator);
      }
      Errors(const Errors &)            = delete;
      Errors &operator=(const Errors &) = delete;

      MPI_Comm communicator;
    };

    /**
     * Whether all ranks arrive here within a time. If they are only late, the
     * run still ends, with the messages of several ranks.
     */
    bool all_have_failed(const Errors &errors)
    {
      using namespace std::chrono;
      constexpr auto patience = seconds(5);
      MPI_Request request;
      MPI_Ibarrier(errors.communicator, &request);
      const auto start = steady_clock::now();
      int all          = 0;
      while (!all && steady_clock::now() - start < patience)
      {
        MPI_Test(&request, &all, MPI_STATUS_IGNORE);
        if (!all)
          std::this_thread::sleep_for(milliseconds(1));
      }
      return all != 0;
    }
  } // namespace

  int run_command_line(int argc, char **argv)
  {
    Arguments arguments;
    const int parsed = parse(arguments, argc, argv);
    if (parsed >= 0)
      return parsed;

    prepare_lone_process();
    const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
    // A rank uses one core: matrix products must not start threads.
    choose_blas_kernels();
    const Errors errors;
    const bool first
        = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    // After MPI, which sets handlers of its own.
    Interruption::begin(first);
    Parameters parameters;
    const auto report = [&](const std::string &what, const int status)
    {
      // A failure on some ranks alone leaves the others waiting.
      const bool alone = !all_have_failed(errors);
      if (first || alone)
        std::cerr << "Error: "
                  << with_place(what, parameters.file, parameters.places)
                  << std::endl;
      if (alone)
        MPI_Abort(MPI_COMM_WORLD, status);
      return status;
    };
    try
    {
      // A rank whose machine cannot read the files must not leave the others.
      std::string message;
      try
      {
        parameters = read_parameters(arguments.file, arguments.overrides);
      }
      catch (const InputError &error)
      {
        message = error.what();
      }
      message = first_message(MPI_COMM_WORLD, message);
      if (!message.empty())
        throw InputError(message);
      if (!arguments.output.empty())
        parameters.output_directory = arguments.output;
      const int signal = Run(parameters, arguments.run, MPI_COMM_WORLD).run();
      // As shells say it of a process that a signal has ended.
      return signal == 0 ? 0 : 128 + signal;
    }
    catch (const InputError &error)
    {
      return report(error.what(), 1);
    }
    catch (const RunError &error)
    {
      return report(error.what(), 2);
    }
    catch (const std::bad_alloc &)
    {
      return report("not enough memory for this model. Coarsen it or use "
                    "more machines.",
                    2);
    }
    catch (const std::exception &error)
    {
      return report(error.what(), 2);
    }
  }
} // namespace quoin
