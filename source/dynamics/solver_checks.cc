// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Checks of the state of a Solver.

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/base/point_text.h>
#include <quoin/dynamics/solver.h>
#include <quoin/mesh/global_geometry.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  template <int dim>
  std::vector<UnsupportedBody<dim>>
  Solver<dim>::unsupported_bodies(const State<dim> &state) const
  {
    constexpr unsigned int n_times = 32;
    const double duration
        = stage.end == StageEnd::time ? stage.duration : stage.minimum_duration;
    std::vector<TimePoint> times;
    for (unsigned int i = 0; i <= n_times; ++i)
    {
      const double t = duration * i / n_times;
      times.push_back({ t, state.stage_start + t });
    }
    return find_unsupported_bodies(model, constraints_on, loads_on, times,
                                   state);
  }

  template <int dim>
  void Solver<dim>::check_finite(const State<dim> &state) const
  {
    unsigned int bad     = NodeMap<dim>::none;
    const unsigned int n = model.exchange().n_owned();
    for (unsigned int i = 0; i < n && bad == NodeMap<dim>::none; ++i)
      for (const double u : state.nodes[i].u)
        if (!(std::abs(u) < 1e100)) // a comparison with NaN is false
          bad = i;
    dealii::Point<dim> p;
    unsigned int block = 0;
    if (!first_point(model.nodes(), bad, p, &block))
      return;
    check_loads(state, state.load_time);
    std::ostringstream message;
    message << "the motion is no longer finite in block " << block << " at "
            << point_text(p) << " m, found at time " << state.time
            << " s, step " << state.step
            << ". The usual causes are a load that grows "
            << "without bound, a value that is not a number in a function of "
            << "time, or a collapse: look at the last fields, reduce 'Share "
            << "of critical time step' or end the stage earlier. The last "
            << "checkpoint is kept.";
    throw RunError(message.str());
  }

  template <int dim>
  void Solver<dim>::check_loads(const State<dim> &state,
                                const double load_time) const
  {
    const TimePoint time{ load_time, state.stage_start + load_time };
    const auto check = [&](const auto &values, const std::string &name)
    {
      if (!std::all_of(values.begin(), values.end(),
                       [](const double value) { return std::isfinite(value); }))
        throw RunError("the load '" + name
                       + "' is no finite number at the time "
                       + number_text(time.stage) + " s of stage '" + stage.name
                       + "', T = " + number_text(time.total)
                       + " s. Correct its function of time in section 'Loads/"
                       + name + "', or end the stage earlier.");
    };
    for (const NodalLoad<dim> *load : loads_on)
      check(load->amplitude(time), load->name());
    for (const MotionConstraint<dim> *constraint : constraints_on)
      check(constraint->values(time), constraint->name());
  }

  template <>
  double Solver<2>::largest_slip_share(const State<2> &state) const
  {
    const NodeMap<2> &nodes     = model.nodes();
    const MatchedJoints &joints = model.joints();
    double largest              = 0.;
    for (unsigned int i = 0; i < joints.n_segments(); ++i)
    {
      const auto &[a, b]  = joints.segment(i).lower;
      const double length = nodes.point(a).distance(nodes.point(b));
      const auto gaps     = joints.gaps(state.nodes.data(), i);
      for (unsigned int k = 0; k < 2; ++k)
        if (state.get<JointHistory>().normal_traction[2 * i + k] < 0.)
          largest = std::max(largest, std::abs(gaps[k][1]) / length);
    }
    return dealii::Utilities::MPI::max(largest, communicator);
  }

  template <int dim>
  void Solver<dim>::check_cells(const State<dim> &state) const
  {
    // Twice the area or six times the volume, positive in valid cells.
    const auto size = [&](const unsigned int cell)
    {
      const auto &corners = model.nodes().cells().nodes[cell];
      dealii::Tensor<2, dim> edges;
      for (unsigned int k = 0; k < dim; ++k)
        for (unsigned int d = 0; d < dim; ++d)
        {
          const NodeRecord<dim> &from = state.nodes[corners[0]],
                                &to   = state.nodes[corners[k + 1]];
          edges[k][d] = to.X[d] - from.X[d] + (to.u[d] - from.u[d]);
        }
      return determinant(edges);
    };
    const unsigned int n = model.n_deformable_cells();
    unsigned int bad     = 0;
    while (bad < n && size(bad) > 0.)
      ++bad;
    const unsigned int n_ranks
        = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int teller = dealii::Utilities::MPI::min(
        bad < n ? dealii::Utilities::MPI::this_mpi_process(communicator)
                : n_ranks,
        communicator);
    if (teller == n_ranks)
      return;

    // The rank that has the cell tells where it was and is now.
    struct
    {
      dealii::Point<dim> before, now;
      unsigned int block;
    } cell{};
    if (bad < n)
    {
      cell.block = model.nodes().blocks().block_of_cell(bad);
      for (const unsigned int node : model.nodes().cells().nodes[bad])
        for (unsigned int d = 0; d < dim; ++d)
        {
          const auto &[X, u] = state.nodes[node];
          cell.before[d] += X[d] / (dim + 1);
          cell.now[d] += (X[d] + u[d]) / (dim + 1);
        }
    }
    MPI_Bcast(&cell, sizeof(cell), MPI_BYTE, teller, communicator);
    std::ostringstream message;
    message << "a cell of block " << cell.block
            << " has turned inside out; it was at " << point_text(cell.before)
            << " m and is now at " << point_text(cell.now)
            << " m, found at time " << state.time << " s, step " << state.step
            << ". The usual causes are a load or an impact that crushes the "
               "block (check the units of the load, "
               "'Density' and 'Young's modulus'), a cell that is thin where "
               "the load acts (refine the mesh there), joints or contacts so "
               "soft that blocks run into each other (raise 'Normal "
               "stiffness'), or a time step too long (lower 'Share of "
               "critical time step')"
            << (dim == 3 || model.large_displacements()
                    ? ""
                    : ", or blocks that slide far or turn, which needs "
                      "'Displacements = large' in section 'Contact'")
            << ". The last checkpoint is kept.";
    throw ModelFailure(message.str());
  }

  template std::vector<UnsupportedBody<2>>
  Solver<2>::unsupported_bodies(const State<2> &) const;
  template void Solver<2>::check_finite(const State<2> &) const;
  template void Solver<2>::check_loads(const State<2> &, double) const;
  template void Solver<2>::check_cells(const State<2> &) const;
  template std::vector<UnsupportedBody<3>>
  Solver<3>::unsupported_bodies(const State<3> &) const;
  template void Solver<3>::check_finite(const State<3> &) const;
  template void Solver<3>::check_loads(const State<3> &, double) const;
  template void Solver<3>::check_cells(const State<3> &) const;
} // namespace quoin
