// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Whether the state of a Solver is still sound.

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/dynamics/solver.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  std::vector<PushedBody> Solver::pushed_bodies(const State<2> &state) const
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
    return find_pushed_bodies(model, constraints_on, loads_on, times, state);
  }

  void Solver::check_finite(const State<2> &state) const
  {
    unsigned int bad     = NodeMap<2>::none;
    const unsigned int n = model.exchange().n_owned();
    for (unsigned int i = 0; i < n && bad == NodeMap<2>::none; ++i)
      // A comparison with NaN is false.
      if (!(std::abs(state.nodes[i].u[0]) < 1e100
            && std::abs(state.nodes[i].u[1]) < 1e100))
        bad = i;
    dealii::Point<2> p;
    unsigned int block = 0;
    if (!model.nodes().first_point(bad, p, &block))
      return;
    check_loads(state, state.load_time);
    std::ostringstream message;
    message << "the motion is no longer finite in block " << block << " at ("
            << p[0] << ", " << p[1] << ") m, found at time " << state.time
            << " s, step " << state.step
            << ". The usual causes are a load that grows "
            << "without bound, a value that is not a number in a function of "
            << "time, or a collapse: look at the last fields, reduce 'Share "
            << "of critical time step' or end the stage earlier. The last "
            << "checkpoint is kept.";
    throw RunError(message.str());
  }

  void Solver::check_loads(const State<2> &state, const double load_time) const
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
    for (const NodalLoad<2> *load : loads_on)
      check(load->amplitude(time), load->name());
    for (const MotionConstraint<2> *constraint : constraints_on)
      check(constraint->values(time), constraint->name());
  }

  double Solver::largest_slip_share(const State<2> &state) const
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

  void Solver::check_cells(const State<2> &state) const
  {
    const auto twice_the_area = [&](const unsigned int cell)
    {
      const auto &[a, b, c] = model.nodes().cell(cell);
      const auto edge       = [&](const unsigned int to, const unsigned int d)
      {
        return state.nodes[to].X[d] - state.nodes[a].X[d]
               + (state.nodes[to].u[d] - state.nodes[a].u[d]);
      };
      return edge(b, 0) * edge(c, 1) - edge(b, 1) * edge(c, 0);
    };
    const unsigned int n = model.n_deformable_cells();
    unsigned int bad     = 0;
    while (bad < n && twice_the_area(bad) > 0.) // cells run anticlockwise
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
    std::array<double, 5> at{};
    if (bad < n)
    {
      at[4] = model.nodes().block_of_cell(bad);
      for (const unsigned int node : model.nodes().cell(bad))
        for (unsigned int d = 0; d < 2; ++d)
        {
          at[d] += state.nodes[node].X[d] / 3.;
          at[2 + d] += (state.nodes[node].X[d] + state.nodes[node].u[d]) / 3.;
        }
    }
    MPI_Bcast(at.data(), at.size(), MPI_DOUBLE, teller, communicator);
    std::ostringstream message;
    message << "a cell of block " << at[4]
            << " has turned inside out; it was at (" << at[0] << ", " << at[1]
            << ") m and is now at (" << at[2] << ", " << at[3]
            << ") m, found at time " << state.time << " s, step " << state.step
            << ". The usual causes are a load or an impact that crushes the "
               "block (check the units of the load, "
               "'Density' and 'Young's modulus'), a cell that is thin where "
               "the load acts (refine the mesh there), joints or contacts so "
               "soft that blocks run into each other (raise 'Normal "
               "stiffness'), or a time step too long (lower 'Share of "
               "critical time step')"
            << (model.large_displacements()
                    ? ""
                    : ", or blocks that slide far or turn, which needs "
                      "'Displacements = large' in section 'Contact'")
            << ". The last checkpoint is kept.";
    throw ModelFailure(message.str());
  }
} // namespace quoin
