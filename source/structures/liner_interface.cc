// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/base/exceptions.h>
#include <quoin/joints/point_arrays.h>
#include <quoin/structures/liner_interface.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace quoin
{
  void LinerInterface::attach(const BeamLine &line, State<2> &state) const
  {
    const auto refuse = [&](const std::string &why)
    {
      throw InputError("section 'Beams/" + line.given.name
                       + "': 'Boundary = " + line.given.boundary + "' " + why);
    };
    BeamState &beams = state.get<BeamState>();
    std::vector<unsigned int> n_here(line.places.size(), 0);
    std::vector<dealii::Tensor<1, 2>> sum(line.places.size());
    double side = 0.;
    for (unsigned int k = 0; k < points.size(); ++k)
    {
      const InterfacePoint &point = points[k];
      beams.attached[first + k]   = !state.is_absent(point.block);
      if (!beams.attached[first + k])
        continue;
      if (side * point.side < 0.)
        refuse("has blocks on both sides where the stage '" + line.given.stage
               + "' places the liner. Name the stage that excavates one of "
                 "them, or a later one, as its 'Stage'.");
      side = point.side;
      n_here[point.at] += 1;
      sum[point.at] += vector_at(beams.block_motion, first + k);
    }
    if (line.given.is_liner())
      for (unsigned int i = 0; i < n_here.size(); ++i)
      {
        if (n_here[i] == 0)
          refuse("has no block in a part of it where the stage places the "
                 "liner. Place it before they are excavated, or line another "
                 "curve.");
        beams.nodes[line.begin + i].X
            = line.places[i] + sum[i] / double(n_here[i]);
      }
    for (unsigned int k = 0; k < points.size(); ++k)
      if (const unsigned int p = first + k; beams.attached[p])
      {
        std::visit(
            [&](const auto &law)
            { write_point(PointOf<decltype(law)>(), beams.interface, p); },
            law);
        beams.offset[p]    = dealii::Tensor<1, 2>();
        const Gap at_start = gap(line, k, beams);
        beams.offset[p]    = dealii::Point<2>(at_start.opening, at_start.slip);
      }
  }

  LinerInterface::Gap LinerInterface::gap(const BeamLine &line,
                                          const unsigned int k,
                                          const BeamState &beams) const
  {
    const InterfacePoint &point = points[k];
    const unsigned int at = line.begin + point.at, p = first + k;
    dealii::Tensor<1, 2> sum;
    for (const unsigned int begin : line.segments_at(at))
      sum += line.segment(begin, beams).direction;
    Gap gap;
    gap.tangent   = sum / sum.norm();
    gap.normal[0] = -point.side * gap.tangent[1];
    gap.normal[1] = point.side * gap.tangent[0];
    const dealii::Tensor<1, 2> way
        = (line.places[point.at] - beams.nodes[at].X)
          + (vector_at(beams.block_motion, p) - beams.nodes[at].u);
    gap.opening = gap.normal * way - beams.offset[p][0];
    gap.slip    = gap.tangent * way - beams.offset[p][1];
    return gap;
  }

  double LinerInterface::stiffness_bound(const unsigned int k) const
  {
    const auto [kn, ks] = quoin::stiffness_bound(law);
    return 2. * points[k].area * std::max(kn, ks);
  }

  double LinerInterface::add_forces(const BeamLine &line, const State<2> &state,
                                    BeamState &beams, EnergyAccounts &energy,
                                    dealii::Tensor<1, 2> *force,
                                    dealii::Tensor<1, 2> *by_point) const
  {
    double size      = 0.;
    const auto visit = [&](const auto &law)
    {
      for (unsigned int k = 0; k < points.size(); ++k)
      {
        if (!acts(k, state, beams))
          continue;
        const double area = points[k].area, side = points[k].side;
        const unsigned int at = line.begin + points[k].at, p = first + k;
        const Gap now = gap(line, k, beams);
        auto point    = read_point(law, beams.interface, p);
        if (!law.update_elastic(point, now.opening, now.slip))
        {
          const JointDissipation lost
              = law.update_failing(point, now.opening, now.slip);
          energy.friction += area * lost.friction;
          energy.fracture += area * lost.fracture;
          energy.crushing += area * lost.crushing;
        }
        write_point(point, beams.interface, p);
        beams.stored_joint += area * law.stored_energy(point, now.opening);
        by_point[p] = area
                      * (point.normal_traction * now.normal
                         + point.shear_traction * now.tangent);
        force[at] += by_point[p];
        size += std::abs(by_point[p][0]) + std::abs(by_point[p][1]);
        // The frame turns with the segments at the node, by the mean of their
        // angles: what keeps the balance of moments and energy over a gap.
        const double couple
            = area * side
              * (point.normal_traction * (now.slip + beams.offset[p][1])
                 - point.shear_traction * (now.opening + beams.offset[p][0]));
        const auto segments = line.segments_at(at);
        for (const unsigned int begin : segments)
        {
          const BeamLine::Segment s = line.segment(begin, beams);
          const double f          = couple / double(segments.size()) / s.length;
          dealii::Tensor<1, 2> &a = force[begin], &b = force[line.next(begin)];
          a[0] += f * s.direction[1];
          a[1] -= f * s.direction[0];
          b[0] -= f * s.direction[1];
          b[1] += f * s.direction[0];
        }
      }
    };
    std::visit(visit, law);
    return size;
  }
} // namespace quoin
