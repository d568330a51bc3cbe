// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Initial stress of a Model<2>.

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/model/model.h>
#include <quoin/loads/nodal_load.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Stress xx, yy, xy, zz of @p load in a material [Pa]. */
    std::array<double, 4> initial_stress(const LoadParameters &load,
                                         const dealii::Point<2> &point,
                                         const LinearElastic &material,
                                         const PlaneAssumption plane)
    {
      auto stress = load.initial_stress(point[0], point[1], material.poisson);
      if (plane == PlaneAssumption::plane_stress)
        stress[3] = 0.;
      return stress;
    }

    /** Refuses values of expressions that are no numbers; collective. */
    void refuse_infinite(const std::string &load,
                         const std::vector<std::array<double, 4>> &cells,
                         const std::vector<JointFaceStress> &faces,
                         const MPI_Comm communicator)
    {
      const auto is_wrong = [](const auto &stress)
      {
        return !std::all_of(stress.begin(), stress.end(),
                            [](const double part)
                            { return std::isfinite(part); });
      };
      std::size_t n = std::count_if(cells.begin(), cells.end(), is_wrong);
      for (const JointFaceStress &face : faces)
        n += std::count_if(face.begin(), face.end(), is_wrong);
      n = dealii::Utilities::MPI::sum(n, communicator);
      if (n > 0)
        throw InputError("section 'Loads/" + load
                         + "': its stress is no finite " + "number at "
                         + count_text(n, "place")
                         + " of the model, such as 1/y where y is 0. Give "
                           "expressions that have a value in all blocks.");
    }
  } // namespace

  template <>
  void Model<2>::find_initial_stress()
  {
    if (given.initial_stresses.empty())
      return;
    cell_stress.assign(node_map.cells().size(), {});
    face_stress.assign(node_map.faces().joints.size(), {});
    for (const LoadParameters &load : given.initial_stresses)
    {
      if (given.plane == PlaneAssumption::plane_stress
          && (load.stress_zz || load.stress_fields.size() == 4))
        throw InputError("section 'Loads/" + load.name
                         + "': 'Stress zz' is the stress out of the plane, "
                           "which is zero with 'Plane assumption = plane "
                           "stress'. Leave it at "
                           "'elastic'.");
      if (given.plane == PlaneAssumption::plane_stress && load.in_situ
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
      const auto stress_at
          = [&](const dealii::Point<2> &point, const unsigned int group)
      {
        return initial_stress(
            load, point, now.materials[now.material_of_group[group]].elastic,
            given.plane);
      };
      for (unsigned int c = 0; c < node_map.cells().size(); ++c)
      {
        const unsigned int group = node_map.cells().group[c];
        if (!acts_in(group))
          continue;
        dealii::Point<2> centre;
        for (const unsigned int node : node_map.cells().nodes[c])
          for (unsigned int d = 0; d < 2; ++d)
            centre[d] += node_map.point(node)[d] / 3.;
        const auto stress = stress_at(centre, group);
        for (unsigned int k = 0; k < 4; ++k)
          cell_stress[c][k] += stress[k];
      }
      for (unsigned int f = 0; f < face_stress.size(); ++f)
      {
        const JointNodes<2> &face = node_map.faces().joints[f];
        if (absent_group[face.groups[0]] || absent_group[face.groups[1]])
          continue;
        for (const unsigned int group : face.groups)
          if (acts_in(group))
            for (unsigned int k = 0; k < 2; ++k)
            {
              const auto stress
                  = stress_at(node_map.point(face.lower[k]), group);
              for (unsigned int i = 0; i < 3; ++i)
                face_stress[f][k][i] += 0.5 * stress[i];
            }
      }
      refuse_infinite(load.name, cell_stress, face_stress,
                      node_map.communicator());
    }
    // The points' forces become those of a traction that is linear along the
    // face. Simpson's rule on quadratic edges gives them already.
    for (JointFaceStress &face : face_stress)
      for (unsigned int i = 0; i < 3 && !node_map.table().is_quadratic; ++i)
      {
        const double third = (face[1][i] - face[0][i]) / 3.;
        face[0][i] += third;
        face[1][i] -= third;
      }
  }
} // namespace quoin
