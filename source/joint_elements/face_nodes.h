// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_face_nodes_h
#define quoin_source_joint_elements_face_nodes_h

#include <quoin/base/lanes.h>
#include <quoin/joint_elements/face_groups.h>

#include <algorithm>
#include <cstddef>

namespace quoin
{
  /** The nodes of faces, from which the faces of groups take their motion and
      to which they add forces. */
  template <int dim>
  class FaceNodes;

  /** In two dimensions groups load and add to nodes themselves. */
  template <>
  class FaceNodes<2>
  {
  public:
    FaceNodes(const FaceGroups<2> &groups, dealii::Tensor<1, 2> *const force)
      : force(force), groups(groups), prefetches(groups.prefetches_nodes())
    {
    }
    void load(const FaceChunk &, const NodeRecord<2> *const positions)
    {
      nodes = positions;
    }
    void load(const FaceChunk &, const dealii::Tensor<1, 2> *const velocities)
    {
      velocity = velocities;
    }
    void add_forces(const FaceChunk &) const
    {
    }

    /** Prefetches nodes and forces of a group after that with @p index, by the
        first vertices of its segments, as the second ones are next to them. */
    QUOIN_INLINE void prefetch(const std::size_t index) const
    {
      if (!prefetches)
        return;
      constexpr std::size_t ahead = 24 / native_lanes;
      const auto &group           = groups.group_at(index + ahead);
      for (unsigned int l = 0; l < native_lanes; ++l)
        for (const unsigned int side : { 0, 2 })
        {
          const std::size_t offset = group.nodes[side][l];
          __builtin_prefetch(reinterpret_cast<const char *>(nodes)
                             + 2 * offset);
          __builtin_prefetch(reinterpret_cast<char *>(force) + offset, 1);
        }
    }

    const NodeRecord<2> *nodes           = nullptr;
    const dealii::Tensor<1, 2> *velocity = nullptr;
    dealii::Tensor<1, 2> *const force;

  private:
    const FaceGroups<2> &groups;
    const bool prefetches;
  };

  /**
   * In three dimensions the nodes of a chunk are loaded, and given their
   * forces, once for all its faces, which share each with some three others. A
   * face sees a pair of nodes only by the gap, the vector from the lower to the
   * upper one, and by the sum of both; it acts on them by opposite forces and
   * by equal ones.
   */
  template <>
  class FaceNodes<3>
  {
  public:
    FaceNodes(const FaceGroups<3> &groups, dealii::Tensor<1, 3> *const force)
      : pairs(groups.node_pairs().data()), n_pairs(groups.node_pairs().size()),
        prefetches(groups.prefetches_nodes()), force(force)
    {
      for (unsigned int d = 0; d < 3; ++d)
        origin[d] = groups.origin()[d];
    }

    /** Takes the positions of the nodes of @p chunk, sums relative to the
        origin. Differences of X and of u are taken apart as in between(). */
    QUOIN_INLINE void load(const FaceChunk &chunk,
                           const NodeRecord<3> *const nodes)
    {
      static_assert(sizeof(NodeRecord<3>) == 6 * sizeof(double));
      const char *base  = reinterpret_cast<const char *>(nodes);
      const auto record = [base](const std::uint32_t offset) {
        return reinterpret_cast<const double *>(base + 2 * std::size_t(offset));
      };
      // u of (X_3, u)
      const auto shifted = [](const Row &row)
      { return __builtin_shufflevector(row, row, 1, 2, 3, 3); };
      const Row from = origin; // no row can alias it
      for (unsigned int p = 0; p < chunk.n_pairs; ++p)
      {
        const NodePair &pair = pairs[chunk.first_pair + p];
        if (prefetches)
          prefetch(nodes, chunk.first_pair + p);
        const double *a = record(pair.lower), *b = record(pair.upper);
        const Row Xa = Lanes<4>::four(a), Xb = Lanes<4>::four(b);
        const Row ua = Lanes<4>::four(a + 2), ub = Lanes<4>::four(b + 2);
        motions[p][0] = (Xb - Xa) + shifted(ub - ua);
        motions[p][1] = ((Xa - from) + (Xb - from)) + shifted(ua + ub);
        forces[p][0] = forces[p][1] = Row{};
      }
    }

    /** Takes velocities instead. */
    void load(const FaceChunk &chunk,
              const dealii::Tensor<1, 3> *const velocity)
    {
      const char *base = reinterpret_cast<const char *>(velocity);
      const auto row   = [base](const std::uint32_t offset)
      {
        const double *v = reinterpret_cast<const double *>(base + offset);
        return Row{ v[0], v[1], v[2], 0. };
      };
      for (unsigned int p = 0; p < chunk.n_pairs; ++p)
      {
        const NodePair &pair = pairs[chunk.first_pair + p];
        const Row a = row(pair.lower), b = row(pair.upper);
        motions[p][0] = b - a;
        motions[p][1] = a + b;
      }
    }

    /** Nodes were prefetched as they were loaded. */
    void prefetch(std::size_t) const
    {
    }

    /** Gaps and sums of the pairs with @p offset; see FaceGroup. */
    template <int lanes, typename Value>
    QUOIN_INLINE void motion(const std::uint16_t (&offset)[lanes],
                             Value (&gap)[4], Value (&sum)[4]) const
    {
      using L          = Lanes<lanes>;
      const char *base = reinterpret_cast<const char *>(motions);
      L::load_columns(base, offset, gap);
      L::load_columns(base + sizeof(Row), offset, sum);
    }

    /** Adds @p equal + @p opposite to the forces on the lower nodes of the
        pairs with @p offset, @p equal - @p opposite to those on the upper. */
    template <int lanes, typename Value>
    QUOIN_INLINE void add(const std::uint16_t (&offset)[lanes],
                          const Value (&opposite)[4], const Value (&equal)[4])
    {
      using L    = Lanes<lanes>;
      char *base = reinterpret_cast<char *>(forces);
      L::add_columns(base, offset, opposite);
      L::add_columns(base + sizeof(Row), offset, equal);
    }

    /** Adds to the forces on the nodes of @p chunk. */
    QUOIN_INLINE void add_forces(const FaceChunk &chunk) const
    {
      char *base = reinterpret_cast<char *>(force);
      for (unsigned int p = 0; p < chunk.n_pairs; ++p)
      {
        const NodePair &pair = pairs[chunk.first_pair + p];
        add(base + pair.lower, forces[p][1] + forces[p][0]);
        add(base + pair.upper, forces[p][1] - forces[p][0]);
      }
    }

    using Row = Lanes<4>::Value; /**< x, y, z and a number without meaning */
    static constexpr unsigned int bytes_of_pair = 2 * sizeof(Row);

  private:
    /** Prefetches the nodes of a pair after that with @p index, and the forces
        on those of this one, which are added after the groups of the chunk. */
    QUOIN_INLINE void prefetch(const NodeRecord<3> *const nodes,
                               const std::size_t index) const
    {
      constexpr std::size_t ahead = 16;
      const NodePair &later       = pairs[std::min(index + ahead, n_pairs - 1)];
      for (const std::size_t offset : { later.lower, later.upper })
      {
        // Records can reach into the next line.
        const char *record = reinterpret_cast<const char *>(nodes) + 2 * offset;
        __builtin_prefetch(record);
        __builtin_prefetch(record + sizeof(NodeRecord<3>) - 1);
      }
      const NodePair &pair = pairs[index];
      for (const std::size_t offset : { pair.lower, pair.upper })
        __builtin_prefetch(reinterpret_cast<char *>(force) + offset, 1);
    }

    static QUOIN_INLINE void add(char *to, const Row &row)
    {
      double *f = reinterpret_cast<double *>(to);
      *reinterpret_cast<Two *>(f) += __builtin_shufflevector(row, row, 0, 1);
      f[2] += row[2];
    }

    const NodePair *const pairs;
    const std::size_t n_pairs;
    const bool prefetches;
    dealii::Tensor<1, 3> *const force;
    Row origin{};
    alignas(64) Row motions[FaceChunk::most_pairs][2]; /**< gap, sum */
    alignas(64) Row forces[FaceChunk::most_pairs][2];  /**< opposite, equal */
  };
} // namespace quoin

#endif
