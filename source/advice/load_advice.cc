// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/advice/load_advice.h>
#include <quoin/base/known_names.h>
#include <quoin/base/point_text.h>
#include <quoin/loads/load_field.h>
#include <quoin/loads/nodal_load.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    constexpr double nowhere = std::numeric_limits<double>::infinity();

    bool acts_on(const std::vector<unsigned int> &groups,
                 const unsigned int group)
    {
      return groups.empty()
             || std::find(groups.begin(), groups.end(), group) != groups.end();
    }

    bool is_in_pattern(const StageParameters &stage, const std::string &name)
    {
      return stage.pattern && is_among(name, stage.pattern->loads);
    }

    bool have_common(const std::vector<std::string> &a,
                     const std::vector<std::string> &b)
    {
      return std::any_of(a.begin(), a.end(),
                         [&](const std::string &name)
                         { return is_among(name, b); });
    }

    /** Whether @p load pushes at the end of @p stage, which is then over for
        @p start [s]. */
    bool pushes(const LoadParameters &load, const StageParameters &stage,
                const double start)
    {
      const double end
          = stage.end == StageEnd::time ? stage.duration : late_time;
      const auto given = load.given_components();
      return std::any_of(
          given.begin(), given.end(),
          [&](const auto &each)
          {
            return each.component.quantity == LoadQuantity::force
                   && (each.component.field
                       || each.component.value({ end, start + end }) != 0.);
          });
    }

    /** Whether @p stage has another load in the place of @p load. */
    bool replaces(const StageParameters &stage, const LoadParameters &load,
                  const Parameters &parameters)
    {
      return std::any_of(
          parameters.loads.begin(), parameters.loads.end(),
          [&](const LoadParameters &other)
          {
            return names_load(stage, other.name) && other.type == load.type
                   && (load.type == LoadType::gravity
                       || have_common(other.boundaries, load.boundaries)
                       || have_common(other.groups, load.groups));
          });
    }
  } // namespace

  void check_forgotten_loads(const Parameters &parameters, Advice &advice)
  {
    for (unsigned int i = 0; i < parameters.stages.size(); ++i)
    {
      const StageParameters &stage  = parameters.stages[i];
      const StageParameters *before = previous_stage(parameters.stages, i);
      if (!stage.safety || !before)
        continue;
      Checks checks(advice, "stage " + stage.name + ": ");
      const double start = start_of_stage(parameters.stages,
                                          before - parameters.stages.data());
      for (const LoadParameters &load : parameters.loads)
        checks.warn_if(
            (is_in_pattern(*before, load.name)
             || (names_load(*before, load.name)
                 && pushes(load, *before, start)))
                && !names_load(stage, load.name)
                // Another warning speaks of weight that stages forget.
                && (load.type != LoadType::gravity
                    || is_in_pattern(*before, load.name))
                && !replaces(stage, load, parameters),
            "its 'Loads' do not name the load ", load.name, ", ",
            load.type_text(), ", of stage ", before->name,
            ": the factor of safety is that without it. Name it here, too, if "
            "that is not meant.");
      checks.warn_if(parameters.water.flow != FlowKind::none
                         && parameters.water.acts_in(before->name)
                         && !parameters.water.acts_in(stage.name),
                     "'Stages' of section 'Water' do not name it, but stage ",
                     before->name,
                     ": the factor of safety is that without water. Name it "
                     "there, too, if that is not meant.");
    }
  }

  namespace
  {
    /** The lowest and the highest point of each block [m], as its height and
        above the surface of an in-situ stress; infinite for blocks without that
        stress. Collective. */
    template <int dim>
    struct StressedBlocks
    {
      StressedBlocks(const LoadParameters &load, const Model<dim> &model,
                     const State<dim> &state)
        : ends(4 * model.nodes().table().n_blocks(), nowhere),
          densities(2, nowhere)
      {
        const NodeMap<dim> &nodes = model.nodes();
        const auto groups = groups_of_names(nodes, load.groups, load.name);
        for (unsigned int c = 0; c < nodes.cells().size(); ++c)
        {
          const unsigned int block = nodes.blocks().block_of_cell(c);
          if (state.is_absent(block)
              || !acts_on(groups, nodes.cells().group[c]))
            continue;
          const double density = model.properties()
                                     .materials[material_of_cell(model, c)]
                                     .elastic.density;
          densities[0] = std::min(densities[0], density);
          densities[1] = std::min(densities[1], -density);
          for (const unsigned int node : nodes.cells().nodes[c])
          {
            dealii::Point<3> place;
            for (unsigned int d = 0; d < dim; ++d)
              place[d] = nodes.point(node)[d];
            const double height = place[dim - 1],
                         above  = height - load.in_situ->surface_height(place);
            double *own         = &ends[4 * block];
            own[0]              = std::min(own[0], height);
            own[1]              = std::min(own[1], -height);
            own[2]              = std::min(own[2], above);
            own[3]              = std::min(own[3], -above);
          }
        }
        dealii::Utilities::MPI::min(ends, nodes.communicator(), ends);
        dealii::Utilities::MPI::min(densities, nodes.communicator(), densities);
        for (std::size_t b = 0; b < ends.size(); b += 4)
        {
          bottom = std::min(bottom, ends[b]);
          top    = std::max(top, -ends[b + 1]);
          lowest = std::min(lowest, ends[b + 2]);
          if (ends[b + 2] < 0.)
            cut = std::max(cut, -ends[b + 3]);
        }
      }

      std::vector<double> ends; /**< four of each block; maxima negative */
      std::vector<double>
          densities; /**< smallest, minus the largest [kg/m^3] */
      double bottom = nowhere, top = -nowhere; /**< of all [m] */
      double lowest = nowhere; /**< of all above the surface [m] */
      double cut    = 0.; /**< by how much the surface cuts blocks off [m] */
    };

    /** Weight of the ground against gravity in the first stage. */
    template <int dim>
    void check_unit_weight(const Parameters &parameters,
                           const LoadParameters &stress,
                           const StressedBlocks<dim> &blocks, Checks &checks)
    {
      constexpr double tolerance = 0.05;
      /** Unit weight of water and a little [N/m^3]. */
      constexpr double buoyancy    = 10.5e3;
      const StageParameters &stage = parameters.stages.front();
      const double end
          = stage.end == StageEnd::time ? stage.duration : late_time;
      double gravity   = 0.;
      bool has_gravity = false, is_known = true, has_water = false;
      for (const LoadParameters &load : parameters.loads)
      {
        if (is_in_pattern(stage, load.name))
          is_known &= load.type != LoadType::gravity;
        if (!names_load(stage, load.name))
          continue;
        has_water |= load.pressure.quantity == LoadQuantity::force;
        if (load.type != LoadType::gravity)
          continue;
        has_gravity = true;
        is_known &= !load.distribution && load.groups.empty();
        const LoadComponent &vertical = load.components[1];
        if (vertical.quantity == LoadQuantity::force)
          gravity -= vertical.value({ end, end });
      }
      has_water |= parameters.water.flow != FlowKind::none
                   && parameters.water.acts_in(stage.name);
      double heaviest = 0., lightest = nowhere, top = nowhere;
      for (const InSituStress::Layer &layer : stress.in_situ->layers)
      {
        if (layer.foot < blocks.top && top > blocks.bottom)
        {
          heaviest = std::max(heaviest, layer.unit_weight);
          lightest = std::min(lightest, layer.unit_weight);
        }
        top = layer.foot;
      }
      checks.warn_if(
          heaviest > 0. && !has_gravity && is_known,
          "its stress grows with depth by 'Unit weight = ", heaviest,
          "' N/m^3, but stage ", stage.name,
          " has no gravity: the ground is driven upwards. Name a load of "
          "gravity in its 'Loads', or give the stress of one depth by 'Type = "
          "initial stress'.");
      if (!has_gravity || !is_known || !(gravity > 0.) || heaviest == 0.)
        return;
      const double low    = blocks.densities[0] * gravity,
                   high   = -blocks.densities[1] * gravity;
      const bool is_heavy = heaviest > (1. + tolerance) * high;
      checks.warn_if(
          is_heavy
              || lightest
                     < (1. - tolerance) * low - (has_water ? buoyancy : 0.),
          "'Unit weight = ", is_heavy ? heaviest : lightest,
          "' N/m^3, but density times gravity of its blocks is ",
          range_text(low, high), " N/m^3 in stage ", stage.name,
          ": stress and weight are not in equilibrium. Give that, or check "
          "'Density'.");
    }

    /** Surface of an in-situ stress against the top of its blocks. */
    template <int dim>
    void check_surface(const double top, const StressedBlocks<dim> &blocks,
                       Checks &checks)
    {
      /** Share of the height that a rough line of the surface may miss. */
      constexpr double rough = 0.02;
      const double height    = blocks.top - blocks.bottom;
      const bool is_above    = blocks.lowest >= -1e-9 * height;
      checks.warn_if(
          is_above || blocks.cut > rough * height, "'Surface' lies ",
          is_above ? "below all" : "within",
          " blocks that have the stress: it is at a height of ", top,
          " m or less, and they reach from ", blocks.bottom, " to ", blocks.top,
          " m. There is no stress above the surface; give the height of the "
          "ground, which may be above the model.");
    }

    /** Largest height of the surface of @p stress above the nodes [m].
        Collective. */
    template <int dim>
    double highest_surface(const LoadParameters &stress,
                           const NodeMap<dim> &nodes)
    {
      double top = -nowhere;
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      {
        dealii::Point<3> place;
        for (unsigned int d = 0; d < dim; ++d)
          place[d] = nodes.point(i)[d];
        top = std::max(top, stress.in_situ->surface_height(place));
      }
      return dealii::Utilities::MPI::max(top, nodes.communicator());
    }

    double size_of(const dealii::SymmetricTensor<2, 2> &stress,
                   const std::array<dealii::Point<2>, 2> &face)
    {
      return (stress * dealii::cross_product_2d(face[1] - face[0])).norm()
             / face[0].distance(face[1]);
    }

    double size_of(const dealii::SymmetricTensor<2, 3> &stress,
                   const std::array<dealii::Point<3>, 3> &face)
    {
      const auto normal
          = dealii::cross_product_3d(face[1] - face[0], face[2] - face[0]);
      return (stress * normal).norm() / normal.norm();
    }

    dealii::SymmetricTensor<2, 2> stress_at(const LoadParameters &load,
                                            const dealii::Point<2> &p)
    {
      const auto s = load.initial_stress(p[0], p[1], 0.);
      dealii::SymmetricTensor<2, 2> result;
      result[0][0] = s[0];
      result[1][1] = s[1];
      result[0][1] = s[2];
      return result;
    }

    dealii::SymmetricTensor<2, 3> stress_at(const LoadParameters &load,
                                            const dealii::Point<3> &p)
    {
      const auto s = load.initial_stress(p);
      dealii::SymmetricTensor<2, 3> result;
      for (unsigned int d = 0; d < 3; ++d)
        result[d][d] = s[d];
      result[0][1] = s[3];
      result[0][2] = s[4];
      result[1][2] = s[5];
      return result;
    }

    /** A joint beside whose one side there is no initial stress. */
    template <int dim>
    struct StressStep
    {
      double traction    = 0.; /**< of the other side [Pa] */
      unsigned int group = 0;  /**< without stress */
      dealii::Point<dim> position;
    };

    /** Warns of blocks without initial stress beside others. */
    template <int dim>
    void check_unstressed(const Parameters &parameters, const Model<dim> &model,
                          const State<dim> &state, Advice &advice)
    {
      /** Traction by the largest one of all joints that counts. */
      constexpr double small    = 0.05;
      const NodeMap<dim> &nodes = model.nodes();
      std::vector<std::vector<unsigned int>> groups;
      for (const LoadParameters &load : parameters.model.initial_stresses)
        groups.push_back(groups_of_names(nodes, load.groups, load.name));
      double largest = 0.;
      StressStep<dim> worst;
      for (const JointNodes<dim> &joint : nodes.faces().joints)
      {
        if (state.is_absent(joint.blocks[0])
            || state.is_absent(joint.blocks[1]))
          continue;
        std::array<dealii::Point<dim>, dim> corners;
        dealii::Point<dim> centre;
        for (unsigned int k = 0; k < dim; ++k)
        {
          corners[k] = nodes.point(joint.lower[k]);
          centre += (corners[k] - dealii::Point<dim>()) / dim;
        }
        std::array<dealii::SymmetricTensor<2, dim>, 2> stress;
        for (unsigned int i = 0; i < groups.size(); ++i)
          for (const unsigned int side : { 0, 1 })
            if (acts_on(groups[i], joint.groups[side]))
              stress[side]
                  += stress_at(parameters.model.initial_stresses[i], centre);
        for (const unsigned int side : { 0, 1 })
        {
          const double traction = size_of(stress[1 - side], corners);
          largest               = std::max(largest, traction);
          if (stress[side].norm() == 0. && traction > worst.traction)
            worst = { traction, joint.groups[side], centre };
        }
      }
      const MPI_Comm all = nodes.communicator();
      for (const StressStep<dim> &other :
           dealii::Utilities::MPI::all_gather(all, worst))
        if (other.traction > worst.traction)
          worst = other;
      largest = dealii::Utilities::MPI::max(largest, all);
      Checks(advice, "initial stress: ")
          .warn_if(worst.traction > small * largest, "blocks of the group ",
                   nodes.table().group_names[worst.group],
                   " have none and touch blocks that have, such as at ",
                   point_text(worst.position), " m with a traction of ",
                   worst.traction,
                   " Pa, which nothing balances there. Add the group to "
                   "'Groups' of the load, or leave them empty for all blocks.");
    }
  } // namespace

  template <int dim>
  void check_stress_at_rest(const Parameters &parameters,
                            const Model<dim> &model, const State<dim> &state,
                            Advice &advice)
  {
    const auto &stresses = parameters.model.initial_stresses;
    const auto n_in_situ = std::count_if(stresses.begin(), stresses.end(),
                                         [](const LoadParameters &load)
                                         { return load.in_situ.has_value(); });
    for (const LoadParameters &load : stresses)
    {
      if (!load.in_situ)
        continue;
      Checks checks(advice, "load " + load.name + ": ");
      const StressedBlocks<dim> blocks(load, model, state);
      if (!(blocks.top > blocks.bottom))
        continue;
      if (n_in_situ == 1) // else they may be added
        check_unit_weight(parameters, load, blocks, checks);
      check_surface(highest_surface(load, model.nodes()), blocks, checks);
    }
    check_unstressed(parameters, model, state, advice);
  }

  namespace
  {
    /** Whether curves of @p load are joints. Collective. */
    template <int dim>
    bool acts_in_joints(const LoadParameters &load, const NodeMap<dim> &nodes)
    {
      const auto &joints = nodes.faces().joints;
      const auto &names  = nodes.table().face_names;
      const bool is_here
          = std::any_of(joints.begin(), joints.end(),
                        [&](const JointNodes<dim> &joint) {
                          return is_among(names[joint.name], load.boundaries);
                        });
      return dealii::Utilities::MPI::logical_or(is_here, nodes.communicator());
    }

    /** Lowest and highest point of all blocks [m]. Collective. */
    template <int dim>
    std::array<double, 2> heights_of(const NodeMap<dim> &nodes)
    {
      std::vector<double> ends(2, nowhere);
      for (unsigned int i = 0; i < nodes.n_owned(); ++i)
      {
        ends[0] = std::min(ends[0], nodes.point(i)[dim - 1]);
        ends[1] = std::min(ends[1], -nodes.point(i)[dim - 1]);
      }
      dealii::Utilities::MPI::min(ends, nodes.communicator(), ends);
      return { ends[0], -ends[1] };
    }

    /** Warns of the water pressure @p load whose @p level is always below its
        boundary. Collective. */
    template <int dim>
    void check_wets(const LoadParameters &load, const TimeFunction &level,
                    const NodeMap<dim> &nodes, Advice &advice)
    {
      if (!level.is_constant())
        return;
      double lowest = nowhere;
      for (const auto &face :
           faces_of_curves(nodes, load.boundaries, load.name, true))
        for (const auto &point : face.points)
          lowest = std::min(lowest, point[dim - 1]);
      const double height = level({ 0., 0. });
      Checks(advice, "load " + load.name + ": ")
          .warn_if(height < lowest, "the water level of ", height,
                   " m is below its boundary, whose lowest point is at ",
                   lowest,
                   " m, so that there is no pressure. Check the level and the "
                   "height of the model.");
    }

    /** Warns if @p water, whose level differs from place to place, is below all
        of the boundary of @p load. Collective. */
    template <int dim>
    void check_wets(const LoadParameters &load, const LoadField &water,
                    const NodeMap<dim> &nodes, Advice &advice)
    {
      /** Points of each side of a face at which there may be water: the level
          may have a kink above its middle. */
      constexpr unsigned int n_points = 20;
      for (const auto &face :
           faces_of_curves(nodes, load.boundaries, load.name, true))
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int i = 0; i < n_points; ++i)
          {
            const double s = double(i) / n_points;
            dealii::Point<3> place;
            for (unsigned int d = 0; d < dim; ++d)
              place[d] = (1. - s) * face.points[k][d]
                         + s * face.points[(k + 1) % dim][d];
            if (!(water(place, {}, dim - 1) <= 0.))
              return;
          }
      Checks(advice, "load " + load.name + ": ")
          .warn_if(true, "the line of the water is below all of its boundary, "
                         "so that there is no pressure. Check its points, x "
                         "and height, and the height of the model.");
    }
  } // namespace

  namespace
  {
    /** Warns of flow in joints into which nothing brings water, and of
        pressures that are nothing beside those of water as high as the model,
        @p height [m]. */
    void check_given_water(const Parameters &parameters, const double height,
                           Advice &advice)
    {
      /** The largest pressure below which kPa may have been meant [Pa], and by
          that of water as high as the model [-]. */
      constexpr double few_pascals = 1e3, small_share = 0.01;
      const WaterParameters &water = parameters.water;
      Checks checks(advice, "section 'Water boundaries': ");
      // At the walls of an excavation the pressure is zero.
      const bool has_walls = std::any_of(
          parameters.stages.begin(), parameters.stages.end(),
          [](const StageParameters &stage) { return !stage.excavate.empty(); });
      checks.warn_if(
          water.flow == FlowKind::steady && !water.fluid.has_free_surface
              && water.boundaries.empty() && !has_walls,
          "'Names' is empty, so that no water enters the joints: steady flow "
          "has no pressure anywhere. Give a place with a head or a pressure.");
      double largest = 0.;
      for (const WaterBoundary &boundary : water.boundaries)
      {
        if (boundary.quantity == WaterQuantity::outlet)
          continue;
        if (boundary.quantity != WaterQuantity::pressure
            || !boundary.value.is_constant())
          return;
        largest = std::max(largest, std::abs(boundary.value({ 0., 0. })));
      }
      checks.warn_if(
          largest > 0. && largest < few_pascals
              && largest < small_share * water.fluid.unit_weight * height,
          "pressures are ", largest, " Pa at most, those of ",
          largest / water.fluid.unit_weight, " m of water, in a model that is ",
          height, " m high. Pressures are in Pa: 50e3, not 50, for 50 kPa.");
    }
  } // namespace

  template <int dim>
  void check_moved_water(const Parameters &parameters, const unsigned int index,
                         const double stable, const double displacement,
                         const NodeMap<dim> &nodes, Advice &advice)
  {
    /** Error of a factor by the displacement over the height of what is below
        water: that of a slope of clay at 45 degrees [-]. */
    constexpr double share_of_error = 3.6;
    /** Error from which on there is a warning [-]. */
    constexpr double most = 0.018;
    /** By which share the pressure of water may differ from its weight [-]. */
    constexpr double other_water = 0.1;
    const StageParameters &stage = parameters.stages[index];
    const double start           = start_of_stage(parameters.stages, index);
    const TimePoint late{ late_time, start + late_time };
    for (const LoadParameters &load : parameters.loads)
    {
      if (load.type != LoadType::traction || !load.pressure.field
          || load.is_water_that_follows() || load.pressure.field->uplift()
          || !names_load(stage, load.name))
        continue;
      // Height and pressure of the lowest and of the highest wet place.
      std::array<double, 2> low{ nowhere, 0. }, high{ -nowhere, 0. };
      for (const auto &face :
           faces_of_curves(nodes, load.boundaries, load.name, true))
        for (const auto &point : face.points)
        {
          dealii::Point<3> place;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] = point[d];
          const double height   = point[dim - 1];
          const double pressure = load.pressure.at(place, late);
          if (!(pressure > 0.))
            continue;
          if (height < low[0])
            low = { height, pressure };
          if (height > high[0])
            high = { height, pressure };
        }
      const double height = high[0] - low[0];
      const double error  = share_of_error * displacement / height;
      if (!(height > 0.) || error <= most
          || std::abs((low[1] - high[1]) / (weight_of_water * height) - 1.)
                 > other_water)
        continue;
      Checks(advice, "stage " + stage.name + ": ")
          .warn_if(
              true, "the ground has moved by ", displacement,
              " m where it comes to rest at the factor ", stable,
              ", and the load ", load.name,
              ", whose pressure is that of water, presses on it as in the "
              "mesh. Ground that sinks would be pressed more, so that the "
              "factor is too high: of a slope of clay at 45 degrees by ",
              std::round(100. * error),
              " %. Give 'Pressure = water LEVEL' or 'water through', which "
              "follow the ground.");
      return;
    }
  }

  template <int dim>
  void check_pressures(const Parameters &parameters, const NodeMap<dim> &nodes,
                       Advice &advice)
  {
    const auto [bottom, top] = heights_of(nodes);
    // Ground under initial stress may lie far below the water table.
    const double most = parameters.model.initial_stresses.empty() ? 10. : 50.;
    const auto check_level
        = [&, low = bottom, high = top](const std::string &about,
                                        const std::string &entry,
                                        const TimeFunction &level)
    {
      for (const StageParameters &stage : parameters.stages)
        if (const double height = level({ stage.duration, stage.duration });
            height > high + most * (high - low))
        {
          Checks(advice, about)
              .warn_if(true, entry, height,
                       " m is far above the model, which ends at a height of ",
                       high, " m: the pressure is ", 9810. * (height - high),
                       " Pa there. In mm it would be ", 1e-3 * height,
                       " m. Check the unit.");
          return;
        }
    };
    for (const LoadParameters &load : parameters.loads)
    {
      if (load.type != LoadType::traction
          || load.pressure.quantity != LoadQuantity::force)
        continue;
      const std::string about = "load " + load.name + ": ";
      if (load.pressure.field)
      {
        if (const auto &level = load.pressure.field->level())
        {
          check_level(about, "the water level of ", *level);
          check_wets(load, *level, nodes, advice);
        }
        else if (load.pressure.field->is_water_at_rest())
          check_wets(load, *load.pressure.field, nodes, advice);
        continue;
      }
      double lowest = 0.;
      for (const StageParameters &stage : parameters.stages)
        if (names_load(stage, load.name))
          for (const double t : { 0., 0.5 * stage.duration, stage.duration })
            lowest = std::min(lowest, load.pressure.value({ t, t }));
      Checks(advice, about)
          .warn_if(
              lowest < 0. && acts_in_joints(load, nodes),
              "'Pressure' is down to ", lowest,
              " Pa in joints, which pulls their faces together. Pressure "
              "is positive; a traction on faces from outside has the signs "
              "of 'Horizontal' and 'Vertical'.");
    }
    if (parameters.water.flow == FlowKind::none)
      return;
    for (const WaterBoundary &boundary : parameters.water.boundaries)
      if (boundary.quantity == WaterQuantity::head)
        check_level("water boundary " + boundary.name + ": ", "the head of ",
                    boundary.value);
    check_given_water(parameters, top - bottom, advice);
  }

  template void check_moved_water(const Parameters &, unsigned int, double,
                                  double, const NodeMap<2> &, Advice &);
  template void check_moved_water(const Parameters &, unsigned int, double,
                                  double, const NodeMap<3> &, Advice &);
  template void check_pressures(const Parameters &, const NodeMap<2> &,
                                Advice &);
  template void check_pressures(const Parameters &, const NodeMap<3> &,
                                Advice &);
  template void check_stress_at_rest(const Parameters &, const Model<2> &,
                                     const State<2> &, Advice &);
  template void check_stress_at_rest(const Parameters &, const Model<3> &,
                                     const State<3> &, Advice &);
} // namespace quoin
