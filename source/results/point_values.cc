// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/field_output.h>
#include <quoin/base/constants.h>
#include <quoin/blocks/cell_states.h>
#include <quoin/block_elements/triangle.h>
#include <quoin/contact/face_contacts.h>
#include <quoin/contact/law_fields.h>
#include <quoin/joint_elements/joint_changes.h>
#include <quoin/results/block_output.h>
#include <quoin/results/point_values.h>
#include <quoin/results/result_origin.h>
#include <quoin/water/joint_flow.h>

#include <array>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    template <int dim>
    double yield_value(const Model<dim> &model, const unsigned int component,
                       const unsigned int cell, const State<dim> &state)
    {
      if (cell >= model.nodes().cells().n_deformable
          || !model.blocks().cell_data().law_of(cell))
        return 0.;
      const auto point
          = cell_history(model.blocks(), state.nodes.data(),
                         state.template get<PlasticHistory>(), cell);
      return component == 0 ? point.state : point.plastic_shear;
    }

    /** As joint_value() of what is no gap, of a joint that has become a
        contact. */
    double contact_value(const Model<2> &model, const unsigned int component,
                         const unsigned int p, const State<2> &state)
    {
      const FaceContact contact = contact_on_face(
          *model.contacts(), state, model.joints().segments()[p / 2], p % 2);
      if (component == 4)
        return static_cast<double>(contact.state());
      if (component < 4)
        return !contact.point   ? 0.
               : component == 2 ? contact.point->normal_traction
                                : contact.point->shear_traction;
      const std::string name = component == 5 ? "damage" : "crushing";
      return contact.point
                 ? law_field(model.joints(), name, contact.set, *contact.point)
                 : law_field(model.joints(), name, p,
                             state.get<JointHistory>());
    }

    double joint_value(const Model<2> &model, const unsigned int component,
                       const unsigned int p, const State<2> &state)
    {
      const JointHistory &history = state.get<JointHistory>();
      if (component >= 2 && model.contacts() && history.handed_over[p / 2])
        return contact_value(model, component, p, state);
      if (component < 2)
        return gaps_since_placing(model.joints(), p / 2,
                                  state)[p % 2][component];
      if (component == 2)
        return history.normal_traction[p];
      if (component == 3)
        return history.shear_traction[p];
      if (component == 4)
        return static_cast<double>(state_since_origin(state, p));
      if (component >= 7)
      {
        const JointFlowState *water = state.find<JointFlowState>();
        return water ? flow_value(model, *water, p, component - 7) : 0.;
      }
      return law_field(model.joints(), component == 5 ? "damage" : "crushing",
                       p, history);
    }

    double joint_value(const Model<3> &model, const unsigned int component,
                       const unsigned int p, const State<3> &state)
    {
      const SpaceJoints &joints        = model.joints();
      const SpaceJointFace &face       = joints.faces()[p / 3];
      const SpaceJointHistory &history = state.get<SpaceJointHistory>();
      SpaceJointGap gap = gaps_since_placing(joints, p / 3, state)[p % 3];
      for (const unsigned int d : { 0, 1 })
        gap[1 + d] -= slip_at_origin(state, p, d);
      switch (component)
      {
      case 0:
        return gap[0];
      case 1:
        return std::hypot(gap[1], gap[2]);
      case 2:
        return history.normal_traction[p];
      case 3:
        return std::hypot(history.shear_traction[2 * p],
                          history.shear_traction[2 * p + 1]);
      case 4:
        return static_cast<double>(state_since_origin(state, p));
      case 5:
      case 6:
        return law_field(joints, component == 5 ? "damage" : "crushing", p,
                         history);
      default:
      {
        const SpaceJointFrame frame = joint_frame(face, state.nodes.data());
        return gap[1] * frame.s[component - 7]
               + gap[2] * frame.t[component - 7];
      }
      }
    }

    /** Rotation of a local cell [rad]. */
    double rotation(const Model<2> &model, const unsigned int cell,
                    const State<2> &state)
    {
      const auto &nodes = model.nodes().cells().nodes[cell];
      if (cell >= model.nodes().cells().n_deformable)
      {
        const RigidBlocks &rigid = model.rigid_blocks();
        unsigned int b           = 0;
        while (rigid.block(b).end <= nodes[0])
          ++b;
        return state.get<RigidBlockStates>()[b].rotation;
      }
      const NodeRecord<2> &a = state.nodes[nodes[0]],
                          &b = state.nodes[nodes[1]],
                          &c = state.nodes[nodes[2]];
      const CorotatedStrain strain(Triangle(a, b, c).gradient(a.u, b.u, c.u));
      return std::atan2(strain.s, strain.c);
    }
  } // namespace

  template <int dim>
  std::vector<unsigned int> blocks_at(const Model<dim> &model,
                                      const HistoryParameters &wanted,
                                      const HistoryPoint &point)
  {
    if (!point.nodes.empty())
      return { model.nodes().block_of_node(point.nodes.front().first) };
    if (!point.here)
      return {};
    switch (wanted.quantity)
    {
    case HistoryQuantity::stress:
    case HistoryQuantity::principal_stress:
    case HistoryQuantity::yielding:
    case HistoryQuantity::rotation:
      return { model.nodes().blocks().block_of_cell(point.entity) };
    case HistoryQuantity::joint:
    {
      unsigned int face;
      if constexpr (dim == 2)
        face = model.joints().segments()[point.entity / 2].face;
      else
        face = model.joints().faces()[point.entity / 3].face;
      const auto &blocks = model.nodes().faces().joints[face].blocks;
      return { blocks.begin(), blocks.end() };
    }
    default:
      return {};
    }
  }

  template <int dim>
  double point_value(const Model<dim> &model, const HistoryParameters &wanted,
                     const HistoryPoint &point, const State<dim> &state)
  {
    bool is_absent = false;
    for (const unsigned int block : blocks_at(model, wanted, point))
    {
      is_absent = is_absent || state.is_absent(block);
      if (is_absent && state.block_marks[block] == block_mark::removed)
        return std::numeric_limits<double>::quiet_NaN();
    }
    if (is_absent)
      return 0.;
    switch (wanted.quantity)
    {
    case HistoryQuantity::displacement:
    case HistoryQuantity::velocity:
    {
      double sum = 0.;
      for (const auto &[node, weight] : point.nodes)
        sum += weight
               * (wanted.quantity == HistoryQuantity::displacement
                      ? state.nodes[node].u[wanted.component]
                      : state.velocity[node][wanted.component]);
      return sum;
    }
    case HistoryQuantity::stress:
    case HistoryQuantity::principal_stress:
    {
      if (point.entity >= model.nodes().cells().n_deformable)
        return 0.;
      const auto stress
          = cell_stress(model.blocks(), state.nodes.data(),
                        state.template get<PlasticHistory>(), point.entity);
      if (wanted.quantity == HistoryQuantity::principal_stress)
        return principal_stress(stress).value[wanted.component];
      // Index from the order xx, yy, xy, zz, xz, yz.
      constexpr std::array<unsigned int, 6> in_space = { 0, 1, 3, 2, 4, 5 };
      return stress[dim == 2 ? wanted.component : in_space[wanted.component]];
    }
    default:
      break;
    }
    if (wanted.quantity == HistoryQuantity::joint)
      return joint_value(model, wanted.component, point.entity, state);
    if (wanted.quantity == HistoryQuantity::yielding)
      return yield_value(model, wanted.component, point.entity, state);
    if constexpr (dim == 2)
      if (wanted.quantity == HistoryQuantity::rotation)
        return rotation(model, point.entity, state) / constants::degree;
    return 0.;
  }

  template std::vector<unsigned int>
  blocks_at(const Model<2> &, const HistoryParameters &, const HistoryPoint &);
  template std::vector<unsigned int>
  blocks_at(const Model<3> &, const HistoryParameters &, const HistoryPoint &);
  template double point_value(const Model<2> &, const HistoryParameters &,
                              const HistoryPoint &, const State<2> &);
  template double point_value(const Model<3> &, const HistoryParameters &,
                              const HistoryPoint &, const State<3> &);
} // namespace quoin
