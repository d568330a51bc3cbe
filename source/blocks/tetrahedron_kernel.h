// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_blocks_tetrahedron_kernel_h
#define quoin_source_blocks_tetrahedron_kernel_h

#include <quoin/base/lanes.h>
#include <quoin/base/node_record.h>
#include <quoin/block_elements/tetrahedron.h>
#include <quoin/mesh/mixed_tetrahedra.h>

#include <cstddef>
#include <cstdint>

/** Forces of the tetrahedra of a chunk, several at once. */
namespace quoin
{
  namespace
  {
    /** Copies of the nodes that the cells of a chunk have, where loads and
        stores of four doubles are aligned. */
    struct ChunkNodes
    {
      static constexpr unsigned int max_size = 256;

      using Row = double __attribute__((vector_size(32), may_alias));
      using UnalignedRow
          = double __attribute__((vector_size(32), aligned(8), may_alias));
      using UnalignedPair
          = double __attribute__((vector_size(16), aligned(8), may_alias));

      Row record[max_size][2]; /**< X, u_1 and X_3, u [m] */
      Row force[max_size];     /**< [N]; the fourth is not used */

      /** Takes @p n nodes out of the @p records, with no force yet. */
      void load(const std::uint32_t *node, const std::size_t n,
                const NodeRecord<3> *records)
      {
        static_assert(sizeof(NodeRecord<3>) == 48);
        for (std::size_t k = 0; k < n; ++k)
        {
          const char *r = reinterpret_cast<const char *>(records + node[k]);
          record[k][0]  = *reinterpret_cast<const UnalignedRow *>(r);
          record[k][1]  = *reinterpret_cast<const UnalignedRow *>(r + 16);
          force[k]      = Row{};
        }
      }

      void add_forces(const std::uint32_t *node, const std::size_t n,
                      dealii::Tensor<1, 3> *sums) const
      {
        for (std::size_t k = 0; k < n; ++k)
        {
          // A store of all four would delay the load of the next node.
          double *f = sums[node[k]].begin_raw();
          *reinterpret_cast<UnalignedPair *>(f)
              += __builtin_shufflevector(force[k], force[k], 0, 1);
          f[2] += force[k][2];
        }
      }
    };

    /** Edges of cells that go through the lanes together. */
    template <int lanes>
    struct TetrahedronEdges
    {
      using L     = Lanes<lanes>;
      using Value = typename L::Value;

      Value e[3][3]; /**< from node 0 to nodes 1, 2, 3, at rest [m] */
      Value d[3][3]; /**< their displacements less that of node 0 [m] */

      /** @p offset: of nodes 0, 1, 2, 3 of each lane, in bytes into the
          forces, half of that into the records. */
      QUOIN_INLINE void load(const std::uint16_t *offset,
                             const ChunkNodes &nodes)
      {
        const char *records = reinterpret_cast<const char *>(nodes.record);
        Value X0[4], u0[4];
        L::load_rows(records, 2, offset, X0);
        L::load_rows(records + 32, 2, offset, u0);
        for (int k = 0; k < 3; ++k)
        {
          Value X[4], u[4], column[4];
          L::load_rows(records, 2, offset + (k + 1) * lanes, X);
          L::load_rows(records + 32, 2, offset + (k + 1) * lanes, u);
          for (int l = 0; l < 4; ++l)
          {
            X[l] -= X0[l];
            u[l] -= u0[l];
          }
          L::to_columns(X, column);
          for (int i = 0; i < 3; ++i)
            e[k][i] = column[i];
          L::to_columns(u, column);
          for (int i = 0; i < 3; ++i)
            d[k][i] = column[i + 1];
        }
      }
    };

    /** Cells that go through the lanes together. */
    template <int lanes, bool with_stress>
    struct TetrahedronGroup
    {
      using L     = Lanes<lanes>;
      using Value = typename L::Value;
      using Edges = TetrahedronEdges<lanes>;

      Tetrahedron<L> cell;
      PolarDecomposition<L> polar;

      /** @p offset as of TetrahedronEdges::load(). */
      QUOIN_INLINE void load(const std::uint16_t *offset,
                             const ChunkNodes &nodes)
      {
        Edges edges;
        edges.load(offset, nodes);
        set_edges(edges);
      }

      QUOIN_INLINE void set_edges(const Edges &edges)
      {
        cell.set_edges(edges.e);
        cell.gradient(edges.d, polar.H);
        polar.find_tensors();
      }

      /** Finds the trace of the strain and loads the @p next group meanwhile.
       */
      QUOIN_INLINE void find_trace_and_load(TetrahedronGroup &next,
                                            const std::uint16_t *offset_of_next,
                                            const ChunkNodes &nodes)
      {
        Edges edges;
        polar.find_trace([&](const unsigned int part)
                             __attribute__((always_inline)) {
                               if (part == 0)
                                 edges.load(offset_of_next, nodes);
                               else
                                 next.set_edges(edges);
                             });
      }

      /** @p isotropic: lambda tr e, or what is in its place; it, @p mu and
          @p stress are times -1/6. */
      QUOIN_INLINE void add_forces(const std::uint16_t *offset,
                                   const Value &isotropic, const Value &mu,
                                   const double *stress, ChunkNodes &nodes)
      {
        char *sums = reinterpret_cast<char *>(nodes.force);
        Value P[3][3], f[3][3], rest[4]{};
        polar.elastic_stress(isotropic, mu, P);
        if constexpr (with_stress)
        {
          Value S[6], R[3][3], e[6], T[3][3];
          for (int i = 0; i < 6; ++i)
            S[i] = reinterpret_cast<const Value *>(stress)[i];
          polar.rotation_and_strain(R, e);
          polar.turning_stress(S, e, T);
          for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c)
              P[r][c]
                  += R[r][0] * T[0][c] + R[r][1] * T[1][c] + R[r][2] * T[2][c];
        }
        cell.nodal_forces(P, f);
        for (int k = 0; k < 3; ++k)
        {
          const Value column[4] = { f[k][0], f[k][1], f[k][2], Value{} };
          Value row[4];
          L::to_rows(column, row);
          for (int l = 0; l < 4; ++l)
            rest[l] -= row[l];
          L::add_rows(sums, offset + (k + 1) * lanes, row);
        }
        L::add_rows(sums, offset, rest);
      }
    };

    /** Lanes without a bit in @p mask get no stiffness. */
    template <int lanes>
    QUOIN_INLINE void keep_lanes(const unsigned int mask,
                                 LameModuli<Lanes<lanes>> &moduli)
    {
      for (int l = 0; l < lanes; ++l)
        if (!(mask >> l & 1))
          moduli.lambda[l] = moduli.mu[l] = 0.;
    }

    /**
     * Adds the forces of @p n groups to those of the nodes. Lanes without a
     * bit in @p last_mask have no cell of their own in the last group.
     *
     * The next group is loaded while the trace of one group's strain is found,
     * a long chain of dependent operations. No branch may be between the two,
     * or they do not overlap.
     */
    template <int lanes, bool with_stress>
    __attribute__((noinline)) void
    add_tetrahedra(const std::uint16_t *offset, const std::size_t n,
                   const unsigned int last_mask,
                   const SpaceStiffness &stiffness, const double *stress,
                   ChunkNodes &nodes)
    {
      using Value                 = typename Lanes<lanes>::Value;
      constexpr int stress_stride = with_stress ? 6 * lanes : 0;
      LameModuli<Lanes<lanes>> moduli{ Value{} - stiffness.lambda / 6.,
                                       Value{} - stiffness.mu / 6. };
      using Group           = TetrahedronGroup<lanes, with_stress>;
      const auto add_forces = [&](Group & group) __attribute__((always_inline))
      {
        group.add_forces(offset, moduli.lambda * group.polar.a, moduli.mu,
                         stress, nodes);
        offset += 4 * lanes;
        stress += stress_stride;
      };
      Group group[2];
      group[0].load(offset, nodes);
      for (std::size_t g = 0; g + 1 < n; ++g)
      {
        group[g % 2].find_trace_and_load(group[(g + 1) % 2], offset + 4 * lanes,
                                         nodes);
        add_forces(group[g % 2]);
      }
      Group &last = group[(n - 1) % 2];
      last.polar.find_trace();
      keep_lanes<lanes>(last_mask, moduli);
      add_forces(last);
    }

    /** add_tetrahedra() of mixed ones, each eight groups. The cells of a lane
        share K times the mean of their tr e by volume, K = lambda + 2/3 mu. */
    template <int lanes, bool with_stress>
    __attribute__((noinline)) void
    add_mixed_tetrahedra(const std::uint16_t *offset, const std::size_t n,
                         const unsigned int last_mask,
                         const SpaceStiffness &stiffness, const double *stress,
                         ChunkNodes &nodes)
    {
      using Value                 = typename Lanes<lanes>::Value;
      constexpr int stress_stride = with_stress ? 6 * lanes : 0;
      LameModuli<Lanes<lanes>> moduli{ Value{} - stiffness.lambda / 6.,
                                       Value{} - stiffness.mu / 6. };
      TetrahedronGroup<lanes, with_stress> group[parts_of_mixed];
      for (std::size_t g = 0; g < n; g += parts_of_mixed)
      {
        if (g + parts_of_mixed == n)
          keep_lanes<lanes>(last_mask, moduli);
        Value volume{}, growth{};
        group[0].load(offset, nodes);
        for (unsigned int k = 0; k < parts_of_mixed; ++k)
        {
          if (k + 1 < parts_of_mixed)
            group[k].find_trace_and_load(group[k + 1],
                                         offset + 4 * lanes * (k + 1), nodes);
          else
            group[k].polar.find_trace();
          volume += group[k].cell.det;
          growth += group[k].cell.det * group[k].polar.a;
        }
        const Value two_thirds = moduli.mu * (2. / 3.);
        const Value mean = (moduli.lambda + two_thirds) * (growth / volume);
        for (unsigned int k = 0; k < parts_of_mixed; ++k)
        {
          group[k].add_forces(offset, mean - two_thirds * group[k].polar.a,
                              moduli.mu, stress, nodes);
          offset += 4 * lanes;
          stress += stress_stride;
        }
      }
    }
  } // namespace
} // namespace quoin

#endif
