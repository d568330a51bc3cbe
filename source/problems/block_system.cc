// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/block_numbering.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/problems/block_system.h>
#include <quoin/problems/far_field_setup.h>
#include <quoin/problems/problem.h>
#include <quoin/problems/run_fingerprint.h>
#include <quoin/results/collective.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    MeshData read_mesh_data(const Parameters &parameters,
                            const MPI_Comm communicator)
    {
      const GeneratedGeometry &made = parameters.generated;
      return made.geometry.empty()
                 ? read_gmsh(parameters.mesh_file, communicator,
                             parameters.triangles)
                 : mesh_gmsh_geometry(made.geometry,
                                      made.name == "wall" ? "section Wall"
                                                          : "section Rock",
                                      communicator, parameters.triangles);
    }
  } // namespace

  BlockSystem::BlockSystem(const Parameters &parameters,
                           const MPI_Comm communicator)
    : parameters(parameters), communicator(communicator)
  {
    const MeshData as_read = read_mesh_data(parameters, communicator);
    fingerprint            = run_fingerprint(parameters, as_read);
    split_into_blocks(as_read, parameters.split, mesh);
    mesh_report = make_mesh_report(mesh);
    naming(parameters.file,
           [&]()
           {
             make_model();
             construction
                 = std::make_unique<Construction>(*model, parameters.stages);
             make_solver(as_read);
           });
  }

  void BlockSystem::make_model()
  {
    // Whole blocks to ranks: blocks share no nodes, only joints cross ranks.
    auto rank_of_block = partition_blocks(
        mesh, dealii::Utilities::MPI::n_mpi_processes(communicator));
    renumber_blocks(mesh, order_by_part(rank_of_block,
                                        find_rigid_blocks(
                                            mesh, parameters.model.materials)));
    std::sort(rank_of_block.begin(), rank_of_block.end());
    model = std::make_unique<Model>(mesh, rank_of_block, parameters.model,
                                    communicator);
  }

  void BlockSystem::make_solver(const MeshData &as_read)
  {
    auto far = make_far_field(parameters, as_read, *model, boundary_geometry);
    auto static_far = make_static_far_field(parameters, *model, far.get());
    if (parameters.is_implicit)
    {
      std::vector<std::string> joint_sets;
      for (const JointSetParameters &set : parameters.model.joints)
        joint_sets.push_back(set.name);
      auto made = std::make_unique<ImplicitSolver>(
          *model, parameters.loads, parameters.implicit, joint_sets,
          std::move(static_far));
      implicit_solver = made.get();
      solver          = std::move(made);
      return;
    }
    auto made = std::make_unique<ExplicitSolver>(
        *model, parameters.loads, parameters.stages, std::move(far),
        std::move(static_far));
    explicit_solver = made.get();
    solver          = std::move(made);
  }

  State<2> BlockSystem::initial_state() const
  {
    State<2> state = model->initial_state();
    if (parameters.initial_motion.is_given)
      naming(parameters.file,
             [&]()
             {
               all_or_none<InputError>(
                   communicator,
                   [&]() { parameters.initial_motion.apply(state); });
               explicit_solver->account_for_initial_motion(state);
             });
    return state;
  }

  void BlockSystem::begin_stage(const unsigned int index, State<2> &state,
                                const bool time_is_known)
  {
    const StageParameters &stage    = parameters.stages[index];
    const StageParameters *previous = previous_stage(parameters.stages, index);
    try
    {
      construction->begin_stage(index, *solver, state);
      if (implicit_solver)
        implicit_solver->begin_stage(stage, previous, state);
      else
        explicit_solver->begin_stage(stage, previous, state);
      if (time_is_known)
        solver->check_start(state);
    }
    catch (const InputError &error)
    {
      const std::string what = parameters.file + ", " + error.what();
      // Wrong input is what is found before anything is computed.
      if (state.step > 0)
        throw RunError(what);
      throw InputError(what);
    }
  }

  void BlockSystem::resume_stage(const unsigned int index, State<2> &state)
  {
    construction->resume_stage(index, state);
    if (implicit_solver)
      implicit_solver->resume_stage(parameters.stages[index], state);
    else
      explicit_solver->resume_stage(parameters.stages[index], state);
  }

  void BlockSystem::restore(const unsigned int index, const State<2> &state)
  {
    if (index == 0)
      return;
    construction->resume_stage(index - 1, state);
    if (explicit_solver)
      explicit_solver->restore_masses(*previous_stage(parameters.stages, index),
                                      state);
  }

  void BlockSystem::set_properties(const ModelProperties &properties,
                                   const State<2> &state)
  {
    model->set_properties(properties, state.construction);
    if (explicit_solver)
      explicit_solver->set_contact_laws(properties.joints);
  }

  unsigned int BlockSystem::n_rigid_blocks() const
  {
    return std::count(model->is_rigid().begin(), model->is_rigid().end(), true);
  }
} // namespace quoin
