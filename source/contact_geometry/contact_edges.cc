// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/node_record.h>
#include <quoin/contact_geometry/contact_edges.h>

#include <deal.II/base/mpi_consensus_algorithms.h>

#include <bitset>
#include <cmath>
#include <functional>
#include <map>
#include <unordered_map>

namespace quoin
{
  namespace
  {
    namespace mpi = dealii::Utilities::MPI;

    /** Turns between edges of less than the first go straight on, of more
        than the second are corners [rad]. */
    constexpr double straight = 0.1, corner = 0.3;
    /** Sine of the turn below which sides of rigid blocks are straight. */
    constexpr double collinear = 1e-6;

    using Direction = dealii::Tensor<1, 2>;

    Direction direction_of(const ContactEdge &edge)
    {
      return edge.points[1] - edge.points[0];
    }

    /** What ContactEdge::corner is between edges in two directions. */
    double corner_between(const Direction &t, const Direction &s)
    {
      const double turn
          = std::abs(std::atan2(t[0] * s[1] - t[1] * s[0], t * s));
      return std::clamp((turn - straight) / (corner - straight), 0., 1.);
    }

    bool by_number(const ContactEdge &a, const ContactEdge &b)
    {
      return a.number < b.number;
    }

    std::unordered_map<unsigned int, unsigned int>
    edges_by_first_node(const std::vector<ContactEdge> &edges)
    {
      std::unordered_map<unsigned int, unsigned int> result;
      result.reserve(edges.size());
      for (unsigned int e = 0; e < edges.size(); ++e)
        result.emplace(edges[e].nodes[0], e);
      return result;
    }

    dealii::IndexSet index_set(const unsigned int size,
                               std::vector<unsigned int> indices)
    {
      std::sort(indices.begin(), indices.end());
      dealii::IndexSet result(size);
      result.add_indices(indices.begin(), indices.end());
      result.compress();
      return result;
    }

    /** The edges that other ranks have by the indices @p wanted, ascending;
        @p edge_of says what this rank has by the indices @p own. Collective. */
    std::vector<ContactEdge>
    ask_for(const dealii::IndexSet &own, const dealii::IndexSet &wanted,
            const std::function<const ContactEdge &(unsigned int)> &edge_of,
            const MPI_Comm communicator)
    {
      using Request    = std::vector<unsigned int>;
      using Answer     = std::vector<ContactEdge>;
      const auto ranks = mpi::compute_index_owner(own, wanted, communicator);
      std::map<unsigned int, Request> requests;
      std::map<unsigned int, std::vector<unsigned int>> places;
      std::vector<unsigned int> targets;
      for (unsigned int i = 0; i < ranks.size(); ++i)
      {
        requests[ranks[i]].push_back(wanted.nth_index_in_set(i));
        places[ranks[i]].push_back(i);
      }
      for (const auto &[rank, request] : requests)
        targets.push_back(rank);
      Answer result(ranks.size());
      mpi::ConsensusAlgorithms::selector<Request, Answer>(
          targets, [&](const unsigned int rank) { return requests[rank]; },
          [&](const unsigned int, const Request &request)
          {
            Answer answer;
            for (const unsigned int index : request)
              answer.push_back(edge_of(index));
            return answer;
          },
          [&](const unsigned int rank, const Answer &answer)
          {
            for (unsigned int i = 0; i < answer.size(); ++i)
              result[places[rank][i]] = answer[i];
          },
          communicator);
      return result;
    }
  } // namespace

  ContactEdges::ContactEdges(const NodeMap<2> &nodes) : node_map(nodes)
  {
    find_interfaces();
    const auto add = [&](const unsigned int a, const unsigned int b,
                         const unsigned int cell, const unsigned int interface)
    {
      const auto &c = nodes.cells().nodes[cell];
      const auto e1 = nodes.point(c[1]) - nodes.point(c[0]);
      const auto e2 = nodes.point(c[2]) - nodes.point(c[0]);
      ContactEdge edge;
      edge.nodes  = { nodes.exchange().global(a), nodes.exchange().global(b) };
      edge.points = { nodes.point(a), nodes.point(b) };
      edge.number = nodes.number_of_node(a);
      edge.block  = nodes.blocks().block_of_cell(cell);
      edge.group  = nodes.cells().group[cell];
      edge.previous  = none;
      edge.next      = none;
      edge.interface = interface;
      edge.length    = edge.points[0].distance(edge.points[1]);
      edge.height    = (e1[0] * e2[1] - e1[1] * e2[0]) / edge.length;
      own_edges.push_back(edge);
    };
    for (unsigned int f = 0; f < nodes.faces().joints.size(); ++f)
    {
      const JointNodes<2> &face    = nodes.faces().joints[f];
      const unsigned int interface = edges_of_joints[f].interface;
      if (face.is_own[0])
        add(face.lower[0], face.lower[1], face.cells[0], interface);
      if (face.is_own[1])
        add(face.upper[1], face.upper[0], face.cells[1], interface);
    }
    for (const OuterFace<2> &face : nodes.faces().outer)
      add(face.nodes[0], face.nodes[1], face.cell, none);
    std::sort(own_edges.begin(), own_edges.end(), by_number);
    link();
    merge_straight_sides(nodes.table().is_rigid);
    number_edges();
    join_over_ranks();
    find_joint_edges();
    for (const ContactEdge &edge : own_edges)
      own_nodes.push_back({ { nodes.exchange().local(edge.nodes[0]),
                              nodes.exchange().local(edge.nodes[1]) } });
    find_boundary_nodes();
  }

  void ContactEdges::find_interfaces()
  {
    const auto &joined = node_map.table().joined;
    std::vector<unsigned char> tips(joined.size(), 0);
    for (const JointNodes<2> &face : node_map.faces().joints)
    {
      std::array<unsigned int, 2> blocks = face.blocks;
      std::sort(blocks.begin(), blocks.end());
      const unsigned int interface = std::lower_bound(joined.begin(),
                                                      joined.end(), blocks)
                                     - joined.begin();
      edges_of_joints.push_back({ { none, none }, interface });
      for (unsigned int k = 0; k < 2; ++k)
        if (node_map.exchange().global(face.lower[k])
            == node_map.exchange().global(face.upper[k]))
          tips[interface] = 1;
    }
    MPI_Allreduce(MPI_IN_PLACE, tips.data(), tips.size(), MPI_UNSIGNED_CHAR,
                  MPI_MAX, node_map.communicator());
    interface_has_tip.assign(tips.begin(), tips.end());
  }

  void ContactEdges::link()
  {
    const auto edge_from = edges_by_first_node(own_edges);
    for (unsigned int e = 0; e < own_edges.size(); ++e)
    {
      const auto next   = edge_from.find(own_edges[e].nodes[1]);
      own_edges[e].next = next == edge_from.end() ? none : next->second;
      if (own_edges[e].next != none)
        own_edges[own_edges[e].next].previous = e;
    }
  }

  void ContactEdges::merge_straight_sides(const std::vector<bool> &is_rigid)
  {
    const auto direction = [](const ContactEdge &edge)
    { return (edge.points[1] - edge.points[0]) / edge.length; };
    const auto goes_on = [&](const ContactEdge &edge)
    {
      if (edge.previous == none || edge.interface != none
          || !is_rigid[edge.block])
        return false;
      const ContactEdge &before = own_edges[edge.previous];
      const auto t = direction(before), s = direction(edge);
      return before.interface == none && before.group == edge.group
             && std::abs(t[0] * s[1] - t[1] * s[0]) < collinear && t * s > 0.;
    };
    std::vector<ContactEdge> merged;
    for (const ContactEdge &start : own_edges)
    {
      if (goes_on(start))
        continue;
      ContactEdge side = start;
      while (side.next != none && goes_on(own_edges[side.next]))
      {
        const ContactEdge &part = own_edges[side.next];
        side.length += part.length;
        side.height    = std::min(side.height, part.height);
        side.nodes[1]  = part.nodes[1];
        side.points[1] = part.points[1];
        side.next      = part.next;
      }
      merged.push_back(side);
    }
    own_edges = std::move(merged);
    link();
  }

  void ContactEdges::number_edges()
  {
    // So far they have the numbers of their first vertices. Those where an edge
    // of any rank starts are bits here.
    using Word                    = std::bitset<64>;
    const MPI_Comm communicator   = node_map.communicator();
    const unsigned int n_vertices = mpi::max(
        own_edges.empty() ? 0 : own_edges.back().number + 1, communicator);
    std::vector<std::uint64_t> starts((n_vertices + 63) / 64, 0);
    for (const ContactEdge &edge : own_edges)
      starts[edge.number / 64] |= std::uint64_t(1) << edge.number % 64;
    MPI_Allreduce(MPI_IN_PLACE, starts.data(), starts.size(), MPI_UINT64_T,
                  MPI_BOR, communicator);
    auto next = own_edges.begin();
    for (unsigned int i = 0; i < starts.size(); ++i)
    {
      for (; next != own_edges.end() && next->number / 64 == i; ++next)
      {
        const std::uint64_t lower = (std::uint64_t(1) << next->number % 64) - 1;
        next->number              = n_edges + Word(starts[i] & lower).count();
      }
      n_edges += Word(starts[i]).count();
    }
    // Edges were linked by their places.
    for (ContactEdge &edge : own_edges)
    {
      if (edge.previous != none)
      {
        edge.corner[0] = corner_between(direction_of(edge),
                                        direction_of(own_edges[edge.previous]));
        edge.previous  = own_edges[edge.previous].number;
      }
      if (edge.next != none)
      {
        edge.corner[1] = corner_between(direction_of(edge),
                                        direction_of(own_edges[edge.next]));
        edge.next      = own_edges[edge.next].number;
      }
    }
  }

  namespace
  {
    /** An edge whose neighbour at a node is on another rank. */
    struct LooseEnd
    {
      unsigned int node, edge;
      unsigned int end; /**< 0 if the edge starts at the node, 1 if it ends */
      unsigned int rank;
      Direction direction;

      template <typename Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &node &edge &end &rank &direction;
      }
    };
  } // namespace

  void ContactEdges::join_over_ranks()
  {
    const unsigned int rank = mpi::this_mpi_process(node_map.communicator());
    std::vector<LooseEnd> loose;
    for (const ContactEdge &edge : own_edges)
      for (unsigned int k = 0; k < 2; ++k)
        if ((k == 0 ? edge.previous : edge.next) == none)
          loose.push_back(
              { edge.nodes[k], edge.number, k, rank, direction_of(edge) });
    if (mpi::max(loose.empty() ? 0U : 1U, node_map.communicator()) == 0)
      return;

    // They meet at the rank that owns the node.
    std::sort(loose.begin(), loose.end(),
              [](const LooseEnd &a, const LooseEnd &b)
              { return a.node < b.node; });
    std::vector<unsigned int> nodes;
    for (const LooseEnd &end : loose)
      nodes.push_back(end.node);
    const dealii::IndexSet wanted
        = index_set(node_map.exchange().n_global(), nodes);
    const auto owners = mpi::compute_index_owner(
        node_map.exchange().owned(), wanted, node_map.communicator());
    using Messages = std::map<unsigned int, std::vector<LooseEnd>>;
    Messages to_owners;
    for (const LooseEnd &end : loose)
      to_owners[owners[wanted.index_within_set(end.node)]].push_back(end);
    std::map<unsigned int, std::vector<LooseEnd>> met;
    for (const auto &[from, ends] :
         mpi::some_to_some(node_map.communicator(), to_owners))
      for (const LooseEnd &end : ends)
        met[end.node].push_back(end);
    Messages to_ranks;
    for (const auto &[node, ends] : met)
      if (ends.size() == 2)
        for (unsigned int k = 0; k < 2; ++k)
          to_ranks[ends[k].rank].push_back(ends[1 - k]);

    const auto find = [&](const unsigned int node, const unsigned int end)
    {
      auto found = std::lower_bound(loose.begin(), loose.end(), node,
                                    [](const LooseEnd &a, const unsigned int n)
                                    { return a.node < n; });
      while (found->end != end)
        ++found;
      return own_place(found->edge);
    };
    for (const auto &[from, ends] :
         mpi::some_to_some(node_map.communicator(), to_ranks))
      for (const LooseEnd &other : ends)
      {
        const unsigned int k                 = 1 - other.end;
        ContactEdge &edge                    = own_edges[find(other.node, k)];
        (k == 0 ? edge.previous : edge.next) = other.edge;
        edge.corner[k] = corner_between(direction_of(edge), other.direction);
        rank_of_neighbour[other.edge] = other.rank;
      }
  }

  void ContactEdges::find_joint_edges()
  {
    // Each side of each joint has an index of its own.
    const auto &faces    = node_map.faces().joints;
    const auto edge_from = edges_by_first_node(own_edges);
    std::map<unsigned int, unsigned int> place_of_side;
    std::vector<unsigned int> own_sides, foreign_sides;
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (unsigned int side = 0; side < 2; ++side)
      {
        const unsigned int index = 2 * faces[f].number + side;
        if (!faces[f].is_own[side])
        {
          foreign_sides.push_back(index);
          continue;
        }
        const unsigned int first
            = side == 0 ? faces[f].lower[0] : faces[f].upper[1];
        place_of_side[index] = edge_from.at(node_map.exchange().global(first));
        own_sides.push_back(index);
        edges_of_joints[f].edges[side] = own_edges[place_of_side[index]].number;
      }
    const unsigned int n_sides = 2 * node_map.faces().n_global_joints;
    if (mpi::n_mpi_processes(node_map.communicator()) == 1 || n_sides == 0)
      return;

    const dealii::IndexSet wanted = index_set(n_sides, foreign_sides);
    const auto across             = ask_for(
                    index_set(n_sides, own_sides), wanted,
                    [&](const unsigned int index) -> const ContactEdge             &
        { return own_edges[place_of_side.at(index)]; },
                    node_map.communicator());
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (unsigned int side = 0; side < 2; ++side)
        if (!faces[f].is_own[side])
          edges_of_joints[f].edges[side]
              = across[wanted.index_within_set(2 * faces[f].number + side)]
                    .number;
    for (const ContactEdge &edge : across)
      across_joints.push_back(edge.number);
    std::sort(across_joints.begin(), across_joints.end());
    add(across);
  }

  void ContactEdges::add(const std::vector<ContactEdge> &edges)
  {
    if (edges.empty())
      return;
    foreign_edges.insert(foreign_edges.end(), edges.begin(), edges.end());
    std::sort(foreign_edges.begin(), foreign_edges.end(), by_number);
    foreign_edges.erase(
        std::unique(foreign_edges.begin(), foreign_edges.end(),
                    [](const ContactEdge &a, const ContactEdge &b)
                    { return a.number == b.number; }),
        foreign_edges.end());
  }

  void ContactEdges::fetch(const std::vector<unsigned int> &numbers)
  {
    const MPI_Comm communicator = node_map.communicator();
    if (mpi::n_mpi_processes(communicator) == 1)
      return;
    std::vector<unsigned int> missing;
    for (const unsigned int number : numbers)
      if (!is_known(number))
        missing.push_back(number);
    if (mpi::max(missing.empty() ? 0U : 1U, communicator) == 0)
      return;
    std::vector<unsigned int> own;
    for (const ContactEdge &edge : own_edges)
      own.push_back(edge.number);
    add(ask_for(
        index_set(n_edges, own), index_set(n_edges, missing),
        [&](const unsigned int number) -> const ContactEdge &
        { return own_edges[own_place(number)]; },
        communicator));
  }

  void ContactEdges::keep(const std::vector<unsigned int> &numbers)
  {
    const auto is_in
        = [](const std::vector<unsigned int> &list, const unsigned int number)
    { return std::binary_search(list.begin(), list.end(), number); };
    foreign_edges.erase(
        std::remove_if(foreign_edges.begin(), foreign_edges.end(),
                       [&](const ContactEdge &edge) {
                         return !is_in(numbers, edge.number)
                                && !is_in(across_joints, edge.number);
                       }),
        foreign_edges.end());
  }

  void ContactEdges::find_boundary_nodes()
  {
    const NodeExchange &exchange = node_map.exchange();
    std::vector<dealii::Tensor<1, 1>> n_starts(exchange.n_local(),
                                               dealii::Tensor<1, 1>({ 0. }));
    for (const auto &[first, last] : own_nodes)
      n_starts[first][0] += 1.;
    exchange.add_to_owners(n_starts.data());
    for (unsigned int i = 0; i < exchange.n_owned(); ++i)
      if (n_starts[i][0] > 0.)
        starts.push_back(i);
  }
} // namespace quoin
