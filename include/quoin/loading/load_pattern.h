// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loading_load_pattern_h
#define quoin_loading_load_pattern_h

#include <quoin/stages/stage_parameters.h>
#include <quoin/motions/motion_constraint.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/model/model.h>
#include <quoin/operators/force_operator.h>

#include <vector>

namespace quoin
{
  /** The part of State that belongs to a LoadPattern. */
  struct LoadPatternState
  {
    static constexpr const char *slice_name = "load pattern";

    double factor = 0.; /**< load factor of the last step [-] */
    /** The controlled displacement where the stage began [m]. */
    double start = 0.;

    // By the explicit solver, where a history is controlled:
    double mean_start = 0.; /**< mean displacement where the stage began [m] */
    double mean       = 0.; /**< prescribed mean displacement [m] */
    double rate   = 0.; /**< rate of the prescribed mean displacement [m/s] */
    double wanted = 0.; /**< control function of the last step [m] */
    double ratio  = 1.; /**< mean by controlled displacement so far [-] */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(factor, start, mean_start, mean, rate, wanted, ratio);
    }
  };

  /** A term of a sum of displacements. */
  struct DisplacementTerm
  {
    unsigned int node; /**< owned */
    unsigned int component;
    double weight; /**< [-] */
  };

  /**
   * Loads p of fixed distribution that one factor scales: lambda p acts, and
   * lambda is what it takes to make a displacement w = sum_i c_i . u_i of the
   * model follow a function of time from the start of the stage on. So a model
   * is pushed past its limit load, where lambda falls (@cite BatozDhatt1979).
   *
   * Unless a history is named, w is the displacement that works with the loads,
   * their mean weighted by the loads themselves,
   * @f[ w = \sum_i p_i \cdot u_i / S , \quad S = \sum_i |p_i| , @f]
   * and the work of the loads is lambda S dw. The sums are over the nodes of
   * blocks that are present, without components that prescribed motions and
   * platens hold: a load on those goes into the support.
   *
   * Explicit: lambda is the Lagrange multiplier of this constraint. Forces of a
   * step have lambda of the step before, all nodes advance as if there were no
   * constraint, and correct() adds the change of lambda that gives w its
   * prescribed value at the end of the step, by velocities along M^-1 p. That
   * is a projection which is symmetric in the metric of the masses: the
   * eigenvalues of the constrained model lie between those of the free one, and
   * the critical step holds. Local damping, which takes a share of the
   * unbalanced force, so sees lambda p, but for its change in one step.
   *
   * The projection is not symmetric where another displacement q is named, and
   * takes no heed of how long a force needs to get there. So the mean is
   * prescribed then, too, at a rate by which q follows its control function
   * Q(t), slowly against the time t_r that the model needs to respond,
   * @f[ t_r \ddot w + \dot w = \frac{w - w_0}{q - q_0}
   *               \left(\dot Q + \frac{Q - q}{4 t_r}\right) . @f]
   *
   * Implicit: lambda is an unknown; see Equilibrium.
   */
  template <int dim>
  class LoadPattern : public ForceOperator<dim>
  {
  public:
    /**
     * The loads of @p loads that @p stage names in its pattern, on blocks that
     * are present in @p state; @p constraints: those that act in the stage;
     * @p measured: this rank's terms of w; null: the mean. Throws an InputError
     * about loads that change in time, vanish or act on nothing that is free,
     * or if blocks may be deleted. Collective.
     */
    LoadPattern(const Model<dim> &model, const StageParameters &stage,
                const std::vector<NodalLoad<dim>> &loads,
                const std::vector<MotionConstraint<dim> *> &constraints,
                const std::vector<DisplacementTerm> *measured,
                const State<dim> &state);

    /** Forces of the factor 1 on local nodes, zero on ghosts [N]. */
    const AlignedArray<dealii::Tensor<1, dim>> &forces() const
    {
      return nodal;
    }
    /** This rank's terms of the controlled displacement. */
    const std::vector<DisplacementTerm> &measure() const
    {
      return is_named ? named : mean;
    }

    /** The controlled displacement, from the reference on [m]; collective. */
    double displacement(const AlignedArray<NodeRecord<dim>> &nodes) const;
    /** Work of the loads with the factor 1 from the reference on [J];
        collective. */
    double unit_work(const AlignedArray<NodeRecord<dim>> &nodes) const;
    /** Prescribed value at @p load_time [s], from the start of the stage on
     * [m]. */
    double target(const double load_time) const
    {
      return control({ load_time, load_time });
    }
    /** Largest target of the stage, whatever its sign [m]. */
    double largest_target() const;
    /** The pattern's state where a stage begins, with @p factor; collective. */
    LoadPatternState begin(double factor,
                           const AlignedArray<NodeRecord<dim>> &nodes) const;
    /** Resultant of the loads with the factor 1 [N]; collective. */
    std::array<double, dim> resultant() const;

    // The rest is for the explicit solver.

    /** Finds what lambda moves: not what @p constraints move. @p mass: of local
        nodes, with mass scaling [kg]; @p response_time: of the model [s].
        Throws an InputError about constraints that do not go with it.
        Collective. */
    void set_mobility(const std::vector<double> &mass,
                      const std::vector<MotionConstraint<dim> *> &constraints,
                      const RigidBlockStage &rigid, double response_time);
    const char *kind() const override
    {
      return "loads";
    }
    void add_forces(const StepContext &step, State<dim> &state,
                    const NodeForces<dim> &forces) override;
    double
    external_power(const TimePoint &time,
                   const dealii::Tensor<1, dim> *velocity) const override;
    /** Completes a step: the change of lambda and of the motion. Collective. */
    void correct(const StepContext &step, State<dim> &state);

  private:
    /** Takes @p own.mean on by @p step, where the named displacement is @p at
        now [m]. */
    void advance_mean(const StepContext &step, double at,
                      LoadPatternState &own) const;
    /** Makes the terms of the mean, without what is held. */
    void find_mean(const std::vector<MotionConstraint<dim> *> &constraints);

    /** A node with a load. */
    struct LoadedNode
    {
      unsigned int node;
      double force[dim]; /**< [N] */
      double gain[dim];  /**< force by mass, 0 where it is held [m/s^2] */
    };

    const Model<dim> &model;
    const std::string stage_name;
    const TimeFunction control;
    AlignedArray<dealii::Tensor<1, dim>> nodal;
    std::vector<LoadedNode> loaded; /**< owned */
    std::vector<DisplacementTerm> mean, named;
    const bool is_named;
    const double duration; /**< duration of the stage [s] */
    double response = 0.;  /**< time t_r [s] */
    /** Smallest increment of q for a ratio of both [m]. */
    double least_moved = 0.;
    double scale       = 0.; /**< S [N] */
    double node_gain   = 0.; /**< p M^-1 p of this rank's free nodes [N^2/kg] */
    double factor      = 0.; /**< the state's, in a step [-] */
    double power_before = 0.; /**< p v of this rank where a step begins [W] */
    RigidBlockStage rigid_stage;
  };
} // namespace quoin

#endif
