// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/application/mesh_parameters.h>
#include <quoin/application/parameters.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/named_sections.h>
#include <quoin/dynamics/construction.h>
#include <quoin/dynamics/solver.h>
#include <quoin/layout/rock_parameters.h>
#include <quoin/tdbem/elastic_medium.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <regex>
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

    /** "section 'A/B'" of line @p number of @p text. */
    std::string section_of_line(const std::string &text,
                                const unsigned int number)
    {
      std::istringstream stream(text);
      std::vector<std::string> path;
      std::string line;
      for (unsigned int n = 1; n <= number && std::getline(stream, line); ++n)
      {
        std::istringstream words(line);
        std::string first, name;
        words >> first;
        std::getline(words >> std::ws, name);
        name = dealii::Utilities::trim(name.substr(0, name.find('#')));
        if (first == "subsection")
          path.push_back(name);
        else if (first == "end" && !path.empty())
          path.pop_back();
      }
      std::string joined;
      for (const auto &name : path)
        joined += (joined.empty() ? "" : "/") + name;
      return "section '" + (joined.empty() ? "/" : joined) + "'";
    }

    /** In one line, and no longer than anyone reads. */
    std::string one_line(const std::string &text)
    {
      constexpr std::size_t longest = 1000;
      std::string line;
      for (const char c : text)
      {
        const bool is_space = std::isspace(static_cast<unsigned char>(c)) != 0;
        if (line.size() == longest)
          return line + " ... ";
        if (!is_space || (!line.empty() && line.back() != ' '))
          line += is_space ? ' ' : c;
      }
      return line;
    }

    /** The reason of a library's error in one line, and where it is. */
    std::string describe(const dealii::ExceptionBase &error,
                         const std::string &source, const std::string &text)
    {
      std::ostringstream reason;
      error.print_info(reason);
      std::string message = one_line(reason.str());
      std::smatch match;
      std::string where = source;
      if (std::regex_search(message, match,
                            std::regex("[Ll]ine <?(\\d{1,9})>?")))
      {
        const unsigned int line = std::stoul(match[1]);
        where += (source.rfind("--set", 0) == 0
                      ? std::string()
                      : ", line " + std::to_string(line))
                 + ", " + section_of_line(text, line);
        message = std::regex_replace(
            message,
            std::regex("^ *[Ll]ine <?\\d{1,9}>? of (input )?file <[^>]*>: *"),
            "");
      }
      return where + ": " + message
             + " Correct it; --print-parameters shows what exists.";
    }

    std::string read_text(const std::string &file)
    {
      std::ifstream stream(file);
      std::error_code error;
      if (!stream || std::filesystem::is_directory(file, error))
        throw InputError("the parameter file '" + file
                         + "' cannot be read. Check the path.");
      std::ostringstream stored;
      stored << stream.rdbuf();
      std::string text = stored.str();
      // Some editors put a mark in front that is no text.
      if (text.rfind("\xEF\xBB\xBF", 0) == 0)
        text.erase(0, 3);
      return text;
    }

    /** Refuses values with braces: to deal.II lists of values to run with,
        which it does not compare with what a parameter may be. */
    void refuse_braces(const std::string &file, const std::string &text)
    {
      std::istringstream lines(text);
      unsigned int number = 0;
      for (std::string line; std::getline(lines, line);)
      {
        ++number;
        line = dealii::Utilities::trim(line.substr(0, line.find('#')));
        if (line.find('{') != std::string::npos)
          throw InputError(file + ", line " + std::to_string(number) + ": '"
                           + line
                           + "' has a brace, which no value has. Remove "
                             "it; runs with several values need as many "
                             "commands with --set.");
      }
    }

    /** Refuses a file that includes itself, which would never end. */
    void check_includes(const std::string &file, const std::string &text,
                        std::set<std::filesystem::path> &open)
    {
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);)
      {
        std::istringstream words(line);
        std::string first, name;
        words >> first;
        if (first != "include")
          continue;
        std::getline(words >> std::ws, name);
        name = dealii::Utilities::trim(name.substr(0, name.find('#')));
        std::error_code error;
        if (!std::filesystem::is_regular_file(name, error))
          continue;
        const auto path = std::filesystem::canonical(name, error);
        if (!open.insert(path).second)
          throw InputError(file + ": it includes '" + name
                           + "', which is being read already: this would never "
                             "end. Remove one of the lines 'include'.");
        const std::string included = read_text(name);
        refuse_braces(name, included);
        check_includes(name, included, open);
        open.erase(path);
      }
    }

    /** @p source: the file, or the option, that @p text is from. */
    void parse(ParameterHandler &prm, const std::string &file,
               const std::string &source, const std::string &text,
               const bool skip_undefined)
    {
      // 'include' resolves against the folder of the file.
      namespace fs = std::filesystem;
      struct Return
      {
        fs::path to;
        ~Return()
        {
          std::error_code error;
          if (!to.empty())
            fs::current_path(to, error);
        }
      } back;
      try
      {
        const auto folder = fs::path(file).parent_path();
        std::error_code error;
        std::set<fs::path> open{ fs::canonical(file, error) };
        if (!folder.empty())
        {
          back.to = fs::current_path();
          fs::current_path(folder);
        }
        refuse_braces(source, text);
        check_includes(source, text, open);
        std::istringstream stream(text);
        prm.parse_input(stream, source, "", skip_undefined);
      }
      catch (const dealii::ExceptionBase &error)
      {
        throw InputError(describe(error, source, text));
      }
      catch (const fs::filesystem_error &error)
      {
        throw InputError(file + ": its folder cannot be entered: "
                         + error.code().message() + ". Check the path.");
      }
    }

    /** What "Section/Name=value" would be in a parameter file. */
    std::string override_text(const std::string &option)
    {
      const auto equals = option.find('=');
      auto path
          = dealii::Utilities::split_string_list(option.substr(0, equals), '/');
      if (equals == std::string::npos || path.empty() || path.back().empty())
        throw InputError("--set '" + option
                         + "': give it as \"Section/Name=value\".");
      const std::string name = path.back();
      path.pop_back();
      std::string text;
      for (const auto &section : path)
        text += "subsection " + section + "\n";
      text += "set " + name + " = " + option.substr(equals + 1) + "\n";
      for (unsigned int i = 0; i < path.size(); ++i)
        text += "end\n";
      return text;
    }

    /** The text of the file first, then what the command line overrides. */
    void parse_all(ParameterHandler &prm, const std::string &file,
                   const std::string &text,
                   const std::vector<std::string> &overrides,
                   const bool skip_undefined)
    {
      parse(prm, file, file, text, skip_undefined);
      for (const std::string &option : overrides)
        parse(prm, file, "--set \"" + option + "\"", override_text(option),
              skip_undefined);
    }

    /** Whether something takes the motion away that an explicit stage has. */
    bool comes_to_rest(const StageParameters &stage,
                       const std::vector<LoadParameters> &loads)
    {
      if (stage.damping == DampingType::rayleigh)
        return stage.mass_coefficient + stage.stiffness_coefficient > 0.;
      return stage.damping != DampingType::none
             || std::any_of(loads.begin(), loads.end(),
                            [&](const LoadParameters &load)
                            {
                              return (load.type == LoadType::viscous_boundary
                                      || load.type == LoadType::free_field)
                                     && names_load(stage, load.name);
                            });
    }

    /** What one stage says that cannot have an effect. */
    void check_stage(const ParameterSection &section,
                     const StageParameters &stage, const Parameters &parameters,
                     const bool has_excavated)
    {
      if (stage.end == StageEnd::static_ratio && !parameters.is_implicit
          && !comes_to_rest(stage, parameters.loads))
        section.fail("Damping", "leaves all motion in the model, which so "
                                "never comes to the rest that 'End = "
                                    + section.text("End")
                                    + "' waits for. Take 'local' or "
                                      "'adaptive'.");
      if (has_excavated)
        return;
      const std::string why
          = "has no effect: neither this stage nor one before it has an "
            "'Excavate'. Name what is excavated, or remove this.";
      if (stage.release != 1.)
        section.fail("Release", why);
      if (stage.release_duration >= 0.)
        section.fail("Release duration", why);
      if (stage.releases_linearly)
        section.fail("Release ramp", why);
    }

    void read_stages(const ParameterSection &top, Parameters &parameters)
    {
      parameters.stages = read_named<StageParameters>(top, "Stages");
      const ParameterSection section(top, "Stages");
      if (parameters.stages.empty())
        section.fail("Names", "must list at least one stage.");
      if (parameters.stages.front().safety)
        ParameterSection(section, parameters.stages.front().name)
            .fail("End", "needs a stage before it that brings the model to "
                         "rest: a factor of safety begins with its state.");
      double end = 0.; // of the stage before; NaN: known only as it runs
      bool has_excavated = false;
      for (const StageParameters &stage : parameters.stages)
      {
        const ParameterSection subsection(section, stage.name);
        has_excavated = has_excavated || !stage.excavate.empty();
        check_stage(subsection, stage, parameters, has_excavated);
        if (stage.start_time >= 0.)
        {
          std::ostringstream why;
          if (std::isnan(end))
            subsection.fail("Start time",
                            "cannot be kept, because the stage before "
                            "ends when it has settled. Use 'previous "
                            "end'.");
          why << "but the stage before ends at " << end << " s: stages "
              << (stage.start_time < end ? "overlap" : "leave a gap")
              << ". Use 'previous end' or change the durations.";
          if (std::abs(stage.start_time - end) > 1e-9 * (1. + end))
            subsection.fail("Start time", why.str());
        }
        end = stage.end == StageEnd::time
                  ? end + stage.duration
                  : std::numeric_limits<double>::quiet_NaN();
      }
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

    /** Sections of one kind of model in a file of the other. */
    void refuse_names(const ParameterSection &top, const std::string &name,
                      const std::string &model)
    {
      const ParameterSection section(top, name);
      if (!section.list("Names").empty())
        section.fail("Names", "has no meaning with 'Model = " + model
                                  + "': remove it, or change 'Model'.");
    }

    /** That of the boundary elements' domain; null if there is none. */
    const MaterialParameters *find_material(const Parameters &parameters)
    {
      for (const MaterialParameters &material : parameters.model.materials)
        if (material.name == parameters.boundary.material)
          return &material;
      return nullptr;
    }

    /** What is left to the program: sizes of elements and steps. */
    void choose_resolution(const ElasticMedium &medium,
                           BoundaryElementParameters &boundary)
    {
      if (boundary.highest_frequency > 0.)
        boundary.element_length = medium.c2 / boundary.highest_frequency / 10.;
      // Where the discrete operators are passive, or nearly so, and accurate.
      if (boundary.step_ratio == 0.)
        boundary.step_ratio
            = boundary.formulation == Formulation::convolution_quadrature
                  ? 0.5
                  : std::clamp(medium.c1 / (std::sqrt(3.) * medium.c2), 1.,
                               1.5);
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

    /** Sections 'Boundary elements', 'Incident waves', 'Sampled field'. */
    void read_boundary_elements(const ParameterSection &top,
                                Parameters &parameters, const bool coupled)
    {
      BoundaryElementParameters &boundary = parameters.boundary;
      boundary                            = BoundaryElementParameters::read(
                                     ParameterSection(top, "Boundary elements"), coupled);
      boundary.boundaries
          = read_named<BoundaryCurveParameters>(top, "Boundary elements");
      boundary.waves
          = read_named<IncidentWaveParameters>(top, "Incident waves");
      boundary.sampled_field = SampledFieldParameters::read(
          ParameterSection(top, "Sampled field"));
      if (std::any_of(boundary.boundaries.begin(), boundary.boundaries.end(),
                      [](const BoundaryCurveParameters &curve)
                      { return curve.shape == BoundaryShape::mesh; })
          && !coupled)
        read_mesh(top, parameters);

      const auto &materials = parameters.model.materials;
      if (boundary.material.empty() && materials.size() == 1)
        boundary.material = materials.front().name;
      {
        const ParameterSection section(top, "Boundary elements");
        if (boundary.boundaries.empty())
          section.fail("Names", "must list at least one boundary.");
        const MaterialParameters *material = find_material(parameters);
        if (material == nullptr)
          section.fail("Material", "is no material: name one of the 'Names' of "
                                   "section 'Materials'.");
        if (material->rigid)
          section.fail("Material", "leads to '" + material->name
                                       + "', which is rigid: boundary elements "
                                         "need 'Law = linear elastic'.");
        if (material->strength && !coupled)
          section.fail("Material", "leads to '" + material->name
                                       + "', whose law is Mohr-Coulomb: "
                                         "boundary elements alone are elastic, "
                                         "they need 'Law = linear elastic'.");
        choose_resolution(ElasticMedium::from_young(material->elastic.density,
                                                    material->elastic.young,
                                                    material->elastic.poisson),
                          boundary);
        for (const BoundaryCurveParameters &curve : boundary.boundaries)
          if (curve.shape != BoundaryShape::mesh
              && curve.shape
                     != BoundaryShape::interface && curve.n_elements == 0
              && curve.element_length == 0. && boundary.element_length == 0.)
            ParameterSection(section, curve.name)
                .fail("Elements", "leaves the size of the elements open: give "
                                  "their number, an 'Element length' or a "
                                  "'Highest frequency'.");
      }
    }

    void read_boundary_model(const ParameterSection &top,
                             Parameters &parameters)
    {
      for (const std::string name : { "Joints", "Loads", "Stages" })
        refuse_names(top, name, "boundary elements");
      for (const std::string name : { "Displacement", "Velocity" })
        if (const ParameterSection section(top, "Initial motion");
            !section.text(name).empty())
          section.fail(name, "has no meaning with 'Model = boundary "
                             "elements': it is that of blocks. Remove it.");
      if (parameters.model.plane != PlaneAssumption::plane_strain)
        top.fail("Plane assumption", "does not go with boundary elements: "
                                     "their kernels are those of plane "
                                     "strain.");
      read_boundary_elements(top, parameters, false);
      const BoundaryElementParameters &boundary = parameters.boundary;
      if (std::any_of(boundary.boundaries.begin(), boundary.boundaries.end(),
                      [](const BoundaryCurveParameters &curve)
                      { return curve.shape == BoundaryShape::interface; }))
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

    void check_loads(const Parameters &parameters)
    {
      std::set<std::string> names, used;
      for (const LoadParameters &load : parameters.loads)
        names.insert(load.name);
      for (const StageParameters &stage : parameters.stages)
        for (const std::string &load : stage.loads)
        {
          if (names.count(load) == 0)
            throw InputError(parameters.file + ", section 'Stages/" + stage.name
                             + "': 'Loads' names '" + load
                             + "', which is no load. Loads are: "
                             + known_names(names) + ".");
          used.insert(load);
          if (std::count(stage.loads.begin(), stage.loads.end(), load) > 1)
            throw InputError(parameters.file + ", section 'Stages/" + stage.name
                             + "': 'Loads' names '" + load
                             + "' twice, but it acts once. Remove one, or "
                               "give the load another value.");
        }
      for (const LoadParameters &load : parameters.loads)
        for (const StageParameters &stage : parameters.stages)
          if (load.type == LoadType::initial_stress
              && names_load(stage, load.name))
            throw InputError(parameters.file + ", section 'Stages/" + stage.name
                             + "': 'Loads' names '" + load.name
                             + "', an initial stress, which acts from the "
                               "start and does not end. Leave it out there.");
      for (const LoadParameters &load : parameters.loads)
        if (load.type != LoadType::initial_stress && used.count(load.name) == 0)
          throw InputError(parameters.file + ", section 'Loads/" + load.name
                           + "': no stage uses this load. Name it in the "
                             "'Loads' of a stage or remove it.");
    }

    /** Boundary elements beyond the blocks. */
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
      if (parameters.model.plane != PlaneAssumption::plane_strain)
        top.fail("Plane assumption", "does not go with boundary elements: "
                                     "their kernels are those of plane "
                                     "strain.");
      read_boundary_elements(top, parameters, true);
      const auto &boundaries = parameters.boundary.boundaries;
      if (std::none_of(boundaries.begin(), boundaries.end(),
                       [](const BoundaryCurveParameters &curve)
                       { return curve.shape == BoundaryShape::interface; }))
        ParameterSection(top, "Boundary elements")
            .fail("Names", "has no boundary with 'Shape = interface': nothing "
                           "is coupled to the blocks.");
      if (parameters.boundary.sampled_field.has_box)
        ParameterSection(top, "Sampled field")
            .fail("Box", "needs 'Model = boundary elements': leave it empty.");
    }

    /** Histories of boundary elements: where they march beside blocks. */
    void check_coupled_histories(const ParameterSection &top,
                                 const Parameters &parameters)
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
        if (parameters.is_implicit
            || std::none_of(parameters.loads.begin(), parameters.loads.end(),
                            acts))
          subsection.fail("Quantity",
                          "is one of boundary elements in motion, but here "
                          "they are at rest: 'Solver' is implicit, or no "
                          "stage with 'End = time' names their load. Take "
                          "'displacement x', 'displacement y' or 'reaction' "
                          "of that load.");
      }
    }

    void read_block_model(const ParameterSection &top, Parameters &parameters)
    {
      parameters.model.joints = read_named<JointSetParameters>(top, "Joints");
      parameters.model.contact
          = ContactParameters::read(ParameterSection(top, "Contact"));
      parameters.model.large_displacements
          = parameters.model.contact.large_displacements;
      for (const JointSetParameters &set : parameters.model.joints)
        if (std::holds_alternative<CompositeLaw>(set.law)
            && parameters.model.large_displacements)
          ParameterSection(ParameterSection(top, "Joints"), set.name)
              .fail("Law", "is for small displacements: contacts that go on "
                           "elsewhere have no bond that could soften. Take "
                           "'Coulomb', or 'Displacements = small' in section "
                           "'Contact'.");
      parameters.loads = read_named<LoadParameters>(top, "Loads");
      for (const LoadParameters &load : parameters.loads)
        if (load.type == LoadType::initial_stress)
          parameters.model.initial_stresses.push_back(load);
      read_far_field(top, parameters);
      parameters.initial_motion
          = InitialMotion::read(ParameterSection(top, "Initial motion"));
      read_stages(top, parameters);
      parameters.model.absent_groups = groups_placed_later(parameters.stages);
      check_loads(parameters);
      check_coupled_histories(top, parameters);
      parameters.implicit
          = ImplicitParameters::read(ParameterSection(top, "Implicit"));
      if (parameters.is_implicit && !parameters.boundary.waves.empty())
        ParameterSection(top, "Incident waves")
            .fail("Names", "needs motion, which 'Solver = implicit' leaves "
                           "out: remove the waves, or take 'explicit'.");
      if (parameters.is_implicit && parameters.initial_motion.is_given)
        top.fail("Solver", "leaves out inertia, but section 'Initial motion' "
                           "gives one: remove that, or take 'explicit'.");
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
    const std::string text = read_text(file);
    ParameterHandler names;
    declare_names(names);
    parse_all(names, file, text, overrides, true);

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
    parse_all(prm, file, text, overrides, false);

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
