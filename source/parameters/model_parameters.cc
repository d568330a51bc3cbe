// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/finite_numbers.h>
#include <quoin/base/known_names.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/named_sections.h>
#include <quoin/dynamics/construction.h>
#include <quoin/parameters/model_parameters.h>
#include <quoin/rock/rock_box.h>
#include <quoin/results/history_conditions.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    void check_plane_strain(const ParameterSection &top,
                            const Parameters &parameters)
    {
      if (parameters.model.plane != PlaneAssumption::plane_strain)
        top.fail("Plane assumption", "does not go with boundary elements: "
                                     "their kernels are those of plane "
                                     "strain.");
    }

    /** Reads the boundary elements beyond the blocks. */
    void read_far_field(const ParameterSection &top, Parameters &parameters)
    {
      std::vector<const LoadParameters *> loads;
      for (const LoadParameters &load : parameters.loads)
        if (load.type == LoadType::boundary_elements)
          loads.push_back(&load);
      if (loads.empty())
      {
        for (const std::string name : { "Boundary elements", "Incident waves" })
          if (!ParameterSection(top, name).list("Names").empty())
            ParameterSection(top, name).fail(
                "Names", "has no meaning without a load of 'Type = "
                         "boundary elements', or 'Model = boundary "
                         "elements': add one, or remove the names.");
        return;
      }
      if (loads.size() > 1)
        ParameterSection(ParameterSection(top, "Loads"), loads[1]->name)
            .fail("Type", "is 'boundary elements', as that of '"
                              + loads[0]->name
                              + "' is: there can be one such load, with all "
                                "interfaces among the boundaries of section "
                                "'Boundary elements'.");
      check_plane_strain(top, parameters);
      parameters.boundary = BoundaryElementParameters::read(
          top, parameters.model.materials, true);
      const MaterialParameters &beyond = *find_named(
          parameters.model.materials, parameters.boundary.material);
      if (beyond.thickness > 0.
          && beyond.thickness != parameters.model.thickness)
        ParameterSection(ParameterSection(top, "Materials"), beyond.name)
            .fail("Thickness", "is not that of the model, which boundary "
                               "elements of this material have: leave it "
                               "empty, or give the blocks a material of "
                               "their own.");
      if (!parameters.boundary.has(BoundaryShape::interface))
        ParameterSection(top, "Boundary elements")
            .fail("Names", "has no boundary with 'Shape = interface': nothing "
                           "is coupled to the blocks.");
      if (parameters.boundary.sampled_field.has_box)
        ParameterSection(top, "Sampled field")
            .fail("Box", "needs 'Model = boundary elements': leave it empty.");
    }

    /** Warns of loads that no stage uses. */
    void warn_of_idle_loads(Parameters &parameters)
    {
      const auto uses
          = [](const StageParameters &stage, const std::string &load)
      {
        return names_load(stage, load)
               || (stage.pattern && is_among(load, stage.pattern->loads));
      };
      for (const LoadParameters &load : parameters.loads)
        if (load.type != LoadType::initial_stress
            && std::none_of(parameters.stages.begin(), parameters.stages.end(),
                            [&](const StageParameters &stage)
                            { return uses(stage, load.name); }))
          parameters.warnings.push_back("load " + load.name
                                        + ": no stage uses it. Name it in the "
                                          "'Loads' of a stage, unless that is "
                                          "meant.");
    }

    /** Whether a stage of the explicit solver has dynamic boundary elements
        beyond the blocks. */
    bool has_dynamic_boundary(const Parameters &parameters)
    {
      const auto acts = [&](const LoadParameters &load)
      {
        return load.type == LoadType::boundary_elements
               && std::any_of(parameters.stages.begin(),
                              parameters.stages.end(),
                              [&](const StageParameters &stage) {
                                return stage.end == StageEnd::time
                                       && names_load(stage, load.name);
                              });
      };
      return !parameters.is_implicit
             && std::any_of(parameters.loads.begin(), parameters.loads.end(),
                            acts);
    }

    /** Whether a value on a boundary, such as 'traction 0.0', is zero. */
    bool is_zero(const std::string &value)
    {
      const auto words = dealii::Utilities::split_string_list(value, ' ');
      const auto last  = finite_numbers({ words.empty() ? "" : words.back() });
      return last.size() == 1 && last[0] == 0.;
    }

    /** Refuses values on boundaries beyond the blocks that are static in all
        stages, in which these values do not change. */
    void check_static_boundaries(const ParameterSection &top,
                                 const Parameters &parameters)
    {
      if (has_dynamic_boundary(parameters))
        return;
      const ParameterSection section(top, "Boundary elements");
      for (const BoundaryCurveParameters &curve :
           parameters.boundary.boundaries)
      {
        const ParameterSection own(section, curve.name);
        for (const std::string name : { "Horizontal", "Vertical", "Pressure" })
          if (!is_zero(own.text(name)))
            own.fail(name,
                     "has no effect: 'Solver' is implicit, or no stage with "
                     "'End = time' names the load of the boundary elements, "
                     "and what is given on their boundaries does not change "
                     "in static stages. Load faces of blocks by a 'traction' "
                     "instead, or take 'Solver = explicit' and a stage with "
                     "'End = time'.");
      }
    }

    /** Checks histories of boundary elements beyond blocks. */
    void check_coupled_histories(const ParameterSection &top,
                                 const Parameters &parameters)
    {
      const ParameterSection section(top, "Histories");
      for (const HistoryParameters &history : parameters.histories)
      {
        if (!history.is_of_boundary())
          continue;
        const ParameterSection subsection(section, history.name);
        if (parameters.boundary.boundaries.empty())
          subsection.fail("Quantity",
                          "needs 'Model = boundary elements' or a load of "
                          "'Type = boundary elements'.");
        if (!has_dynamic_boundary(parameters))
          subsection.fail(
              "Quantity",
              "is a quantity of dynamic boundary elements, but here they are "
              "static: 'Solver' is implicit, or no stage with 'End = time' "
              "names their load. Take 'displacement x', 'displacement y' or "
              "'reaction' of that load.");
      }
    }

    /** Refuses named blocks that move at the start of a run without motion. */
    void check_named_blocks(const ParameterSection &top,
                            const Parameters &parameters)
    {
      const ParameterSection section(top, "Blocks");
      for (const NamedBlock &block : parameters.named_blocks)
        if (parameters.is_implicit && block.moves())
          ParameterSection(section, block.name)
              .fail(block.spin != 0. ? "Spin" : "Velocity",
                    "needs inertia, which 'Solver = implicit' leaves out: "
                    "make it 0, or take 'explicit'.");
    }

    /** Checks the names of blocks that histories give. */
    void check_block_histories(const ParameterSection &top,
                               const Parameters &parameters)
    {
      const auto &blocks = parameters.named_blocks;
      const ParameterSection section(top, "Histories");
      for (const HistoryParameters &history : parameters.histories)
      {
        if (!history.is_of_block())
          continue;
        const ParameterSection subsection(section, history.name);
        const auto known = [&](const std::string &name)
        {
          return known_names_like(name, blocks, &NamedBlock::name)
                 + ". Name one, or add the name to section 'Blocks'.";
        };
        if (!find_named(blocks, history.block))
          subsection.fail("Block", "must be a named block. There are: "
                                       + known(history.block));
        if (history.other_block.empty())
          continue;
        if (!find_named(blocks, history.other_block))
          subsection.fail("Second block",
                          "must be a named block or empty. There are: "
                              + known(history.other_block));
        if (history.other_block == history.block)
          subsection.fail("Second block", "is 'Block' itself. Name another "
                                          "block, or leave it empty.");
      }
    }

    /** Checks the stages that @p items of the section @p name are placed in. */
    template <typename Item>
    void check_stages_of(const ParameterSection &top, const std::string &name,
                         const std::vector<Item> &items,
                         const Parameters &parameters)
    {
      const ParameterSection section(top, name);
      for (const Item &item : items)
      {
        if (item.stage.empty())
          continue;
        const ParameterSection own(section, item.name);
        const StageParameters *stage
            = find_named(parameters.stages, item.stage);
        if (!stage)
          own.fail("Stage",
                   "must be a stage or empty. There are: "
                       + known_names_like(item.stage, parameters.stages,
                                          &StageParameters::name)
                       + ".");
        if (stage->safety)
          own.fail("Stage", "searches a factor of safety and leaves the model "
                            "as it was: what it places would be gone after "
                            "the search. Name a stage before it.");
      }
    }

    /** Checks that histories of @p quantity name one of @p items of the section
        @p name by @p entry, which is read into @p member. */
    template <typename Item>
    void
    check_histories_of(const ParameterSection &top, const std::string &name,
                       const std::vector<Item> &items,
                       const HistoryQuantity quantity, const std::string &entry,
                       std::string HistoryParameters::*const member,
                       const Parameters &parameters)
    {
      const ParameterSection section(top, "Histories");
      for (const HistoryParameters &history : parameters.histories)
        if (history.quantity == quantity && !find_named(items, history.*member))
          ParameterSection(section, history.name)
              .fail(entry,
                    "must be one of section '" + name + "'. There are: "
                        + known_names_like(history.*member, items, &Item::name)
                        + ".");
    }

    /** Checks what histories of the flow of water name. */
    void check_water_histories(const ParameterSection &top,
                               const Parameters &parameters)
    {
      const ParameterSection section(top, "Histories");
      const auto &places = parameters.water.boundaries;
      for (const HistoryParameters &history : parameters.histories)
      {
        if (history.quantity != HistoryQuantity::water
            && !history.is_of_joint_water())
          continue;
        const ParameterSection subsection(section, history.name);
        if (parameters.water.flow == FlowKind::none)
          subsection.fail("Quantity", "is one of water that flows in joints. "
                                      "Give 'Flow' in section 'Water', or "
                                      "remove the history.");
        if (!history.water.empty() && !find_named(places, history.water))
          subsection.fail("Water boundary",
                          "must be one of section 'Water boundaries'. There "
                          "are: "
                              + known_names_like(history.water, places,
                                                 &WaterBoundary::name)
                              + ".");
      }
    }

    /** Refuses histories of a load pattern where no stage has one. */
    void check_pattern_histories(const ParameterSection &top,
                                 const Parameters &parameters)
    {
      if (std::any_of(parameters.stages.begin(), parameters.stages.end(),
                      [](const StageParameters &stage)
                      { return stage.pattern.has_value(); }))
        return;
      const ParameterSection section(top, "Histories");
      for (const HistoryParameters &history : parameters.histories)
        if (history.quantity == HistoryQuantity::load_factor
            || history.quantity == HistoryQuantity::controlled_displacement)
          ParameterSection(section, history.name)
              .fail("Quantity",
                    "is one of a load pattern, and no stage has one. Give a "
                    "stage a 'Load pattern', or remove the history.");
    }

    /** Checks that no stage changes the law of a liner's interface, which
        follows the set as it is read. */
    void check_interfaces(const ParameterSection &top,
                          const Parameters &parameters)
    {
      const ParameterSection section(top, "Stages");
      for (const StageParameters &stage : parameters.stages)
        for (const auto &[set, other] : stage.joint_properties)
          for (const BeamParameters &beam : parameters.beams)
            if (beam.is_liner() && beam.interface == set)
              ParameterSection(section, stage.name)
                  .fail("Joint properties",
                        "changes '" + set + "', the interface of the liner '"
                            + beam.name
                            + "', which keeps its law. Give the liner a set of "
                              "its own, with 'Curves = none'.");
    }

    /** Checks the conditions on histories by which stages end. */
    void check_end_conditions(const ParameterSection &top,
                              const Parameters &parameters)
    {
      const ParameterSection section(top, "Stages");
      for (const StageParameters &stage : parameters.stages)
        ParameterSection(section, stage.name)
            .made("End conditions", [&]()
                  { return end_conditions(stage, parameters.histories); });
    }

    /** Refuses sections of one kind of model in a file of the other. */
    void refuse_names(const ParameterSection &top, const std::string &name,
                      const std::string &model)
    {
      const ParameterSection section(top, name);
      if (!section.list("Names").empty())
        section.fail("Names", "has no meaning with 'Model = " + model
                                  + "': remove it, or change 'Model'.");
    }

    void check_boundary_histories(const ParameterSection &top,
                                  const Parameters &parameters)
    {
      const ParameterSection section(top, "Histories");
      const BoundaryElementParameters &boundary = parameters.boundary;
      for (const HistoryParameters &history : parameters.histories)
      {
        const ParameterSection subsection(section, history.name);
        const bool interior = history.is_of_interior();
        if (history.point_has_z)
          subsection.fail("Point", "must have two coordinates, x and y.");
        if (!interior && !history.is_of_boundary())
          subsection.fail("Quantity",
                          "is one of blocks: with 'Model = boundary "
                          "elements' take a displacement, a "
                          "velocity or a boundary quantity.");
        if (interior
            && boundary.formulation == Formulation::convolution_quadrature)
          subsection.fail("Quantity", "is one of the domain, which is computed "
                                      "with Galerkin and collocation only: "
                                      "change 'Formulation', or take a "
                                      "boundary quantity.");
      }
    }
  } // namespace

  namespace
  {
    /** Reads the flow of water in joints and refuses what it does not do. */
    void read_water(const ParameterSection &top, Parameters &parameters)
    {
      WaterParameters &water = parameters.water = WaterParameters::read(top);
      const auto fail = [&](const std::string &name, const std::string &why)
      { ParameterSection(top, "Water").fail(name, why); };
      if (water.flow == FlowKind::none)
      {
        if (!water.joints.empty() || !water.boundaries.empty())
          fail("Flow", std::string("lets no water flow, although section '")
                           + (water.joints.empty() ? "Water boundaries"
                                                   : "Water joints")
                           + "' has names. Take 'steady' or 'transient', or "
                             "remove the names.");
        return;
      }
      if (parameters.model.large_displacements)
        fail("Flow", "is along joints of the mesh, but with 'Displacements = "
                     "large' blocks meet others at contacts that come and go, "
                     "of which no network of channels is made. Take 'small' "
                     "in section 'Contact'.");
      if (water.joints.empty())
        ParameterSection(top, "Water joints")
            .fail("Names", "must list the sets of joints in which water "
                           "flows, with their apertures.");
      for (const std::string &name : water.stages)
        if (!find_named(parameters.stages, name))
          fail("Stages", "names '" + name + "', which is no stage. Stages are: "
                             + known_names_like(name, parameters.stages,
                                                &StageParameters::name)
                             + ".");
      if (water.flow != FlowKind::transient || !parameters.is_implicit)
        return;
      for (const StageParameters &stage : parameters.stages)
        if ((water.stages.empty() || is_among(stage.name, water.stages))
            && (stage.end != StageEnd::time || stage.safety))
          fail("Flow",
               "needs a time, but the stage '" + stage.name
                   + "' has none: take 'End = time' and a 'Duration' there, "
                     "'Flow = steady', or leave the stage out of 'Stages'.");
    }
  } // namespace

  namespace
  {
    /** Refuses sets of joints that a generated wall would have if it were
        longer or higher, or its openings smaller. */
    void check_wall_joints(const ParameterSection &top,
                           const Parameters &parameters)
    {
      const auto &has = parameters.generated.joint_curves;
      if (parameters.generated.name != "wall")
        return;
      const ParameterSection section(top, "Joints");
      for (const JointSetParameters &set : parameters.model.joints)
        for (const std::string name : { "bed", "head" })
          if (is_among(name, set.curves) && !is_among(name, has))
            ParameterSection(section, set.name)
                .fail(
                    "Curves",
                    "has '" + name + "', but the wall of section 'Wall' has "
                        + (name == "head"
                               ? "no joint between two units of a course: it "
                                 "is "
                                 "no longer than a unit, or its openings leave "
                                 "no more"
                               : "no joint between two courses: it has only "
                                 "one, "
                                 "or its openings leave no more")
                        + ". Check its 'Length', 'Courses' and 'Openings', or "
                          "take '"
                        + set.name + "' out of 'Names'.");
    }

    /** Refuses joints of which the generator of rock has left nothing. */
    void check_rock_joints(const ParameterSection &top,
                           const Parameters &parameters)
    {
      if (parameters.generated.name != "rock")
        return;
      const bool is_box = RockBoxParameters::read(top).is_there();
      const auto named
          = ParameterSection(top, is_box ? "Rock joint sets" : "Rock joints")
                .list("Names");
      const ParameterSection section(top, "Joints");
      for (const JointSetParameters &set : parameters.model.joints)
        for (const std::string &curve : set.curves)
          if (is_among(curve, named)
              && !is_among(curve, parameters.generated.joint_curves))
            ParameterSection(section, set.name)
                .fail("Curves",
                      "means the joints '" + curve
                          + "', of which nothing is left in the rock: "
                          + (is_box
                                 ? "they lie outside it, or cut off pieces "
                                   "below 'Shortest edge' of section 'Rock box'"
                                 : "they lie outside it, end within it, where "
                                   "'Dead ends = cut' removes them, or are "
                                   "left out by 'Shortest edge' and 'Smallest "
                                   "block', which follow from 'Element size' "
                                   "unless they are given")
                          + ". Correct that, or take '" + curve
                          + "' out of 'Curves'.");
    }
  } // namespace

  void read_block_model(const ParameterSection &top, Parameters &parameters)
  {
    parameters.model.joints = read_named<JointSetParameters>(top, "Joints");
    check_wall_joints(top, parameters);
    check_rock_joints(top, parameters);
    parameters.model.contact
        = ContactParameters::read(ParameterSection(top, "Contact"));
    parameters.model.large_displacements
        = parameters.model.contact.large_displacements;
    parameters.model.cables = read_named<CableParameters>(top, "Reinforcement");
    parameters.loads        = read_named<LoadParameters>(top, "Loads");
    for (const LoadParameters &load : parameters.loads)
      if (load.type == LoadType::initial_stress)
        parameters.model.initial_stresses.push_back(load);
    read_far_field(top, parameters);
    parameters.initial_motion
        = InitialMotion::read(ParameterSection(top, "Initial motion"));
    parameters.stages
        = read_stages(top, parameters.loads, parameters.is_implicit);
    parameters.model.absent_groups = groups_placed_later(parameters.stages);
    parameters.named_blocks        = read_named<NamedBlock>(top, "Blocks");
    parameters.beams               = read_named<BeamParameters>(top, "Beams");
    read_water(top, parameters);
    warn_of_idle_loads(parameters);
    check_static_boundaries(top, parameters);
    check_coupled_histories(top, parameters);
    check_block_histories(top, parameters);
    const auto &cables = parameters.model.cables;
    check_stages_of(top, "Reinforcement", cables, parameters);
    check_histories_of(top, "Reinforcement", cables, HistoryQuantity::cable,
                       "Cable", &HistoryParameters::cable, parameters);
    check_stages_of(top, "Beams", parameters.beams, parameters);
    check_histories_of(top, "Beams", parameters.beams, HistoryQuantity::beam,
                       "Beam", &HistoryParameters::beam, parameters);
    check_water_histories(top, parameters);
    check_pattern_histories(top, parameters);
    check_interfaces(top, parameters);
    check_end_conditions(top, parameters);
    parameters.implicit
        = ImplicitParameters::read(ParameterSection(top, "Implicit"));
    if (parameters.is_implicit
        && parameters.implicit.linear_solver == LinearSolverType::iterative
        && std::any_of(parameters.stages.begin(), parameters.stages.end(),
                       [](const StageParameters &stage)
                       { return stage.pattern.has_value(); }))
      ParameterSection(top, "Implicit")
          .fail("Linear solver", "does not solve for the factor of a 'Load "
                                 "pattern'. Take 'direct' or 'automatic'.");
    if (parameters.is_implicit && !parameters.boundary.waves.empty())
      ParameterSection(top, "Incident waves")
          .fail("Names", "needs motion, which 'Solver = implicit' leaves "
                         "out: remove the waves, or take 'explicit'.");
    if (!parameters.boundary.waves.empty() && !has_dynamic_boundary(parameters))
      ParameterSection(top, "Incident waves")
          .fail("Names", "lists waves that never come in: no stage with 'End "
                         "= time' names the load of the boundary elements, "
                         "and waves do not pass in static stages. Give such a "
                         "stage, or remove the waves ('set Names =').");
    if (parameters.is_implicit && parameters.initial_motion.is_given())
      top.fail("Solver", "leaves out inertia, but section 'Initial motion' "
                         "gives one: remove that, or take 'explicit'.");
    check_named_blocks(top, parameters);
  }

  void read_boundary_model(const ParameterSection &top, Parameters &parameters)
  {
    for (const std::string name :
         { "Joints", "Reinforcement", "Loads", "Stages", "Blocks", "Beams",
           "Water joints", "Water boundaries" })
      refuse_names(top, name, "boundary elements");
    for (const std::string name : { "Displacement", "Velocity" })
      if (const ParameterSection section(top, "Initial motion");
          !section.text(name).empty())
        section.fail(name, "has no meaning with 'Model = boundary "
                           "elements': it is that of blocks. Remove it.");
    check_plane_strain(top, parameters);
    for (const MaterialParameters &material : parameters.model.materials)
      if (material.thickness > 0.)
        ParameterSection(ParameterSection(top, "Materials"), material.name)
            .fail("Thickness", "is that of blocks: leave it empty, and give "
                               "'Thickness' at the top of the file.");
    parameters.boundary = BoundaryElementParameters::read(
        top, parameters.model.materials, false);
    const BoundaryElementParameters &boundary = parameters.boundary;
    if (boundary.has(BoundaryShape::mesh))
      read_mesh(top, parameters);
    if (boundary.has(BoundaryShape::interface))
      ParameterSection(top, "Boundary elements")
          .fail("Names", "has a boundary with 'Shape = interface', but there "
                         "are no blocks: take 'Shape = mesh'.");
    if (boundary.is_static && !boundary.waves.empty())
      ParameterSection(top, "Incident waves")
          .fail("Names", "needs 'Analysis = dynamic': statics has no waves.");
    if (boundary.sampled_field.has_box
        && boundary.formulation == Formulation::convolution_quadrature)
      ParameterSection(top, "Sampled field")
          .fail("Box", "asks for the field in the domain, which is computed "
                       "with Galerkin and collocation only: leave it empty, "
                       "or change 'Formulation'.");
    check_boundary_histories(top, parameters);
  }
} // namespace quoin
