// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/block_triangulation.h>
#include <quoin/base/none.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/grid/reference_cell.h>
#include <deal.II/grid/tria_description.h>

#include <boost/serialization/utility.hpp>

#include <set>
#include <tuple>

namespace quoin
{
  namespace
  {
    template <int dim>
    using Description = dealii::TriangulationDescription::Description<dim, dim>;

    /** Vertices of the cell that are those of each of its faces. */
    template <int dim>
    std::array<std::array<unsigned int, dim>, dim + 1> vertices_of_faces()
    {
      const auto simplex = dealii::ReferenceCells::get_simplex<dim>();
      std::array<std::array<unsigned int, dim>, dim + 1> result;
      for (unsigned int f = 0; f <= dim; ++f)
        for (unsigned int k = 0; k < dim; ++k)
          result[f][k] = simplex.face_to_cell_vertices(f, k, 1);
      return result;
    }

    /** What one rank gets. */
    template <int dim>
    struct Part
    {
      Description<dim> description;
      std::vector<unsigned int> vertices; /**< numbers in the whole mesh */
      JointMap<dim> joints;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &description &vertices &joints;
      }
    };

    /** Cuts the whole mesh of the first rank into the parts of all ranks. */
    template <int dim>
    class Distributor
    {
    public:
      Distributor(const BlockMesh<dim> &mesh,
                  const std::vector<unsigned int> &rank_of_cell,
                  const MPI_Comm communicator);

      Part<dim> part(unsigned int rank) const;

    private:
      unsigned int
      face_of_vertices(unsigned int cell,
                       const std::array<unsigned int, dim> &vertices) const;
      void name_faces();
      void pair_joint_faces();

      const BlockMesh<dim> &mesh;
      const std::vector<unsigned int> &rank_of_cell;
      const MPI_Comm communicator;
      const std::array<std::array<unsigned int, dim>, dim + 1> face_vertices
          = vertices_of_faces<dim>();
      /** Boundary id of face f of cell c: entry (dim + 1) c + f. */
      std::vector<unsigned int> boundary_ids;
      JointMap<dim> pairs;
    };

    template <int dim>
    Distributor<dim>::Distributor(const BlockMesh<dim> &mesh,
                                  const std::vector<unsigned int> &rank_of_cell,
                                  const MPI_Comm communicator)
      : mesh(mesh), rank_of_cell(rank_of_cell), communicator(communicator)
    {
      boundary_ids.assign((dim + 1) * mesh.n_cells(), none);
      name_faces();
      pair_joint_faces();
    }

    template <int dim>
    unsigned int Distributor<dim>::face_of_vertices(
        const unsigned int cell,
        const std::array<unsigned int, dim> &vertices) const
    {
      // A face is told by the vertex of its cell that it does not have.
      for (unsigned int f = 0; f <= dim; ++f)
      {
        unsigned int n_shared = 0;
        for (const unsigned int k : face_vertices[f])
          n_shared += std::count(vertices.begin(), vertices.end(),
                                 mesh.cells[cell][k]);
        if (n_shared == dim)
          return f;
      }
      AssertThrow(false, dealii::ExcInternalError());
      return none;
    }

    template <int dim>
    void Distributor<dim>::name_faces()
    {
      for (const BlockFace<dim> &face : mesh.boundary_faces)
        boundary_ids[(dim + 1) * face.cell
                     + face_of_vertices(face.cell, face.vertices)]
            = face.name;
    }

    template <int dim>
    void Distributor<dim>::pair_joint_faces()
    {
      for (const JointFace<dim> &face : mesh.joint_faces)
      {
        JointPair<dim> pair;
        pair.cells        = face.cells;
        pair.faces        = { face_of_vertices(face.cells[0], face.lower),
                              face_of_vertices(face.cells[1], face.upper) };
        const auto vertex = [&](const unsigned int side, const unsigned int k) {
          return mesh
              .cells[pair.cells[side]][face_vertices[pair.faces[side]][k]];
        };
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              if (vertex(0, k) == face.lower[i]
                  && vertex(1, j) == face.upper[i])
                pair.match[k] = j;
        pair.number = pairs.size();
        pair.name   = face.name;
        pair.groups = face.groups;
        for (unsigned int side = 0; side < 2; ++side)
        {
          pair.ranks[side] = rank_of_cell[pair.cells[side]];
          boundary_ids[(dim + 1) * pair.cells[side] + pair.faces[side]]
              = mesh.face_names.size() + face.name;
        }
        pairs.push_back(pair);
      }
    }

    template <int dim>
    Part<dim> Distributor<dim>::part(const unsigned int rank) const
    {
      Part<dim> result;
      Description<dim> &description = result.description;
      description.comm              = communicator;
      description.smoothing         = dealii::Triangulation<dim>::none;
      description.settings
          = dealii::TriangulationDescription::Settings::default_setting;
      description.cell_infos.resize(1);

      // Cells of other ranks that share a vertex come along as ghosts.
      std::vector<bool> is_touched(mesh.n_vertices(), false);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (rank_of_cell[c] == rank)
          for (const unsigned int v : mesh.cells[c])
            is_touched[v] = true;

      std::vector<unsigned int> local(mesh.n_vertices(), none);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        if (std::none_of(mesh.cells[c].begin(), mesh.cells[c].end(),
                         [&](const unsigned int v) { return is_touched[v]; }))
          continue;
        dealii::CellData<dim> cell(dim + 1);
        cell.material_id = mesh.cell_group[c];
        cell.manifold_id = dealii::numbers::flat_manifold_id;
        for (unsigned int k = 0; k <= dim; ++k)
        {
          const unsigned int v = mesh.cells[c][k];
          if (local[v] == none)
          {
            local[v] = result.vertices.size();
            result.vertices.push_back(v);
            description.coarse_cell_vertices.push_back(mesh.vertices[v]);
          }
          cell.vertices[k] = local[v];
        }
        description.coarse_cells.push_back(cell);
        description.coarse_cell_index_to_coarse_cell_id.push_back(c);

        dealii::TriangulationDescription::CellData<dim> info;
        info.id           = dealii::CellId(c, {}).template to_binary<dim>();
        info.subdomain_id = rank_of_cell[c];
        info.level_subdomain_id = rank_of_cell[c];
        info.manifold_id        = dealii::numbers::flat_manifold_id;
        info.manifold_line_ids.fill(dealii::numbers::flat_manifold_id);
        info.manifold_quad_ids.fill(dealii::numbers::flat_manifold_id);
        for (unsigned int f = 0; f <= dim; ++f)
          if (boundary_ids[(dim + 1) * c + f] != none)
            info.boundary_ids.emplace_back(f, boundary_ids[(dim + 1) * c + f]);
        description.cell_infos[0].push_back(info);
      }
      for (const JointPair<dim> &pair : pairs)
        if (pair.ranks[0] == rank || pair.ranks[1] == rank)
          result.joints.push_back(pair);
      return result;
    }

    template <int dim>
    BlockTable<dim> make_table(const BlockMesh<dim> &mesh,
                               const std::vector<bool> &is_rigid)
    {
      BlockTable<dim> table;
      table.group_names = mesh.group_names;
      table.face_names  = mesh.face_names;
      table.first_cell  = mesh.block_first_cell;
      for (unsigned int b = 0; b < mesh.n_blocks(); ++b)
        table.group.push_back(mesh.cell_group[mesh.block_first_cell[b]]);
      table.is_rigid = is_rigid;
      std::set<std::array<unsigned int, 2>> joined;
      for (const JointFace<dim> &face : mesh.joint_faces)
      {
        std::array<unsigned int, 2> blocks
            = { table.block_of_cell(face.cells[0]),
                table.block_of_cell(face.cells[1]) };
        std::sort(blocks.begin(), blocks.end());
        joined.insert(blocks);
      }
      table.joined.assign(joined.begin(), joined.end());
      table.n_vertices    = mesh.n_vertices();
      table.n_joint_faces = mesh.joint_faces.size();
      table.is_quadratic  = mesh.quadratic;
      table.is_mixed      = mesh.mixed;
      std::tie(table.box[0], table.box[1])
          = dealii::BoundingBox<dim>(mesh.vertices).get_boundary_points();
      return table;
    }

    constexpr int part_tag = 71;

    void send(const std::vector<char> &buffer, const unsigned int rank,
              const MPI_Comm communicator)
    {
      // Counts of MPI are integers: large parts go in pieces.
      constexpr std::size_t piece = 1U << 30;
      const std::uint64_t size    = buffer.size();
      MPI_Send(&size, 1, MPI_UINT64_T, rank, part_tag, communicator);
      for (std::size_t begin = 0; begin < size; begin += piece)
        MPI_Send(buffer.data() + begin, std::min(size - begin, piece), MPI_BYTE,
                 rank, part_tag, communicator);
    }

    std::vector<char> receive(const MPI_Comm communicator)
    {
      constexpr std::size_t piece = 1U << 30;
      std::uint64_t size          = 0;
      MPI_Recv(&size, 1, MPI_UINT64_T, 0, part_tag, communicator,
               MPI_STATUS_IGNORE);
      std::vector<char> buffer(size);
      for (std::size_t begin = 0; begin < size; begin += piece)
        MPI_Recv(buffer.data() + begin, std::min(size - begin, piece), MPI_BYTE,
                 0, part_tag, communicator, MPI_STATUS_IGNORE);
      return buffer;
    }
  } // namespace

  template <int dim>
  void CellTriangulation<dim>::create_triangulation(
      const dealii::TriangulationDescription::Description<dim, dim>
          &description)
  {
    const auto &ids = description.coarse_cell_index_to_coarse_cell_id;
    runs.clear();
    for (unsigned int i = 0; i < ids.size(); ++i)
      if (i == 0 || ids[i] != ids[i - 1] + 1)
        runs.emplace_back(ids[i], i);
    dealii::parallel::fullydistributed::Triangulation<
        dim>::create_triangulation(description);
  }

  template <int dim>
  unsigned int CellTriangulation<dim>::coarse_cell_id_to_coarse_cell_index(
      const dealii::types::coarse_cell_id id) const
  {
    const auto next = std::upper_bound(runs.begin(), runs.end(), id,
                                       [](const auto value, const auto &run)
                                       { return value < run.first; });
    const auto &run = *std::prev(next);
    return run.second + (id - run.first);
  }

  template <int dim>
  BlockTriangulation<dim>::BlockTriangulation(
      BlockMesh<dim> &mesh, const std::vector<unsigned int> &rank_of_cell,
      const std::vector<bool> &is_rigid, const MPI_Comm communicator)
    : cells(communicator)
  {
    const bool is_first
        = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    if (is_first)
      block_table = make_table(mesh, is_rigid);
    block_table = dealii::Utilities::MPI::broadcast(communicator, block_table);

    Part<dim> own;
    if (is_first)
    {
      const Distributor<dim> distributor(mesh, rank_of_cell, communicator);
      const unsigned int n_ranks
          = dealii::Utilities::MPI::n_mpi_processes(communicator);
      for (unsigned int rank = 1; rank < n_ranks; ++rank)
        send(dealii::Utilities::pack(distributor.part(rank), false), rank,
             communicator);
      own = distributor.part(0);
    }
    else
    {
      own = dealii::Utilities::unpack<Part<dim>>(receive(communicator), false);
      own.description.comm = communicator;
    }
    mesh      = BlockMesh<dim>();
    joint_map = std::move(own.joints);
    vertices  = std::move(own.vertices);
    cells.create_triangulation(own.description);
  }

  template class CellTriangulation<2>;
  template class CellTriangulation<3>;
  template class BlockTriangulation<2>;
  template class BlockTriangulation<3>;
} // namespace quoin
