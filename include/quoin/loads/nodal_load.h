// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_nodal_load_h
#define quoin_loads_nodal_load_h

#include <quoin/base/thickness.h>
#include <quoin/operators/force_operator.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/loads/pressed_joints.h>
#include <quoin/mesh/global_geometry.h>

#include <array>
#include <memory>
#include <vector>

namespace quoin
{
  template <int dim>
  class TractionField;
  template <int dim>
  class WaterPressure;
  class JointCrack;

  /** What a NodalLoad is in all stages. */
  struct NodalLoadTraits
  {
    bool is_gravity = false;
    /** Whether it is gravity that is the same everywhere, in all groups. */
    bool is_everywhere = false;
    /** Whether it is an uplift that changes with the crack of a joint. */
    bool follows_crack = false;
  };

  /**
   * A traction or gravity: forces a(t) w_i on nodes i with fixed weights w_i,
   * the tributary area [m^2] (face_share()) or the mass [kg]. A
   * pressure adds p(t) n_i, with n_i the tributary area times the inward
   * normal. A distribution of the load is a factor of w_i and n_i by the
   * position of the node in the mesh. Tractions that are functions of the place
   * themselves, or have a moving shape, are integrated by a TractionField.
   * Tractions and pressures act on the reference area and keep their
   * direction, but for the pressure of water at rest, which follows the faces:
   * a WaterPressure.
   */
  template <int dim>
  class NodalLoad : public ForceOperator<dim>
  {
  public:
    /** @p mass is that of the local nodes, unscaled [kg]; @p thickness: of
        each cell group. */
    NodalLoad(const LoadParameters &parameters, const NodeMap<dim> &node_map,
              const std::vector<double> &mass, const Thickness &thickness);

    /** Updates the weights of gravity; @p mass as in the constructor. */
    void set_mass(const std::vector<double> &mass);

    /** Lets the headwater of an uplift follow the crack of a joint; null: it
        does not. */
    void set_crack(std::shared_ptr<const JointCrack> opening)
    {
      crack                    = std::move(opening);
      own_traits.follows_crack = crack != nullptr;
    }
    /** Takes from @p state what it depends on: the places of faces below water
        and the crack of an uplift. An uplift that begins in the stage, and
        acts by the share @p released while forces out of balance are released,
        has in the crack no more than this share, too. Collective. */
    void follow(const State<dim> &state, double released = 1.);
    /** Lets water press on its faces where they are in the mesh. */
    void return_to_mesh();
    /**
     * Whether the crack of @p state, in equilibrium with the present uplift, is
     * the one that the uplift is that of. Otherwise the uplift becomes another
     * one, for which there is to be another equilibrium. Collective.
     */
    bool follow_crack(const State<dim> &state);
    void update(const StepContext &, State<dim> &state) override
    {
      follow(state);
    }
    void linearise(State<dim> &state, bool with_stiffness,
                   const TakeElement<dim> &take) const override;
    /** Lets it grow in a stage by half a cosine as @p growth says, also where
        that goes on from the stage before; @p begins: whether the load begins
        in the stage. */
    void begin_stage(const bool begins, const Growth &growth)
    {
      own_growth  = growth;
      begins_here = begins;
    }
    /** Duration of its growth where it begins: that which is given, or @p
        automatic [s]; 0: it is there at once. */
    double ramp_where_begun(const double automatic) const
    {
      return given_ramp >= 0. ? given_ramp : automatic;
    }
    const Growth &growth() const
    {
      return own_growth;
    }
    const NodalLoadTraits &traits() const
    {
      return own_traits;
    }
    /** Joints in which its pressure acts. */
    const PressedJoints &pressed_joints() const
    {
      return own_joints;
    }

    const char *kind() const override
    {
      return "loads";
    }
    void add_loads(const TimePoint &time,
                   dealii::Tensor<1, dim> *force) const override;
    double
    external_power(const TimePoint &time,
                   const dealii::Tensor<1, dim> *velocity) const override;
    bool has_same_power(const TimePoint &one,
                        const TimePoint &other) const override;

    /** Traction x, y, z [Pa] or acceleration [m/s^2], pressure [Pa] and place
        of moving shapes [m]; where they differ from place to place, numbers
        that change when they do, also as faces below water move. */
    std::array<double, 5> amplitude(const TimePoint &time) const;

    const std::string &name() const
    {
      return load_name;
    }

  private:
    /** Calls @p loop with a function from an index to its node, which is a sum
        where the nodes follow on each other, so that compilers find vectors. */
    template <typename Loop>
    auto by_nodes(const Loop &loop) const;

    /** Nodes and weights of a traction, which is no pressure of water that
        follows the faces. */
    void find_areas(const LoadParameters &parameters,
                    const NodeMap<dim> &node_map,
                    const std::vector<BoundaryFace<dim>> &faces,
                    const Thickness &thickness);
    /** Weights and inward areas of a traction with a distribution. */
    void find_distributed_areas(const LoadParameters &parameters,
                                const NodeMap<dim> &node_map,
                                const std::vector<BoundaryFace<dim>> &faces,
                                const Thickness &thickness);
    /** Factors of gravity with a distribution. */
    void find_factors(const LoadParameters &parameters,
                      const NodeMap<dim> &node_map);

    /** Forces of the field on 'nodes' with a share of what the crack adds [N].
     */
    std::vector<dealii::Tensor<1, dim>>
    forces_of_share(const TimePoint &time) const;

    /** Takes over the integration of a load that differs by place. */
    void make_field(const LoadParameters &parameters,
                    const NodeMap<dim> &node_map,
                    const std::vector<BoundaryFace<dim>> &faces,
                    const Thickness &thickness);

    /** Null: the load does not differ by place, but for the distribution. */
    std::shared_ptr<TractionField<dim>> field;
    /** Null: there is no pressure of water that follows the faces. */
    std::shared_ptr<WaterPressure<dim>> water;
    std::shared_ptr<const JointCrack> crack;
    /** Relaxation of follow_crack(), and by how much the crack was longer than
        the uplift took it to be [m]; 0: not known. */
    double relaxation = 1., crack_excess = 0.;
    bool begins_here   = false;
    double crack_share = 1.; /**< of the uplift that the crack adds [-] */
    std::shared_ptr<const MovingShape> shape;
    /** By which its distribution multiplies the mass of each of its nodes: the
        mean over the cells around, weighted by the node's linear function, so
        that of a linear distribution resultant and moment are exact; empty:
        1. */
    std::vector<double> node_factors;
    std::string load_name;
    NodalLoadTraits own_traits;
    std::array<LoadComponent, 3> components;
    LoadComponent pressure;
    std::vector<unsigned int> nodes;
    std::vector<double> weights;
    PressedJoints own_joints;
    double given_ramp; /**< -1: automatic [s] */
    Growth own_growth;
    std::vector<dealii::Tensor<1, dim>>
        inward; /**< n_i [m^2]; empty without pressure */
  };

  /** Normal of a face out of the block, times its length [m] in two dimensions,
      its area [m^2] in three. */
  dealii::Tensor<1, 2>
  outward_area(const std::array<dealii::Point<2>, 2> &points);
  dealii::Tensor<1, 3>
  outward_area(const std::array<dealii::Point<3>, 3> &points);

  /**
   * Boundary faces of the curves or, in three dimensions, surfaces @p names, on
   * all ranks those of all ranks. Collective. Throws an InputError naming
   * @p load if one does not exist or has no outer face.
   */
  template <int dim>
  std::vector<BoundaryFace<dim>>
  faces_of_curves(const NodeMap<dim> &node_map,
                  const std::vector<std::string> &names,
                  const std::string &load, bool with_joints = false);

  /** Groups named @p names; throws an InputError naming @p load. */
  template <int dim>
  std::vector<unsigned int>
  groups_of_names(const NodeMap<dim> &node_map,
                  const std::vector<std::string> &names,
                  const std::string &load);
} // namespace quoin

#endif
