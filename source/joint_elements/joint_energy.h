// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_joint_energy_h
#define quoin_source_joint_elements_joint_energy_h

#include <quoin/base/node_record.h>
#include <quoin/joint_elements/joint_points.h>
#include <quoin/joint_elements/matched_joints.h>
#include <quoin/joint_elements/space_joints.h>

#include <algorithm>
#include <cstdint>
#include <variant>
#include <vector>

namespace quoin
{
  /**
   * Recoverable energy [J] of the points of @p faces, sorted by their sets,
   * which are under @p laws, but of those that are @p gone; this rank's share
   * of faces that it has in common with another. Gaps are found for the few
   * points alone whose energy depends on them.
   */
  template <int dim, typename Face, typename History>
  double stored_energy(const std::vector<Face> &faces,
                       const std::vector<JointLaw> &laws,
                       const History &history,
                       const AlignedArray<std::uint8_t> &gone,
                       const NodeRecord<dim> *nodes)
  {
    double energy       = 0.;
    unsigned int first  = 0;
    const auto add_face = [&](const auto &law, const unsigned int i)
    {
      const Face &face = faces[i];
      for (unsigned int k = 0; k < dim; ++k)
      {
        const auto point = read_point(law, history, dim * i + k);
        const double opening
            = law.stores_by_opening(point) ? joint_gaps(face, nodes)[k][0] : 0.;
        energy += point_area(face, k) * face.share
                  * law.stored_energy(point, opening);
      }
    };
    for (unsigned int set = 0; set < laws.size(); ++set)
    {
      const unsigned int end
          = std::partition_point(faces.begin() + first, faces.end(),
                                 [set](const Face &face)
                                 { return face.set <= set; })
            - faces.begin();
      std::visit(
          [&](const auto &law)
          {
            for (unsigned int i = first; i < end; ++i)
              if (!gone[i])
                add_face(law, i);
          },
          laws[set]);
      first = end;
    }
    return energy;
  }
} // namespace quoin

#endif
