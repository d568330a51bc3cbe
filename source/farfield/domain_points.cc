// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/farfield/boundary_geometry.h>
#include <quoin/farfield/domain_points.h>

#include <array>
#include <cmath>

namespace quoin
{

  DomainPoints make_domain_points(const SampledFieldParameters &field,
                                  const Boundary &boundary)
  {
    DomainPoints result;
    if (!field.has_box)
      return result;
    const unsigned int nx
        = 1 + std::floor((field.box[2] - field.box[0]) / field.spacing + 1e-9);
    const unsigned int ny
        = 1 + std::floor((field.box[3] - field.box[1]) / field.spacing + 1e-9);
    constexpr std::int32_t none = -1;
    std::vector<std::int32_t> point(nx * ny, none);
    std::vector<double> distance; // of each point to the boundary
    for (unsigned int j = 0; j < ny; ++j)
      for (unsigned int i = 0; i < nx; ++i)
      {
        const dealii::Point<2> x(field.box[0] + i * field.spacing,
                                 field.box[1] + j * field.spacing);
        const NearestElement nearest = nearest_element(boundary, x);
        if (!nearest.inside_domain
            || nearest.distance
                   < 0.25 * boundary.elements[nearest.element].length())
          continue;
        point[j * nx + i] = result.points.size();
        result.points.push_back(x);
        distance.push_back(nearest.distance);
      }
    // Triangles, unless they lie across the boundary.
    const auto add = [&](const std::array<std::int32_t, 3> &triangle)
    {
      bool near = false;
      for (const std::int32_t p : triangle)
      {
        if (p == none)
          return;
        near = near || distance[p] < 2. * field.spacing;
      }
      for (unsigned int k = 0; near && k < 3; ++k)
        for (const BoundaryElement &element : boundary.elements)
          if (segments_meet(result.points[triangle[k]],
                            result.points[triangle[(k + 1) % 3]], element.a,
                            element.b))
            return;
      result.triangles.push_back(triangle);
    };
    for (unsigned int j = 0; j + 1 < ny; ++j)
      for (unsigned int i = 0; i + 1 < nx; ++i)
      {
        const std::int32_t a = point[j * nx + i], b = point[j * nx + i + 1],
                           c = point[(j + 1) * nx + i + 1],
                           d = point[(j + 1) * nx + i];
        // The diagonal that leaves a triangle if one corner is missing.
        if (b == none || d == none)
          add({ { a, b == none ? c : b, d == none ? c : d } });
        else
        {
          add({ { a, b, d } });
          add({ { b, c, d } });
        }
      }
    if (result.points.empty())
      throw InputError("section 'Sampled field': no point of 'Box' is in the "
                       "domain, a quarter of an element from the boundary or "
                       "farther. Move it, or give a smaller 'Spacing'.");
    return result;
  }
} // namespace quoin
