// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_lane_functions_h
#define quoin_base_lane_functions_h

#include <quoin/base/eigen_core.h>
#include <quoin/base/lanes.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

// As in intrinsics.h: Eigen's functions are instantiated here.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

namespace quoin
{
  /** Functions of one, four or eight doubles, and of masks: all bits of a lane
      are set, or none. */
  template <int lanes>
  struct LaneFunctions
  {
    using L     = Lanes<lanes>;
    using Value = typename L::Value;
    using Bits  = typename L::Bits;
    using Bytes = typename L::Bytes;

    static QUOIN_INLINE Value load(const double *from)
    {
      Value value;
      std::memcpy(&value, from, sizeof(value));
      return value;
    }
    static QUOIN_INLINE void store(double *to, const Value &value)
    {
      std::memcpy(to, &value, sizeof(value));
    }
    /** Stores the lanes of @p mask; the others keep what they have. */
    static QUOIN_INLINE void store(double *to, const Value &value,
                                   const Bits &mask)
    {
      store(to, mask ? value : load(to));
    }

    // GCC 12 converts vectors to bytes and back one lane after the other.
    /** Small numbers from and to bytes. */
    static QUOIN_INLINE Bits load_bytes(const std::uint8_t *from)
    {
      Bytes bytes;
      std::memcpy(&bytes, from, sizeof(bytes));
#ifdef __AVX512F__
      if constexpr (lanes == 8)
        return (Bits)_mm512_maskz_cvtepi8_epi64(
            0xff, _mm_cvtsi64_si128((long long)bytes));
#endif
#ifdef __AVX2__
      if constexpr (lanes == 4)
        return (Bits)_mm256_cvtepi8_epi64(_mm_cvtsi32_si128((int)bytes));
#endif
      return __builtin_convertvector(bytes, Bits);
    }
    static QUOIN_INLINE void store_bytes(std::uint8_t *to, const Bits &value,
                                         const Bits &mask)
    {
      store_bytes(to, mask ? value : load_bytes(to));
    }
    static QUOIN_INLINE void store_bytes(std::uint8_t *to, const Bits &value)
    {
      const Bytes bytes = to_bytes(value);
      std::memcpy(to, &bytes, sizeof(bytes));
    }

    /** The lowest byte of each lane. */
    static QUOIN_INLINE Bytes to_bytes(const Bits &value)
    {
#ifdef __AVX512F__
      if constexpr (lanes == 8)
        return (Bytes)_mm_cvtsi128_si64(
            _mm512_maskz_cvtepi64_epi8(0xff, (__m512i)value));
#endif
#ifdef __AVX2__
      if constexpr (lanes == 4)
      {
        // Bytes 0 and 8 of both halves to their beginnings.
        const __m256i pairs
            = _mm256_shuffle_epi8((__m256i)value, _mm256_set1_epi64x(0x0800));
        return (Bytes)_mm_cvtsi128_si32(_mm_unpacklo_epi16(
            _mm256_castsi256_si128(pairs), _mm256_extracti128_si256(pairs, 1)));
      }
#endif
      return __builtin_convertvector(value, Bytes);
    }

    static QUOIN_INLINE Value absolute(const Value &a)
    {
      Value result;
      L::absolute(a, result);
      return result;
    }
    static QUOIN_INLINE Value square_root(const Value &a)
    {
      Value root;
      L::square_root(a, root);
      return root;
    }
    static QUOIN_INLINE Value minimum(const Value &a, const Value &b)
    {
      return b < a ? b : a;
    }
    static QUOIN_INLINE Value maximum(const Value &a, const Value &b)
    {
      return a < b ? b : a;
    }

    /** Bit l: whether lane l of @p mask is set. */
    static QUOIN_INLINE unsigned int set_lanes(const Bits &mask)
    {
      if constexpr (lanes == 1)
        return mask ? 1 : 0;
      else if constexpr (lanes == 4)
      {
#ifdef __AVX__
        return _mm256_movemask_pd((__m256d)mask);
#else
        return (mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8);
#endif
      }
      else
      {
#ifdef __AVX512F__
        return _mm512_cmplt_epi64_mask((__m512i)mask, _mm512_setzero_si512());
#else
        return LaneFunctions<4>::set_lanes(
                   __builtin_shufflevector(mask, mask, 0, 1, 2, 3))
               | LaneFunctions<4>::set_lanes(
                     __builtin_shufflevector(mask, mask, 4, 5, 6, 7))
                     << 4;
#endif
      }
    }
    /** The mask of the lanes whose bit is set, the inverse of set_lanes(). */
    static QUOIN_INLINE Bits mask_of(const unsigned int set)
    {
      if constexpr (lanes == 1)
        return set != 0;
      else
      {
        // By shifts: of masks that come from comparisons GCC 12 combines some
        // bit by bit.
        Bits lane{ 0, 1, 2, 3 };
        if constexpr (lanes == 8)
          lane = Bits{ 0, 1, 2, 3, 4, 5, 6, 7 };
        return -(((Bits{} + set) >> lane) & 1);
      }
    }
    static QUOIN_INLINE bool any(const Bits &mask)
    {
      return set_lanes(mask) != 0;
    }
    static QUOIN_INLINE bool all(const Bits &mask)
    {
      return set_lanes(mask) == (1u << lanes) - 1;
    }

    /** a0, b0, a1, b1, ... of the first half of the lanes, or the second. */
    template <typename Vector>
    static QUOIN_INLINE Vector interleave_low(const Vector &a, const Vector &b)
    {
      if constexpr (lanes == 4)
        return __builtin_shufflevector(a, b, 0, 4, 1, 5);
      else
        return __builtin_shufflevector(a, b, 0, 8, 1, 9, 2, 10, 3, 11);
    }
    template <typename Vector>
    static QUOIN_INLINE Vector interleave_high(const Vector &a, const Vector &b)
    {
      if constexpr (lanes == 4)
        return __builtin_shufflevector(a, b, 2, 6, 3, 7);
      else
        return __builtin_shufflevector(a, b, 4, 12, 5, 13, 6, 14, 7, 15);
    }
    /** The even lanes of @p a and @p b, or the odd ones. */
    static QUOIN_INLINE Value even(const Value &a, const Value &b)
    {
      if constexpr (lanes == 4)
        return __builtin_shufflevector(a, b, 0, 2, 4, 6);
      else
        return __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
    }
    static QUOIN_INLINE Value odd(const Value &a, const Value &b)
    {
      if constexpr (lanes == 4)
        return __builtin_shufflevector(a, b, 1, 3, 5, 7);
      else
        return __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
    }

    /** Components x and y of @p lanes pairs one after the other. */
    static QUOIN_INLINE void load_pairs(const double *from, Value &x, Value &y)
    {
      if constexpr (lanes == 4)
      {
        // In halves, without permutations over all of a register.
        const auto pair
            = [&](int i) { return reinterpret_cast<const Two *>(from)[i]; };
        const Value p02 = __builtin_shufflevector(pair(0), pair(2), 0, 1, 2, 3);
        const Value p13 = __builtin_shufflevector(pair(1), pair(3), 0, 1, 2, 3);
        x               = __builtin_shufflevector(p02, p13, 0, 4, 2, 6);
        y               = __builtin_shufflevector(p02, p13, 1, 5, 3, 7);
      }
      else
      {
        const Value a = load(from), b = load(from + lanes);
        x = even(a, b);
        y = odd(a, b);
      }
    }
    /** The inverse of load_pairs(). */
    static QUOIN_INLINE void store_pairs(double *to, const Value &x,
                                         const Value &y)
    {
      if constexpr (lanes == 4)
      {
        Two *pair       = reinterpret_cast<Two *>(to);
        const Value p02 = __builtin_shufflevector(x, y, 0, 4, 2, 6);
        const Value p13 = __builtin_shufflevector(x, y, 1, 5, 3, 7);
        pair[0]         = __builtin_shufflevector(p02, p02, 0, 1);
        pair[1]         = __builtin_shufflevector(p13, p13, 0, 1);
        pair[2]         = L::upper(p02);
        pair[3]         = L::upper(p13);
      }
      else
      {
        store(to, interleave_low(x, y));
        store(to + lanes, interleave_high(x, y));
      }
    }

    /** The vectors a, b (and c) in the order a0, b0, c0, a1, b1, ... */
    template <typename Vector>
    static QUOIN_INLINE void interleave(const Vector (&from)[2],
                                        Vector (&to)[2])
    {
      to[0] = interleave_low(from[0], from[1]);
      to[1] = interleave_high(from[0], from[1]);
    }
    template <typename Vector>
    static QUOIN_INLINE void interleave(const Vector (&from)[3],
                                        Vector (&to)[3])
    {
      const Vector &a = from[0], &b = from[1], &c = from[2];
      if constexpr (lanes == 4)
      {
        // Hardly any permutation over all of a register, which are slow.
        const Vector ab = __builtin_shufflevector(a, b, 0, 4, 2, 6);
        const Vector ca = __builtin_shufflevector(c, a, 0, 5, 2, 7);
        const Vector bc = __builtin_shufflevector(b, c, 1, 5, 3, 7);
        to[0]           = __builtin_shufflevector(ab, ca, 0, 1, 4, 5);
        to[1]           = L::halves(bc, ab);
        to[2]           = L::uppers(ca, bc);
      }
      else
      {
        to[0] = __builtin_shufflevector(a, b, 0, 8, -1, 1, 9, -1, 2, 10);
        to[0] = __builtin_shufflevector(to[0], c, 0, 1, 8, 3, 4, 9, 6, 7);
        to[1] = __builtin_shufflevector(a, b, -1, 3, 11, -1, 4, 12, -1, 5);
        to[1] = __builtin_shufflevector(to[1], c, 10, 1, 2, 11, 4, 5, 12, 7);
        to[2] = __builtin_shufflevector(a, b, 13, -1, 6, 14, -1, 7, 15, -1);
        to[2] = __builtin_shufflevector(to[2], c, 0, 13, 2, 3, 14, 5, 6, 15);
      }
    }
    /** The inverse of interleave(). */
    static QUOIN_INLINE void take_apart(const Value (&from)[2], Value (&to)[2])
    {
      to[0] = even(from[0], from[1]);
      to[1] = odd(from[0], from[1]);
    }
    static QUOIN_INLINE void take_apart(const Value (&from)[3], Value (&to)[3])
    {
      const Value &x = from[0], &y = from[1], &z = from[2];
      if constexpr (lanes == 4)
      {
        const Value ab = L::halves(x, y);
        const Value ca = __builtin_shufflevector(x, z, 2, 3, 4, 5);
        const Value bc = L::halves(y, z);
        to[0]          = __builtin_shufflevector(ab, ca, 0, 5, 2, 7);
        to[1]          = __builtin_shufflevector(ab, bc, 1, 4, 3, 6);
        to[2]          = __builtin_shufflevector(ca, bc, 0, 5, 2, 7);
      }
      else
      {
        to[0] = __builtin_shufflevector(x, y, 0, 3, 6, 9, 12, 15, -1, -1);
        to[0] = __builtin_shufflevector(to[0], z, 0, 1, 2, 3, 4, 5, 10, 13);
        to[1] = __builtin_shufflevector(x, y, 1, 4, 7, 10, 13, -1, -1, -1);
        to[1] = __builtin_shufflevector(to[1], z, 0, 1, 2, 3, 4, 8, 11, 14);
        to[2] = __builtin_shufflevector(x, y, 2, 5, 8, 11, 14, -1, -1, -1);
        to[2] = __builtin_shufflevector(to[2], z, 0, 1, 2, 3, 4, 9, 12, 15);
      }
    }

    /** Lane @p l. */
    static QUOIN_INLINE double at(const Value &a, const int l)
    {
      if constexpr (lanes == 1)
        return a;
      else
        return a[l];
    }
    /** What @p of gives for each lane. */
    template <typename Of>
    static QUOIN_INLINE Value each(const Of &of)
    {
      if constexpr (lanes == 1)
        return of(0);
      else if constexpr (lanes == 4)
        return Value{ of(0), of(1), of(2), of(3) };
      else
        return Value{ of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7) };
    }

    static QUOIN_INLINE double sum(const Value &a)
    {
      double result = 0.;
      for (int l = 0; l < lanes; ++l)
        result += at(a, l);
      return result;
    }

    /** exp and log to an ulp or two, exp() of less than -709 as of that. */
    static QUOIN_INLINE Value exponential(const Value &a)
    {
#ifdef __AVX__
      return by_four(a,
                     [](const __m256d x) { return Eigen::internal::pexp(x); });
#else
      Value result;
      for (int l = 0; l < lanes; ++l)
        result[l] = std::exp(std::max(a[l], -709.));
      return result;
#endif
    }
    static QUOIN_INLINE Value logarithm(const Value &a)
    {
#ifdef __AVX__
      return by_four(a,
                     [](const __m256d x) { return Eigen::internal::plog(x); });
#else
      Value result;
      for (int l = 0; l < lanes; ++l)
        result[l] = std::log(a[l]);
      return result;
#endif
    }

    /** To an ulp; of angles beyond 1e5, more than any block turns, by those of
        the library. */
    static QUOIN_INLINE void sine_cosine(const Value &angle, Value &sine,
                                         Value &cosine)
    {
      if constexpr (lanes == 1)
      {
        sine   = std::sin(angle);
        cosine = std::cos(angle);
      }
      else
      {
        if (!all(absolute(angle) < 1e5))
        {
          sine   = each([&](const int l) { return std::sin(angle[l]); });
          cosine = each([&](const int l) { return std::cos(angle[l]); });
          return;
        }
        // The multiple of pi/2 that is next to the angle, whose last bits are
        // those of a large number, is taken off in two parts.
        const Value large   = Value{} + 6755399441055744.; // 1.5 * 2^52
        const Value sum     = angle * 0.63661977236758134308 + large;
        const Bits quadrant = (Bits)sum;
        const Value n       = sum - large;
        const Value x       = (angle - n * 1.57079632673412561417)
                        - n * 6.07710050650619224932e-11;
        // Polynomials of W. Kahan's and K. C. Ng's functions in fdlibm.
        const Value z = x * x;
        const Value s = x
                        + x * z
                              * polynomial(z, { -1.66666666666666324348e-1,
                                                8.33333333332248946124e-3,
                                                -1.98412698298579493134e-4,
                                                2.75573137070700676789e-6,
                                                -2.50507602534068634195e-8,
                                                1.58969099521155010221e-10 });
        const Value high
            = z * z
              * polynomial(
                  z,
                  { 4.16666666666666019037e-2, -1.38888888888741095749e-3,
                    2.48015872894767294178e-5, -2.75573143513906633035e-7,
                    2.08757232129817482790e-9, -1.13596475577881948265e-11 });
        const Value half = 0.5 * z, main = 1. - half;
        const Value c     = main + (((1. - main) - half) + high);
        const Bits is_odd = (quadrant & 1) != 0;
        const Value a = is_odd ? c : s, b = is_odd ? s : c;
        sine   = (quadrant & 2) != 0 ? -a : a;
        cosine = ((quadrant + 1) & 2) != 0 ? -b : b;
      }
    }

  private:
    static QUOIN_INLINE Value polynomial(const Value &x, const double (&c)[6])
    {
      Value sum = Value{} + c[5];
      for (int i = 4; i >= 0; --i)
        sum = c[i] + x * sum;
      return sum;
    }
#ifdef __AVX__
    template <typename Function>
    static QUOIN_INLINE Value by_four(const Value &a, const Function &function)
    {
      if constexpr (lanes == 4)
        return function(a);
      else
      {
        const Lanes<4>::Value low  = function(L::low(a)),
                              high = function(L::high(a));
        return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
      }
    }
#endif
  };
} // namespace quoin

#pragma GCC diagnostic pop

#endif
