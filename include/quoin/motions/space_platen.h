// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_motions_space_platen_h
#define quoin_motions_space_platen_h

#include <quoin/motions/platen.h>

#include <type_traits>

namespace quoin
{
  /** Motion of a rigid platen in three dimensions: x, y, z [m], and its
      rotations about these axes [rad]. */
  struct SpacePlatenState
  {
    bool active = false;
    dealii::Tensor<1, 3> centre; /**< position when it first acted [m] */
    /** Displacements, and integrals of the rates of rotation, since it first
        acted [m, rad]. */
    std::array<double, 6> displacement{};
    std::array<double, 6> stage_start{}; /**< the same when the stage began */
    std::array<double, 6> velocity{};    /**< at time - dt/2 [m/s, rad/s] */
    /** Rows of its rotation since it first acted. */
    std::array<double, 9> rotation{ { 1., 0., 0., 0., 1., 0., 0., 0., 1. } };
    std::vector<double> arms; /**< x, y, z of nodes from centre, then [m] */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(active, centre, displacement, stage_start, velocity,
                   rotation);
      visitor.own(arms, 3);
    }
  };

  dealii::Tensor<2, 3> rotation_of(const SpacePlatenState &platen);
  void set_rotation(const dealii::Tensor<2, 3> &rotation,
                    SpacePlatenState &platen);

  /** The rotation by the angle |@p turn| [rad] about @p turn. */
  dealii::Tensor<2, 3> rotation_by(const dealii::Tensor<1, 3> &turn);
  /** The turn by less than half a revolution [rad] that @p rotation is. */
  dealii::Tensor<1, 3> turn_of(const dealii::Tensor<2, 3> &rotation);

  /**
   * A Platen in three dimensions, with six degrees of freedom. Its rotations
   * are given by the rates at which it turns about the axes of the coordinates,
   * or by the integrals of these, which are angles where it turns about one
   * axis; so are moments. Free rotations follow Euler's equations with the
   * inertia of its nodes.
   */
  class SpacePlaten : public MotionConstraint<3>, public RigidMotion<3>
  {
  public:
    /** @p thickness: 1. */
    SpacePlaten(const LoadParameters &parameters, const NodeMap<3> &node_map,
                const Thickness &thickness = Thickness());

    void prepare(State<3> &state) const override;
    void set_mass(const std::vector<double> &mass, double extra_inertia = 0.,
                  double extra_spin = 0.) override;
    void rest(State<3> &state) override;
    void begin_stage(State<3> &state, bool continues) override;
    void grow_forces(const Growth &growth) override
    {
      force_growth = growth;
    }
    double force_share(const double load_time) const override
    {
      return force_growth.share(load_time);
    }
    void resume_stage(const State<3> &state) override;
    void correct(const StepContext &step,
                 const std::vector<CapturedNode<3>> &captured,
                 State<3> &state) override;
    void account(const StepContext &step,
                 const std::vector<CapturedNode<3>> &captured,
                 State<3> &state) override;

    const std::array<LoadComponent, 3> *parts() const override
    {
      return &components;
    }
    const RigidMotion<3> *rigid_motion() const override
    {
      return this;
    }
    double unbalanced() const override
    {
      return last_unbalanced;
    }
    bool bears() const override
    {
      return is_bearing;
    }
    std::vector<dealii::Tensor<1, 3>>
    normals(const State<3> &state) const override;
    const std::vector<dealii::Tensor<1, 3>> &node_forces() const override
    {
      return own_forces;
    }
    const std::array<LoadComponent, 3> *rotations() const override
    {
      return &turns;
    }
    const double *displacement(const State<3> &state) const override
    {
      return state.get<SpacePlatenState>(load_name).displacement.data();
    }

  private:
    using Vector = dealii::Tensor<1, 3>;
    using Matrix = dealii::Tensor<2, 3>;
    using Six    = std::array<double, 6>;

    const LoadComponent &component(const unsigned int d) const
    {
      return d < 3 ? components[d] : turns[d - 3];
    }
    bool driven(unsigned int d) const;
    /** What its velocity becomes where component @p d is driven [m/s, rad/s].
     */
    double driven_velocity(unsigned int d, const StepContext &step,
                           const SpacePlatenState &platen) const;
    /** Force and moment [N, N m] of the nodes, summed over all ranks. */
    Six resultant(const std::vector<CapturedNode<3>> &captured,
                  const SpacePlatenState &platen) const;

    std::array<LoadComponent, 3> components, turns;
    MPI_Comm communicator;
    std::vector<double> node_mass, node_area; /**< see platen_areas() */
    double mass = 0.;
    Matrix inertia; /**< of the arms [kg m^2] */
    Vector offset;  /**< the arm of the centre of mass [m] */

    /** Forces and moments on the platen in the last step by its drive and
        damping, and the velocity before it. */
    Six drive{}, damping{}, velocity_before{};
    double last_unbalanced = 0.;
    bool is_bearing        = false; /**< see bears() */
    /** The normals in the mesh, and forces on nodes, see RigidMotion. */
    std::vector<dealii::Tensor<1, 3>> mesh_normals, own_forces;
    Growth force_growth;
  };

  /** A platen of a model. */
  template <int dim>
  using PlatenOf = std::conditional_t<dim == 2, Platen, SpacePlaten>;
} // namespace quoin

#endif
