// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_blocks_strip_kernel_h
#define quoin_source_blocks_strip_kernel_h

#include <quoin/base/lane_functions.h>
#include <quoin/base/node_record.h>
#include <quoin/materials/plastic_history.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

/**
 * The block kernel: one triangle strip per lane. Notation and formulas are
 * those of triangle.h, all multiplied by the determinant so that one square
 * root and one division remain: with G = det H, D = |det|, N = D n, and T, B,
 * h_1, h_2 now those of G,
 * @f[ A = 2 det + T, \quad N = \sqrt{A^2 + B^2}, \quad
 *     \mathrm{tr}\, e = \frac{T (4 det + T) + B^2}{D (N + 2 D)} . @f]
 * For an isotropic material R S = K tr(e) R + G (h_1, h_2; h_2, -h_1)/det:
 * the deviatoric part needs no rotation at all.
 */
namespace quoin
{
  namespace
  {
    /** Nodes that enter the lanes at each step; see BlockForces. */
    struct StripSequence
    {
      const std::uint32_t *offsets;
      const std::uint8_t *masks;
      std::size_t n_steps;
    };

    /** Moduli times the thickness (times a time, for rates). */
    struct ScaledModuli
    {
      double bulk;
      double shear;
    };

    /**
     * Fetches groups of four nodes and their forces, evenly spread over the
     * calls of fetch().
     */
    class Prefetcher
    {
    public:
      Prefetcher(const NodeRecord<2> *nodes, const dealii::Tensor<1, 2> *force,
                 const std::uint32_t *begin, const std::uint32_t *end,
                 const std::size_t n_calls)
        : records(reinterpret_cast<const char *>(nodes)),
          forces(reinterpret_cast<const char *>(force)), next(begin), end(end),
          per_call((end - begin + n_calls) / (n_calls + 1))
      {
      }

      QUOIN_INLINE void fetch()
      {
        const std::uint32_t *const stop = std::min(next + per_call, end);
        for (; next < stop; ++next)
        {
          const std::size_t group = *next;
          __builtin_prefetch(records + 128 * group, 1);
          __builtin_prefetch(records + 128 * group + 64, 1);
          __builtin_prefetch(forces + 64 * group, 1);
        }
      }

    private:
      const char *records;
      const char *forces;
      const std::uint32_t *next;
      const std::uint32_t *end;
      std::size_t per_call;
    };

    template <int lanes>
    struct Vector
    {
      typename Lanes<lanes>::Value x, y;
    };

    /** First Piola-Kirchhoff stress times half the thickness and sign(det). */
    template <int lanes>
    struct Piola
    {
      typename Lanes<lanes>::Value xx, xy, yx, yy;
    };

    template <int lanes>
    QUOIN_INLINE void
    add_strip_forces(const Piola<lanes> &P, const Vector<lanes> &e1,
                     const Vector<lanes> &e2, Vector<lanes> &oldest,
                     Vector<lanes> &middle, Vector<lanes> &newest)
    {
      using Value    = typename Lanes<lanes>::Value;
      const Value ox = P.xx * e2.y - P.xy * e2.x;
      const Value oy = P.yx * e2.y - P.yy * e2.x;
      newest.x       = P.xx * e1.y - P.xy * e1.x;
      newest.y       = P.yx * e1.y - P.yy * e1.x;
      oldest.x += ox;
      oldest.y += oy;
      middle.x -= ox + newest.x;
      middle.y -= oy + newest.y;
    }

    /** The four invariants of a gradient times the determinant. */
    template <int lanes>
    struct Gradient
    {
      using Value = typename Lanes<lanes>::Value;

      Value sum, skew, h1, h2;

      /** Gradient by the edges e of the triangle and the field's differences.
       */
      QUOIN_INLINE
      Gradient(const Vector<lanes> &e1, const Vector<lanes> &e2,
               const Vector<lanes> &w1, const Vector<lanes> &w2)
      {
        const Value xx = w1.x * e2.y - w2.x * e1.y;
        const Value xy = w2.x * e1.x - w1.x * e2.x;
        const Value yx = w1.y * e2.y - w2.y * e1.y;
        const Value yy = w2.y * e1.x - w1.y * e2.x;
        sum            = xx + yy;
        skew           = yx - xy;
        h1             = xx - yy;
        h2             = xy + yx;
      }
    };

    /**
     * Intermediate results between the stages of a step. From nodes to forces
     * each triangle is a chain of dependent operations, longer than the reorder
     * window of a processor. So the loop does the last stage of one triangle
     * beside the second of the next one and the first of the one after that.
     */
    template <int lanes>
    struct StripStep
    {
      using Value = typename Lanes<lanes>::Value;

      Vector<lanes> e;                 /**< edge to the newest node */
      Vector<lanes> w;                 /**< displacement along it */
      Value A, B, h1, h2, top, D2, NN; /**< left by the first stage */
      Value N, y, denominator;         /**< left by the second */
    };

    /** Walk along the strips, up to the second stage of a step. */
    template <int lanes>
    struct StripWalk
    {
      using L     = Lanes<lanes>;
      using Value = typename L::Value;

      const char *records;
      Vector<lanes> X{}, u{}; /**< of the newest node */

      explicit StripWalk(const NodeRecord<2> *nodes)
        : records(reinterpret_cast<const char *>(nodes))
      {
      }

      QUOIN_INLINE void enter(const std::uint32_t *at, Vector<lanes> &e,
                              Vector<lanes> &w)
      {
        Vector<lanes> new_X, new_u;
        L::load(records, 2, at, new_X.x, new_X.y);
        L::load(records + 16, 2, at, new_u.x, new_u.y);
        e = { new_X.x - X.x, new_X.y - X.y };
        w = { new_u.x - u.x, new_u.y - u.y };
        X = new_X;
        u = new_u;
      }

      QUOIN_INLINE void first_stage(const std::uint32_t *at,
                                    const StripStep<lanes> &before,
                                    StripStep<lanes> &now)
      {
        enter(at, now.e, now.w);
        const Vector<lanes> &e1 = before.e, &e2 = now.e;
        const Gradient<lanes> G(e1, e2, before.w, now.w);
        take_gradient(G, e1.x * e2.y - e1.y * e2.x, now);
      }

      static QUOIN_INLINE void take_gradient(const Gradient<lanes> &G,
                                             const Value &det,
                                             StripStep<lanes> &now)
      {
        const Value det2 = det + det;
        const Value BB   = G.skew * G.skew;
        L::absolute(det2, now.D2);
        now.A   = det2 + G.sum;
        now.B   = G.skew;
        now.h1  = G.h1;
        now.h2  = G.h2;
        now.NN  = now.A * now.A + BB;
        now.top = G.sum * (now.A + det2) + BB;
      }

      static QUOIN_INLINE void second_stage(const std::uint8_t m,
                                            StripStep<lanes> &now)
      {
        L::square_root(now.NN, now.N);
        now.y = now.NN + now.D2 * now.N;
        // 2 D N (N + 2 D), infinite where there is no triangle of the mesh: its
        // force is then zero.
        now.denominator = now.D2 * now.y;
        L::keep(m, now.denominator);
      }
    };

    template <int lanes, bool with_stress>
    __attribute__((noinline)) void
    elastic_strips(const StripSequence sequence, const ScaledModuli moduli,
                   const double *stress, const NodeRecord<2> *nodes,
                   dealii::Tensor<1, 2> *force, Prefetcher &prefetcher)
    {
      using L     = Lanes<lanes>;
      using Value = typename L::Value;

      const Value bulk  = Value{} + moduli.bulk;
      const Value shear = Value{} + moduli.shear;

      char *const sums = reinterpret_cast<char *>(force);

      const std::uint32_t *offset    = sequence.offsets;
      const std::uint32_t *const end = offset + lanes * sequence.n_steps;
      const std::uint8_t *mask       = sequence.masks + 2;

      StripWalk<lanes> walk(nodes);
      Vector<lanes> f0{}, f1{}, f2;

      const auto last_stage
          = [&](const std::uint32_t *at, const StripStep<lanes> &before,
                const StripStep<lanes> &now, Vector<lanes> &oldest,
                Vector<lanes> &middle, Vector<lanes> &newest)
              __attribute__((always_inline))
      {
        const Value r = 1. / now.denominator;
        const Value q = bulk * now.top * r;
        const Value g = shear * now.y * r;
        Value a       = q * now.A;
        Value b       = q * now.B;
        Piola<lanes> P;
        if constexpr (with_stress)
        {
          const Value *s   = reinterpret_cast<const Value *>(stress);
          const Value mean = s[0], d1 = s[1], d2 = s[2];
          stress += 3 * lanes;
          // R S_0 + tau / n J R, see piola_stress() in triangle.h.
          const Value inverse_N = r * now.D2 * (now.N + now.D2);
          const Value turn      = (now.A * (d1 * now.h2 - d2 * now.h1)
                              - now.B * (d1 * now.h1 + d2 * now.h2))
                             * (inverse_N * inverse_N * inverse_N);
          const Value p = mean * inverse_N;
          a += p * now.A - turn * now.B;
          b += p * now.B + turn * now.A;
          const Value k1 = inverse_N * (now.A * d1 - now.B * d2);
          const Value k2 = inverse_N * (now.B * d1 + now.A * d2);
          P              = { g * now.h1 + (a + k1), g * now.h2 - (b - k2),
                             g * now.h2 + (b + k2), (a - k1) - g * now.h1 };
        }
        else
          P = { g * now.h1 + a, g * now.h2 - b, g * now.h2 + b,
                a - g * now.h1 };
        add_strip_forces(P, before.e, now.e, oldest, middle, newest);
        L::add(sums, at - 2 * lanes, oldest.x, oldest.y);
      };

      if constexpr (with_stress)
        stress += 2 * 3 * lanes;
      StripStep<lanes> s0, s1, s2;
      walk.enter(offset, s0.e, s0.w);
      walk.enter(offset + lanes, s0.e, s0.w);
      offset += 2 * lanes;
      walk.first_stage(offset, s0, s1);
      walk.second_stage(mask[0], s1);
      walk.first_stage(offset + lanes, s1, s2);
      // Two more steps begin than end; their results are not used.
      for (; offset < end; offset += 3 * lanes, mask += 3)
      {
        prefetcher.fetch();
        last_stage(offset, s0, s1, f0, f1, f2);
        walk.second_stage(mask[1], s2);
        walk.first_stage(offset + 2 * lanes, s2, s0);

        last_stage(offset + lanes, s1, s2, f1, f2, f0);
        walk.second_stage(mask[2], s0);
        walk.first_stage(offset + 3 * lanes, s0, s1);

        last_stage(offset + 2 * lanes, s2, s0, f2, f0, f1);
        walk.second_stage(mask[3], s1);
        walk.first_stage(offset + 4 * lanes, s1, s2);
      }
      L::add(sums, end - 2 * lanes, f0.x, f0.y);
      L::add(sums, end - lanes, f1.x, f1.y);
    }

    /** Strain energy of the triangles of elastic_strips() [J]. With the trace
        of the strain and its deviator, of length |h|/D, it is
        D/2 (K tr(e)^2 + G h^2/D^2)/2 and what the initial stress does on the
        strain. */
    template <int lanes, bool with_stress>
    __attribute__((noinline)) double
    energy_of_strips(const StripSequence sequence, const ScaledModuli moduli,
                     const double *stress, const NodeRecord<2> *nodes)
    {
      using Value = typename Lanes<lanes>::Value;

      const std::uint32_t *offset    = sequence.offsets;
      const std::uint32_t *const end = offset + lanes * sequence.n_steps;
      const std::uint8_t *mask       = sequence.masks + 2;
      if constexpr (with_stress)
        stress += 2 * 3 * lanes;

      StripWalk<lanes> walk(nodes);
      StripStep<lanes> before, now;
      walk.enter(offset, before.e, before.w);
      walk.enter(offset + lanes, before.e, before.w);
      Value energy{};
      for (offset += 2 * lanes; offset < end; offset += lanes, ++mask)
      {
        walk.first_stage(offset, before, now);
        walk.second_stage(*mask, now);
        // Zero where there is no triangle of the mesh.
        const Value r     = 1. / now.denominator;
        const Value trace = 2. * now.top * now.N * r;
        energy += (0.125 * moduli.bulk) * now.D2 * trace * trace
                  + (0.5 * moduli.shear) * (now.h1 * now.h1 + now.h2 * now.h2)
                        * (now.y * r);
        if constexpr (with_stress)
        {
          const Value *s   = reinterpret_cast<const Value *>(stress);
          const Value mean = s[0], d1 = s[1], d2 = s[2];
          stress += 3 * lanes;
          const Value inverse_N = r * now.D2 * (now.N + now.D2);
          energy += 0.5 * mean * now.D2 * trace
                    + inverse_N
                          * ((now.A * d1 - now.B * d2) * now.h1
                             + (now.B * d1 + now.A * d2) * now.h2);
        }
        before.e = now.e;
        before.w = now.w;
      }
      return LaneFunctions<lanes>::sum(energy);
    }

    template <int lanes>
    __attribute__((noinline)) void
    viscous_strips(const StripSequence sequence, const ScaledModuli moduli,
                   const NodeRecord<2> *nodes,
                   const dealii::Tensor<1, 2> *velocity,
                   dealii::Tensor<1, 2> *force)
    {
      using L     = Lanes<lanes>;
      using Value = typename L::Value;

      const Value bulk  = Value{} + moduli.bulk;
      const Value shear = Value{} + moduli.shear;

      const char *const records = reinterpret_cast<const char *>(nodes);
      const char *const rates   = reinterpret_cast<const char *>(velocity);
      char *const sums          = reinterpret_cast<char *>(force);

      const std::uint32_t *offset    = sequence.offsets;
      const std::uint32_t *const end = offset + lanes * sequence.n_steps;
      const std::uint8_t *mask       = sequence.masks + 2;

      struct Edge
      {
        Vector<lanes> e, w, dw;
      };
      Vector<lanes> X{}, u{}, v{}; // of the newest node
      Edge edge0, edge1, edge2;
      Vector<lanes> f0{}, f1{}, f2;

      const auto enter = [&](const std::uint32_t *at, Edge &edge)
          __attribute__((always_inline))
      {
        const auto replace
            = [&](Vector<lanes> & old, Vector<lanes> & difference,
                  const char *base, const std::size_t scale)
                __attribute__((always_inline))
        {
          Vector<lanes> value;
          L::load(base, scale, at, value.x, value.y);
          difference = { value.x - old.x, value.y - old.y };
          old        = value;
        };
        replace(X, edge.e, records, 2);
        replace(u, edge.w, records + 16, 2);
        replace(v, edge.dw, rates, 1);
      };

      const auto step
          = [&](const std::uint32_t *at, const std::uint8_t m,
                const Edge &edge1, Edge &edge2, Vector<lanes> &oldest,
                Vector<lanes> &middle, Vector<lanes> &newest)
              __attribute__((always_inline))
      {
        enter(at, edge2);
        const Vector<lanes> &e1 = edge1.e, &e2 = edge2.e;
        const Gradient<lanes> G(e1, e2, edge1.w, edge2.w);
        const Gradient<lanes> rate(e1, e2, edge1.dw, edge2.dw);

        const Value det  = e1.x * e2.y - e1.y * e2.x;
        const Value det2 = det + det;
        const Value A    = det2 + G.sum;
        const Value NN   = A * A + G.skew * G.skew;
        // The root itself cancels: (tr de/dt) R = (A T' + B B') / N^2 (A, B).
        Value denominator;
        L::absolute(det2, denominator);
        denominator *= NN;
        L::keep(m, denominator);
        const Value r = 1. / denominator;
        const Value q = bulk * (A * rate.sum + G.skew * rate.skew) * r;
        const Value g = shear * NN * r;
        const Value a = q * A;
        const Value b = q * G.skew;
        const Piola<lanes> P{ g * rate.h1 + a, g * rate.h2 - b, g * rate.h2 + b,
                              a - g * rate.h1 };
        add_strip_forces(P, e1, e2, oldest, middle, newest);
        L::add(sums, at - 2 * lanes, oldest.x, oldest.y);
      };

      enter(offset, edge0);
      enter(offset + lanes, edge0);
      for (offset += 2 * lanes; offset < end; offset += 3 * lanes, mask += 3)
      {
        step(offset, mask[0], edge0, edge1, f0, f1, f2);
        step(offset + lanes, mask[1], edge1, edge2, f1, f2, f0);
        step(offset + 2 * lanes, mask[2], edge2, edge0, f2, f0, f1);
      }
      L::add(sums, end - 2 * lanes, f0.x, f0.y);
      L::add(sums, end - lanes, f1.x, f1.y);
    }
  } // namespace
} // namespace quoin

#endif
