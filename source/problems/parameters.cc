// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/mesh_parameters.h>
#include <quoin/problems/model_parameters.h>
#include <quoin/problems/parameter_file.h>
#include <quoin/problems/parameters.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/named_sections.h>
#include <quoin/layout/rock_parameters.h>

#include <filesystem>
#include <functional>
#include <set>
#include <sstream>

namespace quoin
{
  namespace
  {
    using dealii::ParameterHandler;
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;
    using dealii::Patterns::Selection;

    /** The sections whose subsections the user names. */
    struct NamedSection
    {
      std::string name;
      std::function<void(ParameterHandler &)> declare_one;
    };

    const std::vector<NamedSection> &named_sections()
    {
      static const std::vector<NamedSection> sections
          = { { "Rock regions", RockRegion::declare },
              { "Rock joints", RockJoints::declare },
              { "Materials", MaterialParameters::declare },
              { "Joints", JointSetParameters::declare },
              { "Loads", LoadParameters::declare },
              { "Stages", StageParameters::declare },
              { "Boundary elements", BoundaryCurveParameters::declare },
              { "Incident waves", IncidentWaveParameters::declare },
              { "Histories", HistoryParameters::declare } };
      return sections;
    }

    void declare_names(ParameterHandler &prm)
    {
      for (const NamedSection &section : named_sections())
      {
        prm.enter_subsection(section.name);
        prm.declare_entry("Names", "", Anything(),
                          "Comma-separated names; each is a subsection.");
        prm.leave_subsection();
      }
    }

    void declare_fixed(ParameterHandler &prm)
    {
      prm.declare_entry("Title", "", Anything(), "For figures and logs.");
      prm.declare_entry("Model", "blocks",
                        Selection("blocks|boundary elements"),
                        "Blocks on joints; or a domain with boundary elements "
                        "alone, which needs no mesh, joints, loads or stages.");
      prm.declare_entry("Solver", "explicit", Selection("explicit|implicit"),
                        "Motion by central differences; or equilibrium by "
                        "Newton's method, without inertia and damping: for "
                        "blocks at small displacements, as section 'Implicit' "
                        "says.");
      prm.declare_entry("Plane assumption", "plane strain",
                        Selection("plane strain|plane stress"),
                        "Of all blocks.");
      prm.declare_entry("Thickness", "1", Double(), "Out of the plane [m]");
      prm.declare_entry("Output directory", "output", Anything(),
                        "Relative to the folder of this file.");

      declare_mesh(prm);

      prm.enter_subsection("Contact");
      ContactParameters::declare(prm);
      prm.leave_subsection();

      prm.enter_subsection("Boundary elements");
      BoundaryElementParameters::declare(prm);
      prm.leave_subsection();

      prm.enter_subsection("Sampled field");
      SampledFieldParameters::declare(prm);
      prm.leave_subsection();

      prm.enter_subsection("Initial motion");
      InitialMotion::declare(prm);
      prm.leave_subsection();

      prm.enter_subsection("Implicit");
      ImplicitParameters::declare(prm);
      prm.leave_subsection();

      prm.enter_subsection("Time stepping");
      prm.declare_entry("Share of critical time step", "0.8", Double(),
                        "Of the bound that is computed from blocks, joints "
                        "and damping; with local damping, joints that can "
                        "fail or large displacements no more than 0.5 is "
                        "used [-]");
      prm.declare_entry("Time step", "0", Double(),
                        "0: as the share says; else this one, which must be "
                        "below the critical one [s]");
      prm.leave_subsection();

      prm.enter_subsection("Histories");
      prm.declare_entry("Interval", "0", Double(),
                        "Between rows of histories.csv and energies.csv; 0: "
                        "every step [s]");
      prm.leave_subsection();

      prm.enter_subsection("Output");
      prm.declare_entry("Field interval", "0", Double(),
                        "Between VTU files; 0: at the end of stages only "
                        "[s]");
      prm.declare_entry("Checkpoint interval", "60", Double(),
                        "Between checkpoints, in wall-clock time; 0: at the "
                        "end of stages only [s]");
      prm.declare_entry("Measure bandwidth", "no",
                        Selection("yes|no|true|false"),
                        "Measure the memory bandwidth after the run and "
                        "write which share of it the run used.");
      prm.leave_subsection();
    }

    void read_output(const ParameterSection &top, Parameters &parameters)
    {
      {
        const ParameterSection section(top, "Time stepping");
        parameters.share_of_critical_step
            = section.within("Share of critical time step", 1e-6, 1.);
        parameters.time_step = section.nonnegative("Time step");
      }
      {
        const ParameterSection section(top, "Histories");
        parameters.history_interval = section.nonnegative("Interval");
      }
      const ParameterSection section(top, "Output");
      parameters.field_interval = section.nonnegative("Field interval");
      parameters.checkpoint_interval
          = section.nonnegative("Checkpoint interval");
      parameters.measure_bandwidth = section.flag("Measure bandwidth");
    }

    /** Whether the section that @p prm is in has a parameter @p name. */
    bool has_entry(ParameterHandler &prm, const std::string &name)
    {
      try
      {
        // get() gives an empty text for what is not there.
        prm.set(name, prm.get(name));
        return true;
      }
      catch (const dealii::ExceptionBase &)
      {
        return false;
      }
    }

    /** The tables and records that values of @p text name and that exist. */
    std::vector<std::string> time_files(const std::string &text,
                                        const std::string &folder)
    {
      std::vector<std::string> result;
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);)
        for (const std::string word : { " table ", " record " })
        {
          const std::size_t place = line.find(word);
          if (place == std::string::npos)
            continue;
          std::string name
              = dealii::Utilities::trim(line.substr(place + word.size()));
          // What follows: of a table a factor, of a record options.
          name = name.substr(0, name.find(word == " table " ? " times " : " "));
          if (!name.empty() && name.front() != '/')
            name = folder + name;
          std::error_code error;
          if (std::filesystem::is_regular_file(name, error))
            result.push_back(name);
        }
      return result;
    }
  } // namespace

  Parameters read_parameters(const std::string &file,
                             const std::vector<std::string> &overrides)
  {
    const ParameterFile input(file, overrides);
    ParameterHandler names;
    declare_names(names);
    input.parse(names, true);

    ParameterHandler prm;
    declare_fixed(prm);
    declare_names(prm);
    for (const NamedSection &section : named_sections())
    {
      names.enter_subsection(section.name);
      const auto listed
          = dealii::Utilities::split_string_list(names.get("Names"), ',');
      names.leave_subsection();
      prm.enter_subsection(section.name);
      std::set<std::string> seen;
      for (const std::string &name : listed)
      {
        if (name.empty())
          continue;
        if (!seen.insert(name).second)
          throw InputError(file + ", section '" + section.name
                           + "': 'Names' lists '" + name
                           + "' twice. Names must differ.");
        if (has_entry(prm, name))
          throw InputError(file + ", section '" + section.name
                           + "': 'Names' lists '" + name
                           + "', which is a parameter of this section. Take "
                             "another name.");
        prm.enter_subsection(name);
        section.declare_one(prm);
        prm.leave_subsection();
      }
      prm.leave_subsection();
    }
    input.parse(prm, false);

    Parameters parameters;
    parameters.file = file;
    const ParameterSection top(prm, file);
    parameters.title            = top.text("Title");
    const std::string output    = top.text("Output directory");
    parameters.output_directory = !output.empty() && output.front() == '/'
                                      ? output
                                      : top.folder() + output;
    parameters.model.thickness  = top.positive("Thickness");
    parameters.model.plane      = top.choice<PlaneAssumption>(
        "Plane assumption",
        { { "plane strain", PlaneAssumption::plane_strain },
               { "plane stress", PlaneAssumption::plane_stress } });
    parameters.is_boundary_model = top.text("Model") == "boundary elements";
    parameters.is_implicit       = top.text("Solver") == "implicit";
    if (parameters.is_implicit && parameters.is_boundary_model)
      top.fail("Solver", "is for blocks: with 'Model = boundary elements' "
                         "leave it 'explicit'; statics of these is 'Analysis = "
                         "static'.");
    if (!parameters.is_boundary_model)
      read_mesh(top, parameters);
    parameters.model.materials
        = read_named<MaterialParameters>(top, "Materials");
    if (parameters.model.materials.empty())
      throw InputError(file
                       + ", section 'Materials': 'Names' must list at "
                         "least one material.");
    parameters.histories = read_named<HistoryParameters>(top, "Histories");
    read_output(top, parameters);
    if (parameters.is_boundary_model)
      read_boundary_model(top, parameters);
    else
      read_block_model(top, parameters);
    check_triangles(top, parameters);

    std::ostringstream effective;
    prm.print_parameters(effective, ParameterHandler::ShortPRM);
    parameters.effective  = effective.str();
    parameters.time_files = time_files(parameters.effective, top.folder());
    return parameters;
  }

  std::string describe_parameters()
  {
    ParameterHandler prm;
    declare_fixed(prm);
    declare_names(prm);
    for (const NamedSection &section : named_sections())
    {
      prm.enter_subsection(section.name);
      prm.enter_subsection("NAME");
      section.declare_one(prm);
      prm.leave_subsection();
      prm.leave_subsection();
    }
    std::ostringstream text;
    prm.print_parameters(text, ParameterHandler::PRM
                                   | ParameterHandler::KeepDeclarationOrder);
    return text.str();
  }
} // namespace quoin
