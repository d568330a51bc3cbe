// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/parameters/model_parameters.h>

#include <filesystem>
#include <fstream>
#include <regex>

namespace quoin
{
  namespace
  {
    /** Refuses parameters that a run in three dimensions does not support. */
    class Refusals
    {
    public:
      explicit Refusals(const std::string &file) : file(file)
      {
      }

      /** Throws an InputError if @p given: @p what is section and entry. */
      void refuse_if(const bool given, const std::string &what,
                     const std::string &cure) const
      {
        if (given)
          throw InputError(file + ", " + what
                           + " is for models in two dimensions, and the mesh "
                             "has three. "
                           + cure);
      }

    private:
      const std::string &file;
    };

    void check_materials(const Parameters &parameters, const Refusals &refusals)
    {
      for (const MaterialParameters &material : parameters.model.materials)
      {
        const std::string section
            = "section 'Materials/" + material.name + "': ";
        refusals.refuse_if(material.rigid, section + "'Law = rigid'",
                           "Take 'linear elastic' or 'Mohr-Coulomb'.");
        refusals.refuse_if(material.thickness > 0., section + "'Thickness'",
                           "Leave it empty.");
      }
    }

    void check_joints(const Parameters &parameters, const Refusals &refusals)
    {
      for (const JointSetParameters &set : parameters.model.joints)
      {
        const std::string section = "section 'Joints/" + set.name + "': ";
        refusals.refuse_if(set.all_new_contacts || !set.new_contacts.empty(),
                           section + "'New contacts between'",
                           "Leave it empty.");
      }
    }

    void check_loads(const Parameters &parameters, const Refusals &refusals)
    {
      for (const LoadParameters &load : parameters.loads)
      {
        const std::string section = "section 'Loads/" + load.name + "': ";
        refusals.refuse_if(load.type == LoadType::boundary_elements,
                           section + "'Type = " + load.type_text() + "'",
                           "Take 'prescribed motion', 'platen', 'traction', "
                           "'gravity', 'initial stress', 'in-situ stress', "
                           "'viscous boundary' or 'free-field boundary'.");
      }
    }
  } // namespace

  namespace
  {
    /** Whether a geometry or mesh names volumes. */
    bool names_volumes(const std::string &mesh_file)
    {
      static const std::regex volume(
          R"(\s*(Physical Volume\b.*|3 \d+ "[^"]*"\s*))");
      std::ifstream file(mesh_file);
      for (std::string line; std::getline(file, line) && line != "$Nodes";)
        if (std::regex_match(line, volume))
          return true;
      return false;
    }

    /** Whether the mesh will be one of tetrahedra, as far as its file or
        'Dimension' says so. */
    bool is_in_space(const Parameters &parameters)
    {
      if (parameters.dimension != MeshDimension::from_mesh
          || !parameters.generated.geometry.empty())
        return parameters.dimension == MeshDimension::three;
      return names_volumes(parameters.mesh_file);
    }
  } // namespace

  unsigned int dimension_of_mesh(const ParameterSection &top)
  {
    const ParameterSection mesh(top, "Mesh");
    if (const std::string word = mesh.text("Dimension");
        word == "2" || word == "3")
      return word == "2" ? 2 : 3;
    const std::string file = in_folder(top, mesh.text("File"));
    const auto extension   = std::filesystem::path(file).extension();
    if (extension == ".obj" || extension == ".stl" || extension == ".3dgrid")
      return 3;
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
      return 0;
    return names_volumes(file) ? 3 : 2;
  }

  void check_sections_in_space(const ParameterSection &top,
                               const Parameters &parameters)
  {
    if (!is_in_space(parameters))
      return;
    const Refusals refusals(parameters.file);
    for (const std::string name : { "Reinforcement", "Blocks", "Beams" })
      refusals.refuse_if(!ParameterSection(top, name).list("Names").empty(),
                         "section '" + name + "': 'Names'", "Leave it empty.");
    refusals.refuse_if(!ParameterSection(top, "Contact").text("Box").empty(),
                       "section 'Contact': 'Box'", "Leave it empty.");
    refusals.refuse_if(ParameterSection(top, "Water").text("Flow") != "none",
                       "section 'Water': 'Flow'", "Take 'none'.");
    const ParameterSection histories(top, "Histories");
    for (const std::string &name : histories.list("Names"))
    {
      const std::string word
          = ParameterSection(histories, name).text("Quantity");
      if (!HistoryParameters::is_of_plane(word))
        continue;
      HistoryParameters history;
      history.name      = name;
      history.word      = word;
      history.dimension = 2;
      naming(parameters.file, [&]() { history.check_dimension<3>(); });
    }
  }

  void check_three_dimensions(const Parameters &parameters)
  {
    const Refusals refusals(parameters.file);
    refusals.refuse_if(parameters.model.plane == PlaneAssumption::plane_stress,
                       "'Plane assumption = plane stress'",
                       "Leave it 'plane strain'.");
    refusals.refuse_if(parameters.model.thickness != 1., "'Thickness'",
                       "Leave it 1.");
    refusals.refuse_if(parameters.model.large_displacements,
                       "section 'Contact': 'Displacements = large'",
                       "Take 'small'.");
    refusals.refuse_if(parameters.water.flow != FlowKind::none,
                       "section 'Water': 'Flow'", "Take 'none'.");
    refusals.refuse_if(!parameters.model.cables.empty(),
                       "section 'Reinforcement': 'Names'", "Leave it empty.");
    refusals.refuse_if(!parameters.named_blocks.empty(),
                       "section 'Blocks': 'Names'", "Leave it empty.");
    refusals.refuse_if(!parameters.beams.empty(), "section 'Beams': 'Names'",
                       "Leave it empty.");
    check_materials(parameters, refusals);
    check_joints(parameters, refusals);
    check_loads(parameters, refusals);
  }
} // namespace quoin
