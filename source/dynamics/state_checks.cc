// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/point_text.h>
#include <quoin/dynamics/state_checks.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace quoin
{
  double largest_slip_share(const Model<2> &model, const State<2> &state)
  {
    const NodeMap<2> &nodes     = model.nodes();
    const MatchedJoints &joints = model.joints();
    double largest              = 0.;
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
    {
      const auto &[a, b]  = joints.segments()[i].lower;
      const double length = nodes.point(a).distance(nodes.point(b));
      const auto gaps = joint_gaps(joints.segments()[i], state.nodes.data());
      for (unsigned int k = 0; k < 2; ++k)
        if (state.get<JointHistory>().normal_traction[2 * i + k] < 0.)
          largest = std::max(largest, std::abs(gaps[k][1]) / length);
    }
    return dealii::Utilities::MPI::max(largest, nodes.communicator());
  }

  template <int dim>
  void check_cells(const Model<dim> &model, const State<dim> &state)
  {
    const NodeMap<dim> &nodes   = model.nodes();
    const MPI_Comm communicator = nodes.communicator();
    // Twice the area or six times the volume, positive in valid cells.
    const auto size = [&](const unsigned int cell)
    {
      const auto &corners = nodes.cells().nodes[cell];
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
    const unsigned int n = nodes.cells().n_deformable;
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
      cell.block = nodes.blocks().block_of_cell(bad);
      for (const unsigned int node : nodes.cells().nodes[bad])
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
            << (dim == 3 || model.parameters().large_displacements
                    ? ""
                    : ", or blocks that slide far or turn, which needs "
                      "'Displacements = large' in section 'Contact'")
            << ". The last checkpoint is kept.";
    throw ModelFailure(message.str());
  }

  template void check_cells(const Model<2> &, const State<2> &);
  template void check_cells(const Model<3> &, const State<3> &);
} // namespace quoin
