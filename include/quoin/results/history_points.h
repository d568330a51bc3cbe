// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_history_points_h
#define quoin_results_history_points_h

#include <quoin/model/model.h>
#include <quoin/results/history_parameters.h>

#include <utility>
#include <vector>

namespace quoin
{
  /** Where a history of a point is recorded. */
  struct HistoryPoint
  {
    /** Local cell or joint point, of a rank that records it. */
    unsigned int entity = 0;
    bool here           = false; /**< whether this rank records it */
    /** The nodes from which displacement or velocity is interpolated, those
       that this rank owns, and their weights [-]. */
    std::vector<std::pair<unsigned int, double>> nodes = {};
    /** Whether it lies in a block; outside the value is that of the nearest
        node. */
    bool is_inside = true;
  };

  /**
   * The joint point or the cell of all ranks that is nearest to the point of
   * @p wanted, a history of one of these. Displacements and velocities are
   * interpolated in the cell that contains the point, linearly, which is exact
   * in rigid blocks, or nearly does; else they are those of the nearest node.
   * @p absence: of each physical surface, Construction::absence(). Where two
   * meet, nodes, cells and joints of that with the smaller one are taken: on
   * the wall of an excavation, lined later or not, those of the rock.
   * Throws an InputError if the point is far from the model or there is no such
   * joint. Collective.
   */
  template <int dim>
  HistoryPoint find_history_point(const Model<dim> &model,
                                  const HistoryParameters &wanted,
                                  const std::vector<double> &absence);
} // namespace quoin

#endif
