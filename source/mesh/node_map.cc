// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/node_map.h>

#include <deal.II/base/mpi_consensus_algorithms.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <boost/serialization/array.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace quoin
{
  namespace
  {
    using Dof = dealii::types::global_dof_index;

    /** The linear cells that represent one with the nodes @p nodes. */
    template <int dim>
    std::vector<std::array<unsigned int, dim + 1>>
    linear_cells(const std::vector<Dof> &nodes)
    {
      const auto cell = [&](const auto... k)
      {
        return std::array<unsigned int, dim + 1>{ static_cast<unsigned int>(
            nodes[k])... };
      };
      if constexpr (dim == 2)
      {
        if (nodes.size() == 6)
          return { cell(0, 3, 5), cell(1, 4, 3), cell(2, 5, 4), cell(3, 4, 5) };
        return { cell(0, 1, 2) };
      }
      else
        return { cell(0, 1, 2, 3) };
    }

    /** Vertices of face @p f of a cell, in between its midside node if the
        cell has those; as indices into its nodes. */
    template <int dim>
    std::vector<unsigned int> nodes_of_face(const unsigned int f,
                                            const bool is_quadratic)
    {
      const auto simplex = dealii::ReferenceCells::get_simplex<dim>();
      std::vector<unsigned int> result;
      for (unsigned int k = 0; k < dim; ++k)
        result.push_back(simplex.face_to_cell_vertices(f, k, 1));
      if (is_quadratic)
        result.insert(result.begin() + 1, dim + 1 + f);
      return result;
    }

    /** Sets begin and end of the part of @p segment in @p cell; returns whether
        there is one. */
    bool clip(const std::array<dealii::Point<2>, 2> &segment, CrossedCell &cell)
    {
      constexpr double least = 1e-9; // share of the segment, or of the cell
      const auto &c          = cell.corners;
      const auto twice_area  = [](const auto &p, const auto &q, const auto &r)
      { return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]); };
      cell.begin         = 0.;
      cell.end           = 1.;
      const double whole = twice_area(c[0], c[1], c[2]);
      for (unsigned int k = 0; k < 3; ++k)
      {
        // Barycentric coordinates at both ends.
        const auto &p  = c[(k + 1) % 3];
        const auto &q  = c[(k + 2) % 3];
        const double a = twice_area(p, q, segment[0]) / whole;
        const double b = twice_area(p, q, segment[1]) / whole;
        if (std::abs(a - b) < least)
        {
          if (a < -least)
            return false;
          continue;
        }
        const double zero = a / (a - b);
        if (a < b)
          cell.begin = std::max(cell.begin, zero);
        else
          cell.end = std::min(cell.end, zero);
      }
      return cell.end - cell.begin > least;
    }

    constexpr unsigned int linear_cells_of(const bool is_quadratic)
    {
      return is_quadratic ? 4 : 1;
    }
  } // namespace

  template <int dim>
  NodeMap<dim>::NodeMap(const BlockTriangulation<dim> &mesh,
                        const std::vector<Segment> &segments)
    : mesh(mesh), dofs(mesh.triangulation())
  {
    AssertThrow(dim == 2 || !table().is_quadratic,
                dealii::ExcMessage("Quadratic cells are triangles."));
    dofs.distribute_dofs(
        dealii::FE_SimplexP<dim>(table().is_quadratic ? 2 : 1));
    number_nodes();
    if constexpr (dim == 2)
      find_crossed_cells(segments);
    const Partners partners_of = nodes_of_joints();
    find_ghosts(partners_of);
    const std::vector<unsigned int> cell_place = order_cells();
    pack_cells(cell_place);
    pack_joints(partners_of, cell_place);
    pack_outer_faces(cell_place);
  }

  template <int dim>
  void NodeMap<dim>::number_nodes()
  {
    const dealii::IndexSet &owned = dofs.locally_owned_dofs();
    const unsigned int n          = owned.n_elements();
    const Dof first               = n > 0 ? owned.nth_index_in_set(0) : 0;
    const bool is_quadratic       = table().is_quadratic;

    // Nodes go by the first of these that differs: rigid or not, shared or
    // not, their number in the whole mesh or the order of the cells.
    std::vector<std::uint64_t> key(n, 0);
    constexpr std::uint64_t is_shared = std::uint64_t(1) << 40;
    constexpr std::uint64_t is_rigid  = std::uint64_t(1) << 41;
    std::vector<bool> met(n, false);
    std::uint64_t visit = 0;
    std::vector<Dof> nodes(dofs.get_fe().n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      cell->get_dof_indices(nodes);
      const bool rigid      = table().is_rigid[table().block_of_cell(
               cell->id().get_coarse_cell_id())];
      const auto visit_node = [&](const Dof node, const std::uint64_t number)
      {
        if (!owned.is_element(node) || met[node - first])
          return;
        met[node - first] = true;
        key[node - first] = number + (rigid ? is_rigid : 0);
      };
      if (is_quadratic)
        for (const auto &part : linear_cells<dim>(nodes))
          for (const unsigned int node : part)
            visit_node(node, visit++);
      else
        for (unsigned int k = 0; k <= dim; ++k)
          visit_node(nodes[k], mesh.vertex_numbers()[cell->vertex_index(k)]);
    }
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_ghost())
      {
        cell->get_dof_indices(nodes);
        for (const Dof node : nodes)
          if (owned.is_element(node))
            key[node - first] |= is_shared;
      }

    std::vector<unsigned int> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](const unsigned int a, const unsigned int b)
              { return key[a] < key[b]; });
    std::vector<Dof> new_numbers(n);
    for (unsigned int i = 0; i < n; ++i)
      new_numbers[order[i]] = first + i;
    dofs.renumber_dofs(new_numbers);
    shared_nodes_begin
        = std::count_if(key.begin(), key.end(),
                        [&](const std::uint64_t k) { return k < is_shared; });
    deformable_nodes
        = std::count_if(key.begin(), key.end(),
                        [&](const std::uint64_t k) { return k < is_rigid; });
  }

  template <int dim>
  typename NodeMap<dim>::Partners NodeMap<dim>::nodes_of_joints() const
  {
    const unsigned int rank
        = dealii::Utilities::MPI::this_mpi_process(communicator());
    std::map<unsigned int,
             typename dealii::DoFHandler<dim>::active_cell_iterator>
        cell_of_number;
    for (const JointPair<dim> &pair : mesh.joints())
      for (unsigned int side = 0; side < 2; ++side)
        if (pair.ranks[side] == rank)
          cell_of_number.emplace(pair.cells[side], dofs.end());
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        const auto found = cell_of_number.find(cell->id().get_coarse_cell_id());
        if (found != cell_of_number.end())
          found->second = cell;
      }

    Partners result(mesh.joints().size());
    // To other ranks: number of the pair, side, nodes.
    std::map<unsigned int, std::vector<std::vector<unsigned int>>> to_send;
    std::vector<Dof> nodes(dofs.get_fe().n_dofs_per_cell());
    for (unsigned int p = 0; p < mesh.joints().size(); ++p)
    {
      const JointPair<dim> &pair = mesh.joints()[p];
      for (unsigned int side = 0; side < 2; ++side)
      {
        if (pair.ranks[side] != rank)
          continue;
        cell_of_number.at(pair.cells[side])->get_dof_indices(nodes);
        for (const unsigned int k :
             nodes_of_face<dim>(pair.faces[side], table().is_quadratic))
          result[p][side].push_back(nodes[k]);
        if (pair.ranks[1 - side] != rank)
        {
          std::vector<unsigned int> message = { pair.number, side };
          message.insert(message.end(), result[p][side].begin(),
                         result[p][side].end());
          to_send[pair.ranks[1 - side]].push_back(message);
        }
      }
    }
    for (const auto &[from, messages] :
         dealii::Utilities::MPI::some_to_some(communicator(), to_send))
      for (const auto &message : messages)
      {
        const auto found = std::lower_bound(
            mesh.joints().begin(), mesh.joints().end(), message[0],
            [](const JointPair<dim> &pair, const unsigned int number)
            { return pair.number < number; });
        result[found - mesh.joints().begin()][message[1]].assign(
            message.begin() + 2, message.end());
      }
    return result;
  }

  template <>
  void NodeMap<2>::find_crossed_cells(const std::vector<Segment> &segments)
  {
    if (segments.empty())
      return;
    const unsigned int n_parts = linear_cells_of(table().is_quadratic);
    std::vector<CrossedCell> own;
    std::vector<Dof> nodes(dofs.get_fe().n_dofs_per_cell());
    std::map<unsigned int, dealii::Point<2>> place;
    for (const auto &cell : dofs.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      cell->get_dof_indices(nodes);
      for (unsigned int k = 0; k < 3; ++k)
      {
        place[nodes[k]] = cell->vertex(k);
        if (nodes.size() == 6)
          place[nodes[3 + k]] = dealii::Point<2>(
              0.5 * (cell->vertex(k) + cell->vertex((k + 1) % 3)));
      }
      const auto number = cell->id().get_coarse_cell_id();
      CrossedCell found{};
      found.block  = table().block_of_cell(number);
      found.group  = cell->material_id();
      found.number = n_parts * std::uint64_t(number);
      for (const auto &part : linear_cells<2>(nodes))
      {
        found.nodes = part;
        for (unsigned int k = 0; k < 3; ++k)
          found.corners[k] = place[part[k]];
        for (found.segment = 0; found.segment < segments.size();
             ++found.segment)
          if (clip(segments[found.segment], found))
            own.push_back(found);
        ++found.number;
      }
      place.clear();
    }
    for (const auto &part :
         dealii::Utilities::MPI::all_gather(communicator(), own))
      crossed.insert(crossed.end(), part.begin(), part.end());
    std::sort(crossed.begin(), crossed.end(),
              [](const CrossedCell &a, const CrossedCell &b)
              {
                return std::tie(a.segment, a.begin, a.end, a.number)
                       < std::tie(b.segment, b.begin, b.end, b.number);
              });
  }

  template <int dim>
  void NodeMap<dim>::find_ghosts(const Partners &partners_of)
  {
    const unsigned int rank
        = dealii::Utilities::MPI::this_mpi_process(communicator());
    const dealii::IndexSet &owned = dofs.locally_owned_dofs();
    const auto sort               = [](std::vector<unsigned int> &nodes)
    {
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    };
    std::vector<unsigned int> shared;
    std::vector<Dof> nodes(dofs.get_fe().n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
      {
        cell->get_dof_indices(nodes);
        for (const Dof node : nodes)
          if (!owned.is_element(node))
            shared.push_back(node);
      }
    sort(shared);

    std::vector<unsigned int> partners;
    for (unsigned int p = 0; p < partners_of.size(); ++p)
      for (unsigned int side = 0; side < 2; ++side)
        if (mesh.joints()[p].ranks[side] != rank)
          partners.insert(partners.end(), partners_of[p][side].begin(),
                          partners_of[p][side].end());
    for (const CrossedCell &cell : crossed)
      for (const unsigned int node : cell.nodes)
        if (!owned.is_element(node))
          partners.push_back(node);
    sort(partners);

    const Dof first = owned.n_elements() > 0 ? owned.nth_index_in_set(0) : 0;
    node_exchange   = std::make_unique<NodeExchange>(
        first, first + owned.n_elements(), dofs.n_dofs(), shared, partners,
        communicator());
  }

  template <int dim>
  std::vector<unsigned int> NodeMap<dim>::order_cells()
  {
    std::vector<BlockPart> &parts = local_blocks.parts;
    const unsigned int n_parts    = linear_cells_of(table().is_quadratic);
    std::vector<bool> is_at_others;
    std::vector<Dof> nodes(dofs.get_fe().n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      const unsigned int block
          = table().block_of_cell(cell->id().get_coarse_cell_id());
      const unsigned int begin = n_parts * is_at_others.size();
      if (parts.empty() || parts.back().number != block)
      {
        parts.push_back({ block, { begin, begin }, begin, { 0, 0 } });
        local_blocks.n_deformable += !table().is_rigid[block];
      }
      cell->get_dof_indices(nodes);
      is_at_others.push_back(!table().is_rigid[block]
                             && std::any_of(nodes.begin(), nodes.end(),
                                            [&](const Dof node) {
                                              return node_exchange->local(node)
                                                     >= shared_nodes_begin;
                                            }));
      parts.back().cells[1] = begin + n_parts;
    }
    if (table().is_mixed)
      for (auto first = is_at_others.begin(); first != is_at_others.end();
           first += parts_of_mixed)
        std::fill_n(first, parts_of_mixed,
                    std::find(first, first + parts_of_mixed, true)
                        != first + parts_of_mixed);
    std::vector<unsigned int> cell_place;
    for (BlockPart &part : parts)
    {
      part.first_inner_cell
          += n_parts
             * std::count(is_at_others.begin() + part.cells[0] / n_parts,
                          is_at_others.begin() + part.cells[1] / n_parts, true);
      unsigned int at_others = part.cells[0] / n_parts,
                   inner     = part.first_inner_cell / n_parts;
      for (unsigned int c = part.cells[0] / n_parts;
           c < part.cells[1] / n_parts; ++c)
        cell_place.push_back(is_at_others[c] ? at_others++ : inner++);
    }
    return cell_place;
  }

  template <int dim>
  void NodeMap<dim>::pack_cells(const std::vector<unsigned int> &cell_place)
  {
    const bool is_quadratic = table().is_quadratic;
    points.resize(node_exchange->n_local());
    node_block.resize(points.size(), none);
    node_numbers.resize(points.size());
    midside.assign(is_quadratic ? points.size() : 0, false);

    const unsigned int n_parts = linear_cells_of(is_quadratic);
    local_cells.is_quadratic   = is_quadratic;
    local_cells.nodes.resize(n_parts * cell_place.size());
    local_cells.group.resize(local_cells.size());
    local_cells.number.resize(local_cells.size());
    unsigned int index = 0;
    std::vector<Dof> nodes(dofs.get_fe().n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      const unsigned int block
          = table().block_of_cell(cell->id().get_coarse_cell_id());
      cell->get_dof_indices(nodes);
      for (Dof &node : nodes)
        node = node_exchange->local(node);
      for (unsigned int k = 0; k <= dim; ++k)
      {
        points[nodes[k]]       = cell->vertex(k);
        node_numbers[nodes[k]] = mesh.vertex_numbers()[cell->vertex_index(k)];
      }
      if (is_quadratic)
        for (unsigned int f = 0; f <= dim; ++f)
        {
          const auto face     = nodes_of_face<dim>(f, true);
          const auto [v0, v1] = std::minmax(
              { node_numbers[nodes[face[0]]], node_numbers[nodes[face[2]]] });
          node_numbers[nodes[face[1]]] = (v1 + 1) << 32U | v0;
          points[nodes[face[1]]]
              = 0.5 * (cell->vertex(face[0]) + cell->vertex(face[2]));
          midside[nodes[face[1]]] = true;
        }
      for (const Dof node : nodes)
        node_block[node] = block;
      unsigned int place   = n_parts * cell_place[index++];
      std::uint64_t number = n_parts * cell->id().get_coarse_cell_id();
      for (const auto &part : linear_cells<dim>(nodes))
      {
        local_cells.nodes[place]    = part;
        local_cells.group[place]    = cell->material_id();
        local_cells.number[place++] = number++;
      }
    }

    std::vector<BlockPart> &parts   = local_blocks.parts;
    const unsigned int n_deformable = local_blocks.n_deformable;
    local_cells.n_deformable        = n_deformable == parts.size()
                                          ? local_cells.size()
                                          : parts[n_deformable].cells[0];

    // Nodes of a block that are not shared are consecutive.
    unsigned int node = 0;
    for (unsigned int p = 0; p < parts.size(); ++p)
    {
      if (p == n_deformable)
        node = deformable_nodes;
      const unsigned int end
          = p < n_deformable ? shared_nodes_begin : n_owned();
      parts[p].nodes[0] = node;
      while (node < end && node_block[node] == parts[p].number)
        ++node;
      parts[p].nodes[1] = node;
    }

    std::vector<std::array<double, dim>> positions(points.size());
    for (unsigned int i = 0; i < n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        positions[i][d] = points[i][d];
    node_exchange->update_ghosts(positions.data());
    node_exchange->update_ghosts(node_block.data());
    node_exchange->update_ghosts(node_numbers.data());
    std::vector<unsigned char> is_midside(midside.begin(), midside.end());
    if (is_quadratic)
      node_exchange->update_ghosts(is_midside.data());
    for (unsigned int i = n_owned(); i < points.size(); ++i)
    {
      for (unsigned int d = 0; d < dim; ++d)
        points[i][d] = positions[i][d];
      if (is_quadratic)
        midside[i] = is_midside[i];
    }
  }

  template <int dim>
  void NodeMap<dim>::pack_joints(const Partners &partners_of,
                                 const std::vector<unsigned int> &cell_place)
  {
    const unsigned int rank
        = dealii::Utilities::MPI::this_mpi_process(communicator());
    const bool is_quadratic = table().is_quadratic;
    std::vector<unsigned int> numbers; // of owned cells, ascending
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        numbers.push_back(cell->id().get_coarse_cell_id());
    const auto linear_cell
        = [&](const unsigned int number, const unsigned int vertex)
    {
      const unsigned int cell
          = cell_place[std::lower_bound(numbers.begin(), numbers.end(), number)
                       - numbers.begin()];
      return is_quadratic ? 4 * cell + vertex : cell;
    };
    local_faces.n_global_joints
        = table().n_joint_faces * (is_quadratic ? 2 : 1);
    for (unsigned int p = 0; p < partners_of.size(); ++p)
    {
      const JointPair<dim> &pair = mesh.joints()[p];
      const auto local = [&](const unsigned int side, const unsigned int k)
      {
        const unsigned int node = partners_of[p][side][k];
        return pair.ranks[side] == rank ? node_exchange->local(node)
                                        : node_exchange->partner(node);
      };
      for (unsigned int part = 0; part < (is_quadratic ? 2 : 1); ++part)
      {
        JointNodes<dim> joint;
        joint.number = is_quadratic ? 2 * pair.number + part : pair.number;
        joint.name   = pair.name;
        joint.groups = pair.groups;
        for (unsigned int side = 0; side < 2; ++side)
        {
          joint.blocks[side] = table().block_of_cell(pair.cells[side]);
          joint.is_own[side] = pair.ranks[side] == rank;
          // A half belongs to the linear cell at its vertex.
          const auto face = nodes_of_face<dim>(pair.faces[side], is_quadratic);
          const bool at_start
              = part == (side == 1 && pair.match[0] == 1 ? 1U : 0U);
          joint.cells[side]
              = joint.is_own[side] ? linear_cell(
                    pair.cells[side], at_start ? face.front() : face.back())
                                   : none;
        }
        for (unsigned int k = 0; k < dim; ++k)
          if (is_quadratic)
          {
            // Vertex, midside, vertex; the other side the other way round.
            joint.lower[k] = local(0, part + k);
            joint.upper[k]
                = local(1, pair.match[0] == 1 ? 2 - part - k : part + k);
          }
          else
          {
            joint.lower[k] = local(0, k);
            joint.upper[k] = local(1, pair.match[k]);
          }
        if constexpr (dim == 3)
        {
          // deal.II's faces of a tetrahedron turn inwards.
          std::swap(joint.lower[1], joint.lower[2]);
          std::swap(joint.upper[1], joint.upper[2]);
        }
        local_faces.joints.push_back(joint);
      }
    }
  }

  template <int dim>
  void
  NodeMap<dim>::pack_outer_faces(const std::vector<unsigned int> &cell_place)
  {
    const bool is_quadratic    = table().is_quadratic;
    const unsigned int n_names = table().face_names.size();
    const unsigned int n_parts = linear_cells_of(is_quadratic);
    unsigned int index         = 0;
    std::vector<Dof> nodes(dofs.get_fe().n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
    {
      if (!cell->is_locally_owned())
        continue;
      const unsigned int first = n_parts * cell_place[index++];
      if (cell->at_boundary())
        cell->get_dof_indices(nodes);
      for (unsigned int f = 0; f <= dim; ++f)
      {
        if (!cell->face(f)->at_boundary()
            || cell->face(f)->boundary_id() >= n_names)
          continue;
        const auto face = nodes_of_face<dim>(f, is_quadratic);
        for (unsigned int part = 0; part + dim <= face.size(); ++part)
        {
          OuterFace<dim> result;
          for (unsigned int k = 0; k < dim; ++k)
            result.nodes[k] = node_exchange->local(nodes[face[part + k]]);
          // The linear cell at the vertex of this half.
          result.cell = first + (is_quadratic ? face[part == 0 ? 0 : 2] : 0);
          result.name = cell->face(f)->boundary_id();
          if constexpr (dim == 3)
            turn_outward(result.nodes, local_cells.nodes[result.cell]);
          local_faces.outer.push_back(result);
        }
      }
    }
    std::sort(local_faces.outer.begin(), local_faces.outer.end(),
              [](const OuterFace<dim> &a, const OuterFace<dim> &b)
              { return a.nodes < b.nodes; });
  }

  template <int dim>
  void NodeMap<dim>::turn_outward(
      std::array<unsigned int, dim> &face,
      const std::array<unsigned int, dim + 1> &cell) const
  {
    const auto opposite = std::find_if(
        cell.begin(), cell.end(),
        [&](const unsigned int node)
        { return std::find(face.begin(), face.end(), node) == face.end(); });
    if constexpr (dim == 3)
      if (dealii::cross_product_3d(points[face[1]] - points[face[0]],
                                   points[face[2]] - points[face[0]])
              * (points[*opposite] - points[face[0]])
          > 0.)
        std::swap(face[1], face[2]);
  }

  template class NodeMap<2>;
  template class NodeMap<3>;
} // namespace quoin
