// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/application/far_field_setup.h>
#include <quoin/application/given_values.h>
#include <quoin/base/exceptions.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/tdbem/plane_wave.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    using Eigen::VectorXd;

    std::shared_ptr<std::vector<PlaneWave>>
    make_waves(const BoundaryElementParameters &settings,
               const ElasticMedium &medium)
    {
      auto waves = std::make_shared<std::vector<PlaneWave>>();
      for (const IncidentWaveParameters &wave : settings.waves)
        try
        {
          waves->emplace_back(
              medium, wave.is_shear ? PlaneWave::Type::SV : PlaneWave::Type::P,
              wave.half_plane, wave.angle,
              [f = wave.displacement](const double t) {
                return f({ t, t });
              });
        }
        catch (const InputError &error)
        {
          throw InputError("section 'Incident waves/" + wave.name
                           + "': " + error.what());
        }
      return waves;
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
    if (!settings.waves.empty())
    {
      const auto waves             = make_waves(settings, domain.medium);
      domain.incident_displacement = [waves, &geometry](const double time)
      {
        VectorXd sum
            = VectorXd::Zero(Eigen::Index(geometry.boundary.n_unknowns()));
        for (const PlaneWave &wave : *waves)
          sum += wave.displacements(geometry.boundary, time);
        return sum;
      };
      domain.incident_traction
          = [waves, &geometry](const double begin, const double end)
      {
        VectorXd sum
            = VectorXd::Zero(Eigen::Index(geometry.boundary.n_unknowns()));
        for (const PlaneWave &wave : *waves)
          sum += wave.mean_tractions(geometry.boundary, begin, end);
        return sum;
      };
    }
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
