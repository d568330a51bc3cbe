// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_model_h
#define quoin_dynamics_model_h

#include <quoin/dynamics/construction_state.h>
#include <quoin/operators/state.h>
#include <quoin/contact/block_contacts.h>
#include <quoin/contact/matched_joints.h>
#include <quoin/blocks/block_forces.h>
#include <quoin/dynamics/rigid_blocks.h>
#include <quoin/blocks/stable_time_step.h>
#include <quoin/joints/joint_parameters.h>
#include <quoin/loads/free_field_boundary.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/loads/viscous_boundary.h>
#include <quoin/materials/material_parameters.h>
#include <quoin/materials/plane_assumption.h>
#include <quoin/mesh/node_map.h>

#include <memory>
#include <vector>

namespace quoin
{
  /** What a model is made of, beside its mesh. */
  struct ModelParameters
  {
    PlaneAssumption plane = PlaneAssumption::plane_strain;
    double thickness      = 1.; /**< [m] */
    std::vector<MaterialParameters> materials;
    std::vector<JointSetParameters> joints;
    std::vector<LoadParameters> initial_stresses;
    /** Physical surfaces that are not there before a stage places them. */
    std::vector<std::string> absent_groups;

    /**
     * Blocks may meet anywhere: the critical step then allows for contacts on
     * all boundary edges instead of for the joints alone.
     */
    bool large_displacements = false;
    ContactParameters contact;
  };

  /** What stages may change of a model; see Model::set_properties(). */
  struct ModelProperties
  {
    std::vector<MaterialParameters> materials;
    std::vector<unsigned int> material_of_group; /**< of physical surfaces */
    std::vector<JointSetParameters> joints;
  };

  /**
   * The blocks and joints of this rank, packed for the solvers and constant
   * from then on, but for what set_properties() changes. Nodes and cells have
   * the local numbers of a NodeMap.
   */
  class Model
  {
  public:
    /**
     * Keeps a reference to @p nodes. Throws an InputError about groups without
     * material and joints without set. Collective.
     */
    Model(const NodeMap<2> &nodes, const ModelParameters &parameters);

    /** What BlockContacts needs, for large displacements. */
    ContactModel contact_model() const;
    const ContactParameters &contact_parameters() const
    {
      return parameters.contact;
    }

    /** Positions at rest, initial joint tractions, what is absent. */
    State<2> initial_state() const;

    const ModelProperties &properties() const
    {
      return now;
    }
    /**
     * Cells and joints follow @p properties from now on, with as many
     * materials and sets as before, each of its kind; what cells bear without
     * strain is that of @p construction. Collective. Stresses jump where
     * stiffnesses change, unless change_properties() keeps them.
     */
    void set_properties(const ModelProperties &properties,
                        const ConstructionState &construction);
    /** The same; stresses and joint tractions of @p state stay. */
    void change_properties(const ModelProperties &properties, State<2> &state);
    /** Cells of @p groups bear nothing without strain from now on. */
    void forget_initial_stress(const std::vector<bool> &groups,
                               ConstructionState &construction);

    /** Of each physical surface, whether @p names has it; throws an
        InputError that begins with @p where. */
    std::vector<bool> find_groups(const std::vector<std::string> &names,
                                  const std::string &where) const;
    /** Whether a block beside joint segment @p segment is absent. */
    bool is_at_absent_block(unsigned int segment, const State<2> &state) const;
    /** Of each local node, whether its block is absent in @p state. */
    std::vector<bool> absent_nodes(const State<2> &state) const;

    const NodeMap<2> &nodes() const
    {
      return node_map;
    }
    const BlockTable<2> &table() const
    {
      return node_map.table();
    }
    const NodeExchange &exchange() const
    {
      return node_map.exchange();
    }
    /** The deformable blocks: their nodes, cells and numbers come first. */
    const BlockForces<2> &blocks() const
    {
      return block_forces;
    }
    const RigidBlocks &rigid_blocks() const
    {
      return rigid;
    }
    /** Owned nodes from this one on are those of rigid blocks. */
    unsigned int n_deformable_nodes() const
    {
      return node_map.n_deformable_nodes();
    }
    /** Owned cells from this one on are those of rigid blocks. */
    unsigned int n_deformable_cells() const
    {
      return node_map.n_deformable_cells();
    }
    bool large_displacements() const
    {
      return parameters.large_displacements;
    }
    const MatchedJoints &joints() const
    {
      return matched_joints;
    }
    MatchedJoints &joints()
    {
      return matched_joints;
    }
    /** Not of quadratic meshes: corners without mass have no stable step. */
    const StableTimeStep<2> &stability() const
    {
      return *stable_step;
    }
    /**
     * Lumped masses of owned nodes and ghosts [kg]; zero at the corners of
     * quadratic triangles.
     */
    const std::vector<double> &mass() const
    {
      return node_mass;
    }
    /** Of each cell group. */
    const std::vector<Impedance> &impedance() const
    {
      return group_impedance;
    }
    /**
     * The same of what lies beyond a viscous boundary: that of the material
     * which @p load names for it, or of the cells there. Throws an InputError.
     */
    std::vector<Impedance> impedance_beyond(const LoadParameters &load) const;
    /** Velocity in the slowest material of deformable blocks [m/s]; infinite:
        there are none. */
    double slowest_shear_wave() const;
    /** What columns beside the blocks are made of. */
    FreeFieldGround free_field_ground() const;
    /** Entry of rigid_blocks() of @p block of the whole mesh, of this rank. */
    unsigned int rigid_number(const unsigned int block) const
    {
      return node_map.find_part(block) - node_map.n_deformable_block_parts();
    }
    /** Local nodes of @p block of the whole mesh; none of another rank's. */
    NodeRange block_nodes(const unsigned int block) const
    {
      const unsigned int part = node_map.find_part(block);
      if (part == node_map.block_parts().size())
        return { 0, 0 };
      const auto &[begin, end] = node_map.block_parts()[part].nodes;
      return { begin, end };
    }
    /** Of each physical surface, whether it is there where the run begins. */
    std::vector<bool> groups_present_at_start() const;

    // Of blocks that this rank owns.

    /** Leaves @p block where it is, without strain and motion. */
    void bring_to_rest(unsigned int block, State<2> &state) const;
    /** Puts @p block where the mesh has it, without strain and motion. */
    void place(unsigned int block, State<2> &state) const;
    /** Makes cells of @p block, which this rank owns, as at the start. */
    void forget_yielding(unsigned int block, PlasticHistory &history) const;
    /** Index into the materials of an owned cell. */
    unsigned int material_of_cell(const unsigned int cell) const
    {
      return now.material_of_group[node_map.group_of_cell(cell)];
    }
    double thickness() const
    {
      return parameters.thickness;
    }

  private:
    void find_materials();
    void find_masses();
    void find_initial_stress();
    std::array<double, 4> initial_stress(const LoadParameters &load,
                                         const dealii::Point<2> &point,
                                         unsigned int group) const;
    AlignedArray<double> packed_initial_stress() const;
    void pack_blocks(const ConstructionState &construction);
    void find_stable_step();
    /** Adds springs of the joints to the bound of the local nodes. */
    void add_joint_bound(std::vector<std::array<double, 3>> &bound) const;
    /** The same with springs wherever blocks may touch. */
    void add_contact_bound(std::vector<std::array<double, 3>> &bound) const;

    const NodeMap<2> &node_map;
    const ModelParameters parameters;

    ModelProperties now;
    std::vector<bool> absent_group; /**< of physical surfaces, at the start */
    std::vector<Impedance> group_impedance;
    std::vector<double> node_mass;
    std::vector<std::array<double, 4>> cell_stress;     /**< or empty */
    std::vector<MatchedJoints::FaceStress> face_stress; /**< or empty */
    BlockForces<2> block_forces;
    RigidBlocks rigid;
    MatchedJoints matched_joints;
    std::unique_ptr<StableTimeStep<2>> stable_step;
  };
} // namespace quoin

#endif
