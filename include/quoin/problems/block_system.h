// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_block_system_h
#define quoin_problems_block_system_h

#include <quoin/operators/state.h>
#include <quoin/dynamics/construction.h>
#include <quoin/dynamics/explicit_solver.h>
#include <quoin/dynamics/model.h>
#include <quoin/farfield/boundary_geometry.h>
#include <quoin/implicit/implicit_solver.h>
#include <quoin/mesh/mesh_report.h>
#include <quoin/mesh/node_map.h>
#include <quoin/problems/parameters.h>

#include <memory>
#include <string>

namespace quoin
{
  /**
   * Mesh, model, stages of construction and solver of a problem of blocks, as
   * the parameters say.
   */
  class BlockSystem
  {
  public:
    /**
     * @p parameters must outlive this object. Collective. Throws an InputError
     * that begins with the file.
     */
    BlockSystem(const Parameters &parameters, MPI_Comm communicator);

    /** At the begin of the run, with the initial motion; collective. */
    State<2> initial_state() const;

    /**
     * Model and solver begin stage @p index with @p state; loads are not to
     * begin with a jump, as far as its time is known, @p time_is_known.
     * Throws an InputError, or a RunError once steps have been taken.
     */
    void begin_stage(unsigned int index, State<2> &state,
                     bool time_is_known = true);
    /** Model and solver go on within stage @p index. */
    void resume_stage(unsigned int index, State<2> &state);
    /** Model and solver are left as after stage @p index - 1. */
    void restore(unsigned int index, const State<2> &state);

    /** Properties of blocks, joints and general contacts. */
    void set_properties(const ModelProperties &properties,
                        const State<2> &state);

    /** Number of rigid blocks in the whole model. */
    unsigned int n_rigid_blocks() const;

    const Parameters &parameters;
    const MPI_Comm communicator;
    std::string fingerprint; /**< see run_fingerprint() */
    MeshReport mesh_report;
    std::unique_ptr<BlockTriangulation<2>> blocks;
    std::unique_ptr<NodeMap<2>> nodes;
    BoundaryGeometry boundary_geometry;
    std::unique_ptr<Model> model;
    std::unique_ptr<Construction> construction;
    std::unique_ptr<Solver> solver;
    ExplicitSolver *explicit_solver = nullptr; /**< the solver, or null */
    ImplicitSolver *implicit_solver = nullptr; /**< the solver, or null */

  private:
    /** Splits and distributes the mesh of the first rank. */
    void make_mesh(MeshData as_read);
    void make_solver(const MeshData &curves);
    /**
     * The boundary elements beyond the blocks, along @p curves of the mesh as
     * read; fills the geometry. Null if no load is of that type. Throws an
     * InputError that begins with the section.
     */
    std::unique_ptr<FarField> make_far_field(const MeshData &curves);
    /** The same at rest, of the domain of @p far; null if that is null or no
        static stage names its load. */
    std::unique_ptr<StaticFarField>
    make_static_far_field(const FarField *far) const;
  };
} // namespace quoin

#endif
