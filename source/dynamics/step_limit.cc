// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/model/model_stability.h>
#include <quoin/base/number_text.h>
#include <quoin/base/point_text.h>
#include <quoin/dynamics/step_limit.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

namespace quoin
{
  namespace
  {
    /** The value below the @p k largest of all ranks' @p sorted, positive and
        largest first, to a relative error of 1e-6. Collective. */
    double below_largest(const std::vector<double> &sorted,
                         const std::uint64_t k, const double largest,
                         const MPI_Comm communicator)
    {
      const auto n_above = [&](const double value)
      {
        return dealii::Utilities::MPI::sum(
            std::uint64_t(std::lower_bound(sorted.begin(), sorted.end(), value,
                                           std::greater<>())
                          - sorted.begin()),
            communicator);
      };
      double low = largest;
      while (low > 1e-30 * largest && n_above(low) <= k)
        low *= 0.25;
      double high = std::min(largest, 4. * low);
      while (high > (1. + 1e-6) * low)
      {
        const double middle                 = std::sqrt(low * high);
        (n_above(middle) <= k ? high : low) = middle;
      }
      return high;
    }
  } // namespace

  template <int dim>
  std::string StepLimit<dim>::text() const
  {
    std::string parts;
    if (is_rigid || cells_share < 0.01)
      parts = "joints or contacts";
    else if (cells_share > 0.99)
      parts = "cells";
    else
      parts = text_of("cells (", std::round(100. * cells_share),
                      " % of the stiffness there) and joints or contacts");
    return text_of("the critical step without damping and mass scaling, ",
                   critical, " s, is that of ", parts, " at ",
                   point_text(where), " of block ", block,
                   "; without the stiffest 0.1 % of the ",
                   is_rigid ? "blocks" : "nodes", " it would be ", longer[0],
                   " times as long, without 1 % ", longer[1], ", without 10 % ",
                   longer[2]);
  }

  template <int dim>
  StepLimit<dim> find_step_limit(const Model<dim> &model,
                                 const State<dim> &state)
  {
    const NodeMap<dim> &nodes       = model.nodes();
    const MPI_Comm communicator     = nodes.communicator();
    const StableTimeStep<dim> whole = stability_at(model, state),
                              cells = stability_at(model, state, false);

    std::vector<double> own; // omega^2 of nodes, then of rigid blocks
    for (unsigned int i = 0; i < nodes.n_deformable_nodes(); ++i)
      own.push_back(whole.squared_frequency(i, model.mass()[i]));
    own.insert(own.end(), whole.rigid_blocks().begin(),
               whole.rigid_blocks().end());

    StepLimit<dim> limit;
    const auto stiffest  = std::max_element(own.begin(), own.end());
    const double largest = dealii::Utilities::MPI::max(
        stiffest == own.end() ? 0. : *stiffest, communicator);
    if (largest == 0.)
      return limit;
    limit.critical = StableTimeStep<dim>::critical(largest, 0.);

    // The lowest rank that has it says where.
    const unsigned int rank
        = dealii::Utilities::MPI::this_mpi_process(communicator);
    const bool is_here = stiffest != own.end() && *stiffest == largest;
    const unsigned int teller
        = dealii::Utilities::MPI::min(is_here ? rank : -1U, communicator);
    std::array<double, 6> told{};
    if (rank == teller)
    {
      const unsigned int i = stiffest - own.begin();
      if (i >= nodes.n_deformable_nodes())
      {
        const RigidBlocks::Block &block
            = model.rigid_blocks().block(i - nodes.n_deformable_nodes());
        told = { block.centre[0],
                 block.centre[1],
                 0.,
                 double(nodes.block_of_node(block.begin)),
                 1.,
                 0. };
      }
      else
      {
        for (unsigned int d = 0; d < dim; ++d)
          told[d] = nodes.point(i)[d];
        told[3] = nodes.block_of_node(i);
        told[5] = cells.squared_frequency(i, model.mass()[i]) / largest;
      }
    }
    told = dealii::Utilities::MPI::broadcast(communicator, told, teller);
    for (unsigned int d = 0; d < dim; ++d)
      limit.where[d] = told[d];
    limit.block       = told[3];
    limit.is_rigid    = told[4] == 1.;
    limit.cells_share = told[5];

    std::sort(own.begin(), own.end(), std::greater<>());
    const auto n
        = dealii::Utilities::MPI::sum(std::uint64_t(own.size()), communicator);
    for (unsigned int k = 0; k < limit.shares.size(); ++k)
      limit.longer[k] = std::sqrt(
          largest
          / below_largest(
              own,
              std::min<std::uint64_t>(std::ceil(limit.shares[k] * n), n - 1),
              largest, communicator));
    return limit;
  }

  template struct StepLimit<2>;
  template struct StepLimit<3>;
  template StepLimit<2> find_step_limit(const Model<2> &, const State<2> &);
  template StepLimit<3> find_step_limit(const Model<3> &, const State<3> &);
} // namespace quoin
