// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/operators/stored_energy.h>

#include <deal.II/base/mpi.h>

#include <map>
#include <set>
#include <tuple>

#include "test_contacts.h"

// These tests also run on two and on four ranks.

using namespace quoin;
using namespace quoin::test;

namespace
{
  namespace mpi = dealii::Utilities::MPI;

  const MPI_Comm world = MPI_COMM_WORLD;

  unsigned int n_ranks()
  {
    return mpi::n_mpi_processes(world);
  }

  using Ranks = std::vector<unsigned int>;

  /** All cells of block b on rank @p rank_of_block(b). */
  Ranks whole_blocks(const BlockMesh<2> &mesh,
                     const std::function<unsigned int(unsigned int)> &rank)
  {
    Ranks result;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      result.push_back(rank(mesh.block_of_cell(c)));
    return result;
  }

  /** Vertical stripes [m], from rank to rank, so that blocks are divided;
      those of odd blocks begin farther to the right. */
  Ranks in_vertical_stripes(const BlockMesh<2> &mesh, const double width)
  {
    Ranks result;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      double x = 0.;
      for (const unsigned int v : mesh.cells[c])
        x += mesh.vertices[v][0] / 3.;
      const double offset = mesh.block_of_cell(c) % 2 == 1 ? 0.4 * width : 0.;
      result.push_back(static_cast<unsigned int>((x + offset) / width)
                       % n_ranks());
    }
    return result;
  }

  /** Cells in stripes, so that blocks lie on several ranks. */
  Ranks in_stripes(const BlockMesh<2> &mesh)
  {
    Ranks result;
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      result.push_back(c / 5 % n_ranks());
    return result;
  }

  /** Blocks on the ranks of a communicator, moved by hand. */
  struct Assembly
  {
    const BlockTriangulation<2> blocks;
    const NodeMap<2> nodes;
    const ContactModel model;
    MatchedJoints joints;
    BlockContacts contacts;
    State<2> state;
    AlignedArray<dealii::Tensor<1, 2>> force;

    Assembly(BlockMesh<2> mesh, const Ranks &rank_of_cell,
             const std::vector<JointSetParameters> &sets,
             const MPI_Comm communicator)
      : blocks(mesh, rank_of_cell, std::vector<bool>(mesh.n_blocks(), false),
               communicator),
        nodes(blocks), model(contact_model(sets)),
        contacts(nodes, joints, model)
    {
      joints.prepare(nodes, sets, thickness);
      joints.prepare(state);
      contacts.prepare(state);
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
        state.nodes.push_back({ { nodes.point(i)[0], nodes.point(i)[1] }, {} });
      state.velocity.assign(nodes.n_local(), dealii::Tensor<1, 2>());
    }

    /** Displacement of each node from its block and its place. */
    using Motion = std::function<dealii::Tensor<1, 2>(
        unsigned int, const dealii::Point<2> &)>;

    void find_forces(const Motion &motion)
    {
      for (unsigned int i = 0; i < nodes.n_local(); ++i)
        state.nodes[i].u = motion(nodes.block_of_node(i), state.nodes[i].X);
      state.get<ContactState>().next_check = state.step;
      find_forces(contacts, state);
      ++state.step;
    }

    void find_forces(BlockContacts &by, State<2> &at)
    {
      force.assign(nodes.n_local(), dealii::Tensor<1, 2>());
      joints.add_forces(at.nodes.data(), at.get<JointHistory>(), at.energy,
                        force.data());
      for (unsigned int i = nodes.n_owned() + nodes.exchange().n_shared();
           i < nodes.n_local(); ++i)
        force[i]
            = dealii::Point<2>(0., 0.); // on partners: their owners have them
      StepContext step{};
      step.dt = 1e-9;
      by.update(step, at);
      by.add_forces(step, at, { force.data(), nullptr });
      nodes.exchange().add_to_owners(force.data());
    }
  };

  /** The same assembly as a whole on one rank and distributed. */
  struct Twins
  {
    Assembly whole, part;
    std::vector<unsigned int> twin; /**< of owned nodes */

    Twins(const BlockMesh<2> &mesh, const Ranks &rank_of_cell,
          const std::vector<JointSetParameters> &sets = { touching() })
      : whole(mesh, Ranks(mesh.n_cells(), 0), sets, MPI_COMM_SELF),
        part(mesh, rank_of_cell, sets, world)
    {
      std::map<std::tuple<unsigned int, double, double>, unsigned int> found;
      const auto key = [](const NodeMap<2> &nodes, const unsigned int i)
      {
        return std::make_tuple(nodes.block_of_node(i), nodes.point(i)[0],
                               nodes.point(i)[1]);
      };
      for (unsigned int i = 0; i < whole.nodes.n_local(); ++i)
        found[key(whole.nodes, i)] = i;
      for (unsigned int i = 0; i < part.nodes.n_owned(); ++i)
        twin.push_back(found.at(key(part.nodes, i)));
    }

    void find_forces(const Assembly::Motion &motion)
    {
      whole.find_forces(motion);
      part.find_forces(motion);
    }

    /** @p tolerance: of forces by the largest; 0: bitwise. */
    void compare(const double tolerance) const
    {
      double largest = 0., error = 0.;
      for (const dealii::Tensor<1, 2> &f : whole.force)
        for (const double x : dealii::make_array_view(f))
          largest = std::max(largest, std::abs(x));
      for (unsigned int i = 0; i < twin.size(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
          error = std::max(
              error, std::abs(part.force[i][d] - whole.force[twin[i]][d]));
      EXPECT_LE(error, tolerance * largest);
      const auto sum
          = [](const double value) { return mpi::sum(value, world); };
      EXPECT_EQ(sum(n_touching(part.contacts.near_pairs(),
                               part.state.get<ContactState>())),
                n_touching(whole.contacts.near_pairs(),
                           whole.state.get<ContactState>()));
      const double energy = stored_energy(whole.state, whole.contacts);
      EXPECT_NEAR(sum(stored_energy(part.state, part.contacts)), energy,
                  1e-12 * energy);
      EXPECT_EQ(part.state.get<ContactState>().n_searches,
                whole.state.get<ContactState>().n_searches);
    }

    /** The pairs are those of one rank, in the same order, with the same
        histories. */
    void compare_pairs() const
    {
      const ContactEdges &edges = part.contacts.contact_edges();
      AlignedArray<ContactPair> all;
      for (const ContactPair &pair : whole.state.get<ContactState>().pairs)
        if (edges.is_own(pair.lower) || edges.is_own(pair.upper))
          all.push_back(pair);
      const AlignedArray<ContactPair> &here
          = part.state.get<ContactState>().pairs;
      ASSERT_EQ(here.size(), all.size());
      for (unsigned int i = 0; i < all.size(); ++i)
      {
        ASSERT_EQ(here[i].lower, all[i].lower);
        ASSERT_EQ(here[i].upper, all[i].upper);
        EXPECT_EQ(here[i].active, all[i].active);
        EXPECT_EQ(here[i].set, all[i].set);
        EXPECT_EQ(here[i].shift, all[i].shift);
        for (unsigned int k = 0; k < 2; ++k)
        {
          const ContactPoint &point = here[i].points[k],
                             &same  = all[i].points[k];
          EXPECT_EQ(point.normal_traction, same.normal_traction);
          EXPECT_EQ(point.shear_traction, same.shear_traction);
          EXPECT_EQ(point.plastic_slip, same.plastic_slip);
          EXPECT_EQ(point.slip_offset, same.slip_offset);
          EXPECT_EQ(point.area, same.area);
          EXPECT_EQ(point.state, same.state);
        }
      }
    }

    /** Each rank shares a block with another one. */
    void expect_divided() const
    {
      unsigned int n_divided = 0;
      for (const BlockPart &block : part.nodes.blocks().parts)
        n_divided += block.cells[1] - block.cells[0]
                     < part.nodes.table().first_cell[block.number + 1]
                           - part.nodes.table().first_cell[block.number];
      EXPECT_EQ(n_divided > 0, n_ranks() > 1);
      EXPECT_EQ(part.contacts.contact_edges().ranks_beside().empty(),
                n_ranks() == 1);
    }

    /** Of other ranks there are the edges of pairs and their neighbours. */
    void compare_edges() const
    {
      const ContactEdges &edges = part.contacts.contact_edges();
      std::set<unsigned int> needed;
      for (const ContactPair &pair : part.state.get<ContactState>().pairs)
        for (const unsigned int e : { pair.lower, pair.upper })
          needed.insert({ e, edges[e].previous, edges[e].next });
      unsigned int n_foreign = 0;
      for (const unsigned int e : needed)
      {
        ASSERT_TRUE(edges.is_known(e));
        n_foreign += !edges.is_own(e);
        const ContactEdge &same = whole.contacts.contact_edges()[e];
        EXPECT_EQ(edges[e].previous, same.previous);
        EXPECT_EQ(edges[e].next, same.next);
        EXPECT_EQ(edges[e].points, same.points);
        EXPECT_EQ(edges[e].corner, same.corner);
      }
      EXPECT_EQ(edges.foreign().size(), n_foreign);
    }

    /** Contacts that begin with the state as it is find the same forces. */
    void compare_resumed()
    {
      State<2> state                       = part.state;
      state.get<ContactState>().next_check = ContactState::never;
      State<2> resumed                     = state;
      part.find_forces(part.contacts, state);
      const auto gone_on = part.force;
      BlockContacts fresh(part.nodes, part.joints, part.model);
      part.find_forces(fresh, resumed);
      for (unsigned int i = 0; i < part.nodes.n_owned(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
          EXPECT_EQ(part.force[i][d], gone_on[i][d]);
    }
  };

  /** Columns of square blocks with gaps below the skin. */
  constexpr unsigned int n_columns = 12, n_rows = 5;

  BlockMesh<2> columns()
  {
    std::vector<Rectangle> rectangles;
    for (unsigned int c = 0; c < n_columns; ++c)
      for (unsigned int r = 0; r < n_rows; ++r)
        rectangles.push_back({ 1.02 * c, 1.02 * r, 1., 1., 4, 4 });
    return make_blocks(rectangles);
  }

  /** Columns are pushed into each other and slide past each other. */
  dealii::Tensor<1, 2> slide(const dealii::Point<2> &X, const double way)
  {
    const int column = static_cast<int>(X[0] / 1.02);
    return dealii::Point<2>(-0.023 * column, column % 2 == 0 ? way : -way);
  }

  unsigned int n_known(const ContactEdges &edges)
  {
    return edges.own().size() + edges.foreign().size();
  }
} // namespace

TEST(ContactsOfRanks, AreThoseOfOneRankWithTheNeighbourhoodAlone)
{
  const BlockMesh<2> mesh = columns();
  const Ranks ranks       = whole_blocks(
            mesh,
            [&](const unsigned int block)
            {
        const double x = mesh.vertices[mesh.block_first_vertex[block]][0];
        return static_cast<unsigned int>(x / 1.02) * n_ranks() / n_columns;
      });
  Twins twins(mesh, ranks);
  const ContactEdges &edges = twins.part.contacts.contact_edges();
  ASSERT_EQ(edges.n_global(), 16 * n_columns * n_rows);
  EXPECT_EQ(mpi::sum<unsigned int>(edges.own().size(), world),
            edges.n_global());
  EXPECT_LE(edges.own().size(),
            16 * n_rows * ((n_columns + n_ranks() - 1) / n_ranks()));
  unsigned int most = 0;
  for (unsigned int i = 0; i < 60; ++i)
  {
    twins.find_forces([&](const unsigned int, const dealii::Point<2> &X)
                      { return slide(X, 0.01 * i); });
    twins.compare(0.);
    twins.compare_pairs();
    twins.compare_edges();
    most = std::max<unsigned int>(most, edges.foreign().size());
  }
  EXPECT_GT(twins.part.state.get<ContactState>().n_searches, 10U);
  EXPECT_GT(n_touching(twins.whole.contacts.near_pairs(),
                       twins.whole.state.get<ContactState>()),
            100.);
  // Of each block beside this rank's the side that faces it and, about either
  // corner, an edge that may be near and the one after that.
  EXPECT_LE(most, 2 * n_rows * (4 + 4));
  EXPECT_EQ(most > 0, n_ranks() > 1);
  RecordProperty("edges of all ranks", edges.n_global());
  RecordProperty("edges known here", n_known(edges));
  twins.compare_resumed();
}

TEST(ContactsOfRanks, FollowBlocksThatMeetAnew)
{
  // Two rows of blocks pass each other, so that each meets blocks of all ranks.
  std::vector<Rectangle> rectangles;
  for (unsigned int i = 0; i < 24; ++i)
    rectangles.push_back({ 1.1 * (i % 12), i < 12 ? 0. : 1.001, 1., 1., 3, 2 });
  BlockMesh<2> mesh = make_blocks(rectangles);
  Twins twins(mesh, whole_blocks(mesh, [&](const unsigned int block)
                                 { return block * n_ranks() / 24; }));
  for (unsigned int i = 0; i < 75; ++i)
  {
    twins.find_forces(
        [&](const unsigned int, const dealii::Point<2> &X)
        {
          return X[1] < 1.0005 ? dealii::Point<2>(0., 0.)
                               : dealii::Point<2>(-7. + 0.2 * i, -0.003);
        });
    twins.compare(0.);
    twins.compare_pairs();
    twins.compare_edges();
  }
  twins.compare_resumed();
}

TEST(ContactsOfRanks, GoOnFromJointsThatAreHandedOver)
{
  JointSetParameters joint    = elastic_joint(kn, ks);
  coulomb_law(joint).peak     = { 1e4, 0.5, 0. };
  coulomb_law(joint).residual = { 0., 0.5, 0. };
  BlockMesh<2> mesh           = make_stack(6, 2);
  const Ranks whole
      = whole_blocks(mesh, [&](const unsigned int block)
                     { return (block + n_ranks() - 1) % n_ranks(); });
  for (const Ranks &ranks : { whole, in_vertical_stripes(mesh, 2.) })
  {
    Twins twins(mesh, ranks, { joint, touching() });
    if (ranks != whole)
      twins.expect_divided();
    for (unsigned int i = 0; i < 100; ++i)
    {
      twins.find_forces(
          [&](const unsigned int block, const dealii::Point<2> &)
          {
            return block == 0 ? dealii::Point<2>(0., 0.)
                              : dealii::Point<2>(1e-3 * i, -1e-4);
          });
      twins.compare(ranks == whole ? 0. : 1e-13);
      twins.compare_pairs();
    }
    EXPECT_EQ(twins.part.state.get<ContactState>().handed_over[0], 1);
    twins.compare_resumed();
  }
}

TEST(ContactsOfRanks, GoOnWhereABlockIsDivided)
{
  // A block slides over another one, there and back, and both are divided, so
  // that contacts pass from rank to rank on either side. Each new pair begins
  // beside one that has slipped.
  BlockMesh<2> mesh
      = make_blocks({ { 0., 0., 6., 1., 13, 2 }, { 0.2, 1., 3., 1., 7, 3 } });
  JointSetParameters softening    = touching();
  coulomb_law(softening).peak     = { 1e4, 0.8, 0. };
  coulomb_law(softening).residual = { 0., 0.4, 0. };
  for (const double width : { 0.9, 0.45 })
  {
    Twins twins(mesh, in_vertical_stripes(mesh, width), { softening });
    twins.expect_divided();
    for (unsigned int i = 0; i < 60; ++i)
    {
      const double way = 0.04 * (i < 40 ? i : 80 - i);
      twins.find_forces(
          [&](const unsigned int block, const dealii::Point<2> &X)
          {
            return block == 0 ? dealii::Point<2>(0., 0.)
                              : dealii::Point<2>(
                                  way, -1e-4 - 2e-5 * std::sin(X[0] + 0.2 * i));
          });
      twins.compare(1e-13);
      twins.compare_pairs();
      twins.compare_edges();
    }
    twins.compare_resumed();
  }
}

TEST(ContactsOfRanks, EdgesFollowEachOtherFromRankToRank)
{
  const BlockMesh<2> mesh = columns();
  const TestNodes nodes_of_one(mesh);
  const ContactEdges whole(nodes_of_one);
  BlockMesh<2> divided = mesh;
  const BlockTriangulation<2> blocks(divided, in_stripes(mesh),
                                     std::vector<bool>(mesh.n_blocks(), false),
                                     world);
  const NodeMap<2> nodes(blocks);
  ContactEdges edges(nodes);
  EXPECT_EQ(edges.n_global(), whole.n_global());
  std::set<unsigned int> neighbours;
  for (const ContactEdge &edge : edges.own())
    for (const unsigned int e : { edge.previous, edge.next })
      if (!edges.is_own(e))
        neighbours.insert(e);
  edges.fetch({ neighbours.begin(), neighbours.end() });
  edges.keep({ neighbours.begin(), neighbours.end() });
  EXPECT_EQ(edges.foreign().size(), neighbours.size());
  EXPECT_EQ(edges.foreign().empty(), n_ranks() == 1);
  for (const ContactEdge &edge : edges.own())
  {
    EXPECT_EQ(edges[edge.next].previous, edge.number);
    EXPECT_EQ(edges[edge.previous].next, edge.number);
    EXPECT_EQ(edges[edge.next].nodes[0], edge.nodes[1]);
    EXPECT_EQ(edges[edge.previous].nodes[1], edge.nodes[0]);
    EXPECT_EQ(edges[edge.next].block, edge.block);
    const ContactEdge &same = whole[edge.number];
    EXPECT_EQ(edge.points, same.points);
    EXPECT_EQ(edge.previous, same.previous);
    EXPECT_EQ(edge.next, same.next);
    EXPECT_EQ(edge.corner, same.corner);
    EXPECT_EQ(edge.height, same.height);
  }
}

TEST(ContactsOfRanks, StopAtADeepOverlapWithTheSameWords)
{
  BlockMesh<2> mesh
      = make_blocks({ { 0., 0., 3., 1., 3, 1 }, { 0.3, 1., 2., 1., 2, 1 } });
  Twins twins(mesh, whole_blocks(mesh, [&](const unsigned int block)
                                 { return (block + 1) % n_ranks(); }));
  const auto message = [](Assembly &assembly) -> std::string
  {
    try
    {
      for (unsigned int i = 0; i < 100; ++i)
        assembly.find_forces(
            [&](const unsigned int block, const dealii::Point<2> &X)
            {
              return dealii::Point<2>(
                  0., block == 1 ? 0.05 * (X[0] - 0.3) - 0.01 * i : 0.);
            });
    }
    catch (const RunError &error)
    {
      return error.what();
    }
    return "no error";
  };
  const std::string of_one = message(twins.whole);
  EXPECT_NE(of_one.find("blocks 0 and 1 overlap by 0.2"), std::string::npos)
      << of_one;
  EXPECT_EQ(message(twins.part), of_one);
}
