// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_space_face_lanes_h
#define quoin_source_joint_elements_space_face_lanes_h

#include <quoin/base/lane_functions.h>
#include <quoin/joint_elements/face_groups.h>

// The geometry of space_face.h for several faces at once, one in each lane.

namespace quoin
{
  template <int lanes>
  struct SpaceFaceLanes
  {
    static constexpr unsigned int dim = 3;
    using F                           = LaneFunctions<lanes>;
    using L                           = Lanes<lanes>;
    using Value                       = typename F::Value;
    using Bits                        = typename F::Bits;
    using Group                       = FaceGroup<dim, lanes>;

    Value n[3], s[3], t[3];              /**< see FaceFrame */
    Value inverse_length, inverse_above; /**< of E1, of E2 across it [1/m] */
    Value along;                         /**< of E2 [m] */
    Value opening[3], slip[2][3];        /**< of the points; along s, t [m] */

    /** Lanes that are not @p present have frames and gaps of zero. */
    QUOIN_INLINE SpaceFaceLanes(const Group &group, const NodeRecord<3> *nodes,
                                const Bits &present)
    {
      Value X[6][3], u[6][3];
      load(group, nodes, X, u);
      Value e[2][3];
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int d = 0; d < 3; ++d)
          e[i][d] = 0.5
                    * ((X[i + 1][d] - X[0][d]) + (u[i + 1][d] - u[0][d])
                       + (X[i + 4][d] - X[3][d]) + (u[i + 4][d] - u[3][d]));
      set_frame(e[0], e[1], present);
      for (unsigned int k = 0; k < 3; ++k)
      {
        Value gap[3];
        for (unsigned int d = 0; d < 3; ++d)
          gap[d] = (X[3 + k][d] - X[k][d]) + (u[3 + k][d] - u[k][d]);
        opening[k] = dot(gap, n);
        slip[0][k] = dot(gap, s);
        slip[1][k] = dot(gap, t);
      }
    }

    /** Adds what the resultants @p sigma and @p tau (along s, t) [N] at the
        points do to the nodes, with the couple of the frame. */
    QUOIN_INLINE void add_forces(const Group &group, const Value (&sigma)[3],
                                 const Value (&tau)[2][3],
                                 dealii::Tensor<1, 3> *force) const
    {
      Value about_n{}, about_s{}, about_t{};
      for (unsigned int k = 0; k < 3; ++k)
      {
        about_n += tau[0][k] * slip[1][k] - tau[1][k] * slip[0][k];
        about_s += tau[1][k] * opening[k] - sigma[k] * slip[1][k];
        about_t += sigma[k] * slip[0][k] - tau[0][k] * opening[k];
      }
      // See couple_forces().
      const Value lift  = about_s * inverse_above;
      const Value half  = 0.5 * inverse_length;
      const Value turn  = half * (about_t + lift * along);
      const Value spin  = half * about_n;
      const Value pitch = -0.5 * lift;
      for (unsigned int k = 0; k < 3; ++k)
      {
        Value own[3], couple[3];
        for (unsigned int d = 0; d < 3; ++d)
        {
          own[d]    = sigma[k] * n[d] + tau[0][k] * s[d] + tau[1][k] * t[d];
          couple[d] = k == 0   ? spin * t[d] - (turn + pitch) * n[d]
                      : k == 1 ? turn * n[d] - spin * t[d]
                               : pitch * n[d];
        }
        add(force, group.nodes[k], own[0] + couple[0], own[1] + couple[1],
            own[2] + couple[2]);
        add(force, group.nodes[3 + k], couple[0] - own[0], couple[1] - own[1],
            couple[2] - own[2]);
      }
    }

    /** Rates [m/s] of the openings and slips of the points. */
    QUOIN_INLINE void find_rates(const Group &group,
                                 const dealii::Tensor<1, 3> *velocity,
                                 Value (&opening_rate)[3],
                                 Value (&slip_rate)[2][3]) const
    {
      const char *base = reinterpret_cast<const char *>(velocity);
      Value v[6][3];
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int d = 0; d < 3; ++d)
          v[i][d] = F::each(
              [&](const int l) {
                return reinterpret_cast<const double *>(base
                                                        + group.nodes[i][l])[d];
              });
      // How fast the frame turns; see rotation_rate() of space_joints.cc.
      Value edge[2][3];
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int d = 0; d < 3; ++d)
          edge[i][d]
              = 0.5 * ((v[i + 1][d] - v[0][d]) + (v[i + 4][d] - v[3][d]));
      const Value about_t = -dot(edge[0], n) * inverse_length;
      const Value about_s = (dot(edge[1], n) + about_t * along) * inverse_above;
      const Value about_n = dot(edge[0], t) * inverse_length;
      for (unsigned int k = 0; k < 3; ++k)
      {
        Value rate[3];
        for (unsigned int d = 0; d < 3; ++d)
          rate[d] = v[3 + k][d] - v[k][d];
        opening_rate[k]
            = dot(rate, n) - (about_s * slip[1][k] - about_t * slip[0][k]);
        slip_rate[0][k]
            = dot(rate, s) - (about_t * opening[k] - about_n * slip[1][k]);
        slip_rate[1][k]
            = dot(rate, t) - (about_n * slip[0][k] - about_s * opening[k]);
      }
    }

  private:
    using Pair = double __attribute__((vector_size(16), aligned(8), may_alias));

    static QUOIN_INLINE Value dot(const Value (&a)[3], const Value (&b)[3])
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    static QUOIN_INLINE void cross(const Value (&a)[3], const Value (&b)[3],
                                   Value (&c)[3])
    {
      c[0] = a[1] * b[2] - a[2] * b[1];
      c[1] = a[2] * b[0] - a[0] * b[2];
      c[2] = a[0] * b[1] - a[1] * b[0];
    }

    static QUOIN_INLINE void load(const Group &group,
                                  const NodeRecord<3> *nodes, Value (&X)[6][3],
                                  Value (&u)[6][3])
    {
      static_assert(sizeof(NodeRecord<3>) == 6 * sizeof(double));
      const char *base = reinterpret_cast<const char *>(nodes);
      for (unsigned int i = 0; i < 6; ++i)
      {
        const auto record = [&](const int l)
        {
          return reinterpret_cast<const double *>(
              base + 2 * std::size_t(group.nodes[i][l]));
        };
        Value first[4], last[4]; // X, u_1 and X_3, u
        L::load_four(record, first);
        L::load_four([&](const int l) { return record(l) + 2; }, last);
        for (unsigned int d = 0; d < 3; ++d)
        {
          X[i][d] = first[d];
          u[i][d] = last[d + 1];
        }
      }
    }

    /** See frame_of(). */
    QUOIN_INLINE void set_frame(const Value (&e1)[3], const Value (&e2)[3],
                                const Bits &present)
    {
      const Value none{};
      inverse_length = present ? 1. / F::square_root(dot(e1, e1)) : none;
      cross(e1, e2, n);
      const Value inverse_size
          = present ? 1. / F::square_root(dot(n, n)) : none;
      for (unsigned int d = 0; d < 3; ++d)
      {
        s[d] = e1[d] * inverse_length;
        n[d] *= inverse_size;
      }
      cross(n, s, t);
      along         = dot(e2, s);
      inverse_above = present ? 1. / dot(e2, t) : none;
    }

    /** Adds x, y, z to the vectors at @p offset, one lane after the other. */
    static QUOIN_INLINE void add(dealii::Tensor<1, 3> *force,
                                 const std::uint32_t *offset, const Value &x,
                                 const Value &y, const Value &z)
    {
      alignas(64) double row[lanes][4];
      L::store_four([&](const int l) { return row[l]; }, { x, y, z, Value{} });
      char *base = reinterpret_cast<char *>(force);
      for (int l = 0; l < lanes; ++l)
      {
        double *f = reinterpret_cast<double *>(base + offset[l]);
        *reinterpret_cast<Pair *>(f) += *reinterpret_cast<const Pair *>(row[l]);
        f[2] += row[l][2];
      }
    }
  };
} // namespace quoin

#endif
