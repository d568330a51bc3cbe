// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/application/far_field_setup.h>
#include <quoin/application/given_values.h>
#include <quoin/base/exceptions.h>
#include <quoin/loads/nodal_load.h>

#include <algorithm>

namespace quoin
{
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

    const BoundaryElementParameters &settings = parameters.boundary;
    geometry = make_boundary_geometry(settings, mesh);
    FarFieldDomain domain;
    domain.boundary = geometry.boundary;
    for (const MaterialParameters &material : parameters.model.materials)
      if (material.name == settings.material)
        domain.medium = ElasticMedium::from_young(material.elastic.density,
                                                  material.elastic.young,
                                                  material.elastic.poisson);
    std::vector<std::string> curves;
    for (const BoundaryCurveParameters &curve : settings.boundaries)
      if (curve.shape == BoundaryShape::interface)
        curves.insert(curves.end(), curve.curves.begin(), curve.curves.end());
    for (unsigned int e = 0; e < geometry.owner.size(); ++e)
      if (settings.boundaries[geometry.owner[e]].shape
          == BoundaryShape::interface)
        domain.interface.push_back(e);

    domain.formulation.formulation    = settings.formulation;
    domain.formulation.decay          = settings.decay;
    domain.formulation.damping        = settings.damping;
    domain.formulation.direct_history = settings.direct_history;
    domain.formulation.tolerance      = settings.tolerance;
    domain.scheme                     = settings.coupling;

    const auto given = std::make_shared<GivenValues>(geometry, settings);
    given->check_start();
    domain.traction_is_given = given->traction_is_given();
    domain.given             = [given](const double begin, const double end)
    { return (*given)(begin, end); };
    try
    {
      return std::make_unique<FarField>(
          load->name, std::move(domain), model.mesh(),
          faces_of_curves(model.mesh(), curves, load->name), model.exchange(),
          model.thickness());
    }
    catch (const InputError &error)
    {
      throw InputError(std::string("section 'Boundary elements': ")
                       + error.what());
    }
  }
} // namespace quoin
