// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_motions_platen_h
#define quoin_motions_platen_h

#include <quoin/base/thickness.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/motions/motion_constraint.h>
#include <quoin/mesh/node_map.h>
#include <quoin/signals/time_function.h>

namespace quoin
{
  /** The nodes that a platen moves: those of a boundary, or of groups. */
  template <int dim>
  std::vector<unsigned int> platen_nodes(const LoadParameters &parameters,
                                         const NodeMap<dim> &node_map);

  /** The areas of the boundary that belong to its @p nodes, platen_nodes()
      [m^2]: their middle is the centre of the platen. Platens on groups have
      none; their centre is that of the mass. @p thickness: of each cell group
      [m]. */
  template <int dim>
  std::vector<double> platen_areas(const LoadParameters &parameters,
                                   const NodeMap<dim> &node_map,
                                   const std::vector<unsigned int> &nodes,
                                   const Thickness &thickness);

  /** Motion of a rigid platen: x [m], y [m], rotation [rad, anticlockwise]. */
  struct PlatenState
  {
    bool active = false;
    dealii::Tensor<1, 2> centre; /**< position when it first acted [m] */
    /** Displacement since it first acted [m, m, rad]. */
    double displacement[3]{};
    /** Displacement at the start of the stage [m, m, rad]. */
    double stage_start[3]{};
    double velocity[3]{};     /**< velocity at time - dt/2 [m/s, m/s, rad/s] */
    std::vector<double> arms; /**< x, y of nodes from centre, then [m] */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(active, centre, displacement, stage_start, velocity);
      visitor.own(arms, 2);
    }
  };

  /**
   * A rigid platen: the nodes of a boundary, or all nodes of a group of blocks,
   * move as one rigid body. Its centre is the middle of the boundary, or the
   * centre of mass of the group. Each of its three degrees of freedom, the
   * displacements of the centre and the rotation, is driven (velocity or
   * displacement), loaded (force or moment) or free. Its mass is that of its
   * nodes.
   */
  class Platen : public MotionConstraint<2>, public RigidMotion<2>
  {
  public:
    /** @p thickness: of each cell group [m]. */
    Platen(const LoadParameters &parameters, const NodeMap<2> &node_map,
           const Thickness &thickness = Thickness());

    void prepare(State<2> &state) const override;
    void set_mass(const std::vector<double> &mass, double extra_inertia = 0.,
                  double extra_spin = 0.) override;
    void rest(State<2> &state) override;
    void begin_stage(State<2> &state, bool continues) override;
    void grow_forces(const Growth &growth) override
    {
      force_growth = growth;
    }
    double force_share(const double load_time) const override
    {
      return force_growth.share(load_time);
    }
    void resume_stage(const State<2> &state) override;
    void correct(const StepContext &step,
                 const std::vector<CapturedNode<2>> &captured,
                 State<2> &state) override;
    void account(const StepContext &step,
                 const std::vector<CapturedNode<2>> &captured,
                 State<2> &state) override;

    double unbalanced() const override
    {
      return last_unbalanced;
    }
    bool bears() const override
    {
      return is_bearing;
    }
    std::vector<dealii::Tensor<1, 2>>
    normals(const State<2> &state) const override;
    const std::vector<dealii::Tensor<1, 2>> &node_forces() const override
    {
      return own_forces;
    }
    const std::array<LoadComponent, 3> *parts() const override
    {
      return &components;
    }
    const RigidMotion<2> *rigid_motion() const override
    {
      return this;
    }
    const double *displacement(const State<2> &state) const override
    {
      return state.get<PlatenState>(load_name).displacement;
    }

  private:
    bool driven(const unsigned int d) const
    {
      return components[d].quantity == LoadQuantity::velocity
             || components[d].quantity == LoadQuantity::displacement;
    }

    /** Force and moment [N, N m] of the nodes, summed over all ranks. */
    std::array<double, 3>
    resultant(const std::vector<CapturedNode<2>> &captured,
              const PlatenState &platen) const;
    /** What its velocity becomes where component @p d is driven [m/s, rad/s].
     */
    double driven_velocity(unsigned int d, const StepContext &step,
                           const PlatenState &platen) const;

    std::array<LoadComponent, 3> components;
    MPI_Comm communicator;
    std::vector<double> node_mass, node_area; /**< see platen_areas() */
    double rigid_inertia = 0., rigid_spin = 0.;
    double mass = 0., inertia = 0.; /**< inertia about the centre [kg m^2] */
    /** The arm of the centre of mass, turned back like those of nodes [m]. */
    dealii::Tensor<1, 2> offset;

    /** Forces on the platen in the last step by its drive and damping, and the
        velocity before it. */
    std::array<double, 3> drive{}, damping{}, velocity_before{};
    double last_unbalanced = 0.;
    bool is_bearing        = false; /**< see bears() */
    /** The normals in the mesh, and forces on nodes, see RigidMotion. */
    std::vector<dealii::Tensor<1, 2>> mesh_normals, own_forces;
    Growth force_growth;
  };
} // namespace quoin

#endif
