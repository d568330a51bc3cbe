// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/archive.h>
#include <quoin/joint_elements/dashpot_tractions.h>
#include <quoin/joint_elements/joint_tangent.h>
#include <quoin/joint_laws/composite_lanes.h>
#include <quoin/joint_laws/coulomb_lanes.h>

#include <algorithm>

#include "joint_rates.h"
#include "joint_sets.h"
#include <quoin/joint_elements/joint_points.h>
#include "segment_lanes.h"

namespace quoin
{
  void MatchedJoints::prepare(const NodeMap<2> &nodes,
                              const std::vector<JointSetParameters> &sets,
                              const Thickness &group_thickness)
  {
    node_map  = &nodes;
    thickness = group_thickness;
    set_laws(sets);
    all_segments.clear();
    const BlockTable<2> &table = nodes.table();
    const auto set_of_name     = sets_of_names<2>(table.face_names, sets);
    // The first face without set of all ranks is the one that is named.
    unsigned int without_set = nodes.faces().n_global_joints;
    for (unsigned int f = 0; f < nodes.faces().joints.size(); ++f)
    {
      const JointNodes<2> &face = nodes.faces().joints[f];
      const unsigned int set    = set_of_name[face.name];
      if (set == no_joint_set)
      {
        without_set = std::min(without_set, face.number);
        continue;
      }
      JointSegment segment;
      for (unsigned int k = 0; k < 2; ++k)
        segment.area[k]
            = face_share(nodes, face.lower[k])
              * thickness.common(face.groups[0], face.groups[1])
              * nodes.point(face.lower[0]).distance(nodes.point(face.lower[1]));
      segment.lower = face.lower;
      segment.upper = face.upper;
      segment.share = 0.5f * (face.is_own[0] + face.is_own[1]);
      segment.set   = set;
      segment.face  = f;
      all_segments.push_back(segment);
    }
    refuse_without_set(nodes, without_set);
    std::stable_sort(all_segments.begin(), all_segments.end(),
                     [](const JointSegment &a, const JointSegment &b)
                     { return a.set < b.set; });
    segment_sides.clear();
    for (const JointSegment &segment : all_segments)
    {
      const JointNodes<2> &face = nodes.faces().joints[segment.face];
      segment_sides.push_back({ face.blocks, face.groups });
    }
    set_begin.assign(1, 0);
    for (unsigned int s = 0; s < sets.size(); ++s)
      set_begin.push_back(std::partition_point(
                              all_segments.begin(), all_segments.end(),
                              [s](const JointSegment &a) { return a.set <= s; })
                          - all_segments.begin());
    group_segments();
  }

  void MatchedJoints::group_segments()
  {
    groups.clear();
    group_begin.assign(1, 0);
    for (unsigned int s = 0; s + 1 < set_begin.size(); ++s)
    {
      for (unsigned int i = set_begin[s]; i < set_begin[s + 1];
           i += native_lanes)
      {
        SegmentGroup<native_lanes> group{};
        group.first = i;
        group.size  = std::min(native_lanes, set_begin[s + 1] - i);
        for (unsigned int l = 0; l < native_lanes; ++l)
        {
          const JointSegment &segment
              = all_segments[i + std::min(l, group.size - 1)];
          for (unsigned int k = 0; k < 2; ++k)
          {
            group.nodes[k][l] = segment.lower[k] * sizeof(dealii::Tensor<1, 2>);
            group.nodes[2 + k][l]
                = segment.upper[k] * sizeof(dealii::Tensor<1, 2>);
            if (l >= group.size)
              continue;
            group.area[2 * l + k]   = segment.area[k];
            group.weight[2 * l + k] = segment.area[k] * segment.share;
          }
        }
        groups.push_back(group);
      }
      group_begin.push_back(groups.size());
    }
  }

  std::array<std::array<double, 2>, 2> joint_gaps(const JointSegment &segment,
                                                  const NodeRecord<2> *nodes)
  {
    const JointFrame local = joint_frame(segment, nodes);
    return { { joint_gap(segment, local, nodes, 0),
               joint_gap(segment, local, nodes, 1) } };
  }

  template <typename Law>
  void MatchedJoints::add_set_forces(const unsigned int set, const Law &law,
                                     const NodeRecord<2> *nodes,
                                     JointHistory &history,
                                     EnergyAccounts &energy,
                                     dealii::Tensor<1, 2> *force) const
  {
    using F     = LaneFunctions<native_lanes>;
    using Bits  = F::Bits;
    using Value = F::Value;
    const LawLanes<Law, native_lanes> laws(law);
    const PointArrays arrays = arrays_of(history);
    DissipationLanes<native_lanes> lost;
    // Points of the last group: those behind it belong to another set, or to
    // none.
    PointPack<2 * native_lanes> pack;
    for (unsigned int g = group_begin[set]; g < group_begin[set + 1]; ++g)
    {
      const auto &group  = groups[g];
      const Bits present = SegmentLanes<native_lanes>::present(
          group, history.handed_over.data());
      if (!F::any(present))
        continue;
      const SegmentLanes<native_lanes> segments(group, nodes, present);

      // Points of the group, in the order of the history.
      const Value opening[2]
          = { F::interleave_low(segments.opening[0], segments.opening[1]),
              F::interleave_high(segments.opening[0], segments.opening[1]) };
      const Value slip[2]
          = { F::interleave_low(segments.slip[0], segments.slip[1]),
              F::interleave_high(segments.slip[0], segments.slip[1]) };
      const Bits there[2]     = { F::interleave_low(present, present),
                                  F::interleave_high(present, present) };
      const bool is_full      = group.size == native_lanes;
      const PointArrays all   = arrays.from(2 * group.first);
      const PointArrays first = is_full ? all : pack.arrays();
      if (!is_full)
        copy_points(all, first, 2 * group.size);
      Value sigma[2], tau[2];
      for (unsigned int h = 0; h < 2; ++h)
      {
        PointLanes<native_lanes> points{};
        points.arrays     = first.from(h * native_lanes);
        points.opening    = opening[h];
        points.slip       = slip[h];
        const Bits steady = laws.try_elastic(points);
        if (F::all(steady & there[h]))
          points.store_tractions();
        else
          laws.update(points, there[h],
                      F::load(group.weight + h * native_lanes), lost);
        const Value area = F::load(group.area + h * native_lanes);
        sigma[h]         = area * points.sigma;
        tau[h]           = area * points.tau;
      }
      if (!is_full)
        copy_points(first, all, 2 * group.size);
      segments.add_forces(
          group, { F::even(sigma[0], sigma[1]), F::odd(sigma[0], sigma[1]) },
          { F::even(tau[0], tau[1]), F::odd(tau[0], tau[1]) }, force);
    }
    energy.friction += F::sum(lost.friction);
    energy.fracture += F::sum(lost.fracture);
    energy.crushing += F::sum(lost.crushing);
  }

  void MatchedJoints::prepare(State<2> &state) const
  {
    if (state.find<JointHistory>())
      return;
    unsigned int most = 0;
    for (const JointLaw &law : all_laws)
      most = std::max(most, n_internal(law));
    JointHistory &history = state.add<JointHistory>();
    history.resize(n_points(), most);
    for (unsigned int i = 0; i < all_segments.size(); ++i)
      std::visit(
          [&](const auto &law)
          {
            for (const unsigned int p : { 2 * i, 2 * i + 1 })
              write_point(PointOf<decltype(law)>(), history, p);
          },
          all_laws[all_segments[i].set]);
  }

  void MatchedJoints::add_forces(const StepContext &step, State<2> &state,
                                 const NodeForces<2> &forces)
  {
    JointHistory &history = state.get<JointHistory>();
    add_forces(state.nodes.data(), history, state.energy, forces.force);
    if (forces.viscous && step.stiffness_damping > 0.)
      add_viscous_forces(state.nodes.data(), history, state.velocity.data(),
                         step.stiffness_damping, forces.viscous);
    if (forces.viscous && has_dashpots())
      add_dashpot_forces(state.nodes.data(), history, state.velocity.data(),
                         forces.viscous);
  }

  void MatchedJoints::add_forces(const NodeRecord<2> *nodes,
                                 JointHistory &history, EnergyAccounts &energy,
                                 dealii::Tensor<1, 2> *force) const
  {
    // Summed apart: a step's share is small beside the account.
    EnergyAccounts lost;
    for (unsigned int set = 0; set < all_laws.size(); ++set)
      std::visit(
          [&](const auto &law)
          {
            const auto own = law; // which no history can alias
            add_set_forces(set, own, nodes, history, lost, force);
          },
          all_laws[set]);
    energy += lost;
  }

  void MatchedJoints::add_stored_energy(const State<2> &state,
                                        EnergyAccounts &energies) const
  {
    const JointHistory &history = state.get<JointHistory>();
    double energy               = 0.;
    for (unsigned int i = 0; i < all_segments.size(); ++i)
    {
      if (history.handed_over[i])
        continue;
      const JointSegment &segment = all_segments[i];
      const auto gap              = joint_gaps(segment, state.nodes.data());
      std::visit(
          [&](const auto &law)
          {
            for (unsigned int k = 0; k < 2; ++k)
              energy += segment.area[k] * segment.share
                        * law.stored_energy(read_point(law, history, 2 * i + k),
                                            gap[k][0]);
          },
          all_laws[segment.set]);
    }
    energies.joint += energy;
  }

  void MatchedJoints::set_laws(const std::vector<JointSetParameters> &sets)
  {
    all_laws.clear();
    dampings.clear();
    for (const auto &set : sets)
    {
      all_laws.push_back(set.law);
      dampings.push_back(set.damping);
    }
  }

  void MatchedJoints::add_stiffness_bound(
      const State<2> &state, const NodeRatio &ratio,
      std::vector<NodeStiffness<2>> &stiffness) const
  {
    for (const JointSegment &segment : all_segments)
    {
      const JointFrame local = joint_frame(segment, state.nodes.data());
      const auto [normal_stiffness, shear_stiffness]
          = stiffness_bound(all_laws[segment.set]);
      const dealii::Tensor<1, 2> &n = local.normal, &s = local.tangent;
      for (unsigned int k = 0; k < 2; ++k)
      {
        const unsigned int a = segment.lower[k], b = segment.upper[k];
        if (a == b) // the tip of a crack
          continue;
        const double kn = segment.area[k] * normal_stiffness;
        const double ks = segment.area[k] * shear_stiffness;
        const std::array<double, 3> spring
            = { { kn * n[0] * n[0] + ks * s[0] * s[0],
                  kn * n[1] * n[1] + ks * s[1] * s[1],
                  kn * n[0] * n[1] + ks * s[0] * s[1] } };
        const double ab = ratio(a, b), ba = ratio(b, a);
        for (unsigned int c = 0; c < 3; ++c)
        {
          stiffness[a][c] += (1. + ab) * spring[c];
          stiffness[b][c] += (1. + ba) * spring[c];
        }
      }
    }
  }
  template <typename Law>
  void MatchedJoints::add_set_viscous_forces(
      const unsigned int set, const Law &law, const NodeRecord<2> *nodes,
      const JointHistory &history, const dealii::Tensor<1, 2> *velocity,
      const double beta, dealii::Tensor<1, 2> *force) const
  {
    using F     = LaneFunctions<native_lanes>;
    using Bits  = F::Bits;
    using Value = F::Value;
    for (unsigned int g = group_begin[set]; g < group_begin[set + 1]; ++g)
    {
      const auto &group = groups[g];
      // beta kn and beta ks times the area, of the points that act.
      double factor[2][2 * native_lanes]{};
      bool acts = false;
      for (unsigned int j = 0; j < 2 * group.size; ++j)
      {
        const unsigned int p = 2 * group.first + j;
        if (history.state[p] == JointState::slipping
            || history.state[p] == JointState::open)
          continue;
        const auto [kn, ks] = law.stiffness_at(history.normal_traction[p]);
        factor[0][j]        = beta * kn * group.area[j];
        factor[1][j]        = beta * ks * group.area[j];
        acts                = true;
      }
      if (!acts)
        continue;
      const Bits present = SegmentLanes<native_lanes>::present(
          group, history.handed_over.data());
      const SegmentLanes<native_lanes> segments(group, nodes, present);
      Value opening_rate[2], slip_rate[2];
      segments.find_rates(group, velocity, opening_rate, slip_rate);
      const auto of_point = [](const double *values, Value(&result)[2])
      {
        const Value a = F::load(values), b = F::load(values + native_lanes);
        result[0] = F::even(a, b);
        result[1] = F::odd(a, b);
      };
      Value sigma[2], tau[2];
      of_point(factor[0], sigma);
      of_point(factor[1], tau);
      for (unsigned int k = 0; k < 2; ++k)
      {
        sigma[k] *= opening_rate[k];
        tau[k] *= slip_rate[k];
      }
      segments.add_forces(group, sigma, tau, force);
    }
  }

  void MatchedJoints::add_viscous_forces(const NodeRecord<2> *nodes,
                                         const JointHistory &history,
                                         const dealii::Tensor<1, 2> *velocity,
                                         const double beta,
                                         dealii::Tensor<1, 2> *force) const
  {
    for (unsigned int set = 0; set < all_laws.size(); ++set)
      std::visit(
          [&](const auto &law) {
            add_set_viscous_forces(set, law, nodes, history, velocity, beta,
                                   force);
          },
          all_laws[set]);
  }

  void MatchedJoints::set_blocks(const DashpotBlocks &blocks)
  {
    dashpots.set_blocks(blocks);
    dashpots.bind(segment_sides);
  }

  bool MatchedJoints::has_dashpots() const
  {
    return dashpots.knows_blocks()
           && std::any_of(dampings.begin(), dampings.end(),
                          [](const JointDamping &damping)
                          { return damping.acts(); });
  }

  void MatchedJoints::add_dashpot_forces(const NodeRecord<2> *nodes,
                                         const JointHistory &history,
                                         const dealii::Tensor<1, 2> *velocity,
                                         dealii::Tensor<1, 2> *force)
  {
    // A point that never failed carries tension, too.
    const auto bears = [&](const unsigned int p)
    {
      return !history.handed_over[p / 2]
             && (history.state[p] == JointState::intact
                 || history.normal_traction[p] < 0.);
    };
    const auto stiffness = [&](const unsigned int p)
    {
      return std::visit(
          [&](const auto &law)
          { return law.stiffness_at(history.normal_traction[p]); },
          all_laws[all_segments[p / 2].set]);
    };
    dashpots.clear();
    for (unsigned int p = 0; p < n_points(); ++p)
      if (bears(p))
      {
        const JointSegment &segment = all_segments[p / 2];
        const auto [kn, ks]         = stiffness(p);
        dashpots.add_springs(p / 2, segment.share, segment.area[p % 2] * kn,
                             segment.area[p % 2] * ks);
      }
    dashpots.sum_over_ranks();

    for (unsigned int i = 0; i < all_segments.size(); ++i)
      if (const JointDamping &damping = dampings[all_segments[i].set];
          damping.acts())
        std::visit(
            [&](const auto &law)
            {
              add_rate_forces(
                  all_segments[i], nodes, velocity,
                  [&](const unsigned int k) { return bears(2 * i + k); },
                  [&](const unsigned int k, const PointMotion &motion)
                  {
                    const unsigned int p = 2 * i + k;
                    return dashpot_tractions(
                        law, read_point(law, history, p), motion.gap,
                        motion.rate, dashpots.times(i, damping, stiffness(p)));
                  },
                  force);
            },
            all_laws[all_segments[i].set]);
  }
  void MatchedJoints::linearise(State<2> &state, const bool with_stiffness,
                                const TakeElement<2> &take) const
  {
    const auto *breaking = state.find<BreakingJoints<2>>();
    const std::vector<std::uint8_t> broken
        = breaking ? breaking->points : std::vector<std::uint8_t>(n_points());
    JointHistory &history = state.get<JointHistory>();
    JointLinearisation segment;
    for (unsigned int i = 0; i < all_segments.size(); ++i)
    {
      quoin::linearise(*this, i, state.nodes.data(), broken, history,
                       state.energy, segment, with_stiffness);
      take({ segment.nodes.data(), 4, segment.force.data(),
             segment.stiffness[0].data(), 8, all_segments[i].share,
             segment.inelastic, segment.inelastic_gradient.data(),
             all_segments[i].set,
             all_segments[i].area[0] + all_segments[i].area[1] });
    }
  }
} // namespace quoin
