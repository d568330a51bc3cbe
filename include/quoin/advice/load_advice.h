// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_advice_load_advice_h
#define quoin_advice_load_advice_h

#include <quoin/advice/advice.h>

namespace quoin
{
  /** Warns of loads that a search for the factor of safety forgets. */
  void check_forgotten_loads(const Parameters &parameters, Advice &advice);

  /** Warns of initial stress that cannot be in equilibrium with gravity and
      with blocks that have none. Collective. */
  template <int dim>
  void check_stress_at_rest(const Parameters &parameters,
                            const Model<dim> &model, const State<dim> &state,
                            Advice &advice);

  /**
   * Warns of yielding ground below water in stage @p index, a search for the
   * factor of safety, that came to rest at the factor @p stable after it had
   * moved by @p displacement [m], so far that the pressure of water that is
   * given as an expression, and stays as it is in the mesh, holds it.
   * Collective.
   */
  template <int dim>
  void check_moved_water(const Parameters &parameters, unsigned int index,
                         double stable, double displacement,
                         const NodeMap<dim> &nodes, Advice &advice);

  /** Warns of pressures in joints that are negative and of water far above the
      model. Collective. */
  template <int dim>
  void check_pressures(const Parameters &parameters, const NodeMap<dim> &nodes,
                       Advice &advice);
} // namespace quoin

#endif
