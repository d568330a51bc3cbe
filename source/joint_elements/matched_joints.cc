// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/archive.h>
#include <quoin/joint_elements/dashpot_bounds.h>
#include <quoin/joint_elements/joint_tangent.h>

#include <algorithm>

#include "dashpot_forces.h"
#include "face_group_forces.h"
#include "joint_energy.h"
#include "joint_sets.h"
#include <quoin/joint_elements/joint_points.h>

namespace quoin
{
  void MatchedJoints::prepare(const NodeMap<2> &nodes,
                              const std::vector<JointSetParameters> &sets,
                              const Thickness &thickness)
  {
    node_map = &nodes;
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
    dashpots.set_faces(all_segments, nodes.faces().joints);
    groups.prepare(all_segments, sets.size(), nodes);
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
    if (forces.viscous && dashpots.act())
      dashpots.add_forces(all_segments, all_laws, state.nodes.data(), history,
                          history.handed_over.data(), state.velocity.data(),
                          forces.viscous);
  }

  void MatchedJoints::add_dashpot_forces(const unsigned int i,
                                         const State<2> &state,
                                         dealii::Tensor<1, 2> *force) const
  {
    const JointHistory &history = state.get<JointHistory>();
    if (dashpots.act())
      dashpots.add_face_forces(i, all_segments, all_laws, state.nodes.data(),
                               history, history.handed_over.data(),
                               state.velocity.data(), force);
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
    energies.joint += stored_energy(all_segments, all_laws, history,
                                    history.handed_over, state.nodes.data());
  }

  void MatchedJoints::set_laws(const std::vector<JointSetParameters> &sets)
  {
    all_laws.clear();
    for (const auto &set : sets)
      all_laws.push_back(set.law);
    dashpots.set_dampings(sets);
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

  void MatchedJoints::add_damping_bound(const std::vector<double> &masses,
                                        const double impedance,
                                        DampingBound &bound) const
  {
    add_dashpots(*node_map, joint_areas(*this, *node_map), all_laws,
                 dashpots.dampings(), masses, impedance, bound);
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
