// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/point_text.h>
#include <quoin/loading/constraint_checks.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/model/block_placement.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace quoin
{
  template <int dim>
  void
  refuse_absent_nodes(const Model<dim> &model,
                      const std::vector<MotionConstraint<dim> *> &constraints,
                      const StageParameters &stage, const State<dim> &state)
  {
    const auto absent = absent_nodes(model, state);
    for (const MotionConstraint<dim> *constraint : constraints)
    {
      if (constraint->traits().kind == MotionKind::prescribed)
        continue;
      unsigned int first = NodeMap<dim>::none;
      for (const unsigned int node : constraint->nodes())
        if (absent[node])
          first = std::min(first, node);
      dealii::Point<dim> p;
      if (!first_point(model.nodes(), first, p))
        continue;
      throw InputError(
          "section 'Stages/" + stage.name + "': the load '" + constraint->name()
          + "' moves the node at " + point_text(p)
          + " m, but the block there is excavated or not placed yet. Of loads "
            "that move nodes only prescribed motions leave such blocks alone: "
            "take the load out of this stage, or let it end where the blocks "
            "do.");
    }
  }

  std::vector<bool>
  find_held_blocks(const Model<2> &model,
                   const std::vector<MotionConstraint<2> *> &constraints,
                   const StageParameters &stage)
  {
    constexpr unsigned int none = NodeMap<2>::none;
    const RigidBlocks &rigid    = model.rigid_blocks();
    std::vector<bool> held(rigid.n_blocks(), false);
    for (const MotionConstraint<2> *constraint : constraints)
    {
      const auto &nodes  = constraint->nodes();
      unsigned int wrong = none;
      for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
      {
        const RigidBlocks::Block &block = rigid.block(b);
        const auto first
            = std::lower_bound(nodes.begin(), nodes.end(), block.begin);
        const auto last = std::lower_bound(first, nodes.end(), block.end);
        if (first == last)
          continue;
        if (constraint->traits().is_rigid_body()
            && last - first == block.end - block.begin)
          held[b] = true;
        else if (wrong == none)
          wrong = *first;
      }
      dealii::Point<2> p;
      if (!first_point(model.nodes(), wrong, p))
        continue;
      throw InputError(
          "section 'Stages/" + stage.name + "': the load '" + constraint->name()
          + "' moves the node at " + point_text(p)
          + " m by itself, but its block is rigid. Hold or drive rigid blocks "
            "as a whole, by a load with 'Type = platen' and their 'Group', or "
            "make the block deformable.");
    }
    return held;
  }

  namespace
  {
    /** Whether @p a and @p b move a common node of any rank, the first of which
        is at @p p. Collective. */
    template <int dim>
    bool share_node(const Model<dim> &model, const MotionConstraint<dim> &a,
                    const MotionConstraint<dim> &b, dealii::Point<dim> &p)
    {
      std::vector<unsigned int> shared;
      std::set_intersection(a.nodes().begin(), a.nodes().end(),
                            b.nodes().begin(), b.nodes().end(),
                            std::back_inserter(shared));
      return first_point(model.nodes(),
                         shared.empty() ? NodeMap<dim>::none : shared.front(),
                         p);
    }
  } // namespace

  template <int dim>
  void
  refuse_shared_platens(const Model<dim> &model,
                        const std::vector<MotionConstraint<dim> *> &constraints,
                        const StageParameters &stage)
  {
    for (const MotionConstraint<dim> *a : constraints)
      for (const MotionConstraint<dim> *b : constraints)
      {
        if (a == b || !a->traits().is_rigid_body()
            || !b->traits().is_rigid_body())
          continue;
        dealii::Point<dim> p;
        if (!share_node(model, *a, *b, p))
          continue;
        throw InputError("section 'Stages/" + stage.name + "': the platens '"
                         + a->name() + "' and '" + b->name()
                         + "' share the node at " + point_text(p)
                         + " m. A node can belong to one rigid platen: use one "
                           "of them, or leave a gap.");
      }
  }

  template <int dim>
  std::string
  lost_motion_text(const Model<dim> &model,
                   const std::vector<MotionConstraint<dim> *> &constraints)
  {
    const std::array<std::string, 3> names
        = { "Horizontal", dim == 2 ? "Vertical" : "Lateral", "Vertical" };
    for (const MotionConstraint<dim> *platen : constraints)
      for (const MotionConstraint<dim> *motion : constraints)
      {
        if (!platen->traits().is_rigid_body()
            || motion->traits().kind != MotionKind::prescribed)
          continue;
        dealii::Point<dim> p;
        if (!share_node(model, *platen, *motion, p))
          continue;
        for (unsigned int d = 0; d < dim; ++d)
          if (motion->traits().holds[d] && !platen->traits().holds[d])
            return "the platen '" + platen->name() + "' moves the node at "
                   + point_text(p) + " m and others for which '"
                   + motion->name() + "' prescribes '" + names[d]
                   + "' as well, and its own '" + names[d]
                   + "' is not prescribed: what '" + motion->name()
                   + "' says there is lost, and it supports nothing there. "
                     "Prescribe '"
                   + names[d]
                   + "' of the platen too, e.g. 'velocity 0', or let one of "
                     "them leave these nodes to the other.";
      }
    return "";
  }

  template std::string
  lost_motion_text(const Model<2> &,
                   const std::vector<MotionConstraint<2> *> &);
  template std::string
  lost_motion_text(const Model<3> &,
                   const std::vector<MotionConstraint<3> *> &);
  template void refuse_absent_nodes(const Model<2> &,
                                    const std::vector<MotionConstraint<2> *> &,
                                    const StageParameters &, const State<2> &);
  template void refuse_absent_nodes(const Model<3> &,
                                    const std::vector<MotionConstraint<3> *> &,
                                    const StageParameters &, const State<3> &);
  template void
  refuse_shared_platens(const Model<2> &,
                        const std::vector<MotionConstraint<2> *> &,
                        const StageParameters &);
  template void
  refuse_shared_platens(const Model<3> &,
                        const std::vector<MotionConstraint<3> *> &,
                        const StageParameters &);
} // namespace quoin
