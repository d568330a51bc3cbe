// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/mesh/crossed_triangles.h>
#include <quoin/mesh/gmsh_process.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/mesh/halved_edges.h>
#include <quoin/mesh/mixed_tetrahedra.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <filesystem>
#include <fstream>
#include <tuple>
#include <utility>

namespace quoin
{
  namespace
  {
    /** Refuses a geometry whose last line, not a comment, has no end: gmsh
        would leave it out. */
    void refuse_last_line(const std::string &filename)
    {
      std::ifstream file(filename);
      std::string line, last;
      while (std::getline(file, line))
        last = file.eof() ? line : "";
      const auto begin = last.find_first_not_of(" \t\r");
      if (begin != std::string::npos && last.compare(begin, 2, "//") != 0)
        fail_on_mesh(filename,
                     "the last line, '" + last
                         + "', has no line end, and gmsh would leave "
                           "it out. End the file with an empty line.");
    }

    void check_file(const std::string &filename)
    {
      namespace fs = std::filesystem;
      std::error_code ignored;
      if (!fs::exists(filename, ignored))
        fail_on_mesh(filename,
                     "there is no such file. Check Mesh/File, which is "
                     "relative to the parameter file.");
      if (fs::is_directory(filename, ignored)
          || !std::ifstream(filename).good())
        fail_on_mesh(filename,
                     "this cannot be read as a file. Check Mesh/File and "
                     "the file's permissions.");
      const std::string extension = fs::path(filename).extension();
      if (extension != ".geo" && extension != ".msh")
        fail_on_mesh(filename,
                     "the name ends in '" + extension
                         + "'. Give a gmsh geometry (.geo) or mesh (.msh).");
      if (fs::file_size(filename, ignored) == 0)
        fail_on_mesh(filename, "the file is empty. Save it again from gmsh.");
      if (extension == ".geo")
        refuse_last_line(filename);
    }

    /** Arguments of quoin_gmsh. */
    std::vector<std::string> arguments(const std::string &file,
                                       const CellOptions &cells,
                                       const MeshDimension dimension)
    {
      const TriangleKind kind = cells.kind;
      return { file,
               kind == TriangleKind::crossed     ? "crossed"
               : kind == TriangleKind::quadratic ? "quadratic"
                                                 : "plain",
               std::to_string(static_cast<int>(dimension)),
               std::to_string(cells.refinements) };
    }

    /** Takes what quoin_gmsh gave for a mesh of that dimension. */
    template <int dim>
    MeshData<dim> take(GmshMesh &read, const std::string &source,
                       const CellOptions &cells)
    {
      MeshData<dim> mesh;
      mesh.source = source;
      mesh.vertices.reserve(read.vertices.size());
      for (const std::array<double, 3> &x : read.vertices)
      {
        dealii::Point<dim> &point = mesh.vertices.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          point[d] = x[d];
      }
      mesh.cell_group  = std::move(read.cell_group);
      mesh.face_name   = std::move(read.face_name);
      mesh.group_names = std::move(read.group_names);
      mesh.face_names  = std::move(read.face_names);
      if constexpr (dim == 2)
      {
        mesh.cells = std::move(read.triangles);
        mesh.faces = std::move(read.lines);
        Quadrangles quadrangles{ std::move(read.quadrangles),
                                 std::move(read.quadrangle_group) };
        for (unsigned int i = 0; i < read.n_halvings; ++i)
          halve_edges(mesh, quadrangles);
        add_crossed_triangles(quadrangles, mesh);
        mesh.quadratic = cells.kind == TriangleKind::quadratic;
      }
      else
      {
        mesh.cells = std::move(read.tetrahedra);
        mesh.faces = std::move(read.triangles);
      }
      orient_cells(mesh);
      if (cells.mixed_tetrahedra)
      {
        if constexpr (dim == 3)
          make_mixed(mesh);
        else
          fail_on_mesh(source, "it is plane, and 'Tetrahedra = mixed' in "
                               "section 'Mesh' is for three dimensions. Set "
                               "'Tetrahedra = plain'; against locking in the "
                               "plane there is 'Triangles = crossed'.");
      }
      return mesh;
    }

    /**
     * The mesh of @p file, or of the text @p geometry if that is not empty, for
     * messages that begin with @p source and, where gmsh fails, end with
     * @p cure.
     */
    AnyMeshData read(const std::string &file, const std::string &geometry,
                     const std::string &source, const std::string &cure,
                     const MeshDimension dimension, const CellOptions &cells)
    {
      const auto words = arguments(file, cells, dimension);
      GmshMesh read    = geometry.empty()
                             ? run_gmsh(source, words)
                             : run_gmsh(source, words, geometry, cure);
      if (!read.gmsh_errors.empty())
        fail_on_mesh(source, "gmsh could not make a mesh of it: "
                                 + read.gmsh_errors + ". " + cure);
      if (!read.refusal.empty())
        fail_on_mesh(source, read.refusal);
      if (read.dimension == 3)
        return take<3>(read, source, cells);
      return take<2>(read, source, cells);
    }

    AnyMeshData read_file(const std::string &filename,
                          const MeshDimension dimension,
                          const CellOptions &cells)
    {
      check_file(filename);
      return read(filename, "", filename,
                  "Open the file in gmsh and repair it there.", dimension,
                  cells);
    }

    /** What @p read gives on the first rank, there; its dimension everywhere.
     */
    template <typename Read>
    AnyMeshData read_on_first_rank(const MPI_Comm &communicator,
                                   const Read &read)
    {
      // The others must hear of an error, too, or they wait forever.
      AnyMeshData mesh;
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
      bool is_plane               = mesh.index() == 0;
      std::tie(message, is_plane) = dealii::Utilities::MPI::broadcast(
          communicator, std::make_pair(message, is_plane));
      if (!message.empty())
        throw InputError(message);
      if (!is_plane && mesh.index() == 0)
        mesh = MeshData<3>();
      return mesh;
    }
  } // namespace

  template <int dim>
  MeshData<dim> read_gmsh(const std::string &filename, const CellOptions &cells)
  {
    return std::get<MeshData<dim>>(
        read_file(filename, static_cast<MeshDimension>(dim), cells));
  }

  AnyMeshData read_any_gmsh(const std::string &filename,
                            const MPI_Comm &communicator,
                            const MeshDimension dimension,
                            const CellOptions &cells)
  {
    return read_on_first_rank(
        communicator, [&]() { return read_file(filename, dimension, cells); });
  }

  template <int dim>
  MeshData<dim> read_gmsh(const std::string &filename,
                          const MPI_Comm &communicator,
                          const CellOptions &cells)
  {
    return std::get<MeshData<dim>>(read_any_gmsh(
        filename, communicator, static_cast<MeshDimension>(dim), cells));
  }

  AnyMeshData mesh_any_gmsh_geometry(const std::string &geometry,
                                     const std::string &maker,
                                     const MPI_Comm &communicator,
                                     const MeshDimension dimension,
                                     const CellOptions &cells)
  {
    const std::string cure
        = maker.rfind("section ", 0) == 0
              ? "Change the parameters of that section, such as 'Element "
                "size', 'Shortest edge' or 'Random seed': joints that nearly "
                "meet leave no room for cells."
              : "Correct the blocks in the program that wrote the file.";
    return read_on_first_rank(communicator,
                              [&]() {
                                return read("/dev/stdin", geometry, maker, cure,
                                            dimension, cells);
                              });
  }

  MeshData<2> mesh_gmsh_geometry(const std::string &geometry,
                                 const std::string &maker,
                                 const MPI_Comm &communicator,
                                 const CellOptions &cells)
  {
    return std::get<MeshData<2>>(mesh_any_gmsh_geometry(
        geometry, maker, communicator, MeshDimension::two, cells));
  }

  void write_gmsh_mesh(const std::string &geo_file, const std::string &msh_file,
                       const CellOptions &cells)
  {
    std::vector<std::string> words
        = arguments(geo_file, cells, MeshDimension::from_mesh);
    words.push_back(msh_file);
    const GmshMesh written = run_gmsh(geo_file, words);
    if (!written.gmsh_errors.empty())
      throw RunError("gmsh cannot write the mesh '" + msh_file
                     + "'. Is the disk full?");
  }

  template MeshData<2> read_gmsh(const std::string &, const CellOptions &);
  template MeshData<3> read_gmsh(const std::string &, const CellOptions &);
  template MeshData<2> read_gmsh(const std::string &, const MPI_Comm &,
                                 const CellOptions &);
  template MeshData<3> read_gmsh(const std::string &, const MPI_Comm &,
                                 const CellOptions &);
} // namespace quoin
