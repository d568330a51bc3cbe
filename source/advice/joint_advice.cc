// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/advice/joint_advice.h>
#include <quoin/base/known_names.h>
#include <quoin/parameters/plausibility.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace quoin
{
  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    template <int dim>
    bool is_in_set(const JointNodes<dim> &face, const JointSetParameters &set,
                   const BlockTable<dim> &table)
    {
      return is_among(table.joint_name(face.name), set.curves);
    }

    /** Whether the set is for joints that appear or change later. */
    bool is_for_later(const JointSetParameters &set,
                      const std::vector<StageParameters> &stages)
    {
      const auto takes = [&](const StageParameters &stage)
      {
        return std::any_of(
            stage.joint_properties.begin(), stage.joint_properties.end(),
            [&](const auto &pair) { return pair.second == set.name; });
      };
      return set.all_new_contacts || !set.new_contacts.empty()
             || std::any_of(stages.begin(), stages.end(), takes);
    }

    /** Diagonal of the box around each block [m]. Collective. */
    template <int dim>
    std::vector<double> block_sizes(const NodeMap<dim> &nodes)
    {
      // Upper corners have the other sign, so that one minimum finds both.
      const unsigned int n_blocks = nodes.table().n_blocks();
      std::vector<double> box(2 * dim * n_blocks, infinity);
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
        {
          double *corners = &box[2 * dim * nodes.block_of_node(i) + d];
          corners[0]      = std::min(corners[0], nodes.point(i)[d]);
          corners[dim]    = std::min(corners[dim], -nodes.point(i)[d]);
        }
      dealii::Utilities::MPI::min(box, nodes.communicator(), box);
      std::vector<double> sizes;
      for (unsigned int b = 0; b < n_blocks; ++b)
      {
        double square = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          square
              += std::pow(box[2 * dim * b + d] + box[2 * dim * b + dim + d], 2);
        sizes.push_back(std::sqrt(square));
      }
      return sizes;
    }

    /** Whether strength drops where the joint fails. */
    bool is_brittle(const JointLaw &law)
    {
      return std::visit([](const auto &own)
                        { return std::decay_t<decltype(own)>::is_brittle; },
                        law);
    }

    /** Cells and blocks beside the joints of a set. */
    struct Neighbours
    {
      bool exist           = false;
      double stiffest_cell = 0.; /**< E by shortest edge [Pa/m] */
      /** E of the softest and of the stiffest block by the size of it or, if it
          is smaller, of the block beyond the joint [Pa/m]. */
      double softest_block = infinity, stiffest_block = 0.;
      double softest_whole = infinity; /**< E by size of the block [Pa/m] */
      unsigned int softest_material = 0;
      double softest = infinity, stiffest = 0.; /**< E [Pa] */
    };

    /** Collective. */
    template <int dim>
    Neighbours neighbours(const JointSetParameters &set,
                          const std::vector<MaterialParameters> &materials,
                          const Model<dim> &model)
    {
      namespace MPI = dealii::Utilities::MPI;
      // Boxes of blocks include the parts on all ranks.
      const NodeMap<dim> &nodes = model.nodes();
      const auto sizes          = block_sizes(nodes);
      Neighbours result;
      std::vector<double> softest(materials.size(), infinity);
      for (const JointNodes<dim> &face : nodes.faces().joints)
      {
        if (!is_in_set(face, set, model.nodes().table()))
          continue;
        result.exist = true;
        for (unsigned int side = 0; side < 2; ++side)
        {
          const unsigned int cell = face.cells[side];
          if (!face.is_own[side]
              || materials[material_of_cell(model, cell)].rigid)
            continue;
          const unsigned int material = material_of_cell(model, cell);
          const double young          = materials[material].elastic.young;
          const auto &corners         = nodes.cells().nodes[cell];
          double shortest             = infinity;
          for (unsigned int k = 0; k <= dim; ++k)
            for (unsigned int l = 0; l < k; ++l)
              shortest = std::min(
                  shortest,
                  nodes.point(corners[k]).distance(nodes.point(corners[l])));
          result.softest  = std::min(result.softest, young);
          result.stiffest = std::max(result.stiffest, young);
          result.stiffest_cell
              = std::max(result.stiffest_cell, young / shortest);
          // As far as the smaller block reaches, a joint deforms the larger.
          const double by_block
              = young / std::min(sizes[face.blocks[0]], sizes[face.blocks[1]]);
          result.softest_whole  = std::min(result.softest_whole,
                                           young / sizes[face.blocks[side]]);
          softest[material]     = std::min(softest[material], by_block);
          result.stiffest_block = std::max(result.stiffest_block, by_block);
        }
      }
      const MPI_Comm all    = nodes.communicator();
      result.exist          = MPI::logical_or(result.exist, all);
      result.stiffest_cell  = MPI::max(result.stiffest_cell, all);
      result.stiffest_block = MPI::max(result.stiffest_block, all);
      result.softest        = MPI::min(result.softest, all);
      result.stiffest       = MPI::max(result.stiffest, all);
      result.softest_whole  = MPI::min(result.softest_whole, all);
      MPI::min(softest, all, softest);
      const auto least     = std::min_element(softest.begin(), softest.end());
      result.softest_block = *least;
      result.softest_material = least - softest.begin();
      return result;
    }

    /** Warns of a material whose blocks are too soft for the implicit solver
        beside joints of normal stiffness @p kn that do for other blocks: by
        more than @p limit times their E/L. Where all have the same modulus
        blocks are large, not soft. Whether it warns. */
    bool check_soft_block(const JointSetParameters &set, const double kn,
                          const double limit, const Neighbours &beside,
                          const MaterialParameters &material, Advice &advice)
    {
      const bool is_soft = material.elastic.young < beside.stiffest
                           && kn > limit * beside.softest_block
                           && kn <= limit * beside.stiffest_block;
      Checks(advice, "material " + material.name + ": ")
          .warn_if(
              is_soft, "E/L of its softest block beside joints of the set ",
              set.name, " is ", beside.softest_block,
              " Pa/m, of which their normal stiffness, ", kn, " Pa/m, is ",
              kn / beside.softest_block, " times, and ",
              kn / beside.stiffest_block,
              " times that of other blocks: the block is soft, not the joints "
              "stiff, and the run may not finish. Check its Young's modulus, "
              "or give its joints a set of their own with ten times its E/L, ",
              10. * beside.softest_block, " Pa/m.");
      return is_soft;
    }

    /** Whether @p curve is one of the mesh and no joint, although others are
        made joints by name. Collective. */
    template <int dim>
    bool is_left_out(const std::string &curve, const Parameters &parameters,
                     const NodeMap<dim> &nodes)
    {
      const auto &made  = parameters.split.joints_along;
      const auto &names = nodes.table().face_names;
      if (made.empty() || is_among(curve, made) || !is_among(curve, names))
        return false;
      const auto &joints  = nodes.faces().joints;
      const bool is_joint = std::any_of(joints.begin(), joints.end(),
                                        [&](const JointNodes<dim> &joint)
                                        { return names[joint.name] == curve; });
      return dealii::Utilities::MPI::max(unsigned(is_joint),
                                         nodes.communicator())
             == 0;
    }
  } // namespace

  template <int dim>
  void check_joints(const Parameters &parameters, const Model<dim> &model,
                    Advice &advice)
  {
    /** Normal stiffness of joints by E/h of the cells beside. */
    constexpr double stiff = 100.;
    /** Upper limit by E/L of blocks: with their displacement in double
        precision six digits of the closure of a joint are left. */
    constexpr double rigid = 1e10;
    /** Upper limits by E/L of blocks where joints fail step by step: six
        bricks with brittle joints took 0.7 s at 0.7, 3 s at 25 and from 50 on
        did not end; walls of composite joints end at 140. */
    constexpr double slow_if_brittle = 30., slow = 1000.;
    /** Lower limit by E/L of the blocks beside. */
    constexpr double soft = 1e-3;
    for (const JointSetParameters &set : parameters.model.joints)
    {
      Checks checks(advice, "joints " + set.name + ": ");
      const Neighbours beside
          = neighbours(set, parameters.model.materials, model);
      checks.warn_if(!beside.exist && !set.curves.empty()
                         && !is_for_later(set, parameters.stages),
                     "there are none on its ",
                     dim == 2 ? "curves: they act on nothing. Name the curves"
                              : "surfaces: they act on nothing. Name these",
                     " in 'Joints along' of section 'Mesh', or remove the "
                     "set.");
      if (beside.exist && !is_for_later(set, parameters.stages))
        for (const std::string &curve : set.curves)
          checks.warn_if(is_left_out(curve, parameters, model.nodes()),
                         "there are none on its ",
                         dim == 2 ? "curve " : "surface ", curve,
                         ", which is missing in 'Joints along' of section "
                         "'Mesh': what lies beside it is one block. Name it "
                         "there, or leave it out here.");
      // Where a block is in doubt it is said of the block.
      if (!beside.exist || beside.softest < softest_modulus)
        continue;
      const double kn      = stiffness_bound(set.law)[0];
      const double by_cell = kn / beside.stiffest_cell;
      // For rock joints it is a bound that few of them approach.
      checks.warn_if(!parameters.is_implicit && !stiffens(set.law)
                         && beside.stiffest_cell > 0. && by_cell > stiff,
                     "the normal stiffness ", kn, " Pa/m is ", by_cell,
                     " times E/h of the smallest ",
                     dim == 2 ? "triangles" : "tetrahedra",
                     " beside them: the joints, not the blocks, make the "
                     "time step short, by a factor of about ",
                     std::sqrt(by_cell),
                     ". Unless it was measured take some ten times E/h, ",
                     10. * beside.stiffest_cell, " Pa/m.");
      const double by_block = kn / beside.softest_block;
      const double limit    = is_brittle(set.law) ? slow_if_brittle : slow;
      const bool is_block
          = parameters.is_implicit && can_fail(set.law)
            && check_soft_block(
                set, kn, limit, beside,
                parameters.model.materials[beside.softest_material], advice);
      checks.warn_if(
          parameters.is_implicit && can_fail(set.law) && by_block <= rigid
              && by_block > limit && !is_block,
          "the normal stiffness ", kn, " Pa/m is ", by_block,
          " times E/L of the softest block beside them: as one point fails, "
          "the next ones take over its load within a very small "
          "displacement, steps are reduced, and the run may not finish. "
          "Unless the stiffness was measured, take ten times E/L, ",
          10. * beside.softest_block,
          " Pa/m, which adds a tenth to the compliance of blocks, or the "
          "explicit solver.");
      checks.warn_if(
          parameters.is_implicit && kn > rigid * beside.softest_block,
          "the normal stiffness ", kn, " Pa/m is ", kn / beside.softest_block,
          " times E/L of the softest block beside them: what closes them is "
          "lost in the rounding of its displacements, and no equilibrium may "
          "be found. Take ",
          1e4 * beside.softest_block, " Pa/m or less.");
      checks.warn_if(
          kn >= softest_joint && kn < soft * beside.softest_whole
              && std::isfinite(beside.softest_whole),
          "the normal stiffness ", kn,
          " Pa/m is less than a thousandth of E/L of the blocks beside "
          "them, ",
          beside.softest_whole, " Pa/m: blocks hardly deform. Check its unit",
          dim == 2 ? ", or make the blocks rigid, which takes far fewer steps."
                   : ".");
    }
  }

  template void check_joints(const Parameters &, const Model<2> &, Advice &);
  template void check_joints(const Parameters &, const Model<3> &, Advice &);
} // namespace quoin
