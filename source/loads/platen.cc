// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/plane_geometry.h>
#include <quoin/base/packed_vectors.h>
#include <quoin/operators/archive.h>
#include <quoin/base/constants.h>
#include <quoin/base/local_damping.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/loads/platen.h>
#include <quoin/loads/prescribed_motion.h>

#include <algorithm>
#include <cmath>

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

  Platen::Platen(const LoadParameters &parameters, const NodeMap<2> &node_map)
    : components(parameters.components), communicator(node_map.communicator())
  {
    load_name                 = parameters.name;
    own_traits.kind           = MotionKind::rigid_body;
    own_traits.holds          = { { driven(0), driven(1), driven(2) } };
    own_traits.holds_rotation = driven(2);
    node_list                 = platen_nodes(parameters, node_map);
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
    PlatenState &platen = state.get<PlatenState>(load_name);
    double mass         = 0.;
    dealii::Tensor<1, 2> of_position, momentum;
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      const NodeRecord<2> &node     = state.nodes[node_list[i]];
      const dealii::Tensor<1, 2> &v = state.velocity[node_list[i]];
      mass += node_mass[i];
      of_position += node_mass[i] * node.position();
      momentum += node_mass[i] * v;
    }
    namespace MPI = dealii::Utilities::MPI;
    mass          = MPI::sum(mass, communicator);
    of_position   = MPI::sum(of_position, communicator);
    momentum      = MPI::sum(momentum, communicator);

    const bool is_new = !continues || !platen.active;
    if (is_new)
    {
      platen        = PlatenState();
      platen.active = true;
      set_vector(platen.velocity, 0, momentum / mass);
    }
    std::copy(platen.displacement, platen.displacement + 3, platen.stage_start);

    // Centre and arms follow from the masses of this stage.
    const double c                    = std::cos(platen.displacement[2]),
                 s                    = std::sin(platen.displacement[2]);
    const dealii::Tensor<1, 2> centre = of_position / mass;
    platen.arms.clear();
    double spin   = rigid_spin;
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
    spin = sum<1>({ spin }, communicator)[0];
    resume_stage(state);
    if (is_new)
      platen.velocity[2] = spin / inertia[2];
  }

  void Platen::resume_stage(const State<2> &state)
  {
    const auto &arms = state.get<PlatenState>(load_name).arms;
    inertia          = { 0., 0., rigid_inertia };
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      inertia[0] += node_mass[i];
      inertia[2]
          += node_mass[i]
             * (arms[2 * i] * arms[2 * i] + arms[2 * i + 1] * arms[2 * i + 1]);
    }
    inertia    = sum(inertia, communicator);
    inertia[1] = inertia[0];
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

  void Platen::integrate_degree_of_freedom(const unsigned int d,
                                           const StepContext &step,
                                           PlatenState &platen)
  {
    const double unit   = d == 2 ? constants::degree : 1.;
    const double before = platen.velocity[d];
    velocity_before[d]  = before;
    damping[d]          = 0.;
    if (components[d].quantity == LoadQuantity::velocity)
      platen.velocity[d]
          = unit * step.load_rate * components[d].value(step.middle);
    else if (components[d].quantity == LoadQuantity::displacement)
      platen.velocity[d]
          = (platen.stage_start[d] + unit * components[d].value(step.end)
             - platen.displacement[d])
            / step.dt;
    else
    {
      drive[d]           = components[d].value(step.begin);
      const double total = nodal_force[d] + drive[d];
      const double a     = 0.5 * step.dt_velocity * step.mass_damping;
      const double gain  = step.dt_velocity / (1. + a) / inertia[d];
      const double free  = (1. - a) / (1. + a) * before + gain * total;
      const double local = -local_damping_velocity(
          step.local_damping * gain * std::abs(total), before, free);
      platen.velocity[d] = free + local;
      damping[d]         = local / gain
                   - step.mass_damping * inertia[d] * 0.5
                         * (before + platen.velocity[d]);
      // A moment counts as a force at the radius of gyration.
      last_unbalanced += std::abs(total)
                         / (d == 2 ? std::sqrt(inertia[2] / inertia[0]) : 1.);
    }
    if (driven(d))
      drive[d] = inertia[d] * (platen.velocity[d] - before) / step.dt_velocity
                 - nodal_force[d];
    platen.displacement[d] += step.dt * platen.velocity[d];
  }

  void Platen::correct(const StepContext &step,
                       const std::vector<CapturedNode<2>> &captured,
                       State<2> &state)
  {
    PlatenState &platen = state.get<PlatenState>(load_name);
    nodal_force         = resultant(captured, platen);
    const double c0     = std::cos(platen.displacement[2]),
                 s0     = std::sin(platen.displacement[2]);
    last_unbalanced     = 0.;
    for (unsigned int d = 0; d < 3; ++d)
      integrate_degree_of_freedom(d, step, platen);
    last_resultant = drive;

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
                       const std::vector<CapturedNode<2>> &, State<2> &state)
  {
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
