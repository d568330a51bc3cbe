// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_farfield_static_far_field_h
#define quoin_farfield_static_far_field_h

#include <quoin/base/eigen_core.h>
#include <quoin/farfield/far_field.h>
#include <quoin/farfield/interface_transfer.h>
#include <quoin/motions/motion_constraint.h>

#include <string>
#include <vector>

namespace quoin
{
  /** Static boundary elements beyond the blocks; see StaticFarField. */
  struct StaticFarFieldState
  {
    static constexpr const char *slice_name = "static far field";

    bool active = false;        /**< whether it has begun */
    std::vector<double> held;   /**< forces on its nodes [N] */
    std::vector<double> origin; /**< motion of elements that counts as 0 [m] */
    double stored = 0.;         /**< elastic energy of the domain [J] */
    /** What stored has beside the energy of the motion since origin [J]. */
    double stored_before = 0.;

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(active);
      visitor.own(held, 2);
      visitor.same(origin, stored, stored_before);
    }
  };

  /**
   * The rock beyond the outer boundary of blocks, at rest: a static stiffness
   * on the interface. It takes the place of FarField in static stages.
   *
   * What forces are unbalanced on the interface when it first acts are held
   * from there on; to them comes -K (u - u_0), K of ExteriorStiffness and u_0
   * the motion at that time. After a stage of waves both are those with which
   * these began: momentary forces of waves under way are left out. It acts
   * implicitly, as K times the mean (u_{n-1} + 2 u_n + u_{n+1}) / 4: the same
   * as adding dt^2 K / 4 to the masses of the interface's nodes, which cannot
   * lower the critical step and does not change the equilibrium of the blocks.
   */
  class StaticFarField : public MotionConstraint<2>
  {
  public:
    /** As FarField; motion and waves of @p domain are not used. */
    StaticFarField(const std::string &name, const FarFieldDomain &domain,
                   const NodeMap<2> &node_map,
                   const std::vector<BoundaryFace<2>> &faces, double thickness);

    /**
     * Largest entry of the difference between the stiffness as computed and
     * its transpose, by the largest entry, before it was made symmetric.
     */
    double asymmetry() const
    {
      return relative_asymmetry;
    }

    /**
     * Goes on from the stage in which @p waves acted, once this stage has
     * begun: forces are held, and motion counts, from the state in which the
     * waves began. Values given on the rest of the boundary stay as they are in
     * the end.
     */
    void follow(const FarField &waves, State<2> &state) const;

    // For solvers of equilibrium.

    /**
     * Begins, if it has not: from now on @p force, what is out of balance on
     * local nodes without the far field, is held on the interface. Collective.
     */
    void hold(const dealii::Tensor<1, 2> *force, State<2> &state) const;

    /**
     * Adds its forces on the interface's nodes to @p force and returns its
     * elastic energy [J]. Collective.
     */
    double add_forces(const NodeRecord<2> *nodes,
                      const StaticFarFieldState &state,
                      dealii::Tensor<1, 2> *force) const;

    /** Minus the derivative of these forces. */
    struct NodalStiffness
    {
      /** Global nodes of all ranks, ascending. */
      std::vector<unsigned int> nodes;
      /** [N/m]; row 2 k + d is the k-th of nodes(), of this rank, column
          2 j + e the j-th of nodes. */
      Eigen::MatrixXd rows;
    };
    /** Collective. */
    NodalStiffness nodal_stiffness(const NodeExchange &exchange) const;

    void prepare(State<2> &state) const override;
    /** As ForceOperator::add_stored_energy(). */
    void add_stored_energy(const State<2> &state,
                           EnergyAccounts &energies) const
    {
      // This is the same on all ranks.
      const auto *own = state.find<StaticFarFieldState>();
      if (own && is_first_rank)
        energies.far_field += own->stored;
    }
    void begin_stage(State<2> &state, bool continues) override;
    void resume_stage(const State<2> &state) override;
    void correct(const StepContext &step,
                 const std::vector<CapturedNode<2>> &captured,
                 State<2> &state) override;
    void account(const StepContext &step,
                 const std::vector<CapturedNode<2>> &captured,
                 State<2> &state) override;

  private:
    void start(const StepContext &step,
               const std::vector<CapturedNode<2>> &captured, State<2> &state);
    /** Elastic energy [J] of a motion of the elements [m]. */
    double energy_of(const Eigen::VectorXd &motion) const;
    void prepare_step(const StepContext &step,
                      const std::vector<CapturedNode<2>> &captured);
    void gather_displacement(const std::vector<CapturedNode<2>> &captured,
                             Eigen::VectorXd &means) const;
    void book_stored(const StepContext &step, State<2> &state);

    InterfaceTransfer transfer;
    double thickness;
    bool is_first_rank;
    /** Areas of the degrees of freedom of the interface [m^2]. */
    Eigen::VectorXd areas;
    Eigen::MatrixXd stiffness; /**< traction by displacement [Pa/m] */
    /** Traction by what is given on the whole boundary. */
    Eigen::MatrixXd from_given;
    double relative_asymmetry = 0.;

    /** For the block steps, as long as these are the same; 0: not made. */
    double prepared_step = 0., prepared_velocity_step = 0.;
    std::vector<double> gain;    /**< velocity by force, of the nodes */
    Eigen::MatrixXd from_motion; /**< p by displacement [Pa/m] */

    /** Tractions [Pa] and motion of the elements since u_0 [m] in this step. */
    Eigen::VectorXd p, u, mean;
    Eigen::VectorXd v_before, v_after, change; /**< velocity [m/s] */
    Eigen::VectorXd before, after;             /**< u half a step off [m] */
    Eigen::VectorXd elastic, elastic_before;   /**< K times those [Pa] */
  };
} // namespace quoin

#endif
