// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/archive.h>
#include <quoin/joint_elements/dashpot_tractions.h>
#include <quoin/joint_elements/joint_tangent.h>

#include <algorithm>

#include "face_group_forces.h"
#include "joint_rates.h"
#include "joint_sets.h"
#include <quoin/joint_elements/joint_points.h>

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
    groups.prepare(all_segments, sets.size(),
                   [](const JointSegment &segment, const unsigned int k)
                   { return segment.area[k]; });
  }

  std::array<std::array<double, 2>, 2> joint_gaps(const JointSegment &segment,
                                                  const NodeRecord<2> *nodes)
  {
    const JointFrame local = joint_frame(segment, nodes);
    return { { joint_gap(segment, local, nodes, 0),
               joint_gap(segment, local, nodes, 1) } };
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
            groups.add_forces(set, own, nodes, history,
                              history.handed_over.data(), lost, force);
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
  void MatchedJoints::add_viscous_forces(const NodeRecord<2> *nodes,
                                         const JointHistory &history,
                                         const dealii::Tensor<1, 2> *velocity,
                                         const double beta,
                                         dealii::Tensor<1, 2> *force) const
  {
    for (unsigned int set = 0; set < all_laws.size(); ++set)
      std::visit(
          [&](const auto &law)
          {
            groups.add_viscous_forces(set, law, nodes, history,
                                      history.handed_over.data(), velocity,
                                      beta, force);
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
