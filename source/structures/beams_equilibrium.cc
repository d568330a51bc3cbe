// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Beams in equilibrium, for the implicit solver; beams.cc has the rest.

#include <quoin/joints/point_arrays.h>
#include <quoin/structures/beams.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace quoin
{
  namespace
  {
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
                     const double (&direction)[2], const double length,
                     const double share, Turning &turning)
    {
      const double f = share / length;
      turning.insert(turning.end(), { { 2 * b, -f * direction[1] },
                                      { 2 * b + 1, f * direction[0] },
                                      { 2 * a, f * direction[1] },
                                      { 2 * a + 1, -f * direction[0] } });
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
  } // namespace

  Eigen::MatrixXd Beams::stiffness(const Line &line, const State<2> &state,
                                   const BeamState &before,
                                   const BeamState &now,
                                   std::vector<Eigen::Matrix2d> &by_point) const
  {
    const unsigned int n = 2 * (line.end - line.begin);
    Eigen::MatrixXd sum  = Eigen::MatrixXd::Zero(n, n);
    std::vector<Eigen::Vector2d> normals(n_segments(line)),
        tangents(n_segments(line));
    for (unsigned int k = 0; k < n_segments(line); ++k)
    {
      const unsigned int a = line.begin + k, b = next(line, a);
      const Segment s = segment(line, a, now);
      const Eigen::Vector2d t(s.direction[0], s.direction[1]),
          normal(-s.direction[1], s.direction[0]);
      normals[k]         = normal / s.length;
      tangents[k]        = t;
      const double axial = axial_force(line, a, s, now);
      // The energy grows by (M_a - M_b) d theta as the segment turns.
      const double turns
          = (now.moment[a] - now.moment[b]) / (s.length * s.length);
      const Eigen::Matrix2d part
          = line.axial / s.rest * t * t.transpose()
            + axial / s.length * normal * normal.transpose()
            - turns * (t * normal.transpose() + normal * t.transpose());
      const unsigned int i = 2 * k, j = 2 * (b - line.begin);
      sum.block<2, 2>(i, i) += part;
      sum.block<2, 2>(j, j) += part;
      sum.block<2, 2>(i, j) -= part;
      sum.block<2, 2>(j, i) -= part;
    }
    for (unsigned int i = line.begin; i < line.end; ++i)
    {
      double angle;
      if (!turning(line, i, now, angle))
        continue;
      const double k
          = line.bending / rest_length[i]
            * (now.plastic[i] == before.plastic[i] ? 1. : hinge_stiffness);
      Eigen::VectorXd slope = Eigen::VectorXd::Zero(n); // of the angle
      const auto add        = [&](const unsigned int segment, const double sign)
      {
        const unsigned int b = next(line, line.begin + segment) - line.begin;
        const Eigen::Vector2d change
            = sign * normals[segment] - 0.5 * curvature[i] * tangents[segment];
        slope.segment<2>(2 * b) += change;
        slope.segment<2>(2 * segment) -= change;
      };
      const unsigned int local = i - line.begin;
      if (local < n_segments(line))
        add(local, 1.);
      if (local > 0 || line.is_closed)
        add(local > 0 ? local - 1 : n_segments(line) - 1, -1.);
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
          = std::copysign(hinge_moment(line, i, now)[1], now.moment[i]);
      const double share = has_before(line, i) && has_after(line, i) ? 0.5 : 1.;
      for (const unsigned int first : { previous(line, i), i })
      {
        if (by_axial == 0.
            || (first == i ? !has_after(line, i) : !has_before(line, i)))
          continue;
        const unsigned int b         = next(line, first) - line.begin;
        const Eigen::Vector2d change = by_axial * share * line.axial
                                       / rest_segment[first]
                                       * tangents[first - line.begin];
        for (const unsigned int a : used)
          for (unsigned int d = 0; d < 2; ++d)
          {
            sum(a, 2 * b + d) += slope[a] * change[d];
            sum(a, 2 * (first - line.begin) + d) -= slope[a] * change[d];
          }
      }
    }
    by_point.assign(line.last_point - line.first_point,
                    Eigen::Matrix2d::Zero());
    const auto visit = [&](const auto &law)
    {
      for (unsigned int p = line.first_point; p < line.last_point; ++p)
      {
        if (!now.attached[p] || state.is_absent(points[p].block))
          continue;
        std::array<double, 2> normal;
        const auto [opening, slip]
            = gap(line, p, now, now.block_position.data() + 2 * p, normal);
        auto point = read_point(law, before.interface, p);
        JointTangent<2> slopes;
        law.update(point, opening, slip, slopes);
        Eigen::Matrix2d frame, local;
        frame << normal[0], points[p].side * normal[1], normal[1],
            -points[p].side * normal[0];
        local << slopes.normal_opening, slopes.normal_slip,
            slopes.shear_opening, slopes.shear_slip;
        Eigen::Matrix2d &part = by_point[p - line.first_point];
        part = points[p].area * frame * local * frame.transpose();
        const unsigned int at = points[p].at, local_at = at - line.begin;
        sum.block<2, 2>(2 * local_at, 2 * local_at) += part;
        const Eigen::Vector2d n(frame.col(0)), t(frame.col(1));
        const FrameTerms terms(
            n, t, points[p].side,
            (opening + now.offset[p][0]) * n + (slip + now.offset[p][1]) * t,
            points[p].area * now.interface.normal_traction[p],
            points[p].area * now.interface.shear_traction[p], part);
        Turning turning;
        const double share
            = has_before(line, at) && has_after(line, at) ? 0.5 : 1.;
        for (const unsigned int first : { previous(line, at), at })
        {
          if (first == at ? !has_after(line, at) : !has_before(line, at))
            continue;
          const Segment s      = segment(line, first, now);
          const unsigned int a = first - line.begin,
                             b = next(line, first) - line.begin;
          add_turning(a, b, s.direction, s.length, share, turning);
          // The angle of a segment has second derivatives, too.
          const Eigen::Vector2d along(s.direction[0], s.direction[1]),
              across(-s.direction[1], s.direction[0]);
          const Eigen::Matrix2d curved
              = -terms.couple * share / (s.length * s.length)
                * (along * across.transpose() + across * along.transpose());
          sum.block<2, 2>(2 * a, 2 * a) += curved;
          sum.block<2, 2>(2 * b, 2 * b) += curved;
          sum.block<2, 2>(2 * a, 2 * b) -= curved;
          sum.block<2, 2>(2 * b, 2 * a) -= curved;
        }
        for (const auto &[q, w] : turning)
        {
          for (unsigned int d = 0; d < 2; ++d)
          {
            sum(q, 2 * local_at + d) -= w * terms.couple_by_gap[d];
            sum(2 * local_at + d, q) -= w * terms.force_by_angle[d];
          }
          for (const auto &[r, v] : turning)
            sum(q, r) += w * v * terms.by_angle;
        }
      }
    };
    std::visit(visit, line.law);
    for (unsigned int i = 0; i < n; ++i)
      if (held(line, line.begin + i / 2, i % 2))
      {
        sum.row(i).setZero();
        sum.col(i).setZero();
        sum(i, i) = line.axial;
      }
    return sum;
  }

  bool Beams::settle(const Line &line, const TimePoint &time,
                     const State<2> &marks, BeamState &beams,
                     EnergyAccounts &energy, dealii::Tensor<1, 2> *by_point,
                     Eigen::MatrixXd *condensed) const
  {
    const unsigned int n   = 2 * (line.end - line.begin);
    const BeamState before = beams;
    Eigen::VectorXd loads(n), residual(n);
    const Loads given = loads_of(line, time);
    double loaded     = 0.;
    for (unsigned int i = 0; i < n; ++i)
    {
      loads[i] = load(line, line.begin + i / 2, given)[i % 2];
      loaded += std::abs(loads[i]);
    }
    BeamState now;
    EnergyAccounts lost;
    AlignedArray<dealii::Tensor<1, 2>> sum(rest.size(), dealii::Tensor<1, 2>());
    double size = 0.;
    // The unbalanced force [N] at the displacements u.
    const auto evaluate = [&](const Eigen::VectorXd &u)
    {
      now  = before;
      lost = EnergyAccounts();
      for (unsigned int i = 0; i < n; ++i)
        now.nodes[line.begin + i / 2].u[i % 2] = u[i];
      std::fill(sum.begin(), sum.end(), dealii::Tensor<1, 2>());
      size = loaded;
      size += add_internal_forces(line, now, lost, sum.data());
      size
          += add_interface_forces(line, marks, now, lost, sum.data(), by_point);
      for (unsigned int i = 0; i < n; ++i)
        residual[i] = held(line, line.begin + i / 2, i % 2)
                          ? 0.
                          : sum[line.begin + i / 2][i % 2] + loads[i];
      double square = 0.;
      for (unsigned int i = 0; i < n; ++i)
        square += residual[i] * residual[i];
      return std::sqrt(square);
    };
    Eigen::VectorXd u(n);
    for (unsigned int i = 0; i < n; ++i)
      u[i] = before.nodes[line.begin + i / 2].u[i % 2];
    const Eigen::VectorXd start = u;
    double unbalanced           = evaluate(u);
    // Where nothing is left but rounding of the positions.
    const double rounding
        = 1e-15 * line.axial * std::sqrt(double(n))
          * (1. + node_map.table().diagonal() / rest_segment[line.begin]);
    std::vector<Eigen::Matrix2d> part;
    for (unsigned int iteration = 0;
         unbalanced > std::max(force_ratio * size, rounding); ++iteration)
    {
      if (iteration == most_iterations || !std::isfinite(unbalanced))
        return false;
      const Eigen::VectorXd step = stiffness(line, marks, before, now, part)
                                       .partialPivLu()
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
      dealii::Tensor<1, 2> &last = now.load[line.begin + i / 2];
      energy.external += 0.5 * (last[i % 2] + loads[i]) * (u[i] - start[i]);
      last[i % 2] = loads[i];
    }
    energy += lost;
    beams = now;
    if (condensed)
    {
      const unsigned int m = 2 * (line.last_point - line.first_point);
      condensed->setZero(m, m);
      if (m == 0)
        return true;
      const Eigen::MatrixXd own = stiffness(line, marks, before, now, part);
      // Friction makes them others than each other's transposed.
      Eigen::MatrixXd coupling = Eigen::MatrixXd::Zero(n, m),
                      forces   = Eigen::MatrixXd::Zero(m, n);
      for (unsigned int k = 0; k < m / 2; ++k)
      {
        const unsigned int p = line.first_point + k, at = points[p].at;
        condensed->block<2, 2>(2 * k, 2 * k)               = part[k];
        coupling.block<2, 2>(2 * (at - line.begin), 2 * k) = part[k];
        forces.block<2, 2>(2 * k, 2 * (at - line.begin))   = part[k];
        if (!now.attached[p] || marks.is_absent(points[p].block))
          continue;
        std::array<double, 2> normal;
        const auto [opening, slip]
            = gap(line, p, now, now.block_position.data() + 2 * p, normal);
        const Eigen::Vector2d n(normal[0], normal[1]),
            t(points[p].side * normal[1], -points[p].side * normal[0]);
        const FrameTerms terms(
            n, t, points[p].side,
            (opening + now.offset[p][0]) * n + (slip + now.offset[p][1]) * t,
            points[p].area * now.interface.normal_traction[p],
            points[p].area * now.interface.shear_traction[p], part[k]);
        Turning turning;
        const double share
            = has_before(line, at) && has_after(line, at) ? 0.5 : 1.;
        for (const unsigned int first : { previous(line, at), at })
        {
          if (first == at ? !has_after(line, at) : !has_before(line, at))
            continue;
          const Segment s = segment(line, first, now);
          add_turning(first - line.begin, next(line, first) - line.begin,
                      s.direction, s.length, share, turning);
        }
        for (const auto &[q, w] : turning)
          for (unsigned int d = 0; d < 2; ++d)
          {
            coupling(q, 2 * k + d) -= w * terms.couple_by_gap[d];
            forces(2 * k + d, q) -= w * terms.force_by_angle[d];
          }
      }
      for (unsigned int i = 0; i < n; ++i)
        if (held(line, line.begin + i / 2, i % 2))
        {
          coupling.row(i).setZero();
          forces.col(i).setZero();
        }
      // The nodes of the beam follow the points.
      *condensed -= forces * own.partialPivLu().solve(coupling);
    }
    return true;
  }

  bool Beams::settle(const TimePoint &time, const State<2> &committed,
                     State<2> &state, dealii::Tensor<1, 2> *block_force,
                     Condensed *stiffness) const
  {
    BeamState &beams     = state.get<BeamState>();
    beams.block_position = block_positions(state);
    beams.stored_strain = beams.stored_joint = 0.;
    AlignedArray<dealii::Tensor<1, 2>> by_point(points.size(),
                                                dealii::Tensor<1, 2>());
    EnergyAccounts energy;
    if (stiffness)
      stiffness->assign(lines.size(), Eigen::MatrixXd());
    for (unsigned int b = 0; b < lines.size(); ++b)
      if (beams.placed[b]
          && !settle(lines[b], time, committed, beams, energy, by_point.data(),
                     stiffness ? &(*stiffness)[b] : nullptr))
        return false;
    for (unsigned int p = 0; p < points.size(); ++p)
      if (points[p].node != NodeMap<2>::none)
        for (unsigned int d = 0; d < 2; ++d)
          block_force[points[p].node][d] -= by_point[p][d];
    if (is_first_rank)
      state.energy += energy;
    return true;
  }
} // namespace quoin
