// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/plane_geometry.h>
#include <quoin/base/packed_vectors.h>
#include <quoin/operators/archive.h>
#include <quoin/base/constants.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/motions/platen.h>
#include <quoin/motions/platen_bearing.h>
#include <quoin/motions/prescribed_motion.h>

#include <algorithm>
#include <cmath>

#include "body_step.h"

namespace quoin
{
  namespace
  {
    template <int dim>
    std::vector<unsigned int>
    nodes_of_groups(const NodeMap<dim> &node_map,
                    const std::vector<unsigned int> &groups)
    {
      // Another rank may have the cells of an owned node.
      std::vector<dealii::Tensor<1, dim>> is_in(node_map.n_local());
      for (unsigned int c = 0; c < node_map.cells().size(); ++c)
        if (std::find(groups.begin(), groups.end(), node_map.cells().group[c])
            != groups.end())
          for (const unsigned int node : node_map.cells().nodes[c])
            is_in[node][0] = 1.;
      node_map.exchange().add_to_owners(is_in.data());
      std::vector<unsigned int> nodes;
      for (unsigned int i = 0; i < node_map.n_owned(); ++i)
        if (is_in[i][0] > 0.)
          nodes.push_back(i);
      return nodes;
    }

    /** The matrix of inertia of the motion x, y of a centre and of the rotation
        about it: @p inertia about the centre [kg m^2], @p arm of the centre of
        mass from it [m]. */
    Eigen::Matrix3d inertia_matrix(const double mass, const double inertia,
                                   const dealii::Tensor<1, 2> &arm)
    {
      Eigen::Matrix3d result;
      result << mass, 0., -mass * arm[1], 0., mass, mass * arm[0],
          -mass * arm[1], mass * arm[0], inertia;
      return result;
    }

    template <std::size_t N>
    std::array<double, N> sum(std::array<double, N> values,
                              const MPI_Comm communicator)
    {
      MPI_Allreduce(MPI_IN_PLACE, values.data(), N, MPI_DOUBLE, MPI_SUM,
                    communicator);
      return values;
    }
  } // namespace

  template <int dim>
  std::vector<unsigned int> platen_nodes(const LoadParameters &parameters,
                                         const NodeMap<dim> &node_map)
  {
    return parameters.groups.empty()
               ? nodes_of_faces(node_map,
                                faces_of_curves(node_map, parameters.boundaries,
                                                parameters.name))
               : nodes_of_groups(node_map,
                                 groups_of_names(node_map, parameters.groups,
                                                 parameters.name));
  }
  template std::vector<unsigned int> platen_nodes(const LoadParameters &,
                                                  const NodeMap<2> &);
  template std::vector<unsigned int> platen_nodes(const LoadParameters &,
                                                  const NodeMap<3> &);

  template <int dim>
  std::vector<double> platen_areas(const LoadParameters &parameters,
                                   const NodeMap<dim> &node_map,
                                   const std::vector<unsigned int> &nodes,
                                   const Thickness &thickness)
  {
    if (!parameters.groups.empty())
      return {};
    std::vector<double> areas(node_map.n_owned(), 0.), result;
    for (const BoundaryFace<dim> &face :
         faces_of_curves(node_map, parameters.boundaries, parameters.name))
      for (unsigned int k = 0; k < dim; ++k)
        if (node_map.exchange().owns(face.nodes[k]))
          areas[node_map.exchange().local(face.nodes[k])]
              += face.shares[k] * outward_area(face.points).norm()
                 * thickness[face.group];
    for (const unsigned int node : nodes)
      result.push_back(areas[node]);
    return result;
  }
  template std::vector<double> platen_areas(const LoadParameters &,
                                            const NodeMap<2> &,
                                            const std::vector<unsigned int> &,
                                            const Thickness &);
  template std::vector<double> platen_areas(const LoadParameters &,
                                            const NodeMap<3> &,
                                            const std::vector<unsigned int> &,
                                            const Thickness &);

  Platen::Platen(const LoadParameters &parameters, const NodeMap<2> &node_map,
                 const Thickness &thickness)
    : components(parameters.components), communicator(node_map.communicator())
  {
    load_name                 = parameters.name;
    own_traits.kind           = MotionKind::rigid_body;
    own_traits.holds          = { { driven(0), driven(1), driven(2) } };
    own_traits.holds_rotation = driven(2);
    node_list                 = platen_nodes(parameters, node_map);
    node_area    = platen_areas(parameters, node_map, node_list, thickness);
    is_bearing   = bears_boundary(parameters);
    mesh_normals = platen_normals(parameters, node_map, node_list, thickness);
    own_forces.resize(mesh_normals.size());
  }

  void Platen::set_mass(const std::vector<double> &mass,
                        const double extra_inertia, const double extra_spin)
  {
    rigid_inertia = extra_inertia;
    rigid_spin    = extra_spin;
    node_mass.clear();
    for (const unsigned int node : node_list)
      node_mass.push_back(mass[node]);
  }

  void Platen::prepare(State<2> &state) const
  {
    state.add<PlatenState>(load_name);
  }

  void Platen::rest(State<2> &state)
  {
    MotionConstraint<2>::rest(state);
    state.get<PlatenState>(load_name).active = false;
  }

  void Platen::begin_stage(State<2> &state, const bool continues)
  {
    namespace MPI       = dealii::Utilities::MPI;
    PlatenState &platen = state.get<PlatenState>(load_name);
    double total        = 0.;
    dealii::Tensor<1, 2> of_position, momentum;
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      const double weight = node_area.empty() ? node_mass[i] : node_area[i];
      total += weight;
      of_position += weight * state.nodes[node_list[i]].position();
      momentum += node_mass[i] * state.velocity[node_list[i]];
    }
    total = MPI::sum(total, communicator);
    const dealii::Tensor<1, 2> centre
        = MPI::sum(of_position, communicator) / total;
    momentum = MPI::sum(momentum, communicator);

    const bool is_new = !continues || !platen.active;
    if (is_new)
    {
      platen        = PlatenState();
      platen.active = true;
    }
    std::copy(platen.displacement, platen.displacement + 3, platen.stage_start);

    // Centre and arms follow from the masses of this stage.
    const double c = std::cos(platen.displacement[2]),
                 s = std::sin(platen.displacement[2]);
    platen.arms.clear();
    double spin   = 0.;
    platen.centre = centre - vector_at(platen.displacement, 0);
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      const NodeRecord<2> &node      = state.nodes[node_list[i]];
      const dealii::Tensor<1, 2> &v  = state.velocity[node_list[i]];
      const dealii::Tensor<1, 2> arm = node.position() - centre;
      platen.arms.push_back(c * arm[0] + s * arm[1]);
      platen.arms.push_back(c * arm[1] - s * arm[0]);
      spin += node_mass[i] * cross(arm, v);
    }
    spin = sum<1>({ spin + rigid_spin }, communicator)[0];
    resume_stage(state);
    if (!is_new)
      return;
    const Eigen::Vector3d velocity
        = inertia_matrix(mass, inertia, offset)
              .partialPivLu()
              .solve(Eigen::Vector3d(momentum[0], momentum[1], spin));
    std::copy_n(velocity.data(), 3, platen.velocity);
  }

  void Platen::resume_stage(const State<2> &state)
  {
    const auto &arms = state.get<PlatenState>(load_name).arms;
    std::array<double, 4> sums{ { 0., rigid_inertia, 0., 0. } };
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      const double x = arms[2 * i], y = arms[2 * i + 1];
      sums[0] += node_mass[i];
      sums[1] += node_mass[i] * (x * x + y * y);
      // The centre of a group is that of its mass, to rounding. A rank without
      // nodes has no areas either, whatever the platen is of.
      if (node_area.empty())
        continue;
      sums[2] += node_mass[i] * x;
      sums[3] += node_mass[i] * y;
    }
    sums    = sum(sums, communicator);
    mass    = sums[0];
    inertia = sums[1];
    offset  = dealii::Tensor<1, 2>({ sums[2] / mass, sums[3] / mass });
  }

  std::vector<dealii::Tensor<1, 2>> Platen::normals(const State<2> &state) const
  {
    const double angle = state.get<PlatenState>(load_name).displacement[2];
    const double c = std::cos(angle), s = std::sin(angle);
    std::vector<dealii::Tensor<1, 2>> result;
    for (const dealii::Tensor<1, 2> &n : mesh_normals)
      result.push_back(
          dealii::Tensor<1, 2>({ c * n[0] - s * n[1], s * n[0] + c * n[1] }));
    return result;
  }

  std::array<double, 3>
  Platen::resultant(const std::vector<CapturedNode<2>> &captured,
                    const PlatenState &platen) const
  {
    const double *const arms = platen.arms.data();
    std::array<double, 3> force{};
    const double c = std::cos(platen.displacement[2]),
                 s = std::sin(platen.displacement[2]);
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      const dealii::Tensor<1, 2> &f = captured[captured_positions[i]].force;
      const double rx               = c * arms[2 * i] - s * arms[2 * i + 1];
      const double ry               = s * arms[2 * i] + c * arms[2 * i + 1];
      force[0] += f[0];
      force[1] += f[1];
      force[2] += rx * f[1] - ry * f[0];
    }
    return sum(force, communicator);
  }

  double Platen::driven_velocity(const unsigned int d, const StepContext &step,
                                 const PlatenState &platen) const
  {
    const double unit = d == 2 ? constants::degree : 1.;
    if (components[d].quantity == LoadQuantity::velocity)
      return unit * step.load_rate * components[d].value(step.middle);
    return (platen.stage_start[d] + unit * components[d].value(step.end)
            - platen.displacement[d])
           / step.dt;
  }

  void Platen::correct(const StepContext &step,
                       const std::vector<CapturedNode<2>> &captured,
                       State<2> &state)
  {
    PlatenState &platen = state.get<PlatenState>(load_name);
    const double c0     = std::cos(platen.displacement[2]),
                 s0     = std::sin(platen.displacement[2]);
    const dealii::Tensor<1, 2> mass_arm(
        { c0 * offset[0] - s0 * offset[1], s0 * offset[0] + c0 * offset[1] });
    const double share = force_share(step.begin.stage);
    BodyStep<3, 2> body;
    for (unsigned int d = 0; d < 3; ++d)
    {
      body.driven[d]     = driven(d);
      body.given[d]      = driven(d) ? driven_velocity(d, step, platen)
                                     : components[d].value(step.begin) * share;
      velocity_before[d] = platen.velocity[d];
    }
    const std::array<double, 3> nodal = resultant(captured, platen);
    const Eigen::Matrix3d matrix      = inertia_matrix(mass, inertia, mass_arm);
    // The force that keeps the centre of mass turning about the centre, at the
    // mean of the rates before and after the step.
    double rate                     = velocity_before[2];
    const unsigned int n_iterations = mass_arm.norm_square() > 0. ? 2 : 1;
    for (unsigned int iteration = 0; iteration < n_iterations; ++iteration)
    {
      std::copy(velocity_before.begin(), velocity_before.end(),
                platen.velocity);
      const double pull = mass * rate * rate;
      body.advance(matrix,
                   { nodal[0] + pull * mass_arm[0],
                     nodal[1] + pull * mass_arm[1], nodal[2] },
                   step, platen.velocity);
      rate = 0.5 * (velocity_before[2] + platen.velocity[2]);
    }
    drive           = body.drive;
    damping         = body.damping;
    last_resultant  = drive;
    last_unbalanced = body.unbalanced;
    for (unsigned int d = 0; d < 3; ++d)
      platen.displacement[d] += step.dt * platen.velocity[d];

    const double *const arms = platen.arms.data();
    const double c           = std::cos(platen.displacement[2]),
                 s           = std::sin(platen.displacement[2]);
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      const CapturedNode<2> &before = captured[captured_positions[i]];
      NodeRecord<2> &node           = state.nodes[before.node];
      const dealii::Point<2> arm(c * arms[2 * i] - s * arms[2 * i + 1],
                                 s * arms[2 * i] + c * arms[2 * i + 1]);
      const dealii::Point<2> arm_before(c0 * arms[2 * i] - s0 * arms[2 * i + 1],
                                        s0 * arms[2 * i]
                                            + c0 * arms[2 * i + 1]);
      // Velocity by the mean arm: differences of positions lose digits.
      const dealii::Tensor<1, 2> mean = 0.5 * (arm + arm_before);
      dealii::Tensor<1, 2> &velocity  = state.velocity[before.node];
      velocity[0] = platen.velocity[0] - platen.velocity[2] * mean[1];
      velocity[1] = platen.velocity[1] + platen.velocity[2] * mean[0];
      node.u = platen.centre + vector_at(platen.displacement, 0) + arm - node.X;
    }
  }

  void Platen::account(const StepContext &step,
                       const std::vector<CapturedNode<2>> &captured,
                       State<2> &state)
  {
    own_forces.clear();
    for (unsigned int i = 0; i < mesh_normals.size(); ++i)
    {
      const CapturedNode<2> &before = captured[captured_positions[i]];
      own_forces.push_back(before.mass / step.dt_velocity
                               * (state.velocity[before.node] - before.velocity)
                           - before.force);
    }
    // All ranks have the platen; the first one books its work.
    if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    const PlatenState &platen = state.get<PlatenState>(load_name);
    for (unsigned int d = 0; d < 3; ++d)
    {
      const double w0 = 0.5 * step.dt_before * velocity_before[d];
      const double w1 = 0.5 * step.dt * platen.velocity[d];
      state.energy.external += drive[d] * w0;
      state.pending.external += drive[d] * w1;
      state.energy.damping -= damping[d] * w0;
      state.pending.damping -= damping[d] * w1;
    }
  }

} // namespace quoin
