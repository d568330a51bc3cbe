// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/advice/support_advice.h>
#include <quoin/base/known_names.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/base/point_text.h>
#include <quoin/loads/load_field.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/signals/signal_frequency.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    constexpr double far_away = std::numeric_limits<double>::infinity();

    std::string bar_text(const BarEnds &ends)
    {
      return "the bar from " + point_text(ends[0]) + " to "
             + point_text(ends[1]) + " m ";
    }

    /** Distance of each of @p points from the nearest joint of any rank [m].
        Collective. */
    std::vector<double>
    distances_to_joints(const NodeMap<2> &nodes,
                        const std::vector<dealii::Point<2>> &points)
    {
      std::vector<double> least(points.size(), far_away);
      for (const JointNodes<2> &joint : nodes.faces().joints)
        for (std::size_t i = 0; i < points.size(); ++i)
          least[i] = std::min(least[i],
                              distance_to_segment(points[i],
                                                  nodes.point(joint.lower[0]),
                                                  nodes.point(joint.lower[1])));
      dealii::Utilities::MPI::min(least, nodes.communicator(), least);
      return least;
    }

    /** Warns of elements of a bar that are too long for the forces in it. */
    void check_elements(const CableParameters &cable, Checks &checks)
    {
      const double decay
          = std::sqrt(cable.law.stiffness / cable.law.bond_stiffness);
      checks.warn_if(cable.law.bond_stiffness > 0.
                         && cable.element_length > decay,
                     "its force falls by the factor e over ", decay,
                     " m of bond, sqrt(E A / bond stiffness), and its elements "
                     "are up to ",
                     cable.element_length,
                     " m long: lower 'Element length' to a third of that.");
    }

    /** Warns of friction of a bond in blocks without stress. */
    void check_bond_friction(const std::vector<const PlacedBar *> &bars,
                             const std::vector<bool> &is_rigid, Checks &checks)
    {
      for (const PlacedBar *bar : bars)
        for (unsigned int i = 0; i < bar->hosts.size(); ++i)
        {
          if (bar->law.bond_friction == 0. || bar->chain.bond[i] == 0.
              || !is_rigid[bar->hosts[i].block])
            continue;
          checks.warn_if(
              true,
              "'Bond friction angle' adds nothing in rigid blocks, which have "
              "no stress to press on the bond, such as at ",
              point_text(bar->hosts[i].X),
              " m: it has its 'Bond strength' alone there. Give one with the "
              "share of friction in it, or make the blocks deformable.");
          return;
        }
    }
  } // namespace

  void check_bars(const Model<2> &model, Advice &advice)
  {
    const std::vector<CableParameters> &cables
        = model.reinforcement().sections();
    std::vector<dealii::Point<2>> far_ends;
    for (const BarEnds &ends : all_bars(cables))
      far_ends.push_back(ends[1]);
    if (far_ends.empty())
      return;
    const auto distances  = distances_to_joints(model.nodes(), far_ends);
    std::size_t first_end = 0;
    for (unsigned int c = 0; c < cables.size(); ++c)
    {
      const CableParameters &cable = cables[c];
      std::vector<const PlacedBar *> bars;
      for (const PlacedBar &bar : model.reinforcement().all())
        if (bar.cable == c)
          bars.push_back(&bar);
      Checks checks(advice, "reinforcement " + cable.name + ": ");
      check_elements(cable, checks);
      check_bond_friction(bars, model.nodes().table().is_rigid, checks);

      const auto shortest = std::min_element(
          bars.begin(), bars.end(),
          [](const PlacedBar *a, const PlacedBar *b)
          { return a->longest_active_length < b->longest_active_length; });
      const double longest = (*shortest)->longest_active_length;
      const double wanted  = cable.law.active_length / (1. + 1e-9);
      const auto n_cut
          = std::count_if(bars.begin(), bars.end(),
                          [&](const PlacedBar *bar)
                          { return bar->longest_active_length < wanted; });
      checks.warn_if(
          n_cut > 0, "'Active length = ", cable.law.active_length,
          "' finds no room in ", n_cut, " of ", count_text(bars.size(), "bar"),
          ", least in ", bar_text(cable.bars[shortest - bars.begin()]),
          "with too little bond between two joints, or between a joint and its "
          "end: the length is cut there, and the bar stiffer across the joint. "
          "The longest that all have room for is ",
          longest,
          " m. Give that or less, or lengthen bars that are meant to "
          "hold what is beyond that joint.");

      const double length = cable.bars[0][0].distance(cable.bars[0][1]);
      for (unsigned int b = 0; b < bars.size(); ++b)
      {
        const auto &crossings = bars[b]->crossings;
        const auto free
            = std::find_if(crossings.begin(), crossings.end(),
                           [&](const dealii::Point<2> &place) {
                             return place.distance(cable.bars[b][0])
                                    < (1. - 1e-6) * cable.free_length;
                           });
        if (cable.law.plate_stiffness == 0. && free != crossings.end())
        {
          checks.warn_if(true, "the free length of ", bar_text(cable.bars[b]),
                         "crosses the joint at ", point_text(*free),
                         " m, and its head has no plate: the bar bears nothing "
                         "there. Give 'Plate stiffness', or shorten 'Free "
                         "length'.");
          break;
        }
      }
      bool ends_in_joint = false;
      for (unsigned int b = 0; b < bars.size(); ++b)
        if (distances[first_end + b] < 1e-6 * length)
        {
          ends_in_joint = true;
          checks.warn_if(true, bar_text(cable.bars[b]),
                         "ends in a joint, which it does not cross: it bears "
                         "nothing of what moves there. Let it reach into the "
                         "block beyond by the length of bond that it needs, or "
                         "end before the joint.");
          break;
        }
      // In blocks that yield, bars bear without joints.
      const auto &materials = model.properties().materials;
      checks.warn_if(
          !ends_in_joint && model.nodes().table().n_blocks() > 1
              && std::none_of(materials.begin(), materials.end(),
                              [](const MaterialParameters &material)
                              { return material.strength.has_value(); })
              && std::all_of(bars.begin(), bars.end(),
                             [](const PlacedBar *bar)
                             { return bar->crossings.empty(); }),
          bar_text(cable.bars[0]), bars.size() == 1 ? "" : "and all others ",
          bars.size() == 1 ? "crosses" : "cross",
          bars.size() == 1 ? " no joint but lies" : " no joint but lie",
          " within a block: nothing there moves apart that it could hold. Let "
          "it reach into the block beyond the joint that it is meant for.");
      first_end += bars.size();
    }
  }

  namespace
  {
    /** Whether the pressure of @p load and water of section 'Water' are in the
        joints of one curve in a stage. */
    bool doubles_water(const Parameters &parameters, const NodeMap<2> &nodes,
                       const LoadParameters &load, std::string &joints,
                       std::string &stage)
    {
      const auto &names = nodes.table().face_names;
      for (const StageParameters &each : parameters.stages)
        if (names_load(each, load.name) && parameters.water.acts_in(each.name)
            && stage.empty())
          stage = each.name;
      if (parameters.water.flow == FlowKind::none || !load.is_pressure_alone()
          || stage.empty())
        return false;
      std::vector<std::string> wet; // curves
      for (const JointSetParameters &set : parameters.model.joints)
        if (find_named(parameters.water.joints, set.name))
          wet.insert(wet.end(), set.curves.begin(), set.curves.end());
      std::vector<unsigned int> is_wet(names.size(), 0);
      for (const JointNodes<2> &joint : nodes.faces().joints)
        is_wet[joint.name] = is_among(names[joint.name], load.boundaries)
                             && is_among(names[joint.name], wet);
      dealii::Utilities::MPI::max(is_wet, nodes.communicator(), is_wet);
      const auto found = std::find(is_wet.begin(), is_wet.end(), 1U);
      if (found == is_wet.end())
        return false;
      joints = names[found - is_wet.begin()];
      return true;
    }

    /** Distance of each of @p points from @p faces [m]. */
    std::vector<double>
    distances_to_faces(const std::vector<BoundaryFace<2>> &faces,
                       const std::vector<dealii::Point<2>> &points)
    {
      std::vector<double> least(points.size(), far_away);
      for (std::size_t i = 0; i < points.size(); ++i)
        for (const BoundaryFace<2> &face : faces)
          least[i] = std::min(
              least[i],
              distance_to_segment(points[i], face.points[0], face.points[1]));
      return least;
    }

    constexpr const char *heights
        = "Levels are heights y of the mesh: check them and the height of the "
          "model.";

    /** Largest value of @p function in the stages that @p acts holds of;
        infinite without stages. */
    template <typename Acts>
    double highest(const Parameters &parameters, const TimeFunction &function,
                   const Acts &acts)
    {
      double result = -far_away;
      for (unsigned int i = 0; i < parameters.stages.size(); ++i)
      {
        const StageParameters &stage = parameters.stages[i];
        if (!acts(stage))
          continue;
        const double start = start_of_stage(parameters.stages, i);
        const auto value   = [&](const double t) {
          return function({ t, start + t });
        };
        if (stage.end == StageEnd::time)
          result = std::max(result, extremes(value, stage.duration)[1]);
        else
          result = std::max({ result, value(0.), value(late_time) });
      }
      return result == -far_away ? far_away : result;
    }

    void check_uplift(const Parameters &parameters, const LoadParameters &load,
                      const NodeMap<2> &nodes, Advice &advice)
    {
      /** Distance of an end from the joint by its length [-]. */
      constexpr double most = 0.02;
      if (!load.pressure.field || !load.pressure.field->uplift())
        return;
      Checks checks(advice, "load " + load.name + ": ");
      const UpliftDiagram &uplift = *load.pressure.field->uplift();
      std::vector<bool> wanted;
      for (const std::string &name : nodes.table().face_names)
        wanted.push_back(is_among(name, load.boundaries));
      const auto outer = gather_faces(nodes, wanted),
                 all   = gather_faces(nodes, wanted, true);
      checks.warn_if(!outer.empty(), "'Pressure = uplift' acts on ",
                     outer.size() == all.size() ? "" : "joints and on ",
                     "an outer face of 'Boundary', from one side. Name the "
                     "joint below the dam, and give water on outer faces as "
                     "'Pressure = water LEVEL'.");
      const std::vector<dealii::Point<2>> ends{ uplift.heel, uplift.toe };
      const auto distances = distances_to_faces(all, ends);
      for (const unsigned int i : { 0, 1 })
        checks.warn_if(
            distances[i] > most * uplift.length(),
            i == 0 ? "'Heel' at " : "'Toe' at ", point_text(ends[i]),
            " m lies ", distances[i],
            " m away from its 'Boundary': the pressure would be that "
            "of another place. Give the end of the joint.");
      const auto acts = [&](const StageParameters &stage)
      { return names_load(stage, load.name); };
      const double head = highest(parameters, uplift.headwater, acts),
                   tail = highest(parameters, uplift.tailwater, acts);
      checks.warn_if(head < uplift.heel[1], "the headwater of ", head,
                     " m is below the heel, at a height of ", uplift.heel[1],
                     " m, so that there is no pressure",
                     tail < uplift.toe[1] ? "" : " there", ". ", heights);
    }

    /** Warns of a head of @p boundary that is below all places where it is
        given. */
    void check_head(const Parameters &parameters, const WaterBoundary &boundary,
                    const NodeMap<2> &nodes, Advice &advice)
    {
      // With a free surface places above the head are outlets.
      if (boundary.quantity != WaterQuantity::head
          || parameters.water.fluid.has_free_surface)
        return;
      double lowest = boundary.point ? (*boundary.point)[1] : far_away;
      std::vector<bool> wanted;
      for (const std::string &name : nodes.table().face_names)
        wanted.push_back(is_among(name, boundary.curves));
      for (const auto &face : gather_faces(nodes, wanted, true))
        for (const auto &point : face.points)
          lowest = std::min(lowest, point[1]);
      const double head = highest(parameters, boundary.value,
                                  [&](const StageParameters &stage) {
                                    return parameters.water.acts_in(stage.name);
                                  });
      Checks(advice, "water boundary " + boundary.name + ": ")
          .warn_if(
              lowest < far_away && head < lowest, "the head of ", head,
              " m is below its place, whose ",
              boundary.point ? "height is " : "lowest point is at ", lowest,
              " m: the water there has a negative pressure",
              parameters.water.has_suction ? "" : ", which presses on no face",
              ". ", heights,
              " Where water only comes out, give 'Quantity = pressure' and "
              "'Value = 0'.");
    }
  } // namespace

  void check_water(const Parameters &parameters, const NodeMap<2> &nodes,
                   Advice &advice)
  {
    for (const LoadParameters &load : parameters.loads)
    {
      if (load.type != LoadType::traction)
        continue;
      check_uplift(parameters, load, nodes, advice);
      std::string joints, stage;
      if (doubles_water(parameters, nodes, load, joints, stage))
        Checks(advice, "load " + load.name + ": ")
            .warn_if(true, "its 'Pressure' acts in the joints ", joints,
                     " in the stage ", stage,
                     ", in which section 'Water' has water as well: both press "
                     "on their faces, and the water counts twice. Leave one of "
                     "them out, or let 'Stages' of section 'Water' name the "
                     "stages without this load.");
    }
    if (parameters.water.flow != FlowKind::none)
      for (const WaterBoundary &boundary : parameters.water.boundaries)
        check_head(parameters, boundary, nodes, advice);
  }
} // namespace quoin
