// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_model_h
#define quoin_dynamics_model_h

#include <quoin/base/node_exchange.h>
#include <quoin/base/state.h>
#include <quoin/contact/block_contacts.h>
#include <quoin/contact/matched_joints.h>
#include <quoin/dynamics/block_forces.h>
#include <quoin/dynamics/rigid_blocks.h>
#include <quoin/dynamics/stable_time_step.h>
#include <quoin/joints/joint_parameters.h>
#include <quoin/loads/free_field_boundary.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/loads/viscous_boundary.h>
#include <quoin/materials/material_parameters.h>
#include <quoin/materials/plane_assumption.h>
#include <quoin/mesh/block_mesh.h>

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

    /**
     * Blocks may meet anywhere: the critical step then allows for contacts on
     * all boundary edges instead of for the joints alone.
     */
    bool large_displacements = false;
    ContactParameters contact;
  };

  /**
   * The blocks and joints of this rank, packed for the explicit solver and
   * constant from then on. Nodes, cells and blocks have local numbers: whole
   * blocks, deformable ones first, then rigid ones, then the ghosts of nodes
   * that joints reach.
   */
  class Model
  {
  public:
    /**
     * Blocks of @p mesh are owned by the rank that @p rank_of_block names;
     * those of a rank must be consecutive, its rigid ones last, and ranks
     * ascending. Keeps a reference to the mesh. Throws an InputError about
     * groups without material and joints without set.
     */
    Model(const BlockMesh<2> &mesh,
          const std::vector<unsigned int> &rank_of_block,
          const ModelParameters &parameters, MPI_Comm communicator);

    /** What BlockContacts needs, for large displacements. */
    ContactModel contact_model() const;
    const ContactParameters &contact_parameters() const
    {
      return parameters.contact;
    }

    /** Positions at rest, initial joint tractions. */
    State initial_state() const;

    const BlockMesh<2> &mesh() const
    {
      return block_mesh;
    }
    const NodeExchange &exchange() const
    {
      return *nodes;
    }
    /** The deformable blocks: their nodes, cells and numbers come first. */
    const BlockForces &blocks() const
    {
      return block_forces;
    }
    const RigidBlocks &rigid_blocks() const
    {
      return rigid;
    }
    /** Of the whole mesh, by the number of the block. */
    const std::vector<bool> &is_rigid() const
    {
      return rigid_block;
    }
    /** Owned nodes from this one on are those of rigid blocks. */
    unsigned int n_deformable_nodes() const
    {
      return block_mesh.block_first_vertex[rigid_begin]
             - block_mesh.block_first_vertex[block_begin];
    }
    /** Owned cells from this one on are those of rigid blocks. */
    unsigned int n_deformable_cells() const
    {
      return block_mesh.block_first_cell[rigid_begin] - first_cell();
    }
    bool large_displacements() const
    {
      return parameters.large_displacements;
    }
    const MatchedJoints &joints() const
    {
      return matched_joints;
    }
    /** Not of quadratic meshes: corners without mass have no stable step. */
    const StableTimeStep &stability() const
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
    /** What columns beside the blocks are made of. */
    FreeFieldGround free_field_ground() const;
    unsigned int first_block() const
    {
      return block_begin;
    }
    unsigned int n_blocks() const
    {
      return block_end - block_begin;
    }
    /** Local nodes of @p block of the whole mesh, which this rank owns. */
    NodeRange block_nodes(const unsigned int block) const
    {
      const auto &first = block_mesh.block_first_vertex;
      return { first[block] - first[block_begin],
               first[block + 1] - first[block_begin] };
    }
    /** Makes cells of @p block, which this rank owns, as at the start. */
    void forget_yielding(unsigned int block, PlasticHistory &history) const;
    unsigned int first_cell() const
    {
      return block_mesh.block_first_cell[block_begin];
    }
    unsigned int n_cells() const
    {
      return block_mesh.block_first_cell[block_end] - first_cell();
    }
    /** Owned cells with local node numbers. */
    const std::vector<std::array<unsigned int, 3>> &cells() const
    {
      return local_cells;
    }
    /** Index into the materials of a cell of the whole mesh. */
    unsigned int material_of_cell(const unsigned int cell) const
    {
      return material_of_group[block_mesh.cell_group[cell]];
    }
    double thickness() const
    {
      return parameters.thickness;
    }

  private:
    void find_materials();
    void find_blocks(const std::vector<unsigned int> &rank_of_block,
                     MPI_Comm communicator);
    void find_masses();
    void find_initial_stress();
    void pack_blocks();
    void find_stable_step();
    /** Adds springs of the joints to the bound of the local nodes. */
    void add_joint_bound(std::vector<std::array<double, 3>> &bound) const;
    /** The same with springs wherever blocks may touch. */
    void add_contact_bound(std::vector<std::array<double, 3>> &bound) const;

    const BlockMesh<2> &block_mesh;
    const ModelParameters parameters;

    std::vector<unsigned int> material_of_group;
    std::vector<Impedance> group_impedance;
    unsigned int block_begin, rigid_begin, block_end;
    std::vector<bool> rigid_block;
    std::unique_ptr<NodeExchange> nodes;
    std::vector<double> node_mass;
    std::vector<std::array<unsigned int, 3>> local_cells;
    std::vector<std::array<double, 4>> cell_stress; /**< or empty */
    BlockForces block_forces;
    RigidBlocks rigid;
    MatchedJoints matched_joints;
    std::unique_ptr<StableTimeStep> stable_step;
  };
} // namespace quoin

#endif
