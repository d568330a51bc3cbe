// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/implicit/equilibrium.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    using Index = Freedoms::Index;
    constexpr NodeVector<2> no_force{ { 0., 0. } };

    /** Of all nodes, as a share of the model's size: forces that this needs
        count as applied, as rounding is all there is without loads [-]. */
    constexpr double least_motion = 1e-11;

    double norm(const NodeVector<2> &f)
    {
      return std::hypot(f.v[0], f.v[1]);
    }

    /** One unknown on which a component of a node depends, and how. */
    struct Term
    {
      Index unknown;
      double factor;
    };

    /** Those of component @p d of a node: none, one or two. */
    unsigned int terms(const Freedoms::Node &node, const unsigned int d,
                       Term (&result)[2])
    {
      unsigned int n = 0;
      if (node.unknown[d] != Freedoms::nothing)
        result[n++] = { node.unknown[d], 1. };
      if (node.unknown[2] != Freedoms::nothing)
        result[n++] = { node.unknown[2], d == 0 ? -node.arm[1] : node.arm[0] };
      return n;
    }
  } // namespace

  Equilibrium::Equilibrium(const Model &model, Freedoms &freedoms,
                           const std::vector<const NodalLoad<2> *> &loads,
                           const std::vector<bool> &path_sets,
                           const double stage_start,
                           const StaticFarField *far_field)
    : model(model), freedoms(freedoms), loads(loads), path_sets(path_sets),
      stage_start(stage_start), communicator(model.exchange().communicator()),
      far_field(far_field)
  {
    for (unsigned int i = 0; i < model.joints().n_segments(); ++i)
    {
      const auto &segment = model.joints().segment(i);
      if (path_sets[segment.set])
        path_area += (segment.area[0] + segment.area[1]) * segment.share;
    }
    path_area = dealii::Utilities::MPI::sum(path_area, communicator);
    make_pattern();
  }

  Equilibrium::Vector Equilibrium::make_vector() const
  {
    return Vector(freedoms.owned(), communicator);
  }

  void Equilibrium::make_pattern()
  {
    // Rows of platens get entries from all ranks.
    dealii::IndexSet rows = freedoms.owned();
    for (const Freedoms::Body &body : freedoms.bodies())
      if (body.platen)
        rows.add_range(body.first, body.first + 4);
    dealii::TrilinosWrappers::SparsityPattern pattern(
        freedoms.owned(), freedoms.owned(), rows, communicator);
    const unsigned int n_owned = model.exchange().n_owned();
    const auto add = [&](const unsigned int *nodes, const unsigned int n)
    {
      std::vector<Index> columns;
      for (unsigned int j = 0; j < n; ++j)
        for (const Index unknown : freedoms.nodes()[nodes[j]].unknown)
          if (unknown != Freedoms::nothing)
            columns.push_back(unknown);
      std::sort(columns.begin(), columns.end());
      columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
      for (unsigned int i = 0; i < n; ++i)
        if (nodes[i] < n_owned)
          for (const Index row : freedoms.nodes()[nodes[i]].unknown)
            if (row != Freedoms::nothing)
              pattern.add_entries(row, columns.begin(), columns.end(), true);
    };
    CellLinearisation cell;
    PlasticHistory history = model.blocks().initial_history();
    const State<2> rest    = model.initial_state();
    double sums[3]         = { 0., 0., 0. }; // stiffness, mass, nodes
    for (unsigned int c = 0; c < model.blocks().n_cells(); ++c)
      if (model.blocks().linearise(c, rest.nodes.data(), history, cell))
      {
        add(cell.nodes.data(), cell.n_nodes);
        for (unsigned int i = 0; i < 2 * cell.n_nodes; ++i)
          sums[0] += 0.5 * cell.stiffness[i][i];
      }
    for (unsigned int i = 0; i < n_owned; ++i)
      sums[1] += model.mass()[i];
    sums[2] = model.n_deformable_nodes();
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, communicator);
    const double stiffness
        = sums[2] > 0. ? sums[0] / sums[2] : joint_stiffness();
    const unsigned int n_nodes = model.nodes().n_global();
    least_applied
        = least_motion * model.nodes().diagonal() * stiffness * n_nodes;
    const double by_mass = stiffness / (sums[1] / n_nodes);
    for (const double mass : model.mass())
      drag_stiffness.push_back(by_mass * mass);
    for (unsigned int i = 0; i < model.joints().n_segments(); ++i)
    {
      const auto &segment = model.joints().segment(i);
      const std::array<unsigned int, 4> nodes
          = { { segment.lower[0], segment.lower[1], segment.upper[0],
                segment.upper[1] } };
      add(nodes.data(), 4);
    }
    if (far_field)
    {
      find_far_stiffness();
      std::vector<Index> columns;
      for (const Index unknown : far_unknowns)
        if (unknown != Freedoms::nothing)
          columns.push_back(unknown);
      std::sort(columns.begin(), columns.end());
      for (const unsigned int node : far_field->nodes())
        for (unsigned int d = 0; d < 2; ++d)
          if (freedoms.is_free(node, d))
            pattern.add_entries(freedoms.nodes()[node].unknown[d],
                                columns.begin(), columns.end(), true);
    }
    for (const Index row : freedoms.owned())
      pattern.add(row, row);
    pattern.compress();
    matrix.reinit(pattern);
  }

  void Equilibrium::find_far_stiffness()
  {
    const auto stiffness = far_field->nodal_stiffness(model.exchange());
    far_stiffness        = stiffness.rows;
    far_unknowns.assign(2 * stiffness.nodes.size(), 0);
    for (unsigned int j = 0; j < stiffness.nodes.size(); ++j)
      if (model.exchange().owns(stiffness.nodes[j]))
      {
        const unsigned int node = model.exchange().local(stiffness.nodes[j]);
        for (unsigned int d = 0; d < 2; ++d)
          if (freedoms.is_free(node, d))
            far_unknowns[2 * j + d] = 1 + freedoms.nodes()[node].unknown[d];
      }
    dealii::Utilities::MPI::sum(far_unknowns, communicator, far_unknowns);
    for (Index &unknown : far_unknowns)
      unknown = unknown == 0 ? Freedoms::nothing : unknown - 1;

    // Nothing resists a translation of all if nothing but the far field holds
    // the model. Forces without resultant leave it where it is; so that the
    // equations do so too, it gets a stiffness, in the derivative alone.
    unsigned int held[2] = { 0, 0 };
    for (const Freedoms::Prescribed &given : freedoms.prescribed())
      held[given.component] = 1;
    for (const Freedoms::Body &body : freedoms.bodies())
      for (unsigned int d = 0; d < 2; ++d)
        if (body.given[d])
          held[d] = 1;
    MPI_Allreduce(MPI_IN_PLACE, held, 2, MPI_UNSIGNED, MPI_MAX, communicator);
    const Eigen::Index n = stiffness.nodes.size();
    const double size    = dealii::Utilities::MPI::max(
           far_stiffness.size() > 0 ? far_stiffness.cwiseAbs().maxCoeff() : 0.,
        communicator);
    for (Eigen::Index k = 0; k < far_stiffness.rows(); ++k)
      if (!held[k % 2])
        for (Eigen::Index j = 0; j < n; ++j)
          far_stiffness(k, 2 * j + k % 2) += size / double(n);
  }

  double Equilibrium::joint_stiffness() const
  {
    double largest = 1.;
    for (unsigned int i = 0; i < model.joints().n_segments(); ++i)
    {
      const auto &segment = model.joints().segment(i);
      largest             = std::max(
                      largest, segment.area[0]
                                   * stiffness_bound(model.joints().law(segment.set))[0]);
    }
    return dealii::Utilities::MPI::max(largest, communicator);
  }

  template <std::size_t size>
  void Equilibrium::add_stiffness(
      const unsigned int *nodes, const unsigned int n,
      const std::array<std::array<double, size>, size> &element)
  {
    std::array<Index, 2 * size> columns;
    std::array<double, 2 * size> values;
    Term by_row[2], by_column[2];
    for (unsigned int i = 0; i < n; ++i)
    {
      if (nodes[i] >= model.exchange().n_owned())
        continue;
      for (unsigned int d = 0; d < 2; ++d)
      {
        const auto &row = element[2 * i + d];
        double &lift    = by_given[nodes[i]].v[d];
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int e = 0; e < 2; ++e)
            lift -= row[2 * j + e] * under_way->given[nodes[j]].v[e];

        const unsigned int n_rows
            = terms(freedoms.nodes()[nodes[i]], d, by_row);
        if (n_rows == 0)
          continue;
        unsigned int n_columns = 0;
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int e = 0; e < 2; ++e)
          {
            const unsigned int m
                = terms(freedoms.nodes()[nodes[j]], e, by_column);
            for (unsigned int k = 0; k < m; ++k)
            {
              columns[n_columns]  = by_column[k].unknown;
              values[n_columns++] = row[2 * j + e] * by_column[k].factor;
            }
          }
        for (unsigned int k = 0; k < n_rows; ++k)
        {
          std::array<double, 2 * size> scaled;
          for (unsigned int j = 0; j < n_columns; ++j)
            scaled[j] = by_row[k].factor * values[j];
          matrix.add(by_row[k].unknown, n_columns, columns.data(),
                     scaled.data(), false, false);
        }
      }
    }
  }

  void Equilibrium::add_far_field(const State<2> &committed,
                                  const Configuration &configuration,
                                  Balance &balance, const bool with_derivatives)
  {
    balance.far_field_energy = 0.;
    balance.far_field_force  = { { 0., 0., 0. } };
    if (!far_field)
      return;
    const auto &nodes = far_field->nodes();
    AlignedArray<NodeVector<2>> force(model.exchange().n_local(), no_force);
    balance.far_field_energy = far_field->add_forces(
        configuration.nodes.data(), committed.get<StaticFarFieldState>(),
        force.data());
    for (const unsigned int node : nodes)
    {
      const auto &X = model.nodes().point(node);
      for (unsigned int d = 0; d < 2; ++d)
      {
        const double by_far_field = force[node].v[d];
        joint_force[node].v[d] += by_far_field;
        if (!freedoms.is_free(node, d))
          continue;
        balance.far_field_force[d] += by_far_field;
        balance.far_field_force[2]
            += d == 0 ? -X[1] * by_far_field : X[0] * by_far_field;
      }
    }
    if (!with_derivatives)
      return;
    std::vector<Index> columns;
    for (const auto unknown : far_unknowns)
      if (unknown != Freedoms::nothing)
        columns.push_back(unknown);
    std::vector<double> row;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      for (unsigned int d = 0; d < 2; ++d)
      {
        if (!freedoms.is_free(nodes[k], d))
          continue;
        row.clear();
        for (unsigned int j = 0; j < far_unknowns.size(); ++j)
          if (far_unknowns[j] != Freedoms::nothing)
            row.push_back(far_stiffness(2 * k + d, j));
        matrix.add(freedoms.nodes()[nodes[k]].unknown[d], columns.size(),
                   columns.data(), row.data(), false, false);
      }
  }

  void Equilibrium::add_drag(const State<2> &committed,
                             const Configuration &configuration,
                             Balance &balance, const bool with_derivatives)
  {
    balance.drag.assign(model.exchange().n_local(), no_force);
    if (drag == 0.)
      return;
    for (unsigned int i = 0; i < model.exchange().n_owned(); ++i)
    {
      const double stiffness = drag * drag_stiffness[i];
      for (unsigned int d = 0; d < 2; ++d)
        balance.drag[i].v[d]
            = -stiffness
              * (configuration.nodes[i].u[d] - committed.nodes[i].u[d]);
      if (!with_derivatives)
        continue;
      std::array<std::array<double, 2>, 2> element{};
      element[0][0] = element[1][1] = stiffness;
      add_stiffness(&i, 1, element);
    }
  }

  void Equilibrium::add_turning(const AlignedArray<NodeVector<2>> &force)
  {
    // The arms turn with the body: r x f changes by -r . f per radian.
    for (const Freedoms::Body &body : freedoms.bodies())
    {
      if (body.given[2])
        continue;
      double sum = 0.;
      for (const unsigned int node : body.nodes)
      {
        const double *f = force[node].v, *arm = freedoms.nodes()[node].arm;
        sum += arm[0] * f[0] + arm[1] * f[1];
      }
      matrix.add(body.first + 2, body.first + 2, sum);
    }
  }

  void Equilibrium::add_forces(const State<2> &committed,
                               const Configuration &configuration,
                               const std::vector<std::uint8_t> &broken,
                               Balance &balance, const bool with_derivatives)
  {
    const unsigned int n_owned = model.exchange().n_owned();
    const NodeRecord<2> *nodes = configuration.nodes.data();
    balance.lost               = EnergyAccounts();
    balance.joints             = committed.get<JointHistory>();
    balance.plastic            = committed.get<PlasticHistory>();
    balance.force.assign(model.exchange().n_local(), no_force);
    joint_force.assign(model.exchange().n_local(), no_force);

    double path = 0.;
    JointLinearisation segment;
    for (unsigned int i = 0; i < model.joints().n_segments(); ++i)
    {
      model.joints().linearise(i, nodes, broken, balance.joints, balance.lost,
                               segment, with_derivatives);
      for (unsigned int k = 0; k < 4; ++k)
        if (segment.nodes[k] < n_owned)
          for (unsigned int d = 0; d < 2; ++d)
            joint_force[segment.nodes[k]].v[d] += segment.force[2 * k + d];
      const auto &data = model.joints().segment(i);
      if (path_sets[data.set])
        path += data.share * segment.inelastic;
      if (!with_derivatives)
        continue;
      add_stiffness(segment.nodes.data(), 4, segment.stiffness);
      if (path_sets[data.set])
        for (unsigned int k = 0; k < 4; ++k)
          for (unsigned int d = 0; d < 2; ++d)
          {
            const double slope
                = segment.inelastic_gradient[2 * k + d] / path_area;
            if (segment.nodes[k] < n_owned)
              path_gradient[segment.nodes[k]].v[d] += slope;
            path_by_given
                += data.share * slope * under_way->given[segment.nodes[k]].v[d];
          }
    }
    balance.path
        = path_area > 0.
              ? dealii::Utilities::MPI::sum(path, communicator) / path_area
              : 0.;

    CellLinearisation cell;
    for (unsigned int c = 0; c < model.blocks().n_cells(); ++c)
    {
      if (freedoms.is_absent(model.nodes().cell(c)[0])
          || !model.blocks().linearise(c, nodes, balance.plastic, cell,
                                       with_derivatives))
        continue;
      balance.lost.plastic += cell.dissipated;
      for (unsigned int k = 0; k < cell.n_nodes; ++k)
        for (unsigned int d = 0; d < 2; ++d)
          balance.force[cell.nodes[k]].v[d] += cell.force[2 * k + d];
      if (with_derivatives)
        add_stiffness(cell.nodes.data(), cell.n_nodes, cell.stiffness);
    }
  }

  void Equilibrium::add_loads(const State<2> &committed,
                              const Configuration &configuration,
                              Balance &balance)
  {
    const unsigned int n_owned = model.exchange().n_owned();
    balance.external.assign(model.exchange().n_local(), no_force);
    add_external(configuration.load_time, balance.external);

    const double left = 1. - configuration.released;
    const auto &held  = committed.get<ImplicitState>().held;
    balance.drives    = freedoms.drives(configuration.load_time, stage_start);
    balance.held.assign(freedoms.bodies().size(), { { 0., 0., 0. } });
    for (unsigned int i = 0; i < n_owned; ++i)
      for (unsigned int d = 0; d < 2; ++d)
      {
        joint_force[i].v[d] += balance.external[i].v[d];
        balance.force[i].v[d] += joint_force[i].v[d];
        if (!held.empty())
          balance.force[i].v[d] += left * held[2 * i + d];
      }
    if (!held.empty())
      for (unsigned int b = 0; b < freedoms.bodies().size(); ++b)
        for (unsigned int d = 0; d < 3; ++d)
          balance.held[b][d] = left * held[2 * n_owned + 3 * b + d];
    find_ratio(joint_force, balance);
  }

  void Equilibrium::add_external(const double load_time,
                                 AlignedArray<NodeVector<2>> &force) const
  {
    for (const NodalLoad<2> *load : loads)
      load->add_forces({ load_time, stage_start + load_time }, force.data());
    if (release)
      release->add_forces(load_time, force.data());
    for (unsigned int i = 0; i < force.size(); ++i)
      if (freedoms.is_absent(i))
        force[i] = no_force;
  }

  void Equilibrium::find_ratio(const AlignedArray<NodeVector<2>> &applied,
                               Balance &balance)
  {
    double sums[3] = { 0., 0., 0. }; // unbalanced, applied, dragged
    AlignedArray<NodeVector<2>> total = balance.force;
    for (unsigned int i = 0; i < model.exchange().n_owned(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        total[i].v[d] += balance.drag[i].v[d];
    for (unsigned int i = 0; i < model.exchange().n_owned(); ++i)
    {
      sums[1] += norm(applied[i]);
      sums[2] += norm(balance.drag[i]);
      NodeVector<2> free = total[i], given = total[i];
      for (unsigned int d = 0; d < 2; ++d)
        (freedoms.is_free(i, d) ? given : free).v[d] = 0.;
      sums[0] += norm(free);
      sums[1] += norm(given);
    }
    const auto bodies = freedoms.body_forces(total);
    for (unsigned int b = 0; b < bodies.size(); ++b)
    {
      const Freedoms::Body &body = freedoms.bodies()[b];
      if (!body.counts)
        continue;
      double size = 0.;
      for (const double arm : body.arms)
        size = std::max(size, std::abs(arm));
      for (unsigned int d = 0; d < 3; ++d)
        if (!body.given[d] && (d < 2 || size > 0.))
          sums[0] += std::abs(bodies[b][d] + balance.drives[b][d]
                              + balance.held[b][d])
                     / (d == 2 ? size : 1.);
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM, communicator);
    balance.unbalanced = sums[0];
    balance.applied    = std::max(sums[1], least_applied);
    balance.dragged    = sums[2];
  }

  void Equilibrium::find_forces(const State<2> &committed,
                                const Configuration &configuration,
                                const std::vector<std::uint8_t> &broken,
                                Balance &balance)
  {
    freedoms.update_arms(configuration);
    add_forces(committed, configuration, broken, balance, false);
    add_drag(committed, configuration, balance, false);
    add_far_field(committed, configuration, balance, false);
    add_loads(committed, configuration, balance);
  }

  void Equilibrium::linearise(const State<2> &committed,
                              const Configuration &configuration,
                              const std::vector<std::uint8_t> &broken,
                              const Advance &advance, Balance &balance,
                              Vector &by_advance, Vector &by_unknown,
                              double &path_by_advance)
  {
    const unsigned int n_owned = model.exchange().n_owned();
    freedoms.update_arms(configuration);
    matrix    = 0.;
    under_way = &advance;
    by_given.assign(model.exchange().n_local(), no_force);
    path_gradient.assign(model.exchange().n_local(), no_force);
    path_by_given = 0.;
    add_forces(committed, configuration, broken, balance, true);
    add_drag(committed, configuration, balance, true);
    add_far_field(committed, configuration, balance, true);
    add_loads(committed, configuration, balance);
    add_turning(balance.force);
    matrix.compress(dealii::VectorOperation::add);
    fill_unused_rows();

    std::vector<std::array<double, 3>> drives(freedoms.bodies().size(),
                                              { { 0., 0., 0. } });
    freedoms.project(path_gradient, drives, by_unknown);
    path_by_advance = dealii::Utilities::MPI::sum(path_by_given, communicator);

    add_external(advance.load_time, by_given);
    const double freed = advance.released - configuration.released;
    const auto &held   = committed.get<ImplicitState>().held;
    for (unsigned int i = 0; i < n_owned; ++i)
      for (unsigned int d = 0; d < 2; ++d)
        by_given[i].v[d] -= balance.external[i].v[d]
                            + (held.empty() ? 0. : freed * held[2 * i + d]);
    drives = freedoms.drives(advance.load_time, stage_start);
    for (unsigned int b = 0; b < drives.size(); ++b)
      for (unsigned int d = 0; d < 3; ++d)
        drives[b][d]
            -= balance.drives[b][d]
               + (held.empty() ? 0. : freed * held[2 * n_owned + 3 * b + d]);
    freedoms.project(by_given, drives, by_advance);
  }

  void Equilibrium::fill_unused_rows()
  {
    // Rows that are not free are those of the unit matrix, at a size that
    // leaves the condition as it is.
    const double size
        = matrix.frobenius_norm() / std::sqrt(double(freedoms.n_unknowns()));
    for (const Index row : freedoms.owned())
      if (matrix.diag_element(row) == 0.)
        matrix.set(row, row, size > 0. ? size : 1.);
    matrix.compress(dealii::VectorOperation::insert);
  }
} // namespace quoin
