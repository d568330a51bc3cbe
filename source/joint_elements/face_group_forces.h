// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_face_group_forces_h
#define quoin_source_joint_elements_face_group_forces_h

#include <quoin/joint_elements/face_groups.h>
#include <quoin/joint_laws/composite_lanes.h>
#include <quoin/joint_laws/coulomb_lanes.h>

#include <algorithm>
#include <type_traits>

#include "segment_lanes.h"
#include "space_face_lanes.h"

// FaceGroups: geometry with a face in each lane, laws with a point in each.

namespace quoin
{
  template <int dim>
  using FaceLanes = std::conditional_t<dim == 2, SegmentLanes<native_lanes>,
                                       SpaceFaceLanes<native_lanes>>;

  template <int dim>
  template <typename Face>
  void FaceGroups<dim>::prepare(const std::vector<Face> &faces,
                                const unsigned int n_sets)
  {
    groups.clear();
    set_begin.assign(1, 0);
    unsigned int begin = 0;
    for (unsigned int s = 0; s < n_sets; ++s)
    {
      const unsigned int end
          = std::partition_point(faces.begin() + begin, faces.end(),
                                 [s](const Face &face)
                                 { return face.set <= s; })
            - faces.begin();
      for (; begin < end; begin += std::min(native_lanes, end - begin))
      {
        FaceGroup<dim, native_lanes> group{};
        group.first = begin;
        group.size  = std::min(native_lanes, end - begin);
        for (unsigned int l = 0; l < native_lanes; ++l)
        {
          const Face &face = faces[begin + std::min(l, group.size - 1)];
          for (unsigned int k = 0; k < dim; ++k)
          {
            constexpr unsigned int bytes = sizeof(dealii::Tensor<1, dim>);
            group.nodes[k][l]            = face.lower[k] * bytes;
            group.nodes[dim + k][l]      = face.upper[k] * bytes;
            if (l >= group.size)
              continue;
            group.area[dim * l + k]   = point_area(face, k);
            group.weight[dim * l + k] = point_area(face, k) * face.share;
          }
        }
        groups.push_back(group);
      }
      set_begin.push_back(groups.size());
    }
  }

  /** Faces of @p group that are there and still joints. */
  template <int dim, int lanes>
  QUOIN_INLINE typename LaneFunctions<lanes>::Bits
  present(const FaceGroup<dim, lanes> &group, const std::uint8_t *gone)
  {
    using F = LaneFunctions<lanes>;
    if (group.size == lanes)
      return F::load_bytes(gone + group.first) == 0;
    std::uint8_t bytes[lanes];
    std::fill_n(bytes, lanes, 1);
    std::copy_n(gone + group.first, group.size, bytes);
    return F::load_bytes(bytes) == 0;
  }

  template <int dim>
  template <typename Law, typename History>
  void FaceGroups<dim>::add_forces(const unsigned int set, const Law &law,
                                   const NodeRecord<dim> *nodes,
                                   History &history, const std::uint8_t *gone,
                                   EnergyAccounts &energy,
                                   dealii::Tensor<1, dim> *force) const
  {
    constexpr int lanes = native_lanes;
    using F             = LaneFunctions<lanes>;
    using Bits          = typename F::Bits;
    using Value         = typename F::Value;
    const LawLanes<Law, lanes, dim> laws(law);
    const PointArrays<dim> arrays = arrays_of(history);
    DissipationLanes<lanes> lost;
    // Points of the last group: those behind it belong to another set, or to
    // none.
    PointPack<dim * lanes, dim> pack;
    for (unsigned int g = set_begin[set]; g < set_begin[set + 1]; ++g)
    {
      const auto &group  = groups[g];
      const Bits of_face = present(group, gone);
      if (!F::any(of_face))
        continue;
      const FaceLanes<dim> faces(group, nodes, of_face);

      // Points of the group, in the order of the history.
      Value opening[dim], slip[dim - 1][dim], sigma[dim], tau[dim - 1][dim];
      Bits there[dim], all_of_face[dim];
      std::fill_n(all_of_face, dim, of_face);
      F::interleave(faces.opening, opening);
      for (unsigned int c = 0; c < dim - 1; ++c)
        F::interleave(faces.slip[c], slip[c]);
      F::interleave(all_of_face, there);
      const bool is_full  = group.size == lanes;
      PointArrays<dim> at = arrays;
      std::size_t first   = dim * group.first;
      if (!is_full)
      {
        copy_points(arrays.from(first), pack.arrays(), dim * group.size);
        at    = pack.arrays();
        first = 0;
      }
      for (unsigned int h = 0; h < dim; ++h)
      {
        PointLanes<lanes, dim> points;
        points.arrays  = at;
        points.first   = first + h * lanes;
        points.opening = opening[h];
        for (unsigned int c = 0; c < dim - 1; ++c)
          points.slip.component[c] = slip[c][h];
        const Bits steady = laws.try_elastic(points);
        if (F::all(steady & there[h]))
          points.store_tractions();
        else
          laws.update(points, there[h], F::load(group.weight + h * lanes),
                      lost);
        const Value area = F::load(group.area + h * lanes);
        sigma[h]         = area * points.sigma;
        for (unsigned int c = 0; c < dim - 1; ++c)
          tau[c][h] = area * points.tau.component[c];
      }
      if (!is_full)
        copy_points(at, arrays.from(dim * group.first), dim * group.size);
      Value face_sigma[dim], face_tau[dim - 1][dim];
      F::take_apart(sigma, face_sigma);
      for (unsigned int c = 0; c < dim - 1; ++c)
        F::take_apart(tau[c], face_tau[c]);
      faces.add_forces(group, face_sigma, face_tau, force);
    }
    energy.friction += F::sum(lost.friction);
    energy.fracture += F::sum(lost.fracture);
    energy.crushing += F::sum(lost.crushing);
  }

  template <int dim>
  template <typename Law, typename History>
  void FaceGroups<dim>::add_viscous_forces(
      const unsigned int set, const Law &law, const NodeRecord<dim> *nodes,
      const History &history, const std::uint8_t *gone,
      const dealii::Tensor<1, dim> *velocity, const double beta,
      dealii::Tensor<1, dim> *force) const
  {
    constexpr int lanes = native_lanes;
    using F             = LaneFunctions<lanes>;
    using Value         = typename F::Value;
    for (unsigned int g = set_begin[set]; g < set_begin[set + 1]; ++g)
    {
      const auto &group = groups[g];
      // beta kn and beta ks times the area, of the points that act.
      double factor[2][dim * lanes]{};
      bool acts = false;
      for (unsigned int j = 0; j < dim * group.size; ++j)
      {
        const unsigned int p = dim * group.first + j;
        if (history.state[p] == JointState::slipping
            || history.state[p] == JointState::open)
          continue;
        const auto [kn, ks] = law.stiffness_at(history.normal_traction[p]);
        factor[0][j]        = beta * kn * group.area[j];
        factor[1][j]        = beta * ks * group.area[j];
        acts                = true;
      }
      if (!acts)
        continue;
      const FaceLanes<dim> faces(group, nodes, present(group, gone));
      Value opening_rate[dim], slip_rate[dim - 1][dim];
      faces.find_rates(group, velocity, opening_rate, slip_rate);
      const auto of_face = [](const double *values, Value(&result)[dim])
      {
        Value points[dim];
        for (unsigned int h = 0; h < dim; ++h)
          points[h] = F::load(values + h * lanes);
        F::take_apart(points, result);
      };
      Value normal[dim], shear[dim], sigma[dim], tau[dim - 1][dim];
      of_face(factor[0], normal);
      of_face(factor[1], shear);
      for (unsigned int k = 0; k < dim; ++k)
      {
        sigma[k] = normal[k] * opening_rate[k];
        for (unsigned int c = 0; c < dim - 1; ++c)
          tau[c][k] = shear[k] * slip_rate[c][k];
      }
      faces.add_forces(group, sigma, tau, force);
    }
  }
} // namespace quoin

#endif
