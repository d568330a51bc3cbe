// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Initial stress of a Model.

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
    /** Refuses values of expressions that are no numbers; collective. */
    template <int dim>
    void refuse_infinite(const std::string &load,
                         const std::vector<CellStress<dim>> &cells,
                         const std::vector<JointFaceStress<dim>> &faces,
                         const MPI_Comm communicator)
    {
      const auto is_wrong = [](const auto &stress)
      {
        return !std::all_of(stress.begin(), stress.end(),
                            [](const double part)
                            { return std::isfinite(part); });
      };
      std::size_t n = std::count_if(cells.begin(), cells.end(), is_wrong);
      for (const JointFaceStress<dim> &face : faces)
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
  CellStress<2> Model<2>::initial_stress_of(const LoadParameters &load,
                                            const dealii::Point<2> &point,
                                            const LinearElastic &material) const
  {
    auto stress = load.initial_stress(point[0], point[1], material.poisson);
    if (given.plane == PlaneAssumption::plane_stress)
      stress[3] = 0.;
    return stress;
  }

  template <>
  CellStress<3> Model<3>::initial_stress_of(const LoadParameters &load,
                                            const dealii::Point<3> &point,
                                            const LinearElastic &) const
  {
    return load.initial_stress(point);
  }

  template <>
  void Model<2>::check_initial_stress(const LoadParameters &load) const
  {
    const std::string where = "section 'Loads/" + load.name + "': ";
    if (load.space_stress || load.stress_fields.size() == 6)
      throw InputError(where
                       + "'Stress' has six components, and the mesh has two "
                         "dimensions. Give xx, yy, xy.");
    if (load.in_situ && load.in_situ->surface_names_y)
      throw InputError(where
                       + "'Surface' depends on y, but it is the height y of "
                         "the ground: give an expression of x alone [m].");
    if (load.in_situ && load.in_situ->names_z)
      throw InputError(where
                       + "an expression depends on z, and the mesh has two "
                         "dimensions. Give expressions of x and y.");
    if (given.plane != PlaneAssumption::plane_stress)
      return;
    if (load.stress_zz || load.stress_fields.size() == 4)
      throw InputError(where
                       + "'Stress zz' is the stress out of the plane, which is "
                         "zero with 'Plane assumption = plane stress'. Leave "
                         "it at 'elastic'.");
    if (load.in_situ && load.in_situ->has_out_of_plane)
      throw InputError(where
                       + "'Out-of-plane ratio' gives a stress out of the "
                         "plane, which is zero with 'Plane assumption = plane "
                         "stress'. Leave it at 'same'.");
  }

  template <>
  void Model<3>::check_initial_stress(const LoadParameters &load) const
  {
    if (!load.in_situ && !load.space_stress && load.stress_fields.size() != 6)
      throw InputError("section 'Loads/" + load.name
                       + "': 'Stress' has three components, and the mesh has "
                         "three dimensions. Give xx, yy, zz, xy, xz, yz, and "
                         "leave 'Stress zz' at 'elastic'.");
  }

  template <int dim>
  void Model<dim>::find_initial_stress()
  {
    constexpr unsigned int n_components = dim * (dim + 1) / 2;
    if (given.initial_stresses.empty())
      return;
    cell_stress.assign(node_map.cells().size(), {});
    face_stress.assign(node_map.faces().joints.size(), {});
    for (const LoadParameters &load : given.initial_stresses)
    {
      check_initial_stress(load);
      const auto groups  = groups_of_names(node_map, load.groups, load.name);
      const auto acts_in = [&](const unsigned int group)
      {
        return !absent_group[group]
               && (groups.empty()
                   || std::find(groups.begin(), groups.end(), group)
                          != groups.end());
      };
      const auto stress_at
          = [&](const dealii::Point<dim> &point, const unsigned int group)
      {
        return initial_stress_of(
            load, point, now.materials[now.material_of_group[group]].elastic);
      };
      for (unsigned int c = 0; c < node_map.cells().size(); ++c)
      {
        const unsigned int group = node_map.cells().group[c];
        if (!acts_in(group))
          continue;
        dealii::Point<dim> centre;
        for (const unsigned int node : node_map.cells().nodes[c])
          for (unsigned int d = 0; d < dim; ++d)
            centre[d] += node_map.point(node)[d] / (dim + 1.);
        const auto stress = stress_at(centre, group);
        for (unsigned int k = 0; k < stress.size(); ++k)
          cell_stress[c][k] += stress[k];
      }
      for (unsigned int f = 0; f < face_stress.size(); ++f)
      {
        const JointNodes<dim> &face = node_map.faces().joints[f];
        if (absent_group[face.groups[0]] || absent_group[face.groups[1]])
          continue;
        for (const unsigned int group : face.groups)
          if (acts_in(group))
            for (unsigned int k = 0; k < dim; ++k)
            {
              const auto stress
                  = stress_at(node_map.point(face.lower[k]), group);
              for (unsigned int i = 0; i < n_components; ++i)
                face_stress[f][k][i] += 0.5 * stress[i];
            }
      }
      refuse_infinite<dim>(load.name, cell_stress, face_stress,
                           node_map.communicator());
    }
    // The points' forces become those of a traction that is linear along the
    // face: (t_k + sum of all) / (dim + 1) instead of t_k. Simpson's rule on
    // quadratic edges gives them already.
    if (node_map.table().is_quadratic)
      return;
    for (JointFaceStress<dim> &face : face_stress)
      for (unsigned int i = 0; i < n_components; ++i)
      {
        double sum = 0.;
        for (unsigned int k = 0; k < dim; ++k)
          sum += face[k][i];
        for (unsigned int k = 0; k < dim; ++k)
          face[k][i] = (face[k][i] + sum) / (dim + 1.);
      }
  }

  template void Model<2>::find_initial_stress();
  template void Model<3>::find_initial_stress();
} // namespace quoin
