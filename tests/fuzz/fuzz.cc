// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Reads parameter files, meshes and tables that were right and are made wrong.
// All must be read or refused with an InputError: no crash, no other exception,
// no end that does not come, no value that is not finite.
//
//   fuzz SOURCE [--inputs N] [--seconds S] [--seed N] [--first N] [--limit S]
//        [--keep DIRECTORY]
//
// SOURCE is the project's folder, from which the right files are. Input number
// n of a seed is always the same: '--first n --inputs 1' makes one again.
// Batches of inputs run in a process each, so that a crash names its input.

#include "mutations.h"

#include <quoin/parameters/parameters.h>
#include <quoin/application/run.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/lone_process.h>
#include <quoin/signals/record.h>
#include <quoin/signals/time_function.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/mesh/mesh_report.h>
#include <quoin/mesh/node_map.h>
#include <quoin/mesh/partition.h>

#include <deal.II/base/mpi.h>

#include <CLI/CLI.hpp>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace quoin;
namespace fs = std::filesystem;

namespace
{
  struct Options
  {
    std::string source, keep;
    std::uint64_t n_inputs = 10000, first = 0, seed = 1;
    double seconds     = 1e9; /**< of all inputs */
    unsigned int limit = 30;  /**< seconds of work on one input */
  };

  enum class Kind
  {
    parameters,
    mesh,
    table
  };

  /** A right file. */
  struct Original
  {
    Kind kind;
    fs::path folder; /**< where its likes are read */
    std::string extension;
    std::string text;
    bool is_small = false; /**< its model is built, too */
  };

  struct Input
  {
    Kind kind;
    fs::path file;
    std::string text;
    bool is_small;
  };

  std::string read(const fs::path &path)
  {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }

  /** The folders of the source as links, beside which inputs are written. */
  void mirror(const fs::path &source, const fs::path &scratch)
  {
    for (const char *top : { "parameter_files", "meshes", "tests/errors" })
      for (auto it = fs::recursive_directory_iterator(source / top);
           it != fs::recursive_directory_iterator(); ++it)
      {
        const fs::path to = scratch / fs::relative(it->path(), source);
        if (it->is_directory() && it->path().filename() == "output")
          it.disable_recursion_pending();
        else if (it->is_regular_file())
        {
          fs::create_directories(to.parent_path());
          fs::create_symlink(it->path(), to);
        }
      }
  }

  /** The meshes of a geometry in gmsh's formats. */
  void add_meshes(const fs::path &geometry, const fs::path &folder,
                  std::vector<Original> &originals)
  {
    for (const char *version : { "2.2", "4.1" })
      for (const char *binary : { "0", "1" })
      {
        const fs::path format = folder / "made.geo", file = folder / "made.msh";
        std::ofstream(format) << "Mesh.MshFileVersion = " << version
                              << "; Mesh.Binary = " << binary << ";\n"
                              << read(geometry);
        write_gmsh_mesh(format, file);
        originals.push_back({ Kind::mesh, folder, ".msh", read(file) });
      }
  }

  std::vector<Original> find_originals(const fs::path &scratch)
  {
    std::vector<Original> result;
    std::vector<fs::path> files;
    for (const auto &entry : fs::recursive_directory_iterator(scratch))
      if (entry.is_regular_file())
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path &file : files)
      if (file.extension() == ".prm")
      {
        const bool is_small
            = file.parent_path() == scratch / "tests" / "errors";
        // Half of all are small ones, of which more is tried.
        for (unsigned int i = 0; i < (is_small ? 25 : 1); ++i)
          result.push_back({ Kind::parameters, file.parent_path(), ".prm",
                             read(file), is_small });
      }
    const fs::path errors = scratch / "tests" / "errors";
    for (unsigned int i = 0; i < 4; ++i)
      for (const char *name : { "base.geo", "crack.geo" })
      {
        add_meshes(errors / name, scratch, result);
        result.push_back({ Kind::mesh, scratch, ".geo", read(errors / name) });
      }
    const std::string peer
        = "PEER NGA STRONG MOTION DATABASE RECORD\n"
          "NORTHRIDGE 01/17/94 12:31, ARLETA, 090 (CDMG STATION 24087)\n"
          "ACCELERATION TIME HISTORY IN UNITS OF G\n"
          "NPTS=  5, DT= .02000 SEC\n"
          "   .100000E-02  -.2000E-02\n  0.3 -4.0E-1 5D-1\n";
    for (unsigned int i = 0; i < 20; ++i)
    {
      result.push_back({ Kind::table, scratch, ".csv",
                         "time, value # [s], [m]\n0, 0\n1, 2.5\n2, 1e-3\n" });
      result.push_back({ Kind::table, scratch, ".AT2", peer });
    }
    return result;
  }

  Input make_input(const std::vector<Original> &originals,
                   const Options &options, const std::uint64_t number)
  {
    std::seed_seq seeds{ options.seed, number };
    std::uint64_t seed[1];
    seeds.generate(seed, seed + 1);
    Mutator mutator(seed[0] + (number << 32U));
    const Original &original = mutator.one_of(originals);
    return { original.kind, original.folder / ("fuzz" + original.extension),
             mutator.mutate(original.text, original.kind == Kind::parameters),
             original.is_small };
  }

  void require(const bool holds, const std::string &what)
  {
    if (!holds)
      throw std::logic_error(what);
  }

  void try_parameters(const Input &input)
  {
    Parameters parameters = read_parameters(input.file.string(), {});
    if (!input.is_small)
      return;
    parameters.output_directory = "/nonexistent/quoin";
    const RunOptions check{ false, true, true };
    // Matrices of many boundary elements take long, as they should.
    for (const BoundaryCurveParameters &curve : parameters.boundary.boundaries)
      if (curve.n_elements > 100
          || (curve.element_length > 0. && curve.element_length < 0.05))
        return;
    Run(parameters, check, MPI_COMM_SELF).run();
  }

  template <int dim>
  void try_mesh_data(const MeshData<dim> &data, Mutator &mutator)
  {
    for (const auto &p : data.vertices)
      for (unsigned int d = 0; d < dim; ++d)
        require(std::isfinite(p[d]),
                "a vertex that is not finite was accepted");
    SplitOptions options;
    options.between_all = mutator.below(2) == 0;
    for (std::size_t i = 1; i < data.face_names.size(); ++i)
      if (mutator.below(2) == 0)
        options.joints_along.push_back(data.face_names[i]);
    BlockMesh<dim> mesh = split_into_blocks(data, options);
    require(mesh.n_blocks() > 0, "a mesh without blocks was accepted");
    const MeshReport report = make_mesh_report(mesh);
    require(!report.to_text().empty(), "no report");
    const std::vector<bool> is_rigid(mesh.n_blocks(), false);
    const auto rank = partition_cells(mesh, is_rigid, 3);
    require(rank.size() == mesh.n_cells()
                && std::all_of(rank.begin(), rank.end(),
                               [](const unsigned int r) { return r < 3; }),
            "cells without a rank");
    const std::vector<unsigned int> first(mesh.n_cells(), 0);
    const BlockTriangulation<dim> blocks(mesh, first, is_rigid, MPI_COMM_SELF);
    require(NodeMap<dim>(blocks).exchange().n_global() == report.n_nodes,
            "nodes are not those of the report");
  }

  void try_mesh(const Input &input, Mutator &mutator)
  {
    std::visit([&](const auto &data) { try_mesh_data(data, mutator); },
               read_any_gmsh(input.file.string(), MPI_COMM_SELF,
                             MeshDimension::from_mesh,
                             mutator.below(4) == 0 ? TriangleKind::quadratic
                                                   : TriangleKind::plain));
  }

  void try_table(const Input &input)
  {
    if (input.file.extension() == ".AT2")
    {
      const Signal signal = Record::read(input.file.string()).signal();
      for (const double t : { -1., 0., 0.01, 0.05, 1e3 })
        require(std::isfinite(signal.value(t)),
                "a record that is not finite was accepted");
      return;
    }
    const TimeFunction function("table " + input.file.filename().string(),
                                input.file.parent_path().string() + "/");
    for (const double t : { -1., 0., 0.5, 1.5, 3. })
      require(std::isfinite(function({ t, t })),
              "a table that is not finite was accepted");
  }

  /** Empty if it was read or refused as it should be. */
  std::string verdict_on(const Input &input, const std::uint64_t number)
  {
    Mutator mutator(number);
    try
    {
      switch (input.kind)
      {
      case Kind::parameters:
        try_parameters(input);
        break;
      case Kind::mesh:
        try_mesh(input, mutator);
        break;
      case Kind::table:
        try_table(input);
        break;
      }
      return "";
    }
    catch (const InputError &error)
    {
      return std::string(error.what()).size() > 20 ? "" : "says too little";
    }
    catch (const std::bad_alloc &)
    {
      return "takes all memory";
    }
    catch (const std::exception &error)
    {
      return std::string("throws: ") + error.what();
    }
    catch (...)
    {
      return "throws something else";
    }
  }

  /** What the processes share. */
  struct Progress
  {
    std::uint64_t under_way;
    std::uint64_t n_accepted;
    char finding[4000]; /**< of the input under way; empty: none */
  };

  constexpr unsigned int batch = 200;

  bool has_sanitizer()
  {
#ifdef __SANITIZE_ADDRESS__
    return true;
#else
    return false;
#endif
  }

  /** A signal after @p limit seconds of work, whatever else the machine does,
     or after many more of waiting; 0: none. */
  void limit_time(const unsigned int limit)
  {
    const itimerval work{ { 0, 0 }, { time_t(limit), 0 } };
    setitimer(ITIMER_PROF, &work, nullptr);
    alarm(20 * limit);
  }

  [[noreturn]] void run_batch(const std::vector<Original> &originals,
                              const Options &options, std::uint64_t begin,
                              const std::uint64_t end, Progress &shared)
  {
    const rlimit no_core{ 0, 0 }, memory{ 6UL << 30U, 6UL << 30U };
    setrlimit(RLIMIT_CORE, &no_core);
    if (!has_sanitizer()) // which reserves more for itself
      setrlimit(RLIMIT_AS, &memory);
    if (!std::freopen("/dev/null", "w", stdout))
      std::_Exit(3);
    int argc    = 1;
    char name[] = "fuzz", *arguments[] = { name, nullptr }, **argv = arguments;
    {
      prepare_lone_process();
      const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
      for (; begin < end; ++begin)
      {
        shared.under_way  = begin;
        const Input input = make_input(originals, options, begin);
        std::ofstream(input.file, std::ios::binary) << input.text;
        limit_time(options.limit);
        const std::string verdict = verdict_on(input, begin);
        limit_time(0);
        shared.n_accepted += verdict.empty();
        if (!verdict.empty())
        {
          std::snprintf(shared.finding, sizeof(shared.finding), "%s",
                        verdict.c_str());
          std::_Exit(2);
        }
      }
      shared.under_way = end;
    }
    std::_Exit(0);
  }

  /** Number of inputs on which something is wrong. */
  unsigned int run(const std::vector<Original> &originals,
                   const Options &options)
  {
    auto *shared = static_cast<Progress *>(
        mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE,
             MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    unsigned int n_findings = 0;
    const auto start        = std::chrono::steady_clock::now();
    std::uint64_t next      = options.first;
    const std::uint64_t end = options.first + options.n_inputs;
    while (next < end
           && std::chrono::duration<double>(std::chrono::steady_clock::now()
                                            - start)
                      .count()
                  < options.seconds)
    {
      shared->under_way  = next;
      shared->finding[0] = '\0';
      const pid_t child  = fork();
      if (child == 0)
        run_batch(originals, options, next,
                  std::min<std::uint64_t>(end, next + batch), *shared);
      int status = 0;
      waitpid(child, &status, 0);
      next                 = shared->under_way;
      const bool has_ended = WIFEXITED(status) && shared->finding[0] == '\0';
      if (has_ended && WEXITSTATUS(status) == 0 && next > options.first)
        continue;
      std::string what = shared->finding;
      if (what.empty() && WIFSIGNALED(status))
        what = WTERMSIG(status) == SIGALRM || WTERMSIG(status) == SIGPROF
                   ? "does not end"
                   : "crashes: " + std::string(strsignal(WTERMSIG(status)));
      else if (what.empty())
        what = "ends the process with status "
               + std::to_string(WEXITSTATUS(status));
      const Input input = make_input(originals, options, next);
      std::cout << "input " << next << " (" << input.file.filename().string()
                << "): " << what << std::endl;
      if (!options.keep.empty())
        std::ofstream(
            fs::path(options.keep)
                / (std::to_string(next) + input.file.extension().string()),
            std::ios::binary)
            << input.text;
      ++n_findings;
      ++next;
    }
    std::cout << next - options.first << " inputs, " << n_findings
              << " findings" << std::endl;
    return n_findings;
  }
} // namespace

int
main(int argc, char **argv)
{
  Options options;
  CLI::App app("Wrong inputs for the readers of quoin");
  app.add_option("SOURCE", options.source, "The project's folder")->required();
  app.add_option("--inputs", options.n_inputs, "How many");
  app.add_option("--first", options.first, "Number of the first");
  app.add_option("--seed", options.seed, "Another seed, other inputs");
  app.add_option("--seconds", options.seconds, "Begin none after so long");
  app.add_option("--limit", options.limit, "Seconds of work that one may take");
  app.add_option("--keep", options.keep, "Folder for what goes wrong");
  CLI11_PARSE(app, argc, argv);

  std::string scratch = (fs::temp_directory_path() / "quoin_fuzz_XXXXXX");
  if (mkdtemp(scratch.data()) == nullptr)
    return 2;
  if (!options.keep.empty())
    fs::create_directories(options.keep);
  mirror(fs::absolute(options.source), scratch);
  const std::vector<Original> originals = find_originals(scratch);
  const unsigned int n_findings         = run(originals, options);
  fs::remove_all(scratch);
  return n_findings == 0 ? 0 : 1;
}
