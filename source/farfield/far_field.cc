// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/operators/archive.h>
#include <quoin/base/exceptions.h>
#include <quoin/farfield/far_field.h>
#include <quoin/tdbem/plain_vector.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /**
     * Without what is below rounding beside the largest of its row: the newest
     * step reaches few elements, so that little is left.
     */
    Eigen::SparseMatrix<double, Eigen::RowMajor>
    without_rounding(const MatrixXd &matrix)
    {
      constexpr double smallest = 1e-17;
      std::vector<Eigen::Triplet<double>> entries;
      for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      {
        const double threshold = smallest * matrix.row(i).cwiseAbs().maxCoeff();
        for (Eigen::Index j = 0; j < matrix.cols(); ++j)
          if (std::abs(matrix(i, j)) > threshold)
            entries.emplace_back(i, j, matrix(i, j));
      }
      Eigen::SparseMatrix<double, Eigen::RowMajor> result(matrix.rows(),
                                                          matrix.cols());
      result.setFromTriplets(entries.begin(), entries.end());
      return result;
    }
  } // namespace

  FarField::FarField(const std::string &name, FarFieldDomain domain,
                     const NodeMap<2> &node_map,
                     const std::vector<BoundaryFace<2>> &faces,
                     const double thickness)
    : problem(std::move(domain)),
      transfer(problem.boundary, problem.interface, node_map, faces),
      thickness(thickness), communicator(node_map.communicator()),
      is_first_rank(
          dealii::Utilities::MPI::this_mpi_process(node_map.communicator())
          == 0)
  {
    load_name        = name;
    own_traits.phase = "far field";
    node_list        = transfer.nodes();
    for (const unsigned int element : problem.interface)
      for (const unsigned int d : { 0U, 1U })
        unknowns.push_back(2 * element + d);
    problem.traction_is_given.resize(problem.boundary.n_unknowns(), true);
    for (const unsigned int k : unknowns)
      problem.traction_is_given[k] = false;
    area.resize(Eigen::Index(unknowns.size()));
    for (unsigned int e = 0; e < transfer.n_elements(); ++e)
      area.segment<2>(2 * e).setConstant(transfer.lengths()[e] * thickness);
    outer_area.resize(Eigen::Index(problem.boundary.n_unknowns()));
    for (unsigned int e = 0; e < problem.boundary.n_elements(); ++e)
      outer_area.segment<2>(2 * e).setConstant(
          problem.boundary.elements[e].length() * thickness);
    outer_area(unknowns).setZero();
  }

  FarField::~FarField() = default;

  void FarField::set_time_step(const double time_step,
                               const unsigned int n_substeps,
                               const unsigned long n_steps)
  {
    if (n_substeps != substeps)
      last_incident.reset(); // see time_of_steps()
    substeps = n_substeps;
    if (kernel)
      return;
    dt                          = time_step;
    FormulationOptions &options = problem.formulation;
    options.time_step           = time_step;
    options.n_steps             = n_steps;
    kernel    = make_lag_kernel(problem.boundary, problem.medium, options);
    history   = make_history(*kernel, problem.boundary, options, communicator);
    marching  = std::make_unique<TimeMarching>(*kernel, *history,
                                              problem.traction_is_given);
    stiffness = marching->condensed_matrix(unknowns);
    impedance = dt * stiffness;
    // What is implicit must dissipate, or the blocks' step is not stable.
    const VectorXd root = area.cwiseSqrt();
    const MatrixXd power
        = root.asDiagonal() * impedance * root.cwiseInverse().asDiagonal();
    const double smallest
        = Eigen::SelfAdjointEigenSolver<MatrixXd>(
              0.5 * (power + power.transpose()), Eigen::EigenvaluesOnly)
              .eigenvalues()(0);
    if (!(smallest > 0.))
      throw InputError(
          "section 'Boundary elements': in the first time step the rock beyond "
          "the blocks would not resist their motion, and the coupling would be "
          "unstable. Raise 'Step ratio', or give a boundary with elements of "
          "more equal length.");
  }

  // -- stages ----------------------------------------------------------------

  void FarField::prepare(State<2> &state) const
  {
    state.add<FarFieldState>();
  }

  void FarField::begin_stage(State<2> &state, const bool continues)
  {
    last_incident.reset();
    prepared_step = 0.;
    if (!continues)
      state.get<FarFieldState>() = FarFieldState();
    resume_stage(state);
  }

  void FarField::save(State<2> &state) const
  {
    if (!marching || !state.get<FarFieldState>().active)
      return;
    state.get<FarFieldState>().history = history->save();
  }

  void FarField::resume_stage(const State<2> &state)
  {
    const FarFieldState &far = state.get<FarFieldState>();
    last_incident.reset();
    prepared_step = 0.;
    if (!far.active || far.history.empty())
      return;
    history->restore(far.history);
    marching->restore(to_eigen(far.displacement), to_eigen(far.traction));
    frozen              = to_eigen(far.frozen);
    p_of_history_is_due = true;
    incident_is_due     = true;
  }

  void FarField::start(const std::vector<CapturedNode<2>> &captured,
                       State<2> &state)
  {
    FarFieldState &far = state.get<FarFieldState>();
    far                = FarFieldState();
    far.active         = true;
    for (const unsigned int c : captured_positions)
      append_vector(far.held, captured[c].begun - captured[c].force);
    VectorXd values;
    transfer.gather([&](const unsigned int k)
                    { return captured[captured_positions[k]].displacement; },
                    values);
    far.origin      = to_vector(values);
    const auto none = std::vector<double>(unknowns.size(), 0.);
    far.last_motion = far.frozen = far.velocity_sum = far.traction_sum = none;
    far.displacement.assign(problem.boundary.n_unknowns(), 0.);
    far.velocity = far.traction = far.displacement;
    frozen                      = to_eigen(none);
    find_incident(far);
  }

  // -- a step of the boundary elements -------------------------------------

  double FarField::time_of_steps(const std::uint64_t n_steps) const
  {
    const double lag = problem.scheme == CouplingScheme::staggered
                           ? 0.
                           : 0.5 * dt / double(substeps);
    return double(n_steps) * dt - lag;
  }

  void FarField::find_incident(const FarFieldState &far)
  {
    const auto part
        = [&](const VectorXd &values) { return VectorXd(values(unknowns)); };
    const VectorXd none = VectorXd::Zero(Eigen::Index(unknowns.size()));
    incident_is_due     = false;
    incident_u = incident_velocity = incident_p = none;
    if (incident_displacement)
    {
      const IncidentStep &wave = incident_step(far.n_steps);
      incident_u               = part(wave.displacement);
      incident_velocity        = (incident_u - part(wave.before)) / dt;
      incident_p               = part(wave.traction);
    }
  }

  const FarField::IncidentStep &
  FarField::incident_step(const std::uint64_t step)
  {
    if (last_incident && last_incident->step == step)
      return *last_incident;
    const double begin = time_of_steps(step), end = time_of_steps(step + 1);
    IncidentStep wave;
    wave.step         = step;
    wave.before       = last_incident && last_incident->step + 1 == step
                            ? std::move(last_incident->displacement)
                            : incident_displacement(begin);
    wave.displacement = incident_displacement(end);
    wave.traction     = incident_traction(begin, end);
    last_incident     = std::move(wave);
    return *last_incident;
  }

  VectorXd FarField::scattered_values(const std::uint64_t step)
  {
    const auto n       = Eigen::Index(problem.boundary.n_unknowns());
    const double begin = time_of_steps(step), end = time_of_steps(step + 1);
    VectorXd values = problem.given ? problem.given(std::max(0., begin), end)
                                    : VectorXd(VectorXd::Zero(n));
    if (!incident_displacement)
      return values;
    const IncidentStep &wave = incident_step(step);
    for (Eigen::Index k = 0; k < n; ++k)
      values[k] -= problem.traction_is_given[k] ? wave.traction[k]
                                                : wave.displacement[k];
    return values;
  }

  void FarField::begin_element_step(State<2> &state)
  {
    FarFieldState &far = state.get<FarFieldState>();
    find_incident(far);
    const VectorXd rest
        = marching->condensed_load(unknowns, scattered_values(far.n_steps));
    frozen = rest + stiffness * (to_eigen(far.last_motion) - incident_u)
             + incident_p;
    far.frozen          = to_vector(frozen);
    p_of_history_is_due = true;
    std::fill(far.velocity_sum.begin(), far.velocity_sum.end(), 0.);
    std::fill(far.traction_sum.begin(), far.traction_sum.end(), 0.);
    far.duration = far.square_sum = 0.;
  }

  void FarField::finish_element_step(State<2> &state)
  {
    FarFieldState &far  = state.get<FarFieldState>();
    const VectorXd last = to_eigen(far.last_motion);
    // Motion by the mean velocities, so that the tractions are those that
    // acted.
    const VectorXd motion = problem.scheme == CouplingScheme::staggered
                                ? last_u
                                : VectorXd(last + to_eigen(far.velocity_sum));
    VectorXd given        = scattered_values(far.n_steps);
    given(unknowns)       = motion - incident_u;
    marching->begin_step(given);

    const VectorXd mean      = (motion - last) / dt;
    const VectorXd total     = marching->p()(unknowns) + incident_p;
    const VectorXd scattered = total - incident_p;
    const auto work = [&](const VectorXd &traction, const VectorXd &velocity)
    { return dt * traction.cwiseProduct(area).dot(velocity); };
    const double radiated = work(scattered, mean - incident_velocity);
    far.ledger.radiated += radiated;
    far.ledger.incident += radiated - work(total, mean);
    far.ledger.substeps
        += far.square_sum
           - far.duration * (impedance * mean).cwiseProduct(area).dot(mean);
    const double scale = total.cwiseAbs().maxCoeff();
    if (scale > 0.)
      far.ledger.mismatch
          = std::max(far.ledger.mismatch,
                     (total - frozen - impedance * mean).cwiseAbs().maxCoeff()
                         / std::max(scale, frozen.cwiseAbs().maxCoeff()));

    if (problem.scheme == CouplingScheme::staggered)
      marching->finish_step(
          unknowns, to_eigen(far.traction_sum) / double(substeps) - incident_p);
    else
      marching->finish_step();
    far.ledger.given += marching->p()
                            .cwiseProduct(outer_area)
                            .dot(marching->u() - to_eigen(far.displacement));
    far.last_motion = to_vector(motion);
    far.velocity = to_vector((marching->u() - to_eigen(far.displacement)) / dt);
    far.displacement = to_vector(marching->u());
    far.traction     = to_vector(marching->p());
    far.substep      = 0;
    ++far.n_steps;
  }

  // -- a step of the blocks --------------------------------------------------

  void FarField::prepare_step(const StepContext &step,
                              const std::vector<CapturedNode<2>> &captured)
  {
    const bool same = step.dt_velocity == prepared_step
                      && step.mass_damping == prepared_damping;
    if (same)
      return;
    prepared_step    = step.dt_velocity;
    prepared_damping = step.mass_damping;
    gain.clear();
    const double a = 0.5 * step.dt_velocity * step.mass_damping;
    for (const unsigned int c : captured_positions)
      gain.push_back(step.dt_velocity / (captured[c].mass * (1. + a)));
    const MatrixXd v_by_p = thickness * transfer.mobility(gain);
    const Eigen::Index n  = v_by_p.rows();
    const Eigen::PartialPivLU<MatrixXd> lu(MatrixXd::Identity(n, n)
                                           + 0.5 * impedance * v_by_p);
    mobility            = without_rounding(v_by_p);
    from_history        = lu.inverse();
    from_motion         = without_rounding(lu.solve(0.5 * impedance));
    p_of_history_is_due = true;
  }

  void FarField::correct(const StepContext &step,
                         const std::vector<CapturedNode<2>> &captured,
                         State<2> &state)
  {
    FarFieldState &far = state.get<FarFieldState>();
    const bool begins  = !far.active;
    if (begins)
      start(captured, state);
    prepare_step(step, captured);
    const bool staggered = problem.scheme == CouplingScheme::staggered;
    from_rest            = staggered && begins;
    if (far.substep == 0 && !from_rest)
      begin_element_step(state);
    else if (incident_is_due)
      find_incident(far);

    const double a  = 0.5 * step.dt_velocity * step.mass_damping;
    const auto node = [&](const unsigned int k) -> const CapturedNode<2> &
    { return captured[captured_positions[k]]; };
    const auto free_velocity = [&](const unsigned int k)
    {
      return (1. - a) / (1. + a) * node(k).velocity
             + gain[k] * (node(k).force + vector_at(far.held, k));
    };
    transfer.gather([&](const unsigned int k) { return node(k).velocity; },
                    v_before);
    transfer.gather(free_velocity, v_free);
    if (!staggered)
    {
      if (p_of_history_is_due)
        p_of_history.noalias() = from_history * frozen;
      p_of_history_is_due = false;
      v_mean              = v_before + v_free;
      p                   = p_of_history;
      p.noalias() += from_motion * v_mean;
    }
    else
    {
      transfer.gather(
          [&](const unsigned int k) { return node(k).displacement; }, last_u);
      last_u -= to_eigen(far.origin);
      p = frozen;
      if (!from_rest)
        p += stiffness * (last_u - to_eigen(far.last_motion))
             * (double(substeps) / double(far.substep + 1));
    }
    v_after = v_free;
    v_after.noalias() -= mobility * p;

    for (unsigned int k = 0; k < node_list.size(); ++k)
    {
      const dealii::Tensor<1, 2> v1
          = free_velocity(k) - gain[k] * thickness * transfer.force(k, p);
      move_own(step, node(k), v1, state);
    }
  }

  void FarField::account(const StepContext &step,
                         const std::vector<CapturedNode<2>> &captured,
                         State<2> &state)
  {
    FarFieldState &far = state.get<FarFieldState>();
    last_resultant     = {};
    for (unsigned int k = 0; k < node_list.size(); ++k)
    {
      const CapturedNode<2> &before = captured[captured_positions[k]];
      const auto traction           = transfer.force(k, p);
      dealii::Tensor<1, 2> reaction;
      for (unsigned int d = 0; d < reaction.dimension; ++d)
      {
        if (before.owner[d] != this)
          continue;
        const double v0    = before.velocity[d];
        const double v1    = state.velocity[before.node][d];
        const double force = far.held[2 * k + d] - thickness * traction[d];
        const double rayleigh
            = step.mass_damping * before.mass * 0.5 * (v0 + v1);
        const double w0 = 0.5 * step.dt_before * v0;
        const double w1 = 0.5 * step.dt * v1;
        state.energy.external += force * w0;
        state.pending.external += force * w1;
        state.energy.damping += rayleigh * w0;
        state.pending.damping += rayleigh * w1;
        reaction[d] = force;
      }
      add_force(reaction, place_before(before, state.nodes[before.node]),
                last_resultant);
    }
    if (is_first_rank)
    {
      // The work done on the scattered field of the domain has left the model.
      const auto power = [&](const VectorXd &v) {
        return (p - incident_p).cwiseProduct(area).dot(v - incident_velocity);
      };
      const double now  = 0.5 * step.dt_before * power(v_before);
      const double next = 0.5 * step.dt * power(v_after);
      state.energy.radiated += now;
      state.energy.external += now;
      state.pending.radiated += next;
      state.pending.external += next;
    }

    if (from_rest)
      return;
    v_mean = 0.5 * (v_before + v_after);
    Eigen::Map<VectorXd>(far.velocity_sum.data(), v_mean.size())
        += step.dt_velocity * v_mean;
    Eigen::Map<VectorXd>(far.traction_sum.data(), p.size()) += p;
    far.duration += step.dt_velocity;
    // Work of what the impedance adds to the frozen tractions.
    far.square_sum
        += step.dt_velocity * (p - frozen).cwiseProduct(area).dot(v_mean);
    if (++far.substep == substeps)
      finish_element_step(state);
  }

  VectorXd FarField::given_values(const State<2> &state) const
  {
    const std::uint64_t n_steps = state.get<FarFieldState>().n_steps;
    if (!problem.given || n_steps == 0)
      return VectorXd::Zero(Eigen::Index(problem.boundary.n_unknowns()));
    return problem.given(std::max(0., time_of_steps(n_steps - 1)),
                         time_of_steps(n_steps));
  }

  FarField::TotalFields FarField::total_fields(const State<2> &state) const
  {
    const FarFieldState &far = state.get<FarFieldState>();
    TotalFields fields{ to_eigen(far.displacement), to_eigen(far.velocity),
                        to_eigen(far.traction) };
    if (!incident_displacement)
      return fields;
    const double now        = time_of_steps(far.n_steps);
    const VectorXd incident = incident_displacement(now);
    fields.displacement += incident;
    if (far.n_steps > 0)
    {
      const double before = time_of_steps(far.n_steps - 1);
      fields.velocity += (incident - incident_displacement(before)) / dt;
      fields.traction += incident_traction(before, now);
    }
    return fields;
  }
} // namespace quoin
