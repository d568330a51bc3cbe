// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/implicit/freedoms.h>
#include <quoin/loads/prescribed_motion.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    bool is_driven(const LoadComponent &component)
    {
      return component.quantity == LoadQuantity::velocity
             || component.quantity == LoadQuantity::displacement;
    }

    void sum(std::vector<std::array<double, 3>> &values, const unsigned int n,
             const MPI_Comm communicator)
    {
      if (n > 0)
        MPI_Allreduce(MPI_IN_PLACE, values.data(), 3 * n, MPI_DOUBLE, MPI_SUM,
                      communicator);
    }
  } // namespace

  double given_change(const LoadComponent &component, const double from,
                      const double to, const double stage_start)
  {
    const auto value = [&](const double t) {
      return component.value({ t, stage_start + t });
    };
    if (component.quantity == LoadQuantity::displacement)
      return value(to) - value(from);
    if (component.quantity != LoadQuantity::velocity || from == to)
      return 0.;
    // In pieces, so that short pulses are seen.
    using boost::math::quadrature::gauss_kronrod;
    constexpr unsigned int n = 16;
    double change            = 0.;
    for (unsigned int i = 0; i < n; ++i)
      change += gauss_kronrod<double, 15>::integrate(
          value, from + (to - from) * i / n, from + (to - from) * (i + 1) / n,
          15, 1e-10);
    return change;
  }

  Freedoms::Freedoms(const Model &model,
                     const std::vector<MotionConstraint<2> *> &constraints,
                     const std::vector<bool> &held, const State<2> &state)
    : model(model), communicator(model.exchange().communicator()),
      in_body(model.exchange().n_owned(), 0), absent(model.absent_nodes(state))
  {
    add_platens(constraints, state);
    add_rigid_blocks(held);

    // What acts last on a node prevails.
    const unsigned int n = model.exchange().n_owned();
    std::vector<std::array<const LoadComponent *, 2>> owner(
        n, { { nullptr, nullptr } });
    for (const MotionConstraint<2> *constraint : constraints)
      if (constraint->kind() == MotionKind::prescribed)
        for (const unsigned int node : constraint->nodes())
          for (unsigned int d = 0; d < 2; ++d)
            if (constraint->holds()[d])
              owner[node][d] = &(*constraint->parts())[d];
    for (unsigned int node = 0; node < n; ++node)
      for (unsigned int d = 0; d < 2; ++d)
        if (owner[node][d] && !in_body[node] && !absent[node])
          prescribed_list.push_back({ node, d, owner[node][d] });
    number();
  }

  void
  Freedoms::add_platens(const std::vector<MotionConstraint<2> *> &constraints,
                        const State<2> &state)
  {
    for (const MotionConstraint<2> *constraint : constraints)
    {
      const MotionConstraint<2> *platen = constraint;
      if (!platen->is_rigid_body())
        continue;
      const PlatenState &now = state.get<PlatenState>(platen->name());
      Body body;
      body.platen      = platen;
      body.rigid_block = -1;
      body.nodes       = platen->nodes();
      body.arms        = now.arms;
      body.given       = platen->holds();
      body.counts = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
      std::copy(now.centre, now.centre + 2, body.centre);
      for (const unsigned int node : body.nodes)
        in_body[node] = 1;
      body_list.push_back(body);
    }
    n_platens = body_list.size();
  }

  void Freedoms::add_rigid_blocks(const std::vector<bool> &held)
  {
    const RigidBlocks &rigid = model.rigid_blocks();
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
    {
      if (held[b])
        continue;
      const RigidBlocks::Block &block = rigid.block(b);
      Body body;
      body.platen      = nullptr;
      body.rigid_block = b;
      body.given       = { { false, false, false } };
      body.counts      = true;
      std::copy(block.centre, block.centre + 2, body.centre);
      for (unsigned int i = block.begin; i < block.end; ++i)
      {
        const auto &X = model.nodes().point(i);
        body.nodes.push_back(i);
        body.arms.push_back(X[0] - block.centre[0]);
        body.arms.push_back(X[1] - block.centre[1]);
        in_body[i] = 1;
      }
      body_list.push_back(body);
    }
  }

  void Freedoms::number()
  {
    const NodeExchange &exchange = model.exchange();
    const unsigned int n_nodes   = model.nodes().n_global();
    const unsigned int n_own     = body_list.size() - n_platens;
    const auto n_of_rank
        = dealii::Utilities::MPI::all_gather(communicator, n_own);
    const unsigned int rank
        = dealii::Utilities::MPI::this_mpi_process(communicator);
    Index next = 2 * Index(n_nodes) + 4 * n_platens, end = next;
    for (unsigned int r = 0; r < n_of_rank.size(); ++r)
    {
      if (r < rank)
        next += 4 * n_of_rank[r];
      end += 4 * n_of_rank[r];
    }

    owned_unknowns = dealii::IndexSet(end);
    if (exchange.n_owned() > 0)
    {
      const Index first = 2 * Index(exchange.global(0));
      owned_unknowns.add_range(first, first + 2 * exchange.n_owned());
    }
    for (unsigned int b = 0; b < body_list.size(); ++b)
    {
      Body &body = body_list[b];
      if (b < n_platens)
        body.first = 2 * Index(n_nodes) + 4 * b;
      else
      {
        body.first = next;
        next += 4;
      }
      if (body.counts)
        owned_unknowns.add_range(body.first, body.first + 4);
    }
    owned_unknowns.compress();

    node_list.assign(exchange.n_local(),
                     { { nothing, nothing, nothing }, { 0., 0. } });
    for (unsigned int i = 0; i < exchange.n_owned(); ++i)
      if (!in_body[i] && !absent[i])
        for (unsigned int d = 0; d < 2; ++d)
          node_list[i].unknown[d] = 2 * Index(exchange.global(i)) + d;
    for (const Prescribed &p : prescribed_list)
      node_list[p.node].unknown[p.component] = nothing;
    for (const Body &body : body_list)
      for (const unsigned int node : body.nodes)
        for (unsigned int d = 0; d < 3; ++d)
          if (!body.given[d])
            node_list[node].unknown[d] = body.first + d;
    exchange.update_ghosts(node_list.data());
  }

  Configuration Freedoms::configuration(const State<2> &state) const
  {
    Configuration result;
    result.nodes     = state.nodes;
    result.load_time = state.load_time;
    result.released  = state.get<ImplicitState>().released;
    for (const Body &body : body_list)
      if (body.platen)
      {
        const double *d = body.platen->rigid_displacement(state);
        result.bodies.push_back({ { d[0], d[1], d[2] } });
      }
      else
      {
        const RigidBlockState &block
            = state.get<RigidBlockStates>()[body.rigid_block];
        result.bodies.push_back({ { block.displacement[0],
                                    block.displacement[1], block.rotation } });
      }
    return result;
  }

  void Freedoms::write(const Configuration &configuration,
                       State<2> &state) const
  {
    state.nodes                         = configuration.nodes;
    state.load_time                     = configuration.load_time;
    state.get<ImplicitState>().released = configuration.released;
    for (unsigned int b = 0; b < body_list.size(); ++b)
    {
      const auto &d = configuration.bodies[b];
      if (body_list[b].platen)
        std::copy(
            d.begin(), d.end(),
            state.get<PlatenState>(body_list[b].platen->name()).displacement);
      else
      {
        RigidBlockState &block
            = state.get<RigidBlockStates>()[body_list[b].rigid_block];
        std::copy(d.begin(), d.begin() + 2, block.displacement);
        block.rotation = d[2];
      }
    }
  }

  void Freedoms::update_arms(const Configuration &configuration)
  {
    for (unsigned int b = 0; b < body_list.size(); ++b)
    {
      const Body &body = body_list[b];
      const double c   = std::cos(configuration.bodies[b][2]),
                   s   = std::sin(configuration.bodies[b][2]);
      for (unsigned int i = 0; i < body.nodes.size(); ++i)
      {
        Node &node  = node_list[body.nodes[i]];
        node.arm[0] = c * body.arms[2 * i] - s * body.arms[2 * i + 1];
        node.arm[1] = s * body.arms[2 * i] + c * body.arms[2 * i + 1];
      }
    }
    model.exchange().update_ghosts(node_list.data());
  }

  AlignedArray<NodeVector<2>>
  Freedoms::given_motion(const Configuration &configuration,
                         const double load_time, const double stage_start) const
  {
    AlignedArray<NodeVector<2>> motion(node_list.size(),
                                       NodeVector<2>{ { 0., 0. } });
    for (const Prescribed &p : prescribed_list)
      motion[p.node].v[p.component] = given_change(
          *p.part, configuration.load_time, load_time, stage_start);
    for (const Body &body : body_list)
    {
      if (!body.platen)
        continue;
      double change[3];
      for (unsigned int d = 0; d < 3; ++d)
        change[d]
            = given_change((*body.platen->parts())[d], configuration.load_time,
                           load_time, stage_start)
              * (d == 2 ? constants::degree : 1.);
      for (const unsigned int node : body.nodes)
      {
        const double *arm = node_list[node].arm;
        motion[node].v[0] = change[0] - change[2] * arm[1];
        motion[node].v[1] = change[1] + change[2] * arm[0];
      }
    }
    model.exchange().update_ghosts(motion.data());
    return motion;
  }

  void Freedoms::move(const Vector &increment, const double share,
                      const double load_time, const double stage_start,
                      Configuration &configuration) const
  {
    const double before     = configuration.load_time;
    configuration.load_time = load_time;
    for (unsigned int i = 0; i < in_body.size(); ++i)
      if (!in_body[i])
        for (unsigned int d = 0; d < 2; ++d)
          if (node_list[i].unknown[d] != nothing)
            configuration.nodes[i].u[d]
                += share * increment(node_list[i].unknown[d]);
    for (const Prescribed &p : prescribed_list)
      configuration.nodes[p.node].u[p.component]
          += given_change(*p.part, before, load_time, stage_start);

    // All ranks know how platens move; the first one solves for it.
    std::vector<std::array<double, 3>> changes(body_list.size(),
                                               { { 0., 0., 0. } });
    for (unsigned int b = 0; b < body_list.size(); ++b)
      for (unsigned int d = 0; d < 3; ++d)
        if (body_list[b].counts && !body_list[b].given[d])
          changes[b][d] = share * increment(body_list[b].first + d);
    sum(changes, n_platens, communicator);
    for (unsigned int b = 0; b < body_list.size(); ++b)
      for (unsigned int d = 0; d < 3; ++d)
        configuration.bodies[b][d]
            += body_list[b].given[d]
                   ? given_change((*body_list[b].platen->parts())[d], before,
                                  load_time, stage_start)
                         * (d == 2 ? constants::degree : 1.)
                   : changes[b][d];
    place(configuration);
    model.exchange().update_ghosts(configuration.nodes.data());
  }

  void Freedoms::place(Configuration &configuration) const
  {
    for (unsigned int b = 0; b < body_list.size(); ++b)
    {
      const Body &body = body_list[b];
      const auto &d    = configuration.bodies[b];
      const double c = std::cos(d[2]), s = std::sin(d[2]);
      for (unsigned int i = 0; i < body.nodes.size(); ++i)
      {
        NodeRecord<2> &node = configuration.nodes[body.nodes[i]];
        const double x = body.arms[2 * i], y = body.arms[2 * i + 1];
        // The sum of what nearly cancels first, to keep digits.
        node.u[0]
            = body.centre[0] + x - node.X[0] + d[0] + (c - 1.) * x - s * y;
        node.u[1]
            = body.centre[1] + y - node.X[1] + d[1] + s * x + (c - 1.) * y;
      }
    }
  }

  void Freedoms::project(const AlignedArray<NodeVector<2>> &force,
                         const std::vector<std::array<double, 3>> &body_force,
                         Vector &right_hand_side) const
  {
    right_hand_side = 0.;
    for (unsigned int i = 0; i < in_body.size(); ++i)
      if (!in_body[i])
        for (unsigned int d = 0; d < 2; ++d)
          if (node_list[i].unknown[d] != nothing)
            right_hand_side(node_list[i].unknown[d]) = force[i].v[d];
    const auto sums = body_forces(force);
    for (unsigned int b = 0; b < body_list.size(); ++b)
      for (unsigned int d = 0; d < 3; ++d)
        if (body_list[b].counts && !body_list[b].given[d])
          right_hand_side(body_list[b].first + d)
              = sums[b][d] + body_force[b][d];
    right_hand_side.compress(dealii::VectorOperation::insert);
  }

  std::vector<std::array<double, 3>>
  Freedoms::body_forces(const AlignedArray<NodeVector<2>> &force) const
  {
    std::vector<std::array<double, 3>> result(body_list.size(),
                                              { { 0., 0., 0. } });
    for (unsigned int b = 0; b < body_list.size(); ++b)
      for (const unsigned int node : body_list[b].nodes)
      {
        const double *f = force[node].v, *arm = node_list[node].arm;
        result[b][0] += f[0];
        result[b][1] += f[1];
        result[b][2] += arm[0] * f[1] - arm[1] * f[0];
      }
    sum(result, n_platens, communicator);
    return result;
  }

  std::vector<std::array<double, 3>>
  Freedoms::drives(const double load_time, const double stage_start) const
  {
    std::vector<std::array<double, 3>> result(body_list.size(),
                                              { { 0., 0., 0. } });
    for (unsigned int b = 0; b < body_list.size(); ++b)
      for (unsigned int d = 0; d < 3; ++d)
        if (body_list[b].platen
            && !is_driven((*body_list[b].platen->parts())[d]))
          result[b][d] = (*body_list[b].platen->parts())[d].value(
              { load_time, stage_start + load_time });
    return result;
  }
} // namespace quoin
