// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_face_group_forces_h
#define quoin_source_joint_elements_face_group_forces_h

#include <quoin/joint_elements/face_groups.h>
#include <quoin/law_lanes/barton_bandis_lanes.h>
#include <quoin/law_lanes/composite_lanes.h>
#include <quoin/law_lanes/continuously_yielding_lanes.h>
#include <quoin/law_lanes/coulomb_lanes.h>
#include <quoin/law_lanes/slip_weakening_lanes.h>

#include <algorithm>
#include <limits>
#include <map>
#include <type_traits>
#include <utility>

#include "segment_lanes.h"
#include "space_face_lanes.h"

// FaceGroups: geometry with a face in each lane, laws with a point in each.

namespace quoin
{
  template <int dim>
  using FaceLanes = std::conditional_t<dim == 2, SegmentLanes<native_lanes>,
                                       SpaceFaceLanes<native_lanes>>;

  /** The first corner of the box about the joint nodes of all ranks. */
  template <int dim>
  dealii::Point<dim> least_joint_position(const NodeMap<dim> &nodes)
  {
    std::vector<double> least(dim, std::numeric_limits<double>::max());
    for (const JointNodes<dim> &joint : nodes.faces().joints)
      for (const unsigned int node : joint.lower)
        for (unsigned int d = 0; d < dim; ++d)
          least[d] = std::min(least[d], nodes.point(node)[d]);
    dealii::Utilities::MPI::min(least, nodes.communicator(), least);
    dealii::Point<dim> result;
    std::copy(least.begin(), least.end(), result.begin_raw());
    return result;
  }

  template <int dim>
  template <typename Face>
  void FaceGroups<dim>::prepare(const std::vector<Face> &faces,
                                const unsigned int n_sets,
                                const NodeMap<dim> &nodes)
  {
    constexpr unsigned int bytes = sizeof(dealii::Tensor<1, dim>);
    groups.clear();
    chunks.clear();
    pairs.clear();
    set_begin.assign(1, 0);
    least = least_joint_position(nodes);
    // Where they fit, to ask for them costs some 4 % of the joints' time.
    constexpr std::size_t cache_size = 1 << 20;
    prefetches
        = nodes.n_local() * (sizeof(NodeRecord<dim>) + bytes) > cache_size;
    // Pairs of the chunk.
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> known;
    unsigned int begin = 0;
    for (unsigned int s = 0; s < n_sets; ++s)
    {
      const unsigned int end
          = std::partition_point(faces.begin() + begin, faces.end(),
                                 [s](const Face &face)
                                 { return face.set <= s; })
            - faces.begin();
      bool is_full = true;
      for (; begin < end; begin += std::min(native_lanes, end - begin))
      {
        if (is_full)
        {
          known.clear();
          FaceChunk chunk{};
          chunk.first_group = groups.size();
          chunk.first_pair  = pairs.size();
          chunks.push_back(chunk);
        }
        FaceGroup<dim, native_lanes> group{};
        group.first = begin;
        group.size  = std::min(native_lanes, end - begin);
        for (unsigned int l = 0; l < native_lanes; ++l)
        {
          const Face &face = faces[begin + std::min(l, group.size - 1)];
          for (unsigned int k = 0; k < dim; ++k)
          {
            const unsigned int lower = face.lower[k], upper = face.upper[k];
            if constexpr (dim == 2)
            {
              group.nodes[k][l]       = lower * bytes;
              group.nodes[dim + k][l] = upper * bytes;
            }
            else
            {
              const auto [pair, is_new]
                  = known.try_emplace({ lower, upper }, known.size());
              if (is_new)
                pairs.push_back({ lower * bytes, upper * bytes });
              group.pairs[k][l] = pair->second * FaceNodes<dim>::bytes_of_pair;
            }
            if (l < group.size)
              group.area[dim == 2 ? k : 0][l] = point_area(face, k);
          }
          group.share[l] = face.share;
        }
        groups.push_back(group);
        ++chunks.back().n_groups;
        chunks.back().n_pairs = known.size();
        // Whether the next group may have more nodes than there is room for.
        is_full = known.size() + dim * native_lanes > FaceChunk::most_pairs;
      }
      set_begin.push_back(chunks.size());
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

  /** Areas [m^2] times the share of the energy that this rank counts, of the
      points of @p group in pack @p h in the order of the history. */
  template <int dim, int lanes>
  QUOIN_INLINE typename LaneFunctions<lanes>::Value
  energy_weights(const FaceGroup<dim, lanes> &group, const unsigned int h)
  {
    using F = LaneFunctions<lanes>;
    typename F::Value of_vertices[dim], of_points[dim];
    for (unsigned int k = 0; k < dim; ++k)
      of_vertices[k] = F::load(group.area_of(k)) * F::load(group.share);
    F::interleave(of_vertices, of_points);
    return of_points[h];
  }

  /** Subtracts from the slips of the points of @p group, in the order of the
      history, those that they had where blocks were placed, @p placed. */
  template <int dim, int lanes>
  QUOIN_INLINE void subtract_placed_slips(
      const FaceGroup<dim, lanes> &group, const double *placed,
      typename LaneFunctions<lanes>::Value (&slip)[dim - 1][dim])
  {
    constexpr unsigned int n = dim * (dim - 1); // of a face
    alignas(64) double own[n * lanes]{};
    placed += n * group.first;
    if (group.size < lanes)
    {
      std::copy_n(placed, n * group.size, own);
      placed = own;
    }
    for (unsigned int h = 0; h < dim; ++h)
    {
      const auto before
          = SlipLanes<lanes, dim>::load(placed + (dim - 1) * h * lanes);
      for (unsigned int c = 0; c < dim - 1; ++c)
        slip[c][h] -= before.component[c];
    }
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
    const double *placed_slip
        = history.placed_slip.empty() ? nullptr : history.placed_slip.data();
    DissipationLanes<lanes> lost;
    // Points of the last group: those behind it belong to another set, or to
    // none.
    PointPack<dim * lanes, dim> pack;
    const PointArrays<dim> packed = pack.arrays();
    FaceNodes<dim> face_nodes(*this, force);
    for (unsigned int i = set_begin[set]; i < set_begin[set + 1]; ++i)
    {
      const FaceChunk &chunk = chunks[i];
      face_nodes.load(chunk, nodes);
      for (unsigned int g = 0; g < chunk.n_groups; ++g)
      {
        const auto &group = groups[chunk.first_group + g];
        face_nodes.prefetch(chunk.first_group + g);
        const Bits of_face = present(group, gone);
        if (!F::any(of_face))
          continue;
        const FaceLanes<dim> faces(group, face_nodes, of_face);

        // Points of the group, in the order of the history.
        Value opening[dim], slip[dim - 1][dim], sigma[dim], tau[dim - 1][dim];
        Bits there[dim];
        F::interleave(faces.opening, opening);
        for (unsigned int c = 0; c < dim - 1; ++c)
          F::interleave(faces.slip[c], slip[c]);
        if (placed_slip)
          subtract_placed_slips(group, placed_slip, slip);
        if (F::all(of_face))
          std::fill_n(there, dim, of_face);
        else
        {
          Bits of_vertices[dim];
          std::fill_n(of_vertices, dim, of_face);
          F::interleave(of_vertices, there);
        }
        const bool is_full         = group.size == lanes;
        const PointArrays<dim> &at = is_full ? arrays : packed;
        std::size_t first          = dim * group.first;
        if (!is_full)
        {
          copy_points(arrays.from(first), packed, dim * group.size);
          first = 0;
        }
#pragma GCC unroll 3
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
            laws.update(points, there[h], energy_weights(group, h), lost);
          sigma[h] = points.sigma;
          for (unsigned int c = 0; c < dim - 1; ++c)
            tau[c][h] = points.tau.component[c];
        }
        if (!is_full)
          copy_points(at, arrays.from(dim * group.first), dim * group.size);
        Value face_sigma[dim], face_tau[dim - 1][dim];
        F::take_apart(sigma, face_sigma);
        for (unsigned int c = 0; c < dim - 1; ++c)
          F::take_apart(tau[c], face_tau[c]);
        for (unsigned int k = 0; k < dim; ++k)
        {
          const Value area = F::load(group.area_of(k));
          face_sigma[k] *= area;
          for (unsigned int c = 0; c < dim - 1; ++c)
            face_tau[c][k] *= area;
        }
        faces.add_forces(group, face_sigma, face_tau, face_nodes);
      }
      face_nodes.add_forces(chunk);
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
    FaceNodes<dim> positions(*this, force), velocities(*this, force);
    for (unsigned int i = set_begin[set]; i < set_begin[set + 1]; ++i)
    {
      const FaceChunk &chunk = chunks[i];
      positions.load(chunk, nodes);
      velocities.load(chunk, velocity);
      for (unsigned int g = 0; g < chunk.n_groups; ++g)
      {
        const auto &group = groups[chunk.first_group + g];
        // beta kn and beta ks times the area, of the points that act.
        double factor[2][dim][lanes]{};
        bool acts = false;
        for (unsigned int j = 0; j < dim * group.size; ++j)
        {
          const unsigned int p = dim * group.first + j;
          if (history.state[p] == JointState::slipping
              || history.state[p] == JointState::open)
            continue;
          const auto [kn, ks] = law.stiffness_at(history.normal_traction[p]);
          const double area   = group.area_of(j % dim)[j / dim];
          factor[0][j % dim][j / dim] = beta * kn * area;
          factor[1][j % dim][j / dim] = beta * ks * area;
          acts                        = true;
        }
        if (!acts)
          continue;
        const FaceLanes<dim> faces(group, positions, present(group, gone));
        Value opening_rate[dim], slip_rate[dim - 1][dim];
        faces.find_rates(group, velocities, opening_rate, slip_rate);
        Value sigma[dim], tau[dim - 1][dim];
        for (unsigned int k = 0; k < dim; ++k)
        {
          sigma[k] = F::load(factor[0][k]) * opening_rate[k];
          for (unsigned int c = 0; c < dim - 1; ++c)
            tau[c][k] = F::load(factor[1][k]) * slip_rate[c][k];
        }
        faces.add_forces(group, sigma, tau, positions);
      }
      positions.add_forces(chunk);
    }
  }
} // namespace quoin

#endif
