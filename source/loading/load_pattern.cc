// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/loading/load_pattern.h>
#include <quoin/model/block_placement.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Share of the largest target from which on the ratio of the mean to a
        named displacement counts, and its largest value or inverse. */
    constexpr double least_share = 1e-3, largest_ratio = 1e3;
    /** Least time t_r by the duration of the stage. */
    constexpr double least_response = 0.005;

    /** Throws an InputError if @p load changes in the stage. */
    template <int dim>
    void refuse_change(const NodalLoad<dim> &load, const StageParameters &stage)
    {
      if (load.traits().follows_crack)
        throw InputError("section 'Stages/" + stage.name
                         + "': 'Load pattern' names '" + load.name()
                         + "', an uplift that changes with the crack, but the "
                           "loads of a pattern keep their distribution. Take "
                           "'In cracks = given' in 'Loads/"
                         + load.name() + "', or leave it out of the pattern.");
      const auto start = load.amplitude({ 0., 0. });
      for (const double share : { 0.01, 0.37, 1. })
        if (load.amplitude({ share * stage.duration, 1e3 + stage.duration })
            != start)
          throw InputError("section 'Stages/" + stage.name
                           + "': 'Load pattern' names '" + load.name()
                           + "', which changes in time, but the factor of the "
                             "pattern is what the stage finds. Give that load "
                             "a constant value, its size at the factor 1.");
    }
  } // namespace

  template <int dim>
  LoadPattern<dim>::LoadPattern(
      const Model<dim> &model, const StageParameters &stage,
      const std::vector<NodalLoad<dim>> &loads,
      const std::vector<MotionConstraint<dim> *> &constraints,
      const std::vector<DisplacementTerm> *measured, const State<dim> &state)
    : model(model), stage_name(stage.name), control(stage.pattern->control),
      is_named(measured), duration(stage.duration)
  {
    const std::string where = "section 'Stages/" + stage.name + "': ";
    if (model.parameters().contact.has_box
        && model.parameters().contact.outside
               == ContactParameters::Outside::remove)
      throw InputError(where
                       + "'Load pattern' cannot follow blocks that 'Outside "
                         "the box = delete' of section 'Contact' takes away "
                         "with their loads. Take 'report'.");
    nodal.assign(model.nodes().n_local(), dealii::Tensor<1, dim>());
    for (const NodalLoad<dim> &load : loads)
      if (is_among(load.name(), stage.pattern->loads))
      {
        refuse_change(load, stage);
        load.add_loads(TimePoint{ 0., 0. }, nodal.data());
      }
    const auto absent = absent_nodes(model, state);
    for (unsigned int i = 0; i < nodal.size(); ++i)
      if (absent[i] || i >= model.nodes().n_owned())
        nodal[i] = dealii::Tensor<1, dim>();
    double size = 0.;
    for (const dealii::Tensor<1, dim> &force : nodal)
      for (unsigned int d = 0; d < dim; ++d)
        size += std::abs(force[d]);
    if (dealii::Utilities::MPI::sum(size, model.nodes().communicator()) == 0.)
      throw InputError(where
                       + "the loads of 'Load pattern' are zero, so that no "
                         "factor of theirs moves anything. Give them their "
                         "size at the factor 1.");
    find_mean(constraints);
    if (measured)
      named = *measured;
  }

  template <int dim>
  void LoadPattern<dim>::find_mean(
      const std::vector<MotionConstraint<dim> *> &constraints)
  {
    auto free = nodal;
    for (const MotionConstraint<dim> *constraint : constraints)
      for (const unsigned int node : constraint->nodes())
        for (unsigned int d = 0; d < dim; ++d)
          if (constraint->traits().holds[d])
            free[node][d] = 0.;
    for (const dealii::Tensor<1, dim> &force : free)
      scale += force.norm();
    scale = dealii::Utilities::MPI::sum(scale, model.nodes().communicator());
    if (scale == 0.)
      throw InputError("section 'Stages/" + stage_name
                       + "': all that the loads of 'Load pattern' act on is "
                         "held by other loads of the stage. Leave some of it "
                         "free to move.");
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        if (free[i][d] != 0.)
          mean.push_back({ i, d, free[i][d] / scale });
  }

  namespace
  {
    template <int dim>
    double sum_of(const std::vector<DisplacementTerm> &terms,
                  const AlignedArray<NodeRecord<dim>> &nodes)
    {
      double sum = 0.;
      for (const DisplacementTerm &term : terms)
        sum += term.weight * nodes[term.node].u[term.component];
      return sum;
    }
  } // namespace

  template <int dim>
  double LoadPattern<dim>::displacement(
      const AlignedArray<NodeRecord<dim>> &nodes) const
  {
    return dealii::Utilities::MPI::sum(sum_of(measure(), nodes),
                                       model.nodes().communicator());
  }

  template <int dim>
  double
  LoadPattern<dim>::unit_work(const AlignedArray<NodeRecord<dim>> &nodes) const
  {
    return scale
           * dealii::Utilities::MPI::sum(sum_of(mean, nodes),
                                         model.nodes().communicator());
  }

  template <int dim>
  double LoadPattern<dim>::largest_target() const
  {
    double largest = 0.;
    for (unsigned int i = 0; i <= 100; ++i)
      largest = std::max(largest, std::abs(target(0.01 * i * duration)));
    return largest;
  }

  template <int dim>
  LoadPatternState
  LoadPattern<dim>::begin(const double at,
                          const AlignedArray<NodeRecord<dim>> &nodes) const
  {
    LoadPatternState own;
    own.factor     = at;
    own.start      = displacement(nodes);
    own.mean_start = own.mean = dealii::Utilities::MPI::sum(
        sum_of(mean, nodes), model.nodes().communicator());
    own.wanted = target(0.);
    return own;
  }

  template <int dim>
  std::array<double, dim> LoadPattern<dim>::resultant() const
  {
    std::array<double, dim> sum{};
    for (const dealii::Tensor<1, dim> &force : nodal)
      for (unsigned int d = 0; d < dim; ++d)
        sum[d] += force[d];
    MPI_Allreduce(MPI_IN_PLACE, sum.data(), dim, MPI_DOUBLE, MPI_SUM,
                  model.nodes().communicator());
    return sum;
  }

  template <int dim>
  void LoadPattern<dim>::set_mobility(
      const std::vector<double> &mass,
      const std::vector<MotionConstraint<dim> *> &constraints,
      const RigidBlockStage &rigid, const double response_time)
  {
    rigid_stage = rigid;
    response    = std::max(response_time, least_response * duration);
    least_moved = least_share * largest_target();
    std::vector<std::array<bool, dim>> is_held(nodal.size());
    bool moves_platen = false;
    for (const MotionConstraint<dim> *constraint : constraints)
    {
      const ConstraintTraits &traits = constraint->traits();
      if (traits.kind == MotionKind::absorbing)
        throw InputError("section 'Stages/" + stage_name
                         + "': 'Load pattern' is for quasi-static loading, but "
                           "waves pass through the boundary of the load '"
                         + constraint->name()
                         + "'. Hold that boundary by a prescribed motion.");
      for (const unsigned int node : constraint->nodes())
        for (unsigned int d = 0; d < dim; ++d)
        {
          is_held[node][d] = is_held[node][d] || traits.moves(d);
          moves_platen     = moves_platen
                         || (traits.is_rigid_body() && nodal[node][d] != 0.
                             && !(traits.holds[d] && traits.holds_rotation));
        }
    }
    const MPI_Comm communicator = model.nodes().communicator();
    if (dealii::Utilities::MPI::max(unsigned(moves_platen), communicator) > 0)
      throw InputError(
          "section 'Stages/" + stage_name
          + "': 'Load pattern' acts on a platen that is free to move with it. "
            "Drive or hold that platen along the loads and in its rotation"
          + std::string(dim == 2
                            ? ", or replace it by a block with 'Law = rigid'."
                            : "."));
    loaded.clear();
    node_gain = 0.;
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
    {
      LoadedNode node{ i, {}, {} };
      bool is_loaded = false;
      for (unsigned int d = 0; d < dim; ++d)
      {
        node.force[d] = nodal[i][d];
        is_loaded     = is_loaded || node.force[d] != 0.;
        if (is_held[i][d] || i >= model.nodes().n_deformable_nodes())
          continue;
        node.gain[d] = node.force[d] / mass[i];
        node_gain += node.force[d] * node.gain[d];
      }
      if (is_loaded)
        loaded.push_back(node);
    }
  }

  template <int dim>
  void LoadPattern<dim>::add_forces(const StepContext &, State<dim> &state,
                                    const NodeForces<dim> &forces)
  {
    factor       = state.template get<LoadPatternState>().factor;
    power_before = 0.;
    for (const LoadedNode &node : loaded)
      for (unsigned int d = 0; d < dim; ++d)
      {
        forces.force[node.node][d] += factor * node.force[d];
        power_before += node.force[d] * state.velocity[node.node][d];
      }
  }

  template <int dim>
  double
  LoadPattern<dim>::external_power(const TimePoint &,
                                   const dealii::Tensor<1, dim> *velocity) const
  {
    double power = 0.;
    for (const LoadedNode &node : loaded)
      for (unsigned int d = 0; d < dim; ++d)
        power += node.force[d] * velocity[node.node][d];
    return factor * power;
  }

  template <int dim>
  void LoadPattern<dim>::advance_mean(const StepContext &step, const double at,
                                      LoadPatternState &own) const
  {
    const double moved  = at - own.start;
    const double wanted = target(step.end.stage);
    if (std::abs(moved) > least_moved)
    {
      const double ratio = (own.mean - own.mean_start) / moved;
      own.ratio          = std::copysign(
                   std::clamp(std::abs(ratio), 1. / largest_ratio, largest_ratio),
                   ratio);
    }
    // Four times the filter's time makes the loop critically damped.
    const double aim = own.ratio
                       * ((wanted - own.wanted) / step.dt
                          + (wanted - moved) / (4. * response));
    own.rate += step.dt / response * (aim - own.rate);
    own.mean += step.dt * own.rate;
    own.wanted = wanted;
  }

  template <int dim>
  void LoadPattern<dim>::correct(const StepContext &step, State<dim> &state)
  {
    LoadPatternState &own = state.template get<LoadPatternState>();
    // S w after the step without the change of lambda, by how much an impulse
    // raises its rate, and the named displacement.
    double sums[3] = { scale * sum_of(mean, state.nodes), node_gain,
                       sum_of(named, state.nodes) };
    if constexpr (dim == 2)
      sums[1] += model.rigid_blocks().mobility(rigid_stage, nodal.data(),
                                               step.dt, state);
    MPI_Allreduce(MPI_IN_PLACE, sums, 3, MPI_DOUBLE, MPI_SUM,
                  model.nodes().communicator());
    if (is_named)
      advance_mean(step, sums[2], own);
    else
      own.mean = own.start + target(step.end.stage);
    const double missing = scale * own.mean - sums[0];
    const double push    = missing / (step.dt * sums[1]);
    const double change  = push
                          * (1. + 0.5 * step.dt_velocity * step.mass_damping)
                          / step.dt_velocity;

    for (const LoadedNode &node : loaded)
      for (unsigned int d = 0; d < dim; ++d)
      {
        const double gained = push * node.gain[d];
        state.velocity[node.node][d] += gained;
        state.nodes[node.node].u[d] += step.dt * gained;
      }
    if constexpr (dim == 2)
      model.rigid_blocks().push(rigid_stage, nodal.data(), push, step.dt,
                                state);
    // The work of the change over the last half step.
    state.energy.external += 0.5 * step.dt_before * change * power_before;
    own.factor += change;
    factor = own.factor;
  }

  template class LoadPattern<2>;
  template class LoadPattern<3>;
} // namespace quoin
