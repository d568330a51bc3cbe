// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/block_problem.h>
#include <quoin/problems/boundary_problem.h>
#include <quoin/results/checkpoint.h>

#include <fstream>
#include <sstream>

namespace quoin
{
  void Problem::report()
  {
    run.log.message(parameters.title.empty() ? parameters.file
                                             : parameters.title);
    report_model();
    // Nobody would read it.
    if (run.options.check && !run.options.quiet)
      report_costs();
  }

  std::unique_ptr<Problem> make_problem(const Parameters &parameters,
                                        const RunContext &run)
  {
    if (parameters.is_boundary_model)
      return std::make_unique<BoundaryProblem>(parameters, run);
    return std::make_unique<BlockProblem>(parameters, run);
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

  std::string run_fingerprint(const Parameters &parameters,
                              const MeshData &mesh)
  {
    std::string text = parameters.effective;
    append(mesh.vertices, text);
    append(mesh.triangles, text);
    append(mesh.triangle_group, text);
    append(mesh.lines, text);
    append(mesh.line_name, text);
    for (const auto *names : { &mesh.group_names, &mesh.line_names })
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
} // namespace quoin
