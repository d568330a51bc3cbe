// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/far_field_setup.h>
#include <quoin/farfield/boundary_values.h>
#include <quoin/base/exceptions.h>
#include <quoin/dynamics/solver.h>
#include <quoin/loads/nodal_load.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    /** Edges of blocks along the interface. */
    std::vector<BoundaryFace<2>>
    interface_faces(const BoundaryElementParameters &settings,
                    const Model &model, const std::string &load)
    {
      std::vector<std::string> curves;
      for (const BoundaryCurveParameters &curve : settings.boundaries)
        if (curve.shape == BoundaryShape::interface)
          curves.insert(curves.end(), curve.curves.begin(), curve.curves.end());
      return faces_of_curves(model.nodes(), curves, load);
    }

    /** The history of the waves must have no gap. */
    void check_stages(const std::vector<StageParameters> &stages,
                      const std::string &load)
    {
      bool has_acted = false, has_stopped = false;
      for (const StageParameters &stage : stages)
      {
        const bool acts
            = stage.end == StageEnd::time && names_load(stage, load);
        if (acts && has_stopped)
          throw InputError("section 'Stages/" + stage.name
                           + "': the boundary elements of load '" + load
                           + "' have acted in an earlier stage with 'End = "
                             "time' and not in the stage before this one: "
                             "their history would have a gap. Let such stages "
                             "follow each other.");
        has_acted   = has_acted || acts;
        has_stopped = has_acted && !acts;
      }
    }
  } // namespace

  std::unique_ptr<FarField> make_far_field(const Parameters &parameters,
                                           const MeshData &mesh,
                                           const Model &model,
                                           BoundaryGeometry &geometry)
  {
    const auto load
        = std::find_if(parameters.loads.begin(), parameters.loads.end(),
                       [](const LoadParameters &candidate) {
                         return candidate.type == LoadType::boundary_elements;
                       });
    if (load == parameters.loads.end())
      return nullptr;

    check_stages(parameters.stages, load->name);
    const BoundaryElementParameters &settings = parameters.boundary;
    geometry = make_boundary_geometry(settings, mesh);
    FarFieldDomain domain;
    domain.boundary = geometry.boundary;
    for (const MaterialParameters &material : parameters.model.materials)
      if (material.name == settings.material)
        domain.medium = ElasticMedium::from_young(material.elastic.density,
                                                  material.elastic.young,
                                                  material.elastic.poisson);
    for (unsigned int e = 0; e < geometry.owner.size(); ++e)
      if (settings.boundaries[geometry.owner[e]].shape
          == BoundaryShape::interface)
        domain.interface.push_back(e);

    domain.formulation = settings.formulation_options();
    domain.scheme      = settings.coupling;

    const auto given = std::make_shared<BoundaryValues>(geometry, settings);
    given->check_start();
    domain.traction_is_given = given->traction_is_given();
    domain.given             = [given](const double begin, const double end)
    { return (*given)(begin, end); };
    try
    {
      return std::make_unique<FarField>(
          load->name, std::move(domain), model.nodes(),
          interface_faces(settings, model, load->name), model.thickness());
    }
    catch (const InputError &error)
    {
      throw InputError(std::string("section 'Boundary elements': ")
                       + error.what());
    }
  }

  std::unique_ptr<StaticFarField>
  make_static_far_field(const Parameters &parameters, const Model &model,
                        const FarField *far)
  {
    const auto needs_it = [&](const StageParameters &stage)
    {
      return (stage.end == StageEnd::static_ratio || parameters.is_implicit)
             && names_load(stage, far->name());
    };
    if (!far
        || std::none_of(parameters.stages.begin(), parameters.stages.end(),
                        needs_it))
      return nullptr;
    return std::make_unique<StaticFarField>(
        far->name(), far->domain(), model.nodes(),
        interface_faces(parameters.boundary, model, far->name()),
        model.thickness());
  }
} // namespace quoin
