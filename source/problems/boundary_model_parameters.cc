// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/mesh_parameters.h>
#include <quoin/problems/model_parameters.h>
#include <quoin/base/named_sections.h>
#include <quoin/tdbem/elastic_medium.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
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
  } // namespace

  void read_boundary_elements(const ParameterSection &top,
                              Parameters &parameters, const bool coupled)
  {
    BoundaryElementParameters &boundary = parameters.boundary;
    boundary                            = BoundaryElementParameters::read(
                                   ParameterSection(top, "Boundary elements"), coupled);
    boundary.boundaries
        = read_named<BoundaryCurveParameters>(top, "Boundary elements");
    boundary.waves = read_named<IncidentWaveParameters>(top, "Incident waves");
    boundary.sampled_field
        = SampledFieldParameters::read(ParameterSection(top, "Sampled field"));
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
            && curve.shape != BoundaryShape::interface && curve.n_elements == 0
            && curve.element_length == 0. && boundary.element_length == 0.)
          ParameterSection(section, curve.name)
              .fail("Elements", "leaves the size of the elements open: give "
                                "their number, an 'Element length' or a "
                                "'Highest frequency'.");
    }
  }

  void read_boundary_model(const ParameterSection &top, Parameters &parameters)
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
} // namespace quoin
