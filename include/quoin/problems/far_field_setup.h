// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_far_field_setup_h
#define quoin_problems_far_field_setup_h

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/problems/parameters.h>
#include <quoin/farfield/far_field.h>
#include <quoin/farfield/static_far_field.h>
#include <quoin/dynamics/model.h>
#include <quoin/mesh/mesh_data.h>

#include <memory>

namespace quoin
{
  /**
   * The boundary elements of a model of blocks. Null if no load is of the type
   * 'boundary elements'. @p parameters and @p geometry, which is filled, must
   * outlive the result. @p mesh is the mesh as read. Throws an InputError that
   * begins with the section.
   */
  std::unique_ptr<FarField> make_far_field(const Parameters &parameters,
                                           const MeshData &mesh,
                                           const Model &model,
                                           BoundaryGeometry &geometry);

  /**
   * The same at rest, of the domain of @p far, null or from make_far_field().
   * Null if no static stage names its load.
   */
  std::unique_ptr<StaticFarField>
  make_static_far_field(const Parameters &parameters, const Model &model,
                        const FarField *far);
} // namespace quoin

#endif
