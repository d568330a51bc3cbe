// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/packed_vectors.h>
#include <quoin/absorbing/free_field_column.h>

#include <algorithm>

namespace quoin
{
  void fail_free_field(const std::string &load, const std::string &setting,
                       const std::string &why)
  {
    throw InputError("section 'Loads/" + load + "': '" + setting + "' " + why);
  }

  void check_free_field_ground(const std::string &load,
                               const FreeFieldGround &ground,
                               const unsigned int group,
                               const std::string &place)
  {
    if (ground.is_rigid[group])
      fail_free_field(load, "Boundary",
                      "meets a rigid block at " + place
                          + ", in which no waves run: make it deformable.");
    if (ground.yields[group])
      fail_free_field(load, "Boundary",
                      "meets ground of the law 'Mohr-Coulomb' at " + place
                          + ", but the column beside it is elastic: give "
                            "the ground along the sides a material of its "
                            "own with 'Law = linear elastic'.");
  }

  template <int dim>
  double FreeFieldFoot<dim>::velocity(const unsigned int d,
                                      const StepContext &step) const
  {
    const LoadComponent &given = components[d];
    return given.quantity == LoadQuantity::velocity
               ? given.value(step.middle)
               : (given.value(step.end) - given.value(step.begin)) / step.dt;
  }

  template <int dim>
  double FreeFieldFoot<dim>::incident(const unsigned int d,
                                      const StepContext &step) const
  {
    // At the foot normal is along the last axis.
    return is_prescribed
               ? 0.
               : components[d + 1 == dim ? 0 : d + 1].value(step.begin);
  }

  template <int dim>
  void FreeFieldColumn<dim>::add_layer(const Layer &layer, const double top)
  {
    const double half = 0.5 * layer.density * layer.height * layer.thickness;
    node_mass.back() += half;
    node_mass.push_back(half);
    node_height.push_back(top);
    layers.push_back(layer);
    lateral.resize(layers.size());
    stress.resize(layers.size());
  }

  template <int dim>
  void FreeFieldColumn<dim>::set_base(const dealii::Tensor<1, dim> &impedance)
  {
    base_impedance = impedance;
  }

  template <int dim>
  unsigned int FreeFieldColumn<dim>::node_at(const double height) const
  {
    // The nearer of the nodes below and above.
    const unsigned int above
        = std::lower_bound(node_height.begin(), node_height.end() - 1, height)
          - node_height.begin();
    return above > 0
                   && height - node_height[above - 1]
                          < node_height[above] - height
               ? above - 1
               : above;
  }

  template <int dim>
  double FreeFieldColumn<dim>::largest_eigenvalue() const
  {
    double largest = 0.;
    for (const Layer &layer : layers)
      largest = std::max(largest,
                         4. * layer.stiffness.c11
                             / (layer.density * layer.height * layer.height));
    return largest;
  }

  template <int dim>
  void FreeFieldColumn<dim>::move_foot(const StepContext &step,
                                       const FreeFieldFoot<dim> &foot,
                                       double *const velocity) const
  {
    const double h = 0.5 * step.dt_velocity, m = node_mass.front();
    for (unsigned int d = 0; d < dim; ++d)
    {
      double &v = velocity[d];
      if (foot.prescribes(d))
      {
        v = foot.velocity(d, step);
        continue;
      }
      const double z        = foot.is_prescribed ? 0. : base_impedance[d];
      const double incident = foot.incident(d, step);
      const double drag     = h * (z + step.mass_damping * m);
      v = ((m - drag) * v + 2. * h * (force[d] + 2. * z * incident))
          / (m + drag);
    }
  }

  template <int dim>
  void FreeFieldColumn<dim>::advance(const StepContext &step,
                                     const FreeFieldFoot<dim> &foot,
                                     double *const u, double *const v)
  {
    const unsigned int n = dim * n_nodes();
    force.assign(n, 0.);
    for (unsigned int e = 0; e < layers.size(); ++e)
    {
      const Layer &layer = layers[e];
      // Shear and, last, vertical strain.
      const dealii::Tensor<1, dim> strain
          = (vector_at<dim>(u, e + 1) - vector_at<dim>(u, e)
             + step.stiffness_damping
                   * (vector_at<dim>(v, e + 1) - vector_at<dim>(v, e)))
            / layer.height;
      stress[e]          = layer.stiffness.c33 * strain;
      stress[e][dim - 1] = layer.stiffness.c11 * strain[dim - 1];
      lateral[e]         = layer.stiffness.c12 * strain[dim - 1];
      add_to_vector<dim>(force, e, layer.thickness * stress[e]);
      add_to_vector<dim>(force, e + 1, -layer.thickness * stress[e]);
    }

    mean_velocity.assign(v, v + n);
    const double a = 0.5 * step.dt_velocity * step.mass_damping;
    for (unsigned int i = dim; i < n; ++i)
      v[i]
          = ((1. - a) * v[i] + step.dt_velocity * force[i] / node_mass[i / dim])
            / (1. + a);
    move_foot(step, foot, v);
    for (unsigned int i = 0; i < n; ++i)
    {
      mean_velocity[i] = 0.5 * (mean_velocity[i] + v[i]);
      u[i] += step.dt * v[i];
    }
  }

  template <int dim>
  dealii::Tensor<1, dim>
  FreeFieldColumn<dim>::velocity(const unsigned int node) const
  {
    return vector_at<dim>(mean_velocity, node);
  }

  template <int dim>
  void FreeFieldColumn<dim>::add_force(const unsigned int e,
                                       const dealii::Tensor<1, dim> &area,
                                       dealii::Tensor<1, dim> &total) const
  {
    for (unsigned int d = 0; d + 1 < dim; ++d)
    {
      total[d] += area[d] * lateral[e];
      total[dim - 1] += area[d] * stress[e][d];
    }
  }

  template struct FreeFieldFoot<2>;
  template struct FreeFieldFoot<3>;
  template class FreeFieldColumn<2>;
  template class FreeFieldColumn<3>;
} // namespace quoin
