// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_construction_h
#define quoin_dynamics_construction_h

#include <quoin/model/model.h>
#include <quoin/dynamics/solver.h>
#include <quoin/stages/stage_parameters.h>

#include <string>
#include <vector>

namespace quoin
{
  /**
   * Physical surfaces that a stage fills before any excavates them: they are
   * absent at the start of the run.
   */
  std::vector<std::string>
  groups_placed_later(const std::vector<StageParameters> &stages);

  /**
   * Staged construction: excavation and fill of blocks and changes of
   * materials, joint laws and their strength, done before the solver begins a
   * stage.
   *
   * Excavated blocks stay in the arrays: State::block_marks says that they are
   * absent, their nodes are held, their joints are deactivated. The forces that
   * they exerted on the others, through bars as well, go to
   * ConstructionState::held, which Release ramps down. Their energy is booked
   * as external work, as is what a change of stiffness adds.
   */
  template <int dim>
  class Construction
  {
  public:
    /**
     * Keeps a reference to @p model. Throws an InputError about stages that
     * name or order groups wrongly, or that would cut a block.
     */
    Construction(Model<dim> &model, const std::vector<StageParameters> &stages);

    /**
     * Called before @p solver begins stage @p stage, with the state at the end
     * of the previous one. Collective.
     */
    void begin_stage(unsigned int stage, Solver<dim> &solver,
                     State<dim> &state);

    /** Adds @p force on local nodes, of what else than joints and water lost
       its hold in the blocks that stage @p stage has excavated, to the forces
       that are released [N]. */
    void hold(unsigned int stage,
              const AlignedArray<dealii::Tensor<1, dim>> &force,
              State<dim> &state) const;

    /** Called instead when @p state is one within stage @p stage. */
    void resume_stage(unsigned int stage, const State<dim> &state);

    /** The absence of each physical surface: the share of the stages in which
        it is absent, and 2 more where it is absent after the last one [-].
        Histories at the border of two are of that with the smaller one. */
    std::vector<double> absence() const;

    /** Restores the model of the start of the run. */
    void restart();

  private:
    /** Changes by a stage; flags are per physical surface. */
    struct Step
    {
      std::string where; /**< location for messages */
      std::vector<bool> excavate, fill;
      bool takes = false, places = false;
      /** Properties from here on, with strength factor 1. */
      ModelProperties properties;
      double release  = 1.;
      bool changes    = false; /**< whether the properties change */
      double strength = 1.;    /**< factor on strengths */
      /** Physical surfaces present before and after the stage. */
      std::vector<bool> bears_load;
    };

    void check_presence();
    void check_borders(const Step &step, const std::vector<bool> &groups,
                       const std::string &parameter) const;
    void find_properties(unsigned int stage, const StageParameters &parameters);
    void change_material(const std::string &group, const std::string &material,
                         Step &step) const;
    void change_joints(const std::string &set, const std::string &other,
                       Step &step) const;
    bool is_in(unsigned int block, const std::vector<bool> &groups) const;
    std::vector<unsigned int> blocks_in(const std::vector<bool> &groups) const;
    /** Stored energy of this rank [J]. */
    double stored_energy(const State<dim> &state) const;
    void take_away(const Step &step, Solver<dim> &solver,
                   State<dim> &state) const;
    void place(const Step &step, State<dim> &state) const;
    /** Properties of the model after @p n stages. */
    ModelProperties properties_after(unsigned int n) const;
    /** Restores the model after @p n stages. */
    void restore(unsigned int n, const ConstructionState<dim> &state);

    Model<dim> &model;
    const ModelProperties at_start;
    const std::vector<bool> absent_at_start; /**< flags of physical surfaces */
    std::vector<Step> steps;
    unsigned int n_begun = 0; /**< stages whose properties the model has */
  };
} // namespace quoin

#endif
