// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_core.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/operators/archive.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/absorbing/plane_waves.h>
#include <quoin/motions/prescribed_motion.h>
#include <quoin/absorbing/viscous_boundary.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Product of a symmetric matrix, as Dashpot::Damping, and a vector. */
    template <int dim>
    dealii::Tensor<1, dim> product(const typename Dashpot<dim>::Damping &matrix,
                                   const dealii::Tensor<1, dim> &v)
    {
      if constexpr (dim == 2)
      {
        const auto &[xx, yy, xy] = matrix;
        return dealii::Point<2>(xx * v[0] + xy * v[1], xy * v[0] + yy * v[1]);
      }
      else
      {
        const auto &[xx, yy, zz, xy, xz, yz] = matrix;
        return dealii::Point<3>(xx * v[0] + xy * v[1] + xz * v[2],
                                xy * v[0] + yy * v[1] + yz * v[2],
                                xz * v[0] + yz * v[1] + zz * v[2]);
      }
    }

    /** Solves with a symmetric positive definite matrix. */
    dealii::Tensor<1, 2> solve(const std::array<double, 3> &matrix,
                               const dealii::Tensor<1, 2> &b)
    {
      const auto &[xx, yy, xy] = matrix;
      const double determinant = xx * yy - xy * xy;
      return dealii::Point<2>((yy * b[0] - xy * b[1]) / determinant,
                              (xx * b[1] - xy * b[0]) / determinant);
    }

    dealii::Tensor<1, 3> solve(const std::array<double, 6> &matrix,
                               const dealii::Tensor<1, 3> &b)
    {
      const auto &[xx, yy, zz, xy, xz, yz] = matrix;
      Eigen::Matrix3d full;
      full << xx, xy, xz, xy, yy, yz, xz, yz, zz;
      const Eigen::Vector3d x
          = full.llt().solve(Eigen::Vector3d(b[0], b[1], b[2]));
      return dealii::Point<3>(x[0], x[1], x[2]);
    }
    /** Adds the dashpot of @p zn, @p zs [N s/m] across and along an area with
        the outward normal @p n. */
    template <int dim>
    void add_dashpot(const dealii::Tensor<1, dim> &n, const double zn,
                     const double zs, Dashpot<dim> &dashpot)
    {
      unsigned int k = dim;
      for (unsigned int d = 0; d < dim; ++d)
      {
        dashpot.damping[d] += zn * n[d] * n[d] + zs * (1. - n[d] * n[d]);
        for (unsigned int e = d + 1; e < dim; ++e)
          dashpot.damping[k++] += (zn - zs) * n[d] * n[e];
        dashpot.normal[d] -= 2. * zn * n[d];
      }
      if constexpr (dim == 2)
      {
        dashpot.shear[0] -= 2. * zs * n[1];
        dashpot.shear[1] += 2. * zs * n[0];
      }
      else
      {
        dashpot.shear[0] += 2. * zs;
        dashpot.lateral[1] += 2. * zs;
      }
    }

    /** Throws an InputError if a face is not horizontal. */
    void refuse_inclined(const std::vector<BoundaryFace<3>> &faces,
                         const std::string &load)
    {
      for (const BoundaryFace<3> &face : faces)
      {
        const auto outward = outward_area(face.points);
        if (std::hypot(outward[0], outward[1]) <= 1e-6 * outward.norm())
          continue;
        const auto &at = face.points[0];
        throw InputError(text_of(
            "section 'Loads/", load,
            "': 'Incident shear velocity' and 'Incident lateral velocity' are "
            "those of S waves that rise vertically, along x and y, but the "
            "boundary is not horizontal at (",
            at[0], ", ", at[1], ", ", at[2],
            ") m. Give them on a horizontal base, or a load with 'Type = "
            "traction' on the same boundary, half of which goes into the "
            "blocks."));
      }
    }
  } // namespace

  Impedance impedance_of(const LinearElastic &material,
                         const PlaneAssumption assumption)
  {
    const PlaneStiffness stiffness = plane_stiffness(material, assumption);
    return { std::sqrt(material.density * stiffness.c11),
             std::sqrt(material.density * stiffness.c33), material.density };
  }

  template <int dim>
  void Dashpot<dim>::add_drag(const dealii::Tensor<1, dim> &v,
                              dealii::Tensor<1, dim> &force) const
  {
    unsigned int k = dim;
    for (unsigned int d = 0; d < dim; ++d)
    {
      force[d] += damping[d] * v[d];
      for (unsigned int e = d + 1; e < dim; ++e, ++k)
      {
        force[d] += damping[k] * v[e];
        force[e] += damping[k] * v[d];
      }
    }
  }

  template <int dim>
  void Dashpot<dim>::add(const dealii::Tensor<1, dim> &outward,
                         const Impedance &z)
  {
    const double area = outward.norm();
    add_dashpot<dim>(outward / area, z.normal * area, z.shear * area, *this);
  }

  template <int dim>
  void add_dashpots(const NodeMap<dim> &node_map,
                    const std::vector<BoundaryFace<dim>> &faces,
                    const std::vector<Impedance> &impedance,
                    const Thickness &thickness,
                    const std::vector<unsigned int> &nodes,
                    std::vector<Dashpot<dim>> &dashpots)
  {
    for (const BoundaryFace<dim> &face : faces)
    {
      const dealii::Tensor<1, dim> outward = outward_area(face.points);
      const double share = outward.norm() * thickness[face.group] / dim;
      const auto n       = outward / outward.norm();
      const Impedance &z = impedance[face.group];
      for (const unsigned int v : face.nodes)
      {
        if (!node_map.exchange().owns(v))
          continue;
        const auto found = std::lower_bound(nodes.begin(), nodes.end(),
                                            node_map.exchange().local(v));
        if (found == nodes.end() || *found != node_map.exchange().local(v))
          continue;
        add_dashpot(n, z.normal * share, z.shear * share,
                    dashpots[found - nodes.begin()]);
      }
    }
  }

  template <int dim>
  dealii::Tensor<1, dim>
  velocity_with_dashpot(const StepContext &step, const double m,
                        const dealii::Tensor<1, dim> &velocity,
                        const typename Dashpot<dim>::Damping &damping,
                        const dealii::Tensor<1, dim> &force,
                        const std::array<bool, dim> &prescribed,
                        dealii::Tensor<1, dim> after)
  {
    const double h  = 0.5 * step.dt_velocity;
    const double a  = h * step.mass_damping * m;
    const auto drag = product<dim>(damping, velocity);
    auto b          = (m - a) * velocity - h * drag + 2. * h * force;
    auto matrix     = damping;
    for (unsigned int k = 0; k < matrix.size(); ++k)
      matrix[k] = h * damping[k] + (k < dim ? m + a : 0.);
    // Known velocities drag the free components and are no unknowns.
    unsigned int k = dim;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int e = d + 1; e < dim; ++e, ++k)
      {
        if (!prescribed[d] && !prescribed[e])
          continue;
        if (!prescribed[d])
          b[d] -= matrix[k] * after[e];
        if (!prescribed[e])
          b[e] -= matrix[k] * after[d];
        matrix[k] = 0.;
      }
    const auto solved = solve(matrix, b);
    for (unsigned int d = 0; d < dim; ++d)
      if (!prescribed[d])
        after[d] = solved[d];
    return after;
  }

  template <int dim>
  void move_with_dashpot(const StepContext &step,
                         const CapturedNode<dim> &before,
                         const typename Dashpot<dim>::Damping &damping,
                         const dealii::Tensor<1, dim> &pull,
                         const MotionConstraint<dim> *owner, State<dim> &state)
  {
    std::array<bool, dim> prescribed;
    for (unsigned int d = 0; d < dim; ++d)
      prescribed[d] = before.owner[d] != owner;
    dealii::Tensor<1, dim> &after = state.velocity[before.node];
    after = velocity_with_dashpot<dim>(step, before.mass, before.velocity,
                                       damping, before.force + pull, prescribed,
                                       after);
    for (unsigned int d = 0; d < dim; ++d)
      if (!prescribed[d])
        state.nodes[before.node].u[d]
            = before.displacement[d] + step.dt * after[d];
  }

  template <int dim>
  void account_for_dashpot(const StepContext &step,
                           const CapturedNode<dim> &before,
                           const typename Dashpot<dim>::Damping &damping,
                           const dealii::Tensor<1, dim> &pull,
                           const MotionConstraint<dim> *owner,
                           Resultant<dim> &resultant, State<dim> &state)
  {
    const dealii::Tensor<1, dim> &v0  = before.velocity;
    const dealii::Tensor<1, dim> &v1  = state.velocity[before.node];
    const dealii::Tensor<1, dim> mean = 0.5 * (v0 + v1);
    dealii::Tensor<1, dim> reaction;
    const auto drag = product<dim>(damping, mean);
    for (unsigned int d = 0; d < dim; ++d)
    {
      if (before.owner[d] != owner)
        continue;
      const double w0 = 0.5 * step.dt_before * v0[d];
      const double w1 = 0.5 * step.dt * v1[d];
      state.energy.external += pull[d] * w0;
      state.pending.external += pull[d] * w1;
      state.energy.viscous += drag[d] * w0;
      state.pending.viscous += drag[d] * w1;
      const double rayleigh = step.mass_damping * before.mass * mean[d];
      state.energy.damping += rayleigh * w0;
      state.pending.damping += rayleigh * w1;
      reaction[d] = pull[d] - drag[d];
    }
    add_force(reaction, place_before(before, state.nodes[before.node]),
              resultant);
  }

  template <int dim>
  ViscousBoundary<dim>::ViscousBoundary(const LoadParameters &parameters,
                                        const NodeMap<dim> &node_map,
                                        const std::vector<Impedance> &impedance,
                                        const Thickness &thickness)
    : components(parameters.components)
  {
    this->load_name = parameters.name;
    const auto faces
        = faces_of_curves(node_map, parameters.boundaries, this->load_name);
    if constexpr (dim == 3)
      if (!parameters.wave_direction
          && (components[1].quantity != LoadQuantity::free
              || components[2].quantity != LoadQuantity::free))
        refuse_inclined(faces, this->load_name);
    this->node_list = nodes_of_faces(node_map, faces);
    dashpots.resize(this->node_list.size());
    waves.resize(this->node_list.size());
    add_dashpots(node_map, faces, impedance, thickness, this->node_list,
                 dashpots);
    take_over({});
    if constexpr (dim == 3)
      if (parameters.wave_direction)
        plane_waves = std::make_unique<const PlaneWaveForces>(
            parameters, node_map, faces, impedance, this->node_list);
  }

  template <int dim>
  ViscousBoundary<dim>::~ViscousBoundary() = default;

  template <int dim>
  ViscousBoundary<dim> &ViscousBoundary<dim>::operator=(ViscousBoundary &&)
      = default;

  template <int dim>
  void ViscousBoundary<dim>::prepare(State<dim> &state) const
  {
    state.template add<ViscousBoundaryState<dim>>(this->load_name);
  }

  template <int dim>
  void ViscousBoundary<dim>::begin_stage(State<dim> &state,
                                         const bool continues)
  {
    // Before the first stage there are no reactions to hold.
    if (!continues)
      state.template get<ViscousBoundaryState<dim>>(this->load_name)
          = { state.step == 0, {} };
  }

  template <int dim>
  void ViscousBoundary<dim>::take_over(
      const std::vector<const ViscousBoundary *> &others)
  {
    shared.clear();
    damping.clear();
    for (const Dashpot<dim> &dashpot : dashpots)
      damping.push_back(dashpot.damping);
    const auto &own = this->node_list;
    for (const ViscousBoundary *other : others)
      for (unsigned int i = 0; i < other->node_list.size(); ++i)
      {
        const auto found
            = std::lower_bound(own.begin(), own.end(), other->node_list[i]);
        if (found == own.end() || *found != other->node_list[i])
          continue;
        const auto at = static_cast<unsigned int>(found - own.begin());
        shared.push_back({ at, i, other });
        for (unsigned int k = 0; k < damping[at].size(); ++k)
          damping[at][k] += other->dashpots[i].damping[k];
      }
  }

  template <int dim>
  void
  ViscousBoundary<dim>::hold(const std::vector<CapturedNode<dim>> &captured,
                             ViscousBoundaryState<dim> &own) const
  {
    own.active = true;
    for (const unsigned int c : this->captured_positions)
      for (unsigned int d = 0; d < dim; ++d)
        own.held.push_back(captured[c].begun[d] - captured[c].force[d]);
  }

  template <int dim>
  void ViscousBoundary<dim>::find_pulls(const TimePoint &time,
                                        const ViscousBoundaryState<dim> &own)
  {
    if constexpr (dim == 3)
      if (plane_waves)
        plane_waves->find(components, time, waves);
    if (!plane_waves)
    {
      const auto incident = component_values(components, time);
      for (unsigned int i = 0; i < dashpots.size(); ++i)
        waves[i] = dashpots[i].pull(incident);
    }
    pull = waves;
    for (const SharedNode &node : shared)
      pull[node.here] += node.other->waves[node.there];
    if (!own.held.empty())
      for (unsigned int i = 0; i < dashpots.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          pull[i][d] += own.held[dim * i + d];
  }

  template <int dim>
  void
  ViscousBoundary<dim>::correct(const StepContext &step,
                                const std::vector<CapturedNode<dim>> &captured,
                                State<dim> &state)
  {
    ViscousBoundaryState<dim> &own
        = state.template get<ViscousBoundaryState<dim>>(this->load_name);
    if (!own.active)
      hold(captured, own);
    find_pulls(step.begin, own);
    for (unsigned int i = 0; i < dashpots.size(); ++i)
      move_with_dashpot(step, captured[this->captured_positions[i]], damping[i],
                        pull[i], this, state);
  }

  template <int dim>
  void
  ViscousBoundary<dim>::account(const StepContext &step,
                                const std::vector<CapturedNode<dim>> &captured,
                                State<dim> &state)
  {
    this->last_resultant = {};
    for (unsigned int i = 0; i < dashpots.size(); ++i)
      account_for_dashpot(step, captured[this->captured_positions[i]],
                          damping[i], pull[i], this, this->last_resultant,
                          state);
  }

  template struct Dashpot<2>;
  template class ViscousBoundary<2>;
  template void add_dashpots(const NodeMap<2> &,
                             const std::vector<BoundaryFace<2>> &,
                             const std::vector<Impedance> &, const Thickness &,
                             const std::vector<unsigned int> &,
                             std::vector<Dashpot<2>> &);
  template dealii::Tensor<1, 2> velocity_with_dashpot<2>(
      const StepContext &, double, const dealii::Tensor<1, 2> &,
      const Dashpot<2>::Damping &, const dealii::Tensor<1, 2> &,
      const std::array<bool, 2> &, dealii::Tensor<1, 2>);
  template void move_with_dashpot(const StepContext &, const CapturedNode<2> &,
                                  const Dashpot<2>::Damping &,
                                  const dealii::Tensor<1, 2> &,
                                  const MotionConstraint<2> *, State<2> &);
  template void
  account_for_dashpot(const StepContext &, const CapturedNode<2> &,
                      const Dashpot<2>::Damping &, const dealii::Tensor<1, 2> &,
                      const MotionConstraint<2> *, Resultant<2> &, State<2> &);
  template struct Dashpot<3>;
  template class ViscousBoundary<3>;
  template void add_dashpots(const NodeMap<3> &,
                             const std::vector<BoundaryFace<3>> &,
                             const std::vector<Impedance> &, const Thickness &,
                             const std::vector<unsigned int> &,
                             std::vector<Dashpot<3>> &);
  template dealii::Tensor<1, 3> velocity_with_dashpot<3>(
      const StepContext &, double, const dealii::Tensor<1, 3> &,
      const Dashpot<3>::Damping &, const dealii::Tensor<1, 3> &,
      const std::array<bool, 3> &, dealii::Tensor<1, 3>);
  template void move_with_dashpot(const StepContext &, const CapturedNode<3> &,
                                  const Dashpot<3>::Damping &,
                                  const dealii::Tensor<1, 3> &,
                                  const MotionConstraint<3> *, State<3> &);
  template void
  account_for_dashpot(const StepContext &, const CapturedNode<3> &,
                      const Dashpot<3>::Damping &, const dealii::Tensor<1, 3> &,
                      const MotionConstraint<3> *, Resultant<3> &, State<3> &);
} // namespace quoin
