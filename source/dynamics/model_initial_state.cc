// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What a Model is at the start: stresses, positions, histories.

#include <quoin/operators/archive.h>
#include <quoin/base/exceptions.h>
#include <quoin/dynamics/model.h>
#include <quoin/loads/nodal_load.h>

#include <algorithm>

namespace quoin
{
  std::array<double, 4> Model::initial_stress(const LoadParameters &load,
                                              const dealii::Point<2> &point,
                                              const unsigned int group) const
  {
    auto stress = load.initial_stress(
        point[0], point[1],
        parameters.materials[now.material_of_group[group]].elastic.poisson);
    if (parameters.plane == PlaneAssumption::plane_stress)
      stress[3] = 0.;
    return stress;
  }

  void Model::find_initial_stress()
  {
    if (parameters.initial_stresses.empty())
      return;
    cell_stress.assign(node_map.n_cells(), {});
    face_stress.assign(node_map.joint_faces().size(), {});
    for (const LoadParameters &load : parameters.initial_stresses)
    {
      if (parameters.plane == PlaneAssumption::plane_stress && load.stress_zz)
        throw InputError("section 'Loads/" + load.name
                         + "': 'Stress zz' is the stress out of the plane, "
                           "which is zero with 'Plane assumption = plane "
                           "stress'. Leave it at "
                           "'elastic'.");
      if (parameters.plane == PlaneAssumption::plane_stress && load.in_situ
          && load.in_situ->has_out_of_plane)
        throw InputError("section 'Loads/" + load.name
                         + "': 'Out-of-plane ratio' gives a stress out of the "
                           "plane, which is zero with 'Plane assumption = "
                           "plane stress'. Leave it at 'same'.");
      const auto groups  = groups_of_names(node_map, load.groups, load.name);
      const auto acts_in = [&](const unsigned int group)
      {
        return !absent_group[group]
               && (groups.empty()
                   || std::find(groups.begin(), groups.end(), group)
                          != groups.end());
      };
      for (unsigned int c = 0; c < node_map.n_cells(); ++c)
      {
        const unsigned int group = node_map.group_of_cell(c);
        if (!acts_in(group))
          continue;
        dealii::Point<2> centre;
        for (const unsigned int node : node_map.cell(c))
          for (unsigned int d = 0; d < 2; ++d)
            centre[d] += node_map.point(node)[d] / 3.;
        const auto stress = initial_stress(load, centre, group);
        for (unsigned int k = 0; k < 4; ++k)
          cell_stress[c][k] += stress[k];
      }
      for (unsigned int f = 0; f < face_stress.size(); ++f)
      {
        const JointNodes<2> &face = node_map.joint_faces()[f];
        if (absent_group[face.groups[0]] || absent_group[face.groups[1]])
          continue;
        for (const unsigned int group : face.groups)
          if (acts_in(group))
            for (unsigned int k = 0; k < 2; ++k)
            {
              const auto stress
                  = initial_stress(load, node_map.point(face.lower[k]), group);
              for (unsigned int i = 0; i < 3; ++i)
                face_stress[f][k][i] += 0.5 * stress[i];
            }
      }
    }
    // So that the points' forces are those of a traction that is linear along
    // the face. Simpson's rule of quadratic edges has them already.
    for (MatchedJoints::FaceStress &face : face_stress)
      for (unsigned int i = 0; i < 3 && !table().is_quadratic; ++i)
      {
        const double third = (face[1][i] - face[0][i]) / 3.;
        face[0][i] += third;
        face[1][i] -= third;
      }
  }

  void Model::forget_yielding(const unsigned int block,
                              PlasticHistory &history) const
  {
    const unsigned int part = node_map.find_part(block);
    if (part == node_map.block_parts().size())
      return;
    const auto &[begin, end] = node_map.block_parts()[part].cells;
    for (unsigned int c = begin; c < end; ++c)
      block_forces.forget_history(c, history);
  }

  State<2> Model::initial_state() const
  {
    State<2> state;
    state.add<RigidBlockStates>().resize(rigid.n_blocks());
    state.add<ConstructionState>();
    for (unsigned int i = 0; i < node_map.n_local(); ++i)
    {
      const auto &p = node_map.point(i);
      state.nodes.push_back({ { p[0], p[1] }, { 0., 0. } });
    }
    state.velocity.assign(node_map.n_local(), NodeVector<2>{ { 0., 0. } });
    block_forces.prepare(state);
    matched_joints.prepare(state);
    if (!face_stress.empty())
      matched_joints.initialise(face_stress, state, state.get<JointHistory>());
    if (std::find(absent_group.begin(), absent_group.end(), true)
        == absent_group.end())
      return state;
    for (const unsigned int group : table().group)
      state.block_marks.push_back(absent_group[group] ? block_mark::absent
                                                      : block_mark::present);
    for (unsigned int i = 0; i < matched_joints.n_segments(); ++i)
      if (is_at_absent_block(i, state))
        matched_joints.let_go(i, state.get<JointHistory>());
    return state;
  }
} // namespace quoin
