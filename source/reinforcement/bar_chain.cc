// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/reinforcement/bar_chain.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Stiffness added to that of a node, so that the matrix is regular where
        everything yields: it changes steps, not the solution [-]. */
    constexpr double regularisation     = 1e-9;
    constexpr unsigned int most_steps   = 100;
    constexpr double force_tolerance    = 1e-13; // of the sum of forces
    constexpr double line_search_target = 0.1;

    /** The equilibrium of a bar at given stretches of the rock. */
    class Balance
    {
    public:
      /** @p head_force: on the head in place of the plate, if not negative. */
      Balance(const BarLaw &law, const BarChain &chain,
              const std::vector<double> &stretch, const BarState &before,
              const double head_force = -1., const bool has_bond = true)
        : law(law), chain(chain), stretch(stretch), before(before),
          head_force(head_force), has_bond(has_bond), n(chain.n_nodes()),
          gradient(n), diagonal(n), elements(n - 1), bonds(n)
      {
      }

      /** Forces and stiffness at @p slip. */
      void evaluate(const std::vector<double> &slip)
      {
        size = 0.;
        for (std::size_t i = 0; i < n; ++i)
        {
          bonds[i]    = bond(i, slip[i]);
          gradient[i] = bonds[i].force;
          diagonal[i] = bonds[i].tangent;
          size += std::abs(bonds[i].force);
        }
        plate = plate_spring(slip[0]);
        gradient[0] += plate.force;
        diagonal[0] += plate.tangent;
        anchor = { 0., 0., before.anchor_plastic };
        if (law.anchor_stiffness > 0. && !before.lost[n - 1])
          anchor = spring_force(law.anchor_stiffness, slip[n - 1],
                                before.anchor_plastic, -law.anchor_strength,
                                law.anchor_strength);
        gradient[n - 1] += anchor.force;
        diagonal[n - 1] += anchor.tangent;
        size += std::abs(plate.force) + std::abs(anchor.force);
        for (std::size_t e = 0; e + 1 < n; ++e)
        {
          const double k  = law.stiffness / chain.length[e];
          const double at = stretch[e] + slip[e + 1] - slip[e];
          elements[e]     = before.broken[e]
                                ? SpringForce{ 0., 0., before.plastic[e] }
                                : spring_force(k, at, before.plastic[e], -law.yield,
                                               law.yield);
          gradient[e] -= elements[e].force;
          gradient[e + 1] += elements[e].force;
          diagonal[e] += elements[e].tangent;
          diagonal[e + 1] += elements[e].tangent;
          // The last term is what rounding leaves of differences.
          size += std::abs(elements[e].force)
                  + 1e-3 * k
                        * (std::abs(slip[e]) + std::abs(slip[e + 1])
                           + std::abs(stretch[e]));
        }
      }

      /** Finds the slip at which forces are in balance, if there is one. */
      void solve(std::vector<double> &slip)
      {
        std::vector<double> step;
        for (unsigned int count = 0; count < most_steps; ++count)
        {
          evaluate(slip);
          double residual = 0.;
          for (const double g : gradient)
            residual = std::max(residual, std::abs(g));
          if (residual <= force_tolerance * size)
            return;
          step = gradient;
          for (double &s : step)
            s = -s;
          factorise();
          back_substitute(step);
          if (!search(slip, step))
            break;
        }
        evaluate(slip);
      }

      /** Derivatives of the element forces by the stretches. */
      void tangent(std::vector<double> &result)
      {
        factorise();
        const std::size_t m = n - 1;
        result.assign(m * m, 0.);
        std::vector<double> column(n);
        for (std::size_t f = 0; f < m; ++f)
        {
          if (elements[f].tangent == 0.)
            continue;
          std::fill(column.begin(), column.end(), 0.);
          column[f]     = elements[f].tangent;
          column[f + 1] = -elements[f].tangent;
          back_substitute(column);
          for (std::size_t e = 0; e < m; ++e)
            result[e * m + f]
                = elements[e].tangent
                  * ((e == f ? 1. : 0.) + column[e + 1] - column[e]);
        }
      }

      const BarLaw &law;
      const BarChain &chain;
      const std::vector<double> &stretch;
      const BarState &before;
      const double head_force;
      const bool has_bond;
      const std::size_t n;
      std::vector<double> gradient, diagonal;
      std::vector<SpringForce> elements, bonds;
      SpringForce plate{}, anchor{};
      double size = 0.;

    private:
      SpringForce bond(const std::size_t i, const double slip) const
      {
        const double k = law.bond_stiffness * chain.bond[i];
        if (!has_bond || k == 0. || before.lost[i])
          return { 0., 0., before.bond_plastic[i] };
        double strength = law.bond_strength;
        if (strength != BarLaw::unlimited)
          strength = (strength + law.bond_friction * before.pressure[i])
                     * chain.bond[i];
        return spring_force(k, slip, before.bond_plastic[i], -strength,
                            strength);
      }

      SpringForce plate_spring(const double slip) const
      {
        if (head_force >= 0.)
          return { head_force, 0., 0. };
        if (law.plate_stiffness == 0. || before.lost[0])
          return { 0., 0., before.plate_plastic };
        SpringForce result
            = spring_force(law.plate_stiffness, slip + before.plate_offset,
                           before.plate_plastic, 0., law.plate_strength);
        // A plate that has lost contact keeps its shape.
        if (result.force == 0.)
          result.plastic = before.plate_plastic;
        return result;
      }

      /** Factors of the tridiagonal matrix. */
      void factorise()
      {
        double largest = 0.;
        for (const double d : diagonal)
          largest = std::max(largest, d);
        pivot = diagonal;
        lower.assign(n, 0.);
        for (std::size_t i = 0; i < n; ++i)
        {
          pivot[i] += regularisation * (largest > 0. ? largest : 1.);
          if (i == 0)
            continue;
          lower[i] = -elements[i - 1].tangent / pivot[i - 1];
          pivot[i] += lower[i] * elements[i - 1].tangent;
        }
      }

      void back_substitute(std::vector<double> &x) const
      {
        for (std::size_t i = 1; i < n; ++i)
          x[i] -= lower[i] * x[i - 1];
        for (std::size_t i = n; i-- > 0;)
          x[i] = x[i] / pivot[i] - (i + 1 < n ? lower[i + 1] * x[i + 1] : 0.);
      }

      /** Moves @p slip along @p step to where the energy no longer falls;
          returns whether it moved. */
      bool search(std::vector<double> &slip, const std::vector<double> &step)
      {
        const auto slope = [&]()
        {
          double sum = 0.;
          for (std::size_t i = 0; i < n; ++i)
            sum += gradient[i] * step[i];
          return sum;
        };
        const std::vector<double> start = slip;
        const double first              = slope();
        if (!(first < 0.))
          return false;
        double low = 0., high = 1., share = 1.;
        for (unsigned int count = 0; count < 60; ++count)
        {
          for (std::size_t i = 0; i < n; ++i)
            slip[i] = start[i] + share * step[i];
          evaluate(slip);
          const double now = slope();
          if (std::abs(now) <= line_search_target * std::abs(first)
              || (count == 0 && now < 0.))
            return true;
          (now > 0. ? high : low) = share;
          share                   = 0.5 * (low + high);
        }
        return true;
      }

      std::vector<double> pivot, lower;
    };

    double mean(const double a, const double b)
    {
      return 0.5 * (a + b);
    }

    /** Takes the solution over and returns what was dissipated on the way, by
        the trapezoidal rule. */
    BarDissipation take_over(const Balance &found,
                             const std::vector<double> &slip, BarState &state)
    {
      BarDissipation lost;
      for (std::size_t i = 0; i < found.n; ++i)
      {
        lost.friction += mean(state.bond_force[i], found.bonds[i].force)
                         * (found.bonds[i].plastic - state.bond_plastic[i]);
        state.bond_force[i]   = found.bonds[i].force;
        state.bond_plastic[i] = found.bonds[i].plastic;
        if (found.bonds[i].tangent == 0. && found.bonds[i].force != 0.)
          state.bond[i] = bond_state::slips;
        else if (state.bond[i] == bond_state::slips)
          state.bond[i] = bond_state::has_slipped;
      }
      lost.plastic += mean(state.plate_force, found.plate.force)
                      * (found.plate.plastic - state.plate_plastic);
      lost.friction += mean(state.anchor_force, found.anchor.force)
                       * (found.anchor.plastic - state.anchor_plastic);
      state.plate_force    = found.plate.force;
      state.plate_plastic  = found.plate.plastic;
      state.anchor_force   = found.anchor.force;
      state.anchor_plastic = found.anchor.plastic;
      for (std::size_t e = 0; e + 1 < found.n; ++e)
      {
        lost.plastic += mean(state.force[e], found.elements[e].force)
                        * (found.elements[e].plastic - state.plastic[e]);
        state.force[e]   = found.elements[e].force;
        state.plastic[e] = found.elements[e].plastic;
        if (state.force[e] > 0.
            && state.force[e] / found.law.stiffness
                       + state.plastic[e] / found.chain.length[e]
                   >= found.law.rupture_strain)
          state.broken[e] = 1;
      }
      state.slip    = slip;
      state.stretch = found.stretch;
      return lost;
    }

    /** Whether an element or node still bears what it can bear no more. */
    bool has_broken(const BarState &state)
    {
      for (std::size_t e = 0; e < state.force.size(); ++e)
        if (state.broken[e] && state.force[e] != 0.)
          return true;
      for (std::size_t i = 0; i < state.lost.size(); ++i)
        if (state.lost[i]
            && (state.bond_force[i] != 0. || (i == 0 && state.plate_force != 0.)
                || (i + 1 == state.lost.size() && state.anchor_force != 0.)))
          return true;
      return false;
    }
  } // namespace

  void BarState::resize(const BarChain &chain, const std::size_t n_dowels)
  {
    for (auto *of_nodes : { &slip, &bond_plastic, &bond_force, &pressure })
      of_nodes->resize(chain.n_nodes(), 0.);
    lost.resize(chain.n_nodes(), 0);
    bond.resize(chain.n_nodes(), bond_state::elastic);
    for (auto *of_elements : { &stretch, &plastic, &force })
      of_elements->resize(chain.n_elements(), 0.);
    broken.resize(chain.n_elements(), 0);
    start.resize(2 * chain.n_elements(), 0.);
    for (auto *of_dowels :
         { &dowel_start, &dowel_plastic, &dowel_force, &dowel_motion })
      of_dowels->resize(2 * n_dowels, 0.);
    dowel_broken.resize(n_dowels, 0);
  }

  BarDissipation update(const BarLaw &law, const BarChain &chain,
                        const std::vector<double> &stretch, BarState &state,
                        std::vector<double> *tangent, const bool is_static)
  {
    BarDissipation lost;
    if ((is_static && law.bond_friction > 0.) || has_broken(state))
    {
      // At the last stretch: what the bar stores less than before is lost, but
      // for what its bond dissipates.
      const double before = stored_energy(law, chain, state);
      const auto at = state.stretch, force = state.force;
      Balance balance(law, chain, at, state);
      auto slip = state.slip;
      balance.solve(slip);
      lost          = take_over(balance, slip, state);
      lost.fracture = before - stored_energy(law, chain, state) - lost.plastic
                      - lost.friction;
      for (std::size_t e = 0; !is_static && e < force.size(); ++e)
        if (!state.lost[e] && !state.lost[e + 1])
          lost.fracture
              += 0.5 * (force[e] - state.force[e]) * (stretch[e] - at[e]);
    }
    Balance balance(law, chain, stretch, state);
    auto slip = state.slip;
    balance.solve(slip);
    if (tangent)
      balance.tangent(*tangent);
    const BarDissipation more = take_over(balance, slip, state);
    lost.plastic += more.plastic;
    lost.friction += more.friction;
    return lost;
  }

  bool pretension(const BarLaw &law, const BarChain &chain, const double force,
                  BarState &state)
  {
    if (force == 0.)
      return true;
    const bool has_anchor = law.anchor_stiffness > 0.;
    auto slip             = state.slip;
    const auto at         = state.stretch;
    Balance balance(law, chain, at, state, force, !has_anchor);
    balance.solve(slip);
    double unbalanced = 0.;
    for (const double g : balance.gradient)
      unbalanced = std::max(unbalanced, std::abs(g));
    if (unbalanced > 1e-6 * force)
      return false;
    take_over(balance, slip, state);
    state.plate_plastic = 0.;
    state.plate_offset  = force / law.plate_stiffness - slip[0];
    if (has_anchor)
      state.bond_plastic = slip;
    return true;
  }

  double stored_energy(const BarLaw &law, const BarChain &chain,
                       const BarState &state)
  {
    double twice   = 0.;
    const auto add = [&](const double force, const double stiffness)
    {
      if (force != 0.)
        twice += force * force / stiffness;
    };
    for (std::size_t i = 0; i < chain.n_nodes(); ++i)
      add(state.bond_force[i], law.bond_stiffness * chain.bond[i]);
    add(state.plate_force, law.plate_stiffness);
    add(state.anchor_force, law.anchor_stiffness);
    for (std::size_t e = 0; e < chain.n_elements(); ++e)
      add(state.force[e], law.stiffness / chain.length[e]);
    for (std::size_t d = 0; d < state.dowel_force.size(); ++d)
      add(state.dowel_force[d],
          d % 2 == 0 ? law.dowel_axial_stiffness : law.dowel_stiffness);
    return 0.5 * twice;
  }
} // namespace quoin
