// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/field_output.h>
#include <quoin/results/histories.h>
#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/number_text.h>
#include <quoin/contact/face_contacts.h>
#include <quoin/joint_elements/joint_changes.h>
#include <quoin/model/block_placement.h>
#include <quoin/reinforcement/bar_results.h>
#include <quoin/results/point_values.h>
#include <quoin/results/result_origin.h>
#include <quoin/water/joint_flow.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  template <int dim>
  Histories<dim>::Histories(const std::vector<HistoryParameters> &parameters,
                            const Model<dim> &model, const Solver<dim> &solver,
                            const BoundaryGeometry &geometry,
                            const BoundaryElementParameters &boundaries,
                            const std::vector<double> &absence,
                            const std::vector<NamedBlock> &named_blocks)
    : n_columns(parameters.size()), model(model), solver(solver),
      communicator(model.nodes().communicator()), absence(absence)
  {
    std::vector<HistoryParameters> boundary_probes, block_probes;
    for (const HistoryParameters &history : parameters)
    {
      Probe probe;
      probe.parameters = history;
      history.check_dimension<dim>();
      locate(probe);
      probes.push_back(probe);
      if (history.is_of_boundary())
        boundary_probes.push_back(history);
      if (history.is_of_block())
        block_probes.push_back(history);
    }
    for (unsigned int i = 0; i < n_columns; ++i)
      if (probes[i].parameters.is_of_two_points())
        add_ends(i);
    row.resize(1 + probes.size());
    origin.resize(n_columns, 0.);
    if (!boundary_probes.empty())
      of_boundary = std::make_unique<BoundaryHistories>(
          boundary_probes, geometry, boundaries, model.parameters().thickness);
    if constexpr (dim == 2)
      if (!block_probes.empty())
        of_blocks = std::make_unique<BlockHistories>(block_probes, named_blocks,
                                                     model, model.contacts());
  }

  template <int dim>
  std::vector<std::string> Histories<dim>::column_names() const
  {
    std::vector<std::string> names = { "time [s]" };
    for (unsigned int i = 0; i < n_columns; ++i)
      names.push_back(probes[i].parameters.name + " ["
                      + probes[i].parameters.unit + "]");
    return names;
  }

  template <int dim>
  dealii::Point<dim> Histories<dim>::place_of(const Probe &probe) const
  {
    std::vector<double> sum(dim, 0.);
    for (const auto &[node, weight] : probe.at.nodes)
      for (unsigned int d = 0; d < dim; ++d)
        sum[d] += weight * model.nodes().point(node)[d];
    dealii::Utilities::MPI::sum(sum, communicator, sum);
    dealii::Point<dim> result;
    std::copy(sum.begin(), sum.end(), result.begin_raw());
    return result;
  }

  template <int dim>
  std::vector<std::string> Histories<dim>::moved_points() const
  {
    std::vector<std::string> lines;
    const auto add = [&](const Probe &probe, const char *const entry)
    {
      if (probe.at.is_inside)
        return;
      const dealii::Point<dim> node = place_of(probe);
      double square                 = 0.;
      std::string place;
      for (unsigned int d = 0; d < dim; ++d)
      {
        square += std::pow(node[d] - probe.parameters.point[d], 2);
        place += (d == 0 ? "" : ", ") + number_text(node[d]);
      }
      lines.push_back("history " + probe.parameters.name
                      + ": the motion of the node at (" + place
                      + "), the nearest to its " + entry
                      + ", which lies outside of all blocks, "
                      + number_text(std::sqrt(square)) + " m away");
    };
    for (unsigned int i = 0; i < n_columns; ++i)
    {
      add(probes[i], "'Point'");
      if (const unsigned int ends = probes[i].ends; ends > 0)
      {
        add(probes[ends], "'Point'");
        add(probes[ends + dim], "'Second point'");
      }
    }
    return lines;
  }

  template <int dim>
  std::vector<std::string>
  Histories<dim>::names_in(const unsigned int block) const
  {
    std::vector<unsigned int> is_in;
    unsigned int next = 0; // column of of_blocks
    for (const Probe &probe : probes)
    {
      const auto blocks = blocks_at(model, probe.parameters, probe.at);
      is_in.push_back(probe.parameters.is_of_block()
                          ? of_blocks->is_of(next++, block)
                          : std::count(blocks.begin(), blocks.end(), block)
                                > 0);
    }
    dealii::Utilities::MPI::max(is_in, communicator, is_in);
    std::vector<std::string> names;
    for (unsigned int i = 0; i < probes.size(); ++i)
      if (const std::string &name = probes[i].parameters.name;
          is_in[i] && !is_among(name, names))
        names.push_back(name);
    return names;
  }

  template <int dim>
  void Histories<dim>::add_ends(const unsigned int column)
  {
    const HistoryParameters wanted = probes[column].parameters;
    probes[column].ends            = probes.size();
    for (const auto &point : { wanted.point, wanted.other_point })
      for (unsigned int d = 0; d < dim; ++d)
      {
        Probe end;
        end.parameters.name      = wanted.name;
        end.parameters.component = d;
        end.parameters.point     = point;
        locate(end);
        end.coordinate = place_of(end)[d];
        probes.push_back(end);
      }
  }

  template <int dim>
  double Histories<dim>::value_of_two(const Probe &probe,
                                      const double *values) const
  {
    dealii::Tensor<1, dim> before, change;
    for (unsigned int d = 0; d < dim; ++d)
    {
      const unsigned int first = probe.ends + d, second = first + dim;
      before[d] = probes[second].coordinate - probes[first].coordinate;
      change[d] = values[second] - values[first];
    }
    const dealii::Tensor<1, dim> now = before + change;
    if (probe.parameters.quantity == HistoryQuantity::relative_displacement)
      return change[probe.parameters.component];
    if (probe.parameters.quantity == HistoryQuantity::distance_change)
      return now.norm() - before.norm();
    return std::atan2(before[0] * now[1] - before[1] * now[0], before * now)
           / constants::degree;
  }

  template <int dim>
  void Histories<dim>::locate(Probe &probe) const
  {
    const HistoryParameters &wanted = probe.parameters;
    switch (wanted.quantity)
    {
    case HistoryQuantity::displacement:
    case HistoryQuantity::velocity:
    case HistoryQuantity::stress:
    case HistoryQuantity::principal_stress:
    case HistoryQuantity::yielding:
    case HistoryQuantity::rotation:
      probe.at = find_history_point(model, wanted, absence);
      return;
    case HistoryQuantity::joint:
      probe.at = find_history_point(model, wanted, absence);
      return check_law(probe);
    case HistoryQuantity::joint_force:
      return find_surface(probe);
    case HistoryQuantity::water:
      return find_water(probe);
    case HistoryQuantity::reaction:
    case HistoryQuantity::platen_displacement:
    case HistoryQuantity::platen_force:
      return find_load(probe);
    case HistoryQuantity::unbalanced_ratio: // of the whole model
    case HistoryQuantity::kinetic_share:
    case HistoryQuantity::contacts:
    case HistoryQuantity::open_joints:
    case HistoryQuantity::load_time:
    case HistoryQuantity::loading_rate:
    case HistoryQuantity::load_factor:
    case HistoryQuantity::controlled_displacement:
    case HistoryQuantity::relative_displacement: // see add_ends()
    case HistoryQuantity::tilt:
    case HistoryQuantity::distance_change:
    case HistoryQuantity::block_displacement: // see BlockHistories
    case HistoryQuantity::block_velocity:
    case HistoryQuantity::block_force:
    case HistoryQuantity::cable:                 // see cable_value()
    case HistoryQuantity::beam:                  // see add_beam_values()
    case HistoryQuantity::boundary_displacement: // see BoundaryHistories
    case HistoryQuantity::boundary_velocity:
    case HistoryQuantity::boundary_traction:
    case HistoryQuantity::boundary_hoop_stress:
    case HistoryQuantity::boundary_force:
      return;
    case HistoryQuantity::blocks_outside:
      if (!model.parameters().contact.has_box)
        throw InputError("section 'Histories/" + wanted.name
                         + "': 'Quantity = blocks outside' counts those that "
                           "have left a box, and there is none. Give 'Box' in "
                           "section 'Contact'.");
      return;
    }
  }

  template <int dim>
  void Histories<dim>::check_law(const Probe &probe) const
  {
    const std::string field = probe.parameters.law_field();
    if (field.empty())
      return;
    unsigned int has_it = 0;
    if (probe.at.here)
      std::visit(
          [&](const auto &law)
          {
            for (const auto &each : law.template fields<dim>())
              if (each.name == field)
                has_it = 1;
          },
          model.joints()
              .laws()[joint_faces(model.joints())[probe.at.entity / dim].set]);
    if (dealii::Utilities::MPI::max(has_it, communicator) == 0)
      throw InputError(
          "section 'Histories/" + probe.parameters.name
          + "': 'Quantity = " + probe.parameters.word
          + "' is one of joints with 'Law = composite', and the joint at "
            "'Point' has another law. Give a point of such a joint, name its "
            "'Curve', or remove the history.");
  }

  template <int dim>
  void Histories<dim>::find_surface(const Probe &probe) const
  {
    const std::string &name = probe.parameters.curve;
    unsigned int n          = 0;
    for (const JointNodes<dim> &face : model.nodes().faces().joints)
      if (name.empty() || model.nodes().table().joint_name(face.name) == name)
        n = 1;
    if (dealii::Utilities::MPI::max(n, communicator) == 0)
      throw InputError("section 'Histories/" + probe.parameters.name
                       + "': there is no joint"
                       + (name.empty() ? "" : " on a surface '" + name + "'")
                       + " in the model. Correct 'Curve' or 'Quantity'.");
  }

  template <int dim>
  void Histories<dim>::find_load(Probe &probe) const
  {
    const HistoryParameters &wanted = probe.parameters;
    const std::string section = "section 'Histories/" + wanted.name + "': ";
    const auto &constraints   = solver.loads().constraints;
    const auto found = std::find_if(constraints.begin(), constraints.end(),
                                    [&](const auto &constraint) {
                                      return constraint->name() == wanted.load;
                                    });
    if (wanted.quantity == HistoryQuantity::reaction
        && solver.loads().has_added_mass(wanted.load))
      return;
    if (found == constraints.end())
      throw InputError(section + "'Load = " + wanted.load
                       + "' is no prescribed motion, platen or "
                         "viscous boundary. These are: "
                       + known_names_like(wanted.load, constraints,
                                          &MotionConstraint<dim>::name)
                       + ".");
    if ((*found)->traits().is_rigid_body())
      probe.platen = found->get();
    if (wanted.quantity != HistoryQuantity::reaction && !probe.platen)
      throw InputError(section + "'Load = " + wanted.load
                       + "' is no platen. Use 'reaction' for other loads.");
  }

  template <int dim>
  double Histories<dim>::cable_value(const HistoryParameters &wanted,
                                     const State<dim> &state) const
  {
    if constexpr (dim == 2)
      return quoin::cable_value(model.reinforcement(), state, wanted.cable,
                                static_cast<CableQuantity>(wanted.component),
                                wanted.point);
    return 0.;
  }

  template <int dim>
  void Histories<dim>::find_water(Probe &probe) const
  {
    if constexpr (dim == 2)
    {
      const HistoryParameters &wanted = probe.parameters;
      const JointFlow &flow           = *solver.loads().water;
      const auto &places              = flow.parameters().boundaries;
      if (const auto *place = find_named(places, wanted.water))
        probe.water_nodes
            = flow.channels().boundary_nodes[place - places.data()];
      else if (!wanted.curve.empty())
        probe.water_nodes = flow.channels().nodes_on(
            { wanted.curve },
            "section 'Histories/" + wanted.name + "': ", "Curve");
    }
  }

  template <int dim>
  double Histories<dim>::water_value(const Probe &probe,
                                     const State<dim> &state) const
  {
    const double sign = probe.parameters.component == 0 ? 1. : -1.;
    double sum        = 0.;
    if constexpr (dim == 2)
    {
      const auto &inflow = state.template get<JointFlowState>().node_inflow;
      for (const unsigned int node : probe.water_nodes)
        sum += sign * inflow[node];
      if (probe.water_nodes.empty())
        for (const double flow : inflow)
          sum += std::max(0., sign * flow);
    }
    return sum;
  }

  template <>
  double Histories<3>::joint_force(const Probe &probe,
                                   const State<3> &state) const
  {
    const SpaceJoints &joints = model.joints();
    const std::string &name   = probe.parameters.curve;
    double force              = 0.;
    for (unsigned int i = 0; i < joints.faces().size(); ++i)
    {
      const SpaceJointFace &face = joints.faces()[i];
      const auto &joint          = model.nodes().faces().joints[face.face];
      if (name.empty() || model.nodes().table().joint_name(joint.name) == name)
        force += face.share
                 * force_on_upper(joints, i, state)[probe.parameters.component];
    }
    return force;
  }

  template <>
  double Histories<2>::open_length(const State<2> &state) const
  {
    const auto &segments        = model.joints().segments();
    const auto &faces           = model.nodes().faces().joints;
    const JointHistory &history = state.get<JointHistory>();
    double length               = 0.;
    for (unsigned int i = 0; i < segments.size(); ++i)
    {
      const bool is_gone            = history.handed_over[i];
      const BlockContacts *contacts = model.contacts();
      const JointNodes<2> &face     = faces[segments[i].face];
      if ((is_gone && !contacts) || is_at_absent_block(model, i, state))
        continue;
      // What lies on a face its own rank knows.
      const double share = !is_gone         ? segments[i].share
                           : face.is_own[0] ? 1.
                                            : 0.;
      const double thickness
          = model.thickness().common(face.groups[0], face.groups[1]);
      for (unsigned int k = 0; k < 2 && share > 0.; ++k)
        if ((is_gone ? contact_on_face(*contacts, state, segments[i], k).state()
                     : history.state[2 * i + k])
            == JointState::open)
          length += segments[i].area[k] / thickness * share;
    }
    return length;
  }

  template <int dim>
  std::vector<DisplacementTerm>
  Histories<dim>::terms_of(const std::string &name,
                           const std::string &where) const
  {
    const auto found = std::find_if(probes.begin(), probes.begin() + n_columns,
                                    [&](const Probe &probe)
                                    { return probe.parameters.name == name; });
    const bool is_of_two = found != probes.begin() + n_columns
                           && found->parameters.quantity
                                  == HistoryQuantity::relative_displacement;
    if (found == probes.begin() + n_columns
        || (!is_of_two
            && found->parameters.quantity != HistoryQuantity::displacement))
      throw InputError(where + "'Controlled displacement = " + name
                       + "' is neither 'mean' nor a history with the quantity "
                         "displacement or relative displacement. Name one of "
                         "section 'Histories'.");
    std::vector<DisplacementTerm> terms;
    const unsigned int d = found->parameters.component;
    const auto add       = [&](const Probe &probe, const double weight)
    {
      for (const auto &[node, part] : probe.at.nodes)
        terms.push_back({ node, d, weight * part });
    };
    if (!is_of_two)
      add(*found, 1.);
    else
    {
      add(probes[found->ends + d], -1.);
      add(probes[found->ends + dim + d], 1.);
    }
    return terms;
  }

  template <int dim>
  bool Histories<dim>::need_balance() const
  {
    return std::any_of(probes.begin(), probes.end(),
                       [](const Probe &probe) {
                         return probe.parameters.quantity
                                == HistoryQuantity::unbalanced_ratio;
                       });
  }

  template <int dim>
  void Histories<dim>::before_step(const State<dim> &state)
  {
    std::fill(row.begin(), row.end(), 0.);
    row[0]     = state.time;
    load_clock = { state.load_time, state.load_rate };
    controlled = std::numeric_limits<double>::quiet_NaN();
    if (const LoadPattern<dim> *pattern = solver.stage_loads().pattern.get())
      controlled = pattern->displacement(state.nodes)
                   - state.template get<LoadPatternState>().start;
    n_outside = double(std::count_if(
        state.block_marks.begin(), state.block_marks.end(),
        [](const std::uint8_t mark) {
          return mark == block_mark::left_box || mark == block_mark::removed;
        }));
    for (unsigned int i = 0; i < probes.size(); ++i)
    {
      const Probe &probe = probes[i];
      if (probe.at.here || !probe.at.nodes.empty())
        row[1 + i] = point_value(model, probe.parameters, probe.at, state);
      else if (probe.platen
               && probe.parameters.quantity
                      == HistoryQuantity::platen_displacement)
      {
        const unsigned int d = probe.parameters.component;
        row[1 + i] = probe.platen->rigid_motion()->displacement(state)[d]
                     / (d >= (dim == 2 ? 2 : 3) ? constants::degree : 1.);
      }
    }
    if constexpr (dim == 2)
    {
      add_beam_values(state);
      if (of_blocks)
        of_blocks->before_step(state);
    }
  }

  template <int dim>
  bool Histories<dim>::is_at_absent(const Probe &probe,
                                    const State<dim> &state) const
  {
    if (state.block_marks.empty())
      return false;
    const auto blocks = blocks_at(model, probe.parameters, probe.at);
    bool result       = std::any_of(blocks.begin(), blocks.end(),
                                    [&](const unsigned int block)
                                    { return state.is_absent(block); });
    if (probe.ends > 0)
      for (unsigned int end = 0; end < 2 * dim; ++end)
        result = result || is_at_absent(probes[probe.ends + end], state);
    return result;
  }

  template <int dim>
  std::vector<unsigned int>
  Histories<dim>::about_absent(const State<dim> &state) const
  {
    std::vector<unsigned int> result(n_columns, 0);
    for (unsigned int i = 0; i < n_columns; ++i)
      result[i] = is_at_absent(probes[i], state);
    unsigned int next = 0; // column of of_blocks
    for (unsigned int i = 0; i < n_columns; ++i)
      if (probes[i].parameters.is_of_block())
      {
        for (unsigned int b = 0; b < state.block_marks.size(); ++b)
          if (state.is_absent(b) && of_blocks->is_of(next, b))
            result[i] = 1;
        ++next;
      }
    dealii::Utilities::MPI::max(result, communicator, result);
    return result;
  }

  template <int dim>
  void Histories<dim>::begin_stage(const ResultReset &reset,
                                   const State<dim> &state)
  {
    std::vector<double> whole;
    if (reset.displacements || reset.slips)
    {
      before_step(state);
      whole = whole_row(state);
    }
    const auto is_absent = about_absent(state);
    for (unsigned int i = 0; i < n_columns; ++i)
    {
      const HistoryParameters &wanted = probes[i].parameters;
      // Slips that are vectors count from the origin before their magnitude.
      const bool is_slip = dim == 2 && wanted.quantity == HistoryQuantity::joint
                           && wanted.component == 1;
      // A block that is absent begins where the mesh has it.
      if (is_absent[i])
        origin[i] = 0.;
      else if ((reset.displacements && wanted.is_displacement())
               || (reset.slips && is_slip))
        origin[i] = whole[1 + i];
    }
  }

  template <int dim>
  std::vector<double> Histories<dim>::after_step(const State<dim> &state)
  {
    std::vector<double> result = whole_row(state);
    for (unsigned int i = 0; i < n_columns; ++i)
      result[1 + i] -= origin[i];
    return result;
  }

  template <int dim>
  std::vector<double> Histories<dim>::whole_row(const State<dim> &state)
  {
    for (unsigned int i = 0; i < probes.size(); ++i)
    {
      const Probe &probe = probes[i];
      // The velocity at the full step is the mean of those at half steps; joint
      // tractions were updated in the step.
      if (!probe.at.nodes.empty()
          && probe.parameters.quantity == HistoryQuantity::velocity)
        row[1 + i]
            = 0.5
              * (row[1 + i]
                 + point_value(model, probe.parameters, probe.at, state));
      if (probe.at.here && probe.parameters.quantity == HistoryQuantity::joint
          && probe.parameters.component >= 2
          && (dim == 2 || probe.parameters.component < 7)) // else a slip
        row[1 + i] = point_value(model, probe.parameters, probe.at, state);
    }
    for (unsigned int i = 0; i < n_columns; ++i)
      if (probes[i].parameters.quantity == HistoryQuantity::contacts
          && model.contacts())
        row[1 + i] = n_touching(model.contacts()->near_pairs(),
                                state.template get<ContactState>());
    if constexpr (dim == 2)
      for (unsigned int i = 0; i < n_columns; ++i)
        if (probes[i].parameters.quantity == HistoryQuantity::open_joints)
          row[1 + i] = open_length(state);
    if constexpr (dim == 3)
      for (unsigned int i = 0; i < n_columns; ++i)
        if (probes[i].parameters.quantity == HistoryQuantity::joint_force)
          row[1 + i] = joint_force(probes[i], state);
    const double time          = row[0];
    std::vector<double> result = row;
    // All ranks have platen displacements; of points each has its part.
    for (unsigned int i = 0; i < probes.size(); ++i)
      if (probes[i].platen
          && dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
        result[1 + i] = 0.;
    // Behind them, whether one of two points is in a block that is not there.
    const std::size_t n_values = result.size();
    for (unsigned int i = 0; i < n_columns; ++i)
      result.push_back(
          probes[i].ends > 0 && is_at_absent(probes[i], state) ? 1. : 0.);
    MPI_Allreduce(MPI_IN_PLACE, result.data(), result.size(), MPI_DOUBLE,
                  MPI_SUM, communicator);
    result[0] = time;
    for (unsigned int i = 0; i < n_columns; ++i)
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
      else if (wanted.quantity == HistoryQuantity::load_factor)
        result[1 + i] = std::isnan(controlled)
                            ? controlled
                            : state.template get<LoadPatternState>().factor;
      else if (wanted.quantity == HistoryQuantity::controlled_displacement)
        result[1 + i] = controlled;
      else if (wanted.quantity == HistoryQuantity::kinetic_share)
        result[1 + i] = solver.energies().kinetic
                        / std::max(solver.energies().throughput(), 1e-300);
      else if (wanted.quantity == HistoryQuantity::blocks_outside)
        result[1 + i] = n_outside;
      else if (wanted.quantity == HistoryQuantity::cable)
        result[1 + i] = cable_value(wanted, state);
      else if (wanted.quantity == HistoryQuantity::water)
        result[1 + i] = water_value(probes[i], state);
      else if (wanted.is_of_two_points())
      {
        const double value = value_of_two(probes[i], result.data() + 1);
        // That of a block that has been deleted is no number.
        result[1 + i]
            = result[n_values + i] > 0. && !std::isnan(value) ? 0. : value;
      }
    }
    result.resize(1 + n_columns);
    if constexpr (dim == 2)
      if (of_blocks)
        add_block_values(state, result);
    if constexpr (dim == 2)
      if (of_boundary && state.template get<FarFieldState>().active)
        add_boundary_values(state, result);
    return result;
  }

  template <>
  void Histories<2>::add_beam_values(const State<2> &state)
  {
    const Beams *beams = solver.loads().beams.get();
    if (!beams || dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    for (unsigned int i = 0; i < n_columns; ++i)
    {
      const HistoryParameters &wanted = probes[i].parameters;
      if (wanted.quantity != HistoryQuantity::beam)
        continue;
      for (unsigned int b = 0; b < beams->all().size(); ++b)
      {
        const Beam &beam = beams->all()[b];
        if (beam.line.given.name == wanted.beam
            && state.get<BeamState>().placed[b])
          row[1 + i] = beam_value(
              beam_fields(beam, state),
              nearest_node(beam.line, { wanted.point[0], wanted.point[1] }),
              wanted.component);
      }
    }
  }

  template <>
  void Histories<2>::add_block_values(const State<2> &state,
                                      std::vector<double> &result)
  {
    const std::vector<double> values = of_blocks->after_step(state);
    unsigned int next                = 0;
    for (unsigned int i = 0; i < n_columns; ++i)
      if (probes[i].parameters.is_of_block())
        result[1 + i] = values[next++];
  }

  template <>
  void Histories<2>::add_boundary_values(const State<2> &state,
                                         std::vector<double> &result) const
  {
    const FarField &far  = *solver.loads().far.elastodynamic;
    BoundaryState fields = boundary_state(far, state);
    // The row is for the time before the last step.
    const double since = (double(state.get<FarFieldState>().substep) - 1.)
                         * far.time_step() / far.n_substeps();
    fields.displacement += since * fields.velocity;
    const std::vector<double> values = of_boundary->row(0., fields);
    unsigned int next                = 1;
    for (unsigned int i = 0; i < n_columns; ++i)
      if (probes[i].parameters.is_of_boundary())
        result[1 + i] = values[next++];
  }

  template class Histories<2>;
  template class Histories<3>;
} // namespace quoin
