// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/model/material_waves.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  template <int dim>
  std::vector<Impedance> impedance_beyond(const Model<dim> &model,
                                          const LoadParameters &load)
  {
    const auto &materials         = model.properties().materials;
    const auto &material_of_group = model.properties().material_of_group;
    const PlaneAssumption plane   = model.parameters().plane;
    if (load.far_material.empty())
    {
      std::vector<Impedance> result;
      for (const unsigned int m : material_of_group)
        result.push_back(impedance_of(materials[m].elastic, plane));
      return result;
    }
    for (const MaterialParameters &material : materials)
      if (!material.rigid && material.name == load.far_material)
        return std::vector<Impedance>(material_of_group.size(),
                                      impedance_of(material.elastic, plane));
    const auto elastic = [](const MaterialParameters &material)
    { return material.rigid ? std::string() : material.name; };
    throw InputError("section 'Loads/" + load.name
                     + "': 'Far field material = " + load.far_material
                     + "' is no linear elastic material of section "
                       "'Materials'. There are: "
                     + known_names_like(load.far_material, materials, elastic)
                     + ".");
  }

  template <int dim>
  double slowest_shear_wave(const Model<dim> &model)
  {
    double slowest = std::numeric_limits<double>::infinity();
    for (const unsigned int m : model.properties().material_of_group)
    {
      const MaterialParameters &material = model.properties().materials[m];
      if (material.rigid)
        continue;
      const double shear
          = 0.5 * material.elastic.young / (1. + material.elastic.poisson);
      slowest = std::min(slowest, std::sqrt(shear / material.elastic.density));
    }
    return slowest;
  }

  template <int dim>
  FreeFieldGround free_field_ground(const Model<dim> &model)
  {
    FreeFieldGround ground;
    for (const unsigned int m : model.properties().material_of_group)
    {
      const MaterialParameters &material = model.properties().materials[m];
      ground.materials.push_back(material.elastic);
      ground.is_rigid.push_back(material.rigid);
      ground.yields.push_back(material.strength.has_value());
    }
    ground.plane     = model.parameters().plane;
    ground.thickness = model.thickness();
    return ground;
  }

  template std::vector<Impedance> impedance_beyond(const Model<2> &,
                                                   const LoadParameters &);
  template double slowest_shear_wave(const Model<2> &);
  template std::vector<Impedance> impedance_beyond(const Model<3> &,
                                                   const LoadParameters &);
  template double slowest_shear_wave(const Model<3> &);
  template FreeFieldGround free_field_ground(const Model<2> &);
  template FreeFieldGround free_field_ground(const Model<3> &);
} // namespace quoin
