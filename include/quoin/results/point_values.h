// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_point_values_h
#define quoin_results_point_values_h

#include <quoin/results/history_points.h>

#include <vector>

namespace quoin
{
  /** The blocks at @p point, where the history @p wanted is recorded; none on
      other ranks. */
  template <int dim>
  std::vector<unsigned int> blocks_at(const Model<dim> &model,
                                      const HistoryParameters &wanted,
                                      const HistoryPoint &point);

  /** Value of @p wanted at @p point, on its rank: zero in blocks that are
     absent, NaN in deleted ones. */
  template <int dim>
  double point_value(const Model<dim> &model, const HistoryParameters &wanted,
                     const HistoryPoint &point, const State<dim> &state);
} // namespace quoin

#endif
