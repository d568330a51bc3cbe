// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/field_output.h>
#include <quoin/results/histories.h>
#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/blocks/triangle.h>
#include <quoin/results/block_output.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace quoin
{
  namespace
  {
    /** Squared distance by which nodes are put after others at their place
        [m^2]. */
    constexpr double just_behind = 1e-18;

    /**
     * What of this rank is nearest to a point. Of several at the same distance
     * that of a block in which the point lies, then the lower, then the left
     * one: numbers depend on the number of ranks.
     */
    struct Nearest
    {
      /** Squared distance [m^2], 1 outside of the block, y, x. */
      using Key                    = std::array<double, 4>;
      static constexpr double none = std::numeric_limits<double>::max();

      dealii::Point<2> point;
      unsigned int entity = 0; /**< node, cell or joint point */
      Key key{ { none, none, none, none } };

      /** @p finer: the key but for the distance. */
      template <typename Finer>
      void consider(const dealii::Point<2> &p, const unsigned int candidate,
                    const Finer &finer, const double farther = 0.)
      {
        const double distance = p.distance_square(point) + farther;
        if (distance > key[0])
          return;
        const std::array<double, 3> rest = finer();
        const Key other{ { distance, rest[0], rest[1], rest[2] } };
        if (other < key)
        {
          key    = other;
          entity = candidate;
        }
      }
    };

    bool contains(const NodeMap<2> &nodes, const unsigned int cell,
                  const dealii::Point<2> &point)
    {
      for (unsigned int k = 0; k < 3; ++k)
      {
        const auto &p     = nodes.point(nodes.cell(cell)[k]);
        const auto along  = nodes.point(nodes.cell(cell)[(k + 1) % 3]) - p;
        const auto beyond = point - p;
        if (along[0] * beyond[1] < along[1] * beyond[0])
          return false;
      }
      return true;
    }

    std::array<double, 3> place_of_block(const NodeMap<2> &nodes,
                                         const unsigned int block,
                                         const dealii::Point<2> &point)
    {
      const BlockPart &part = nodes.block_parts()[nodes.find_part(block)];
      bool inside           = false;
      for (unsigned int c = part.cells[0]; c < part.cells[1]; ++c)
        inside = inside || contains(nodes, c, point);
      dealii::Point<2> sum;
      for (unsigned int node = part.nodes[0]; node < part.nodes[1]; ++node)
        sum += nodes.point(node);
      const unsigned int n = part.nodes[1] - part.nodes[0];
      return { { inside ? 0. : 1., sum[1] / n, sum[0] / n } };
    }

    void consider_nodes(const Model &model,
                        const std::vector<bool> &absent_in_the_end,
                        Nearest &nearest)
    {
      const NodeMap<2> &nodes = model.nodes();
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      {
        const unsigned int block = nodes.block_of_node(i);
        const bool absent = absent_in_the_end[model.table().group[block]];
        nearest.consider(
            nodes.point(i), i,
            [&] { return place_of_block(nodes, block, nearest.point); },
            absent ? just_behind : 0.);
      }
    }

    void consider_cells(const Model &model, Nearest &nearest)
    {
      const NodeMap<2> &nodes = model.nodes();
      for (unsigned int c = 0; c < nodes.n_cells(); ++c)
      {
        const auto &[i, j, k] = nodes.cell(c);
        const dealii::Point<2> centroid(
            (nodes.point(i) + nodes.point(j) + nodes.point(k)) / 3.);
        nearest.consider(
            centroid, c,
            [&] {
              return std::array<double, 3>{ { 0., centroid[1], centroid[0] } };
            });
      }
    }

    /** Of joints on @p curve; on any, if it is empty. */
    void consider_joint_points(const Model &model, const std::string &curve,
                               Nearest &nearest)
    {
      const NodeMap<2> &nodes = model.nodes();
      for (unsigned int i = 0; i < model.joints().n_segments(); ++i)
      {
        const auto &face = nodes.joint_faces()[model.joints().segment(i).face];
        if (!curve.empty() && model.table().face_names[face.name] != curve)
          continue;
        for (unsigned int k = 0; k < 2; ++k)
        {
          const auto &here  = nodes.point(face.lower[k]);
          const auto &other = nodes.point(face.lower[1 - k]);
          nearest.consider(
              here, 2 * i + k,
              [&]
              {
                return std::array<double, 3>{ { 0., 0.5 * (here[1] + other[1]),
                                                0.5 * (here[0] + other[0]) } };
              });
        }
      }
    }
  } // namespace

  Histories::Histories(const std::vector<HistoryParameters> &parameters,
                       const Model &model, const Solver &solver,
                       const BoundaryGeometry &geometry,
                       const BoundaryElementParameters &boundaries,
                       const std::vector<bool> &absent_in_the_end)
    : model(model), solver(solver),
      communicator(model.exchange().communicator()),
      absent_in_the_end(absent_in_the_end)
  {
    std::vector<HistoryParameters> boundary_probes;
    for (const HistoryParameters &history : parameters)
    {
      Probe probe;
      probe.parameters = history;
      locate(probe);
      probes.push_back(probe);
      if (history.is_of_boundary())
        boundary_probes.push_back(history);
    }
    row.resize(1 + probes.size());
    if (!boundary_probes.empty())
      of_boundary = std::make_unique<BoundaryHistories>(
          boundary_probes, geometry, boundaries, model.thickness());
  }

  std::vector<std::string> Histories::column_names() const
  {
    std::vector<std::string> names = { "time [s]" };
    for (const Probe &probe : probes)
      names.push_back(probe.parameters.name + " [" + probe.parameters.unit
                      + "]");
    return names;
  }

  void Histories::locate(Probe &probe) const
  {
    const HistoryParameters &wanted = probe.parameters;
    Nearest nearest{ { wanted.point[0], wanted.point[1] } };
    switch (wanted.quantity)
    {
    case HistoryQuantity::displacement:
    case HistoryQuantity::velocity:
      consider_nodes(model, absent_in_the_end, nearest);
      break;
    case HistoryQuantity::stress:
    case HistoryQuantity::yielding:
    case HistoryQuantity::rotation:
      consider_cells(model, nearest);
      break;
    case HistoryQuantity::joint:
      consider_joint_points(model, wanted.curve, nearest);
      break;
    case HistoryQuantity::reaction:
    case HistoryQuantity::platen_displacement:
    case HistoryQuantity::platen_force:
      return find_load(probe);
    case HistoryQuantity::unbalanced_ratio: // of the whole model
    case HistoryQuantity::kinetic_share:
    case HistoryQuantity::contacts:
    case HistoryQuantity::load_time:
    case HistoryQuantity::loading_rate:
    case HistoryQuantity::boundary_displacement: // see BoundaryHistories
    case HistoryQuantity::boundary_velocity:
    case HistoryQuantity::boundary_traction:
    case HistoryQuantity::boundary_hoop_stress:
    case HistoryQuantity::boundary_force:
      return;
    }
    probe.entity = nearest.entity;
    find_owner(probe, nearest.key);
  }

  void Histories::find_load(Probe &probe) const
  {
    const HistoryParameters &wanted = probe.parameters;
    const std::string section = "section 'Histories/" + wanted.name + "': ";
    const auto &constraints   = solver.constraints();
    const auto found = std::find_if(constraints.begin(), constraints.end(),
                                    [&](const auto &constraint) {
                                      return constraint->name() == wanted.load;
                                    });
    if (found == constraints.end())
      throw InputError(section + "'Load = " + wanted.load
                       + "' is no prescribed motion, platen or "
                         "viscous boundary. These are: "
                       + known_names(constraints, &MotionConstraint<2>::name)
                       + ".");
    if ((*found)->is_rigid_body())
      probe.platen = found->get();
    if (wanted.quantity != HistoryQuantity::reaction && !probe.platen)
      throw InputError(section + "'Load = " + wanted.load
                       + "' is no platen. Use 'reaction' for other loads.");
  }

  void Histories::find_owner(Probe &probe,
                             const std::array<double, 4> &key) const
  {
    const HistoryParameters &wanted = probe.parameters;
    const std::string section = "section 'Histories/" + wanted.name + "': ";
    const NodeMap<2> &nodes   = model.nodes();
    // The least key of all ranks; more than one know joints between them.
    probe.here           = true;
    const double nearest = dealii::Utilities::MPI::min(key[0], communicator);
    for (const double part : key)
    {
      const double least = dealii::Utilities::MPI::min(
          probe.here ? part : Nearest::none, communicator);
      probe.here = probe.here && part == least;
    }
    double longest = 0.;
    for (const auto &cell : nodes.all_cells())
      for (unsigned int k = 0; k < 3; ++k)
        longest = std::max(longest, nodes.point(cell[k]).distance_square(
                                        nodes.point(cell[(k + 1) % 3])));
    longest = dealii::Utilities::MPI::max(longest, communicator);
    if (nearest > 4. * longest && nearest != std::numeric_limits<double>::max())
    {
      std::ostringstream message;
      message << section << "'Point = " << wanted.point[0] << ", "
              << wanted.point[1] << "' is " << std::sqrt(nearest)
              << " m from the nearest node, cell or joint of the model, more "
                 "than two of its longest edges. Give a point of the model in "
                 "metres.";
      throw InputError(message.str());
    }
    if (nearest == std::numeric_limits<double>::max())
      throw InputError(section + "there is no "
                       + (wanted.curve.empty()
                              ? std::string("such point")
                              : "joint on a curve '" + wanted.curve + "'")
                       + " in the model. Correct 'Curve' or 'Quantity'.");
    const unsigned int rank
        = dealii::Utilities::MPI::this_mpi_process(communicator);
    probe.here = rank
                 == dealii::Utilities::MPI::min(probe.here ? rank : 1U << 30,
                                                communicator);
  }

  double Histories::point_value(const Probe &probe, const State<2> &state) const
  {
    const HistoryParameters &wanted = probe.parameters;
    if (is_absent(probe, state))
      return 0.;
    switch (wanted.quantity)
    {
    case HistoryQuantity::displacement:
      return state.nodes[probe.entity].u[wanted.component];
    case HistoryQuantity::velocity:
      return state.velocity[probe.entity].v[wanted.component];
    case HistoryQuantity::rotation:
      return rotation(probe.entity, state) / constants::degree;
    case HistoryQuantity::stress:
    {
      if (probe.entity >= model.n_deformable_cells())
        return 0.;
      const auto stress = model.blocks().cell_stress(
          state.nodes.data(), state.get<PlasticHistory>(), probe.entity);
      if (wanted.component < 4)
        return stress[wanted.component];
      const PrincipalStress principal
          = principal_stress(stress[0], stress[1], stress[2]);
      return wanted.component == 4 ? principal.s1 : principal.s2;
    }
    case HistoryQuantity::yielding:
    {
      if (probe.entity >= model.n_deformable_cells()
          || !model.blocks().cell_law(probe.entity))
        return 0.;
      const PlasticPoint point = model.blocks().cell_history(
          state.nodes.data(), state.get<PlasticHistory>(), probe.entity);
      return wanted.component == 0 ? point.state : point.plastic_shear;
    }
    case HistoryQuantity::joint:
    {
      const unsigned int p        = probe.entity;
      const JointHistory &history = state.get<JointHistory>();
      if (wanted.component < 2)
        return model.joints().gaps(state.nodes.data(),
                                   p / 2)[p % 2][wanted.component];
      if (wanted.component == 2)
        return history.normal_traction[p];
      if (wanted.component == 3)
        return history.shear_traction[p];
      if (wanted.component == 4)
        return static_cast<double>(history.state[p]);
      return model.joints().field(wanted.component == 5 ? "damage" : "crushing",
                                  p, history);
    }
    default:
      return 0.;
    }
  }

  bool Histories::is_absent(const Probe &probe, const State<2> &state) const
  {
    switch (probe.parameters.quantity)
    {
    case HistoryQuantity::displacement:
    case HistoryQuantity::velocity:
      return state.is_absent(model.nodes().block_of_node(probe.entity));
    case HistoryQuantity::stress:
    case HistoryQuantity::yielding:
    case HistoryQuantity::rotation:
      return state.is_absent(model.nodes().block_of_cell(probe.entity));
    case HistoryQuantity::joint:
      return model.is_at_absent_block(probe.entity / 2, state);
    default:
      return false;
    }
  }

  double Histories::rotation(const unsigned int cell,
                             const State<2> &state) const
  {
    const auto &nodes = model.nodes().cell(cell);
    if (cell >= model.n_deformable_cells())
    {
      const RigidBlocks &rigid = model.rigid_blocks();
      unsigned int b           = 0;
      while (rigid.block(b).end <= nodes[0])
        ++b;
      return state.get<RigidBlockStates>()[b].rotation;
    }
    const NodeRecord<2> &a = state.nodes[nodes[0]], &b = state.nodes[nodes[1]],
                        &c = state.nodes[nodes[2]];
    const CorotatedStrain strain(Triangle(a, b, c).gradient(a.u, b.u, c.u));
    return std::atan2(strain.s, strain.c);
  }

  bool Histories::need_balance() const
  {
    return std::any_of(probes.begin(), probes.end(),
                       [](const Probe &probe) {
                         return probe.parameters.quantity
                                == HistoryQuantity::unbalanced_ratio;
                       });
  }

  void Histories::before_step(const State<2> &state)
  {
    std::fill(row.begin(), row.end(), 0.);
    row[0]     = state.time;
    load_clock = { state.load_time, state.load_rate };
    for (unsigned int i = 0; i < probes.size(); ++i)
    {
      const Probe &probe = probes[i];
      if (probe.here)
        row[1 + i] = point_value(probe, state);
      else if (probe.platen
               && probe.parameters.quantity
                      == HistoryQuantity::platen_displacement)
      {
        const unsigned int d = probe.parameters.component;
        row[1 + i]           = probe.platen->rigid_displacement(state)[d]
                     / (d == 2 ? constants::degree : 1.);
      }
    }
  }

  std::vector<double> Histories::after_step(const State<2> &state)
  {
    for (unsigned int i = 0; i < probes.size(); ++i)
    {
      const Probe &probe = probes[i];
      // The velocity at the full step is the mean of the half steps'; the
      // step has brought the joint tractions to its time.
      if (probe.here && probe.parameters.quantity == HistoryQuantity::velocity)
        row[1 + i] = 0.5 * (row[1 + i] + point_value(probe, state));
      if (probe.here && probe.parameters.quantity == HistoryQuantity::joint
          && probe.parameters.component >= 2)
        row[1 + i] = point_value(probe, state);
    }
    for (unsigned int i = 0; i < probes.size(); ++i)
      if (probes[i].parameters.quantity == HistoryQuantity::contacts
          && solver.contacts())
        row[1 + i] = solver.contacts()->n_touching(state.get<ContactState>());
    const double time          = row[0];
    std::vector<double> result = row;
    // Platen displacements are known to all ranks, points to one.
    for (unsigned int i = 0; i < probes.size(); ++i)
      if (probes[i].platen
          && dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
        result[1 + i] = 0.;
    MPI_Allreduce(MPI_IN_PLACE, result.data(), result.size(), MPI_DOUBLE,
                  MPI_SUM, communicator);
    result[0] = time;
    for (unsigned int i = 0; i < probes.size(); ++i)
    {
      const HistoryParameters &wanted = probes[i].parameters;
      if (wanted.quantity == HistoryQuantity::reaction
          || wanted.quantity == HistoryQuantity::platen_force)
        result[1 + i] = solver.resultant(wanted.load)[wanted.component];
      else if (wanted.quantity == HistoryQuantity::unbalanced_ratio)
        result[1 + i] = state.unbalanced_ratio;
      else if (wanted.quantity == HistoryQuantity::load_time)
        result[1 + i] = load_clock[0];
      else if (wanted.quantity == HistoryQuantity::loading_rate)
        result[1 + i] = load_clock[1];
      else if (wanted.quantity == HistoryQuantity::kinetic_share)
        result[1 + i] = solver.energies().kinetic
                        / std::max(solver.energies().throughput(), 1e-300);
    }
    if (of_boundary && state.get<FarFieldState>().active)
      add_boundary_values(state, result);
    return result;
  }

  void Histories::add_boundary_values(const State<2> &state,
                                      std::vector<double> &result) const
  {
    const FarField &far  = *solver.far_field();
    BoundaryState fields = boundary_state(far, state);
    // The row is of the time before the step that is over.
    const double since = (double(state.get<FarFieldState>().substep) - 1.)
                         * far.time_step() / far.n_substeps();
    fields.displacement += since * fields.velocity;
    const std::vector<double> values = of_boundary->row(0., fields);
    unsigned int next                = 1;
    for (unsigned int i = 0; i < probes.size(); ++i)
      if (probes[i].parameters.is_of_boundary())
        result[1 + i] = values[next++];
  }
} // namespace quoin
