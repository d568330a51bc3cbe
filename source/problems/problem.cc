// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/output/checkpoint.h>
#include <quoin/problems/problem.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>

namespace quoin
{
  void Problem::report()
  {
    run.log.message(parameters.title.empty() ? parameters.file
                                             : parameters.title);
    run.log.warnings(parameters.warnings);
    report_model();
    // Costs are not measured if they are not shown.
    if (run.options.check && !run.options.quiet)
      report_costs();
  }

  namespace
  {
    /** Smaller shares of the time are not reported. */
    constexpr double least_share = 1e-3;
  } // namespace

  void Problem::summarise_time(const PhaseClock &clock, const double seconds,
                               nlohmann::ordered_json &summary) const
  {
    std::vector<double> times;
    for (unsigned int i = 0; i < clock.phases().size(); ++i)
      times.push_back(clock.time(i));
    // Processes step together: the mean of their times counts. They have the
    // same phases, because they have the same operators.
    dealii::Utilities::MPI::sum(times, run.communicator, times);
    // Samples of a short run may exceed the total.
    const double all = std::max(
        seconds * dealii::Utilities::MPI::n_mpi_processes(run.communicator),
        std::accumulate(times.begin(), times.end(), 0.));
    double other = 1.;
    for (unsigned int i = 0; i < times.size() && all > 0.; ++i)
    {
      const double share = times[i] / all;
      other -= share;
      if (share >= least_share)
        summary["time shares"][clock.phases()[i]] = share;
    }
    summary["time shares"]["other"] = std::max(other, 0.);
  }

  std::string Problem::time_line(const nlohmann::ordered_json &summary)
  {
    std::string shares;
    for (const auto &[phase, share] : summary["time shares"].items())
      if (share.get<double>() >= least_share)
        shares += text_of(shares.empty() ? "" : ", ", phase, " ",
                          std::round(1e3 * share.get<double>()) / 10., " %");
    return "\ntime: " + shares;
  }

  namespace
  {
    /** The bytes of @p values and how many there are. */
    template <typename T>
    void append(const std::vector<T> &values, std::string &text)
    {
      text += std::to_string(values.size()) + ":";
      text.append(reinterpret_cast<const char *>(values.data()),
                  values.size() * sizeof(T));
    }
  } // namespace

  template <int dim>
  std::string run_fingerprint(const Parameters &parameters,
                              const MeshData<dim> &mesh)
  {
    std::string text = parameters.effective;
    append(mesh.vertices, text);
    append(mesh.cells, text);
    append(mesh.cell_group, text);
    append(mesh.faces, text);
    append(mesh.face_name, text);
    for (const auto *names : { &mesh.group_names, &mesh.face_names })
      for (const std::string &name : *names)
        text += name + "\n";
    for (const std::string &file : parameters.time_files)
    {
      std::ostringstream contents;
      contents << std::ifstream(file, std::ios::binary).rdbuf();
      text += contents.str();
    }
    return fingerprint(text);
  }

  template std::string run_fingerprint(const Parameters &, const MeshData<2> &);
  template std::string run_fingerprint(const Parameters &, const MeshData<3> &);
} // namespace quoin
