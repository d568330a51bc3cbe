// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/base/unread_parameters.h>
#include <quoin/loads/load_components.h>
#include <quoin/loads/load_field.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/loads/stress_entries.h>
#include <quoin/loads/traction_entries.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Names of 'Type'; an in-situ stress is an initial stress by depth. */
    const std::vector<std::pair<std::string, LoadType>> type_words
        = { { "prescribed motion", LoadType::prescribed_motion },
            { "traction", LoadType::traction },
            { "viscous boundary", LoadType::viscous_boundary },
            { "free-field boundary", LoadType::free_field },
            { "platen", LoadType::platen },
            { "gravity", LoadType::gravity },
            { "initial stress", LoadType::initial_stress },
            { "in-situ stress", LoadType::initial_stress },
            { "boundary elements", LoadType::boundary_elements } };

    /** Name of each of LoadParameters::functions() and its unit as a force. */
    struct ComponentWord
    {
      std::string name, force_unit;
    };
    std::vector<ComponentWord> component_words(const LoadType type)
    {
      switch (type)
      {
      case LoadType::traction:
        return { { "Horizontal", "Pa" },
                 { "Vertical", "Pa" },
                 {},
                 { "Lateral", "Pa" },
                 { "Pressure", "Pa" } };
      case LoadType::gravity:
        return { { "Horizontal", "m/s^2" },
                 { "Vertical", "m/s^2" },
                 {},
                 { "Lateral", "m/s^2" } };
      case LoadType::viscous_boundary:
        return { { "Incident normal velocity", "" },
                 { "Incident shear velocity", "" },
                 {},
                 { "Incident lateral velocity", "" } };
      case LoadType::prescribed_motion:
      case LoadType::platen:
        return { { "Horizontal", "N" },
                 { "Vertical", "N" },
                 { "Rotation", "N m" },
                 { "Lateral", "N" },
                 {},
                 { "Rotation x", "N m" },
                 { "Rotation y", "N m" } };
      default:
        return {};
      }
    }

    void refuse_unread_parameters(const ParameterSection &section)
    {
      const std::vector<std::string> initial = { "initial stress" };
      const std::vector<std::string> in_situ = { "in-situ stress" };
      const std::vector<std::string> viscous = { "viscous boundary" };
      const std::vector<std::string> directed
          = { "prescribed motion", "traction", "platen", "gravity" };
      refuse_unread(
          section, "Type",
          { { "Boundary",
              "",
              { "prescribed motion", "traction", "viscous boundary",
                "free-field boundary", "platen" } },
            { "Group", "", { "platen" } },
            { "Groups", "", { "initial stress", "in-situ stress", "gravity" } },
            { "Quantity", "velocity", { "prescribed motion" } },
            { "Horizontal", "free", directed },
            { "Vertical", "free", directed },
            { "Lateral",
              "free",
              { "prescribed motion", "traction", "platen", "gravity" } },
            { "Rotation", "free", { "platen" } },
            { "Rotation x", "free", { "platen" } },
            { "Rotation y", "free", { "platen" } },
            { "Pressure", "free", { "traction" } },
            { "Ramp duration", "automatic", { "gravity" } },
            { "Headwater", "", { "traction" } },
            { "Tailwater", "", { "traction" } },
            { "Heel", "", { "traction" } },
            { "Toe", "", { "traction" } },
            { "Drain distance", "0", { "traction" } },
            { "Drain efficiency", "0", { "traction" } },
            { "Drain level", "tailwater", { "traction" } },
            { "In cracks", "given", { "traction" } },
            { "Added mass", "none", { "traction" } },
            { "Reservoir floor", "automatic", { "traction" } },
            { "Distribution", "1", { "traction", "gravity" } },
            { "Moving shape", "none", { "traction" } },
            { "Moving centre", "", { "traction" } },
            { "Moving width", "0", { "traction" } },
            { "Moving axis", "x", { "traction" } },
            { "Incident normal velocity", "0", viscous },
            { "Incident shear velocity", "0", viscous },
            { "Incident lateral velocity", "0", viscous },
            { "Far field material", "", viscous },
            { "Incident direction", "", viscous },
            { "Incident origin", "", viscous },
            { "Free surface", "none", viscous },
            { "Base", "", { "free-field boundary" } },
            { "Stress", "0, 0, 0", initial },
            { "Stress gradient", "0, 0, 0", initial },
            { "Stress zz", "elastic", initial },
            { "Surface", "0", in_situ },
            { "Unit weight", "", in_situ },
            { "Surface pressure", "0", in_situ },
            { "Horizontal ratio", "1", in_situ },
            { "Horizontal surface stress", "0", in_situ },
            { "Out-of-plane ratio", "same", in_situ } });
    }

    /** Refuses a load that does nothing or acts nowhere. */
    void refuse_idle(const ParameterSection &section,
                     const LoadParameters &load)
    {
      if ((load.type == LoadType::prescribed_motion
           || load.type == LoadType::traction || load.type == LoadType::gravity)
          && load.given_components().empty())
        section.fail("Vertical", "and 'Horizontal' are free, and nothing else "
                                 "is given: the load would do nothing. Give "
                                 "one.");
      if ((load.type == LoadType::prescribed_motion
           || load.type == LoadType::traction
           || load.type == LoadType::viscous_boundary
           || load.type == LoadType::free_field)
          && load.boundaries.empty())
        section.fail("Boundary", "must name a physical curve of the mesh.");
    }
  } // namespace

  double LoadComponent::at(const dealii::Point<3> &place,
                           const TimePoint &time) const
  {
    return field ? (*field)(place, time, 1) : value(time);
  }

  bool LoadParameters::differs_by_place() const
  {
    const auto all = functions();
    return shape
           || std::any_of(all.begin(), all.end(),
                          [](const LoadComponent &part)
                          { return part.field != nullptr; });
  }

  bool LoadParameters::is_water_that_follows() const
  {
    return pressure.field && pressure.field->is_water_at_rest() && !shape
           && !distribution;
  }

  bool LoadParameters::is_pressure_alone() const
  {
    const auto given = given_components();
    return type == LoadType::traction && given.size() == 1
           && pressure.quantity != LoadQuantity::free;
  }

  std::array<double, 3>
  component_values(const std::array<LoadComponent, 3> &components,
                   const TimePoint &time)
  {
    std::array<double, 3> values{};
    for (unsigned int d = 0; d < 3; ++d)
      if (components[d].quantity != LoadQuantity::free)
        values[d] = components[d].value(time);
    return values;
  }

  void check_no_jump(const std::array<LoadComponent, 3> &components,
                     const std::array<const char *, 3> &names,
                     const TimePoint &time, const std::string &load)
  {
    const auto values = component_values(components, time);
    for (unsigned int d = 0; d < 3; ++d)
      if (components[d].quantity == LoadQuantity::displacement
          && std::abs(values[d]) > 1e-14)
        throw InputError(text_of(
            "section 'Loads/", load, "': the displacement '", names[d], "' is ",
            values[d],
            " where the stage begins. It counts from there, so it must begin "
            "at 0: let it rise from 0."));
  }

  namespace
  {
    /** Refuses an expression of z of the load @p name in the plane. */
    [[noreturn]] void refuse_z(const std::string &name,
                               const std::string &entry)
    {
      throw InputError("section 'Loads/" + name + "': '" + entry
                       + "' depends on z, which is 0 all over a model in two "
                         "dimensions, whose height is y. Write y for the "
                         "height, or take a mesh of tetrahedra.");
    }
  } // namespace

  template <>
  LoadParameters LoadParameters::along_axes<2>() const
  {
    if (lateral.quantity != LoadQuantity::free)
      throw InputError("section 'Loads/" + name + "': '"
                       + (type == LoadType::viscous_boundary
                              ? "Incident lateral velocity"
                              : "Lateral")
                       + "' is along the third axis, which a model "
                         "in two dimensions does not have. Remove it, or take "
                         "a mesh of tetrahedra.");
    if (wave_direction)
      throw InputError("section 'Loads/" + name
                       + "': 'Incident direction' is for models in three "
                         "dimensions. In the plane, waves of any direction "
                         "come through boundary elements: section 'Incident "
                         "waves'.");
    for (const unsigned int d : { 0, 1 })
      if (rotations[d].quantity != LoadQuantity::free)
        throw InputError("section 'Loads/" + name + "': 'Rotation "
                         + (d == 0 ? "x" : "y")
                         + "' is out of the plane of a model in two "
                           "dimensions. Take 'Rotation', or a mesh of "
                           "tetrahedra.");
    if (shape && shape->axis == 2)
      throw InputError("section 'Loads/" + name
                       + "': 'Moving axis = z' does not exist in two "
                         "dimensions. Take x or y.");
    const auto words = component_words(type);
    const auto all   = functions();
    for (unsigned int d = 0; d < words.size(); ++d)
      if (all[d].field && all[d].field->depends_on_z())
        refuse_z(name, words[d].name);
    if (distribution && distribution->depends_on_z())
      refuse_z(name, "Distribution");
    return *this;
  }

  template <>
  LoadParameters LoadParameters::along_axes<3>() const
  {
    LoadParameters result = *this;
    if (type == LoadType::prescribed_motion || type == LoadType::traction
        || type == LoadType::gravity || type == LoadType::platen)
      result.components = { components[0], lateral, components[1] };
    if (type == LoadType::platen)
      result.rotations[2] = components[2];
    if (type == LoadType::viscous_boundary)
      result.components[2] = lateral;
    return result;
  }

  namespace
  {
    void enter_place(ParameterEntries &entries, LoadParameters &load)
    {
      entries.choice("Type", load.type, type_words,
                     "Type of the load; 'boundary elements' are described in "
                     "section 'Boundary elements'.");
      entries.list("Boundary", load.boundaries,
                   "Physical curves on which the load acts; where a "
                   "traction is a pressure alone, also joints, on both "
                   "faces.");
      if (const ParameterSection *section = entries.read_section())
        refuse_unread_parameters(*section);
      if (entries.reads_if(load.type == LoadType::platen))
        entries.list("Group", load.groups,
                     "Physical surfaces whose blocks form the rigid body of a "
                     "platen, instead of a boundary.");
      if (entries.reads_if(load.type == LoadType::initial_stress
                           || load.type == LoadType::gravity))
        entries.list("Groups", load.groups,
                     "Physical surfaces in which gravity, initial or in-situ "
                     "stress acts; empty: all surfaces.");
    }

    /** A factor by place; none if the text is 1. */
    std::optional<SpaceTimeFunction>
    distribution(const ParameterSection &section)
    {
      const std::string name = "Distribution", text = section.text(name);
      if (text == "1")
        return {};
      // Where there are two dimensions along_axes() refuses z.
      const auto factor = section.made(
          name, [&]() { return SpaceTimeFunction(text, section.folder(), 3); });
      if (factor.depends_on_time())
        section.fail(name, "depends on time. Give a factor by place alone, and "
                           "the course in time as 'Horizontal', 'Vertical', "
                           "'Lateral' or 'Pressure'.");
      return factor;
    }

    /** Enters a component that @p read makes from section and name. */
    template <typename Read>
    void enter_component(ParameterEntries &entries, const std::string &name,
                         const std::string &preset, LoadComponent &component,
                         const std::string &sentence, const Read &read)
    {
      entries.other(name, preset, sentence,
                    [&](const ParameterSection &section)
                    { component = read(section, name); });
    }

    void enter_directions(ParameterEntries &entries, LoadParameters &load)
    {
      const bool is_platen = load.type == LoadType::platen;
      const bool is_motion = load.type == LoadType::prescribed_motion;
      const bool is_force
          = load.type == LoadType::traction || load.type == LoadType::gravity;
      LoadQuantity quantity = LoadQuantity::velocity;
      if (entries.reads_if(is_motion))
        entries.choice(
            "Quantity", quantity,
            { { "velocity", LoadQuantity::velocity },
              { "displacement", LoadQuantity::displacement } },
            "Quantity of a prescribed motion. velocity: velocity [m/s]; "
            "displacement: displacement from the start of the stage on [m].");
      if (is_force)
        quantity = LoadQuantity::force;
      const auto plain
          = [&](const ParameterSection &section, const std::string &name)
      {
        return is_platen ? platen_component(section, name)
                         : load_component(section, name, quantity);
      };
      const std::string names[] = { "Horizontal", "Vertical" };
      for (const unsigned int d : { 0, 1 })
        if (entries.reads_if(is_platen || is_motion || is_force))
          enter_component(
              entries, names[d], "free", load.components[d],
              names[d]
                  + " component of the load: a function of t (time in the "
                    "stage) and T (total time) [s], 'table FILE', a signal or "
                    "'free'; tractions and prescribed motions may also depend "
                    "on x, y and, in three dimensions, z in the mesh [m]. Its "
                    "unit is [Pa] for a traction, [m/s^2] for gravity, [m/s] "
                    "or [m] for a prescribed motion; for a platen the function "
                    "is preceded by 'velocity' [m/s], 'displacement' [m] or "
                    "'force' [N].",
              plain);
      if (entries.reads_if(is_platen || is_motion || is_force))
        enter_component(entries, "Lateral", "free", load.lateral,
                        "Component along y of a model in three dimensions, in "
                        "which 'Horizontal' is along x and 'Vertical' along z, "
                        "given in the same way as 'Horizontal'.",
                        plain);
      if (entries.reads_if(is_platen))
        enter_component(
            entries, "Rotation", "free", load.components[2],
            "Rotation of a platen, anticlockwise, in three dimensions about "
            "the vertical: 'velocity' [deg/s], 'displacement' [deg] or "
            "'moment' [N m] and a function of time, or 'free'.",
            rotation_component);
      const std::string axes[] = { "x", "y" };
      for (const unsigned int d : { 0, 1 })
        if (entries.reads_if(is_platen))
          enter_component(
              entries, "Rotation " + axes[d], "free", load.rotations[d],
              "Rotation of a platen in three dimensions about " + axes[d]
                  + ", given in the same way as 'Rotation'.",
              rotation_component);
      if (entries.reads_if(is_force))
        enter_component(
            entries, "Pressure", "free", load.pressure,
            "Pressure of a traction, which pushes on the block against its "
            "outward normal in the mesh and is added to 'Horizontal' and "
            "'Vertical': a function of place and time as for these; or 'water "
            "LEVEL', the pressure of water whose level is a function of time "
            "[m], 9810 N/m^3 times the depth below it; or 'water through X, Y; "
            "X, Y', that below a line through points with ascending x [m], "
            "level beyond its ends (in three dimensions X, Z, the same along "
            "y); or 'uplift', that in a joint below a dam "
            "from 'Headwater' to 'Tailwater'. Water, but for an uplift, "
            "presses on faces where they have moved to, unless it has a "
            "'Distribution' or a moving shape or is in a 'Load pattern' "
            "[Pa]",
            pressure_component);
      if (entries.reads_if(load.type == LoadType::gravity))
        entries.number_or(
            "automatic", -1., "Ramp duration", load.ramp_duration,
            "Load time over which gravity grows by half a cosine from zero "
            "where it begins; 0: it acts fully at once; automatic: 0 except in "
            "explicit stages with 'End = static ratio' of models without "
            "initial stress, where it is twice the travel time of a shear wave "
            "along the model's diagonal and at least two thousand critical "
            "time steps. Loads that go on from the stage before grow so on "
            "blocks that 'Fill' places, with initial stress, too. Pressures in "
            "joints "
            "that begin in the same stage grow with it, and, without initial "
            "stress, in a stage with 'End = static ratio' also tractions and "
            "the forces on platens and on beams that the stage places [s]");
      if (entries.reads_if(is_force))
        entries.other(
            "Distribution", "1",
            "Spatial distribution of a traction or of gravity: a factor on the "
            "load as an expression of x, y and, in three dimensions, z in the "
            "mesh [m], such as y/12 for a load that grows with the height [-]",
            [&](const ParameterSection &from)
            { load.distribution = distribution(from); });
      if (entries.reads_if(load.type == LoadType::traction))
        enter_traction(entries, load);
      const ParameterSection *section = entries.read_section();
      if (section && is_platen
          && load.groups.empty() == load.boundaries.empty())
        section->fail("Group",
                      "and 'Boundary': a platen takes one of the two.");
      if (section && load.type == LoadType::gravity && load.ramp_duration < 0.
          && section->text("Ramp duration") != "automatic")
        section->fail("Ramp duration",
                      "must be 'automatic' or a time that is not negative.");
    }

    /** Three numbers, or nothing. */
    std::optional<std::array<double, 3>>
    numbers_or_none(const ParameterSection &section, const std::string &name)
    {
      if (section.text(name).empty())
        return {};
      return section.numbers<3>(name);
    }

    void enter_plane_waves(ParameterEntries &entries, LoadParameters &load)
    {
      entries.other(
          "Incident direction", "",
          "Direction x, y, z in which plane waves propagate that pass a "
          "viscous "
          "boundary in three dimensions, of any length; empty: they come along "
          "the normal. The incident normal velocity is then that of a P wave, "
          "the shear velocity that of an SV wave, the lateral velocity that of "
          "an SH wave, as they pass 'Incident origin'.",
          [&](const ParameterSection &section)
          {
            const auto d = numbers_or_none(section, "Incident direction");
            if (!d)
              return;
            load.wave_direction = dealii::Point<3>((*d)[0], (*d)[1], (*d)[2]);
            if (load.wave_direction->norm() == 0.)
              section.fail("Incident direction", "must not be 0, 0, 0.");
          });
      entries.other(
          "Incident origin", "",
          "Place x, y, z that incident plane waves pass at t = 0, before they "
          "reach the boundary; empty: the place that they reach first, of the "
          "boundaries of all loads with the same 'Incident direction' and no "
          "origin [m]",
          [&](const ParameterSection &section)
          {
            if (const auto x = numbers_or_none(section, "Incident origin"))
              load.wave_origin = dealii::Point<3>((*x)[0], (*x)[1], (*x)[2]);
          });
      entries.other(
          "Free surface", "none",
          "Height z of a free horizontal surface above the model, which "
          "reflects incident plane waves before they pass its sides; none: "
          "there is none [m]",
          [&](const ParameterSection &section)
          {
            if (section.text("Free surface") != "none")
              load.free_surface = section.number("Free surface");
          });
      const ParameterSection *section = entries.read_section();
      if (!section || load.wave_direction)
        return;
      if (load.wave_origin)
        section->fail("Incident origin",
                      "goes with an 'Incident direction': give one.");
      if (load.free_surface)
        section->fail("Free surface",
                      "goes with an 'Incident direction': give one.");
    }

    void enter_open_boundary(ParameterEntries &entries, LoadParameters &load)
    {
      if (entries.reads_if(load.type == LoadType::viscous_boundary))
      {
        const std::string names[] = { "normal", "shear", "lateral" };
        LoadComponent *const parts[]
            = { &load.components[0], &load.components[1], &load.lateral };
        const std::string ways[]
            = { "along the inward normal",
                "along the boundary with the block on its left, in three "
                "dimensions of an S wave along x, for which the boundary is "
                "horizontal",
                "in three dimensions of an S wave along y" };
        for (const unsigned int d : { 0, 1, 2 })
          enter_component(
              entries, "Incident " + names[d] + " velocity", "0", *parts[d],
              "Velocity of the wave incident on a viscous boundary, " + ways[d]
                  + ", as a function of time [m/s]",
              [](const ParameterSection &section, const std::string &name)
              {
                return section.text(name) == "0"
                           ? LoadComponent()
                           : load_component(section, name,
                                            LoadQuantity::velocity);
              });
        entries.text(
            "Far field material", load.far_material,
            "Material of the medium beyond a viscous boundary, which gives the "
            "impedances; empty: the material of the cells along the boundary.");
        enter_plane_waves(entries, load);
      }
      if (!entries.reads_if(load.type == LoadType::free_field))
        return;
      entries.text("Base", load.base,
                   "Load on the model's base for a free-field boundary, of "
                   "type 'viscous boundary' or 'prescribed motion', which also "
                   "drives the base of the free-field column.");
      if (entries.read_section() && load.base.empty())
        entries.read_section()->fail("Base", "must name the load on the base "
                                             "of the model.");
    }

    void enter_load(ParameterEntries &entries, LoadParameters &load)
    {
      enter_place(entries, load);
      enter_directions(entries, load);
      enter_open_boundary(entries, load);
      if (entries.reads_if(load.type == LoadType::initial_stress))
        enter_initial_stress(entries, load);
      if (const ParameterSection *section = entries.read_section())
        refuse_idle(*section, load);
    }
  } // namespace

  std::string LoadParameters::type_text() const
  {
    return in_situ ? "in-situ stress" : word_of(type_words, type);
  }

  std::vector<LoadParameters::NamedComponent>
  LoadParameters::given_components() const
  {
    const auto words = component_words(type);
    const std::array<const LoadComponent *, 7> parts
        = { &components[0], &components[1], &components[2], &lateral,
            &pressure,      &rotations[0],  &rotations[1] };
    std::vector<NamedComponent> result;
    for (unsigned int d = 0; d < words.size(); ++d)
    {
      const LoadComponent &part = *parts[d];
      if (part.quantity == LoadQuantity::free)
        continue;
      const std::string length
          = words[d].name.rfind("Rotation", 0) == 0 ? "degrees" : "m";
      result.push_back({ boost::algorithm::to_lower_copy(words[d].name),
                         part.quantity == LoadQuantity::velocity ? length + "/s"
                         : part.quantity == LoadQuantity::displacement
                             ? length
                             : words[d].force_unit,
                         part });
    }
    return result;
  }

  void LoadParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_load);
  }

  LoadParameters LoadParameters::read(const ParameterSection &section,
                                      const std::string &name)
  {
    LoadParameters load = read_entries(section, enter_load);
    load.name           = name;
    return load;
  }
} // namespace quoin
