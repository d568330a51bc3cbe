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
     * The strips of cells that yield. A step computes the trial stress of one
     * triangle per lane as MohrCoulomb::trial_stress() does and compares the
     * Mohr circle's radius R, squared, with the least of
     * @f[ \frac{q - (N - 1) m}{N + 1}, \quad \frac{q + \sigma_{zz}}{N} - m,
     *     \quad q + m - N \sigma_{zz}, \quad \sigma_t - m , @f]
     * m the mean stress in the plane, N = N_phi, q the unconfined compressive
     * strength. The law gets the triangles that exceed it.
     */
    template <int lanes>
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
          c11(out_of_plane * stiffness.c11), c12(out_of_plane * stiffness.c12)
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
                        const NodeRecord<2> *nodes, NodeVector<2> *force,
                        Prefetcher &prefetcher) const;

    private:
      using L     = Lanes<lanes>;
      using Value = typename L::Value;

      /** Stress in the rotating frame: mean, half the difference, shear, zz. */
      struct Stress
      {
        Value mean, half, shear, zz;
      };

      QUOIN_INLINE Stress trial_stress(const std::uint32_t *at,
                                       const Value &trace,
                                       const Value &difference,
                                       const Value &e12) const;
      QUOIN_INLINE std::uint8_t exceeding(const Stress &s) const;
      QUOIN_INLINE void keep_stress(const std::uint32_t *at, std::uint8_t mask,
                                    const Stress &s) const;
      __attribute__((noinline)) double yield(const std::uint32_t *at,
                                             std::uint8_t mask,
                                             const Value &volume,
                                             Stress &s) const;

      const MohrCoulomb &law;
      const std::uint32_t *cells;
      const std::array<double, 4> *initial;
      PlasticHistory &history;
      double thickness, bulk, shear;
      bool out_of_plane;
      double c11, c12;
      double strength, tension, number, inverse, slope, cohesion;
    };

    template <int lanes>
    auto PlasticStrips<lanes>::trial_stress(const std::uint32_t *at,
                                            const Value &trace,
                                            const Value &difference,
                                            const Value &e12) const -> Stress
    {
      Value p[4];
      L::load_four([&](const int l) { return history.cells[at[l]].strain; }, p);
      const Value area = trace - (p[0] + p[1]);
      Stress s;
      s.mean  = bulk * area - c12 * p[3];
      s.half  = shear * (difference - (p[0] - p[1]));
      s.shear = 2. * shear * (e12 - p[2]);
      s.zz    = c12 * area - c11 * p[3];
      if (initial)
      {
        Value s0[4];
        L::load_four([&](const int l) { return initial[at[l]].data(); }, s0);
        s.mean += 0.5 * (s0[0] + s0[1]);
        s.half += 0.5 * (s0[0] - s0[1]);
        s.shear += s0[2];
        s.zz += s0[3];
      }
      return s;
    }

    template <int lanes>
    std::uint8_t PlasticStrips<lanes>::exceeding(const Stress &s) const
    {
      Value limit = cohesion - slope * s.mean;
      L::minimum((strength + s.zz) * inverse - s.mean, limit);
      L::minimum(strength + s.mean - number * s.zz, limit);
      L::minimum(tension - s.mean, limit);
      Value size;
      L::absolute(limit, size);
      return L::greater(s.half * s.half + s.shear * s.shear, limit * size)
             | L::greater(s.zz, Value{} + tension);
    }

    template <int lanes>
    void PlasticStrips<lanes>::keep_stress(const std::uint32_t *at,
                                           const std::uint8_t mask,
                                           const Stress &s) const
    {
      alignas(32) double unused[4];
      L::store_four(
          [&](const int l)
          { return mask >> l & 1 ? history.cells[at[l]].stress : unused; },
          { s.mean + s.half, s.mean - s.half, s.shear, s.zz });
    }

    template <int lanes>
    double PlasticStrips<lanes>::yield(const std::uint32_t *at,
                                       const std::uint8_t mask,
                                       const Value &volume, Stress &s) const
    {
      double dissipated = 0.;
      for (int l = 0; l < lanes; ++l)
      {
        const std::array<double, 4> trial{ s.mean[l] + s.half[l],
                                           s.mean[l] - s.half[l], s.shear[l],
                                           s.zz[l] };
        if (!(mask >> l & 1) || law.is_elastic(trial))
          continue;
        PlasticPoint point = plastic_point(history, at[l]);
        dissipated += volume[l] * law.update_yielding(point, trial);
        set_plastic_point(point, at[l], history);
        s.mean[l]  = 0.5 * (point.stress[0] + point.stress[1]);
        s.half[l]  = 0.5 * (point.stress[0] - point.stress[1]);
        s.shear[l] = point.stress[2];
        s.zz[l]    = point.stress[3];
      }
      return dissipated;
    }

    template <int lanes>
    double PlasticStrips<lanes>::add_forces(const StripSequence &sequence,
                                            const NodeRecord<2> *nodes,
                                            NodeVector<2> *force,
                                            Prefetcher &prefetcher) const
    {
      char *const sums = reinterpret_cast<char *>(force);

      const std::uint32_t *offset    = sequence.offsets;
      const std::uint32_t *const end = offset + lanes * sequence.n_steps;
      const std::uint8_t *mask       = sequence.masks + 2;
      const std::uint32_t *cell      = cells + 2 * lanes;

      StripWalk<lanes> walk(nodes);
      Vector<lanes> f0{}, f1{}, f2;
      double dissipated = 0.;

      const auto first_stage
          = [&](const int ahead, const StripStep<lanes> &before,
                StripStep<lanes> &now) __attribute__((always_inline))
      {
        for (int l = 0; l < lanes; ++l)
          __builtin_prefetch(&history.cells[cell[ahead * lanes + l]], 1);
        walk.first_stage(offset + ahead * lanes, before, now);
      };

      const auto last_stage
          = [&](const int ahead, const StripStep<lanes> &before,
                const StripStep<lanes> &now, Vector<lanes> &oldest,
                Vector<lanes> &middle, Vector<lanes> &newest)
              __attribute__((always_inline))
      {
        const std::uint32_t *const of = cell + ahead * lanes;
        // CorotatedStrain; R times the sign of the determinant is (c, s).
        const Value r          = 1. / now.denominator;
        const Value inverse_D  = 2. * r * now.y;
        const Value inverse_N  = r * now.D2 * (now.N + now.D2);
        const Value c          = now.A * inverse_N;
        const Value s          = now.B * inverse_N;
        const Value trace      = 2. * now.top * (now.N * r);
        const Value difference = inverse_D * (c * now.h1 + s * now.h2);
        const Value e12        = 0.5 * inverse_D * (c * now.h2 - s * now.h1);

        Stress t                  = trial_stress(of, trace, difference, e12);
        const std::uint8_t beyond = exceeding(t) & mask[ahead];
        if (__builtin_expect(beyond != 0, 0))
          dissipated += yield(of, beyond, 0.25 * thickness * now.D2, t);
        keep_stress(of, mask[ahead], t);

        // piola_stress()
        const Value turn = 0.5 * now.D2 * inverse_N
                           * (2. * t.half * e12 - t.shear * difference);
        const Value a  = t.mean * c - turn * s;
        const Value b  = t.mean * s + turn * c;
        const Value k1 = t.half * c - t.shear * s;
        const Value k2 = t.half * s + t.shear * c;
        const Value w  = Value{} + 0.5 * thickness;
        const Piola<lanes> P{ w * (a + k1), w * (k2 - b), w * (b + k2),
                              w * (a - k1) };
        add_strip_forces(P, before.e, now.e, oldest, middle, newest);
        L::add(sums, offset + (ahead - 2) * lanes, oldest.x, oldest.y);
      };

      // As elastic_strips().
      StripStep<lanes> s0, s1, s2;
      walk.enter(offset, s0.e, s0.w);
      walk.enter(offset + lanes, s0.e, s0.w);
      offset += 2 * lanes;
      first_stage(0, s0, s1);
      walk.second_stage(mask[0], s1);
      first_stage(1, s1, s2);
      for (; offset < end; offset += 3 * lanes, mask += 3, cell += 3 * lanes)
      {
        prefetcher.fetch();
        last_stage(0, s0, s1, f0, f1, f2);
        walk.second_stage(mask[1], s2);
        first_stage(2, s2, s0);

        last_stage(1, s1, s2, f1, f2, f0);
        walk.second_stage(mask[2], s0);
        first_stage(3, s0, s1);

        last_stage(2, s2, s0, f2, f0, f1);
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
