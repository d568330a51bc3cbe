// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/blocks/cell_states.h>
#include <quoin/contact/law_fields.h>
#include <quoin/joint_elements/joint_changes.h>
#include <quoin/joints/point_arrays.h>
#include <quoin/model/block_placement.h>
#include <quoin/results/field_output.h>
#include <quoin/results/result_origin.h>
#include <quoin/tdbem/tangential_stress.h>

#include <cmath>

namespace quoin
{
  template <int dim>
  BlockFields<dim> block_fields(const Model<dim> &model,
                                const State<dim> &state)
  {
    // Blocks that were removed are left out with their nodes and cells.
    BlockFields<dim> fields;
    const NodeMap<dim> &nodes = model.nodes();
    const auto &plastic       = state.template get<PlasticHistory>();
    const auto *origin        = state.template find<ResultOrigin<dim>>();
    const bool is_moved       = origin && !origin->displacement.empty();
    decltype(fields.stress) stress;
    decltype(fields.strain) strain;
    cell_stresses(model.blocks(), state.nodes.data(), plastic, stress, strain);
    stress.resize(nodes.cells().size()); // those of rigid blocks are zero
    strain.resize(nodes.cells().size());
    std::vector<std::int32_t> number(nodes.n_local(), -1);
    const auto add_node = [&](const unsigned int i)
    {
      const NodeRecord<dim> &node = state.nodes[i];
      number[i]                   = std::int32_t(fields.position.size());
      fields.position.push_back(node.X);
      fields.displacement.push_back(node.u);
      if (is_moved)
      {
        const dealii::Tensor<1, dim> &earlier = origin->displacement[i];
        fields.earlier_displacement.push_back(earlier);
        fields.position.back() += earlier;
        fields.displacement.back() -= earlier;
      }
      fields.velocity.push_back(state.velocity[i]);
    };
    for (const BlockPart &part : nodes.blocks().parts)
    {
      const unsigned int block = part.number;
      if (state.is_absent(block))
        continue;
      for (unsigned int i = part.nodes[0]; i < part.nodes[1]; ++i)
        add_node(i);
      for (unsigned int own = part.cells[0]; own < part.cells[1]; ++own)
      {
        // Shared nodes are added with their first cell.
        for (const unsigned int i : nodes.cells().nodes[own])
          if (number[i] < 0)
            add_node(i);
        fields.cells.emplace_back();
        for (unsigned int k = 0; k <= dim; ++k)
          fields.cells.back()[k] = number[nodes.cells().nodes[own][k]];
        fields.stress.push_back(stress[own]);
        fields.strain.push_back(strain[own]);
        if (model.blocks().cell_data().is_plastic())
        {
          const bool is_rigid = own >= model.nodes().cells().n_deformable;
          fields.yielding.push_back(is_rigid ? 0 : plastic.yielding[own]);
          fields.plastic_shear.push_back(is_rigid ? 0. : plastic.shear[own]);
        }
        fields.block.push_back(block);
        fields.material.push_back(material_of_cell(model, own));
      }
    }
    return fields;
  }

  double flow_value(const Model<2> &model, const JointFlowState &water,
                    const unsigned int point, const unsigned int component)
  {
    if (component == 0)
      return water.point_pressure[point];
    if (component == 1)
      return water.point_aperture[point];
    if (component == 4)
      return water.point_saturation[point];
    // Faces run either way along a joint.
    const JointSegment &segment = model.joints().segments()[point / 2];
    const auto along            = model.nodes().point(segment.lower[1])
                       - model.nodes().point(segment.lower[0]);
    const bool is_steep = std::abs(along[1]) > 1e6 * std::abs(along[0]);
    const double sign   = along[is_steep ? 1 : 0] < 0. ? -1. : 1.;
    return sign * (component == 2 ? water.flow : water.velocity)[point / 2];
  }

  JointFields joint_fields(const Model<2> &model, const State<2> &state)
  {
    JointFields fields;
    const JointHistory &history = state.get<JointHistory>();
    const auto *origin          = state.find<ResultOrigin<2>>();
    const bool is_moved         = origin && !origin->displacement.empty();
    const bool slips_later      = origin && !origin->slip.empty();
    const auto law_names        = law_field_names(model.joints());
    for (const std::string &name : law_names)
      fields.of_laws.push_back({ name, {} });
    const JointFlowState *water = state.find<JointFlowState>();
    if (water)
      for (const char *name : { "water pressure", "hydraulic aperture", "flow",
                                "flow velocity", "saturation" })
        fields.of_laws.push_back({ name, {} });
    const std::size_t n_given = fields.of_laws.size();
    fields.of_laws.push_back({ "inelastic slip", {} });
    for (unsigned int i = 0; i < model.joints().segments().size(); ++i)
    {
      const auto &segment = model.joints().segments()[i];
      // A joint between two ranks is written by the rank of its lower side.
      if (!model.nodes().faces().joints[segment.face].is_own[0]
          || is_at_absent_block(model, i, state))
        continue;
      const auto gaps = gaps_since_placing(model.joints(), i, state);
      fields.joint_set.push_back(segment.set);
      fields.handed_over.push_back(history.handed_over[i]);
      for (unsigned int k = 0; k < 2; ++k)
      {
        const NodeRecord<2> &a = state.nodes[segment.lower[k]];
        const NodeRecord<2> &b = state.nodes[segment.upper[k]];
        const unsigned int p   = 2 * i + k;
        fields.position.push_back(a.X + 0.5 * (b.X - a.X));
        fields.displacement.push_back(0.5 * (a.u + b.u));
        if (is_moved)
        {
          const dealii::Tensor<1, 2> earlier
              = 0.5
                * (origin->displacement[segment.lower[k]]
                   + origin->displacement[segment.upper[k]]);
          fields.earlier_displacement.push_back(earlier);
          fields.position.back() += earlier;
          fields.displacement.back() -= earlier;
        }
        fields.opening.push_back(gaps[k][0]);
        fields.slip.push_back(gaps[k][1] - slip_at_origin(state, p));
        if (slips_later)
          fields.earlier_slip.push_back(origin->slip[p]);
        fields.normal_traction.push_back(history.normal_traction[p]);
        fields.shear_traction.push_back(history.shear_traction[p]);
        for (unsigned int f = 0; f < n_given; ++f)
          fields.of_laws[f].second.push_back(
              f < law_names.size()
                  ? law_field(model.joints(), law_names[f], p, history)
                  : flow_value(model, *water, p, f - law_names.size()));
        // Without the elastic part, that of initial stresses, too; the law of a
        // joint that has become a contact no longer follows it.
        fields.of_laws.back().second.push_back(
            history.handed_over[i] ? gaps[k][1]
                                   : plastic_slip_done(history, p));
        // Its contact carries forces from then on; the law has it as open.
        fields.state.push_back(history.handed_over[i] && gaps[k][0] <= 0.
                                   ? JointState::slipped
                                   : state_since_origin(state, p));
      }
    }
    return fields;
  }

  SpaceJointFields joint_fields(const Model<3> &model, const State<3> &state)
  {
    SpaceJointFields fields;
    const SpaceJoints &joints        = model.joints();
    const SpaceJointHistory &history = state.get<SpaceJointHistory>();
    const auto *origin               = state.find<ResultOrigin<3>>();
    const bool is_moved              = origin && !origin->displacement.empty();
    const bool slips_later           = origin && !origin->slip.empty();
    for (const std::string &name : law_field_names(joints))
      fields.of_laws.push_back({ name, {} });
    for (unsigned int i = 0; i < joints.faces().size(); ++i)
    {
      const SpaceJointFace &face = joints.faces()[i];
      // A joint between two ranks is written by the rank of its lower side.
      if (!model.nodes().faces().joints[face.face].is_own[0]
          || is_at_absent_block(model, i, state))
        continue;
      const SpaceJointFrame frame = joint_frame(face, state.nodes.data());
      const auto gaps             = gaps_since_placing(joints, i, state);
      const auto in_plane         = [&](const double s, const double t)
      { return s * frame.s + t * frame.t; };
      fields.joint_set.push_back(face.set);
      fields.normal.push_back(frame.n);
      fields.area.push_back(3. * face.area);
      for (unsigned int k = 0; k < 3; ++k)
      {
        const unsigned int p   = 3 * i + k;
        const NodeRecord<3> &a = state.nodes[face.lower[k]];
        const NodeRecord<3> &b = state.nodes[face.upper[k]];
        dealii::Tensor<1, 3> earlier;
        if (is_moved)
          earlier = 0.5
                    * (origin->displacement[face.lower[k]]
                       + origin->displacement[face.upper[k]]);
        fields.position.push_back(a.X + 0.5 * (b.X - a.X) + earlier);
        fields.displacement.push_back(0.5 * (a.u + b.u) - earlier);
        if (is_moved)
          fields.earlier_displacement.push_back(earlier);
        fields.opening.push_back(gaps[k][0]);
        const double slipped[]
            = { slip_at_origin(state, p, 0), slip_at_origin(state, p, 1) };
        fields.slip.push_back(
            in_plane(gaps[k][1] - slipped[0], gaps[k][2] - slipped[1]));
        if (slips_later)
          fields.earlier_slip.push_back(in_plane(slipped[0], slipped[1]));
        fields.normal_traction.push_back(history.normal_traction[p]);
        fields.shear_traction.push_back(in_plane(
            history.shear_traction[2 * p], history.shear_traction[2 * p + 1]));
        for (auto &[name, values] : fields.of_laws)
          values.push_back(law_field(joints, name, p, history));
        fields.state.push_back(state_since_origin(state, p));
      }
    }
    return fields;
  }

  JointFields contact_fields(const MatchedJoints &joints,
                             const BlockContacts &contacts,
                             const State<2> &state)
  {
    JointFields fields;
    for (const std::string &name : law_field_names(joints))
      fields.of_laws.push_back({ name, {} });
    const ContactState &all   = state.get<ContactState>();
    const auto &pairs         = all.pairs;
    const ContactEdges &edges = contacts.contact_edges();
    const auto *origin        = state.find<ResultOrigin<2>>();
    const bool is_moved       = origin && !origin->displacement.empty();
    for (unsigned int i = 0; i < pairs.size(); ++i)
    {
      Contact contact;
      if (!edges.is_own(pairs[i].lower)
          || !contacts.near_pairs().contact(all, i, contact))
        continue;
      fields.joint_set.push_back(contact.set);
      fields.handed_over.push_back(pairs[i].was_joint);
      for (unsigned int k = 0; k < 2; ++k)
      {
        fields.position.emplace_back(contact.reference[k]);
        fields.displacement.push_back(
            0.5 * (contact.lower[k] + contact.upper[k]) - contact.reference[k]);
        if (is_moved)
        {
          // That of the lower edge, along which it is linear.
          const unsigned int own    = edges.own_place(pairs[i].lower);
          const auto &[first, last] = edges.local_nodes()[own];
          const auto &[begin, end]  = edges.own()[own].points;
          const double share
              = (contact.reference[k] - dealii::Tensor<1, 2>(begin))
                * (end - begin) / begin.distance_square(end);
          const dealii::Tensor<1, 2> earlier
              = (1. - share) * origin->displacement[first]
                + share * origin->displacement[last];
          fields.earlier_displacement.push_back(earlier);
          fields.position.back() += earlier;
          fields.displacement.back() -= earlier;
        }
        fields.opening.push_back(contact.opening[k]);
        fields.slip.push_back(contact.slip[k]);
        fields.normal_traction.push_back(pairs[i].points[k].normal_traction);
        fields.shear_traction.push_back(pairs[i].points[k].shear_traction);
        for (auto &[name, values] : fields.of_laws)
          values.push_back(
              law_field(joints, name, contact.set, pairs[i].points[k]));
        fields.state.push_back(pairs[i].points[k].state);
      }
    }
    return fields;
  }

  BoundaryState boundary_state(const FarField &far, const State<2> &state)
  {
    const FarField::TotalFields fields = far.total_fields(state);
    BoundaryState result{
      fields.displacement, fields.velocity, fields.traction, {}
    };
    result.hoop_stress
        = TangentialStress(far.domain().boundary, far.domain().medium)(
            result.displacement, result.traction);
    return result;
  }

  BoundaryFields boundary_fields(const BoundaryGeometry &geometry,
                                 const BoundaryState &state)
  {
    BoundaryFields fields;
    for (unsigned int e = 0; e < geometry.boundary.n_elements(); ++e)
    {
      const BoundaryElement &element = geometry.boundary.elements[e];
      fields.a.push_back(element.a);
      fields.b.push_back(element.b);
      fields.boundary.push_back(std::int32_t(geometry.owner[e]));
      fields.displacement.push_back(vector_at(state.displacement, e));
      fields.velocity.push_back(vector_at(state.velocity, e));
      fields.traction.push_back(vector_at(state.traction, e));
      fields.hoop_stress.push_back(state.hoop_stress[e]);
    }
    return fields;
  }

  template <int dim>
  double bytes_of_fields(const Model<dim> &model)
  {
    // Bytes of the arrays of BlockOutput and JointOutput.
    constexpr double of_node = 3 * 3 * 8,
                     of_cell = (dim == 2 ? 4 + 3 : 6 + 6) * 8
                               + dim * (1 + 3) * 8 + 2 * 4 + (dim + 1) * 4 + 4
                               + 1;
    constexpr double of_plastic_cell = 4 + 8;
    constexpr double of_files        = 5000.; // XML
    const double n_cells             = model.nodes().cells().size();
    double bytes
        = of_files + of_node * model.nodes().n_owned() + of_cell * n_cells;
    if (model.blocks().cell_data().is_plastic())
      bytes += of_plastic_cell * n_cells;
    if constexpr (dim == 2)
    {
      const double of_joint_point
          = 2 * 3 * 8 + 5 * 8 + 1 + 8 * law_field_names(model.joints()).size();
      constexpr double of_joint = 1 + 4 + 1 + 8 + 2 * 4 + 4 + 1;
      const auto &faces         = model.nodes().faces().joints;
      for (unsigned int i = 0; i < model.joints().segments().size(); ++i)
        if (faces[model.joints().segments()[i].face].is_own[0])
          bytes += of_joint + 2. * of_joint_point;
    }
    else
    {
      const double of_joint_point
          = (2 + 1 + 3 + 1 + 3) * 8 + 8 * 3 + 1
            + 8 * law_field_names(model.joints()).size();
      constexpr double of_joint = 1 + 4 + 4 * 8 + 3 * 4 + 4 + 1;
      const auto &faces         = model.nodes().faces().joints;
      for (const SpaceJointFace &face : model.joints().faces())
        if (faces[face.face].is_own[0])
          bytes += of_joint + 3. * of_joint_point;
    }
    return dealii::Utilities::MPI::sum(bytes, model.nodes().communicator());
  }

  template BlockFields<2> block_fields(const Model<2> &, const State<2> &);
  template double bytes_of_fields(const Model<2> &);
  template BlockFields<3> block_fields(const Model<3> &, const State<3> &);
  template double bytes_of_fields(const Model<3> &);
} // namespace quoin
