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
  struct Dashpot
  {
    std::array<double, 3> damping{}; /**< xx, yy, xy [N s/m] */
    std::array<double, 2> normal{};  /**< force per incident normal ... */
    std::array<double, 2> shear{};   /**< ... and shear velocity [N s/m] */

    /** Force of a wave that comes in with these velocities [N]. */
    std::array<double, 2> pull(const double vn, const double vs) const
    {
      return { { vn * normal[0] + vs * shear[0],
                 vn * normal[1] + vs * shear[1] } };
    }
  };

  /**
   * Adds to @p dashpots, those of the local nodes @p nodes (ascending), the
   * shares of the @p faces of @p node_map; nodes that are not listed are left
   * out.
   * @p impedance: of each cell group.
   */
  void add_dashpots(const NodeMap<2> &node_map,
                    const std::vector<BoundaryFace<2>> &faces,
                    const std::vector<Impedance> &impedance, double thickness,
                    const std::vector<unsigned int> &nodes,
                    std::vector<Dashpot> &dashpots);

  /**
   * Moves a node by the force @p pull [N] beside its own and the drag
   * @p damping (xx, yy, xy [N s/m]) on the mean velocity of the step:
   * (m + h c) v+ = (m - h c) v- + 2 h f, h half the step.
   */
  void move_with_dashpot(const StepContext &step, const CapturedNode<2> &before,
                         const std::array<double, 3> &damping,
                         const std::array<double, 2> &pull, State<2> &state);

  /**
   * Books the work of what move_with_dashpot() did, for the components that
   * @p owner moved, and adds its forces [N] and their moment about the
   * origin [N m] to @p resultant.
   */
  void account_for_dashpot(const StepContext &step,
                           const CapturedNode<2> &before,
                           const std::array<double, 3> &damping,
                           const std::array<double, 2> &pull,
                           const MotionConstraint<2> *owner,
                           std::array<double, 3> &resultant, State<2> &state);

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
  class ViscousBoundary : public MotionConstraint<2>
  {
  public:
    /** @p impedance: of what lies beyond each cell group of @p node_map. */
    ViscousBoundary(const LoadParameters &parameters,
                    const NodeMap<2> &node_map,
                    const std::vector<Impedance> &impedance, double thickness);

    MotionKind kind() const override
    {
      return MotionKind::absorbing;
    }
    void prepare(State<2> &state) const override;
    void begin_stage(State<2> &state, bool continues) override;
    void correct(const StepContext &step,
                 const std::vector<CapturedNode<2>> &captured,
                 State<2> &state) override;
    void account(const StepContext &step,
                 const std::vector<CapturedNode<2>> &captured,
                 State<2> &state) override;
    std::array<double, 3> values(const TimePoint &time) const override
    {
      return component_values(components, time);
    }

  private:
    void hold(const std::vector<CapturedNode<2>> &captured,
              ViscousBoundaryState &own) const;
    /** On the i-th node, of the wave that comes in and what is held [N]. */
    std::array<double, 2> pull(unsigned int i, double vn, double vs,
                               const ViscousBoundaryState &own) const;

    std::array<LoadComponent, 3> components;
    std::vector<Dashpot> dashpots;
  };
} // namespace quoin

#endif
