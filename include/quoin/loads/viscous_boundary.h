// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_viscous_boundary_h
#define quoin_loads_viscous_boundary_h

#include <quoin/loads/load_parameters.h>
#include <quoin/loads/motion_constraint.h>
#include <quoin/materials/linear_elastic.h>
#include <quoin/materials/plane_assumption.h>
#include <quoin/mesh/node_map.h>

#include <array>
#include <vector>

namespace quoin
{
  /** Impedances of a material [Pa s/m]: rho c of P and S waves. */
  struct Impedance
  {
    double normal;
    double shear;
  };

  Impedance impedance_of(const LinearElastic &material,
                         PlaneAssumption assumption);

  /** Of one node on a viscous boundary. */
  template <int dim>
  struct Dashpot
  {
    /** xx, yy, xy or xx, yy, zz, xy, xz, yz [N s/m] */
    using Damping = std::array<double, dim *(dim + 1) / 2>;
    using Force   = std::array<double, dim>; /**< [N] */

    Damping damping{};
    std::array<double, dim> normal{}; /**< force per incident normal ... */
    std::array<double, dim> shear{};  /**< ... and shear velocity [N s/m] */

    /** Force of a wave that comes in with these velocities [N]. */
    std::array<double, dim> pull(const double vn, const double vs) const
    {
      std::array<double, dim> force;
      for (unsigned int d = 0; d < dim; ++d)
        force[d] = vn * normal[d] + vs * shear[d];
      return force;
    }
  };

  /**
   * Adds to @p dashpots, those of the local nodes @p nodes (ascending), the
   * shares of the @p faces of @p node_map; nodes that are not listed are left
   * out.
   * @p impedance: of each cell group. The shear velocity of an incident wave
   * is along the boundary curve; in three dimensions it has no direction and
   * is left out.
   */
  template <int dim>
  void add_dashpots(const NodeMap<dim> &node_map,
                    const std::vector<BoundaryFace<dim>> &faces,
                    const std::vector<Impedance> &impedance, double thickness,
                    const std::vector<unsigned int> &nodes,
                    std::vector<Dashpot<dim>> &dashpots);

  /**
   * Moves a node by the force @p pull [N] beside its own and the drag
   * @p damping [N s/m] on the mean velocity of the step:
   * (m + h c) v+ = (m - h c) v- + 2 h f, h half the step.
   */
  template <int dim>
  void move_with_dashpot(const StepContext &step,
                         const CapturedNode<dim> &before,
                         const typename Dashpot<dim>::Damping &damping,
                         const typename Dashpot<dim>::Force &pull,
                         State<dim> &state);

  /**
   * Books the work of what move_with_dashpot() did, for the components that
   * @p owner moved, and adds its forces [N] and their moment about the
   * origin [N m] to @p resultant.
   */
  template <int dim>
  void account_for_dashpot(const StepContext &step,
                           const CapturedNode<dim> &before,
                           const typename Dashpot<dim>::Damping &damping,
                           const typename Dashpot<dim>::Force &pull,
                           const MotionConstraint<dim> *owner,
                           std::array<double, 3> &resultant, State<dim> &state);

  /** A viscous boundary that came after other stages. */
  struct ViscousBoundaryState
  {
    bool active = false;      /**< whether it has begun */
    std::vector<double> held; /**< forces on its nodes [N]; empty: none */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &active &held;
    }
  };

  /**
   * The standard viscous boundary (@cite LysmerKuhlemeyer1969) with waves
   * coming in: traction = rho c (2 v_incident - v), normal and tangential.
   * The dashpot is centred in time and solved node by node, so that it does
   * not reduce the stable step. Local damping does not act on its nodes.
   *
   * If it comes after a stage in which it did not act, the forces that are
   * unbalanced on its nodes at its first step, but for those of loads that
   * begin with it, are held from there on: reactions of what it replaces. A
   * run that begins with it has nothing to hold.
   */
  template <int dim>
  class ViscousBoundary : public MotionConstraint<dim>
  {
  public:
    /**
     * @p impedance: of what lies beyond each cell group of @p node_map. Throws
     * an InputError about an incident shear velocity in three dimensions.
     */
    ViscousBoundary(const LoadParameters &parameters,
                    const NodeMap<dim> &node_map,
                    const std::vector<Impedance> &impedance, double thickness);

    MotionKind kind() const override
    {
      return MotionKind::absorbing;
    }
    void prepare(State<dim> &state) const override;
    void begin_stage(State<dim> &state, bool continues) override;
    void correct(const StepContext &step,
                 const std::vector<CapturedNode<dim>> &captured,
                 State<dim> &state) override;
    void account(const StepContext &step,
                 const std::vector<CapturedNode<dim>> &captured,
                 State<dim> &state) override;
    std::array<double, 3> values(const TimePoint &time) const override
    {
      return component_values(components, time);
    }

  private:
    void hold(const std::vector<CapturedNode<dim>> &captured,
              ViscousBoundaryState &own) const;
    /** On the i-th node, of the wave that comes in and what is held [N]. */
    std::array<double, dim> pull(unsigned int i, double vn, double vs,
                                 const ViscousBoundaryState &own) const;

    std::array<LoadComponent, 3> components;
    std::vector<Dashpot<dim>> dashpots;
  };
} // namespace quoin

#endif
