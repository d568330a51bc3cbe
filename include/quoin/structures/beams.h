// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_structures_beams_h
#define quoin_structures_beams_h

#include <quoin/loads/nodal_load.h>
#include <quoin/structures/beam_equilibrium.h>

#include <string>
#include <vector>

namespace quoin
{
  /**
   * All beams and liners of a run. A liner's nodes are at those of a boundary
   * and connected to them by a joint law.
   *
   * All ranks have all beams and do the same with them; what they do to nodes
   * of blocks is done by the owner of the node, and the first rank counts
   * energies. BeamMotion moves them in explicit steps.
   */
  class Beams : public ForceOperator<2>
  {
  public:
    /** Keeps a reference to @p nodes. @p sets: of joints; @p thickness: of the
        model, @p group_thickness of each cell group [m]. Throws an InputError.
        Collective. */
    Beams(const std::vector<BeamParameters> &parameters,
          const NodeMap<2> &nodes, const std::vector<JointSetParameters> &sets,
          double thickness, const Thickness &group_thickness);

    const char *kind() const override
    {
      return "beams";
    }
    void prepare(State<2> &state) const override;

    /** Places the beams of the stage @p name, that begins. Throws an
        InputError. Collective. */
    void begin_stage(const std::string &name, State<2> &state);
    /** Takes the shapes at rest from @p state, in which beams are placed. */
    void resume_stage(const State<2> &state);

    /**
     * Cuts the interfaces to @p blocks, which are about to be taken away, for
     * good. Their forces are gone at once; what they store goes out of State::
     * energy as external work, and in equilibrium they do work like a load that
     * goes. Returns whether there were any. Collective.
     */
    bool cut(const std::vector<unsigned int> &blocks, State<2> &state) const;

    /** Takes from @p loads of the stage the gravity that acts everywhere. */
    void set_gravity(const std::vector<const NodalLoad<2> *> &loads);
    /** Acceleration of that gravity at @p time [m/s^2]. */
    dealii::Tensor<1, 2> gravity(const TimePoint &time) const;
    /** Whether the beam @p b is placed where the stage @p name begins, the
        @p first one of the run or not. */
    bool is_placed_by(unsigned int b, const std::string &name, bool first) const
    {
      const std::string &stage = beams[b].line.given.stage;
      return stage.empty() ? first : stage == name;
    }
    /** Lets the forces at the ends and along the line of each beam grow in the
        stage as @p growth says; empty: they are there. */
    void grow_loads(const std::vector<Growth> &growth)
    {
      load_growth = growth;
    }
    /** Loads at @p time, numbers that change when they do. */
    std::vector<double> loads(const TimePoint &time) const;
    /** Loads on the nodes of the beam @p b at @p time, its weight included [N].
     */
    std::vector<dealii::Tensor<1, 2>> node_loads(unsigned int b,
                                                 const TimePoint &time) const;

    void add_forces(const StepContext &step, State<2> &state,
                    const NodeForces<2> &forces) override;
    void add_stored_energy(const State<2> &state,
                           EnergyAccounts &energies) const override;
    /** Forces on the nodes, loads included, of add_forces() [N]. */
    const AlignedArray<dealii::Tensor<1, 2>> &node_forces() const
    {
      return force;
    }

    /**
     * Finds the nodes of beams in equilibrium with the blocks of @p state at
     * @p time, from BeamState of the last equilibrium, which @p committed is;
     * adds forces to owned nodes of blocks, updates BeamState and books
     * dissipation and the work of loads in State::energy. @p stiffness: null,
     * or that of blocks at the interface of each beam, see BeamReaction.
     * Returns the name of a beam that has no equilibrium, or nothing.
     * Collective.
     */
    std::string settle(const TimePoint &time, const State<2> &committed,
                       State<2> &state, dealii::Tensor<1, 2> *block_force,
                       std::vector<Eigen::MatrixXd> *stiffness) const;

    /** Names of the beams that is_unstable() says of @p state. */
    std::vector<std::string> unstable(const State<2> &state) const;

    const std::vector<Beam> &all() const
    {
      return beams;
    }

  private:
    /** Share of the given loads of the beam @p b at @p time [-]. */
    double grown(unsigned int b, const TimePoint &time) const;
    /** Finds BeamState::block_motion. Collective. */
    void find_block_motion(const State<2> &state, BeamState &now) const;
    /** Adds the opposite of @p by_point to owned nodes of blocks. */
    void add_block_forces(const AlignedArray<dealii::Tensor<1, 2>> &by_point,
                          dealii::Tensor<1, 2> *block_force) const;

    const NodeMap<2> &node_map;
    const bool is_first_rank;
    std::vector<Beam> beams;
    unsigned int n_nodes = 0, n_points = 0, n_internal_variables = 0;
    std::vector<const NodalLoad<2> *> gravity_loads; /**< of the stage */
    AlignedArray<dealii::Tensor<1, 2>> force;
    std::vector<Growth> load_growth; /**< of each beam; empty: all is there */
  };
} // namespace quoin

#endif
