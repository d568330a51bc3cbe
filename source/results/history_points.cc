// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/model/block_placement.h>
#include <quoin/results/history_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace quoin
{
  namespace
  {
    /**
     * The nearest node, cell or joint point of this rank. Among equal distances
     * one of a block that is present in the end, then of one that contains the
     * point, then that of the smallest absence, then the lower, then the left
     * one is chosen, as numbers depend on the number of ranks.
     */
    template <int dim>
    struct Nearest
    {
      /** Which blocks come first, then the last coordinate first. */
      using Rest = std::array<double, dim + 1>;
      /** Squared distance [m^2] and Rest. */
      using Key                    = std::array<double, dim + 2>;
      static constexpr double none = std::numeric_limits<double>::max();

      static Rest place(const double order, const dealii::Point<dim> &p)
      {
        Rest rest;
        rest[0] = order;
        std::reverse_copy(p.begin_raw(), p.end_raw(), rest.begin() + 1);
        return rest;
      }

      explicit Nearest(const dealii::Point<dim> &point) : point(point)
      {
        key.fill(none);
      }

      dealii::Point<dim> point;
      unsigned int entity = 0; /**< node, cell or joint point */
      Key key;

      /** @p finer: the key but for the distance. */
      template <typename Finer>
      void consider(const dealii::Point<dim> &p, const unsigned int candidate,
                    const Finer &finer, const double farther = 0.)
      {
        const double distance = p.distance_square(point) + farther;
        if (distance > key[0])
          return;
        const Rest rest = finer();
        Key other;
        other[0] = distance;
        std::copy(rest.begin(), rest.end(), other.begin() + 1);
        if (other < key)
        {
          key    = other;
          entity = candidate;
        }
      }
    };

    /** Twice the area or six times the volume. */
    template <int dim>
    double size(const std::array<dealii::Point<dim>, dim + 1> &corners)
    {
      dealii::Tensor<2, dim> edges;
      for (unsigned int k = 0; k < dim; ++k)
        edges[k] = corners[k + 1] - corners[0];
      return determinant(edges);
    }

    template <int dim>
    std::array<dealii::Point<dim>, dim + 1> corners(const NodeMap<dim> &nodes,
                                                    const unsigned int cell)
    {
      std::array<dealii::Point<dim>, dim + 1> result;
      for (unsigned int k = 0; k <= dim; ++k)
        result[k] = nodes.point(nodes.cells().nodes[cell][k]);
      return result;
    }

    /**
     * Weights of the corners of @p cell at @p point: its volume with the point
     * in place of the corner, by its own.
     */
    template <int dim>
    std::array<double, dim + 1> weights(const NodeMap<dim> &nodes,
                                        const unsigned int cell,
                                        const dealii::Point<dim> &point)
    {
      std::array<double, dim + 1> result;
      const auto own = corners(nodes, cell);
      for (unsigned int k = 0; k <= dim; ++k)
      {
        auto with_point = own;
        with_point[k]   = point;
        result[k]       = size<dim>(with_point) / size<dim>(own);
      }
      return result;
    }

    /** By how much @p point lies outside of @p cell, in weights of corners [-]:
        0 in it or within rounding on its boundary, infinity beyond @p most. */
    template <int dim>
    double outside(const NodeMap<dim> &nodes, const unsigned int cell,
                   const dealii::Point<dim> &point, const double most = 0.)
    {
      // By the box first, beyond which most cells are.
      const auto own  = corners(nodes, cell);
      double rounding = 0., smallest = std::numeric_limits<double>::max();
      for (unsigned int d = 0; d < dim; ++d)
      {
        double low = own[0][d], high = low;
        for (const auto &corner : own)
        {
          low  = std::min(low, corner[d]);
          high = std::max(high, corner[d]);
        }
        const double error = 1e-9 * (high - low)
                             + 16. * std::numeric_limits<double>::epsilon()
                                   * std::max(std::abs(low), std::abs(high));
        const double margin = error + dim * most * (high - low);
        if (point[d] < low - margin || point[d] > high + margin)
          return std::numeric_limits<double>::infinity();
        rounding = std::max(rounding, error);
        smallest = std::min(smallest, high - low);
      }
      const auto part    = weights(nodes, cell, point);
      const double least = *std::min_element(part.begin(), part.end());
      return least >= -rounding / smallest ? 0.
             : least >= -most              ? -least
                              : std::numeric_limits<double>::infinity();
    }

    /** What of the nodes at the least distance says which comes first: of their
        block, which may lie on several ranks, with its @p absence, a share
        below 1 or 2 more. Collective. */
    template <int dim>
    typename Nearest<dim>::Rest
    place_of_block(const Model<dim> &model, const unsigned int block,
                   const dealii::Point<dim> &point, const double absence)
    {
      const NodeMap<dim> &nodes = model.nodes();
      const unsigned int part   = nodes.blocks().find(block);
      unsigned int inside       = 0;
      if (part < nodes.blocks().parts.size())
      {
        const auto &[begin, end] = nodes.blocks().parts[part].cells;
        for (unsigned int c = begin; c < end; ++c)
          if (outside(nodes, c, point) == 0.)
            inside = 1;
      }
      // Sum of positions, and how many there are.
      std::vector<double> sums(dim + 1, 0.);
      for (const unsigned int node : owned_nodes(model, block))
      {
        for (unsigned int d = 0; d < dim; ++d)
          sums[d] += nodes.point(node)[d];
        ++sums[dim];
      }
      namespace MPI = dealii::Utilities::MPI;
      MPI::sum(sums, nodes.communicator(), sums);
      dealii::Point<dim> centre;
      for (unsigned int d = 0; d < dim; ++d)
        centre[d] = sums[d] / sums[dim];
      return Nearest<dim>::place(
          absence + (MPI::max(inside, nodes.communicator()) > 0 ? 0. : 1.),
          centre);
    }

    /** Collective. */
    template <int dim>
    void consider_nodes(const Model<dim> &model,
                        const std::vector<double> &absence,
                        Nearest<dim> &nearest)
    {
      const NodeMap<dim> &nodes = model.nodes();
      // Alike to the last bit of all nodes at one position.
      const auto distance = [&](const unsigned int node)
      { return nodes.point(node).distance_square(nearest.point); };
      double least = Nearest<dim>::none;
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
        least = std::min(least, distance(i));
      namespace MPI = dealii::Utilities::MPI;
      least         = MPI::min(least, nodes.communicator());
      // The blocks that have a node there, on all ranks.
      std::vector<unsigned int> has_one(nodes.table().n_blocks(), 0);
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
        if (distance(i) == least)
          has_one[nodes.block_of_node(i)] = 1;
      MPI::max(has_one, nodes.communicator(), has_one);
      std::map<unsigned int, typename Nearest<dim>::Rest> places;
      for (unsigned int b = 0; b < has_one.size(); ++b)
        if (has_one[b])
          places[b] = place_of_block(model, b, nearest.point,
                                     absence[nodes.table().group[b]]);
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
        if (distance(i) == least)
          nearest.consider(nodes.point(i), i,
                           [&] { return places.at(nodes.block_of_node(i)); });
    }

    template <int dim>
    double absence_of_cell(const NodeMap<dim> &nodes,
                           const std::vector<double> &absence,
                           const unsigned int cell)
    {
      return absence[nodes.table().group[nodes.blocks().block_of_cell(cell)]];
    }

    /** The least absence of the blocks in or on which @p point lies; the
        largest number: it lies in none. Collective. */
    template <int dim>
    double least_absence(const NodeMap<dim> &nodes,
                         const std::vector<double> &absence,
                         const dealii::Point<dim> &point)
    {
      double least = std::numeric_limits<double>::max();
      for (unsigned int c = 0; c < nodes.cells().size() && least > 0.; ++c)
        if (const double own = absence_of_cell(nodes, absence, c);
            own < least && outside(nodes, c, point) == 0.)
          least = own;
      return dealii::Utilities::MPI::min(least, nodes.communicator());
    }

    /** The larger absence of the two blocks at joint @p face. */
    template <int dim>
    double absence_of_joint(const NodeMap<dim> &nodes,
                            const std::vector<double> &absence,
                            const JointNodes<dim> &face)
    {
      const auto &group = nodes.table().group;
      return std::max(absence[group[face.blocks[0]]],
                      absence[group[face.blocks[1]]]);
    }

    /** Whether @p key is the least of all ranks, on the first rank that has it:
        several may have the same joint. Collective. */
    template <typename Key>
    bool is_least(const Key &key, const MPI_Comm communicator)
    {
      namespace MPI = dealii::Utilities::MPI;
      bool here     = true;
      for (const double part : key)
      {
        const double least = MPI::min(
            here ? part : std::numeric_limits<double>::max(), communicator);
        here = here && part == least;
      }
      const unsigned int rank = MPI::this_mpi_process(communicator);
      return rank == MPI::min(here ? rank : 1U << 30, communicator);
    }

    /**
     * Sets the nodes of @p at: the corners of the cell that contains the point
     * in the block of the nearest node, that of @p node, or there nearly does,
     * as walls of excavations are curved and coordinates rounded; else of one
     * in another block, those of the smallest absence first; or the nearest
     * node. Collective.
     */
    template <int dim>
    void find_host(const Model<dim> &model, const std::vector<double> &absence,
                   const Nearest<dim> &node, HistoryPoint &at)
    {
      /** Distance that is rounding, by the size of coordinates [-]. */
      constexpr double rounding = 1e-12;
      /** By how much a point may lie outside of a cell whose motion it has [-].
       */
      constexpr double most_outside = 0.1;
      namespace MPI                 = dealii::Utilities::MPI;
      const NodeMap<dim> &nodes     = model.nodes();
      const MPI_Comm communicator   = nodes.communicator();
      const double distance    = std::sqrt(MPI::min(node.key[0], communicator));
      const bool is_at_node    = distance <= rounding * node.point.norm();
      const unsigned int block = MPI::max(
          at.here ? nodes.block_of_node(node.entity) : 0U, communicator);
      // Not in what is absent longer, on its border, where its node may be
      // nearest.
      const double least = least_absence(nodes, absence, node.point);
      Nearest<dim> host(node.point);
      for (unsigned int c = 0; c < nodes.cells().size() && !is_at_node; ++c)
      {
        const unsigned int own = nodes.blocks().block_of_cell(c);
        const double missing   = absence_of_cell(nodes, absence, c);
        if (missing > least)
          continue;
        const double beyond
            = outside(nodes, c, node.point, own == block ? most_outside : 0.);
        if (std::isinf(beyond))
          continue;
        dealii::Point<dim> centroid;
        for (const auto &corner : corners(nodes, c))
          centroid += corner / (dim + 1.);
        // In place of a distance.
        host.consider(
            node.point, c, [&] { return Nearest<dim>::place(0., centroid); },
            own == block ? beyond : 1. + missing);
      }
      if (MPI::min(host.key[0], communicator) == Nearest<dim>::none)
      {
        at.is_inside = is_at_node;
        if (at.here)
          at.nodes = { { node.entity, 1. } };
        return;
      }
      // Corners of the cell and their weights, for the ranks that own them.
      std::vector<double> all(2 * (dim + 1), 0.);
      if (is_least(host.key, communicator))
      {
        const auto &own = nodes.cells().nodes[host.entity];
        const auto part = weights(nodes, host.entity, node.point);
        for (unsigned int k = 0; k <= dim; ++k)
        {
          all[2 * k]     = nodes.exchange().global(own[k]);
          all[2 * k + 1] = part[k];
        }
      }
      MPI::sum(all, communicator, all);
      for (unsigned int k = 0; k <= dim; ++k)
        if (const auto global = static_cast<unsigned int>(all[2 * k]);
            nodes.exchange().owns(global))
          at.nodes.push_back(
              { nodes.exchange().local(global), all[2 * k + 1] });
    }

    /** Considers cells by their centroids; in or at the border of blocks those
        with the smallest absence of these alone. Collective. */
    template <int dim>
    void consider_cells(const Model<dim> &model,
                        const std::vector<double> &absence,
                        Nearest<dim> &nearest)
    {
      const NodeMap<dim> &nodes  = model.nodes();
      const double least         = least_absence(nodes, absence, nearest.point);
      const bool lies_in_a_block = least < std::numeric_limits<double>::max();
      for (unsigned int c = 0; c < nodes.cells().size(); ++c)
      {
        // A place in a lining is not in the rock, whose cells may be nearer.
        if (lies_in_a_block && absence_of_cell(nodes, absence, c) != least)
          continue;
        dealii::Point<dim> centroid;
        for (const auto &corner : corners(nodes, c))
          centroid += corner / (dim + 1.);
        nearest.consider(centroid, c,
                         [&] { return Nearest<dim>::place(0., centroid); });
      }
    }

    /** Considers joint points on surface @p name; on all if it is empty. At a
        node of several joints that of the smallest absence comes first. */
    void consider_joint_points(const Model<3> &model,
                               const std::vector<double> &absence,
                               const std::string &name, Nearest<3> &nearest)
    {
      const NodeMap<3> &nodes = model.nodes();
      const auto &faces       = model.joints().faces();
      for (unsigned int i = 0; i < faces.size(); ++i)
      {
        const JointNodes<3> &face = nodes.faces().joints[faces[i].face];
        if (!name.empty() && nodes.table().joint_name(face.name) != name)
          continue;
        dealii::Point<3> centroid;
        for (const unsigned int node : face.lower)
          centroid += nodes.point(node) / 3.;
        const double order = absence_of_joint(nodes, absence, face);
        for (unsigned int k = 0; k < 3; ++k)
          nearest.consider(nodes.point(face.lower[k]), 3 * i + k,
                           [&] { return Nearest<3>::place(order, centroid); });
      }
    }

    /** Considers joint points on @p curve; on all curves if it is empty. At a
        node of several joints that of the smallest absence comes first, of the
        two ranks of a joint that of its lower face, which knows what lies on
        it. */
    void consider_joint_points(const Model<2> &model,
                               const std::vector<double> &absence,
                               const std::string &curve, Nearest<2> &nearest)
    {
      const NodeMap<2> &nodes = model.nodes();
      for (unsigned int i = 0; i < model.joints().segments().size(); ++i)
      {
        const auto &face
            = nodes.faces().joints[model.joints().segments()[i].face];
        if (!curve.empty() && nodes.table().joint_name(face.name) != curve)
          continue;
        const double order = absence_of_joint(nodes, absence, face)
                             + (face.is_own[0] ? 0. : 1.);
        for (unsigned int k = 0; k < 2; ++k)
        {
          const auto &here  = nodes.point(face.lower[k]);
          const auto &other = nodes.point(face.lower[1 - k]);
          nearest.consider(here, 2 * i + k,
                           [&] {
                             return Nearest<2>::place(
                                 order, dealii::Point<2>(0.5 * (here + other)));
                           });
        }
      }
    }

    /** Whether the nearest point, of those with the @p key of each rank, is on
        this rank, for a history @p wanted. */
    template <int dim>
    bool is_owner(const NodeMap<dim> &nodes, const HistoryParameters &wanted,
                  const typename Nearest<dim>::Key &key)
    {
      const MPI_Comm communicator = nodes.communicator();
      const std::string section   = "section 'Histories/" + wanted.name + "': ";
      const double nearest = dealii::Utilities::MPI::min(key[0], communicator);
      double longest       = 0.;
      for (const auto &cell : nodes.cells().nodes)
        for (unsigned int k = 0; k <= dim; ++k)
          for (unsigned int l = 0; l < k; ++l)
            longest = std::max(longest, nodes.point(cell[k]).distance_square(
                                            nodes.point(cell[l])));
      longest = dealii::Utilities::MPI::max(longest, communicator);
      if (nearest > 4. * longest
          && nearest != std::numeric_limits<double>::max())
      {
        std::ostringstream message;
        message << section << "'Point = ";
        for (unsigned int d = 0; d < dim; ++d)
          message << (d == 0 ? "" : ", ") << wanted.point[d];
        message
            << "' is " << std::sqrt(nearest)
            << " m from the nearest node, cell or joint of the model, more "
               "than two of its longest edges. Give a point of the model in "
               "metres.";
        throw InputError(message.str());
      }
      if (nearest == std::numeric_limits<double>::max())
        throw InputError(section + "there is no "
                         + (wanted.curve.empty()
                                ? std::string("such point")
                                : "joint on a curve '" + wanted.curve + "'")
                         + " in the model. Correct 'Curve' or 'Quantity'.");
      return is_least(key, communicator);
    }
  } // namespace

  template <int dim>
  HistoryPoint find_history_point(const Model<dim> &model,
                                  const HistoryParameters &wanted,
                                  const std::vector<double> &absence)
  {
    dealii::Point<dim> point;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] = wanted.point[d];
    Nearest<dim> nearest(point);
    switch (wanted.quantity)
    {
    case HistoryQuantity::displacement:
    case HistoryQuantity::velocity:
      consider_nodes(model, absence, nearest);
      break;
    case HistoryQuantity::joint:
      consider_joint_points(model, absence, wanted.curve, nearest);
      break;
    default:
      consider_cells(model, absence, nearest);
    }
    HistoryPoint result
        = { nearest.entity, is_owner(model.nodes(), wanted, nearest.key) };
    if (wanted.quantity == HistoryQuantity::displacement
        || wanted.quantity == HistoryQuantity::velocity)
      find_host(model, absence, nearest, result);
    return result;
  }

  template HistoryPoint find_history_point(const Model<2> &,
                                           const HistoryParameters &,
                                           const std::vector<double> &);
  template HistoryPoint find_history_point(const Model<3> &,
                                           const HistoryParameters &,
                                           const std::vector<double> &);
} // namespace quoin
