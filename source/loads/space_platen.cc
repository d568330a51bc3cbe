// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/local_damping.h>
#include <quoin/loads/space_platen.h>
#include <quoin/operators/archive.h>

#include <deal.II/physics/transformations.h>

#include <boost/serialization/array.hpp>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    using Vector = dealii::Tensor<1, 3>;
    using Matrix = dealii::Tensor<2, 3>;

    Vector half_of(const std::array<double, 6> &values,
                   const unsigned int first)
    {
      return Vector({ values[first], values[first + 1], values[first + 2] });
    }

    Vector arm_at(const std::vector<double> &arms, const unsigned int i)
    {
      return Vector({ arms[3 * i], arms[3 * i + 1], arms[3 * i + 2] });
    }

    /** What @p mass at @p arm adds to a tensor of inertia. */
    Matrix inertia_of(const double mass, const Vector &arm)
    {
      Matrix result = -mass * outer_product(arm, arm);
      for (unsigned int d = 0; d < 3; ++d)
        result[d][d] += mass * arm.norm_square();
      return result;
    }
  } // namespace

  dealii::Tensor<2, 3> rotation_of(const SpacePlatenState &platen)
  {
    Matrix result;
    for (unsigned int d = 0; d < 3; ++d)
      for (unsigned int e = 0; e < 3; ++e)
        result[d][e] = platen.rotation[3 * d + e];
    return result;
  }

  void set_rotation(const dealii::Tensor<2, 3> &rotation,
                    SpacePlatenState &platen)
  {
    for (unsigned int d = 0; d < 3; ++d)
      for (unsigned int e = 0; e < 3; ++e)
        platen.rotation[3 * d + e] = rotation[d][e];
  }

  dealii::Tensor<2, 3> rotation_by(const dealii::Tensor<1, 3> &turn)
  {
    const double angle = turn.norm();
    if (angle == 0.)
      return dealii::unit_symmetric_tensor<3>();
    return dealii::Physics::Transformations::Rotations::rotation_matrix_3d(
        turn / angle, angle);
  }

  dealii::Tensor<1, 3> turn_of(const dealii::Tensor<2, 3> &rotation)
  {
    const Vector axis = 0.5
                        * Vector({ rotation[2][1] - rotation[1][2],
                                   rotation[0][2] - rotation[2][0],
                                   rotation[1][0] - rotation[0][1] });
    const double sine = axis.norm();
    return sine == 0.
               ? axis
               : std::atan2(sine, 0.5 * (trace(rotation) - 1.)) / sine * axis;
  }

  SpacePlaten::SpacePlaten(const LoadParameters &parameters,
                           const NodeMap<3> &node_map)
    : components(parameters.components), turns(parameters.rotations),
      communicator(node_map.communicator())
  {
    load_name                 = parameters.name;
    own_traits.kind           = MotionKind::rigid_body;
    own_traits.holds          = { { driven(0), driven(1), driven(2) } };
    own_traits.holds_rotation = driven(3) && driven(4) && driven(5);
    node_list                 = platen_nodes(parameters, node_map);
  }

  bool SpacePlaten::driven(const unsigned int d) const
  {
    return component(d).quantity == LoadQuantity::velocity
           || component(d).quantity == LoadQuantity::displacement;
  }

  void SpacePlaten::set_mass(const std::vector<double> &masses, double, double)
  {
    node_mass.clear();
    for (const unsigned int node : node_list)
      node_mass.push_back(masses[node]);
  }

  void SpacePlaten::prepare(State<3> &state) const
  {
    state.add<SpacePlatenState>(load_name);
  }

  void SpacePlaten::rest(State<3> &state)
  {
    MotionConstraint<3>::rest(state);
    drive                                         = {};
    state.get<SpacePlatenState>(load_name).active = false;
  }

  void SpacePlaten::begin_stage(State<3> &state, const bool continues)
  {
    namespace MPI            = dealii::Utilities::MPI;
    SpacePlatenState &platen = state.get<SpacePlatenState>(load_name);
    double total             = 0.;
    Vector of_position, momentum;
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      total += node_mass[i];
      of_position
          += node_mass[i] * Vector(state.nodes[node_list[i]].position());
      momentum += node_mass[i] * state.velocity[node_list[i]];
    }
    total               = MPI::sum(total, communicator);
    const Vector centre = MPI::sum(of_position, communicator) / total;
    momentum            = MPI::sum(momentum, communicator);

    const bool is_new = !continues || !platen.active;
    if (is_new)
    {
      platen        = SpacePlatenState();
      platen.active = true;
    }
    platen.stage_start = platen.displacement;

    // Centre and arms follow from the masses of this stage.
    const Matrix back = transpose(rotation_of(platen));
    platen.centre     = centre - half_of(platen.displacement, 0);
    platen.arms.clear();
    Vector spin;
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      const Vector arm  = state.nodes[node_list[i]].position() - centre;
      const Vector then = back * arm;
      platen.arms.insert(platen.arms.end(), then.begin_raw(), then.end_raw());
      spin
          += node_mass[i] * cross_product_3d(arm, state.velocity[node_list[i]]);
    }
    spin = MPI::sum(spin, communicator);
    resume_stage(state);
    if (!is_new)
      return;
    const Vector rate = invert(inertia) * spin;
    for (unsigned int d = 0; d < 3; ++d)
    {
      platen.velocity[d]     = momentum[d] / mass;
      platen.velocity[3 + d] = rate[d];
    }
  }

  void SpacePlaten::resume_stage(const State<3> &state)
  {
    const auto &arms = state.get<SpacePlatenState>(load_name).arms;
    mass             = 0.;
    inertia          = Matrix();
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      mass += node_mass[i];
      inertia += inertia_of(node_mass[i], arm_at(arms, i));
    }
    mass    = dealii::Utilities::MPI::sum(mass, communicator);
    inertia = dealii::Utilities::MPI::sum(inertia, communicator);
  }

  SpacePlaten::Six
  SpacePlaten::resultant(const std::vector<CapturedNode<3>> &captured,
                         const SpacePlatenState &platen) const
  {
    const Matrix rotation = rotation_of(platen);
    Six result{};
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      const Vector &f = captured[captured_positions[i]].force;
      const Vector moment
          = cross_product_3d(Vector(rotation * arm_at(platen.arms, i)), f);
      for (unsigned int d = 0; d < 3; ++d)
      {
        result[d] += f[d];
        result[3 + d] += moment[d];
      }
    }
    MPI_Allreduce(MPI_IN_PLACE, result.data(), 6, MPI_DOUBLE, MPI_SUM,
                  communicator);
    return result;
  }

  double SpacePlaten::driven_velocity(const unsigned int d,
                                      const StepContext &step,
                                      const SpacePlatenState &platen) const
  {
    const double unit = d < 3 ? 1. : constants::degree;
    if (component(d).quantity == LoadQuantity::velocity)
      return unit * step.load_rate * component(d).value(step.middle);
    return (platen.stage_start[d] + unit * component(d).value(step.end)
            - platen.displacement[d])
           / step.dt;
  }

  void SpacePlaten::advance(const unsigned int first, const Matrix &inertia,
                            const Vector &force, const StepContext &step,
                            SpacePlatenState &platen)
  {
    const Vector before = half_of(platen.velocity, first);
    const double a      = 0.5 * step.dt_velocity * step.mass_damping;
    // Unknown is the change of velocity; of driven components it is given.
    Matrix matrix = inertia;
    Vector total  = force, right;
    for (unsigned int d = 0; d < 3; ++d)
    {
      damping[first + d] = 0.;
      if (driven(first + d))
      {
        matrix[d]    = Vector();
        matrix[d][d] = 1.;
        right[d]     = driven_velocity(first + d, step, platen) - before[d];
        continue;
      }
      drive[first + d] = component(first + d).value(step.begin);
      total[d] += drive[first + d];
      right[d] = step.dt_velocity * total[d];
      for (unsigned int e = 0; e < 3; ++e)
        if (!driven(first + e))
        {
          matrix[d][e] *= 1. + a;
          right[d] -= 2. * a * inertia[d][e] * before[e];
        }
    }
    Vector change = invert(matrix) * right, local;
    for (unsigned int d = 0; d < 3; ++d)
      if (!driven(first + d))
      {
        local[d] = -local_damping_velocity(step.local_damping * step.dt_velocity
                                               / (1. + a) / inertia[d][d]
                                               * std::abs(total[d]),
                                           before[d], before[d] + change[d]);
        // A moment counts as a force at the radius of gyration.
        last_unbalanced
            += std::abs(total[d])
               / (first == 0 ? 1. : std::sqrt(inertia[d][d] / mass));
      }
    change += local;
    for (unsigned int d = 0; d < 3; ++d)
    {
      for (unsigned int e = 0; e < 3; ++e)
        if (!driven(first + d) && !driven(first + e))
          damping[first + d]
              += inertia[d][e]
                 * ((1. + a) / step.dt_velocity * local[e]
                    - step.mass_damping * (before[e] + 0.5 * change[e]));
      if (driven(first + d))
        drive[first + d] = inertia[d] * change / step.dt_velocity - force[d];
      velocity_before[first + d] = before[d];
      platen.velocity[first + d] = before[d] + change[d];
      platen.displacement[first + d] += step.dt * platen.velocity[first + d];
    }
  }

  void SpacePlaten::correct(const StepContext &step,
                            const std::vector<CapturedNode<3>> &captured,
                            State<3> &state)
  {
    SpacePlatenState &platen = state.get<SpacePlatenState>(load_name);
    const Matrix before      = rotation_of(platen);
    const Matrix turned      = before * inertia * transpose(before);
    const Vector spin        = half_of(platen.velocity, 3);
    const Six nodal          = resultant(captured, platen);
    last_unbalanced          = 0.;
    advance(0, mass * Matrix(dealii::unit_symmetric_tensor<3>()),
            half_of(nodal, 0), step, platen);
    // Euler's equations: the spin of its axes takes a moment, that of the mean
    // of the spins before and after, which does no work.
    const double of_forces = last_unbalanced;
    const Six from = platen.displacement, velocity = platen.velocity;
    Vector mean_spin = spin;
    for (unsigned int iteration = 0; iteration < 2; ++iteration)
    {
      platen.displacement = from;
      platen.velocity     = velocity;
      last_unbalanced     = of_forces;
      advance(3, turned,
              half_of(nodal, 3)
                  - cross_product_3d(mean_spin, Vector(turned * mean_spin)),
              step, platen);
      mean_spin = 0.5 * (spin + half_of(platen.velocity, 3));
    }
    last_resultant = { { drive[0], drive[1], drive[2] } };

    const Vector rate  = half_of(platen.velocity, 3);
    const Matrix after = rotation_by(step.dt * rate) * before;
    set_rotation(after, platen);
    const Vector moved = platen.centre + half_of(platen.displacement, 0);
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      const CapturedNode<3> &node = captured[captured_positions[i]];
      const Vector arm            = arm_at(platen.arms, i);
      const Vector now = after * arm, mean = 0.5 * (now + before * arm);
      // Velocity by the mean arm: differences of positions lose digits.
      state.velocity[node.node]
          = half_of(platen.velocity, 0) + cross_product_3d(rate, mean);
      NodeRecord<3> &record = state.nodes[node.node];
      record.u              = moved + now - record.X;
    }
  }

  void SpacePlaten::account(const StepContext &step,
                            const std::vector<CapturedNode<3>> &,
                            State<3> &state)
  {
    // All ranks have the platen; the first one books its work.
    if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    const SpacePlatenState &platen = state.get<SpacePlatenState>(load_name);
    for (unsigned int d = 0; d < 6; ++d)
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
