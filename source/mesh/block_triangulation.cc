// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/block_triangulation.h>
#include <quoin/base/none.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/grid/reference_cell.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/utility.hpp>

#include <numeric>
#include <set>
#include <tuple>

namespace quoin
{
  namespace
  {
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

    /** Cuts the whole mesh of the first rank into the parts of all ranks. */
    template <int dim>
    class Distributor
    {
    public:
      Distributor(const BlockMesh<dim> &mesh,
                  const std::vector<unsigned int> &rank_of_cell);

      MeshPart<dim> part(unsigned int rank) const;

    private:
      unsigned int
      face_of_vertices(unsigned int cell,
                       const std::array<unsigned int, dim> &vertices) const;
      void name_faces();
      void pair_joint_faces();

      const BlockMesh<dim> &mesh;
      const std::vector<unsigned int> &rank_of_cell;
      const std::array<std::array<unsigned int, dim>, dim + 1> face_vertices
          = vertices_of_faces<dim>();
      /** Boundary id of face f of cell c: entry (dim + 1) c + f. */
      std::vector<unsigned int> boundary_ids;
      JointMap<dim> pairs;
    };

    template <int dim>
    Distributor<dim>::Distributor(const BlockMesh<dim> &mesh,
                                  const std::vector<unsigned int> &rank_of_cell)
      : mesh(mesh), rank_of_cell(rank_of_cell)
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
    MeshPart<dim> Distributor<dim>::part(const unsigned int rank) const
    {
      MeshPart<dim> result;

      // Cells of other ranks that share a vertex come along as ghosts.
      std::vector<bool> is_touched(mesh.n_vertices(), false);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
        if (rank_of_cell[c] == rank)
          for (const unsigned int v : mesh.cells[c])
            is_touched[v] = true;

      std::vector<unsigned int> local(mesh.n_vertices(), none);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        auto cell = mesh.cells[c];
        if (std::none_of(cell.begin(), cell.end(),
                         [&](const unsigned int v) { return is_touched[v]; }))
          continue;
        for (unsigned int &v : cell)
        {
          if (local[v] == none)
          {
            local[v] = result.points.size();
            result.vertex_numbers.push_back(v);
            result.points.push_back(mesh.vertices[v]);
          }
          v = local[v];
        }
        for (unsigned int f = 0; f <= dim; ++f)
          if (const unsigned int id = boundary_ids[(dim + 1) * c + f];
              id != none)
            result.boundary_ids.emplace_back(
                (dim + 1) * result.cells.size() + f, id);
        result.cells.push_back(cell);
        result.cell_numbers.push_back(c);
        result.cell_ranks.push_back(rank_of_cell[c]);
        result.cell_groups.push_back(mesh.cell_group[c]);
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
  void CellTriangulation<dim>::create(const MeshPart<dim> &part)
  {
    using Serial = dealii::Triangulation<dim>;
    if (part.cells.empty())
    {
      // deal.II asks for a cell on each rank: one of no rank.
      std::vector<dealii::Point<dim>> corners(1);
      for (unsigned int d = 0; d < dim; ++d)
        corners.push_back(dealii::Point<dim>::unit_vector(d));
      dealii::CellData<dim> cell(dim + 1);
      std::iota(cell.vertices.begin(), cell.vertices.end(), 0);
      ids = { dealii::numbers::invalid_coarse_cell_id };
      Serial::create_triangulation(corners, { cell }, {});
      this->begin()->set_subdomain_id(dealii::numbers::artificial_subdomain_id);
    }
    else
    {
      std::vector<dealii::CellData<dim>> cells(part.cells.size(),
                                               dealii::CellData<dim>(dim + 1));
      for (unsigned int c = 0; c < cells.size(); ++c)
      {
        std::copy(part.cells[c].begin(), part.cells[c].end(),
                  cells[c].vertices.begin());
        cells[c].material_id = part.cell_groups[c];
      }
      ids = part.cell_numbers;
      Serial::create_triangulation(part.points, cells, {});
      auto boundary_id = part.boundary_ids.begin();
      for (const auto &cell : this->active_cell_iterators())
      {
        const unsigned int c = cell->index();
        cell->set_subdomain_id(part.cell_ranks[c]);
        for (; boundary_id != part.boundary_ids.end()
               && boundary_id->first / (dim + 1) == c;
             ++boundary_id)
          cell->face(boundary_id->first % (dim + 1))
              ->set_boundary_id(boundary_id->second);
      }
    }
    // That of the derived class, which is private, does the same.
    dealii::parallel::TriangulationBase<dim>::update_number_cache();
  }

  template <int dim>
  unsigned int
  CellTriangulation<dim>::coarse_cell_id_to_coarse_cell_index(const Id id) const
  {
    return std::lower_bound(ids.begin(), ids.end(), id) - ids.begin();
  }

  template <int dim>
  typename CellTriangulation<dim>::Id
  CellTriangulation<dim>::coarse_cell_index_to_coarse_cell_id(
      const unsigned int index) const
  {
    return ids[index];
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

    MeshPart<dim> own;
    if (is_first)
    {
      const Distributor<dim> distributor(mesh, rank_of_cell);
      const unsigned int n_ranks
          = dealii::Utilities::MPI::n_mpi_processes(communicator);
      for (unsigned int rank = 1; rank < n_ranks; ++rank)
        send(dealii::Utilities::pack(distributor.part(rank), false), rank,
             communicator);
      own = distributor.part(0);
    }
    else
      own = dealii::Utilities::unpack<MeshPart<dim>>(receive(communicator),
                                                     false);
    mesh = BlockMesh<dim>();
    cells.create(own);
    joint_map = std::move(own.joints);
    vertices  = std::move(own.vertex_numbers);
  }

  template class CellTriangulation<2>;
  template class CellTriangulation<3>;
  template class BlockTriangulation<2>;
  template class BlockTriangulation<3>;
} // namespace quoin
