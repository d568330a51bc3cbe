// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_problem_block_system_h
#define quoin_block_problem_block_system_h

#include <quoin/operators/state.h>
#include <quoin/dynamics/construction.h>
#include <quoin/dynamics/explicit_solver.h>
#include <quoin/model/model.h>
#include <quoin/farfield/boundary_geometry.h>
#include <quoin/implicit/implicit_solver.h>
#include <quoin/mesh/mesh_report.h>
#include <quoin/mesh/node_map.h>
#include <quoin/parameters/parameters.h>
#include <quoin/water/joint_flow.h>

#include <memory>
#include <string>

namespace quoin
{
  /** Mesh, model, staged construction and solver of a problem of blocks. */
  template <int dim>
  class BlockSystem
  {
  public:
    /**
     * @p parameters must outlive this object; @p as_read is the mesh on the
     * first rank. Collective. Throws an InputError that begins with the file.
     */
    BlockSystem(const Parameters &parameters, MeshData<dim> as_read,
                MPI_Comm communicator);

    /** State at the start of the run, with initial motion; collective. */
    State<dim> initial_state() const;

    /**
     * Model and solver begin stage @p index with @p state. If @p time_is_known,
     * its start time, loads must not begin with a jump. @p variant: the stage
     * with other damping, or null. Throws an InputError, or a RunError once
     * steps have been taken.
     */
    void begin_stage(unsigned int index, State<dim> &state,
                     bool time_is_known             = true,
                     const StageParameters *variant = nullptr);
    /** Model and solver continue within stage @p index. */
    void resume_stage(unsigned int index, State<dim> &state);
    /** Restores model and solver as after stage @p index - 1. */
    void restore(unsigned int index, const State<dim> &state);

    /** Properties of blocks, joints and general contacts. */
    void set_properties(const ModelProperties &properties,
                        const State<dim> &state);

    /** Number of rigid blocks in the whole model. */
    unsigned int n_rigid_blocks() const;

    const Parameters &parameters;
    const MPI_Comm communicator;
    std::string fingerprint; /**< see run_fingerprint() */
    MeshReport mesh_report;
    std::unique_ptr<BlockTriangulation<dim>> blocks;
    std::unique_ptr<NodeMap<dim>> nodes;
    /** Named blocks with their numbers. */
    std::vector<NamedBlock> named_blocks;
    BoundaryGeometry boundary_geometry;
    std::unique_ptr<Model<dim>> model;
    std::unique_ptr<Construction<dim>> construction;
    /** Water that flows in joints; null: there is none. */
    std::unique_ptr<JointFlow> water;
    std::unique_ptr<Solver<dim>> solver;
    ExplicitSolver<dim> *explicit_solver = nullptr; /**< the solver, or null */
    ImplicitSolver<dim> *implicit_solver = nullptr; /**< the solver, or null */

  private:
    /** Splits and distributes the mesh of the first rank. */
    void make_mesh(MeshData<dim> as_read);
    void make_solver(const MeshData<2> &curves);
    /**
     * The boundary elements beyond the blocks, along @p curves of the mesh as
     * read; fills the geometry. Null if no load is of that type. Throws an
     * InputError that begins with the section.
     */
    std::unique_ptr<FarField> make_far_field(const MeshData<2> &curves);
    /** The static boundary elements of the domain of @p far; null if that is
        null or no static stage names its load. */
    std::unique_ptr<StaticFarField>
    make_static_far_field(const FarField *far) const;
  };

  // Members that exist in two dimensions only.
  template <>
  std::unique_ptr<FarField>
  BlockSystem<2>::make_far_field(const MeshData<2> &curves);
  template <>
  std::unique_ptr<StaticFarField>
  BlockSystem<2>::make_static_far_field(const FarField *far) const;
} // namespace quoin

#endif
