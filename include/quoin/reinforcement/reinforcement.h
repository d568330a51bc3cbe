// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_reinforcement_reinforcement_h
#define quoin_reinforcement_reinforcement_h

#include <quoin/base/thickness.h>
#include <quoin/blocks/block_forces.h>
#include <quoin/mesh/node_map.h>
#include <quoin/operators/force_operator.h>
#include <quoin/reinforcement/bar_placement.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /** Internal variables of all bars, the same on all ranks. */
  struct ReinforcementState
  {
    static constexpr const char *slice_name = "reinforcement";

    std::vector<BarState> bars;

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.each(bars);
    }
  };

  /**
   * Bolts and cables: bars without mass in the blocks of a plane model. Their
   * nodes are points of cells, with constant weights on the cell's nodes; the
   * bar moves along itself relative to them (BarLaw), in equilibrium at any
   * motion of the rock, and an element pulls its two points towards each other
   * along their present line. Dowels resist the relative motion of the two
   * sides of a joint that a bar crosses.
   *
   * All ranks have the nodes of these cells (NodeMap::crossed_cells()) and
   * compute all bars; each adds the forces on its own nodes. The first rank
   * adds derivatives and energies.
   */
  class Reinforcement : public ForceOperator<2>
  {
  public:
    /** Keeps references. Throws an InputError about bars that do not lie in
        blocks. */
    void prepare(const NodeMap<2> &nodes,
                 const std::vector<CableParameters> &cables,
                 const Thickness &thickness, const BlockForces<2> &blocks);

    bool empty() const
    {
      return bars.empty();
    }

    const char *kind() const override
    {
      return "reinforcement";
    }
    void prepare(State<2> &state) const override;

    /** Updates bars for the positions at the end of a stage, before blocks are
        excavated; returns the power of their forces on this rank's nodes [W],
        for begin_stage(). */
    double end_stage(State<2> &state) const;

    /**
     * Installs the bars of the stage @p name at the positions of @p state, in
     * the @p first one also those that name none, and takes bars out of blocks
     * that are absent. The energy of pretension is external work. @p power: of
     * end_stage(). Adds to @p released, unless it is null, the forces that bars
     * in such blocks no longer exert on nodes of this rank in others [N], those
     * of @p before: the nodes before blocks were taken away, which moves them;
     * null: those of @p state. Collective.
     */
    void begin_stage(const std::string &name, bool first, double power,
                     State<2> &state, dealii::Tensor<1, 2> *released = nullptr,
                     const NodeRecord<2> *before = nullptr) const;

    void add_forces(const StepContext &step, State<2> &state,
                    const NodeForces<2> &forces) override;
    void linearise(State<2> &state, bool with_stiffness,
                   const TakeElement<2> &take) const override;
    void add_stiffness_bound(
        const State<2> &state, const NodeRatio &ratio,
        std::vector<NodeStiffness<2>> &stiffness) const override;
    void add_stored_energy(const State<2> &state,
                           EnergyAccounts &energies) const override;

    const std::vector<CableParameters> &sections() const
    {
      return cables;
    }
    const std::vector<PlacedBar> &all() const
    {
      return bars;
    }

  private:
    /** Forces of a bar on PlacedBar::nodes [N], and their derivatives. */
    struct Work
    {
      std::vector<double> stretch, tangent, force, stiffness;
      std::vector<dealii::Tensor<1, 2>> axis; /**< of elements, present */
      std::vector<double> span;               /**< present length [m] */
    };

    /** Updates a bar and finds its forces in work; @p is_static: from the
        equilibrium at the last positions with the pressure of now. */
    BarDissipation update_bar(const PlacedBar &bar, const NodeRecord<2> *nodes,
                              BarState &state, bool is_static,
                              bool with_stiffness) const;
    /** Adds @p factor times the forces of a bar, with @p nodes, on those of
       this rank in blocks that are there. */
    void add_forces_on_present(const PlacedBar &bar, BarState now,
                               const NodeRecord<2> *nodes,
                               const State<2> &state, double factor,
                               dealii::Tensor<1, 2> *force) const;
    void add_dowels(const PlacedBar &bar, const NodeRecord<2> *nodes,
                    BarState &state, bool with_stiffness,
                    BarDissipation &lost) const;
    /** Adds a spring @p k along @p axis between two points to the stiffness. */
    void add_spring(const PlacedBar &bar, const BarHost &near,
                    const BarHost &far, const dealii::Tensor<1, 2> &axis,
                    double k) const;
    void add_pair_force(const BarHost &near, const BarHost &far,
                        const dealii::Tensor<1, 2> &force) const;
    /** Updates the pressure on the bond of all bars. Collective. */
    void update_pressure(State<2> &state) const;
    void book(const BarDissipation &lost, State<2> &state) const;
    /** Power of the forces of bars on this rank's nodes [W]. */
    double power(const State<2> &state) const;

    const NodeMap<2> *node_map  = nullptr;
    const BlockForces<2> *cells = nullptr;
    std::vector<CableParameters> cables;
    std::vector<PlacedBar> bars;
    bool has_friction = false;
    bool is_first     = true; /**< rank */
    mutable Work work;
  };
} // namespace quoin

#endif
