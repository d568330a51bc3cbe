// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/mesh/crossed_triangles.h>
#include <quoin/mesh/gmsh_process.h>
#include <quoin/mesh/gmsh_reader.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <filesystem>
#include <fstream>
#include <utility>

namespace quoin
{
  namespace
  {
    [[noreturn]] void fail(const std::string &source, const std::string &what)
    {
      throw InputError("Mesh '" + source + "': " + what);
    }

    void check_file(const std::string &filename)
    {
      namespace fs = std::filesystem;
      std::error_code ignored;
      if (!fs::exists(filename, ignored))
        fail(filename, "there is no such file. Check Mesh/File, which is "
                       "relative to the parameter file.");
      if (fs::is_directory(filename, ignored)
          || !std::ifstream(filename).good())
        fail(filename, "this cannot be read as a file. Check Mesh/File and "
                       "the file's permissions.");
      const std::string extension = fs::path(filename).extension();
      if (extension != ".geo" && extension != ".msh")
        fail(filename, "the name ends in '" + extension
                           + "'. Give a gmsh geometry (.geo) or mesh (.msh).");
      if (fs::file_size(filename, ignored) == 0)
        fail(filename, "the file is empty. Save it again from gmsh.");
    }

    /** What quoin_gmsh calls the elements that gmsh is to make. */
    std::string elements_of(const TriangleKind kind)
    {
      return kind == TriangleKind::crossed ? "quadrangles" : "triangles";
    }

    /**
     * The mesh of @p file, or of the text @p geometry if that is not empty, for
     * messages that begin with @p source and, where gmsh fails, end with
     * @p cure.
     */
    MeshData read(const std::string &file, const std::string &geometry,
                  const std::string &source, const std::string &cure,
                  const TriangleKind kind)
    {
      GmshMesh read = run_gmsh(source, { file, elements_of(kind) }, geometry);
      if (!read.gmsh_errors.empty())
        fail(source, "gmsh could not make a mesh of it: " + read.gmsh_errors
                         + ". " + cure);
      if (!read.refusal.empty())
        fail(source, read.refusal);

      MeshData mesh;
      mesh.source = source;
      mesh.vertices.reserve(read.vertices.size());
      for (const auto &[x, y] : read.vertices)
        mesh.vertices.emplace_back(x, y);
      mesh.triangles      = std::move(read.triangles);
      mesh.triangle_group = std::move(read.triangle_group);
      mesh.lines          = std::move(read.lines);
      mesh.line_name      = std::move(read.line_name);
      mesh.group_names    = std::move(read.group_names);
      mesh.line_names     = std::move(read.line_names);
      add_crossed_triangles(
          { std::move(read.quadrangles), std::move(read.quadrangle_group) },
          mesh);
      orient_triangles(mesh);
      mesh.quadratic = kind == TriangleKind::quadratic;
      return mesh;
    }
  } // namespace

  MeshData read_gmsh(const std::string &filename, const TriangleKind kind)
  {
    check_file(filename);
    return read(filename, "", filename,
                "Open the file in gmsh and repair it there.", kind);
  }

  namespace
  {
    /** What @p read gives on the first rank, there. */
    template <typename Read>
    MeshData read_on_first_rank(const MPI_Comm &communicator, const Read &read)
    {
      // The others must hear of an error, too, or they wait forever.
      MeshData mesh;
      std::string message;
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        try
        {
          mesh = read();
        }
        catch (const std::exception &error)
        {
          message = error.what();
        }
      message = dealii::Utilities::MPI::broadcast(communicator, message);
      if (!message.empty())
        throw InputError(message);
      return mesh;
    }
  } // namespace

  MeshData read_gmsh(const std::string &filename, const MPI_Comm &communicator,
                     const TriangleKind kind)
  {
    return read_on_first_rank(communicator,
                              [&]() { return read_gmsh(filename, kind); });
  }

  MeshData mesh_gmsh_geometry(const std::string &geometry,
                              const std::string &maker,
                              const MPI_Comm &communicator,
                              const TriangleKind kind)
  {
    return read_on_first_rank(
        communicator,
        [&]()
        {
          return read("/dev/stdin", geometry, maker,
                      "Change the parameters of that section.", kind);
        });
  }

  void write_gmsh_mesh(const std::string &geo_file, const std::string &msh_file,
                       const TriangleKind kind)
  {
    const GmshMesh written
        = run_gmsh(geo_file, { geo_file, elements_of(kind), msh_file });
    if (!written.gmsh_errors.empty())
      throw RunError("gmsh cannot write the mesh '" + msh_file
                     + "'. Is the disk full?");
  }
} // namespace quoin
