// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_blocks_tetrahedron_kernel_h
#define quoin_source_blocks_tetrahedron_kernel_h

#include <quoin/base/lane_functions.h>
#include <quoin/base/node_record.h>
#include <quoin/block_elements/tetrahedron.h>
#include <quoin/mesh/mixed_tetrahedra.h>

#include <cstddef>
#include <cstdint>

/** Forces of the tetrahedra of a chunk, several at once. Loops over cells and
    nodes are unrolled, because GCC keeps arrays in registers only then. */
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

    /** One tetrahedron of each lane. */
    template <int lanes>
    struct TetrahedronCell
    {
      using L     = Lanes<lanes>;
      using Value = typename L::Value;

      Tetrahedron<L> geometry;
      PolarDecomposition<L> polar;

      /** Forces at nodes 1, 2, 3 of the cell. @p isotropic: lambda tr e, or
          what is in its place; it, @p mu and @p stress, if there is one, are
          times -1/6. */
      QUOIN_INLINE void find_forces(const Value &isotropic, const Value &mu,
                                    const double *stress,
                                    Value (&f)[3][3]) const
      {
        Value P[3][3];
        polar.elastic_stress(isotropic, mu, P);
        if (stress)
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
        geometry.nodal_forces(P, f);
      }

      /** Minus the strain energy [J] without lambda/2 (tr e)^2: the determinant
          times mu e : e + S : e, with the arguments of find_forces(). */
      QUOIN_INLINE void find_energy(const Value &mu, const double *stress,
                                    Value &energy) const
      {
        Value R[3][3], e[6];
        polar.rotation_and_strain(R, e);
        Value density{};
        for (int i = 0; i < 6; ++i)
        {
          Value s = mu * e[i];
          if (stress)
            s += reinterpret_cast<const Value *>(stress)[i];
          density += (i < 3 ? s : s + s) * e[i];
        }
        energy = geometry.det * density;
      }
    };

    /** Edges from node 0 of @p n_cells cells to their other nodes. */
    template <int lanes, int n_cells>
    struct TetrahedronEdges
    {
      using L     = Lanes<lanes>;
      using Value = typename L::Value;

      static constexpr int n = 2 + n_cells;

      Value e[n][3]; /**< at rest [m] */
      Value d[n][3]; /**< displacements less that of node 0 [m] */

      /** @p offset: of the nodes, each in all lanes, in bytes into the forces,
          half of that into the records. */
      QUOIN_INLINE void load(const std::uint16_t *offset,
                             const ChunkNodes &nodes)
      {
        const char *records = reinterpret_cast<const char *>(nodes.record);
        Value X0[4], u0[4];
        L::load_rows(records, 2, offset, X0);
        L::load_rows(records + 32, 2, offset, u0);
#pragma GCC unroll 4
        for (int k = 0; k < n; ++k)
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

    /**
     * One or two tetrahedra of each lane, two of which share three nodes: the
     * first has nodes 0, 1, 2, 3, the second 0, 2, 1, 4.
     */
    template <int lanes, bool with_stress, int n_cells>
    struct TetrahedronGroup
    {
      using L     = Lanes<lanes>;
      using Value = typename L::Value;
      using Edges = TetrahedronEdges<lanes, n_cells>;

      static constexpr int n_nodes       = 3 + n_cells;
      static constexpr int offset_stride = n_nodes * lanes;
      static constexpr int stress_stride
          = with_stress ? 6 * n_cells * lanes : 0;
      static constexpr int edge_of[2][3] = { { 0, 1, 2 }, { 1, 0, 3 } };

      TetrahedronCell<lanes> cells[n_cells];

      QUOIN_INLINE void load(const std::uint16_t *offset,
                             const ChunkNodes &nodes)
      {
        Edges edges;
        edges.load(offset, nodes);
#pragma GCC unroll 2
        for (int c = 0; c < n_cells; ++c)
          set_edges(c, edges);
      }

      /** Finds the traces of the strains and loads the @p next group
          meanwhile. */
      QUOIN_INLINE void
      find_traces_and_load(TetrahedronGroup &next,
                           const std::uint16_t *offset_of_next,
                           const ChunkNodes &nodes)
      {
        Edges edges;
#pragma GCC unroll 2
        for (int c = 0; c < n_cells; ++c)
          cells[c].polar.find_trace([&](const unsigned int part)
                                        __attribute__((always_inline)) {
                                          if (part == 1)
                                            next.set_edges(c, edges);
                                          else if (c == 0)
                                            edges.load(offset_of_next, nodes);
                                        });
      }

      QUOIN_INLINE void find_traces()
      {
        for (auto &cell : cells)
          cell.polar.find_trace();
      }

      /** @p isotropic, @p mu and @p stress as of
          TetrahedronCell::find_forces(). */
      QUOIN_INLINE void add_forces(const std::uint16_t *offset,
                                   const Value (&isotropic)[n_cells],
                                   const Value &mu, const double *stress,
                                   ChunkNodes &nodes) const
      {
        char *sums = reinterpret_cast<char *>(nodes.force);
        Value f[n_nodes - 1][3], rest[4]{};
#pragma GCC unroll 2
        for (int c = 0; c < n_cells; ++c)
        {
          Value of_cell[3][3];
          cells[c].find_forces(isotropic[c], mu,
                               with_stress ? stress + 6 * lanes * c : nullptr,
                               of_cell);
          for (int k = 0; k < 3; ++k)
            for (int i = 0; i < 3; ++i)
            {
              Value &sum = f[edge_of[c][k]][i];
              sum = c == 0 || k == 2 ? of_cell[k][i] : sum + of_cell[k][i];
            }
        }
#pragma GCC unroll 4
        for (int k = 0; k < n_nodes - 1; ++k)
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

    private:
      QUOIN_INLINE void set_edges(const int c, const Edges &edges)
      {
        Value e[3][3], d[3][3];
        for (int k = 0; k < 3; ++k)
          for (int i = 0; i < 3; ++i)
          {
            e[k][i] = edges.e[edge_of[c][k]][i];
            d[k][i] = edges.d[edge_of[c][k]][i];
          }
        auto &[geometry, polar] = cells[c];
        geometry.set_edges(e);
        geometry.gradient(d, polar.H);
        polar.find_tensors();
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
     * bit in @p last_mask have no cells of their own in the last group.
     *
     * The next group is loaded while the trace of one group's strain is found,
     * a long chain of dependent operations.
     */
    template <int lanes, bool with_stress, int n_cells>
    __attribute__((noinline)) void
    add_tetrahedra(const std::uint16_t *offset, const std::size_t n,
                   const unsigned int last_mask,
                   const SpaceStiffness &stiffness, const double *stress,
                   ChunkNodes &nodes)
    {
      using Value = typename Lanes<lanes>::Value;
      using Group = TetrahedronGroup<lanes, with_stress, n_cells>;
      LameModuli<Lanes<lanes>> moduli{ Value{} - stiffness.lambda / 6.,
                                       Value{} - stiffness.mu / 6. };
      const auto add_forces
          = [&](const Group &group) __attribute__((always_inline))
      {
        Value isotropic[n_cells];
#pragma GCC unroll 2
        for (int c = 0; c < n_cells; ++c)
          isotropic[c] = moduli.lambda * group.cells[c].polar.a;
        group.add_forces(offset, isotropic, moduli.mu, stress, nodes);
        offset += Group::offset_stride;
        stress += Group::stress_stride;
      };
      Group group[2];
      group[0].load(offset, nodes);
      for (std::size_t g = 0; g + 1 < n; ++g)
      {
        group[g % 2].find_traces_and_load(group[(g + 1) % 2],
                                          offset + Group::offset_stride, nodes);
        add_forces(group[g % 2]);
      }
      Group &last = group[(n - 1) % 2];
      last.find_traces();
      keep_lanes<lanes>(last_mask, moduli);
      add_forces(last);
    }

    /** add_tetrahedra() of mixed ones, each four groups of two. The cells of a
        lane share K times the mean of their tr e by volume,
        K = lambda + 2/3 mu. */
    template <int lanes, bool with_stress>
    __attribute__((noinline)) void
    add_mixed_tetrahedra(const std::uint16_t *offset, const std::size_t n,
                         const unsigned int last_mask,
                         const SpaceStiffness &stiffness, const double *stress,
                         ChunkNodes &nodes)
    {
      using Value              = typename Lanes<lanes>::Value;
      using Group              = TetrahedronGroup<lanes, with_stress, 2>;
      constexpr unsigned int m = parts_of_mixed / 2;
      LameModuli<Lanes<lanes>> moduli{ Value{} - stiffness.lambda / 6.,
                                       Value{} - stiffness.mu / 6. };
      Group group[m];
      for (std::size_t g = 0; g < n; g += m)
      {
        if (g + m == n)
          keep_lanes<lanes>(last_mask, moduli);
        group[0].load(offset, nodes);
        for (unsigned int k = 0; k + 1 < m; ++k)
          group[k].find_traces_and_load(
              group[k + 1], offset + Group::offset_stride * (k + 1), nodes);
        group[m - 1].find_traces();
        Value volume{}, growth{};
        for (const Group &pair : group)
          for (const auto &[geometry, polar] : pair.cells)
          {
            volume += geometry.det;
            growth += geometry.det * polar.a;
          }
        const Value two_thirds = moduli.mu * (2. / 3.);
        const Value mean = (moduli.lambda + two_thirds) * (growth / volume);
        for (const Group &pair : group)
        {
          const Value isotropic[2]
              = { mean - two_thirds * pair.cells[0].polar.a,
                  mean - two_thirds * pair.cells[1].polar.a };
          pair.add_forces(offset, isotropic, moduli.mu, stress, nodes);
          offset += Group::offset_stride;
          stress += Group::stress_stride;
        }
      }
    }

    /** Strain energy of the cells of add_tetrahedra() [J]. */
    template <int lanes, bool with_stress, int n_cells>
    __attribute__((noinline)) double
    energy_of_tetrahedra(const std::uint16_t *offset, const std::size_t n,
                         const unsigned int last_mask,
                         const SpaceStiffness &stiffness, const double *stress,
                         const ChunkNodes &nodes)
    {
      using Value = typename Lanes<lanes>::Value;
      using Group = TetrahedronGroup<lanes, with_stress, n_cells>;
      LameModuli<Lanes<lanes>> moduli{ Value{} - stiffness.lambda / 6.,
                                       Value{} - stiffness.mu / 6. };
      Value energy{};
      for (std::size_t g = 0; g < n; ++g)
      {
        if (g + 1 == n)
          keep_lanes<lanes>(last_mask, moduli);
        Group group;
        group.load(offset, nodes);
        group.find_traces();
#pragma GCC unroll 2
        for (int c = 0; c < n_cells; ++c)
        {
          const auto &cell = group.cells[c];
          Value of_cell;
          cell.find_energy(moduli.mu,
                           with_stress ? stress + 6 * lanes * c : nullptr,
                           of_cell);
          energy += of_cell
                    + cell.geometry.det * (0.5 * moduli.lambda)
                          * (cell.polar.a * cell.polar.a);
        }
        offset += Group::offset_stride;
        stress += Group::stress_stride;
      }
      return -LaneFunctions<lanes>::sum(energy);
    }

    /** Strain energy of the cells of add_mixed_tetrahedra() [J]: K/2 times the
        square of the mean of tr e, and of e the deviator alone. */
    template <int lanes, bool with_stress>
    __attribute__((noinline)) double
    energy_of_mixed_tetrahedra(const std::uint16_t *offset, const std::size_t n,
                               const unsigned int last_mask,
                               const SpaceStiffness &stiffness,
                               const double *stress, const ChunkNodes &nodes)
    {
      using Value = typename Lanes<lanes>::Value;
      using Group = TetrahedronGroup<lanes, with_stress, 2>;
      LameModuli<Lanes<lanes>> moduli{ Value{} - stiffness.lambda / 6.,
                                       Value{} - stiffness.mu / 6. };
      Value energy{}, volume{}, growth{};
      for (std::size_t g = 0; g < n; ++g)
      {
        constexpr unsigned int m = parts_of_mixed / 2;
        if (g + m == n)
          keep_lanes<lanes>(last_mask, moduli);
        Group group;
        group.load(offset, nodes);
        group.find_traces();
#pragma GCC unroll 2
        for (int c = 0; c < 2; ++c)
        {
          const auto &cell = group.cells[c];
          Value of_cell;
          cell.find_energy(moduli.mu,
                           with_stress ? stress + 6 * lanes * c : nullptr,
                           of_cell);
          const Value growth_of_cell = cell.geometry.det * cell.polar.a;
          energy += of_cell - moduli.mu * growth_of_cell * cell.polar.a / 3.;
          volume += cell.geometry.det;
          growth += growth_of_cell;
        }
        if (g % m == m - 1)
        {
          energy += (0.5 * moduli.lambda + moduli.mu / 3.) * growth
                    * (growth / volume);
          volume = growth = Value{};
        }
        offset += Group::offset_stride;
        stress += Group::stress_stride;
      }
      return -LaneFunctions<lanes>::sum(energy);
    }
  } // namespace
} // namespace quoin

#endif
