// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_contact_test_contacts_h
#define quoin_tests_unit_contact_test_contacts_h

#include "../model/test_models.h"

#include <quoin/contact/block_contacts.h>

namespace quoin::test
{
  constexpr double kn        = 8e9;
  constexpr double ks        = 3e9;
  constexpr double thickness = 0.3;

  struct Rectangle
  {
    double x, y, width, height; // lower left corner before it is turned
    unsigned int nx, ny;
    double angle = 0.; // about its lower left corner [rad]
  };

  /** Each rectangle is a block of the group "stone"; none share nodes. */
  inline BlockMesh<2> make_blocks(const std::vector<Rectangle> &rectangles)
  {
    MeshData<2> data;
    data.group_names = { "stone" };
    for (const Rectangle &r : rectangles)
    {
      const unsigned int first = data.vertices.size();
      const double c = std::cos(r.angle), s = std::sin(r.angle);
      for (unsigned int j = 0; j <= r.ny; ++j)
        for (unsigned int i = 0; i <= r.nx; ++i)
        {
          const double x = r.width * i / r.nx, y = r.height * j / r.ny;
          data.vertices.emplace_back(r.x + c * x - s * y, r.y + s * x + c * y);
        }
      for (unsigned int j = 0; j < r.ny; ++j)
        for (unsigned int i = 0; i < r.nx; ++i)
        {
          const unsigned int a = first + j * (r.nx + 1) + i;
          const unsigned int b = a + 1, d = a + r.nx + 1, e = d + 1;
          data.cells.push_back({ { a, b, e } });
          data.cells.push_back({ { a, e, d } });
          data.cell_group.push_back(0);
          data.cell_group.push_back(0);
        }
    }
    return split_into_blocks(data, {});
  }

  inline JointSetParameters touching(const double friction = 0.5)
  {
    JointSetParameters set = elastic_joint(kn, ks);
    set.name               = "touch";
    set.curves.clear();
    set.all_new_contacts  = true;
    coulomb_law(set).peak = coulomb_law(set).residual = { 0., friction, 0. };
    return set;
  }

  inline ContactModel contact_model(const std::vector<JointSetParameters> &sets)
  {
    ContactModel model;
    model.parameters.large_displacements = true;
    model.sets                           = sets;
    model.materials                      = { "stone" };
    model.material_of_group              = { 0, 0 };
    model.thickness                      = thickness;
    return model;
  }
} // namespace quoin::test

#endif
