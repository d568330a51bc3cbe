// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_construction_h
#define quoin_dynamics_construction_h

#include <quoin/dynamics/model.h>
#include <quoin/dynamics/solver.h>
#include <quoin/dynamics/stage_parameters.h>

#include <string>
#include <vector>

namespace quoin
{
  /**
   * Physical surfaces that a stage places before any takes them away: they are
   * absent where the run begins.
   */
  std::vector<std::string>
  groups_placed_later(const std::vector<StageParameters> &stages);

  /**
   * What stages do to the model before the solver begins them: blocks that are
   * taken away and placed, materials and joint laws that change.
   *
   * Taken blocks stay in the arrays: State::block_marks says that they are
   * absent, their nodes are held, the joints to them are let go. What they
   * exerted on the others goes to ConstructionState::held, which Release lets
   * go. Energy that they had is booked as done from outside, as is what
   * a change of stiffness adds.
   */
  class Construction
  {
  public:
    /**
     * Keeps a reference to @p model. Throws an InputError about stages whose
     * names or order are wrong, or that would cut a block.
     */
    Construction(Model &model, const std::vector<StageParameters> &stages);

    /**
     * Called before @p solver begins stage @p stage, with the state of the end
     * of the one before. Collective.
     */
    void begin_stage(unsigned int stage, Solver &solver, State<2> &state);

    /** Called instead when @p state is one within stage @p stage. */
    void resume_stage(unsigned int stage, const State<2> &state);

    /** Of each physical surface, whether the last stage leaves it absent. */
    std::vector<bool> absent_in_the_end() const;

    /** Makes the model as it is where the run begins. */
    void restart();

  private:
    /** What a stage does, by physical surface. */
    struct Step
    {
      std::string where; /**< for messages */
      std::vector<bool> excavate, fill;
      bool takes = false, places = false;
      ModelProperties properties; /**< from here on */
      double release = 1.;
      bool changes   = false; /**< the properties */
      /** Physical surfaces that are there before and after it. */
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
    std::vector<unsigned int> own_blocks(const std::vector<bool> &groups) const;
    double stored_energy(const State<2> &state) const; /**< of this rank [J] */
    void take_away(const Step &step, Solver &solver, State<2> &state) const;
    void place(const Step &step, State<2> &state) const;
    /** Makes the model that which @p n stages left. */
    void restore(unsigned int n, const ConstructionState &state);

    Model &model;
    const ModelProperties at_start;
    std::vector<Step> steps;
    unsigned int n_begun = 0; /**< stages whose properties the model has */
  };
} // namespace quoin

#endif
