// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/open_log.h>
#include <quoin/results/vtu_series.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace quoin
{
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

  void take_output(const std::string &output, const bool resume,
                   OutputLock &lock)
  {
    namespace fs = std::filesystem;
    std::error_code error;
    fs::create_directories(output, error);
    std::error_code ignored;
    if (!fs::is_directory(output, ignored))
      throw InputError(
          "the output directory '" + output + "' cannot be made: "
          + (error ? error.message() : "there is a file of this name")
          + ". Choose another with 'Output directory' or --output.");
    lock.take(output);
    if (resume)
      return;
    remove_checkpoint(output);
    for (const char *name :
         { "summary.json", "histories.csv", "energies.csv", "safety.csv",
           "convergence.csv", "far_field.csv", "rock_statistics.csv" })
      fs::remove(output + "/" + name, error);
    remove_series(output);
    remove_series(output + "/mechanism");
  }
} // namespace quoin
