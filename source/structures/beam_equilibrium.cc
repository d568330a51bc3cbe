// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_vectors.h>
#include <quoin/joints/point_arrays.h>
#include <quoin/structures/beam_equilibrium.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace quoin
{
  namespace
  {
    constexpr unsigned int dim             = 2;
    constexpr unsigned int most_iterations = 60;
    /** Unbalanced force of a beam by the sum of its forces [-]. */
    constexpr double force_ratio = 1e-11;
    /** Stiffness of a plastic hinge by that of an elastic one [-]. */
    constexpr double hinge_stiffness     = 1e-6;
    constexpr unsigned int most_halvings = 8;

    /** Derivative of the angle of a frame by degrees of freedom [1/m]. */
    using Turning = std::vector<std::pair<unsigned int, double>>;

    /** Adds @p share of the angle of the segment of @p length along @p
       direction from node @p a to @p b. */
    void add_turning(const unsigned int a, const unsigned int b,
                     const dealii::Tensor<1, 2> &direction, const double length,
                     const double share, Turning &turning)
    {
      const double f = share / length;
      turning.insert(turning.end(), { { 2 * b, -f * direction[1] },
                                      { 2 * b + 1, f * direction[0] },
                                      { 2 * a, f * direction[1] },
                                      { 2 * a + 1, -f * direction[0] } });
    }

    /** Adds to @p sum the stiffness @p part of a spring between the nodes @p a
        and @p b. */
    void add_between(const unsigned int a, const unsigned int b,
                     const Eigen::Matrix2d &part, Eigen::MatrixXd &sum)
    {
      sum.block<2, 2>(2 * a, 2 * a) += part;
      sum.block<2, 2>(2 * b, 2 * b) += part;
      sum.block<2, 2>(2 * a, 2 * b) -= part;
      sum.block<2, 2>(2 * b, 2 * a) -= part;
    }

    /** @p direction turned by a right angle, anticlockwise. */
    dealii::Tensor<1, 2> across(const dealii::Tensor<1, 2> &direction)
    {
      return dealii::Point<2>(-direction[1], direction[0]);
    }

    /** An interface point whose energy depends on the gap g, as a law with the
        derivative @p D, and on the angle of its frame. */
    struct FrameTerms
    {
      /** Derivatives of the force by the angle and of the couple by g [N], of
          friction two different ones. */
      Eigen::Vector2d force_by_angle, couple_by_gap;
      double by_angle; /**< of the couple by the angle [N m] */
      double couple;   /**< first derivative by the angle [N m] */

      FrameTerms(const Eigen::Vector2d &n, const Eigen::Vector2d &t,
                 const double side, const Eigen::Vector2d &g,
                 const double normal_force, const double shear_force,
                 const Eigen::Matrix2d &D)
      {
        // n turns by -side t, t by side n.
        const double opening = -side * t.dot(g), slip = side * n.dot(g);
        const Eigen::Vector2d way = opening * n + slip * t;
        const Eigen::Vector2d turned
            = side * (shear_force * n - normal_force * t);
        force_by_angle = D * way + turned;
        couple_by_gap  = D.transpose() * way + turned;
        by_angle       = way.dot(D * way) - normal_force * n.dot(g)
                   - shear_force * t.dot(g);
        couple = normal_force * opening + shear_force * slip;
      }
    };

    /** Derivatives at an interface point that acts. */
    struct PointTangent
    {
      unsigned int point;   /**< number at the liner */
      Eigen::Matrix2d part; /**< of the force by the gap [N/m] */
      FrameTerms terms;
      Turning turning; /**< of its frame */
    };

    /** Minus the derivative of the forces on the nodes of @p line by their
        displacements [N/m], which went from @p before to @p now. */
    Eigen::MatrixXd line_stiffness(const BeamLine &line,
                                   const BeamState &before,
                                   const BeamState &now)
    {
      const unsigned int n = 2 * line.places.size();
      Eigen::MatrixXd sum  = Eigen::MatrixXd::Zero(n, n);
      std::vector<Eigen::Vector2d> normals(line.n_segments()),
          tangents(line.n_segments());
      for (unsigned int k = 0; k < line.n_segments(); ++k)
      {
        const unsigned int a = line.begin + k, b = line.next(a);
        const BeamLine::Segment s    = line.segment(a, now);
        const Eigen::Vector2d t      = to_eigen(s.direction),
                              normal = to_eigen(across(s.direction));
        normals[k]                   = normal / s.length;
        tangents[k]                  = t;
        const double axial           = line.axial_force(a, s, now);
        // The energy grows by (M_a - M_b) d theta as the segment turns.
        const double turns
            = (now.moment[a] - now.moment[b]) / (s.length * s.length);
        const Eigen::Matrix2d part
            = line.axial_stiffness / s.rest * t * t.transpose()
              + axial / s.length * normal * normal.transpose()
              - turns * (t * normal.transpose() + normal * t.transpose());
        add_between(k, b - line.begin, part, sum);
      }
      for (unsigned int i = line.begin; i < line.end; ++i)
      {
        double angle;
        if (!line.turning(i, now, angle))
          continue;
        const double k
            = line.bending_stiffness / line.at_rest(i).length
              * (now.plastic[i] == before.plastic[i] ? 1. : hinge_stiffness);
        Eigen::VectorXd slope = Eigen::VectorXd::Zero(n); // of the angle
        const auto segments   = line.segments_at(i);
        for (const unsigned int first : segments)
        {
          const unsigned int s = first - line.begin,
                             e = line.next(first) - line.begin;
          const Eigen::Vector2d change
              = (first == i ? 1. : -1.) * normals[s]
                - 0.5 * line.at_rest(i).curvature * tangents[s];
          slope.segment<2>(2 * e) += change;
          slope.segment<2>(2 * s) -= change;
        }
        std::vector<unsigned int> used;
        for (unsigned int a = 0; a < n; ++a)
          if (slope[a] != 0.)
            used.push_back(a);
        for (const unsigned int a : used)
          for (const unsigned int b : used)
            sum(a, b) += k * slope[a] * slope[b];
        if (now.plastic[i] == before.plastic[i])
          continue;
        // The moment of a hinge follows the axial force.
        const double by_axial
            = std::copysign(line.hinge_moment(i, now)[1], now.moment[i]);
        if (by_axial == 0.)
          continue;
        const double share = 1. / segments.size();
        for (const unsigned int first : segments)
        {
          const unsigned int s = first - line.begin,
                             e = line.next(first) - line.begin;
          const Eigen::RowVector2d change
              = by_axial * share * line.axial_stiffness
                / line.at_rest(first).segment * tangents[s].transpose();
          for (const unsigned int a : used)
          {
            sum.block<1, 2>(a, 2 * e) += slope[a] * change;
            sum.block<1, 2>(a, 2 * s) -= slope[a] * change;
          }
        }
      }
      return sum;
    }

    /** Adds to @p sum what the interface adds to line_stiffness(). */
    std::vector<PointTangent> add_interface(const Beam &beam,
                                            const State<2> &state,
                                            const BeamState &before,
                                            const BeamState &now,
                                            Eigen::MatrixXd &sum)
    {
      const BeamLine &line            = beam.line;
      const LinerInterface &interface = beam.interface;
      std::vector<PointTangent> result;
      const auto visit = [&](const auto &law)
      {
        for (unsigned int k = 0; k < interface.points.size(); ++k)
        {
          if (!interface.acts(k, state, now))
            continue;
          const auto &[node, block, at, side, area] = interface.points[k];
          const unsigned int p                      = interface.first + k;
          const LinerInterface::Gap gap = interface.gap(line, k, now);
          auto point                    = read_point(law, before.interface, p);
          JointTangent<2> slopes;
          law.update(point, gap.opening, gap.slip, slopes);
          Eigen::Matrix2d frame, local;
          frame << gap.normal[0], gap.tangent[0], gap.normal[1], gap.tangent[1];
          local << slopes.normal_opening, slopes.normal_slip,
              slopes.shear_opening, slopes.shear_slip;
          const Eigen::Matrix2d part = area * frame * local * frame.transpose();
          sum.block<2, 2>(2 * at, 2 * at) += part;
          const Eigen::Vector2d n(frame.col(0)), t(frame.col(1));
          const FrameTerms terms(n, t, side,
                                 (gap.opening + now.offset[p][0]) * n
                                     + (gap.slip + now.offset[p][1]) * t,
                                 area * now.interface.normal_traction[p],
                                 area * now.interface.shear_traction[p], part);
          Turning turning;
          const auto segments = line.segments_at(line.begin + at);
          const double share  = 1. / segments.size();
          for (const unsigned int first : segments)
          {
            const BeamLine::Segment s = line.segment(first, now);
            const unsigned int a      = first - line.begin,
                               b      = line.next(first) - line.begin;
            add_turning(a, b, s.direction, s.length, share, turning);
            // The angle of a segment has second derivatives, too.
            const Eigen::Vector2d along  = to_eigen(s.direction),
                                  normal = to_eigen(across(s.direction));
            add_between(
                a, b,
                -terms.couple * share / (s.length * s.length)
                    * (along * normal.transpose() + normal * along.transpose()),
                sum);
          }
          for (const auto &[q, w] : turning)
          {
            for (unsigned int d = 0; d < dim; ++d)
            {
              sum(q, dim * at + d) -= w * terms.couple_by_gap[d];
              sum(dim * at + d, q) -= w * terms.force_by_angle[d];
            }
            for (const auto &[r, v] : turning)
              sum(q, r) += w * v * terms.by_angle;
          }
          result.push_back({ k, part, terms, turning });
        }
      };
      std::visit(visit, interface.law);
      return result;
    }

    /** The stiffness of the nodes of @p beam, of those that are held one that
        keeps them; see line_stiffness(). */
    Eigen::MatrixXd stiffness(const Beam &beam, const State<2> &state,
                              const BeamState &before, const BeamState &now,
                              std::vector<PointTangent> &points)
    {
      const BeamLine &line = beam.line;
      Eigen::MatrixXd sum  = line_stiffness(line, before, now);
      points               = add_interface(beam, state, before, now, sum);
      for (unsigned int i = 0; i < sum.rows(); ++i)
        if (line.held(line.begin + i / 2, i % 2))
        {
          sum.row(i).setZero();
          sum.col(i).setZero();
          sum(i, i) = line.axial_stiffness;
        }
      return sum;
    }

    /** Factors of the stiffness of nodes, in which each knows its neighbours
        alone. */
    class StiffnessFactors
    {
    public:
      explicit StiffnessFactors(const Eigen::MatrixXd &stiffness)
      {
        factors.compute(stiffness.sparseView());
      }

      /** The displacements under the columns of @p forces; no numbers if the
          stiffness is singular. */
      Eigen::MatrixXd solve(const Eigen::MatrixXd &forces) const
      {
        if (factors.info() != Eigen::Success)
          return Eigen::MatrixXd::Constant(
              forces.rows(), forces.cols(),
              std::numeric_limits<double>::quiet_NaN());
        return factors.solve(forces);
      }

    private:
      Eigen::SparseLU<Eigen::SparseMatrix<double>> factors;
    };

    /** Stiffness of blocks at the interface, see BeamReaction, with the
        stiffness @p own of the nodes. */
    Eigen::MatrixXd condensed(const Beam &beam, const Eigen::MatrixXd &own,
                              const std::vector<PointTangent> &points)
    {
      const unsigned int n = own.rows(), m = 2 * beam.interface.points.size();
      Eigen::MatrixXd result = Eigen::MatrixXd::Zero(m, m);
      if (m == 0)
        return result;
      // Friction makes them others than each other's transposed.
      Eigen::MatrixXd coupling = Eigen::MatrixXd::Zero(n, m),
                      forces   = Eigen::MatrixXd::Zero(m, n);
      for (const auto &[k, part, terms, turning] : points)
      {
        const unsigned int at               = beam.interface.points[k].at;
        result.block<2, 2>(2 * k, 2 * k)    = part;
        coupling.block<2, 2>(2 * at, 2 * k) = part;
        forces.block<2, 2>(2 * k, 2 * at)   = part;
        for (const auto &[q, w] : turning)
          for (unsigned int d = 0; d < dim; ++d)
          {
            coupling(q, dim * k + d) -= w * terms.couple_by_gap[d];
            forces(dim * k + d, q) -= w * terms.force_by_angle[d];
          }
      }
      for (unsigned int i = 0; i < n; ++i)
        if (beam.line.held(beam.line.begin + i / 2, i % 2))
        {
          coupling.row(i).setZero();
          forces.col(i).setZero();
        }
      // The nodes of the beam follow the points.
      const Eigen::SparseMatrix<double> rows = forces.sparseView();
      result -= rows * StiffnessFactors(own).solve(coupling);
      return result;
    }
  } // namespace

  bool find_equilibrium(const Beam &beam,
                        const std::vector<dealii::Tensor<1, 2>> &loads,
                        const double model_size, const State<2> &state,
                        BeamState &beams, EnergyAccounts &energy,
                        const BeamReaction &reaction)
  {
    const BeamLine &line   = beam.line;
    const unsigned int n   = 2 * line.places.size();
    const BeamState before = beams;
    Eigen::VectorXd residual(n), u(n);
    double loaded = 0.;
    for (unsigned int i = 0; i < n; ++i)
    {
      u[i] = before.nodes[line.begin + i / 2].u[i % 2];
      loaded += std::abs(loads[i / 2][i % 2]);
    }
    BeamState now;
    EnergyAccounts lost;
    AlignedArray<dealii::Tensor<1, 2>> force(before.nodes.size());
    double size = 0.;
    // The unbalanced force [N] at the displacements u.
    const auto evaluate = [&](const Eigen::VectorXd &u)
    {
      now  = before;
      lost = EnergyAccounts();
      for (unsigned int i = 0; i < n; ++i)
        now.nodes[line.begin + i / 2].u[i % 2] = u[i];
      std::fill(force.begin(), force.end(), dealii::Tensor<1, 2>());
      size = loaded;
      size += line.add_forces(now, lost, force.data());
      size += beam.interface.add_forces(line, state, now, lost, force.data(),
                                        reaction.force);
      double square = 0.;
      for (unsigned int i = 0; i < n; ++i)
      {
        residual[i]
            = line.held(line.begin + i / 2, i % 2)
                  ? 0.
                  : force[line.begin + i / 2][i % 2] + loads[i / 2][i % 2];
        square += residual[i] * residual[i];
      }
      return std::sqrt(square);
    };
    const Eigen::VectorXd start = u;
    double unbalanced           = evaluate(u);
    // Where nothing is left but rounding of the positions.
    const double rounding
        = 1e-15 * line.axial_stiffness * std::sqrt(double(n))
          * (1. + model_size / line.at_rest(line.begin).segment);
    std::vector<PointTangent> points;
    for (unsigned int iteration = 0;
         unbalanced > std::max(force_ratio * size, rounding); ++iteration)
    {
      if (iteration == most_iterations || !std::isfinite(unbalanced))
        return false;
      const Eigen::VectorXd step
          = StiffnessFactors(stiffness(beam, state, before, now, points))
                .solve(residual);
      if (!step.allFinite())
        return false;
      double share = 1., reached = evaluate(u + step);
      for (unsigned int i = 0; i < most_halvings && !(reached < unbalanced);
           ++i)
      {
        share *= 0.5;
        reached = evaluate(u + share * step);
      }
      u += share * step;
      unbalanced = reached;
    }
    for (unsigned int i = 0; i < n; ++i)
    {
      double &last = now.load[line.begin + i / 2][i % 2];
      energy.external += 0.5 * (last + loads[i / 2][i % 2]) * (u[i] - start[i]);
      last = loads[i / 2][i % 2];
    }
    energy += lost;
    beams = now;
    if (reaction.stiffness)
    {
      const Eigen::MatrixXd own = stiffness(beam, state, before, now, points);
      *reaction.stiffness       = condensed(beam, own, points);
    }
    return true;
  }

  bool is_unstable(const Beam &beam, const State<2> &state,
                   const BeamState &now)
  {
    /** Eigenvalues smaller than that by the largest may be rounding. */
    constexpr double rounding = 1e-11;
    std::vector<PointTangent> points;
    // Friction in the interface makes it unsymmetric.
    const Eigen::VectorXcd values
        = stiffness(beam, state, now, now, points).eigenvalues();
    const double largest = values.cwiseAbs().maxCoeff();
    return values.real().minCoeff() < -rounding * largest;
  }
} // namespace quoin
