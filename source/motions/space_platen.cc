// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/motions/platen_bearing.h>
#include <quoin/motions/space_platen.h>
#include <quoin/operators/archive.h>

#include <deal.II/physics/transformations.h>

#include <boost/serialization/array.hpp>

#include <algorithm>
#include <cmath>

#include "body_step.h"

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

    using SixVector = BodyStep<6, 3>::Vector;
    using SixMatrix = BodyStep<6, 3>::Matrix;

    /** The matrix of inertia of the motion of a centre and of the rotation
        about it: @p inertia about the centre [kg m^2], @p arm of the centre of
        mass from it [m]. */
    SixMatrix inertia_matrix(const double mass, const Matrix &inertia,
                             const Vector &arm)
    {
      SixMatrix result = SixMatrix::Zero();
      for (unsigned int d = 0; d < 3; ++d)
      {
        Vector axis;
        axis[d]           = 1.;
        const Vector spun = mass * cross_product_3d(axis, arm);
        result(d, d)      = mass;
        for (unsigned int e = 0; e < 3; ++e)
        {
          // Momentum by the rate about axis d, and the other way round.
          result(e, 3 + d) = result(3 + d, e) = spun[e];
          result(3 + d, 3 + e)                = inertia[d][e];
        }
      }
      return result;
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
                           const NodeMap<3> &node_map,
                           const Thickness &thickness)
    : components(parameters.components), turns(parameters.rotations),
      communicator(node_map.communicator())
  {
    load_name                 = parameters.name;
    own_traits.kind           = MotionKind::rigid_body;
    own_traits.holds          = { { driven(0), driven(1), driven(2) } };
    own_traits.holds_rotation = driven(3) && driven(4) && driven(5);
    node_list                 = platen_nodes(parameters, node_map);
    node_area    = platen_areas(parameters, node_map, node_list, thickness);
    is_bearing   = bears_boundary(parameters);
    mesh_normals = platen_normals(parameters, node_map, node_list, thickness);
    own_forces.resize(mesh_normals.size());
  }

  std::vector<dealii::Tensor<1, 3>>
  SpacePlaten::normals(const State<3> &state) const
  {
    const Matrix rotation = rotation_of(state.get<SpacePlatenState>(load_name));
    std::vector<Vector> result;
    for (const Vector &normal : mesh_normals)
      result.push_back(rotation * normal);
    return result;
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
      const double weight = node_area.empty() ? node_mass[i] : node_area[i];
      total += weight;
      of_position += weight * Vector(state.nodes[node_list[i]].position());
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
    SixVector motion;
    for (unsigned int d = 0; d < 3; ++d)
    {
      motion[d]     = momentum[d];
      motion[3 + d] = spin[d];
    }
    const Matrix now = rotation_of(platen);
    motion = inertia_matrix(mass, now * inertia * transpose(now), now * offset)
                 .partialPivLu()
                 .solve(motion);
    std::copy_n(motion.data(), 6, platen.velocity.begin());
  }

  void SpacePlaten::resume_stage(const State<3> &state)
  {
    const auto &arms = state.get<SpacePlatenState>(load_name).arms;
    mass             = 0.;
    inertia          = Matrix();
    offset           = Vector();
    for (unsigned int i = 0; i < node_list.size(); ++i)
    {
      mass += node_mass[i];
      inertia += inertia_of(node_mass[i], arm_at(arms, i));
      if (!node_area.empty())
        offset += node_mass[i] * arm_at(arms, i);
    }
    mass    = dealii::Utilities::MPI::sum(mass, communicator);
    inertia = dealii::Utilities::MPI::sum(inertia, communicator);
    offset  = dealii::Utilities::MPI::sum(offset, communicator) / mass;
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

  void SpacePlaten::correct(const StepContext &step,
                            const std::vector<CapturedNode<3>> &captured,
                            State<3> &state)
  {
    SpacePlatenState &platen = state.get<SpacePlatenState>(load_name);
    const Matrix before      = rotation_of(platen);
    const Matrix turned      = before * inertia * transpose(before);
    const Vector mass_arm    = before * offset;
    const Vector spin        = half_of(platen.velocity, 3);
    const Six nodal          = resultant(captured, platen);
    velocity_before          = platen.velocity;
    const double share       = force_share(step.begin.stage);
    BodyStep<6, 3> body;
    for (unsigned int d = 0; d < 6; ++d)
    {
      body.driven[d] = driven(d);
      body.given[d]  = driven(d) ? driven_velocity(d, step, platen)
                                 : component(d).value(step.begin) * share;
    }
    // Euler's equations: the spin of its axes takes a moment, and that of its
    // centre of mass a force, of the mean of the spins before and after, which
    // does no work.
    const SixMatrix matrix = inertia_matrix(mass, turned, mass_arm);
    Vector mean_spin       = spin;
    for (unsigned int iteration = 0; iteration < 2; ++iteration)
    {
      platen.velocity = velocity_before;
      const Vector force
          = half_of(nodal, 0)
            - mass
                  * cross_product_3d(mean_spin,
                                     cross_product_3d(mean_spin, mass_arm));
      const Vector moment
          = half_of(nodal, 3)
            - cross_product_3d(mean_spin, Vector(turned * mean_spin));
      SixVector total;
      for (unsigned int d = 0; d < 3; ++d)
      {
        total[d]     = force[d];
        total[3 + d] = moment[d];
      }
      body.advance(matrix, total, step, platen.velocity.data());
      mean_spin = 0.5 * (spin + half_of(platen.velocity, 3));
    }
    drive           = body.drive;
    damping         = body.damping;
    last_unbalanced = body.unbalanced;
    for (unsigned int d = 0; d < 6; ++d)
      platen.displacement[d] += step.dt * platen.velocity[d];
    last_resultant = drive;

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
                            const std::vector<CapturedNode<3>> &captured,
                            State<3> &state)
  {
    own_forces.clear();
    for (unsigned int i = 0; i < mesh_normals.size(); ++i)
    {
      const CapturedNode<3> &before = captured[captured_positions[i]];
      own_forces.push_back(before.mass / step.dt_velocity
                               * (state.velocity[before.node] - before.velocity)
                           - before.force);
    }
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
