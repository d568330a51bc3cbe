// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_nodal_load_h
#define quoin_loads_nodal_load_h

#include <quoin/operators/force_operator.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/mesh/node_map.h>

#include <vector>

namespace quoin
{
  /**
   * A traction or gravity: forces a_x(t) w_i, a_y(t) w_i on nodes i with
   * fixed weights w_i, the tributary area [m^2] (NodeMap::face_share()) or
   * the mass [kg]. A pressure
   * adds a_p(t) n_i, with n_i the tributary area times the inward normal.
   * Tractions and pressures act on the reference area and keep their
   * direction.
   */
  class NodalLoad : public ForceOperator<2>
  {
  public:
    /** @p mass is that of the local nodes, unscaled [kg]. */
    NodalLoad(const LoadParameters &parameters, const NodeMap<2> &node_map,
              const std::vector<double> &mass, double thickness);

    /** Weights of gravity where masses have changed; see the constructor. */
    void set_mass(const std::vector<double> &mass);

    const char *kind() const override
    {
      return "loads";
    }
    void add_forces(const TimePoint &time, NodeVector<2> *force) const;
    void add_forces(const StepContext &step, State<2> &,
                    const NodeForces<2> &forces) override
    {
      add_forces(step.begin, forces.force);
    }
    double external_power(const TimePoint &time,
                          const NodeVector<2> *velocity) const override;

    /** Traction x, y and pressure [Pa] or acceleration x, y [m/s^2]. */
    std::array<double, 3> amplitude(const TimePoint &time) const;

    const std::string &name() const
    {
      return load_name;
    }

  private:
    std::string load_name;
    bool is_gravity;
    std::array<LoadComponent, 3> components;
    std::vector<unsigned int> nodes;
    std::vector<double> weights;
    std::vector<NodeVector<2>> inward; /**< n_i [m^2]; empty without pressure */
  };

  /**
   * Boundary faces of the curves @p names, those of all ranks on all ranks.
   * Collective. Throws an InputError naming @p load if a curve does
   * not exist or has no outer edge.
   */
  std::vector<BoundaryFace<2>>
  faces_of_curves(const NodeMap<2> &node_map,
                  const std::vector<std::string> &names,
                  const std::string &load);

  /** Groups named @p names; throws an InputError naming @p load. */
  std::vector<unsigned int>
  groups_of_names(const NodeMap<2> &node_map,
                  const std::vector<std::string> &names,
                  const std::string &load);
} // namespace quoin

#endif
