// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/named_sections.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/base/parameter_file.h>
#include <quoin/layout/arch_parameters.h>
#include <quoin/rock/rock_box.h>
#include <quoin/rock/rock_parameters.h>
#include <quoin/layout/wall_parameters.h>
#include <quoin/parameters/model_parameters.h>
#include <quoin/parameters/plausibility.h>
#include <quoin/parameters/schema.h>

#include <filesystem>
#include <sstream>

namespace quoin
{
  namespace
  {
    using dealii::ParameterHandler;

    /** Sections with named subsections, and functions that declare these. */
    const std::vector<SectionEntries> named_sections
        = { { "Wall storeys", WallStorey::declare },
            { "Wall segments", WallSegment::declare },
            { "Rock regions", RockRegion::declare },
            { "Rock bodies", RockBody::declare },
            { "Rock joints", RockJoints::declare },
            { "Rock joint sets", SpaceJointSet::declare },
            { "Materials", MaterialParameters::declare },
            { "Joints", JointSetParameters::declare },
            { "Reinforcement", CableParameters::declare },
            { "Loads", LoadParameters::declare },
            { "Water joints", HydraulicAperture::declare },
            { "Water boundaries", WaterBoundary::declare },
            { "Stages", StageParameters::declare },
            { "Boundary elements", BoundaryCurveParameters::declare },
            { "Incident waves", IncidentWaveParameters::declare },
            { "Blocks", NamedBlock::declare },
            { "Beams", BeamParameters::declare },
            { "Histories", HistoryParameters::declare } };

    void enter_top(ParameterEntries &entries, Parameters &parameters)
    {
      entries.text("Title", parameters.title,
                   "Title of the run, for figures and logs.");
      entries.choice("Model", parameters.is_boundary_model,
                     { { "blocks", false }, { "boundary elements", true } },
                     "Problem type. blocks: an assembly of blocks and joints; "
                     "boundary elements: a domain of boundary elements alone, "
                     "which needs no mesh, joints, loads or stages.");
      entries.choice("Solver", parameters.is_implicit,
                     { { "explicit", false }, { "implicit", true } },
                     "Solver of block models. explicit: time marching by "
                     "central differences; implicit: static equilibrium at "
                     "small displacements by Newton's method, without inertia "
                     "and damping, as section 'Implicit' says.");
      entries.choice("Plane assumption", parameters.model.plane,
                     { { "plane strain", PlaneAssumption::plane_strain },
                       { "plane stress", PlaneAssumption::plane_stress } },
                     "Plane strain or plane stress in all blocks.");
      entries.positive("Thickness", parameters.model.thickness,
                       "Out-of-plane thickness of the model [m]");
      parameters.output_directory = "output";
      entries.text("Output directory", parameters.output_directory,
                   "Folder of all results, relative to the folder of this "
                   "file.");
    }

    void enter_time_stepping(ParameterEntries &entries, Parameters &parameters)
    {
      entries.within("Share of critical time step",
                     parameters.share_of_critical_step, 1e-6, 1.,
                     "Safety factor on the time step: the time step divided by "
                     "the critical one, which is computed from blocks, joints "
                     "and damping; at most 0.5 is used with local damping, "
                     "joints that can fail or large displacements [-]");
      entries.choice(
          "Critical time step", parameters.takes_assembled_step,
          { { "assembled", true }, { "bound", false } },
          "From what the critical time step follows. assembled: the highest "
          "frequency of all blocks and joints together, by the Lanczos "
          "iteration at the start of each stage; bound: a bound of that "
          "frequency by each node and what is joined to it, with which steps "
          "are 0.7 to 1.0 times as long. Models with bars, beams, dashpots in "
          "joints, materials that yield or 'Coupling = staggered', and stages "
          "with scaled masses keep the bound.");
      entries.nonnegative(
          "Time step", parameters.time_step,
          "Time step, which must be below the critical one; 0: the critical "
          "time step multiplied by the safety factor [s]");
    }

    void enter_histories(ParameterEntries &entries, Parameters &parameters)
    {
      entries.nonnegative("Interval", parameters.history_interval,
                          "Time between rows of histories.csv and "
                          "energies.csv; 0: every step [s]");
    }

    void enter_output(ParameterEntries &entries, Parameters &parameters)
    {
      entries.nonnegative("Field interval", parameters.field_interval,
                          "Time between field outputs; 0: fields are written "
                          "at the end of stages only [s]");
      entries.choice(
          "Field format", parameters.field_format,
          { { "vtu", FieldFormat::vtu }, { "xdmf", FieldFormat::xdmf } },
          "Format of field files. vtu: VTU files in fields/ with a list such "
          "as blocks.pvd; xdmf: blocks.xdmf and blocks.bin for all output "
          "times together.");
      entries.nonnegative("Checkpoint interval", parameters.checkpoint_interval,
                          "Wall-clock time between checkpoints; 0: checkpoints "
                          "are written at the end of stages only [s]");
      entries.flag("Measure bandwidth", parameters.measure_bandwidth,
                   "Whether the memory bandwidth is measured after the run, "
                   "and the fraction of it that the run used is written.");
    }

    /** Declares the entries of @p enter, a function of this file. */
    template <void (*enter)(ParameterEntries &, Parameters &)>
    void declare_with(ParameterHandler &prm)
    {
      declare_entries(prm, enter);
    }

    /** Sections without names. */
    const std::vector<SectionEntries> other_sections
        = { { "Mesh", declare_mesh },
            { "Wall", WallParameters::declare },
            { "Arch", ArchParameters::declare },
            { "Rock", RockParameters::declare },
            { "Rock box", RockBoxParameters::declare },
            { "Contact", ContactParameters::declare },
            { "Water", WaterParameters::declare },
            { "Boundary elements", BoundaryElementParameters::declare },
            { "Sampled field", SampledFieldParameters::declare },
            { "Initial motion", InitialMotion::declare },
            { "Implicit", ImplicitParameters::declare },
            { "Time stepping", declare_with<enter_time_stepping> },
            { "Histories", declare_with<enter_histories> },
            { "Output", declare_with<enter_output> } };

    void declare_fixed(ParameterHandler &prm)
    {
      declare_entries(prm, enter_top);
      declare_sections(other_sections, prm);
      declare_names(named_sections, prm);
    }

    void read_section(const ParameterSection &top, const std::string &name,
                      void (*enter)(ParameterEntries &, Parameters &),
                      Parameters &parameters)
    {
      const ParameterSection section(top, name);
      ParameterEntries entries(section);
      enter(entries, parameters);
    }

    /** The tables and records that values of @p text name and that exist. */
    std::vector<std::string> time_files(const std::string &text,
                                        const ParameterSection &top)
    {
      std::vector<std::string> result;
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);)
        for (const std::string word : { "table ", "record " })
          for (std::size_t place = line.find(word); place != std::string::npos;
               place             = line.find(word, place + 1))
          {
            if (place == 0
                || (line[place - 1] != ' ' && line[place - 1] != ';'))
              continue;
            std::string name
                = dealii::Utilities::trim(line.substr(place + word.size()));
            // A factor may follow a table, options a record, and other
            // functions either of them.
            name
                = name.substr(0, name.find(word == "table " ? " times " : " "));
            for (const std::string &candidate :
                 { name,
                   dealii::Utilities::trim(name.substr(0, name.find(';'))) })
            {
              std::error_code error;
              const std::string path = in_folder(top, candidate);
              if (!std::filesystem::is_regular_file(path, error))
                continue;
              result.push_back(path);
              break;
            }
          }
      return result;
    }

    /** Reads @p parameters by @p prm, whose entries are known. */
    void read_values(const ParameterFile &input, NotedParameters &prm,
                     Parameters &parameters)
    {
      const ParameterSection top(prm, parameters.file);
      ParameterEntries entries(top);
      enter_top(entries, parameters);
      parameters.output_directory = in_folder(top, parameters.output_directory);
      if (parameters.is_implicit && parameters.is_boundary_model)
        top.fail("Solver",
                 "is for blocks: with 'Model = boundary elements' "
                 "leave it 'explicit'; statics of these is 'Analysis = "
                 "static'.");
      if (!parameters.is_boundary_model)
      {
        read_mesh(top, parameters);
        check_sections_in_space(top, parameters);
      }
      parameters.model.materials
          = read_named<MaterialParameters>(top, "Materials");
      if (parameters.model.materials.empty())
        throw InputError(parameters.file
                         + ", section 'Materials': 'Names' must list at "
                           "least one material.");
      parameters.histories = read_named<HistoryParameters>(top, "Histories");
      read_section(top, "Time stepping", enter_time_stepping, parameters);
      read_section(top, "Histories", enter_histories, parameters);
      read_section(top, "Output", enter_output, parameters);
      if (parameters.is_boundary_model)
        read_boundary_model(top, parameters);
      else
        read_block_model(top, parameters);

      // Before plausibility, which looks at more than a run uses.
      for (const auto &doubts :
           { input.idle_overrides(prm), idle_properties(prm, top),
             implausible_values(top, parameters), idle_damping(top, parameters),
             idle_motion(parameters) })
        parameters.warnings.insert(parameters.warnings.end(), doubts.begin(),
                                   doubts.end());
    }
  } // namespace

  Parameters read_parameters(const std::string &file,
                             const std::vector<std::string> &overrides)
  {
    const ParameterFile input(file, overrides);
    NotedParameters names;
    declare_names(named_sections, names);
    names.enter_subsection("Mesh");
    for (const char *const entry : { "File", "Dimension" })
      names.declare_entry(entry, "", dealii::Patterns::Anything());
    names.leave_subsection();
    input.parse(names, true);

    NotedParameters prm;
    declare_fixed(prm);
    declare_listed(named_sections, file, names, prm);
    Parameters parameters;
    parameters.file = file;
    for (const SectionEntries &section : named_sections)
      for (const std::string &warning : declare_unlisted(
               section, file, input.subsections(section.name), names, prm))
        parameters.warnings.push_back(warning);
    const unsigned int dimension
        = dimension_of_mesh(ParameterSection(names, file));
    prm.suggests
        = [dimension](const std::string &entry, const std::string &word)
    {
      return entry != "Quantity" || dimension == 0
             || HistoryParameters::exists_in(word, dimension);
    };
    input.parse(prm, false);
    parameters.places = prm.places;
    parameters.warnings.insert(parameters.warnings.end(), prm.repeated.begin(),
                               prm.repeated.end());
    try
    {
      read_values(input, prm, parameters);
    }
    catch (const InputError &error)
    {
      throw InputError(with_place(error.what(), file, prm.places));
    }

    std::ostringstream effective;
    prm.print_parameters(effective, ParameterHandler::ShortPRM);
    parameters.effective = effective.str();
    parameters.time_files
        = time_files(parameters.effective, ParameterSection(prm, file));
    for (const std::string &warning : long_time_files(parameters))
      parameters.warnings.push_back(warning);
    return parameters;
  }

  namespace
  {
    /** Declares all entries, with an example of each named subsection. */
    void declare_all(ParameterHandler &prm)
    {
      declare_fixed(prm);
      declare_examples(named_sections, prm);
    }
  } // namespace

  std::string parameter_schema()
  {
    ParameterHandler prm;
    declare_all(prm);
    return schema_text(prm);
  }

  std::string describe_parameters()
  {
    ParameterHandler prm;
    declare_all(prm);
    std::ostringstream text;
    prm.print_parameters(text, ParameterHandler::PRM
                                   | ParameterHandler::KeepDeclarationOrder);
    return text.str();
  }
} // namespace quoin
