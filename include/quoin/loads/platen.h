// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_platen_h
#define quoin_loads_platen_h

#include <quoin/loads/load_parameters.h>
#include <quoin/loads/node_constraint.h>
#include <quoin/mesh/node_map.h>

namespace quoin
{
  /**
   * A rigid platen: the nodes of a boundary, or all nodes of a group of
   * blocks, move as one rigid body about their centre of mass. Each of its
   * three freedoms is driven (velocity or displacement) or loaded (force or
   * moment) or free. Its mass is that of its nodes.
   */
  class Platen : public NodeConstraint
  {
  public:
    /** @p index is its place in State::platens. */
    Platen(const LoadParameters &parameters, unsigned int index,
           const NodeMap<2> &node_map);

    /**
     * Masses of the local nodes, as they act in the stage to come [kg].
     * Rigid blocks are no masses at nodes: @p extra_inertia [kg m^2] is what
     * their moments of inertia have beyond those of the masses of their
     * nodes, @p extra_spin the angular momentum that goes with it.
     */
    void set_mass(const std::vector<double> &mass, double extra_inertia = 0.,
                  double extra_spin = 0.);

    void begin_stage(State<2> &state, bool continues) override;
    void resume_stage(const State<2> &state) override;
    void correct(const StepContext &step,
                 const std::vector<CapturedNode> &captured,
                 State<2> &state) override;
    void account(const StepContext &step,
                 const std::vector<CapturedNode> &captured,
                 State<2> &state) override;

    bool is_global() const override
    {
      return true;
    }
    double unbalanced() const override
    {
      return last_unbalanced;
    }
    const std::array<LoadComponent, 3> &parts() const
    {
      return components;
    }
    std::array<double, 3> values(const TimePoint &time) const override
    {
      return component_values(components, time);
    }
    void check_start(const TimePoint &time) const override
    {
      check_no_jump(components, time, load_name);
    }
    std::array<bool, 3> holds() const override;

    unsigned int index() const
    {
      return platen_index;
    }

  private:
    bool driven(const unsigned int freedom) const
    {
      return components[freedom].quantity == LoadQuantity::velocity
             || components[freedom].quantity == LoadQuantity::displacement;
    }

    /** Force and moment [N, N m] of the nodes, of all ranks. */
    std::array<double, 3> resultant(const std::vector<CapturedNode> &captured,
                                    const PlatenState &platen) const;
    /** One component of the platen's motion, of force, drive and damping. */
    void advance_freedom(unsigned int d, const StepContext &step,
                         PlatenState &platen);

    std::array<LoadComponent, 3> components;
    unsigned int platen_index;
    MPI_Comm communicator;
    std::vector<double> node_mass;
    double rigid_inertia = 0., rigid_spin = 0.;
    std::array<double, 3> inertia{}; /**< mass, mass, moment */

    /** Of the last step: force on the platen from its nodes and its drive,
        damping force, velocity before. */
    std::array<double, 3> nodal_force{}, drive{}, damping{}, velocity_before{};
    double last_unbalanced = 0.;
  };
} // namespace quoin

#endif
