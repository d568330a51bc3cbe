// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_model_model_h
#define quoin_model_model_h

#include <quoin/model/construction_state.h>
#include <quoin/operators/state.h>
#include <quoin/contact/block_contacts.h>
#include <quoin/contact/matched_joints.h>
#include <quoin/blocks/block_cells.h>
#include <quoin/blocks/stable_time_step.h>
#include <quoin/blocks/rigid_blocks.h>
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
  /** Parameters of a model besides its mesh. */
  struct ModelParameters
  {
    PlaneAssumption plane = PlaneAssumption::plane_strain;
    double thickness      = 1.; /**< [m] */
    std::vector<MaterialParameters> materials;
    std::vector<JointSetParameters> joints;
    std::vector<LoadParameters> initial_stresses;
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
    std::vector<unsigned int> material_of_group; /**< of physical surfaces */
    std::vector<JointSetParameters> joints;
  };

  /**
   * The blocks and joints of this rank, packed for the solvers; constant but
   * for what set_properties() changes. Nodes and cells have the local numbers
   * of a NodeMap.
   *
   * In three dimensions blocks are deformable and linear elastic and have no
   * joints: joints(), rigid_blocks() and what deals with contacts, stages of
   * construction and initial stress belong to two dimensions.
   */
  template <int dim>
  class Model
  {
  public:
    /**
     * Keeps a reference to @p nodes. Throws an InputError about groups without
     * material and joints without set. Collective.
     */
    Model(const NodeMap<dim> &nodes, const ModelParameters &parameters);

    /** Data of BlockContacts, for large displacements. */
    ContactModel contact_model() const;
    const ContactParameters &contact_parameters() const
    {
      return parameters.contact;
    }

    /** State at rest, with initial joint tractions and absent blocks. */
    State<dim> initial_state() const;

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
                        const ConstructionState &construction);
    /** As set_properties(), with stresses and tractions of @p state kept. */
    void change_properties(const ModelProperties &properties,
                           State<dim> &state);
    /** Sets the stress at zero strain of the cells of @p groups to zero. */
    void clear_initial_stress(const std::vector<bool> &groups,
                              ConstructionState &construction);

    /** Whether @p names has each physical surface; throws an InputError that
        begins with @p where. */
    std::vector<bool> find_groups(const std::vector<std::string> &names,
                                  const std::string &where) const;
    /** Whether a block beside joint segment @p segment is absent. */
    bool is_at_absent_block(unsigned int segment,
                            const State<dim> &state) const;
    /** Whether the block of each local node is absent in @p state. */
    std::vector<bool> absent_nodes(const State<dim> &state) const;

    const NodeMap<dim> &nodes() const
    {
      return node_map;
    }
    const BlockTable<dim> &table() const
    {
      return node_map.table();
    }
    const NodeExchange &exchange() const
    {
      return node_map.exchange();
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
    /** First owned node of rigid blocks. */
    unsigned int n_deformable_nodes() const
    {
      return node_map.n_deformable_nodes();
    }
    /** First owned cell of rigid blocks. */
    unsigned int n_deformable_cells() const
    {
      return node_map.cells().n_deformable;
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
    /** Bound of the step; none for quadratic meshes (corners without mass). */
    const StableTimeStep<dim> &stability() const
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
    /** Impedances of each cell group [Pa s/m]. */
    const std::vector<Impedance> &impedance() const
    {
      return group_impedance;
    }
    /**
     * Impedances beyond a viscous boundary: those of the material that @p load
     * names, or of the cells there. Throws an InputError.
     */
    std::vector<Impedance> impedance_beyond(const LoadParameters &load) const;
    /** Lowest S wave velocity of deformable blocks [m/s]; infinite: there are
        none. */
    double slowest_shear_wave() const;
    /** Materials of the columns of free-field boundaries. */
    FreeFieldGround free_field_ground() const;
    /** Index into rigid_blocks() of this rank of @p block of the mesh. */
    unsigned int rigid_number(const unsigned int block) const
    {
      return node_map.blocks().find(block) - node_map.blocks().n_deformable;
    }
    /** Nodes of @p block of the whole mesh that this rank owns. */
    std::vector<unsigned int> owned_nodes(unsigned int block) const;
    /** Local nodes of @p block without those that other ranks share. */
    NodeRange block_nodes(const unsigned int block) const
    {
      const unsigned int part = node_map.blocks().find(block);
      if (part == node_map.blocks().parts.size())
        return { 0, 0 };
      const auto &[begin, end] = node_map.blocks().parts[part].nodes;
      return { begin, end };
    }
    /** Whether each physical surface is present at the start of the run. */
    std::vector<bool> groups_present_at_start() const;

    // In these functions @p blocks are numbers in the whole mesh.

    /** Leaves @p blocks where they are, without strain and motion. Collective.
     */
    void bring_to_rest(const std::vector<unsigned int> &blocks,
                       State<dim> &state) const;
    /** Puts @p blocks in their reference position, without strain and motion.
        Collective. */
    void place(const std::vector<unsigned int> &blocks,
               State<dim> &state) const;
    /** Resets the internal variables of the cells of @p block on this rank. */
    void reset_plasticity(unsigned int block, PlasticHistory &history) const;
    /** Index into the materials of an owned cell. */
    unsigned int material_of_cell(const unsigned int cell) const
    {
      return now.material_of_group[node_map.cells().group[cell]];
    }
    double thickness() const
    {
      return parameters.thickness;
    }

  private:
    CellStiffness<dim> stiffness_of(const MaterialParameters &material) const;
    void find_materials();
    void find_masses();
    void find_initial_stress();
    AlignedArray<double> packed_initial_stress() const;
    void pack_blocks(const ConstructionState &construction);
    void find_stable_step();
    /** Adds springs of the joints to the bound of the local nodes. */
    void add_joint_bound(const State<dim> &state,
                         std::vector<NodeStiffness<dim>> &bound) const;
    /** Adds springs wherever blocks may touch. */
    void add_contact_bound(std::vector<NodeStiffness<dim>> &bound) const;

    const NodeMap<dim> &node_map;
    const ModelParameters parameters;

    ModelProperties now;
    std::vector<bool> absent_group; /**< of physical surfaces, at the start */
    std::vector<Impedance> group_impedance;
    std::vector<double> node_mass;
    std::vector<std::array<double, 4>> cell_stress;     /**< or empty */
    std::vector<MatchedJoints::FaceStress> face_stress; /**< or empty */
    BlockForces<dim> block_forces;
    RigidBlocks rigid;
    MatchedJoints matched_joints;
    std::unique_ptr<StableTimeStep<dim>> stable_step;
  };

  // Members that exist in two dimensions only.
  template <>
  void Model<2>::add_joint_bound(const State<2> &state,
                                 std::vector<NodeStiffness<2>> &bound) const;
  template <>
  void Model<2>::add_contact_bound(std::vector<NodeStiffness<2>> &bound) const;
  template <>
  void Model<2>::find_initial_stress();
  template <>
  AlignedArray<double> Model<2>::packed_initial_stress() const;
  template <>
  void Model<2>::set_properties(const ModelProperties &properties,
                                const ConstructionState &construction);
  template <>
  void Model<2>::change_properties(const ModelProperties &properties,
                                   State<2> &state);
  template <>
  void Model<2>::clear_initial_stress(const std::vector<bool> &groups,
                                      ConstructionState &construction);
  template <>
  bool Model<2>::is_at_absent_block(unsigned int segment,
                                    const State<2> &state) const;
  template <>
  void Model<2>::bring_to_rest(const std::vector<unsigned int> &blocks,
                               State<2> &state) const;
  template <>
  void Model<2>::place(const std::vector<unsigned int> &blocks,
                       State<2> &state) const;
  template <>
  void Model<2>::reset_plasticity(unsigned int block,
                                  PlasticHistory &history) const;
} // namespace quoin

#endif
