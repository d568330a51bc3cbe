// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_blocks_plastic_strip_kernel_h
#define quoin_source_blocks_plastic_strip_kernel_h

#include <quoin/materials/mohr_coulomb.h>

#include <array>

#include "strip_kernel.h"

namespace quoin
{
  namespace
  {
    /**
     * The strips of cells that yield. A step computes the elastic part of the
     * deformation, F (I + Q) = I + H (I + Q) + Q, of one triangle per lane:
     * that of edges b on which (I + Q) has acted, see first_stage(). It
     * compares the trial stress as MohrCoulomb::update() does: in Cauchy's
     * stresses the Mohr circle's radius, squared, with the least of
     * @f[ \frac{q - (N - 1) m}{N + 1}, \quad \frac{q + \sigma_{zz}}{N} - m,
     *     \quad q + m - N \sigma_{zz}, \quad \sigma_t - m , @f]
     * m the mean stress in the plane, N = N_phi, q the unconfined compressive
     * strength; both sides times the volume of F_e by that at the start, so
     * that nothing is divided. The law gets the triangles that exceed it.
     *
     * In @p intact strips no cell has yielded before: Q is zero and is neither
     * loaded nor computed with.
     */
    template <int lanes, bool intact>
    class PlasticStrips
    {
    public:
      /**
       * @p cells: cell of each lane at each step; @p initial: initial stress of
       * all cells, or null.
       */
      PlasticStrips(const MohrCoulomb &law, const PlaneStiffness &stiffness,
                    const double thickness, const std::uint32_t *cells,
                    const std::array<double, 4> *initial,
                    PlasticHistory &history)
        : law(law), cells(cells), initial(initial), history(history),
          thickness(thickness), bulk(stiffness.bulk()), shear(stiffness.c33),
          out_of_plane(law.plane_assumption() == PlaneAssumption::plane_strain),
          c11(out_of_plane * stiffness.c11), c12(out_of_plane * stiffness.c12),
          thinning(out_of_plane
                       ? 0.
                       : -stiffness.c12 / (stiffness.c11 - stiffness.c12))
      {
        const double n = law.friction_number();
        strength       = law.compressive_strength();
        tension        = law.tensile_strength();
        number         = n;
        inverse        = 1. / n;
        slope          = (n - 1.) / (n + 1.);
        cohesion       = strength / (n + 1.);
      }

      /** Returns the dissipated energy [J]. */
      double add_forces(const StripSequence &sequence,
                        const NodeRecord<2> *nodes, dealii::Tensor<1, 2> *force,
                        Prefetcher &prefetcher) const;

    private:
      using L     = Lanes<lanes>;
      using Value = typename L::Value;

      /** Stress in the rotating frame: mean, half the difference, shear, zz. */
      struct Stress
      {
        Value mean, half, shear, zz;
      };

      /** Trace of a strain, half its difference, and its shear. */
      struct Strain
      {
        Value trace, half, shear;
      };

      struct Step : StripStep<lanes>
      {
        Vector<lanes> b1, b2; /**< edges on which (I + Q) has acted */
        Value q_zz, q_area;   /**< of Q, and the determinant of (I + Q) */
      };

      QUOIN_INLINE void take_edges(const std::uint32_t *at, const Step &before,
                                   Step &now) const;
      QUOIN_INLINE Stress trial_stress(const std::uint32_t *at, const Strain &e,
                                       const Value &q_zz) const;
      QUOIN_INLINE std::uint8_t exceeding(const Stress &s, const Strain &e,
                                          const Value &turn,
                                          const Step &now) const;
      QUOIN_INLINE void keep_stress(const std::uint32_t *at, std::uint8_t mask,
                                    const Stress &s) const;
      __attribute__((noinline)) double yield(const std::uint32_t *at,
                                             std::uint8_t mask,
                                             const Value &volume,
                                             const Strain &e, Stress &s) const;

      const MohrCoulomb &law;
      const std::uint32_t *cells;
      const std::array<double, 4> *initial;
      PlasticHistory &history;
      double thickness, bulk, shear;
      bool out_of_plane;
      double c11, c12, thinning;
      double strength, tension, number, inverse, slope, cohesion;
    };

    template <int lanes, bool intact>
    void PlasticStrips<lanes, intact>::take_edges(const std::uint32_t *at,
                                                  const Step &before,
                                                  Step &now) const
    {
      const Vector<lanes> &e1 = before.e, &e2 = now.e;
      const Value det = e1.x * e2.y - e1.y * e2.x;
      if constexpr (intact)
      {
        now.b1 = e1;
        now.b2 = e2;
        StripWalk<lanes>::take_gradient({ e1, e2, before.w, now.w }, det, now);
        return;
      }
      Value q[4];
      L::load_four(
          [&](const int l) { return history.cells[at[l]].inverse_stretch; }, q);
      // On an edge turned by a right angle, as nodal gradients are.
      const auto stretch = [&](const Vector<lanes> &e, Vector<lanes> &b)
          __attribute__((always_inline))
      {
        b = { e.x + (q[1] * e.x - q[2] * e.y),
              e.y + (q[0] * e.y - q[2] * e.x) };
      };
      stretch(e1, now.b1);
      stretch(e2, now.b2);
      Gradient<lanes> G(now.b1, now.b2, before.w, now.w);
      G.sum += det * (q[0] + q[1]);
      G.h1 += det * (q[0] - q[1]);
      G.h2 += 2. * det * q[2];
      StripWalk<lanes>::take_gradient(G, det, now);
      now.q_zz   = q[3];
      now.q_area = (1. + q[0]) * (1. + q[1]) - q[2] * q[2];
    }

    template <int lanes, bool intact>
    auto PlasticStrips<lanes, intact>::trial_stress(const std::uint32_t *at,
                                                    const Strain &e,
                                                    const Value &q_zz) const
        -> Stress
    {
      Stress s;
      s.mean  = bulk * e.trace;
      s.half  = 2. * shear * e.half;
      s.shear = 2. * shear * e.shear;
      s.zz    = c12 * e.trace;
      if constexpr (!intact)
      {
        s.mean += c12 * q_zz;
        s.zz += c11 * q_zz;
      }
      if (initial)
      {
        // The initial stress of a cell which has yielded is part of its elastic
        // stretch.
        alignas(32) static constexpr double none[4]{};
        Value s0[4];
        L::load_four(
            [&](const int l)
            {
              return !intact && history.yielding[at[l]] != 0
                         ? none
                         : initial[at[l]].data();
            },
            s0);
        s.mean += 0.5 * (s0[0] + s0[1]);
        s.half += 0.5 * (s0[0] - s0[1]);
        s.shear += s0[2];
        s.zz += s0[3];
      }
      return s;
    }

    template <int lanes, bool intact>
    std::uint8_t PlasticStrips<lanes, intact>::exceeding(const Stress &s,
                                                         const Strain &e,
                                                         const Value &turn,
                                                         const Step &now) const
    {
      // Kirchhoff's stress (S + turn J) U times b is to be compared with the
      // limits times a; a / b is the volume by that at the start.
      const Value u = 1. + 0.5 * e.trace;
      Value a       = u * u - e.half * e.half - e.shear * e.shear;
      if (!out_of_plane)
        a *= 1. + thinning * e.trace;
      Value mean = s.mean * u + s.half * e.half + s.shear * e.shear;
      Value half = s.mean * e.half - turn * e.shear + s.half * u;
      Value tau  = s.mean * e.shear + turn * e.half + s.shear * u;
      Value zz   = s.zz;
      if constexpr (!intact)
      {
        Value b = now.q_area;
        if (!out_of_plane)
          b *= 1. + now.q_zz;
        mean *= b;
        half *= b;
        tau *= b;
        zz *= b * (1. + now.q_zz);
      }

      const Value q = strength * a;
      Value limit   = cohesion * a - slope * mean;
      L::minimum((q + zz) * inverse - mean, limit);
      L::minimum(q + mean - number * zz, limit);
      L::minimum(tension * a - mean, limit);
      Value size;
      L::absolute(limit, size);
      return L::greater(half * half + tau * tau, limit * size)
             | L::greater(zz, tension * a);
    }

    template <int lanes, bool intact>
    void PlasticStrips<lanes, intact>::keep_stress(const std::uint32_t *at,
                                                   const std::uint8_t mask,
                                                   const Stress &s) const
    {
      alignas(32) double unused[4];
      L::store_four(
          [&](const int l)
          { return mask >> l & 1 ? history.cells[at[l]].stress : unused; },
          { s.mean + s.half, s.mean - s.half, s.shear, s.zz });
    }

    template <int lanes, bool intact>
    double PlasticStrips<lanes, intact>::yield(const std::uint32_t *at,
                                               const std::uint8_t mask,
                                               const Value &volume,
                                               const Strain &e, Stress &s) const
    {
      double dissipated = 0.;
      for (int l = 0; l < lanes; ++l)
      {
        if (!(mask >> l & 1))
          continue;
        PlasticPoint point = plastic_point(history, at[l]);
        const PlasticStep step
            = law.update(point,
                         { 0.5 * e.trace[l] + e.half[l],
                           0.5 * e.trace[l] - e.half[l], e.shear[l] },
                         initial ? initial[at[l]] : std::array<double, 4>{});
        set_plastic_point(point, at[l], history);
        dissipated += volume[l] * step.dissipated;
        s.mean[l]  = 0.5 * (step.stress[0] + step.stress[1]);
        s.half[l]  = 0.5 * (step.stress[0] - step.stress[1]);
        s.shear[l] = step.stress[2];
      }
      return dissipated;
    }

    template <int lanes, bool intact>
    double PlasticStrips<lanes, intact>::add_forces(
        const StripSequence &sequence, const NodeRecord<2> *nodes,
        dealii::Tensor<1, 2> *force, Prefetcher &prefetcher) const
    {
      char *const sums = reinterpret_cast<char *>(force);

      const std::uint32_t *offset    = sequence.offsets;
      const std::uint32_t *const end = offset + lanes * sequence.n_steps;
      const std::uint8_t *mask       = sequence.masks + 2;
      const std::uint32_t *cell      = cells + 2 * lanes;

      StripWalk<lanes> walk(nodes);
      Vector<lanes> f0{}, f1{}, f2;
      double dissipated = 0.;

      const auto first_stage = [&](const int ahead, const Step &before,
                                   Step &now) __attribute__((always_inline))
      {
        for (int l = 0; l < lanes; ++l)
          __builtin_prefetch(&history.cells[cell[(ahead + 2) * lanes + l]], 1);
        walk.enter(offset + ahead * lanes, now.e, now.w);
        take_edges(cell + ahead * lanes, before, now);
      };

      const auto last_stage
          = [&](const int ahead, const Step &now, Vector<lanes> &oldest,
                Vector<lanes> &middle, Vector<lanes> &newest)
              __attribute__((always_inline))
      {
        const std::uint32_t *const of = cell + ahead * lanes;
        // CorotatedStrain; R times the sign of the determinant is (c, s).
        const Value r         = 1. / now.denominator;
        const Value inverse_D = 2. * r * now.y;
        const Value inverse_N = r * now.D2 * (now.N + now.D2);
        const Value c         = now.A * inverse_N;
        const Value s         = now.B * inverse_N;
        const Strain e{ 2. * now.top * (now.N * r),
                        0.5 * inverse_D * (c * now.h1 + s * now.h2),
                        0.5 * inverse_D * (c * now.h2 - s * now.h1) };

        // piola_stress()
        const auto turn_of = [&](const Stress &t) __attribute__((always_inline))
        {
          return now.D2 * inverse_N * (t.half * e.shear - t.shear * e.half);
        };
        Stress t                  = trial_stress(of, e, now.q_zz);
        Value turn                = turn_of(t);
        const std::uint8_t beyond = exceeding(t, e, turn, now) & mask[ahead];
        keep_stress(of, mask[ahead] & ~beyond, t);
        if (__builtin_expect(beyond != 0, 0))
        {
          dissipated += yield(of, beyond, 0.25 * thickness * now.D2, e, t);
          turn = turn_of(t);
        }
        const Value a  = t.mean * c - turn * s;
        const Value b  = t.mean * s + turn * c;
        const Value k1 = t.half * c - t.shear * s;
        const Value k2 = t.half * s + t.shear * c;
        const Value w  = Value{} + 0.5 * thickness;
        const Piola<lanes> P{ w * (a + k1), w * (k2 - b), w * (b + k2),
                              w * (a - k1) };
        add_strip_forces(P, now.b1, now.b2, oldest, middle, newest);
        L::add(sums, offset + (ahead - 2) * lanes, oldest.x, oldest.y);
      };

      // As elastic_strips().
      Step s0, s1, s2;
      walk.enter(offset, s0.e, s0.w);
      walk.enter(offset + lanes, s0.e, s0.w);
      offset += 2 * lanes;
      first_stage(0, s0, s1);
      walk.second_stage(mask[0], s1);
      first_stage(1, s1, s2);
      for (; offset < end; offset += 3 * lanes, mask += 3, cell += 3 * lanes)
      {
        prefetcher.fetch();
        last_stage(0, s1, f0, f1, f2);
        walk.second_stage(mask[1], s2);
        first_stage(2, s2, s0);

        last_stage(1, s2, f1, f2, f0);
        walk.second_stage(mask[2], s0);
        first_stage(3, s0, s1);

        last_stage(2, s0, f2, f0, f1);
        walk.second_stage(mask[3], s1);
        first_stage(4, s1, s2);
      }
      L::add(sums, end - 2 * lanes, f0.x, f0.y);
      L::add(sums, end - lanes, f1.x, f1.y);
      return dissipated;
    }
  } // namespace
} // namespace quoin

#endif
