// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/point_text.h>
#include <quoin/dynamics/state_checks.h>
#include <quoin/joint_elements/joint_changes.h>
#include <quoin/model/model_stability.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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
      const auto gaps     = gaps_since_placing(joints, i, state);
      for (unsigned int k = 0; k < 2; ++k)
        if (state.get<JointHistory>().normal_traction[2 * i + k] < 0.)
          largest = std::max(largest, std::abs(gaps[k][1]) / length);
    }
    return dealii::Utilities::MPI::max(largest, nodes.communicator());
  }

  void JointMotion::take_larger(const JointMotion &other)
  {
    slip     = std::max(slip, other.slip);
    distance = std::max(distance, other.distance);
    turn     = std::max(turn, other.turn);
  }

  namespace
  {
    /** Mean rotation of each block of the whole mesh by the displacements of
        its nodes, linear in them [rad]. Collective. */
    std::vector<double> block_rotations(const NodeMap<2> &nodes,
                                        const State<2> &state)
    {
      // A block has seven sums: of 1, X, u, X x u and X . X over its nodes.
      constexpr unsigned int n = 7;
      std::vector<double> sums(n * nodes.table().n_blocks(), 0.);
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      {
        const auto &[X, u]    = state.nodes[i];
        double *sum           = &sums[n * nodes.block_of_node(i)];
        const double added[n] = { 1.,
                                  X[0],
                                  X[1],
                                  u[0],
                                  u[1],
                                  X[0] * u[1] - X[1] * u[0],
                                  X[0] * X[0] + X[1] * X[1] };
        for (unsigned int k = 0; k < n; ++k)
          sum[k] += added[k];
      }
      dealii::Utilities::MPI::sum(sums, nodes.communicator(), sums);
      std::vector<double> rotations(nodes.table().n_blocks(), 0.);
      for (unsigned int b = 0; b < rotations.size(); ++b)
      {
        const double *sum = &sums[n * b];
        const double inertia
            = sum[6] - (sum[1] * sum[1] + sum[2] * sum[2]) / sum[0];
        if (inertia > 0.)
          rotations[b] = (sum[5] - (sum[1] * sum[4] - sum[2] * sum[3]) / sum[0])
                         / inertia;
      }
      return rotations;
    }
  } // namespace

  JointMotion joint_motion(const Model<2> &model, const State<2> &state)
  {
    const NodeMap<2> &nodes = model.nodes();
    const auto rotations    = block_rotations(nodes, state);
    JointMotion motion;
    const MatchedJoints &joints = model.joints();
    for (unsigned int i = 0; i < joints.segments().size(); ++i)
    {
      const JointSegment &segment = joints.segments()[i];
      const unsigned int a        = nodes.block_of_node(segment.lower[0]),
                         b        = nodes.block_of_node(segment.upper[0]);
      if (state.is_absent(a) || state.is_absent(b))
        continue;
      motion.turn
          = std::max(motion.turn, std::abs(rotations[a] - rotations[b]));
      for (const auto &gap : gaps_since_placing(joints, i, state))
        motion.distance = std::max(motion.distance, std::hypot(gap[0], gap[1]));
    }
    for (double *value : { &motion.turn, &motion.distance })
      *value = dealii::Utilities::MPI::max(*value, nodes.communicator());
    motion.slip = largest_slip_share(model, state);
    return motion;
  }

  namespace
  {
    /** Mean rotation of each block of the whole mesh: the orthogonal part of
        the sum of x X^T over its nodes, about their centres. Collective. */
    std::vector<dealii::Tensor<2, 3>> block_turns(const NodeMap<3> &nodes,
                                                  const State<3> &state)
    {
      // A block has 16 sums: of 1, X, x and x X^T over its nodes.
      constexpr unsigned int n = 16;
      std::vector<double> sums(n * nodes.table().n_blocks(), 0.);
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      {
        const auto &[X, u] = state.nodes[i];
        double *sum        = &sums[n * nodes.block_of_node(i)];
        ++sum[0];
        for (unsigned int d = 0; d < 3; ++d)
        {
          sum[1 + d] += X[d];
          sum[4 + d] += X[d] + u[d];
          for (unsigned int e = 0; e < 3; ++e)
            sum[7 + 3 * d + e] += (X[d] + u[d]) * X[e];
        }
      }
      dealii::Utilities::MPI::sum(sums, nodes.communicator(), sums);
      std::vector<dealii::Tensor<2, 3>> turns(nodes.table().n_blocks());
      for (unsigned int b = 0; b < turns.size(); ++b)
      {
        const double *sum = &sums[n * b];
        dealii::Tensor<2, 3> moment;
        for (unsigned int d = 0; d < 3; ++d)
          for (unsigned int e = 0; e < 3; ++e)
            moment[d][e]
                = sum[7 + 3 * d + e] - sum[4 + d] * sum[1 + e] / sum[0];
        turns[b] = project_onto_orthogonal_tensors(moment);
      }
      return turns;
    }
  } // namespace

  JointMotion joint_motion(const Model<3> &model, const State<3> &state)
  {
    const auto turns                 = block_turns(model.nodes(), state);
    const NodeMap<3> &nodes          = model.nodes();
    const SpaceJoints &joints        = model.joints();
    const SpaceJointHistory &history = state.get<SpaceJointHistory>();
    JointMotion motion;
    for (unsigned int i = 0; i < joints.faces().size(); ++i)
    {
      const auto &sides = nodes.faces().joints[joints.faces()[i].face].blocks;
      if (state.is_absent(sides[0]) || state.is_absent(sides[1]))
        continue;
      // The skew part of the relative rotation has the sine of its angle.
      const auto turn = turns[sides[1]] * transpose(turns[sides[0]]);
      motion.turn
          = std::max(motion.turn,
                     std::atan2((turn - transpose(turn)).norm() / std::sqrt(2.),
                                trace(turn) - 1.));
      const auto &[a, b, c] = joints.faces()[i].lower;
      const double length
          = std::max({ nodes.point(a).distance(nodes.point(b)),
                       nodes.point(b).distance(nodes.point(c)),
                       nodes.point(c).distance(nodes.point(a)) });
      const auto gaps = gaps_since_placing(joints, i, state);
      for (unsigned int k = 0; k < 3; ++k)
      {
        const double slip = std::hypot(gaps[k][1], gaps[k][2]);
        motion.distance
            = std::max(motion.distance, std::hypot(gaps[k][0], slip));
        if (history.normal_traction[3 * i + k] < 0.)
          motion.slip = std::max(motion.slip, slip / length);
      }
    }
    for (double *value : { &motion.slip, &motion.distance, &motion.turn })
      *value = dealii::Utilities::MPI::max(*value, nodes.communicator());
    return motion;
  }

  namespace
  {
    /** Height of a cell by its longest edge below which its shape is a likely
        reason that it fails [-]; 0.87 of an equilateral triangle. */
    constexpr double thin = 0.1;

    template <int dim>
    struct InvertedCell
    {
      dealii::Point<dim> before, now; /**< centroid before and now [m] */
      unsigned int block; /**< number of the block in the whole mesh */
      double shape; /**< smallest height by longest edge, in the mesh [-] */
    };

    template <int dim>
    using Corners = std::array<dealii::Point<dim>, dim + 1>;

    /** Twice the area or six times the volume, positive in valid cells. */
    template <int dim>
    double size_of(const Corners<dim> &corners)
    {
      dealii::Tensor<2, dim> edges;
      for (unsigned int k = 0; k < dim; ++k)
        edges[k] = corners[k + 1] - corners[0];
      return determinant(edges);
    }

    /** The corners of a local cell in the mesh, or displaced by @p state. */
    template <int dim>
    Corners<dim> corners_of(const NodeMap<dim> &nodes, const State<dim> &state,
                            const unsigned int cell, const bool displaced)
    {
      Corners<dim> result;
      for (unsigned int k = 0; k <= dim; ++k)
      {
        const auto &[X, u] = state.nodes[nodes.cells().nodes[cell][k]];
        for (unsigned int d = 0; d < dim; ++d)
          result[k][d] = X[d] + (displaced ? u[d] : 0.);
      }
      return result;
    }

    template <int dim>
    dealii::Point<dim> centre_of(const Corners<dim> &corners)
    {
      dealii::Point<dim> result;
      for (const auto &corner : corners)
        result += corner / (dim + 1.);
      return result;
    }

    /** Smallest height of a cell by its longest edge. */
    template <int dim>
    double shape_of(const Corners<dim> &corners)
    {
      double longest = 0., largest_face = 0.;
      for (unsigned int k = 0; k <= dim; ++k)
      {
        // Twice the area of the face opposite to corner k, or its length.
        std::array<dealii::Tensor<1, dim>, dim - 1> edges;
        const auto &origin = corners[k == 0 ? 1 : 0];
        unsigned int n     = 0;
        for (unsigned int l = k == 0 ? 2 : 1; l <= dim; ++l)
          if (l != k)
            edges[n++] = corners[l] - origin;
        double face = edges[0].norm();
        if constexpr (dim == 3)
          face = cross_product_3d(edges[0], edges[1]).norm();
        largest_face = std::max(largest_face, face);
        for (unsigned int l = 0; l < k; ++l)
          longest = std::max(longest, corners[k].distance(corners[l]));
      }
      return size_of<dim>(corners) / (largest_face * longest);
    }

    /** What is likely to have inverted @p cell, and what to do. */
    template <int dim>
    std::string causes(const InvertedCell<dim> &cell, const State<dim> &state,
                       const bool small, const std::vector<std::string> &loads)
    {
      std::ostringstream text;
      if (cell.shape < thin)
        text << "In the mesh its smallest height is only " << 100. * cell.shape
             << " % of its longest edge: the mesh is the likely cause. Refine "
                "it there, or leave out short edges and sharp corners of the "
                "geometry.";
      else if (state.step == 0)
        text << "Only 'Initial motion' has moved nodes, and its displacements "
                "turn the cell over: give smaller ones.";
      else
        text << "Its shape in the mesh is good: it has been crushed, and the "
                "loads of this stage are "
             << known_names(loads)
             << ". If the model collapses there, and may, end the stage before "
                "by 'End conditions' on a history of its motion. If not, the "
                "usual causes are a load or an impact that crushes the block "
                "(check the units of the load, 'Density' and 'Young's "
                "modulus'), cells too large for the load that acts (refine "
                "the mesh there), too little damping, joints or contacts so "
                "soft that blocks run into each other (raise 'Normal "
                "stiffness'), or a time step too long (lower 'Share of "
                "critical time step')"
             << (small ? ", or blocks that slide far or turn, which needs "
                         "'Displacements = large' in section 'Contact'."
                       : ".");
      return text.str();
    }
  } // namespace

  template <int dim>
  void check_cells(const Model<dim> &model, const State<dim> &state,
                   const std::vector<std::string> &loads)
  {
    const NodeMap<dim> &nodes   = model.nodes();
    const MPI_Comm communicator = nodes.communicator();
    const unsigned int n        = nodes.cells().n_deformable;
    unsigned int bad            = 0;
    while (bad < n && size_of<dim>(corners_of(nodes, state, bad, true)) > 0.)
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
    InvertedCell<dim> cell{};
    if (bad < n)
    {
      const auto before = corners_of(nodes, state, bad, false);
      cell              = { centre_of<dim>(before),
                            centre_of<dim>(corners_of(nodes, state, bad, true)),
                            nodes.blocks().block_of_cell(bad), shape_of<dim>(before) };
    }
    MPI_Bcast(&cell, sizeof(cell), MPI_BYTE, teller, communicator);
    std::ostringstream message;
    message << "a cell of block " << cell.block
            << " has turned inside out; it was at " << point_text(cell.before)
            << " m and is now at " << point_text(cell.now)
            << " m, found at time " << state.time << " s, step " << state.step
            << ". "
            << causes(cell, state,
                      dim == 2 && !model.parameters().large_displacements,
                      loads)
            << " The last checkpoint is kept.";
    throw ModelFailure(message.str());
  }

  template <int dim>
  FarthestNode<dim> farthest_node(const Model<dim> &model,
                                  const State<dim> &state)
  {
    const NodeMap<dim> &nodes   = model.nodes();
    const MPI_Comm communicator = nodes.communicator();
    FarthestNode<dim> farthest;
    double largest = -1.; // squared [m^2]
    for (unsigned int i = 0; i < nodes.n_owned(); ++i)
    {
      const double square = state.nodes[i].u.norm_square();
      if (square <= largest || state.is_absent(nodes.block_of_node(i)))
        continue;
      largest        = square;
      farthest.block = nodes.block_of_node(i);
      farthest.speed = 0.;
      for (unsigned int d = 0; d < dim; ++d)
      {
        const auto &[X, u] = state.nodes[i];
        farthest.before[d] = X[d];
        farthest.now[d]    = X[d] + u[d];
        farthest.speed += state.velocity[i][d] * u[d];
      }
    }
    farthest.distance = std::sqrt(std::max(largest, 0.));
    if (farthest.distance > 0.)
      farthest.speed /= farthest.distance;
    const double most     = dealii::Utilities::MPI::max(largest, communicator);
    const unsigned teller = dealii::Utilities::MPI::min(
        largest == most ? dealii::Utilities::MPI::this_mpi_process(communicator)
                        : std::numeric_limits<unsigned int>::max(),
        communicator);
    MPI_Bcast(&farthest, sizeof(farthest), MPI_BYTE, int(teller), communicator);
    return farthest;
  }

  template <int dim>
  void check_time_step(const Model<dim> &model, const State<dim> &state,
                       const StageParameters &stage,
                       const std::vector<double> &node_mass,
                       const std::vector<double> &mass_factor,
                       const double time_step)
  {
    const MPI_Comm communicator   = model.nodes().communicator();
    double flowed                 = 0.;
    const PlasticHistory &plastic = state.template get<PlasticHistory>();
    if constexpr (dim == 2)
      for (const PlasticCell &cell : plastic.cells)
        for (unsigned int i = 0; i < 3; ++i)
          flowed = std::max(flowed, std::abs(cell.inverse_stretch[i]));
    else
      for (const SpacePlasticCell &cell : plastic.space_cells)
        for (const double component : cell.inverse_stretch)
          flowed = std::max(flowed, std::abs(component));
    // The bound takes as long as some steps, and small flow changes it little.
    if (dealii::Utilities::MPI::max(flowed, communicator) < 0.05)
      return;
    const double eigenvalue
        = stability_at(model, state).largest_eigenvalue(node_mass, mass_factor);
    const double critical = StableTimeStep<dim>::critical(
        dealii::Utilities::MPI::max(eigenvalue, communicator),
        stage.stiffness_coefficient);
    if (time_step <= critical)
      return;
    throw ModelFailure(
        "plastic flow has deformed cells so much that the critical time step "
        "has fallen to "
        + number_text(critical) + " s, below the time step of "
        + number_text(time_step) + " s, at time " + number_text(state.time)
        + " s of stage '" + stage.name
        + "'. Lower 'Share of critical time step' (or 'Time step') in section "
          "'Time stepping' to "
        + number_text(0.8 * critical / time_step)
        + " of its value, or further if cells continue to yield; if only few "
          "cells have yielded, such as at a corner, make the mesh coarser "
          "there. The last checkpoint is kept.");
  }

  template void check_cells(const Model<2> &, const State<2> &,
                            const std::vector<std::string> &);
  template void check_cells(const Model<3> &, const State<3> &,
                            const std::vector<std::string> &);
  template FarthestNode<2> farthest_node(const Model<2> &, const State<2> &);
  template FarthestNode<3> farthest_node(const Model<3> &, const State<3> &);
  template void check_time_step(const Model<2> &, const State<2> &,
                                const StageParameters &,
                                const std::vector<double> &,
                                const std::vector<double> &, double);
  template void check_time_step(const Model<3> &, const State<3> &,
                                const StageParameters &,
                                const std::vector<double> &,
                                const std::vector<double> &, double);
} // namespace quoin
