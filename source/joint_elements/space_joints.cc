// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_elements/dashpot_bounds.h>
#include <quoin/joint_elements/joint_tangent.h>
#include <quoin/operators/archive.h>

#include <algorithm>
#include <cmath>

#include "dashpot_forces.h"
#include "face_group_forces.h"
#include "joint_energy.h"
#include "joint_sets.h"

namespace quoin
{
  SpaceJointFrame joint_frame(const SpaceJointFace &face,
                              const NodeRecord<3> *nodes)
  {
    const auto edge = [&](const unsigned int k)
    {
      return 0.5
             * (between(nodes[face.lower[0]], nodes[face.lower[k]])
                + between(nodes[face.upper[0]], nodes[face.upper[k]]));
    };
    return frame_of(edge(1), edge(2));
  }

  std::array<SpaceJointGap, 3> joint_gaps(const SpaceJointFace &face,
                                          const NodeRecord<3> *nodes)
  {
    const SpaceJointFrame frame = joint_frame(face, nodes);
    std::array<SpaceJointGap, 3> gaps;
    for (unsigned int k = 0; k < 3; ++k)
      gaps[k] = components(frame, gap_vector(face, nodes, k));
    return gaps;
  }

  void SpaceJoints::prepare(const NodeMap<3> &nodes,
                            const std::vector<JointSetParameters> &sets)
  {
    node_map = &nodes;
    set_laws(sets);
    all_faces.clear();
    const auto set_of_name = sets_of_names<3>(nodes.table().face_names, sets);
    // The first face without set of all ranks is the one that is named.
    unsigned int without_set = nodes.faces().n_global_joints;
    for (unsigned int f = 0; f < nodes.faces().joints.size(); ++f)
    {
      const JointNodes<3> &joint = nodes.faces().joints[f];
      const unsigned int set     = set_of_name[joint.name];
      if (set == no_joint_set)
      {
        without_set = std::min(without_set, joint.number);
        continue;
      }
      const auto edge = [&](const unsigned int k)
      { return nodes.point(joint.lower[k]) - nodes.point(joint.lower[0]); };
      SpaceJointFace face;
      face.lower = joint.lower;
      face.upper = joint.upper;
      face.area  = cross_product_3d(edge(1), edge(2)).norm() / 6.;
      face.share = 0.5f * (joint.is_own[0] + joint.is_own[1]);
      face.set   = set;
      face.face  = f;
      all_faces.push_back(face);
    }
    refuse_without_set(nodes, without_set);
    std::stable_sort(all_faces.begin(), all_faces.end(),
                     [](const SpaceJointFace &a, const SpaceJointFace &b)
                     { return a.set < b.set; });
    dashpots.set_faces(all_faces, nodes.faces().joints);
    groups.prepare(all_faces, sets.size(), nodes);
  }

  void SpaceJoints::set_laws(const std::vector<JointSetParameters> &sets)
  {
    all_laws.clear();
    for (const JointSetParameters &set : sets)
      all_laws.push_back(set.law);
    dashpots.set_dampings(sets);
  }

  void SpaceJoints::prepare(State<3> &state) const
  {
    if (state.find<SpaceJointHistory>())
      return;
    unsigned int most = 0;
    for (const JointLaw &law : all_laws)
      most = std::max(most, n_internal(law));
    SpaceJointHistory &history = state.add<SpaceJointHistory>();
    history.resize(all_faces.size(), most);
    for (unsigned int p = 0; p < n_points(); ++p)
      std::visit([&](const auto &law)
                 { write_point(PointOf<decltype(law), 3>(), history, p); },
                 all_laws[all_faces[p / 3].set]);
  }

  void SpaceJoints::add_forces(const StepContext &step, State<3> &state,
                               const NodeForces<3> &forces)
  {
    SpaceJointHistory &history = state.get<SpaceJointHistory>();
    add_forces(state.nodes.data(), history, state.energy, forces.force);
    if (forces.viscous && step.stiffness_damping > 0.)
      add_viscous_forces(state.nodes.data(), history, state.velocity.data(),
                         step.stiffness_damping, forces.viscous);
    if (forces.viscous && dashpots.act())
      dashpots.add_forces(all_faces, all_laws, state.nodes.data(), history,
                          history.detached.data(), state.velocity.data(),
                          forces.viscous);
  }

  void SpaceJoints::add_forces(const NodeRecord<3> *nodes,
                               SpaceJointHistory &history,
                               EnergyAccounts &energy,
                               dealii::Tensor<1, 3> *force) const
  {
    // Summed apart: a step's share is small beside the account.
    EnergyAccounts lost;
    for (unsigned int set = 0; set < all_laws.size(); ++set)
      std::visit(
          [&](const auto &law)
          {
            const auto own = law; // which no history can alias
            groups.add_forces(set, own, nodes, history, history.detached.data(),
                              lost, force);
          },
          all_laws[set]);
    energy += lost;
  }

  void SpaceJoints::add_viscous_forces(const NodeRecord<3> *nodes,
                                       const SpaceJointHistory &history,
                                       const dealii::Tensor<1, 3> *velocity,
                                       const double beta,
                                       dealii::Tensor<1, 3> *force) const
  {
    for (unsigned int set = 0; set < all_laws.size(); ++set)
      std::visit(
          [&](const auto &law)
          {
            groups.add_viscous_forces(set, law, nodes, history,
                                      history.detached.data(), velocity, beta,
                                      force);
          },
          all_laws[set]);
  }

  void add_elastic_forces(const SpaceJoints &joints, const NodeRecord<3> *nodes,
                          const dealii::Tensor<1, 3> *displacement,
                          dealii::Tensor<1, 3> *force)
  {
    for (const SpaceJointFace &face : joints.faces())
    {
      const auto [kn, ks] = stiffness_bound(joints.laws()[face.set]);
      add_rate_forces(
          face, nodes, displacement, [](unsigned int) { return true; },
          [kn = kn, ks = ks](unsigned int, const PointMotion<3> &motion) {
            return JointVector<3>{ kn * motion.rate.normal,
                                   ks * motion.rate.shear };
          },
          force);
    }
  }

  void SpaceJoints::add_stored_energy(const State<3> &state,
                                      EnergyAccounts &energies) const
  {
    const SpaceJointHistory &history = state.get<SpaceJointHistory>();
    energies.joint += stored_energy(all_faces, all_laws, history,
                                    history.detached, state.nodes.data());
  }

  void SpaceJoints::add_stiffness_bound(
      const State<3> &state, const NodeRatio &ratio,
      std::vector<NodeStiffness<3>> &stiffness) const
  {
    for (const SpaceJointFace &face : all_faces)
    {
      const Vector n             = joint_frame(face, state.nodes.data()).n;
      const auto [normal, shear] = stiffness_bound(all_laws[face.set]);
      const double kn = face.area * normal, ks = face.area * shear;
      // ks in all directions, and the rest along the normal.
      const NodeStiffness<3> spring
          = { { ks + (kn - ks) * n[0] * n[0], ks + (kn - ks) * n[1] * n[1],
                ks + (kn - ks) * n[2] * n[2], (kn - ks) * n[0] * n[1],
                (kn - ks) * n[0] * n[2], (kn - ks) * n[1] * n[2] } };
      for (unsigned int k = 0; k < 3; ++k)
      {
        const unsigned int a = face.lower[k], b = face.upper[k];
        if (a == b) // the front of a crack
          continue;
        const double ab = ratio(a, b), ba = ratio(b, a);
        for (unsigned int c = 0; c < spring.size(); ++c)
        {
          stiffness[a][c] += (1. + ab) * spring[c];
          stiffness[b][c] += (1. + ba) * spring[c];
        }
      }
    }
  }

  void SpaceJoints::add_damping_bound(const std::vector<double> &masses,
                                      const double impedance,
                                      DampingBound &bound) const
  {
    add_dashpots(*node_map, joint_areas(*this, *node_map), all_laws,
                 dashpots.dampings(), masses, impedance, bound);
  }

  std::vector<std::string> law_field_names(const SpaceJoints &joints)
  {
    std::vector<std::string> names;
    for (const JointLaw &law : joints.laws())
      std::visit(
          [&](const auto &own)
          {
            for (const auto &field : own.template fields<3>())
              if (std::find(names.begin(), names.end(), field.name)
                  == names.end())
                names.push_back(field.name);
          },
          law);
    return names;
  }

  double law_field(const SpaceJoints &joints, const std::string &name,
                   const unsigned int p, const SpaceJointHistory &history)
  {
    double value = 0.;
    std::visit(
        [&](const auto &law)
        {
          for (const auto &field : law.template fields<3>())
            if (field.name == name)
              value = field.value(read_point(law, history, p));
        },
        joints.laws()[joints.faces()[p / 3].set]);
    return value;
  }
} // namespace quoin
