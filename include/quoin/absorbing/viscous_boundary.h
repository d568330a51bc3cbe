// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_absorbing_viscous_boundary_h
#define quoin_absorbing_viscous_boundary_h

#include <quoin/base/thickness.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/motions/motion_constraint.h>
#include <quoin/materials/linear_elastic.h>
#include <quoin/materials/plane_assumption.h>
#include <quoin/mesh/global_geometry.h>

#include <array>
#include <memory>
#include <vector>

namespace quoin
{
  class PlaneWaveForces;

  /** Impedances of a material [Pa s/m]: rho c of P and S waves. */
  struct Impedance
  {
    double normal;
    double shear;
    double density = 0.; /**< [kg/m^3] */
  };

  Impedance impedance_of(const LinearElastic &material,
                         PlaneAssumption assumption);

  /** Dashpot of a node on a viscous boundary. */
  template <int dim>
  struct Dashpot
  {
    /** xx, yy, xy or xx, yy, zz, xy, xz, yz [N s/m] */
    using Damping = std::array<double, dim *(dim + 1) / 2>;

    Damping damping{};
    dealii::Tensor<1, dim> normal;  /**< force per incident normal ... */
    dealii::Tensor<1, dim> shear;   /**< ... and shear velocity [N s/m] */
    dealii::Tensor<1, dim> lateral; /**< the second shear velocity in space */

    /** Force of waves with the normal, shear and, in three dimensions, second
        shear velocity @p incident [m/s]. */
    dealii::Tensor<1, dim> pull(const std::array<double, 3> &incident) const
    {
      auto result = incident[0] * normal + incident[1] * shear;
      if (dim == 3)
        result += incident[2] * lateral;
      return result;
    }

    /** Adds to @p force [N] that by which the velocity @p v [m/s] of the medium
        beyond drags the node along. */
    void add_drag(const dealii::Tensor<1, dim> &v,
                  dealii::Tensor<1, dim> &force) const;

    /** Adds that of the area @p outward [m^2] with its normal, before a medium
        of the impedance @p z. */
    void add(const dealii::Tensor<1, dim> &outward, const Impedance &z);
  };

  /**
   * Adds to @p dashpots, those of the local nodes @p nodes (ascending), the
   * shares of the @p faces of @p node_map; nodes that are not listed are left
   * out.
   * @p impedance, @p thickness: of each cell group. The shear velocity of an
   * incident wave is along the boundary curve; in three dimensions, where the
   * faces must be horizontal for it, along x, the second one along y.
   */
  template <int dim>
  void add_dashpots(const NodeMap<dim> &node_map,
                    const std::vector<BoundaryFace<dim>> &faces,
                    const std::vector<Impedance> &impedance,
                    const Thickness &thickness,
                    const std::vector<unsigned int> &nodes,
                    std::vector<Dashpot<dim>> &dashpots);

  /**
   * Velocity after a step [m/s] of a @p mass [kg] with @p velocity before it
   * under @p force [N], the damping of the step and the drag @p damping [N s/m]
   * on the mean velocity: (m + h c) v+ = (m - h c) v- + 2 h f, h half the step.
   * Components that are @p prescribed have the velocity @p after, by which they
   * drag the others along.
   */
  template <int dim>
  dealii::Tensor<1, dim>
  velocity_with_dashpot(const StepContext &step, double mass,
                        const dealii::Tensor<1, dim> &velocity,
                        const typename Dashpot<dim>::Damping &damping,
                        const dealii::Tensor<1, dim> &force,
                        const std::array<bool, dim> &prescribed,
                        dealii::Tensor<1, dim> after);

  /**
   * Moves the components of a node that @p owner moves by its force, the force
   * @p pull [N] and the drag @p damping [N s/m], see velocity_with_dashpot().
   * The others have moved already.
   */
  template <int dim>
  void move_with_dashpot(const StepContext &step,
                         const CapturedNode<dim> &before,
                         const typename Dashpot<dim>::Damping &damping,
                         const dealii::Tensor<1, dim> &pull,
                         const MotionConstraint<dim> *owner, State<dim> &state);

  /**
   * Books the work of move_with_dashpot() for the components that @p owner
   * moved, and adds its forces [N] and their moment about the origin [N m] to
   * @p resultant.
   */
  template <int dim>
  void account_for_dashpot(const StepContext &step,
                           const CapturedNode<dim> &before,
                           const typename Dashpot<dim>::Damping &damping,
                           const dealii::Tensor<1, dim> &pull,
                           const MotionConstraint<dim> *owner,
                           Resultant<dim> &resultant, State<dim> &state);

  /** State of a viscous boundary that began after the first stage. */
  template <int dim>
  struct ViscousBoundaryState
  {
    bool active = false;      /**< whether it has begun */
    std::vector<double> held; /**< forces on its nodes [N]; empty: none */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(active);
      visitor.own(held, dim);
    }
  };

  /**
   * The standard viscous boundary (@cite LysmerKuhlemeyer1969) with incident
   * waves: traction = rho c (2 v_incident - v), normal and tangential. The
   * dashpot is centred in time and solved node by node, so that it does not
   * reduce the stable step. Local damping does not act on its nodes.
   *
   * If it follows a stage in which it did not act, the unbalanced forces on its
   * nodes at its first step, without those of loads that begin with it, are
   * held from then on: they are the reactions of the support that it replaces.
   * In the first stage of a run nothing is held.
   *
   * In three dimensions incident waves may be plane waves of any direction: the
   * traction is rho c (v_incident - v) and that of the stress of the wave, so
   * that it passes as if there were no boundary; see PlaneWaves.
   */
  template <int dim>
  class ViscousBoundary : public MotionConstraint<dim>
  {
  public:
    /**
     * @p impedance: beyond each cell group of @p node_map; @p thickness: of
     * each. Throws an InputError about an incident shear velocity on a surface
     * that is not horizontal.
     */
    ViscousBoundary(const LoadParameters &parameters,
                    const NodeMap<dim> &node_map,
                    const std::vector<Impedance> &impedance,
                    const Thickness &thickness);
    ~ViscousBoundary() override;
    ViscousBoundary &operator=(ViscousBoundary &&);

    void prepare(State<dim> &state) const override;
    void begin_stage(State<dim> &state, bool continues) override;
    void correct(const StepContext &step,
                 const std::vector<CapturedNode<dim>> &captured,
                 State<dim> &state) override;
    void account(const StepContext &step,
                 const std::vector<CapturedNode<dim>> &captured,
                 State<dim> &state) override;
    const std::array<LoadComponent, 3> *parts() const override
    {
      return &components;
    }

    /**
     * Adds the dashpots and waves of @p others where they share nodes with this
     * boundary, which moves these nodes as the last one of them. The others
     * act in the same stage and come before it in the order of constraints.
     */
    void take_over(const std::vector<const ViscousBoundary *> &others);

  private:
    void hold(const std::vector<CapturedNode<dim>> &captured,
              ViscousBoundaryState<dim> &own) const;
    /** Finds the forces of incident waves at @p time, also those that others
        bring to shared nodes, and those that are held. */
    void find_pulls(const TimePoint &time,
                    const ViscousBoundaryState<dim> &own);

    std::array<LoadComponent, 3> components;
    /** A node of this boundary and of another one, by place in their lists. */
    struct SharedNode
    {
      unsigned int here, there;
      const ViscousBoundary *other;
    };

    std::vector<Dashpot<dim>> dashpots;
    std::vector<dealii::Tensor<1, dim>> waves; /**< forces of this step [N] */
    std::vector<dealii::Tensor<1, dim>> pull;  /**< of all that acts [N] */
    std::vector<SharedNode> shared;
    /** Drag of each node, with that of the dashpots of other boundaries. */
    std::vector<typename Dashpot<dim>::Damping> damping;
    /** Null: waves come along the normal. */
    std::unique_ptr<const PlaneWaveForces> plane_waves;
  };
} // namespace quoin

#endif
