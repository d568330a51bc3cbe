// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/model/initial_stress.h>
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

    /** Initial stress by @p load at @p point in a material [Pa]. */
    CellStress<2> stress_of(const LoadParameters &load,
                            const dealii::Point<2> &point,
                            const LinearElastic &material,
                            const PlaneAssumption plane)
    {
      auto stress = load.initial_stress(point[0], point[1], material.poisson);
      if (plane == PlaneAssumption::plane_stress)
        stress[3] = 0.;
      return stress;
    }

    CellStress<3> stress_of(const LoadParameters &load,
                            const dealii::Point<3> &point,
                            const LinearElastic &, PlaneAssumption)
    {
      return load.initial_stress(point);
    }

    /** Refuses an initial stress of the other dimension, or out of a plane that
        is free. */
    template <int dim>
    void check(const LoadParameters &load, PlaneAssumption plane);

    template <>
    void check<2>(const LoadParameters &load, const PlaneAssumption plane)
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
      if (plane != PlaneAssumption::plane_stress)
        return;
      if (load.stress_zz || load.stress_fields.size() == 4)
        throw InputError(
            where
            + "'Stress zz' is the stress out of the plane, which is "
              "zero with 'Plane assumption = plane stress'. Leave "
              "it at 'elastic'.");
      if (load.in_situ && load.in_situ->has_out_of_plane)
        throw InputError(
            where
            + "'Out-of-plane ratio' gives a stress out of the "
              "plane, which is zero with 'Plane assumption = plane "
              "stress'. Leave it at 'same'.");
    }

    template <>
    void check<3>(const LoadParameters &load, PlaneAssumption)
    {
      if (!load.in_situ && !load.space_stress && load.stress_fields.size() != 6)
        throw InputError("section 'Loads/" + load.name
                         + "': 'Stress' has three components, and the mesh has "
                           "three dimensions. Give xx, yy, zz, xy, xz, yz, and "
                           "leave 'Stress zz' at 'elastic'.");
    }

  } // namespace

  template <int dim>
  AlignedArray<double>
  InitialStress<dim>::packed(const NodeMap<dim> &nodes) const
  {
    AlignedArray<double> result;
    for (unsigned int c = 0; c < nodes.cells().n_deformable && !cells.empty();
         ++c)
      for (const double stress : cells[c])
        result.push_back(stress);
    return result;
  }

  template <int dim>
  InitialStress<dim> find_initial_stress(const NodeMap<dim> &nodes,
                                         const ModelParameters &parameters,
                                         const ModelProperties &properties,
                                         const std::vector<bool> &absent)
  {
    constexpr unsigned int n_components = dim * (dim + 1) / 2;
    InitialStress<dim> result;
    if (parameters.initial_stresses.empty())
      return result;
    result.cells.assign(nodes.cells().size(), {});
    result.faces.assign(nodes.faces().joints.size(), {});
    for (const LoadParameters &load : parameters.initial_stresses)
    {
      check<dim>(load, parameters.plane);
      const auto groups  = groups_of_names(nodes, load.groups, load.name);
      const auto acts_in = [&](const unsigned int group)
      {
        return !absent[group]
               && (groups.empty()
                   || std::find(groups.begin(), groups.end(), group)
                          != groups.end());
      };
      const auto stress_at
          = [&](const dealii::Point<dim> &point, const unsigned int group)
      {
        return stress_of(
            load, point,
            properties.materials[properties.material_of_group[group]].elastic,
            parameters.plane);
      };
      for (unsigned int c = 0; c < nodes.cells().size(); ++c)
      {
        const unsigned int group = nodes.cells().group[c];
        if (!acts_in(group))
          continue;
        dealii::Point<dim> centre;
        for (const unsigned int node : nodes.cells().nodes[c])
          for (unsigned int d = 0; d < dim; ++d)
            centre[d] += nodes.point(node)[d] / (dim + 1.);
        const auto stress = stress_at(centre, group);
        for (unsigned int k = 0; k < stress.size(); ++k)
          result.cells[c][k] += stress[k];
      }
      for (unsigned int f = 0; f < result.faces.size(); ++f)
      {
        const JointNodes<dim> &face = nodes.faces().joints[f];
        if (absent[face.groups[0]] || absent[face.groups[1]])
          continue;
        for (const unsigned int group : face.groups)
          if (acts_in(group))
            for (unsigned int k = 0; k < dim; ++k)
            {
              const auto stress = stress_at(nodes.point(face.lower[k]), group);
              for (unsigned int i = 0; i < n_components; ++i)
                result.faces[f][k][i] += 0.5 * stress[i];
            }
      }
      refuse_infinite<dim>(load.name, result.cells, result.faces,
                           nodes.communicator());
    }
    // The points' forces become those of a traction that is linear along the
    // face: (t_k + sum of all) / (dim + 1) instead of t_k. Simpson's rule on
    // quadratic edges gives them already.
    if (nodes.table().is_quadratic)
      return result;
    for (JointFaceStress<dim> &face : result.faces)
      for (unsigned int i = 0; i < n_components; ++i)
      {
        double sum = 0.;
        for (unsigned int k = 0; k < dim; ++k)
          sum += face[k][i];
        for (unsigned int k = 0; k < dim; ++k)
          face[k][i] = (face[k][i] + sum) / (dim + 1.);
      }
    return result;
  }

  template struct InitialStress<2>;
  template struct InitialStress<3>;
  template InitialStress<2> find_initial_stress(const NodeMap<2> &,
                                                const ModelParameters &,
                                                const ModelProperties &,
                                                const std::vector<bool> &);
  template InitialStress<3> find_initial_stress(const NodeMap<3> &,
                                                const ModelParameters &,
                                                const ModelProperties &,
                                                const std::vector<bool> &);
} // namespace quoin
