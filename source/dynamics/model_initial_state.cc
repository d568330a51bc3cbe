// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What a Model is at the start: stresses, positions, histories.

#include <quoin/base/exceptions.h>
#include <quoin/dynamics/model.h>
#include <quoin/loads/nodal_load.h>

#include <algorithm>

namespace quoin
{
  void Model::find_initial_stress()
  {
    if (parameters.initial_stresses.empty())
      return;
    cell_stress.assign(block_mesh.n_cells(), {});
    const bool plane_stress = parameters.plane == PlaneAssumption::plane_stress;
    for (const LoadParameters &load : parameters.initial_stresses)
    {
      const auto groups = groups_of_names(block_mesh, load.groups, load.name);
      if (plane_stress && load.stress_zz)
        throw InputError("section 'Loads/" + load.name
                         + "': 'Stress zz' is the stress out of the plane, "
                           "which is zero with 'Plane assumption = plane "
                           "stress'. Leave it at "
                           "'elastic'.");
      for (unsigned int c = 0; c < block_mesh.n_cells(); ++c)
      {
        if (!groups.empty()
            && std::find(groups.begin(), groups.end(), block_mesh.cell_group[c])
                   == groups.end())
          continue;
        double y = 0.;
        for (const unsigned int v : block_mesh.cells[c])
          y += block_mesh.vertices[v][1] / 3.;
        std::array<double, 3> stress;
        for (unsigned int k = 0; k < 3; ++k)
        {
          stress[k] = load.stress[k] + y * load.stress_gradient[k];
          cell_stress[c][k] += stress[k];
        }
        const double poisson
            = parameters.materials[material_of_cell(c)].elastic.poisson;
        if (!plane_stress)
          cell_stress[c][3]
              += load.stress_zz
                     ? (*load.stress_zz)[0] + y * (*load.stress_zz)[1]
                     : poisson * (stress[0] + stress[1]);
      }
    }
  }

  void Model::forget_yielding(const unsigned int block,
                              PlasticHistory &history) const
  {
    const PlasticHistory start = block_forces.initial_history();
    for (unsigned int c = block_mesh.block_first_cell[block];
         c < block_mesh.block_first_cell[block + 1]
         && block_forces.is_plastic();
         ++c)
    {
      const unsigned int own = c - first_cell();
      set_plastic_point(plastic_point(start, own), own, history);
    }
  }

  State Model::initial_state() const
  {
    State state;
    state.rigid_blocks.resize(rigid.n_blocks());
    for (unsigned int i = 0; i < nodes->n_local(); ++i)
    {
      const auto &p = block_mesh.vertices[nodes->global(i)];
      state.nodes.push_back({ { p[0], p[1] }, { 0., 0. } });
    }
    state.velocity.assign(nodes->n_local(), NodeVector{ { 0., 0. } });
    state.plastic = block_forces.initial_history();
    state.joints.resize(matched_joints.n_points(), matched_joints.can_soften(),
                        matched_joints.can_wear());
    if (!cell_stress.empty())
    {
      std::vector<std::array<double, 3>> face_stress;
      for (const JointFace &face : block_mesh.joint_faces)
      {
        face_stress.emplace_back();
        for (unsigned int k = 0; k < 3; ++k)
          face_stress.back()[k] = 0.5
                                  * (cell_stress[face.cells[0]][k]
                                     + cell_stress[face.cells[1]][k]);
      }
      matched_joints.initialise(face_stress, state, state.joints);
    }
    return state;
  }
} // namespace quoin
