// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_viscous_boundary_h
#define quoin_loads_viscous_boundary_h

#include <quoin/base/node_exchange.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/loads/node_constraint.h>
#include <quoin/mesh/block_mesh.h>

#include <array>
#include <vector>

namespace quoin
{
  /** Impedances of a cell group [Pa s/m]: rho c of P and S waves. */
  struct Impedance
  {
    double normal;
    double shear;
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
  class ViscousBoundary : public NodeConstraint
  {
  public:
    /**
     * @p index: its place in State::viscous_boundaries; @p impedance of each
     * cell group of @p mesh.
     */
    ViscousBoundary(const LoadParameters &parameters, unsigned int index,
                    const BlockMesh<2> &mesh, const NodeExchange &exchange,
                    const std::vector<Impedance> &impedance, double thickness);

    void begin_stage(State &state, bool continues) override;
    void correct(const StepContext &step,
                 const std::vector<CapturedNode> &captured,
                 State &state) override;
    void account(const StepContext &step,
                 const std::vector<CapturedNode> &captured,
                 State &state) override;
    std::array<double, 3> values(const TimePoint &time) const override
    {
      return component_values(components, time);
    }
    std::array<bool, 3> holds() const override
    {
      return { { false, false, false } };
    }

  private:
    void hold(const std::vector<CapturedNode> &captured,
              ViscousBoundaryState &own) const;

    /** Of one node. */
    struct Dashpot
    {
      std::array<double, 3> damping{}; /**< xx, yy, xy [N s/m] */
      std::array<double, 2> normal{};  /**< force per incident normal ... */
      std::array<double, 2> shear{};   /**< ... and shear velocity [N s/m] */
    };

    unsigned int index;
    std::array<LoadComponent, 3> components;
    std::vector<Dashpot> dashpots;
  };
} // namespace quoin

#endif
