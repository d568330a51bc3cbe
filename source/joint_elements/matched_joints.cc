// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/archive.h>
#include <quoin/joint_elements/matched_joints.h>
#include <quoin/joint_laws/composite_lanes.h>
#include <quoin/joint_laws/coulomb_lanes.h>

#include <algorithm>

#include "joint_frame.h"
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

  double MatchedJoints::stored_energy(const State<2> &state) const
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
    return energy;
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
} // namespace quoin
