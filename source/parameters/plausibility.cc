// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/finite_numbers.h>
#include <quoin/base/known_names.h>
#include <quoin/base/noted_parameters.h>
#include <quoin/base/number_text.h>
#include <quoin/parameters/plausibility.h>
#include <quoin/signals/record.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace quoin
{
  namespace
  {
    /** Values between which nearly all are, and what others may mean. */
    struct Range
    {
      std::string name;
      double low, high;
      std::string unit;
      /** "in GPa it would be 8e9 Pa", of a value beyond the range; or empty. */
      std::function<std::string(double)> meant;
    };

    std::string meant_density(const double value)
    {
      constexpr double gravity = 9.81;
      if (value > 0.5 && value < 12.)
        return text_of("in t/m^3 it would be ", 1e3 * value, " kg/m^3");
      if (value >= 12. && value < 40.)
        return text_of("as a unit weight in kN/m^3 it would be ",
                       1e3 * value / gravity, " kg/m^3");
      if (value > 12e3 && value < 40e3)
        return text_of("as a unit weight in N/m^3 it would be ",
                       value / gravity, " kg/m^3");
      return "";
    }

    std::string meant_modulus(const double value)
    {
      if (value >= 0.01 && value < 1e3)
        return text_of("in GPa it would be ", 1e9 * value, " Pa");
      if (value >= 1e3 && value < softest_modulus)
        return text_of("in MPa it would be ", 1e6 * value, " Pa");
      return "";
    }

    std::string meant_stiffness(const double value)
    {
      if (value >= 0.1 && value < 1e3)
        return text_of("in GPa/m, which is MPa/mm and N/mm^3, it would be ",
                       1e9 * value, " Pa/m");
      if (value >= 1e3 && value < softest_joint)
        return text_of("in MPa/m it would be ", 1e6 * value, " Pa/m");
      return "";
    }

    std::string meant_angle(const double value)
    {
      return text_of("as a coefficient of friction it would be an angle of ",
                     std::atan(value) / constants::degree, " degrees");
    }

    std::string meant_strength(const double value)
    {
      return value >= 0.01 ? text_of("in kPa it would be ", 1e3 * value,
                                     " Pa, in MPa ", 1e6 * value, " Pa")
                           : "";
    }

    const Range density{ "Density", 100., 12e3, "kg/m^3", meant_density };
    const Range modulus{ "Young's modulus", softest_modulus, 2e12, "Pa",
                         meant_modulus };
    const Range friction{ "Friction angle", 2., 90., "degrees", meant_angle };
    constexpr double weakest = 100.; // [Pa]
    const Range cohesion{ "Cohesion", weakest, 1e10, "Pa", meant_strength };
    const Range tension{ "Tensile strength", weakest, 1e10, "Pa",
                         meant_strength };
    const Range stiffness{ "Normal stiffness", softest_joint, 1e16, "Pa/m",
                           meant_stiffness };
    const Range shear_stiffness{ "Shear stiffness", softest_joint, 1e16, "Pa/m",
                                 meant_stiffness };
    const Range crushing{ "Compressive strength", 1e4, 1e10, "Pa",
                          meant_strength };
    std::string meant_length(const double value)
    {
      return text_of("in mm it would be ", 1e-3 * value, " m");
    }

    std::string meant_force(const double value)
    {
      return text_of("in kN it would be ", 1e3 * value, " N");
    }

    std::string meant_moment(const double value)
    {
      return text_of("in kN m it would be ", 1e3 * value, " N m");
    }

    std::string meant_line_force(const double value)
    {
      return text_of("in kN/m it would be ", 1e3 * value, " N/m");
    }

    std::string meant_spring(const double value)
    {
      return text_of("in kN/mm it would be ", 1e6 * value, " N/m");
    }

    std::string meant_area(const double value)
    {
      return text_of("in mm^2 it would be ", 1e-6 * value, " m^2, in cm^2 ",
                     1e-4 * value, " m^2");
    }

    std::string meant_second_moment(const double value)
    {
      return text_of("in mm^4 it would be ", 1e-12 * value, " m^4, in cm^4 ",
                     1e-8 * value, " m^4");
    }

    std::string meant_unit_weight(const double value)
    {
      if (value < 50.)
        return text_of("in kN/m^3 it would be ", 1e3 * value, " N/m^3");
      return text_of("as a density in kg/m^3 it would be ", 9.81 * value,
                     " N/m^3");
    }

    std::string meant_viscosity(const double value)
    {
      return text_of("in mPa s, which is cP, it would be ", 1e-3 * value,
                     " Pa s");
    }

    const Range thickness{ "Thickness", 1e-3, 50., "m", meant_length };
    const Range wall_strength{ "Joint wall strength", 1e5, 1e9, "Pa",
                               meant_strength };
    const Range closure{ "Largest closure", 1e-7, 0.02, "m", meant_length };
    std::string meant_share(const double value)
    {
      return text_of("in per cent it would be ", 0.01 * value);
    }
    const Range stress_ratio{ "Horizontal ratio", 0., 5.,
                              "times the vertical stress", meant_share };
    const Range peak_slip{ "Peak slip", 1e-7, 0.1, "m", meant_length };
    const Range unit_weight{ "Unit weight", 5e3, 1e5, "N/m^3",
                             meant_unit_weight };
    const Range water_weight{ "Unit weight", 5e3, 3e4, "N/m^3",
                              meant_unit_weight };
    const Range viscosity{ "Viscosity", 1e-4, 0.2, "Pa s", meant_viscosity };

    /** Lengths of a generated wall; the first that is beyond its range is
       warned of, because the others have the same mistake. */
    const Range wall_lengths[]
        = { { "Unit length", 0.02, 10., "m", meant_length },
            { "Unit height", 0.01, 5., "m", meant_length },
            { "Length", 0.05, 500., "m", meant_length },
            { "Thickness", 0.01, 20., "m", meant_length } };

    /** Ranges of values in all sections of a kind. */
    struct KindOfSection
    {
      std::string section, what;
      std::vector<Range> ranges;
    };
    const std::vector<KindOfSection> &kinds_of_sections()
    {
      static const std::vector<KindOfSection> kinds = {
        { "Reinforcement",
          "bolts",
          { { "Diameter", 1e-3, 1., "m", meant_length },
            { "Young's modulus", 1e9, 1e12, "Pa", meant_modulus },
            { "Yield force", 1e3, 1e9, "N", meant_force },
            { "Bond stiffness", 1e5, 1e13, "Pa", meant_modulus },
            { "Rupture strain", 1e-4, 0.499, "", meant_share },
            { "Spacing", 0.02, 50., "m", meant_length },
            { "Pretension", 1e3, 1e9, "N", meant_force },
            { "Bond strength", 1e3, 1e9, "N/m", meant_line_force },
            { "Plate strength", 1e3, 1e9, "N", meant_force },
            { "Anchor strength", 1e3, 1e9, "N", meant_force },
            { "Dowel strength", 1e3, 1e9, "N", meant_force },
            { "Dowel axial strength", 1e3, 1e9, "N", meant_force },
            { "Plate stiffness", 1e4, 1e14, "N/m", meant_spring },
            { "Anchor stiffness", 1e4, 1e14, "N/m", meant_spring },
            { "Dowel stiffness", 1e4, 1e14, "N/m", meant_spring },
            { "Dowel axial stiffness", 1e4, 1e14, "N/m", meant_spring } } },
        { "Beams",
          "beam",
          { { "Young's modulus", 1e8, 1e12, "Pa", meant_modulus },
            { "Thickness", 1e-3, 20., "m", meant_length },
            { "Area", 1e-6, 20., "m^2", meant_area },
            { "Second moment", 1e-14, 100., "m^4", meant_second_moment },
            { "Depth", 1e-3, 20., "m", meant_length },
            density,
            crushing,
            tension,
            { "Spacing", 0.02, 50., "m", meant_length },
            { "Hinge moment", 100., 1e10, "N m", meant_moment } } },
        { "Water joints",
          "water joints",
          { { "Initial aperture", 1e-8, 0.05, "m", meant_length } } }
      };
      return kinds;
    }

    /** Adds a warning if the value of @p range in @p section, which is called
        @p where, is beyond it, but for 0 and words. */
    void check(const ParameterSection &section, const std::string &where,
               const Range &range, std::vector<std::string> &warnings)
    {
      const auto values = finite_numbers({ section.text(range.name) });
      if (values.size() != 1 || values[0] == 0.
          || (values[0] >= range.low && values[0] <= range.high))
        return;
      const std::string meant = range.meant(values[0]);
      warnings.push_back(
          text_of(where, "'", range.name, " = ", values[0], "'",
                  range.unit.empty() ? "" : " ", range.unit,
                  values[0] < range.low ? " is far less" : " is far more",
                  " than usual", meant.empty() ? "" : ": ", meant,
                  ". Check the unit."));
    }

    /** Adds a warning if the dip of @p section, which is called @p where, looks
        like one in radians: hardly any set dips by so little and no round
        number. */
    void check_dip(const ParameterSection &section, const std::string &where,
                   std::vector<std::string> &warnings)
    {
      const auto values = finite_numbers({ section.text("Dip") });
      if (values.size() != 1)
        return;
      const double dip = std::abs(values[0]), rounded = std::round(2. * dip);
      if (dip > 0.05 && dip < 0.5 * constants::pi && rounded != 2. * dip)
        warnings.push_back(text_of(where, "'Dip = ", values[0],
                                   "' degrees is nearly level: in radians it "
                                   "would be ",
                                   values[0] / constants::degree,
                                   " degrees. Check the unit."));
    }

    /** Times at the start, in the middle and at the end of the stages in which
        @p load acts; late ones where their length is not known before. */
    std::vector<TimePoint> times_of(const LoadParameters &load,
                                    const Parameters &parameters)
    {
      std::vector<TimePoint> times;
      double begin = 0.;
      for (const StageParameters &stage : parameters.stages)
      {
        const double length = stage.duration > 0. && stage.end == StageEnd::time
                                  ? stage.duration
                              : parameters.is_implicit ? 1.
                                                       : late_time;
        if (names_load(stage, load.name))
          for (const double t : { 0., 0.5 * length, length })
            times.push_back({ t, begin + t });
        begin += length;
      }
      return times;
    }

    /** Pressure beyond which a joint gains strength as it fails [Pa]; infinite:
        at none. */
    double pressure_of_gain(const JointLaw &law)
    {
      const auto *coulomb   = std::get_if<CoulombLaw>(&law);
      const auto *composite = std::get_if<CompositeLaw>(&law);
      double loss = 0., gain = 0.; // of cohesion [Pa], of friction
      if (coulomb)
      {
        loss = coulomb->peak.cohesion - coulomb->residual.cohesion;
        gain = coulomb->residual.friction - coulomb->peak.friction;
      }
      if (composite)
      {
        loss = composite->cohesion;
        gain = composite->residual_friction - composite->friction;
      }
      return gain > 1e-9 ? loss / gain
                         : std::numeric_limits<double>::infinity();
    }

    /** Whether all components of a gravity are the number 0 or free. */
    bool is_without_weight(const LoadParameters &load,
                           const ParameterSection &top)
    {
      const ParameterSection loads(top, "Loads");
      const ParameterSection own(loads, load.name);
      const std::string names[] = { "Horizontal", "Lateral", "Vertical" };
      return load.type == LoadType::gravity
             && std::all_of(std::begin(names), std::end(names),
                            [&](const std::string &name)
                            {
                              const auto value
                                  = finite_numbers({ own.text(name) });
                              return own.text(name) == "free"
                                     || (value.size() == 1 && value[0] == 0.);
                            });
    }

    /** The acceleration of a load that alone gives blocks a vertical weight, if
        it is a number, otherwise 0 [m/s^2]. */
    double lone_weight(const LoadParameters &load,
                       const std::vector<LoadParameters> &loads)
    {
      const auto has_vertical = [](const LoadParameters &each)
      {
        const LoadComponent &vertical = each.components[1];
        return each.type == LoadType::gravity
               && vertical.quantity != LoadQuantity::free
               && !(vertical.value.is_constant()
                    && vertical.value({ 0., 0. }) == 0.);
      };
      const LoadComponent &own = load.components[1];
      return has_vertical(load) && own.value.is_constant()
                     && std::count_if(loads.begin(), loads.end(), has_vertical)
                            == 1
                 ? own.value({ 0., 0. })
                 : 0.;
    }

    bool have_common_blocks(const LoadParameters &a, const LoadParameters &b)
    {
      return a.groups.empty() || b.groups.empty()
             || std::any_of(a.groups.begin(), a.groups.end(),
                            [&](const std::string &group)
                            { return is_among(group, b.groups); });
    }

    /** Whether @p load is a weight that acts upwards all the time in a stage,
        also together with the others there on the same blocks, such as a
        seismic part beside the weight. Load patterns, which may have any
        direction, are no loads of a stage. */
    bool acts_upwards(const LoadParameters &load, const Parameters &parameters)
    {
      const auto is_upwards
          = [](const std::vector<const LoadParameters *> &loads)
      {
        const double times[] = { 0., 0.37, 41., late_time };
        return std::all_of(std::begin(times), std::end(times),
                           [&](const double t)
                           {
                             double sum = 0.;
                             for (const LoadParameters *each : loads)
                               if (each->components[1].quantity
                                   != LoadQuantity::free)
                                 sum += each->components[1].value({ t, t });
                             return sum > 0.;
                           });
      };
      if (load.type != LoadType::gravity || !is_upwards({ &load }))
        return false;
      return std::any_of(parameters.stages.begin(), parameters.stages.end(),
                         [&](const StageParameters &stage)
                         {
                           std::vector<const LoadParameters *> together;
                           for (const LoadParameters &other : parameters.loads)
                             if (other.type == LoadType::gravity
                                 && names_load(stage, other.name)
                                 && have_common_blocks(load, other))
                               together.push_back(&other);
                           return names_load(stage, load.name)
                                  && is_upwards(together);
                         });
    }
  } // namespace

  std::vector<std::string> implausible_values(const ParameterSection &top,
                                              const Parameters &parameters)
  {
    std::vector<std::string> warnings;
    if (!parameters.is_boundary_model)
      check(top, "", thickness, warnings);
    {
      const ParameterSection section(top, "Materials");
      for (const MaterialParameters &material : parameters.model.materials)
      {
        const std::string where = "material " + material.name + ": ";
        const ParameterSection own(section, material.name);
        check(own, where, density, warnings);
        if (!material.rigid)
          check(own, where, modulus, warnings);
        for (const Range *range : { &cohesion, &friction, &tension })
          check(own, where, *range, warnings);
      }
    }
    {
      const ParameterSection section(top, "Joints");
      for (const JointSetParameters &set : parameters.model.joints)
      {
        const ParameterSection own(section, set.name);
        const std::string where = "joints " + set.name + ": ";
        const std::size_t n     = warnings.size();
        check(own, where, stiffness, warnings);
        if (warnings.size() == n) // it would be the same mistake
          check(own, where, shear_stiffness, warnings);
        for (const Range *range : { &cohesion, &friction, &tension, &crushing,
                                    &wall_strength, &closure, &peak_slip })
          check(own, where, *range, warnings);
        if (const double pressure = pressure_of_gain(set.law);
            std::isfinite(pressure))
          warnings.push_back(text_of(
              where, "beyond a pressure of ", pressure,
              " Pa the failed joint is stronger than the intact one, as its "
              "'Residual friction angle' is larger: forces and factors of "
              "safety may be too large there. Give at most 'Friction angle' "
              "unless tests reached such pressures."));
      }
    }
    for (const KindOfSection &kind : kinds_of_sections())
    {
      const ParameterSection section(top, kind.section);
      for (const std::string &name : section.list("Names"))
        for (const Range &range : kind.ranges)
          check(ParameterSection(section, name), kind.what + " " + name + ": ",
                range, warnings);
    }
    for (const char *kind : { "Rock joints", "Rock joint sets" })
    {
      const ParameterSection section(top, kind);
      for (const std::string &name : section.list("Names"))
        check_dip(ParameterSection(section, name), "joint set " + name + ": ",
                  warnings);
    }
    if (parameters.generated.name == "wall")
    {
      const std::size_t n = warnings.size();
      for (const Range &range : wall_lengths)
        if (warnings.size() == n)
          check(ParameterSection(top, "Wall"), "wall: ", range, warnings);
    }
    for (const Range *range : { &water_weight, &viscosity })
      check(ParameterSection(top, "Water"), "water: ", *range, warnings);
    // Beside a gravity that acts one of 0 may be there for --set.
    const bool has_weight
        = std::any_of(parameters.loads.begin(), parameters.loads.end(),
                      [&](const LoadParameters &load) {
                        return load.type == LoadType::gravity
                               && !is_without_weight(load, top);
                      });
    /** Acceleration that no weight of a structure has [m/s^2]. */
    constexpr double most_gravity = 100.;
    for (const LoadParameters &load : parameters.loads)
    {
      if (load.type == LoadType::gravity)
        for (const auto &given : load.given_components())
          for (const TimePoint &time : times_of(load, parameters))
            if (const double value = given.component.value(time);
                std::abs(value) > most_gravity)
            {
              warnings.push_back(
                  text_of("load ", load.name, ": gravity of ", value,
                          " m/s^2 is far more than usual. Check the unit."));
              break;
            }
      // A seismic coefficient may be a tenth, but beside the weight.
      constexpr double on_earth = 9.81, digits = 0.005;
      const double weight = lone_weight(load, parameters.loads);
      for (const double power : { 0.1, 10. })
        if (std::abs(std::abs(weight) / (power * on_earth) - 1.) < digits)
          warnings.push_back(
              text_of("load ", load.name, ": gravity of ", weight, " m/s^2 is ",
                      power < 1. ? "a tenth of" : "ten times",
                      " that on the earth, and no other load has a weight. "
                      "Check the decimal point, unless that is meant."));
      if (!has_weight && is_without_weight(load, top))
        warnings.push_back(
            "load " + load.name
            + ": a gravity of 0 in all directions does nothing. Give "
              "'Vertical', such as -9.81, or remove the load.");
      if (load.type == LoadType::initial_stress)
        for (const Range *range : { &unit_weight, &stress_ratio })
          check(ParameterSection(ParameterSection(top, "Loads"), load.name),
                "load " + load.name + ": ", *range, warnings);
      if (acts_upwards(load, parameters))
        warnings.push_back("load " + load.name
                           + ": gravity acts upwards. Give 'Vertical' a minus "
                             "sign, such as -9.81, unless that is meant.");
    }
    return warnings;
  }

  std::vector<std::string> idle_damping(const ParameterSection &top,
                                        const Parameters &parameters)
  {
    std::vector<std::string> warnings;
    if (parameters.is_implicit)
      return warnings;
    // Options may change the damping of a file that is made for another one;
    // of their own entries that nothing reads there is a warning in any case.
    const auto set_in_file = [&](const std::string &entry)
    {
      const auto place = parameters.places.find(entry);
      return place != parameters.places.end()
             && place->second.find(" with --set") == std::string::npos;
    };
    const ParameterSection section(top, "Stages");
    for (const StageParameters &stage : parameters.stages)
    {
      const std::string path = "Stages/" + stage.name;
      const auto where       = [&](const std::string &entry)
      { return parameters.places.at(entry) + section_phrase(path) + ": "; };
      const std::string damping = path + "/Damping";
      const bool was_set        = parameters.places.count(damping) > 0;
      if (stage.damping == DampingType::rayleigh)
      {
        if (stage.mass_coefficient + stage.stiffness_coefficient == 0.)
          warnings.push_back(
              where(damping)
              + "'Damping = Rayleigh' dissipates nothing, as both of its "
                "coefficients are 0. Give 'Rayleigh stiffness coefficient' or "
                "'Rayleigh mass coefficient', or take 'Damping = none'.");
        continue;
      }
      if (was_set && !set_in_file(damping))
        continue;
      const ParameterSection own(section, stage.name);
      for (const std::string name :
           { "Rayleigh mass coefficient", "Rayleigh stiffness coefficient" })
      {
        const auto values = finite_numbers({ own.text(name) });
        if (set_in_file(path + "/" + name)
            && !(values.size() == 1 && values[0] == 0.))
          warnings.push_back(
              where(path + "/" + name) + "'" + name + " = " + own.text(name)
              + "' has no effect: 'Damping = " + own.text("Damping")
              + "' does not read it. Give the stage 'Damping = Rayleigh', or "
                "remove it.");
      }
    }
    return warnings;
  }

  namespace
  {
    /** The file of a place "FILE, line N" or "FILE with --set ...". */
    std::string file_of(const std::string &place)
    {
      return place.substr(
          0, std::min(place.rfind(", line "), place.find(" with --set")));
    }
  } // namespace

  std::vector<std::string> idle_properties(const NotedParameters &prm,
                                           const ParameterSection &top)
  {
    std::vector<std::string> warnings;
    for (const std::string kind : { "Materials", "Joints", "Histories" })
      for (const std::string &name : ParameterSection(top, kind).list("Names"))
      {
        const bool is_history     = kind == "Histories";
        const std::string chooser = is_history ? "Quantity" : "Law";
        const std::string path    = kind + "/" + name;
        const std::string word
            = ParameterSection(ParameterSection(top, kind), name).text(chooser);
        if (word == "rigid") // its moduli wait for deformable blocks
          continue;
        // An option or a file may choose another law for one that it includes.
        const auto law       = prm.places.find(path + "/" + chooser);
        const auto is_option = [](const std::string &place)
        { return place.find(" with --set") != std::string::npos; };
        const auto is_elsewhere = [&](const std::string &place)
        {
          return is_option(place)
                 || (law != prm.places.end()
                     && (is_option(law->second)
                         || file_of(law->second) != file_of(place)));
        };
        std::string names, place;
        for (auto entry = prm.places.lower_bound(path + "/");
             entry != prm.places.end()
             && entry->first.rfind(path + "/", 0) == 0;
             ++entry)
          if (prm.read.count(entry->first) == 0 && !is_elsewhere(entry->second))
          {
            names += (names.empty() ? "'" : ", '")
                     + entry->first.substr(path.size() + 1) + "'";
            if (place.empty())
              place = entry->second;
          }
        if (!names.empty())
          warnings.push_back(
              place + section_phrase(path) + ": '" + chooser + " = " + word
              + "' does not read " + names + ". Choose the "
              + (is_history ? "quantity" : "law") + " that is meant, or remove "
              + (names.find(',') == std::string::npos ? "it." : "them."));
      }
    return warnings;
  }

  std::vector<std::string> idle_motion(const Parameters &parameters)
  {
    std::vector<std::string> warnings;
    if (!parameters.is_implicit)
      return warnings;
    const auto where = [&](const std::string &path, const std::string &entry)
    {
      const auto place = parameters.places.find(path + "/" + entry);
      return (place == parameters.places.end() ? parameters.file
                                               : place->second)
             + section_phrase(path) + ": ";
    };
    for (const HistoryParameters &history : parameters.histories)
      if (history.quantity == HistoryQuantity::velocity
          || history.quantity == HistoryQuantity::block_velocity
          || history.quantity == HistoryQuantity::boundary_velocity
          || history.quantity == HistoryQuantity::kinetic_share)
        warnings.push_back(
            where("Histories/" + history.name, "Quantity")
            + "'Quantity = " + history.word
            + "' is 0 in all rows: 'Solver = implicit' leaves out motion. "
              "Record a displacement, or take 'explicit'.");
    for (const LoadParameters &load : parameters.loads)
      if (load.has_added_mass)
        warnings.push_back(
            where("Loads/" + load.name, "Added mass")
            + "'Added mass = Westergaard' does nothing: 'Solver = implicit' "
              "leaves out motion, and the mass of the water with it. Its "
              "pressure acts. Take 'explicit' for an earthquake, or 'none'.");
    return warnings;
  }

  std::vector<std::string> long_time_files(const Parameters &parameters)
  {
    /** How many times as long as the run, with how many samples in it and at
        least in all: few may be a slow change. */
    constexpr double times_run        = 20.;
    constexpr std::ptrdiff_t n_in_run = 3, n_in_all = 10;
    double end = 0.;
    for (const StageParameters &stage : parameters.stages)
      if (stage.end == StageEnd::time)
        end += stage.duration;
    std::vector<std::string> warnings;
    for (const std::string &file : parameters.time_files)
    {
      TimeTable samples;
      try
      {
        samples = Record::read(file).samples();
      }
      catch (const InputError &)
      {
        continue; // a table of one line
      }
      const double last = samples.back().first;
      const auto n
          = std::count_if(samples.begin(), samples.end(),
                          [&](const std::pair<double, double> &sample) {
                            return sample.first >= 0. && sample.first <= end;
                          });
      if (end > 0. && last > times_run * end && n < n_in_run
          && std::ptrdiff_t(samples.size()) >= n_in_all)
        warnings.push_back(text_of(
            "the times in '", file, "' go on to ", last,
            " s, but the run ends "
            "after ",
            end, " s, within ", n, " of its ", samples.size(),
            " lines. If they are in milliseconds, change them to seconds."));
    }
    return warnings;
  }
} // namespace quoin
