// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_model_h
#define quoin_model_model_h

#include <quoin/base/thickness.h>
#include <quoin/model/construction_state.h>
#include <quoin/operators/state.h>
#include <quoin/contact/block_contacts.h>
#include <quoin/joint_elements/joint_changes.h>
#include <quoin/joint_elements/space_joints.h>
#include <quoin/blocks/block_cells.h>
#include <quoin/blocks/stable_time_step.h>
#include <quoin/blocks/rigid_blocks.h>
#include <quoin/joint_laws/joint_parameters.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/materials/material_parameters.h>
#include <quoin/materials/plane_assumption.h>
#include <quoin/mesh/node_map.h>
#include <quoin/reinforcement/reinforcement.h>

#include <memory>
#include <optional>
#include <vector>

namespace quoin
{
  /** Parameters of a model besides its mesh. */
  struct ModelParameters
  {
    PlaneAssumption plane = PlaneAssumption::plane_strain;
    double thickness = 1.; /**< thickness of materials that give none [m] */
    std::vector<MaterialParameters> materials;
    std::vector<JointSetParameters> joints;
    std::vector<LoadParameters> initial_stresses;
    std::vector<CableParameters> cables;
    /** Physical surfaces that are absent until a stage fills them. */
    std::vector<std::string> absent_groups;

    /**
     * Whether blocks may meet anywhere: the critical step then allows for
     * contacts on all boundary edges instead of for joints alone.
     */
    bool large_displacements = false;
    ContactParameters contact;
  };

  /** Properties that stages may change; see Model::set_properties(). */
  struct ModelProperties
  {
    std::vector<MaterialParameters> materials;
    /** Material of each physical surface. */
    std::vector<unsigned int> material_of_group;
    std::vector<JointSetParameters> joints;
  };

  /** @p properties with the strength of joints and blocks, or of one of the
      two, divided by @p factor. */
  ModelProperties reduced(ModelProperties properties, double factor,
                          bool joints = true, bool blocks = true);

  /**
   * The blocks and joints of this rank, packed for the solvers; constant but
   * for what set_properties() changes. Nodes and cells have the local numbers
   * of a NodeMap.
   *
   * In three dimensions blocks are deformable: rigid_blocks() and what deals
   * with contacts belong to two dimensions.
   */
  template <int dim>
  class Model
  {
  public:
    /**
     * Keeps a reference to @p nodes. Throws an InputError about groups without
     * material, joints without set and materials that may touch without one.
     * Collective.
     */
    Model(const NodeMap<dim> &nodes, const ModelParameters &parameters);
    Model(const Model &) = delete;

    /** State at rest, with initial joint tractions and absent blocks. */
    State<dim> initial_state() const;

    /** Parameters of the start of the run; properties() are those of now. */
    const ModelParameters &parameters() const
    {
      return given;
    }
    const ModelProperties &properties() const
    {
      return now;
    }
    /**
     * Sets the @p properties of cells and joints, with as many materials and
     * sets as before, each of the same kind, and the stress at zero strain of
     * @p construction. Collective. Stresses jump where stiffnesses change; see
     * change_properties().
     */
    void set_properties(const ModelProperties &properties,
                        const ConstructionState<dim> &construction);
    /** Does what set_properties() does and keeps stresses and tractions of @p
     * state. */
    void change_properties(const ModelProperties &properties,
                           State<dim> &state);
    /** Sets the stress at zero strain of the cells of @p groups to zero. */
    void clear_initial_stress(const std::vector<bool> &groups,
                              ConstructionState<dim> &construction);

    const NodeMap<dim> &nodes() const
    {
      return node_map;
    }
    /** Out-of-plane thickness of each physical surface [m]. */
    const Thickness &thickness() const
    {
      return group_thickness;
    }
    /** The deformable blocks: their nodes, cells and numbers come first. */
    const BlockForces<dim> &blocks() const
    {
      return block_forces;
    }
    const RigidBlocks &rigid_blocks() const
    {
      return rigid;
    }
    const JointsOf<dim> &joints() const
    {
      return matched_joints;
    }
    JointsOf<dim> &joints()
    {
      return matched_joints;
    }
    /** Bolts and cables of two dimensions. */
    const Reinforcement &reinforcement() const
    {
      return bars;
    }
    Reinforcement &reinforcement()
    {
      return bars;
    }
    /** Null if displacements are small. */
    const BlockContacts *contacts() const
    {
      return block_contacts.get();
    }
    BlockContacts *contacts()
    {
      return block_contacts.get();
    }
    /** Bound of the critical step; none for quadratic meshes, whose corners
        have no mass. */
    const StableTimeStep<dim> &stability() const
    {
      return *stable_step;
    }
    /** Bound of the critical step with the plastic strains of @p state; of
     * the blocks alone if joints and contacts are not @p with_springs.
     * Collective. */
    StableTimeStep<dim> stability_at(const State<dim> &state,
                                     bool with_springs = true) const;
    /**
     * Lumped masses of owned nodes and ghosts [kg]; zero at the corners of
     * quadratic triangles.
     */
    const std::vector<double> &mass() const
    {
      return node_mass;
    }
    /** Index into the materials of an owned cell. */
    unsigned int material_of_cell(const unsigned int cell) const
    {
      return now.material_of_group[node_map.cells().group[cell]];
    }

  private:
    CellStiffness<dim> stiffness_of(const MaterialParameters &material) const;
    /** Yield laws of @p materials. */
    std::vector<std::optional<YieldLaw<dim>>>
    laws_of(const std::vector<MaterialParameters> &materials) const;
    /** Initial stress by @p load at @p point in a material [Pa]. */
    CellStress<dim> initial_stress_of(const LoadParameters &load,
                                      const dealii::Point<dim> &point,
                                      const LinearElastic &material) const;
    /** Refuses an initial stress of the other dimension, or out of a plane that
        is free. */
    void check_initial_stress(const LoadParameters &load) const;
    void find_materials();
    void find_thickness();
    void find_masses();
    void find_initial_stress();
    AlignedArray<double> packed_initial_stress() const;
    void pack_blocks(const ConstructionState<dim> &construction);
    void find_stable_step();
    void make_contacts();
    /** The operators that bound the stable step. */
    std::vector<const ForceOperator<dim> *> stiff_operators() const;
    /** In what ratio their springs are divided between nodes. Collective. */
    NodeRatio spring_ratio(const State<dim> &state) const;
    /** Adds to both bounds, of owned nodes [N/m] and of rigid blocks [1/s^2],
        what dashpots take of the step. Collective. */
    void add_dashpot_bound(std::vector<NodeStiffness<dim>> &bound,
                           std::vector<double> &rigid_bound) const;

    const NodeMap<dim> &node_map;
    const ModelParameters given;

    ModelProperties now;
    Thickness group_thickness;
    /** Flag of each physical surface at the start. */
    std::vector<bool> absent_group;
    std::vector<double> node_mass;
    /** Stress of each cell; may be empty. */
    std::vector<CellStress<dim>> cell_stress;
    /** Stress of joint faces; may be empty. */
    std::vector<JointFaceStress<dim>> face_stress;
    BlockForces<dim> block_forces;
    RigidBlocks rigid;
    JointsOf<dim> matched_joints;
    Reinforcement bars;
    std::unique_ptr<BlockContacts> block_contacts;
    std::unique_ptr<StableTimeStep<dim>> stable_step;
  };

  template <>
  CellStress<2>
  Model<2>::initial_stress_of(const LoadParameters &load,
                              const dealii::Point<2> &point,
                              const LinearElastic &material) const;
  template <>
  CellStress<3>
  Model<3>::initial_stress_of(const LoadParameters &load,
                              const dealii::Point<3> &point,
                              const LinearElastic &material) const;
  template <>
  void Model<2>::check_initial_stress(const LoadParameters &load) const;
  template <>
  void Model<3>::check_initial_stress(const LoadParameters &load) const;

  template <>
  NodeRatio Model<2>::spring_ratio(const State<2> &state) const;
  template <>
  NodeRatio Model<3>::spring_ratio(const State<3> &state) const;

  // Members that exist in two dimensions only.
  template <>
  void Model<2>::make_contacts();
  template <>
  void Model<2>::add_dashpot_bound(std::vector<NodeStiffness<2>> &bound,
                                   std::vector<double> &rigid_bound) const;
} // namespace quoin

#endif
