// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_rest_time_h
#define quoin_implicit_rest_time_h

#include <quoin/loading/stage_loads.h>
#include <quoin/stages/stage_parameters.h>

namespace quoin
{
  /** Load time from which on the loads of @p stage, which begins at
      @p stage_start, are constant [s]. Throws an InputError if they never are.
   */
  template <int dim>
  double rest_time(const StageLoads<dim> &acting, const StageParameters &stage,
                   double stage_start);
} // namespace quoin

#endif
