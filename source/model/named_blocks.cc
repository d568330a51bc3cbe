// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/number_text.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/base/point_text.h>
#include <quoin/model/block_placement.h>
#include <quoin/model/named_blocks.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;

    void enter(ParameterEntries &entries, NamedBlock &block)
    {
      entries.other("Point", "",
                    "Point x, y inside the block in its initial position; "
                    "empty: 'Group' is given [m]",
                    [&](const ParameterSection &section)
                    {
                      block.has_point = !section.text("Point").empty();
                      if (!block.has_point)
                        return;
                      const auto [x, y] = section.numbers<2>("Point");
                      block.point       = dealii::Point<2>(x, y);
                    });
      entries.text("Group", block.group,
                   "Physical surface of the block, instead of 'Point'; no "
                   "other block may have a part of it.");
      std::array<double, 2> velocity{};
      entries.numbers("Velocity", velocity,
                      "Initial velocity x, y of the block's centroid at t = 0, "
                      "added to that of section 'Initial motion' [m/s]");
      block.velocity[0] = velocity[0];
      block.velocity[1] = velocity[1];
      entries.number("Spin", block.spin,
                     "Initial angular velocity of the block about its centroid "
                     "at t = 0, anticlockwise [deg/s]",
                     constants::degree);
      const ParameterSection *section = entries.read_section();
      if (section && block.has_point == !block.group.empty())
        section->fail("Point", block.has_point
                                   ? "and 'Group' are both given: say by one "
                                     "of them which block is meant."
                                   : "or 'Group' must say which block is "
                                     "meant: give a point inside it.");
    }

    /** Whether @p point is in the triangle or on its edge. */
    bool is_in_cell(const NodeMap<2> &nodes, const unsigned int cell,
                    const dealii::Point<2> &point)
    {
      constexpr double rounding = 1e-12; // of the area
      const auto &[i, j, k]     = nodes.cells().nodes[cell];
      const auto &a = nodes.point(i), &b = nodes.point(j), &c = nodes.point(k);
      const double least = -rounding * twice_area(a, b, c);
      return twice_area(a, b, point) >= least
             && twice_area(b, c, point) >= least
             && twice_area(c, a, point) >= least;
    }

    /** Which blocks have a cell of this or another rank where @p is_meant. */
    template <typename IsMeant>
    std::vector<unsigned int> blocks_where(const NodeMap<2> &nodes,
                                           const IsMeant &is_meant)
    {
      std::vector<unsigned int> found(nodes.table().n_blocks(), 0);
      for (unsigned int c = 0; c < nodes.cells().size(); ++c)
        if (is_meant(c))
          found[nodes.blocks().block_of_cell(c)] = 1;
      MPI::max(found, nodes.communicator(), found);
      std::vector<unsigned int> result;
      for (unsigned int b = 0; b < found.size(); ++b)
        if (found[b])
          result.push_back(b);
      return result;
    }

    std::vector<unsigned int> candidates(const NodeMap<2> &nodes,
                                         const NamedBlock &block,
                                         const std::string &where)
    {
      if (block.has_point)
        return blocks_where(nodes, [&](const unsigned int c)
                            { return is_in_cell(nodes, c, block.point); });
      const auto groups = find_groups(nodes.table(), { block.group }, where);
      return blocks_where(nodes, [&](const unsigned int c)
                          { return groups[nodes.cells().group[c]]; });
    }
  } // namespace

  void NamedBlock::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter);
  }

  NamedBlock NamedBlock::read(const ParameterSection &section,
                              const std::string &name)
  {
    NamedBlock block = read_entries(section, enter);
    block.name       = name;
    return block;
  }

  void find_named_blocks(const NodeMap<2> &nodes,
                         std::vector<NamedBlock> &blocks)
  {
    for (NamedBlock &block : blocks)
    {
      const std::string where = "section 'Blocks/" + block.name + "': ";
      const auto found
          = candidates(nodes, block, where + "'Group = " + block.group + "'");
      if (found.size() != 1)
        throw InputError(
            where
            + (block.has_point
                   ? text_of("the point ", point_text(block.point), " m is ",
                             found.empty() ? "in no block"
                                           : "on the edge of several blocks",
                             ". Give one inside the block, in metres.")
                   : text_of("'Group = ", block.group, "' is a surface of ",
                             found.size(),
                             " blocks. Say by 'Point' which one is meant.")));
      block.number = found.front();
      for (const NamedBlock &other : blocks)
        if (&other != &block && other.number == block.number)
          throw InputError(where + "it is the block that is named '"
                           + other.name
                           + "' already. Name it once, or another block.");
    }
  }

  BlockInertia inertia_of_block(const Model<2> &model, const unsigned int block)
  {
    const NodeMap<2> &nodes = model.nodes();
    const auto owned        = owned_nodes(model, block);
    std::array<double, 4> sums{}; // mass, mass times x and y, moment
    const auto add_up = [&]()
    {
      MPI_Allreduce(MPI_IN_PLACE, sums.data(), sums.size(), MPI_DOUBLE, MPI_SUM,
                    nodes.communicator());
    };
    BlockInertia result;
    if (nodes.table().is_rigid[block])
    {
      if (!owned.empty())
      {
        const RigidBlocks::Block &rigid
            = model.rigid_blocks().block(rigid_number(model, block));
        sums = { rigid.mass, rigid.centre[0], rigid.centre[1], rigid.inertia };
      }
      add_up();
      result.centroid = dealii::Point<2>(sums[1], sums[2]);
    }
    else
    {
      for (const unsigned int i : owned)
      {
        sums[0] += model.mass()[i];
        sums[1] += model.mass()[i] * nodes.point(i)[0];
        sums[2] += model.mass()[i] * nodes.point(i)[1];
      }
      add_up();
      result.centroid = dealii::Point<2>(sums[1] / sums[0], sums[2] / sums[0]);
      const double mass = sums[0];
      sums              = {};
      for (const unsigned int i : owned)
        sums[3] += model.mass()[i]
                   * nodes.point(i).distance_square(result.centroid);
      add_up();
      sums[0] = mass;
    }
    result.mass   = sums[0];
    result.moment = sums[3];
    return result;
  }

  std::vector<std::string>
  named_block_lines(const Model<2> &model,
                    const std::vector<NamedBlock> &blocks)
  {
    std::vector<std::string> lines;
    for (const NamedBlock &block : blocks)
    {
      const BlockInertia inertia = inertia_of_block(model, block.number);
      std::string text           = text_of(
                    "block ", block.name, ": number ", block.number, ", ",
          model.nodes().table().is_rigid[block.number] ? "rigid" : "deformable",
                    ", ", inertia.mass, " kg, centroid at ", point_text(inertia.centroid),
                    " m");
      if (block.moves())
        text += text_of(", starts with ", point_text(block.velocity),
                        " m/s and ", block.spin / constants::degree, " deg/s");
      lines.push_back(text);
    }
    return lines;
  }
} // namespace quoin
