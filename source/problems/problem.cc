// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/block_problem.h>
#include <quoin/problems/boundary_problem.h>
#include <quoin/results/checkpoint.h>

#include <cctype>
#include <fstream>
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
    /** The mesh of a file, or of a generated geometry. */
    AnyMeshData read_mesh_data(const Parameters &parameters,
                               const MPI_Comm communicator)
    {
      const GeneratedGeometry &made = parameters.generated;
      if (made.geometry.empty())
        return read_any_gmsh(parameters.mesh_file, communicator,
                             parameters.dimension, parameters.cells);
      std::string section = made.name;
      section[0]          = std::toupper(section[0]);
      return mesh_gmsh_geometry(made.geometry, "section " + section,
                                communicator, parameters.cells);
    }
  } // namespace

  std::unique_ptr<Problem> make_problem(const Parameters &parameters,
                                        const RunContext &run)
  {
    if (parameters.is_boundary_model)
      return std::make_unique<BoundaryProblem>(parameters, run);
    AnyMeshData mesh = read_mesh_data(parameters, run.communicator);
    if (auto *plane = std::get_if<MeshData<2>>(&mesh))
      return std::make_unique<BlockProblem<2>>(parameters, std::move(*plane),
                                               run);
    check_three_dimensions(parameters);
    return std::make_unique<BlockProblem<3>>(
        parameters, std::move(std::get<MeshData<3>>(mesh)), run);
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
