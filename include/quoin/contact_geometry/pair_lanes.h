// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_geometry_pair_lanes_h
#define quoin_contact_geometry_pair_lanes_h

#include <quoin/base/lane_functions.h>
#include <quoin/contact_geometry/contact_search.h>

// Geometry of pairs of edges in contact and the forces that go with it, for
// one pair or for one in each lane. theory.md, "General contacts".

namespace quoin
{
  /** An edge in each lane, where it is now. */
  template <int lanes>
  struct EdgeLanes
  {
    using Value = typename Lanes<lanes>::Value;

    Value x, y; /**< of its first node [m] */
    Value tangent[2];
    Value length;          /**< [m] */
    Value inverse_length;  /**< [1/m] */
    Value thickness;       /**< of the cell behind it [m] */
    Value reference_ratio; /**< reference length by length */
    Value corner[2];       /**< see ContactEdge */
  };

  /** Where slip is counted from. */
  template <int lanes>
  struct AnchorLanes
  {
    typename Lanes<lanes>::Value slip_offset, lower, upper;
  };

  /** What the geometry of a pair depends on beside its edges. */
  template <int lanes>
  struct PairLanes
  {
    typename Lanes<lanes>::Bits was_joint;
    typename Lanes<lanes>::Value shift, shift_start; /**< of active pairs */
    AnchorLanes<lanes> anchor; /**< of the first point of active pairs */
    typename Lanes<lanes>::Bits active;
  };

  template <int lanes>
  struct PairGeometry
  {
    using Value = typename Lanes<lanes>::Value;

    Value overlap;            /**< [m] */
    Value tangent[2];         /**< mean direction of both edges, as of a */
    Value half;               /**< cosine of half the angle between them */
    Value inverse_half;       /**< 1 by half */
    Value slope;              /**< of a against the mean direction, outwards */
    Value begin;              /**< first node of b from that of a, along [m] */
    Value height;             /**< the same, across [m] */
    Value sideways;           /**< 1: from corner to corner, 0: along a side */
    Value area[2];            /**< of each point [m^2] */
    Value normal[2][2];       /**< from lower to upper */
    Value lower[2], upper[2]; /**< where on the edges, 0 to 1 */
    Value opening[2];         /**< [m] */
    /** Share by which the end of the overlap goes with the vertex of b. */
    Value share[2];
    Value lean[2]; /**< slope of the normal by that of b's, from -1 to 1 */
    Value turn[2]; /**< its derivative, by how far a's vertex is inside */
  };

  /** Forces of contacts on both edges as sums over points [N], [Nm]; what they
      are for the ends is found at last. */
  template <int lanes>
  struct TractionLanes
  {
    using Value = typename Lanes<lanes>::Value;

    Value force[2]{}, at_lower[2]{}, at_upper[2]{}; /**< at places of a and b */
    Value move[2]{}, turn{}, bend{}, stretch_a{}, stretch_b{};
  };

  /** Forces on the ends of both edges [N]. */
  template <int lanes>
  struct EndForceLanes
  {
    typename Lanes<lanes>::Value a[2][2]{}, b[2][2]{};
  };

  /** Sizes that the geometry of contacts goes by. */
  struct ContactSizes
  {
    double inverse_rounding; /**< of the shorter edge */
    double inverse_handover;
  };

  template <int lanes>
  struct PairFunctions
  {
    static constexpr unsigned int dim = 2;
    using F                           = LaneFunctions<lanes>;
    using Value                       = typename F::Value;
    using Bits                        = typename F::Bits;
    using Edge                        = EdgeLanes<lanes>;

    static constexpr double least_cosine = least_contact_cosine;

    static QUOIN_INLINE Value fill(const double value)
    {
      return Value{} + value;
    }
    static QUOIN_INLINE Value clamp(const Value &a)
    {
      return F::minimum(F::maximum(Value{}, a), fill(1.));
    }

    static QUOIN_INLINE Value cosine(const Edge &a, const Edge &b)
    {
      return -(a.tangent[0] * b.tangent[0] + a.tangent[1] * b.tangent[1]);
    }

    /**
     * Whether edges may overlap: true if they do, and false if they are clear
     * of doing so. Takes neither a root nor a quotient.
     */
    static QUOIN_INLINE Bits may_overlap(const Edge &a, const Edge &b)
    {
      // All lengths by that of the sum of both directions.
      const Value c      = cosine(a, b);
      const Value tx     = a.tangent[0] - b.tangent[0];
      const Value ty     = a.tangent[1] - b.tangent[1];
      const Value u      = (b.x - a.x) * tx + (b.y - a.y) * ty;
      const Value la     = (1. + c) * a.length;
      const Value lb     = (1. + c) * b.length;
      const Value margin = 1e-9 * (la + lb);
      return (c > least_cosine) & (u > -margin) & (u - lb < la + margin);
    }

    /** Unit vector of the mean direction @p c, the cosine() of both, shorter
        where they hardly face each other. */
    static QUOIN_INLINE void mean_direction(const Edge &a, const Edge &b,
                                            const Value &c, Value (&t)[2])
    {
      const Value scale
          = 1. / F::square_root(F::maximum(fill(1.), 2. + 2. * c));
      t[0] = scale * (a.tangent[0] - b.tangent[0]);
      t[1] = scale * (a.tangent[1] - b.tangent[1]);
    }

    /**
     * How far all nodes may move against each other [m] while the edges do not
     * overlap by may_overlap(); not more than 0 if they may now.
     */
    static QUOIN_INLINE Value clearance(const Edge &a, const Edge &b)
    {
      // Both together turn by no more than this by the motion: one of length l
      // by asin(d/l), which is at most pi/2 d/l. Their mean direction turns by
      // half of it.
      const Value turn = M_PI_2 * (a.inverse_length + b.inverse_length);
      const Value c    = cosine(a, b);
      Value t[2];
      mean_direction(a, b, c, t);
      // How far a node is from the one that it passes as the overlap begins.
      const auto clear = [&](const Value &x, const Value &y)
      {
        const Value distance = F::square_root(x * x + y * y);
        return (x * t[0] + y * t[1] - 1e-8 * (a.length + b.length))
               / (1. + 0.5 * turn * distance);
      };
      const Value x = b.x - a.x, y = b.y - a.y;
      const Value before = clear(-x, -y);
      const Value behind
          = clear(x + b.length * b.tangent[0] - a.length * a.tangent[0],
                  y + b.length * b.tangent[1] - a.length * a.tangent[1]);
      const Value beside  = turn * F::maximum(before, behind);
      const Value averted = 0.999 * least_cosine - c;
      return F::minimum(fill(1.),
                        F::maximum(averted, c > -0.5 ? beside : averted))
             / turn;
    }

    /** A bound from below of the distance of edges that face each other [m], by
        lines along their mean direction; less than 0 if it finds none. */
    static QUOIN_INLINE Value separation(const Edge &a, const Edge &b)
    {
      Value t[2];
      mean_direction(a, b, cosine(a, b), t);
      const auto height
          = [&](const Value &x, const Value &y) { return x * t[1] - y * t[0]; };
      const Value first  = height(b.x - a.x, b.y - a.y);
      const Value rise_a = a.length * height(a.tangent[0], a.tangent[1]);
      const Value rise_b = b.length * height(b.tangent[0], b.tangent[1]);
      return F::minimum(first, first + rise_b) - F::maximum(Value{}, rise_a)
             - 1e-8 * (a.length + b.length);
    }

    /** Unit normal of a contact, from lower to upper: of @p a where @p lean is
        -1, of @p b where it is 1, across the mean direction @p t where it is 0.
     */
    static QUOIN_INLINE void normal_between(const Edge &a, const Edge &b,
                                            const Value (&t)[2],
                                            const Value &lean,
                                            Value (&normal)[2])
    {
      const Bits is_a = lean == -1., is_b = lean == 1., is_mean = lean == 0.;
      normal[0] = is_a ? a.tangent[1] : (is_b ? -b.tangent[1] : t[1]);
      normal[1] = is_a ? -a.tangent[0] : (is_b ? b.tangent[0] : -t[0]);
      const Bits is_plain = is_a | is_b | is_mean;
      if (F::all(is_plain))
        return;
      const Value of_a = 0.5 * (1. - lean), of_b = 0.5 * (1. + lean);
      const Value x    = of_a * a.tangent[1] - of_b * b.tangent[1];
      const Value y    = of_b * b.tangent[0] - of_a * a.tangent[0];
      const Value norm = 1. / F::square_root(x * x + y * y);
      normal[0]        = is_plain ? normal[0] : norm * x;
      normal[1]        = is_plain ? normal[1] : norm * y;
    }

    /** From a point of a to one of b, places from 0 to 1 along them. */
    static QUOIN_INLINE void gap(const Edge &a, const Edge &b,
                                 const Value &lower, const Value &upper,
                                 Value (&d)[2])
    {
      const Value la = lower * a.length, lb = upper * b.length;
      d[0] = b.x - a.x + lb * b.tangent[0] - la * a.tangent[0];
      d[1] = b.y - a.y + lb * b.tangent[1] - la * a.tangent[1];
    }

    static QUOIN_INLINE Value slip(const AnchorLanes<lanes> &anchor,
                                   const Edge &a, const Edge &b,
                                   const Value (&normal)[2])
    {
      Value d[2];
      gap(a, b, anchor.lower, anchor.upper, d);
      return anchor.slip_offset + d[0] * normal[1] - d[1] * normal[0];
    }

    /** What of the shift of a pair is left after the slip since. */
    static QUOIN_INLINE Value shift_left(const PairLanes<lanes> &pair,
                                         const Edge &a, const Edge &b,
                                         const Value (&t)[2])
    {
      const Value normal[2] = { t[1], -t[0] };
      const Value slipped
          = F::absolute(slip(pair.anchor, a, b, normal) - pair.shift_start);
      const Value size = F::absolute(pair.shift);
      const Value left
          = pair.active ? F::maximum(Value{}, size - 0.5 * slipped) : size;
      return pair.shift < 0. ? -left : left;
    }

    /**
     * How far [m] the end of an overlap lies beyond the vertex of one edge, by
     * how far @p inside the other edge this vertex lies. Minus the derivative,
     * @p share, by which the end goes with the other edge's vertex, goes from
     * 1 to 0 over twice the @p rounding length [m]; where the vertices coincide
     * and beyond the rounding the end is one of theirs.
     */
    static QUOIN_INLINE Value soft_end(const Value &inside,
                                       const Value &rounding, Value &share)
    {
      const Value outside = F::maximum(Value{}, -inside);
      const Value one     = fill(1.);
      const Bits is_soft  = F::absolute(inside) < rounding;
      share               = inside < 0. ? one : Value{};
      if (!F::any(is_soft))
        return outside;
      const Value size    = F::absolute(inside);
      const Value left    = 1. - size / (is_soft ? rounding : one);
      const Value part    = 0.5 * left * (3. * left - 2.);
      share               = is_soft ? (inside < 0. ? 1. - part : part) : share;
      const Value earlier = outside - 0.5 * size * left * left;
      return is_soft ? earlier : outside;
    }

    /**
     * Factor on the area at a corner of an edge that makes an angle of
     * @p cosine with the edge @p touched, less than 1 if the @p neighbour of
     * this direction there lies flatter on that: then the corner belongs to
     * the neighbour.
     */
    static QUOIN_INLINE Value recession(const Value &cosine,
                                        const Value (&neighbour)[2],
                                        const Value (&touched)[2])
    {
      const Value of_neighbour
          = -(neighbour[0] * touched[0] + neighbour[1] * touched[1]);
      const Bits is_steeper = of_neighbour <= cosine;
      const Value ratio     = cosine / (is_steeper ? fill(1.) : of_neighbour);
      const Value cube      = ratio * ratio * ratio;
      return is_steeper ? fill(1.) : cube * cube;
    }

    /** Recession at end @p k, of the edge a if @p is_a, else of b. */
    template <typename Neighbour>
    static QUOIN_INLINE Value recession_beside(const Value &cosine,
                                               const Edge &a, const Edge &b,
                                               const Bits &is_a,
                                               const unsigned int k,
                                               const Neighbour &neighbour)
    {
      Value beside[2];
      neighbour(F::set_lanes(is_a), k, beside);
      const Value touched[2] = { is_a ? b.tangent[0] : a.tangent[0],
                                 is_a ? b.tangent[1] : a.tangent[1] };
      return recession(cosine, beside, touched);
    }

    /**
     * Sets @p g for the pairs whose edges overlap, which it returns.
     * @p neighbour: gives the direction of the edge beside a at end k, in the
     * lanes of a number's bits, or else of that beside b there.
     */
    template <typename Neighbour>
    static QUOIN_INLINE Bits find(const ContactSizes &sizes,
                                  const PairLanes<lanes> &pair, const Edge &a,
                                  const Edge &b, const Neighbour &neighbour,
                                  PairGeometry<lanes> &g)
    {
      const Value none{}, one = fill(1.);
      const Value c = cosine(a, b);
      // Mean direction, and the cosine of half the angle between the edges.
      const Value scale = 1. / F::square_root(2. + 2. * c);
      Value(&t)[2]      = g.tangent;
      t[0]              = scale * (a.tangent[0] - b.tangent[0]);
      t[1]              = scale * (a.tangent[1] - b.tangent[1]);
      g.half            = (1. + c) * scale;
      g.inverse_half    = 2. * scale;

      const Value x       = b.x - a.x;
      const Value y       = b.y - a.y;
      const Value along_a = g.half * a.length;
      const Value along_b = g.half * b.length;
      g.begin             = x * t[0] + y * t[1]; // b runs backwards from here
      const Value end_b   = g.begin - along_b;
      g.overlap        = F::minimum(along_a, g.begin) - F::maximum(none, end_b);
      const Bits found = (c > least_cosine) & (g.overlap > 0.);
      if (!F::any(found))
        return found;
      g.slope  = (a.tangent[0] * t[1] - a.tangent[1] * t[0]) * g.inverse_half;
      g.height = x * t[1] - y * t[0];

      // The length that counts allows for the slip at which a matched joint,
      // whose length does not change, became this contact.
      Value length          = g.overlap;
      const Bits is_shifted = found & (pair.shift != 0.);
      if (F::any(is_shifted))
      {
        const Value shift = shift_left(pair, a, b, t);
        const Value left
            = F::maximum(none, F::minimum(along_a, g.begin + shift)
                                   - F::maximum(none, end_b + shift));
        length = is_shifted ? left : length;
      }
      const Value fade
          = F::minimum(one, (c - least_cosine) * (1. / (1. - least_cosine)));
      const Value area = length * scale * fade
                         * F::minimum(a.thickness, b.thickness) * 0.5
                         * (a.reference_ratio + b.reference_ratio);

      // By how far the vertex of a lies within b at either end.
      const Value inside[2] = { -end_b, g.begin - along_a };
      const Value sine      = F::absolute(a.tangent[0] * b.tangent[1]
                                          - a.tangent[1] * b.tangent[0]);
      const Value parallel
          = pair.was_joint ? clamp(1.5 - 0.5 * sizes.inverse_handover * sine)
                           : none;
      g.sideways = (inside[0] > 0. ? a.corner[0] : b.corner[1])
                   * (inside[1] > 0. ? a.corner[1] : b.corner[0]);
      const Value by_rounding
          = sizes.inverse_rounding
            * F::maximum(a.inverse_length, b.inverse_length);
      const Value rounding   = 1. / by_rounding;
      const Value inverse_a  = a.inverse_length * g.inverse_half;
      const Value inverse_b  = b.inverse_length * g.inverse_half;
      const Bits is_inclined = found & (c < 1. - 1e-7);
      for (unsigned int k = 0; k < 2; ++k)
      {
        // As soon as a corner is among them the end of the overlap of what was
        // a joint goes over from one vertex to the other within the rounding
        // length.
        const Value &ca = a.corner[k], &cb = b.corner[1 - k];
        const Value shift  = ca * (1. - cb) - cb * (1. - ca);
        const Value beyond = soft_end(
            inside[k], pair.was_joint ? rounding * F::maximum(ca, cb) : none,
            g.share[k]);
        const Value end = k == 0 ? beyond : along_a - beyond;
        g.lower[k]      = end * inverse_a;
        g.upper[k]      = (g.begin - end) * inverse_b;
        Value d[2];
        gap(a, b, g.lower[k], g.upper[k], d);
        // The edge that a vertex touches gives the normal. Where two vertices
        // pass each other it turns from one edge to the other, unless one of
        // them is no corner: then its edge's normal holds on.
        const Value touched = 0.5 * (1. + inside[k] * by_rounding + shift);
        const Value of_b    = 0.5 * parallel + (1. - parallel) * clamp(touched);
        g.lean[k]           = 2. * of_b - 1.;
        // Joints overlap by little against the rounding. Where overlaps may be
        // many times as deep, forces of the turning would be a wall.
        g.turn[k] = (pair.was_joint & (touched > 0.) & (touched < 1.))
                        ? (1. - parallel) * by_rounding
                        : none;
        normal_between(a, b, t, g.lean[k], g.normal[k]);
        g.opening[k] = d[0] * g.normal[k][0] + d[1] * g.normal[k][1];

        g.area[k] = area;
        if (F::any(is_inclined))
        {
          const Value by_a = clamp(0.5 + 0.5 * inside[k] * by_rounding);
          const Bits is_a = inside[k] > 0., is_b = inside[k] <= 0.;
          Value factor      = recession_beside(c, a, b, is_a, k, neighbour);
          const Value share = is_a ? by_a : 1. - by_a;
          if (F::any(is_inclined & (share < 1.)))
            factor = share * factor
                     + (1. - share)
                           * recession_beside(c, a, b, is_b, k, neighbour);
          g.area[k] = is_inclined ? area * factor : area;
        }
      }
      return found;
    }

    /** Adds @p f [N] at places of a, and its opposite on b. */
    static QUOIN_INLINE void spread(const Value &lower, const Value &upper,
                                    const Value (&f)[2],
                                    TractionLanes<lanes> &sum)
    {
      for (unsigned int d = 0; d < dim; ++d)
      {
        sum.force[d] += f[d];
        sum.at_lower[d] += lower * f[d];
        sum.at_upper[d] += upper * f[d];
      }
    }

    /**
     * Adds the forces of the resultants @p sigma and @p tau [N] of point @p k,
     * minus the derivative of sigma u_n + tau u_s by the nodes of both edges;
     * the normal turns from one edge to the other only where
     * PairGeometry::turn says so.
     */
    static QUOIN_INLINE void add_tractions(const Edge &a, const Edge &b,
                                           const PairGeometry<lanes> &g,
                                           const unsigned int k,
                                           const AnchorLanes<lanes> &anchor,
                                           const Value &sigma, const Value &tau,
                                           TractionLanes<lanes> &sum)
    {
      const Value(&normal)[2] = g.normal[k];
      const Value(&t)[2]      = g.tangent;
      const Value f[2]        = { tau * normal[1], -tau * normal[0] };
      spread(anchor.lower, anchor.upper, f, sum);

      // theory.md, "General contacts": the differential of sigma u_n + tau u_s
      // by the place of b, the rotations and the lengths of both edges.
      const Value cosine = normal[0] * t[1] - normal[1] * t[0];
      const Value sine   = normal[0] * t[0] + normal[1] * t[1];
      const Value rise   = g.slope * g.half;
      const Value end    = g.lower[k] * g.half * a.length;
      const Value lag    = g.begin - 2. * end;
      const Value height = g.height + g.slope * lag;
      const Value pull   = 2. * g.slope * cosine * sigma;
      const double side  = k == 0 ? -1. : 1.;

      Value d[2];
      gap(a, b, anchor.lower, anchor.upper, d);
      const Value across = d[0] * normal[0] + d[1] * normal[1];
      const Value by_turn
          = cosine * cosine * (tau * across - sigma * height * sine);
      const Value by_slope = sigma * cosine * lag + by_turn * g.lean[k];
      const Value by_inside
          = by_turn * g.slope * g.turn[k] - side * pull * g.share[k];

      const Value along = 0.5 * pull + side * by_inside;
      sum.move[0] += sigma * cosine * t[1] + along * t[0];
      sum.move[1] += along * t[1] - sigma * cosine * t[0];
      sum.turn += tau * across;
      sum.bend -= by_slope * (g.inverse_half * g.inverse_half);
      if (k == 0)
      {
        sum.bend += by_inside * b.length * rise;
        sum.stretch_b += by_inside * g.half;
      }
      else
      {
        sum.bend -= (by_inside + pull) * a.length * rise;
        sum.stretch_a -= (by_inside + pull) * g.half;
      }
    }

    static QUOIN_INLINE EndForceLanes<lanes>
    end_forces(const Edge &a, const Edge &b, const TractionLanes<lanes> &sum)
    {
      const Value turn
          = sum.turn + sum.move[0] * (b.y - a.y) - sum.move[1] * (b.x - a.x);
      const Value turn_a = 0.5 * (turn + sum.bend) * a.inverse_length;
      const Value turn_b = 0.5 * (turn - sum.bend) * b.inverse_length;
      const Value end_a[2]
          = { sum.stretch_a * a.tangent[0] - turn_a * a.tangent[1],
              sum.stretch_a * a.tangent[1] + turn_a * a.tangent[0] };
      const Value end_b[2]
          = { sum.stretch_b * b.tangent[0] - turn_b * b.tangent[1],
              sum.stretch_b * b.tangent[1] + turn_b * b.tangent[0] };
      EndForceLanes<lanes> forces;
      for (unsigned int d = 0; d < dim; ++d)
      {
        forces.a[1][d] = sum.at_lower[d] - end_a[d];
        forces.a[0][d] = sum.force[d] + sum.move[d] - forces.a[1][d];
        forces.b[1][d] = -sum.at_upper[d] - end_b[d];
        forces.b[0][d] = -sum.force[d] - sum.move[d] - forces.b[1][d];
      }
      return forces;
    }
  };
} // namespace quoin

#endif
