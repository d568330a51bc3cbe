// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/point_text.h>
#include <quoin/dynamics/initial_block_motion.h>
#include <quoin/dynamics/initial_energy.h>
#include <quoin/farfield/boundary_values.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/mesh/block_numbering.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/mesh/partition.h>
#include <quoin/block_problem/block_system.h>
#include <quoin/problems/problem.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    /** The blocks' faces at boundary elements of the load @p name, which
        continue blocks of their thickness alone. Collective. */
    std::vector<BoundaryFace<2>>
    interface_faces(const Model<2> &model,
                    const BoundaryElementParameters &settings,
                    const std::string &name)
    {
      auto faces
          = faces_of_curves(model.nodes(), settings.interface_curves(), name);
      const ModelProperties &properties = model.properties();
      const double thickness            = model.parameters().thickness;
      for (const BoundaryFace<2> &face : faces)
      {
        const MaterialParameters &material
            = properties.materials[properties.material_of_group[face.group]];
        if (material.thickness != thickness)
          throw InputError(
              text_of("the load '", name,
                      "' continues the model of 'Thickness = ", thickness,
                      "' [m], but meets blocks of 'Materials/", material.name,
                      "' with 'Thickness = ", material.thickness, "' at ",
                      point_text(face.points[0]),
                      " m. Leave the latter empty, or give "
                      "the blocks there a material of their own."));
      }
      return faces;
    }
  } // namespace

  template <int dim>
  BlockSystem<dim>::BlockSystem(const Parameters &parameters,
                                MeshData<dim> as_read,
                                const MPI_Comm communicator)
    : parameters(parameters), communicator(communicator),
      named_blocks(parameters.named_blocks)
  {
    MeshData<2> curves;
    if constexpr (dim == 2)
      curves
          = dealii::Utilities::MPI::broadcast(communicator, curves_of(as_read));
    make_mesh(std::move(as_read));
    naming(parameters.file,
           [&]()
           {
             model = std::make_unique<Model<dim>>(*nodes, parameters.model);
             if constexpr (dim == 2)
               find_named_blocks(*nodes, named_blocks);
             construction = std::make_unique<Construction<dim>>(
                 *model, parameters.stages);
             make_solver(curves);
             if constexpr (dim == 2)
             {
               if (parameters.water.flow != FlowKind::none)
               {
                 water = std::make_unique<JointFlow>(
                     parameters.water, *nodes, model->joints(),
                     parameters.model.joints, model->thickness());
                 solver->loads().water = water.get();
               }
               if (!parameters.beams.empty())
                 solver->loads().beams = std::make_unique<Beams>(
                     parameters.beams, *nodes, parameters.model.joints,
                     parameters.model.thickness, model->thickness());
             }
           });
  }

  namespace
  {
    /** Refuses blocks that overlap so deep that contacts would not find each
        other, or push them apart like springs. */
    void refuse_overlap(const MeshReport &report)
    {
      /** By the shortest edge [-]. */
      constexpr double most = 0.01;
      if (report.overlaps && report.overlap_depth > most * report.shortest_edge)
        throw InputError(
            "section 'Mesh': " + report.overlap_text()
            + ". With 'Displacements = large' of section 'Contact' they would "
              "pass through each other or be pushed apart. "
            + report.overlap_cure());
    }
  } // namespace

  template <int dim>
  void BlockSystem<dim>::make_mesh(MeshData<dim> as_read)
  {
    using dealii::Utilities::MPI::broadcast;
    using dealii::Utilities::MPI::n_mpi_processes;
    using dealii::Utilities::MPI::this_mpi_process;
    // The first rank alone has the whole mesh, until it is distributed.
    BlockMesh<dim> mesh;
    std::vector<bool> is_rigid;
    std::vector<unsigned int> rank_of_cell;
    all_or_none<InputError>(
        communicator,
        [&]()
        {
          if (this_mpi_process(communicator) != 0)
            return;
          fingerprint = run_fingerprint(parameters, as_read);
          mesh        = split_into_blocks(as_read, parameters.split);
          as_read     = MeshData<dim>();
          mesh_report = make_mesh_report(mesh);
          if (parameters.model.large_displacements)
          {
            mesh_report.unmatched_touch = true;
            if (parameters.model.absent_groups.empty())
              refuse_overlap(mesh_report);
          }
          const auto &materials = parameters.model.materials;
          naming(parameters.file,
                 [&]()
                 {
                   if constexpr (dim == 2)
                     renumber_blocks(mesh, order_rigid_last(find_rigid_blocks(
                                               mesh, materials)));
                   is_rigid = find_rigid_blocks(mesh, materials);
                 });
          rank_of_cell
              = partition_cells(mesh, is_rigid, n_mpi_processes(communicator));
        });
    fingerprint = broadcast(communicator, fingerprint);
    mesh_report = broadcast(communicator, mesh_report);
    blocks      = std::make_unique<BlockTriangulation<dim>>(mesh, rank_of_cell,
                                                       is_rigid, communicator);
    std::vector<typename NodeMap<dim>::Segment> segments;
    if constexpr (dim == 2)
      for (const auto &[a, b] : all_bars(parameters.model.cables))
        segments.push_back({ { { a[0], a[1] }, { b[0], b[1] } } });
    nodes = std::make_unique<NodeMap<dim>>(*blocks, segments);
  }

  template <int dim>
  void BlockSystem<dim>::make_solver(const MeshData<2> &curves)
  {
    std::unique_ptr<FarField> far;
    std::unique_ptr<StaticFarField> static_far;
    if constexpr (dim == 2)
    {
      far        = make_far_field(curves);
      static_far = make_static_far_field(far.get());
    }
    std::vector<LoadParameters> loads;
    for (const LoadParameters &load : parameters.loads)
      loads.push_back(load.along_axes<dim>());
    if (parameters.is_implicit)
    {
      std::vector<std::string> joint_sets;
      for (const JointSetParameters &set : parameters.model.joints)
        joint_sets.push_back(set.name);
      auto made = std::make_unique<ImplicitSolver<dim>>(
          *model, loads, parameters.implicit, joint_sets,
          std::move(static_far));
      implicit_solver = made.get();
      solver          = std::move(made);
      return;
    }
    auto made = std::make_unique<ExplicitSolver<dim>>(
        *model, loads, parameters.stages, std::move(far),
        std::move(static_far));
    explicit_solver = made.get();
    if (parameters.takes_assembled_step)
      explicit_solver->take_assembled_step();
    solver = std::move(made);
  }

  template <>
  std::unique_ptr<FarField>
  BlockSystem<2>::make_far_field(const MeshData<2> &curves)
  {
    const auto load
        = std::find_if(parameters.loads.begin(), parameters.loads.end(),
                       [](const LoadParameters &candidate) {
                         return candidate.type == LoadType::boundary_elements;
                       });
    if (load == parameters.loads.end())
      return nullptr;

    const BoundaryElementParameters &settings = parameters.boundary;
    boundary_geometry     = make_boundary_geometry(settings, curves);
    FarFieldDomain domain = far_field_domain(boundary_geometry, settings);
    try
    {
      return std::make_unique<FarField>(
          load->name, std::move(domain), *nodes,
          interface_faces(*model, settings, load->name),
          model->parameters().thickness);
    }
    catch (const InputError &error)
    {
      throw InputError(std::string("section 'Boundary elements': ")
                       + error.what());
    }
  }

  template <>
  std::unique_ptr<StaticFarField>
  BlockSystem<2>::make_static_far_field(const FarField *far) const
  {
    const auto needs_it = [&](const StageParameters &stage)
    {
      return (stage.end == StageEnd::static_ratio || parameters.is_implicit)
             && names_load(stage, far->name());
    };
    if (!far
        || std::none_of(parameters.stages.begin(), parameters.stages.end(),
                        needs_it))
      return nullptr;
    return std::make_unique<StaticFarField>(
        far->name(), far->domain(), *nodes,
        interface_faces(*model, parameters.boundary, far->name()),
        model->parameters().thickness);
  }

  template <int dim>
  State<dim> BlockSystem<dim>::initial_state() const
  {
    State<dim> state = model->initial_state();
    solver->prepare(state);
    const bool blocks_move
        = std::any_of(named_blocks.begin(), named_blocks.end(),
                      [](const NamedBlock &block) { return block.moves(); });
    if (parameters.initial_motion.is_given() || blocks_move)
      naming(parameters.file,
             [&]()
             {
               if (parameters.initial_motion.is_given())
                 all_or_none<InputError>(
                     communicator,
                     [&]() { parameters.initial_motion.apply(*nodes, state); });
               refuse_moved_rigid_blocks(*model, state);
               if constexpr (dim == 2)
                 start_blocks(named_blocks, *model, *solver,
                              parameters.stages.front(), state);
               account_for_initial_motion(*model, state);
             });
    return state;
  }

  template <int dim>
  void BlockSystem<dim>::begin_stage(const unsigned int index,
                                     State<dim> &state,
                                     const bool time_is_known,
                                     const StageParameters *variant)
  {
    const StageParameters &stage
        = variant ? *variant : parameters.stages[index];
    const StageParameters *previous = previous_stage(parameters.stages, index);
    try
    {
      double power = 0.;
      // Nodes of blocks that are taken away move.
      AlignedArray<NodeRecord<dim>> nodes_before;
      if constexpr (dim == 2)
      {
        power = model->reinforcement().end_stage(state);
        if (!model->reinforcement().empty())
          nodes_before = state.nodes;
      }
      construction->begin_stage(index, *solver, state);
      if constexpr (dim == 2)
        if (!model->reinforcement().empty())
        {
          AlignedArray<dealii::Tensor<1, dim>> released(
              state.nodes.size(), dealii::Tensor<1, dim>());
          model->reinforcement().begin_stage(stage.name, index == 0, power,
                                             state, released.data(),
                                             nodes_before.data());
          construction->hold(index, released, state);
        }
      if (implicit_solver)
        implicit_solver->begin_stage(stage, previous, state);
      if (explicit_solver)
        explicit_solver->begin_stage(stage, previous, state);
      if (time_is_known)
      {
        solver->stage_loads().check_start(state);
        if (explicit_solver)
          explicit_solver->added_water().check_levels(stage,
                                                      state.load_start());
      }
    }
    catch (const InputError &error)
    {
      const std::string what = parameters.file + ", " + error.what();
      // An InputError is thrown only before anything is computed.
      if (state.step > 0)
        throw RunError(what);
      throw InputError(what);
    }
  }

  template <int dim>
  void BlockSystem<dim>::resume_stage(const unsigned int index,
                                      State<dim> &state)
  {
    const StageParameters &stage    = parameters.stages[index];
    const StageParameters *previous = previous_stage(parameters.stages, index);
    construction->resume_stage(index, state);
    if (implicit_solver)
      implicit_solver->resume_stage(stage, previous, state);
    if (explicit_solver)
      explicit_solver->resume_stage(stage, previous, state);
  }

  template <int dim>
  void BlockSystem<dim>::restore(const unsigned int index,
                                 const State<dim> &state)
  {
    if (index == 0)
      return;
    construction->resume_stage(index - 1, state);
    const StageParameters &previous = *previous_stage(parameters.stages, index);
    solver->loads().follow_materials(*model, previous, nullptr);
    if (explicit_solver)
      explicit_solver->restore_masses(previous, state);
  }

  template <int dim>
  void BlockSystem<dim>::set_properties(const ModelProperties &properties,
                                        const State<dim> &state)
  {
    model->set_properties(properties,
                          state.template get<ConstructionState<dim>>());
  }

  template <int dim>
  unsigned int BlockSystem<dim>::n_rigid_blocks() const
  {
    const auto &is_rigid = model->nodes().table().is_rigid;
    return std::count(is_rigid.begin(), is_rigid.end(), true);
  }

  template class BlockSystem<2>;
  template class BlockSystem<3>;
} // namespace quoin
