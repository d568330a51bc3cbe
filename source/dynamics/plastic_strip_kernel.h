// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_dynamics_plastic_strip_kernel_h
#define quoin_source_dynamics_plastic_strip_kernel_h

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
     * m the mean stress in the plane, N = N_phi, q the strength of a free cube
     * in compression. The law gets the triangles that exceed it.
     */
    template <int lanes>
    class PlasticStrips
    {
    public:
      /**
       * @p cells: of each lane at each step; @p initial: stress of all cells,
       * or null.
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

      /** Returns what was dissipated [J]. */
      double add_forces(const StripSequence &sequence, const NodeRecord *nodes,
                        NodeVector *force, Prefetcher &prefetcher) const;

    private:
      using L     = Lanes<lanes>;
      using Value = typename L::Value;

      /** In the rotating frame: mean, half the difference, shear, zz. */
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
                                            const NodeRecord *nodes,
                                            NodeVector *force,
                                            Prefetcher &prefetcher) const
    {
      const char *const records = reinterpret_cast<const char *>(nodes);
      char *const sums          = reinterpret_cast<char *>(force);

      const std::uint32_t *offset    = sequence.offsets;
      const std::uint32_t *const end = offset + lanes * sequence.n_steps;
      const std::uint8_t *mask       = sequence.masks + 2;
      const std::uint32_t *cell      = cells + 2 * lanes;

      struct Edge
      {
        Vector<lanes> e, w;
      };
      Vector<lanes> X{}, u{}; // of the newest node
      Edge edge0, edge1, edge2;
      Vector<lanes> f0{}, f1{}, f2;
      double dissipated = 0.;

      const auto enter = [&](const std::uint32_t *at, Edge &edge)
          __attribute__((always_inline))
      {
        Vector<lanes> new_X, new_u;
        L::load(records, 2, at, new_X.x, new_X.y);
        L::load(records + 16, 2, at, new_u.x, new_u.y);
        edge.e = { new_X.x - X.x, new_X.y - X.y };
        edge.w = { new_u.x - u.x, new_u.y - u.y };
        X      = new_X;
        u      = new_u;
      };

      const auto step
          = [&](const std::uint32_t *at, const std::uint8_t m,
                const std::uint32_t *of, const Edge &edge1, Edge &edge2,
                Vector<lanes> &oldest, Vector<lanes> &middle,
                Vector<lanes> &newest) __attribute__((always_inline))
      {
        enter(at, edge2);
        const Vector<lanes> &e1 = edge1.e, &e2 = edge2.e;
        const Gradient<lanes> G(e1, e2, edge1.w, edge2.w);

        // What is no triangle of the mesh gets a determinant without limit:
        // no strain, and no weight.
        const Value det = e1.x * e2.y - e1.y * e2.x;
        Value divisor   = det;
        L::keep(m, divisor);
        const Value r    = 1. / divisor;
        const Value sum  = G.sum * r;
        const Value skew = G.skew * r;
        const Value h1   = G.h1 * r;
        const Value h2   = G.h2 * r;

        // CorotatedStrain
        const Value A = 2. + sum;
        Value n;
        L::square_root(A * A + skew * skew, n);
        const Value both       = 1. / (n * (n + 2.));
        const Value inverse_n  = both * (n + 2.);
        const Value c          = A * inverse_n;
        const Value sn         = skew * inverse_n;
        const Value trace      = (sum * (2. + A) + skew * skew) * (both * n);
        const Value difference = c * h1 + sn * h2;
        const Value e12        = 0.5 * (c * h2 - sn * h1);

        Stress s = trial_stress(of, trace, difference, e12);
        Value area;
        L::absolute(det, area);
        const std::uint8_t beyond = exceeding(s) & m;
        if (__builtin_expect(beyond != 0, 0))
          dissipated += yield(of, beyond, 0.5 * thickness * area, s);
        keep_stress(of, m, s);

        // piola_stress(), with half the thickness and the sign of det.
        Value sign;
        L::absolute(r, sign);
        const Value w = 0.5 * thickness * det * sign;
        const Value turn
            = (2. * s.half * e12 - s.shear * difference) * inverse_n;
        const Value mean_c = s.mean * c - turn * sn;
        const Value mean_s = s.mean * sn + turn * c;
        const Value k1     = s.half * c - s.shear * sn;
        const Value k2     = s.half * sn + s.shear * c;
        const Piola<lanes> P{ w * (mean_c + k1), w * (k2 - mean_s),
                              w * (mean_s + k2), w * (mean_c - k1) };
        add_strip_forces(P, e1, e2, oldest, middle, newest);
        L::add(sums, at - 2 * lanes, oldest.x, oldest.y);
      };

      enter(offset, edge0);
      enter(offset + lanes, edge0);
      for (offset += 2 * lanes; offset < end;
           offset += 3 * lanes, mask += 3, cell += 3 * lanes)
      {
        prefetcher.fetch();
        step(offset, mask[0], cell, edge0, edge1, f0, f1, f2);
        step(offset + lanes, mask[1], cell + lanes, edge1, edge2, f1, f2, f0);
        step(offset + 2 * lanes, mask[2], cell + 2 * lanes, edge2, edge0, f2,
             f0, f1);
      }
      L::add(sums, end - 2 * lanes, f0.x, f0.y);
      L::add(sums, end - lanes, f1.x, f1.y);
      return dissipated;
    }
  } // namespace
} // namespace quoin

#endif
