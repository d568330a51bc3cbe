// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_implicit_solver_h
#define quoin_implicit_implicit_solver_h

#include <quoin/implicit/implicit_state.h>
#include <quoin/dynamics/solver.h>
#include <quoin/implicit/dof_map.h>
#include <quoin/implicit/equilibrium.h>
#include <quoin/implicit/implicit_parameters.h>
#include <quoin/implicit/implicit_record.h>
#include <quoin/implicit/implicit_steps.h>
#include <quoin/implicit/newton_solver.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /**
   * Static equilibrium: the same blocks, joints and loads without inertia,
   * stage by stage and step by step, each by a NewtonSolver.
   *
   * At the start of a stage the unbalanced forces, of loads that begin or end
   * or of removed supports, are released step by step at constant time; then
   * the load time runs to the end of the stage. Steps are cut if iterations do
   * not converge and grow if they do. If load steps meet a snap-back, the load
   * time becomes an unknown, and steps are controlled by the mean inelastic
   * opening and slip of joints, which grows on any path (@cite Lourenco1996; as
   * the dissipation of @cite VerhooselRemmersGutierrez2009). Or the model
   * jumps, as a test does: at constant loads it moves against a drag,
   * implicitly in a pseudo-time (pseudo-transient continuation,
   * @cite KelleyKeyes1998), until it is in equilibrium without drag.
   */
  template <int dim>
  class ImplicitSolver : public Solver<dim>
  {
  public:
    /**
     * Keeps a reference to @p model. @p joint_sets: their names, for 'Path
     * joints'; @p far_field: of the load of type 'boundary elements', or null,
     * in all stages. Throws an InputError about loads that need inertia.
     */
    ImplicitSolver(Model<dim> &model, const std::vector<LoadParameters> &loads,
                   const ImplicitParameters &parameters,
                   const std::vector<std::string> &joint_sets,
                   std::unique_ptr<StaticFarField> far_field = nullptr);

    void prepare(State<dim> &state) const override;
    void discard_saved(State<dim> &state) const override
    {
      state.template get<ImplicitState>().before_jump.clear();
    }

    /** Begins a stage as ExplicitSolver::begin_stage(). */
    void begin_stage(const StageParameters &stage,
                     const StageParameters *previous, State<dim> &state);
    /** Resumes a stage with a state completed by save(). */
    void resume_stage(const StageParameters &stage,
                      const StageParameters *previous, State<dim> &state);

    const ImplicitSteps &steps() const
    {
      return own_steps;
    }
    /** Whether the stage has ended; a jump has its last load_time at once. */
    bool has_ended(const State<dim> &state) const
    {
      return state.template get<ImplicitState>().released == 1.
             && !state.template get<ImplicitState>().jumps
             && state.load_time >= own_steps.duration();
    }

    /**
     * Advances @p state to the next equilibrium. Throws a RunError, which names
     * the place of the largest unbalanced force, if there is none within the
     * smallest step; the state is then the last equilibrium.
     */
    void step(State<dim> &state);

    /** Makes the next steps of a search for the factor of safety those of a
        jump, from @p state on and with all forces released. */
    void move_against_drag(State<dim> &state);

    /**
     * Computes the matrix, its factors and the first correction of the next
     * step, to measure their cost, and discards them.
     */
    void try_iteration(const State<dim> &state)
    {
      newton->try_iteration(state);
    }

    /** Finds the equilibrium of liners without what is cut, too, while blocks
        rest: the forces that this leaves on them are then released. */
    void cut_liners(const std::vector<unsigned int> &blocks,
                    State<dim> &state) override;

    void save(State<dim> &state) const override;

    Resultant<dim> resultant(const std::string &load) const override;
    std::vector<dealii::Tensor<1, dim>>
    node_forces(const MotionConstraint<dim> &platen) const override;

    /** Record of steps and iterations; the caller that reports them empties the
     * lists. */
    ImplicitRecord &record()
    {
      return done;
    }
    DofIndex n_unknowns() const
    {
      return dof_map ? dof_map->owned().size() : 0;
    }
    /** Whether the linear solver of the stage is the direct one. */
    bool is_direct() const
    {
      return newton->is_direct();
    }

  private:
    using Solver<dim>::acting;
    using Solver<dim>::all;
    using Solver<dim>::communicator;
    using Solver<dim>::model;
    using Solver<dim>::stage;
    using Solver<dim>::time_shares;

    /** Whether forces have been found on any rank, one of which may have no
        node. Collective. */
    bool has_balance() const;
    void prepare_stage(const State<dim> &state);
    /** Joints, blocks, @p loads and what excavated blocks leave behind. */
    typename Equilibrium<dim>::Operators
    operators_with(const std::vector<const NodalLoad<dim> *> &loads) const;
    /** Excludes absent rigid blocks from the bodies. */
    void hold_absent_blocks(const State<dim> &state);
    /** Throws an InputError if what acts in the stage has a net force that
        nothing but the static far field could take. Collective. */
    void refuse_net_force(const State<dim> &state);
    void hold_what_is_out_of_balance(const StageParameters *previous,
                                     State<dim> &state);
    void go_on_jumping(const State<dim> &before, State<dim> &state);
    /** Whether the drag of a jump falls, as far as it has been watched. */
    bool comes_to_rest(const State<dim> &before, ImplicitState &now) const;
    void commit(const Configuration<dim> &configuration, State<dim> &state);
    /** Largest component of the displacements @p from one configuration
        @p to another [m]; collective. */
    double largest_move(const AlignedArray<NodeRecord<dim>> &from,
                        const AlignedArray<NodeRecord<dim>> &to) const;
    /** Makes @p state the last equilibrium and throws the RunError. */
    [[noreturn]] void give_up(State<dim> &state);
    [[noreturn]] void fail(const State<dim> &state, double tried,
                           bool jumped) const;

    const ImplicitParameters parameters;
    ImplicitSteps own_steps;
    std::vector<bool> path_sets;
    std::vector<std::string> set_names;

    double stage_start = 0.; /**< State::load_start() [s] */
    std::vector<bool> held_blocks;
    std::unique_ptr<DofMap<dim>> dof_map;
    std::unique_ptr<Equilibrium<dim>> equilibrium;
    std::unique_ptr<NewtonSolver<dim>> newton;

    State<dim> last_equilibrium; /**< state before the current step or jump */
    typename NewtonSolver<dim>::Attempt attempt;
    ImplicitRecord done;
  };
} // namespace quoin

#endif
