// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/implicit/equilibrium.h>
#include <quoin/joint_elements/breaking_joints.h>
#include <quoin/joint_elements/joint_changes.h>
#include <quoin/operators/archive.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    using Index = DofIndex;

    /** Displacement of all nodes by the model's size [-]: the forces for it
        count as applied, as without loads there is only rounding. */
    constexpr double least_motion = 1e-11;

    double area_of_points(const JointSegment &segment)
    {
      return segment.area[0];
    }
    double area_of_points(const SpaceJointFace &face)
    {
      return face.area;
    }
  } // namespace

  template <int dim>
  Equilibrium<dim>::Equilibrium(const Model<dim> &model, DofMap<dim> &dof_map,
                                const Operators &operators,
                                const std::vector<bool> &path_sets,
                                const double stage_start,
                                const StaticFarField *far_field,
                                const LoadPattern<dim> *pattern,
                                const Beams *beams)
    : model(model), dof_map(dof_map), operators(operators),
      path_sets(path_sets), stage_start(stage_start),
      communicator(model.nodes().communicator()), pattern(pattern),
      far_field(far_field), beams(beams)
  {
    make_pattern();
  }

  template <int dim>
  void Equilibrium<dim>::make_pattern()
  {
    dealii::TrilinosWrappers::SparsityPattern entries(
        dof_map.owned(), dof_map.owned(), dof_map.relevant(), communicator);
    State<dim> rest = model.initial_state();
    double sums[4]  = { 0., 0., 0., 0. }; // stiffness, mass, nodes, path
    for (const ForceOperator<dim> *each : operators)
      each->linearise(
          rest, each->is_internal(),
          [&](const ElementLinearisation<dim> &element)
          {
            const unsigned int n = dim * element.n_nodes;
            element_dofs.resize(n);
            dof_map.get_dofs(element.nodes, element.n_nodes, element_dofs);
            dof_map.constraints().add_entries_local_to_global(element_dofs,
                                                              entries, false);
            for (unsigned int i = 0; each->is_internal() && i < n; ++i)
              sums[0] += 0.5 * element.stiffness[i * element.row_length + i];
            if (is_on_path(element))
              sums[3] += element.area * element.share;
          });
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      sums[1] += model.mass()[i];
    sums[2] = model.nodes().n_deformable_nodes();
    MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, communicator);
    path_area = sums[3];
    const double stiffness
        = sums[2] > 0. ? sums[0] / sums[2] : joint_stiffness();
    const unsigned int n_nodes = model.nodes().exchange().n_global();
    least_applied
        = least_motion * model.nodes().table().diagonal() * stiffness * n_nodes;
    const double by_mass = stiffness / (sums[1] / n_nodes);
    for (const double mass : model.mass())
      drag_stiffness.push_back(by_mass * mass);
    if constexpr (dim == 2)
    {
      if (far_field)
        find_far_stiffness();
      for (const Index row : far_rows)
        entries.add_entries(row, far_columns.begin(), far_columns.end());
      if (beams)
        add_beam_entries(entries);
    }
    for (const Index row : dof_map.owned())
    {
      entries.add(row, row);
      if (pattern)
      {
        entries.add(row, dof_map.factor());
        entries.add(dof_map.factor(), row);
      }
    }
    entries.compress();
    matrix.reinit(entries);
    int *starts, *columns;
    matrix.trilinos_matrix().ExtractCrsDataPointers(starts, columns,
                                                    matrix_values);
    for (int row = 0; row < matrix.trilinos_matrix().NumMyRows(); ++row)
    {
      const int column
          = matrix.trilinos_matrix().LCID(matrix.trilinos_matrix().GRID(row));
      diagonal_places.push_back(
          std::find(columns + starts[row], columns + starts[row + 1], column)
          - columns);
    }
  }

  template <>
  void Equilibrium<2>::find_far_stiffness()
  {
    auto stiffness       = far_field->nodal_stiffness(model.nodes().exchange());
    const Eigen::Index n = stiffness.nodes.size();
    // Nothing resists a translation of the model if only the far field supports
    // it. Forces without resultant do not cause one; a stiffness in the
    // derivative alone makes the equations regular.
    unsigned int held[2] = {};
    for (const DofMap<2>::Prescribed &given : dof_map.prescribed())
      held[given.component] = 1;
    for (const RigidBody<2> &body : dof_map.bodies())
      for (unsigned int d = 0; d < 2; ++d)
        if (body.given[d])
          held[d] = 1;
    MPI_Allreduce(MPI_IN_PLACE, held, 2, MPI_UNSIGNED, MPI_MAX, communicator);
    const double size = dealii::Utilities::MPI::max(
        stiffness.rows.size() > 0 ? stiffness.rows.cwiseAbs().maxCoeff() : 0.,
        communicator);
    for (Eigen::Index k = 0; k < stiffness.rows.rows(); ++k)
      if (!held[k % 2])
        for (Eigen::Index j = 0; j < n; ++j)
          stiffness.rows(k, 2 * j + k % 2) += size / double(n);

    std::vector<Eigen::Index> rows, columns;
    std::vector<Index> dofs(2 * n, 0); // one more; 0: not free
    for (unsigned int k = 0; k < far_field->nodes().size(); ++k)
      for (unsigned int d = 0; d < 2; ++d)
      {
        const unsigned int node = far_field->nodes()[k];
        if (!dof_map.is_free(node, d))
          continue;
        rows.push_back(2 * k + d);
        far_rows.push_back(dof_map.dof(node, d));
        const auto place
            = std::lower_bound(stiffness.nodes.begin(), stiffness.nodes.end(),
                               model.nodes().exchange().global(node));
        dofs[2 * (place - stiffness.nodes.begin()) + d] = 1 + far_rows.back();
      }
    dealii::Utilities::MPI::sum(dofs, communicator, dofs);
    for (Eigen::Index j = 0; j < 2 * n; ++j)
      if (dofs[j] > 0)
      {
        columns.push_back(j);
        far_columns.push_back(dofs[j] - 1);
      }
    far_stiffness = stiffness.rows(rows, columns);
  }

  template <>
  void Equilibrium<2>::add_beam_entries(
      dealii::TrilinosWrappers::SparsityPattern &entries)
  {
    std::vector<Index> dofs; // one more; 0: held
    for (const auto &[line, interface] : beams->all())
      for (const InterfacePoint &point : interface.points)
        for (unsigned int d = 0; d < 2; ++d)
          dofs.push_back(point.node != NodeMap<2>::none
                                 && dof_map.is_free(point.node, d)
                             ? 1 + dof_map.dof(point.node, d)
                             : 0);
    dealii::Utilities::MPI::sum(dofs, communicator, dofs);
    for (const Index dof : dofs)
      beam_dofs.push_back(dof - 1); // numbers::invalid_dof_index of 0
    for (const auto &[line, interface] : beams->all())
    {
      std::vector<Index> columns;
      for (unsigned int k = 0; k < 2 * interface.points.size(); ++k)
        if (dofs[2 * interface.first + k] > 0)
          columns.push_back(beam_dofs[2 * interface.first + k]);
      std::sort(columns.begin(), columns.end());
      for (const Index row : columns)
        if (dof_map.owned().is_element(row))
          entries.add_entries(row, columns.begin(), columns.end());
    }
  }

  template <>
  void Equilibrium<2>::add_beams(const State<2> &committed,
                                 const Configuration<2> &configuration,
                                 Balance<2> &balance, const bool slopes)
  {
    std::vector<Eigen::MatrixXd> stiffness;
    balance.failed_beam = beams->settle(
        { configuration.load_time, stage_start + configuration.load_time },
        committed, balance.state, applied_force.data(),
        slopes ? &stiffness : nullptr);
    if (!balance.failed_beam.empty())
      return;
    for (unsigned int b = 0; b < stiffness.size(); ++b)
      for (Eigen::Index i = 0; i < stiffness[b].rows(); ++i)
      {
        const unsigned int first = 2 * beams->all()[b].interface.first;
        const Index row          = beam_dofs[first + i];
        if (row == dealii::numbers::invalid_dof_index
            || !dof_map.owned().is_element(row))
          continue;
        std::vector<Index> columns;
        std::vector<double> values;
        for (Eigen::Index j = 0; j < stiffness[b].cols(); ++j)
          if (beam_dofs[first + j] != dealii::numbers::invalid_dof_index)
          {
            columns.push_back(beam_dofs[first + j]);
            values.push_back(stiffness[b](i, j));
          }
        matrix.add(row, columns.size(), columns.data(), values.data(), false,
                   false);
      }
  }

  template <int dim>
  double Equilibrium<dim>::joint_stiffness() const
  {
    double largest = 1.;
    for (const auto &face : joint_faces(model.joints()))
      largest = std::max(
          largest, area_of_points(face)
                       * stiffness_bound(model.joints().laws()[face.set])[0]);
    return dealii::Utilities::MPI::max(largest, communicator);
  }

  template <int dim>
  void Equilibrium<dim>::find_places(const ElementLinearisation<dim> &element)
  {
    const unsigned int n = dim * element.n_nodes;
    ElementPlaces places{ all_places.size(), 0, {} };
    element_dofs.resize(n);
    dof_map.get_dofs(element.nodes, element.n_nodes, element_dofs);
    const Epetra_CrsMatrix &rows = matrix.trilinos_matrix();
    const bool is_free
        = std::all_of(element_dofs.begin(), element_dofs.end(),
                      [&](const Index dof)
                      {
                        return !dof_map.constraints().is_constrained(dof)
                               && dof_map.owned().is_element(dof);
                      });
    if (is_free && element.n_nodes <= places.nodes.size())
    {
      std::copy(element.nodes, element.nodes + element.n_nodes,
                places.nodes.begin());
      places.n_values = n * n;
      int *starts, *columns;
      double *values;
      rows.ExtractCrsDataPointers(starts, columns, values);
      for (const Index i : element_dofs)
      {
        const int row = rows.LRID(int(i));
        for (const Index j : element_dofs)
          all_places.push_back(std::find(columns + starts[row],
                                         columns + starts[row + 1],
                                         rows.LCID(int(j)))
                               - columns);
      }
    }
    element_places.push_back(places);
  }

  template <int dim>
  void Equilibrium<dim>::add_stiffness(const ElementLinearisation<dim> &element,
                                       DofVector &by_advance)
  {
    const unsigned int n = dim * element.n_nodes;
    if (next_element == element_places.size())
      find_places(element);
    const ElementPlaces &places = element_places[next_element++];
    if (places.n_values == n * n
        && std::equal(element.nodes, element.nodes + element.n_nodes,
                      places.nodes.begin()))
    {
      const int *to = all_places.data() + places.first;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          matrix_values[*to++]
              += element.share * element.stiffness[i * element.row_length + j];
      return;
    }
    if (element_dofs.size() != n || element_matrix.m() != n)
    {
      element_dofs.resize(n);
      element_matrix.reinit(n, n);
      no_load.reinit(n);
    }
    dof_map.get_dofs(element.nodes, element.n_nodes, element_dofs);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        element_matrix(i, j)
            = element.share * element.stiffness[i * element.row_length + j];
    dof_map.constraints().distribute_local_to_global(
        element_matrix, no_load, element_dofs, matrix, by_advance);
  }

  template <int dim>
  void
  Equilibrium<dim>::add_element(const ElementLinearisation<dim> &element,
                                AlignedArray<dealii::Tensor<1, dim>> &force,
                                double &path, const bool on_path,
                                Slopes *slopes)
  {
    for (unsigned int k = 0; k < element.n_nodes; ++k)
      force[element.nodes[k]] += vector_at<dim>(element.force, k);
    if (is_on_path(element))
      path += element.share * element.inelastic;
    if (!slopes)
      return;
    add_stiffness(element, slopes->by_advance);
    if (!on_path || !is_on_path(element))
      return;
    const unsigned int n = dim * element.n_nodes;
    element_dofs.resize(n);
    dof_map.get_dofs(element.nodes, element.n_nodes, element_dofs);
    std::vector<double> slope(n);
    for (unsigned int j = 0; j < n; ++j)
    {
      slope[j] = element.inelastic_gradient[j] * (element.share / path_area);
      slopes->path_by_advance
          += slope[j]
             * dof_map.constraints().get_inhomogeneity(element_dofs[j]);
    }
    dof_map.constraints().distribute_local_to_global(
        slope.begin(), slope.end(), element_dofs.begin(), slopes->path_by_dof);
  }

  template <>
  void Equilibrium<2>::add_far_field(const State<2> &committed,
                                     const Configuration<2> &configuration,
                                     Balance<2> &balance, const Slopes *slopes)
  {
    balance.far_field_energy = 0.;
    balance.far_field_force  = {};
    if (!far_field)
      return;
    const auto &nodes = far_field->nodes();
    AlignedArray<dealii::Tensor<1, 2>> force(model.nodes().n_local(),
                                             dealii::Tensor<1, 2>());
    balance.far_field_energy = far_field->add_forces(
        configuration.nodes.data(), committed.get<StaticFarFieldState>(),
        force.data());
    for (const unsigned int node : nodes)
    {
      dealii::Tensor<1, 2> on_free;
      for (unsigned int d = 0; d < 2; ++d)
      {
        applied_force[node][d] += force[node][d];
        if (dof_map.is_free(node, d))
          on_free[d] = force[node][d];
      }
      add_force<2>(on_free, model.nodes().point(node), balance.far_field_force);
    }
    for (unsigned int k = 0; slopes && k < far_rows.size(); ++k)
      matrix.add(far_rows[k], far_columns.size(), far_columns.data(),
                 far_stiffness.row(k).data(), false, false);
  }

  template <int dim>
  void Equilibrium<dim>::add_drag(const State<dim> &committed,
                                  const Configuration<dim> &configuration,
                                  Balance<dim> &balance, Slopes *slopes)
  {
    balance.drag.assign(model.nodes().n_local(), dealii::Tensor<1, dim>());
    if (drag == 0.)
      return;
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
    {
      const double stiffness = drag * drag_stiffness[i];
      balance.drag[i]
          = -stiffness * (configuration.nodes[i].u - committed.nodes[i].u);
      if (!slopes)
        continue;
      std::array<double, dim * dim> element{};
      for (unsigned int d = 0; d < dim; ++d)
        element[(dim + 1) * d] = stiffness;
      add_stiffness({ &i, 1, nullptr, element.data(), dim },
                    slopes->by_advance);
    }
  }

  template <int dim>
  void Equilibrium<dim>::add_turning(
      const AlignedArray<dealii::Tensor<1, dim>> &force, DofVector &by_advance)
  {
    // The arms turn with the body: r x f changes by r (dtheta . f) - dtheta
    // (r . f), in the plane by -r . f per radian.
    constexpr unsigned int n = n_body_motions<dim> - dim;
    for (const RigidBody<dim> &body : dof_map.bodies())
    {
      std::array<std::array<double, n>, n> sum{};
      for (unsigned int i = 0; i < body.nodes.size(); ++i)
      {
        const dealii::Tensor<1, dim> &f = force[body.nodes[i]];
        const auto &arm                 = body.present_arms[i];
        double along                    = arm[0] * f[0] + arm[1] * f[1];
        if constexpr (dim == 3)
          along += arm[2] * f[2];
        for (unsigned int d = 0; d < n; ++d)
        {
          sum[d][d] += along;
          for (unsigned int e = 0; dim == 3 && e < n; ++e)
            sum[d][e] -= arm[d] * f[e];
        }
      }
      const Index first = body.first + dim;
      for (unsigned int d = 0; d < n; ++d)
        for (unsigned int e = 0; !body.given[dim + d] && e < n; ++e)
          if (!body.given[dim + e])
            matrix.add(first + d, first + e, sum[d][e]);
          else
            by_advance(first + d)
                -= sum[d][e]
                   * dof_map.constraints().get_inhomogeneity(first + e);
    }
  }

  template <int dim>
  void Equilibrium<dim>::add_forces(const State<dim> &committed,
                                    const Configuration<dim> &configuration,
                                    const std::vector<std::uint8_t> &broken,
                                    Balance<dim> &balance, Slopes *slopes,
                                    const bool on_path)
  {
    next_element      = 0;
    State<dim> &trial = balance.state;
    trial.nodes       = configuration.nodes;
    trial.energy      = EnergyAccounts();
    trial.load_time   = configuration.load_time;
    trial.stage_start = stage_start;
    trial.load_lag    = 0.;
    for (const ForceOperator<dim> *each : operators)
      each->prepare(trial);
    if constexpr (dim == 2)
      if (beams)
        beams->prepare(trial);
    trial.copy_slices(committed);
    trial.template add<BreakingJoints<dim>>().points = broken;
    balance.force.assign(model.nodes().n_local(), dealii::Tensor<1, dim>());
    applied_force.assign(model.nodes().n_local(), dealii::Tensor<1, dim>());

    double path = 0.;
    for (const ForceOperator<dim> *each : operators)
    {
      auto &force = each->is_internal() ? balance.force : applied_force;
      each->linearise(trial, slopes,
                      [&](const ElementLinearisation<dim> &element)
                      {
                        if (!dof_map.is_absent(element.nodes[0]))
                          add_element(element, force, path, on_path, slopes);
                      });
    }
    if constexpr (dim == 2)
      if (beams)
        add_beams(committed, configuration, balance, slopes != nullptr);
    balance.path
        = path_area > 0.
              ? dealii::Utilities::MPI::sum(path, communicator) / path_area
              : 0.;
    model.nodes().exchange().add_to_owners(applied_force.data());
    model.nodes().exchange().add_to_owners(balance.force.data());
  }

  template <int dim>
  void Equilibrium<dim>::add_loads(const State<dim> &committed,
                                   const Configuration<dim> &configuration,
                                   Balance<dim> &balance)
  {
    const unsigned int n_owned = model.nodes().n_owned();
    balance.external.assign(model.nodes().n_local(), dealii::Tensor<1, dim>());
    add_external(configuration.load_time, configuration.factor,
                 balance.external);
    if (pattern)
      balance.lacking = committed.template get<LoadPatternState>().start
                        + pattern->target(configuration.load_time)
                        - pattern->displacement(configuration.nodes);

    const double left = 1. - configuration.released;
    const auto &now   = committed.template get<ImplicitState>();
    const auto &held  = now.held;
    balance.drives    = body_loads(
           dof_map.bodies(),
           { configuration.load_time, stage_start + configuration.load_time });
    balance.held.assign(dof_map.bodies().size(), {});
    for (unsigned int i = 0; i < n_owned; ++i)
    {
      applied_force[i] += balance.external[i];
      balance.force[i] += applied_force[i];
      if (!held.empty())
        balance.force[i] += left * vector_at<dim>(held, i);
    }
    if (!held.empty())
      for (unsigned int b = 0; b < dof_map.bodies().size(); ++b)
      {
        balance.held[b] = kept_values(dof_map.bodies(), b, now.held_platens,
                                      now.held_blocks);
        for (double &force : balance.held[b])
          force *= left;
      }
    find_ratio(applied_force, balance);
  }

  template <int dim>
  void Equilibrium<dim>::add_external(
      const double load_time, const double factor,
      AlignedArray<dealii::Tensor<1, dim>> &force) const
  {
    for (unsigned int i = 0; pattern && i < force.size(); ++i)
      force[i] += factor * pattern->forces()[i];
    for (const ForceOperator<dim> *each : operators)
      each->add_loads({ load_time, stage_start + load_time }, force.data());
    for (unsigned int i = 0; i < force.size(); ++i)
      if (dof_map.is_absent(i))
        force[i] = dealii::Tensor<1, dim>();
  }

  template <int dim>
  void Equilibrium<dim>::find_ratio(
      const AlignedArray<dealii::Tensor<1, dim>> &applied,
      Balance<dim> &balance)
  {
    double sums[3] = { 0., 0., 0. }; // unbalanced, applied, dragged
    AlignedArray<dealii::Tensor<1, dim>> total = balance.force;
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      total[i] += balance.drag[i];
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
    {
      sums[1] += applied[i].norm();
      sums[2] += balance.drag[i].norm();
      dealii::Tensor<1, dim> free = total[i], given = total[i];
      for (unsigned int d = 0; d < dim; ++d)
        (dof_map.is_free(i, d) ? given : free)[d] = 0.;
      sums[0] += free.norm();
      sums[1] += given.norm();
    }
    const auto bodies = body_forces(dof_map.bodies(), total, communicator);
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const RigidBody<dim> &body = dof_map.bodies()[b];
      if (!body.counts)
        continue;
      for (unsigned int d = 0; d < n_body_motions<dim>; ++d)
        if (!body.given[d] && (d < dim || body.reach > 0.))
          sums[0] += std::abs(bodies[b][d] + balance.drives[b][d]
                              + balance.held[b][d])
                     / (d >= dim ? body.reach : 1.);
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, communicator);
    // Corrections by a matrix that is singular may not be numbers.
    const bool is_finite = std::isfinite(sums[0] + sums[1]);
    balance.unbalanced   = balance.failed_beam.empty() && is_finite
                               ? sums[0]
                               : std::numeric_limits<double>::infinity();
    balance.applied
        = is_finite ? std::max(sums[1], least_applied) : least_applied;
    balance.dragged = sums[2];
  }

  template <int dim>
  void Equilibrium<dim>::find_forces(const State<dim> &committed,
                                     const Configuration<dim> &configuration,
                                     const std::vector<std::uint8_t> &broken,
                                     Balance<dim> &balance)
  {
    dof_map.update_arms(configuration);
    add_forces(committed, configuration, broken, balance, nullptr);
    add_drag(committed, configuration, balance, nullptr);
    if constexpr (dim == 2)
      add_far_field(committed, configuration, balance, nullptr);
    add_loads(committed, configuration, balance);
  }

  template <int dim>
  void Equilibrium<dim>::linearise(const State<dim> &committed,
                                   const Configuration<dim> &configuration,
                                   const std::vector<std::uint8_t> &broken,
                                   const Advance &advance,
                                   Balance<dim> &balance, Slopes &slopes)
  {
    const unsigned int n_owned = model.nodes().n_owned();
    dof_map.update_constraints(configuration, advance.load_time);
    matrix                 = 0.;
    slopes.by_advance      = 0.;
    slopes.path_by_dof     = 0.;
    slopes.path_by_advance = 0.;
    add_forces(committed, configuration, broken, balance, &slopes,
               advance.on_path);
    add_drag(committed, configuration, balance, &slopes);
    if constexpr (dim == 2)
      add_far_field(committed, configuration, balance, &slopes);
    add_loads(committed, configuration, balance);
    add_turning(balance.force, slopes.by_advance);
    if (pattern)
      add_pattern(configuration, advance.load_time, slopes.by_advance);
    matrix.compress(dealii::VectorOperation::add);
    fill_unused_rows();

    slopes.path_by_dof.compress(dealii::VectorOperation::add);
    slopes.path_by_advance
        = dealii::Utilities::MPI::sum(slopes.path_by_advance, communicator);

    AlignedArray<dealii::Tensor<1, dim>> change(n_owned,
                                                dealii::Tensor<1, dim>());
    add_external(advance.load_time, configuration.factor, change);
    const double freed = advance.released - configuration.released;
    const auto &now    = committed.template get<ImplicitState>();
    const auto &held   = now.held;
    for (unsigned int i = 0; i < n_owned; ++i)
    {
      // Summed first, so that nodes with equal loads round in the same way.
      dealii::Tensor<1, dim> before = balance.external[i];
      if (!held.empty())
        before += freed * vector_at<dim>(held, i);
      change[i] -= before;
    }
    auto drives
        = body_loads(dof_map.bodies(),
                     { advance.load_time, stage_start + advance.load_time });
    for (unsigned int b = 0; b < drives.size(); ++b)
    {
      std::array<double, n_body_motions<dim>> on_body{};
      if (!held.empty())
        on_body = kept_values(dof_map.bodies(), b, now.held_platens,
                              now.held_blocks);
      for (unsigned int d = 0; d < n_body_motions<dim>; ++d)
        drives[b][d] -= balance.drives[b][d] + freed * on_body[d];
    }
    dof_map.add_forces(change, slopes.by_advance);
    add_body_forces(dof_map.bodies(), drives, slopes.by_advance);
    slopes.by_advance.compress(dealii::VectorOperation::add);
  }

  template <int dim>
  void Equilibrium<dim>::add_pattern(const Configuration<dim> &configuration,
                                     const double load_time,
                                     DofVector &by_advance)
  {
    const Index factor         = dof_map.factor();
    const unsigned int n_owned = model.nodes().n_owned();
    DofVector push(dof_map.owned(), communicator),
        measure(dof_map.owned(), communicator);
    dof_map.add_forces(pattern->forces(), push);
    AlignedArray<dealii::Tensor<1, dim>> weights(n_owned,
                                                 dealii::Tensor<1, dim>());
    double moves
        = pattern->target(load_time) - pattern->target(configuration.load_time);
    double given = 0.; // by prescribed motions
    for (const DisplacementTerm &term : pattern->measure())
    {
      weights[term.node][term.component] += term.weight;
      given += term.weight
               * dof_map.constraints().get_inhomogeneity(
                   dof_map.dof(term.node, term.component));
    }
    dof_map.add_forces(weights, measure);
    push.compress(dealii::VectorOperation::add);
    measure.compress(dealii::VectorOperation::add);
    for (const Index row : dof_map.owned())
    {
      if (push(row) != 0.)
        matrix.add(row, factor, -push(row));
      if (measure(row) != 0.)
        matrix.add(factor, row, measure(row));
    }
    moves -= dealii::Utilities::MPI::sum(given, communicator);
    if (dof_map.owned().is_element(factor))
      by_advance(factor) += moves;
  }

  template <int dim>
  void Equilibrium<dim>::fill_unused_rows()
  {
    // Rows of constrained degrees of freedom are those of the unit matrix,
    // scaled to keep the condition number.
    const double size
        = matrix.frobenius_norm() / std::sqrt(double(dof_map.owned().size()));
    unsigned int local = 0;
    for (const Index row : dof_map.owned())
    {
      double &value = matrix_values[diagonal_places[local++]];
      if (value == 0. && row != dof_map.factor())
        value = size > 0. ? size : 1.;
    }
  }

  template class Equilibrium<2>;
  template class Equilibrium<3>;
} // namespace quoin
