// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/operators/archive.h>
#include <quoin/base/eigen_core.h>
#include <quoin/farfield/static_far_field.h>
#include <quoin/tdbem/exterior_stiffness.h>

#include <deal.II/base/mpi.h>

#include <Eigen/LU>

#include <algorithm>

namespace quoin
{
  namespace
  {
    using Eigen::MatrixXd;
    using Eigen::VectorXd;
  } // namespace

  StaticFarField::StaticFarField(const std::string &name,
                                 const FarFieldDomain &domain,
                                 const NodeMap<2> &node_map,
                                 const std::vector<BoundaryFace<2>> &faces,
                                 const double thickness)
    : transfer(domain.boundary, domain.interface, node_map, faces),
      thickness(thickness),
      is_first_rank(
          dealii::Utilities::MPI::this_mpi_process(node_map.communicator())
          == 0)
  {
    load_name                           = name;
    own_traits.supports                 = true;
    own_traits.phase                    = "far field";
    node_list                           = transfer.nodes();
    std::vector<bool> traction_is_given = domain.traction_is_given;
    traction_is_given.resize(domain.boundary.n_unknowns(), true);
    std::vector<unsigned int> unknowns;
    for (const unsigned int element : domain.interface)
      for (const unsigned int d : { 0U, 1U })
      {
        unknowns.push_back(2 * element + d);
        traction_is_given[unknowns.back()] = false;
      }
    const ExteriorStiffness exterior
        = exterior_stiffness(domain.boundary, domain.medium,
                             Projection::galerkin, unknowns, traction_is_given);
    stiffness          = exterior.traction;
    from_given         = exterior.traction_by_given;
    relative_asymmetry = exterior.asymmetry;
    areas.resize(stiffness.rows());
    for (Eigen::Index k = 0; k < areas.size(); ++k)
      areas[k] = transfer.lengths()[k / 2] * thickness;
  }

  void StaticFarField::prepare(State<2> &state) const
  {
    state.add<StaticFarFieldState>();
  }

  void StaticFarField::begin_stage(State<2> &state, const bool continues)
  {
    prepared_step = 0.;
    if (continues)
      return;
    const double stored              = state.get<StaticFarFieldState>().stored;
    state.get<StaticFarFieldState>() = { false, {}, {}, stored, stored };
  }

  void StaticFarField::resume_stage(const State<2> &)
  {
    prepared_step = 0.;
  }

  void StaticFarField::start(const StepContext &step,
                             const std::vector<CapturedNode<2>> &captured,
                             State<2> &state)
  {
    StaticFarFieldState &far = state.get<StaticFarFieldState>();
    far.active               = true;
    gather_displacement(captured, u);
    if (far.origin.empty())
    {
      for (const unsigned int c : captured_positions)
        append_vector(far.held, captured[c].begun - captured[c].force);
      far.origin.assign(u.data(), u.data() + u.size());
    }
    // The energy counts from the middle of the last step, see book_stored().
    transfer.gather([&](const unsigned int k)
                    { return captured[captured_positions[k]].velocity; },
                    v_before);
    before = u - VectorXd::Map(far.origin.data(), u.size())
             - 0.5 * step.dt_before * v_before;
    far.stored_before -= energy_of(before);
  }

  void StaticFarField::follow(const FarField &waves, State<2> &state) const
  {
    const FarFieldState &last = state.get<FarFieldState>();
    StaticFarFieldState &far  = state.get<StaticFarFieldState>();
    if (!last.active)
      return;
    far.origin           = last.origin;
    far.held             = last.held;
    const VectorXd given = from_given * waves.given_values(state);
    for (unsigned int k = 0; k < node_list.size(); ++k)
    {
      const auto force = thickness * transfer.force(k, given);
      for (unsigned int d = 0; d < force.dimension; ++d)
        far.held[2 * k + d] -= force[d];
    }
  }

  double StaticFarField::energy_of(const VectorXd &motion) const
  {
    return 0.5 * (stiffness * motion).cwiseProduct(areas).dot(motion);
  }

  void StaticFarField::gather_displacement(
      const std::vector<CapturedNode<2>> &captured, VectorXd &means) const
  {
    transfer.gather([&](const unsigned int k)
                    { return captured[captured_positions[k]].displacement; },
                    means);
  }

  void
  StaticFarField::prepare_step(const StepContext &step,
                               const std::vector<CapturedNode<2>> &captured)
  {
    if (step.dt == prepared_step && step.dt_velocity == prepared_velocity_step)
      return;
    prepared_step          = step.dt;
    prepared_velocity_step = step.dt_velocity;
    gain.clear();
    for (const unsigned int c : captured_positions)
      gain.push_back(step.dt_velocity / captured[c].mass);
    const MatrixXd mobility = thickness * transfer.mobility(gain);
    const Eigen::Index n    = stiffness.rows();
    from_motion
        = Eigen::PartialPivLU<MatrixXd>(MatrixXd::Identity(n, n)
                                        + 0.25 * step.dt * stiffness * mobility)
              .solve(stiffness);
  }

  void StaticFarField::correct(const StepContext &step,
                               const std::vector<CapturedNode<2>> &captured,
                               State<2> &state)
  {
    StaticFarFieldState &far = state.get<StaticFarFieldState>();
    if (!far.active)
      start(step, captured, state);
    prepare_step(step, captured);

    const auto node = [&](const unsigned int k) -> const CapturedNode<2> &
    { return captured[captured_positions[k]]; };
    transfer.gather([&](const unsigned int k) { return node(k).velocity; },
                    v_before);
    transfer.gather(
        [&](const unsigned int k)
        { return gain[k] * (node(k).force + vector_at(far.held, k)); },
        change);
    gather_displacement(captured, u);
    u -= VectorXd::Map(far.origin.data(), u.size());
    // With mass damping of the added mass, too, so that this is all of it.
    mean = u + 0.25 * step.dt * change
           + 0.25 * (step.dt - step.dt_before) * v_before;
    p.noalias() = from_motion * mean;

    const double a = 0.5 * step.dt_velocity * step.mass_damping;
    for (unsigned int k = 0; k < node_list.size(); ++k)
    {
      const dealii::Tensor<1, 2> total = node(k).force + vector_at(far.held, k)
                                         - thickness * transfer.force(k, p);
      const dealii::Tensor<1, 2> v1
          = ((1. - a) * node(k).velocity + gain[k] * total) / (1. + a);
      move_own(step, node(k), v1, state);
    }
  }

  void StaticFarField::account(const StepContext &step,
                               const std::vector<CapturedNode<2>> &captured,
                               State<2> &state)
  {
    StaticFarFieldState &far = state.get<StaticFarFieldState>();
    last_resultant           = {};
    for (unsigned int k = 0; k < node_list.size(); ++k)
    {
      const CapturedNode<2> &before = captured[captured_positions[k]];
      const auto traction           = transfer.force(k, p);
      dealii::Tensor<1, 2> reaction;
      for (unsigned int d = 0; d < reaction.dimension; ++d)
      {
        const double v0 = before.velocity[d];
        const double v1 = state.velocity[before.node][d];
        const double w0 = 0.5 * step.dt_before * v0;
        const double w1 = 0.5 * step.dt * v1;
        const bool own  = before.owner[d] == this;
        // Who else moves the node works against the domain, too.
        const double held = own ? far.held[2 * k + d] : thickness * traction[d];
        state.energy.external += held * w0;
        state.pending.external += held * w1;
        if (!own)
          continue;
        const double rayleigh
            = step.mass_damping * before.mass * 0.5 * (v0 + v1);
        state.energy.damping += rayleigh * w0;
        state.pending.damping += rayleigh * w1;
        reaction[d] = held - thickness * traction[d];
      }
      add_force(reaction, place_before(before, state.nodes[before.node]),
                last_resultant);
    }
    transfer.gather(
        [&](const unsigned int k)
        { return state.velocity[captured[captured_positions[k]].node]; },
        v_after);
    book_stored(step, state);
  }

  void StaticFarField::book_stored(const StepContext &step, State<2> &state)
  {
    // Positions half a step before and after, between which the trapezoidal
    // work of K times their mean is the change of the energy.
    v_before *= 0.5 * step.dt_before;
    v_after *= 0.5 * step.dt;
    before                   = u - v_before;
    after                    = u + v_after;
    elastic_before.noalias() = stiffness * before;
    elastic.noalias()        = 0.5 * stiffness * after;
    elastic += 0.5 * elastic_before;
    StaticFarFieldState &far = state.get<StaticFarFieldState>();
    far.stored               = far.stored_before
                 + 0.5 * elastic_before.cwiseProduct(areas).dot(before)
                 + elastic.cwiseProduct(areas).dot(v_before);
    if (!is_first_rank)
      return;
    const auto damping = (p - elastic).cwiseProduct(areas);
    state.energy.damping += damping.dot(v_before);
    state.pending.damping += damping.dot(v_after);
  }

  void StaticFarField::hold(const dealii::Tensor<1, 2> *force,
                            State<2> &state) const
  {
    StaticFarFieldState &far = state.get<StaticFarFieldState>();
    if (far.active)
      return;
    far.active = true;
    far.held.clear();
    for (const unsigned int node : node_list)
      append_vector(far.held, -force[node]);
    VectorXd means;
    transfer.gather([&](const unsigned int k)
                    { return state.nodes[node_list[k]].u; },
                    means);
    far.origin.assign(means.data(), means.data() + means.size());
  }

  double StaticFarField::add_forces(const NodeRecord<2> *nodes,
                                    const StaticFarFieldState &far,
                                    dealii::Tensor<1, 2> *force) const
  {
    VectorXd means;
    transfer.gather([&](const unsigned int k) { return nodes[node_list[k]].u; },
                    means);
    means -= VectorXd::Map(far.origin.data(), means.size());
    const VectorXd traction = stiffness * means;
    for (unsigned int k = 0; k < node_list.size(); ++k)
      force[node_list[k]]
          += vector_at(far.held, k) - thickness * transfer.force(k, traction);
    return far.stored_before + 0.5 * traction.cwiseProduct(areas).dot(means);
  }

  StaticFarField::NodalStiffness
  StaticFarField::nodal_stiffness(const NodeExchange &exchange) const
  {
    const MPI_Comm communicator = exchange.communicator();
    std::vector<unsigned int> own;
    for (const unsigned int node : node_list)
      own.push_back(exchange.global(node));
    NodalStiffness result;
    for (const auto &part :
         dealii::Utilities::MPI::all_gather(communicator, own))
      result.nodes.insert(result.nodes.end(), part.begin(), part.end());
    std::sort(result.nodes.begin(), result.nodes.end());

    const Eigen::Index n = transfer.n_elements();
    MatrixXd all         = MatrixXd::Zero(result.nodes.size(), n);
    const MatrixXd rows  = transfer.weights();
    for (unsigned int k = 0; k < own.size(); ++k)
      all.row(std::lower_bound(result.nodes.begin(), result.nodes.end(), own[k])
              - result.nodes.begin())
          = rows.row(k);
    MPI_Allreduce(MPI_IN_PLACE, all.data(), all.size(), MPI_DOUBLE, MPI_SUM,
                  communicator);
    result.rows = MatrixXd::Zero(2 * own.size(), 2 * result.nodes.size());
    for (const unsigned int d : { 0, 1 })
      for (const unsigned int e : { 0, 1 })
      {
        MatrixXd part(n, n); // force by displacement of the elements
        for (Eigen::Index i = 0; i < n; ++i)
          for (Eigen::Index j = 0; j < n; ++j)
            part(i, j) = areas[2 * i] * stiffness(2 * i + d, 2 * j + e);
        const MatrixXd block = rows * part * all.transpose();
        for (Eigen::Index k = 0; k < block.rows(); ++k)
          for (Eigen::Index j = 0; j < block.cols(); ++j)
            result.rows(2 * k + d, 2 * j + e) = block(k, j);
      }
    return result;
  }
} // namespace quoin
