// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_model_h
#define quoin_model_model_h

#include <quoin/base/thickness.h>
#include <quoin/model/construction_state.h>
#include <quoin/model/initial_stress.h>
#include <quoin/operators/state.h>
#include <quoin/contact/block_contacts.h>
#include <quoin/joint_elements/joint_changes.h>
#include <quoin/joint_elements/space_joints.h>
#include <quoin/blocks/block_cells.h>
#include <quoin/blocks/rigid_blocks.h>
#include <quoin/joint_laws/joint_parameters.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/materials/material_parameters.h>
#include <quoin/materials/plane_assumption.h>
#include <quoin/mesh/node_map.h>
#include <quoin/reinforcement/reinforcement.h>

#include <cstdint>
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

  /** The operators beside the blocks, of which some change as they act. */
  template <int dim>
  struct ModelOperators
  {
    BlockContacts *contacts; /**< null if displacements are small */
    JointsOf<dim> *joints;
    Reinforcement *bars; /**< null: no bolts and cables */
  };

  /** @p properties with the strength of joints and blocks, or of one of the
      two, divided by @p factor. */
  ModelProperties reduced(ModelProperties properties, double factor,
                          bool joints = true, bool blocks = true);

  /** Stiffness of cells of @p material. */
  template <int dim>
  CellStiffness<dim> stiffness_of(const MaterialParameters &material,
                                  PlaneAssumption plane);

  /** Yield laws of @p materials, none of those that are elastic. */
  template <int dim>
  std::vector<std::optional<YieldLaw<dim>>>
  laws_of(const std::vector<MaterialParameters> &materials,
          PlaneAssumption plane);

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
     * @p construction. Collective. Stresses jump where stiffnesses change, but
     * for change_properties() (model_changes.h).
     */
    void set_properties(const ModelProperties &properties,
                        const ConstructionState<dim> &construction);
    /** Sets the blocks that loads hold or move in a stage (block of the mesh:
        nonzero), which is for dashpots and stability_at(). Collective. */
    void set_held_blocks(const std::vector<std::uint8_t> &is_held);
    bool is_held(const unsigned int block) const
    {
      return !held_blocks.empty() && held_blocks[block];
    }
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
    /** Bolts and cables of two dimensions. */
    const Reinforcement &reinforcement() const
    {
      return bars;
    }
    /** Null if displacements are small. */
    const BlockContacts *contacts() const
    {
      return block_contacts.get();
    }
    ModelOperators<dim> operators()
    {
      return { block_contacts.get(), &matched_joints,
               bars.empty() ? nullptr : &bars };
    }
    /**
     * Lumped masses of owned nodes and ghosts [kg]; zero at the corners of
     * quadratic triangles.
     */
    const std::vector<double> &mass() const
    {
      return node_mass;
    }

  private:
    void find_materials();
    void find_thickness();
    void find_masses();
    void pack_blocks(const ConstructionState<dim> &construction);
    void make_contacts();

    const NodeMap<dim> &node_map;
    const ModelParameters given;

    ModelProperties now;
    Thickness group_thickness;
    /** Flag of each physical surface at the start. */
    std::vector<bool> absent_group;
    std::vector<double> node_mass;
    InitialStress<dim> start_stress;
    BlockForces<dim> block_forces;
    RigidBlocks rigid;
    JointsOf<dim> matched_joints;
    Reinforcement bars;
    std::unique_ptr<BlockContacts> block_contacts;
    std::vector<std::uint8_t> held_blocks; /**< of the mesh; empty: none */
  };

  // A member that exists in two dimensions only.
  template <>
  void Model<2>::make_contacts();

  /** Index into the materials of an owned @p cell. */
  template <int dim>
  unsigned int material_of_cell(const Model<dim> &model,
                                const unsigned int cell)
  {
    return model.properties()
        .material_of_group[model.nodes().cells().group[cell]];
  }
} // namespace quoin

#endif
