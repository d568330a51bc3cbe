// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_lanes_h
#define quoin_base_lanes_h

#include <quoin/base/intrinsics.h>
#include <quoin/base/native_lanes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

// Vectors wider than the machine's registers are legal (the tests run 8 lanes
// everywhere), but passing them by value has no fixed ABI.
#define QUOIN_INLINE inline __attribute__((always_inline))

/** SIMD operations on four or eight doubles: vectors of GCC, which have
    arithmetic, comparisons that give masks, and mask ? a : b of their own. */
namespace quoin
{
  using Pair
      = double __attribute__((vector_size(16), may_alias)); // x, y of a node
  using Two = double
      __attribute__((vector_size(16), aligned(8), may_alias)); // not aligned

  template <int lanes>
  struct Lanes;

  /** One double, so that code for lanes is that for single points, too. */
  template <>
  struct Lanes<1>
  {
    using Value = double;
    using Bits  = bool;
    using Bytes = std::int8_t;

    static void square_root(const Value a, Value &root)
    {
      root = std::sqrt(a);
    }
    static void absolute(const Value a, Value &result)
    {
      result = std::abs(a);
    }

    template <typename Of>
    static QUOIN_INLINE void load_four(const Of &of, Value (&v)[4])
    {
      std::copy_n(of(0), 4, v);
    }
    template <typename To>
    static QUOIN_INLINE void store_four(const To &to, const Value (&v)[4])
    {
      std::copy_n(v, 4, to(0));
    }
    static QUOIN_INLINE void load(const char *base, const std::size_t scale,
                                  const std::uint32_t *offset, Value &x,
                                  Value &y)
    {
      const Pair &p = *reinterpret_cast<const Pair *>(base + scale * *offset);
      x             = p[0];
      y             = p[1];
    }
  };

  template <>
  struct Lanes<4>
  {
    using Value = double __attribute__((vector_size(32), may_alias));
    using Bits  = std::int64_t __attribute__((vector_size(32), may_alias));
    using Bytes = std::int8_t __attribute__((vector_size(4)));

    /** Sets the lanes without a bit in the mask to infinity. */
    static QUOIN_INLINE void keep(const std::uint8_t mask, Value &value)
    {
      alignas(32) static constexpr std::int64_t table[16][4]
          = { { -1, -1, -1, -1 }, { 0, -1, -1, -1 }, { -1, 0, -1, -1 },
              { 0, 0, -1, -1 },   { -1, -1, 0, -1 }, { 0, -1, 0, -1 },
              { -1, 0, 0, -1 },   { 0, 0, 0, -1 },   { -1, -1, -1, 0 },
              { 0, -1, -1, 0 },   { -1, 0, -1, 0 },  { 0, 0, -1, 0 },
              { -1, -1, 0, 0 },   { 0, -1, 0, 0 },   { -1, 0, 0, 0 },
              { 0, 0, 0, 0 } };
      const Bits absent = *reinterpret_cast<const Bits *>(table[mask]);
      value
          = absent ? Value{} + std::numeric_limits<double>::infinity() : value;
    }

    static QUOIN_INLINE void square_root(const Value &a, Value &root)
    {
#ifdef __AVX__
      root = _mm256_sqrt_pd(a);
#else
      root = Value{ std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]),
                    std::sqrt(a[3]) };
#endif
    }

    static QUOIN_INLINE void absolute(const Value &a, Value &result)
    {
      constexpr auto all = std::numeric_limits<std::int64_t>::max();
      result             = (Value)((Bits)a & Bits{ all, all, all, all });
    }

    static QUOIN_INLINE void minimum(const Value &a, Value &result)
    {
      result = a < result ? a : result;
    }

    /** Bit l: whether a > b in lane l. */
    static QUOIN_INLINE std::uint8_t greater(const Value &a, const Value &b)
    {
#ifdef __AVX__
      return _mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_GT_OQ));
#else
      return (a[0] > b[0]) | (a[1] > b[1]) << 1 | (a[2] > b[2]) << 2
             | (a[3] > b[3]) << 3;
#endif
    }

    /** Transposes the four doubles at @p of(lane) of each lane. */
    template <typename Of>
    static QUOIN_INLINE void load_four(const Of &of, Value (&v)[4])
    {
      const Value row[4]
          = { four(of(0)), four(of(1)), four(of(2)), four(of(3)) };
      to_columns(row, v);
    }

    /** The inverse of load_four(), to @p to(lane). */
    template <typename To>
    static QUOIN_INLINE void store_four(const To &to, const Value (&v)[4])
    {
      Value row[4];
      to_rows(v, row);
      for (int l = 0; l < 4; ++l)
        set_four(to(l), row[l]);
    }

    /** Four doubles, at any address of doubles. */
    static QUOIN_INLINE Value four(const double *p)
    {
      Value value;
      std::memcpy(&value, p, sizeof(value));
      return value;
    }
    static QUOIN_INLINE void set_four(double *p, const Value &value)
    {
      std::memcpy(p, &value, sizeof(value));
    }

    /** Transposes the pairs at base + scale * offset. */
    template <typename Offset>
    static QUOIN_INLINE void load(const char *base, const std::size_t scale,
                                  const Offset *offset, Value &x, Value &y)
    {
      const Pair p0   = pair(base + scale * offset[0]);
      const Pair p1   = pair(base + scale * offset[1]);
      const Pair p2   = pair(base + scale * offset[2]);
      const Pair p3   = pair(base + scale * offset[3]);
      const Value p02 = __builtin_shufflevector(p0, p2, 0, 1, 2, 3);
      const Value p13 = __builtin_shufflevector(p1, p3, 0, 1, 2, 3);
      x               = __builtin_shufflevector(p02, p13, 0, 4, 2, 6);
      y               = __builtin_shufflevector(p02, p13, 1, 5, 3, 7);
    }

    /** Adds x, y to the pairs at base + offset, one lane after the other. */
    template <typename Offset>
    static QUOIN_INLINE void add(char *base, const Offset *offset,
                                 const Value &x, const Value &y)
    {
      const Value p02 = __builtin_shufflevector(x, y, 0, 4, 2, 6);
      const Value p13 = __builtin_shufflevector(x, y, 1, 5, 3, 7);
      pair(base + offset[0]) += __builtin_shufflevector(p02, p02, 0, 1);
      pair(base + offset[1]) += __builtin_shufflevector(p13, p13, 0, 1);
      pair(base + offset[2]) += upper(p02);
      pair(base + offset[3]) += upper(p13);
    }

    /** Loads the four doubles of each lane at base + scale * offset. */
    static QUOIN_INLINE void load_rows(const char *base,
                                       const std::size_t scale,
                                       const std::uint16_t *offset,
                                       Value (&row)[4])
    {
      for (int l = 0; l < 4; ++l)
        row[l] = *reinterpret_cast<const Value *>(base + scale * offset[l]);
    }

    /** x + u and y + v of rows (x, y, u, v), one for each lane. */
    static QUOIN_INLINE void add_halves(const Value (&row)[4], Value &x,
                                        Value &y)
    {
      const Value sum_02
          = __builtin_shufflevector(row[0], row[2], 0, 1, 4, 5)
            + __builtin_shufflevector(row[0], row[2], 2, 3, 6, 7);
      const Value sum_13
          = __builtin_shufflevector(row[1], row[3], 0, 1, 4, 5)
            + __builtin_shufflevector(row[1], row[3], 2, 3, 6, 7);
      x = __builtin_shufflevector(sum_02, sum_13, 0, 4, 2, 6);
      y = __builtin_shufflevector(sum_02, sum_13, 1, 5, 3, 7);
    }

    /** Pairs of lanes: the first of each twice, the second twice, swapped. */
    static QUOIN_INLINE void first_of_pairs(const Value &a, Value &result)
    {
      result = __builtin_shufflevector(a, a, 0, 0, 2, 2);
    }
    static QUOIN_INLINE void second_of_pairs(const Value &a, Value &result)
    {
      result = __builtin_shufflevector(a, a, 1, 1, 3, 3);
    }
    static QUOIN_INLINE void swap_pairs(const Value &a, Value &result)
    {
      result = __builtin_shufflevector(a, a, 1, 0, 3, 2);
    }

    /** Transposes rows, one for each lane, to columns, one for each
        component. */
    static QUOIN_INLINE void to_columns(const Value (&row)[4],
                                        Value (&column)[4])
    {
      const Value ab_0 = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6);
      const Value ab_1 = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7);
      const Value cd_0 = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6);
      const Value cd_1 = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
      column[0]        = __builtin_shufflevector(ab_0, cd_0, 0, 1, 4, 5);
      column[1]        = __builtin_shufflevector(ab_1, cd_1, 0, 1, 4, 5);
      column[2]        = uppers(ab_0, cd_0);
      column[3]        = uppers(ab_1, cd_1);
    }

    /** The inverse of to_columns(). */
    static QUOIN_INLINE void to_rows(const Value (&column)[4], Value (&row)[4])
    {
      to_columns(column, row);
    }

    /** Adds rows to the values at base + offset, one lane after the other. */
    static QUOIN_INLINE void add_rows(char *base, const std::uint16_t *offset,
                                      const Value (&row)[4])
    {
      for (int l = 0; l < 4; ++l)
        *reinterpret_cast<Value *>(base + offset[l]) += row[l];
    }

    /** load_rows() and to_columns(), in halves of rows, without permutations
        over all of a register. */
    static QUOIN_INLINE void load_columns(const char *base,
                                          const std::uint16_t *offset,
                                          Value (&column)[4])
    {
      load(base, 1, offset, column[0], column[1]);
      load(base + sizeof(Pair), 1, offset, column[2], column[3]);
    }

    /** to_rows() and add_rows(), in halves of rows. */
    static QUOIN_INLINE void add_columns(char *base,
                                         const std::uint16_t *offset,
                                         const Value (&column)[4])
    {
      add(base, offset, column[0], column[1]);
      add(base + sizeof(Pair), offset, column[2], column[3]);
    }

    /** The upper two lanes. GCC 12 takes a slower permutation for them where it
        is not told. */
    static QUOIN_INLINE Pair upper(const Value &a)
    {
#ifdef __AVX__
      return _mm256_extractf128_pd(a, 1);
#else
      return __builtin_shufflevector(a, a, 2, 3);
#endif
    }
    /** The lower lanes of @p a and the upper ones of @p b, likewise. */
    template <typename Vector>
    static QUOIN_INLINE Vector halves(const Vector &a, const Vector &b)
    {
#ifdef __AVX__
      return (Vector)_mm256_blend_pd((__m256d)a, (__m256d)b, 0b1100);
#else
      return __builtin_shufflevector(a, b, 0, 1, 6, 7);
#endif
    }

    /** The upper lanes of both. */
    template <typename Vector>
    static QUOIN_INLINE Vector uppers(const Vector &a, const Vector &b)
    {
#ifdef __AVX__
      return (Vector)_mm256_blend_pd(_mm256_castpd128_pd256(upper((Value)a)),
                                     (__m256d)b, 0b1100);
#else
      return __builtin_shufflevector(a, b, 2, 3, 6, 7);
#endif
    }

    static QUOIN_INLINE const Pair &pair(const char *p)
    {
      return *reinterpret_cast<const Pair *>(p);
    }

    static QUOIN_INLINE Pair &pair(char *p)
    {
      return *reinterpret_cast<Pair *>(p);
    }
  };

  template <>
  struct Lanes<8>
  {
    using Value = double __attribute__((vector_size(64), may_alias));
    using Bits  = std::int64_t __attribute__((vector_size(64), may_alias));
    using Bytes = std::int8_t __attribute__((vector_size(8)));

    static QUOIN_INLINE void keep(const std::uint8_t mask, Value &value)
    {
      const std::int64_t m = mask;
      const Bits bits      = Bits{ m, m, m, m, m, m, m, m }
                        & Bits{ 1, 2, 4, 8, 16, 32, 64, 128 };
      value = bits == 0 ? Value{} + std::numeric_limits<double>::infinity()
                        : value;
    }

    static QUOIN_INLINE void square_root(const Value &a, Value &root)
    {
#ifdef __AVX512F__
      root = _mm512_maskz_sqrt_pd(0xff, a);
#else
      root = Value{ std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]),
                    std::sqrt(a[3]), std::sqrt(a[4]), std::sqrt(a[5]),
                    std::sqrt(a[6]), std::sqrt(a[7]) };
#endif
    }

    static QUOIN_INLINE void absolute(const Value &a, Value &result)
    {
      constexpr auto all = std::numeric_limits<std::int64_t>::max();
      result
          = (Value)((Bits)a & Bits{ all, all, all, all, all, all, all, all });
    }

    static QUOIN_INLINE void minimum(const Value &a, Value &result)
    {
      result = a < result ? a : result;
    }

    static QUOIN_INLINE std::uint8_t greater(const Value &a, const Value &b)
    {
      return Lanes<4>::greater(low(a), low(b))
             | Lanes<4>::greater(high(a), high(b)) << 4;
    }

    template <typename Of>
    static QUOIN_INLINE void load_four(const Of &of, Value (&v)[4])
    {
      Value row[4];
      for (int r = 0; r < 4; ++r)
        row[r] = join(Lanes<4>::four(of(lane_of_row(r))),
                      Lanes<4>::four(of(lane_of_row(r) + 2)));
      to_columns(row, v);
    }

    template <typename To>
    static QUOIN_INLINE void store_four(const To &to, const Value (&v)[4])
    {
      Value row[4];
      to_rows(v, row);
      for (int r = 0; r < 4; ++r)
      {
        Lanes<4>::set_four(to(lane_of_row(r)), low(row[r]));
        Lanes<4>::set_four(to(lane_of_row(r) + 2), high(row[r]));
      }
    }

    static QUOIN_INLINE Lanes<4>::Value low(const Value &a)
    {
      return __builtin_shufflevector(a, a, 0, 1, 2, 3);
    }

    static QUOIN_INLINE Lanes<4>::Value high(const Value &a)
    {
      return __builtin_shufflevector(a, a, 4, 5, 6, 7);
    }

    static QUOIN_INLINE void load(const char *base, const std::size_t scale,
                                  const std::uint32_t *offset, Value &x,
                                  Value &y)
    {
      Lanes<4>::Value x0, y0, x1, y1;
      Lanes<4>::load(base, scale, offset, x0, y0);
      Lanes<4>::load(base, scale, offset + 4, x1, y1);
      x = __builtin_shufflevector(x0, x1, 0, 1, 2, 3, 4, 5, 6, 7);
      y = __builtin_shufflevector(y0, y1, 0, 1, 2, 3, 4, 5, 6, 7);
    }

    static QUOIN_INLINE void add(char *base, const std::uint32_t *offset,
                                 const Value &x, const Value &y)
    {
      Lanes<4>::add(base, offset, __builtin_shufflevector(x, x, 0, 1, 2, 3),
                    __builtin_shufflevector(y, y, 0, 1, 2, 3));
      Lanes<4>::add(base, offset + 4, __builtin_shufflevector(x, x, 4, 5, 6, 7),
                    __builtin_shufflevector(y, y, 4, 5, 6, 7));
    }

    /** Row r has the four doubles of this lane, then those of two lanes
        further: columns come out of them without permutations over all of a
        register, which are slow beside arithmetic. */
    static constexpr int lane_of_row(const int r)
    {
      return r < 2 ? r : r + 2;
    }

    static QUOIN_INLINE void load_rows(const char *base,
                                       const std::size_t scale,
                                       const std::uint16_t *offset,
                                       Value (&row)[4])
    {
      for (int r = 0; r < 4; ++r)
      {
        const std::uint16_t *o = offset + lane_of_row(r);
        row[r]                 = join(
                            *reinterpret_cast<const Lanes<4>::Value *>(base + scale * o[0]),
                            *reinterpret_cast<const Lanes<4>::Value *>(base + scale * o[2]));
      }
    }

    static QUOIN_INLINE Value join(const Lanes<4>::Value &first,
                                   const Lanes<4>::Value &second)
    {
#ifdef __AVX512F__
      // With a mask of all lanes, because GCC 12 warns of the undefined value
      // in the intrinsic without one.
      return _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(first),
                                      second, 1);
#else
      return __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7);
#endif
    }

    static QUOIN_INLINE void add_halves(const Lanes<4>::Value (&row)[8],
                                        Value &x, Value &y)
    {
      Lanes<4>::Value x0, y0, x1, y1;
      Lanes<4>::add_halves({ row[0], row[1], row[2], row[3] }, x0, y0);
      Lanes<4>::add_halves({ row[4], row[5], row[6], row[7] }, x1, y1);
      x = __builtin_shufflevector(x0, x1, 0, 1, 2, 3, 4, 5, 6, 7);
      y = __builtin_shufflevector(y0, y1, 0, 1, 2, 3, 4, 5, 6, 7);
    }

    static QUOIN_INLINE void first_of_pairs(const Value &a, Value &result)
    {
      result = __builtin_shufflevector(a, a, 0, 0, 2, 2, 4, 4, 6, 6);
    }
    static QUOIN_INLINE void second_of_pairs(const Value &a, Value &result)
    {
      result = __builtin_shufflevector(a, a, 1, 1, 3, 3, 5, 5, 7, 7);
    }
    static QUOIN_INLINE void swap_pairs(const Value &a, Value &result)
    {
      result = __builtin_shufflevector(a, a, 1, 0, 3, 2, 5, 4, 7, 6);
    }

    static QUOIN_INLINE void to_columns(const Value (&row)[4],
                                        Value (&column)[4])
    {
      const Value ab_0
          = __builtin_shufflevector(row[0], row[1], 0, 8, 2, 10, 4, 12, 6, 14);
      const Value ab_1
          = __builtin_shufflevector(row[0], row[1], 1, 9, 3, 11, 5, 13, 7, 15);
      const Value cd_0
          = __builtin_shufflevector(row[2], row[3], 0, 8, 2, 10, 4, 12, 6, 14);
      const Value cd_1
          = __builtin_shufflevector(row[2], row[3], 1, 9, 3, 11, 5, 13, 7, 15);
      column[0] = __builtin_shufflevector(ab_0, cd_0, 0, 1, 4, 5, 8, 9, 12, 13);
      column[1] = __builtin_shufflevector(ab_1, cd_1, 0, 1, 4, 5, 8, 9, 12, 13);
      column[2]
          = __builtin_shufflevector(ab_0, cd_0, 2, 3, 6, 7, 10, 11, 14, 15);
      column[3]
          = __builtin_shufflevector(ab_1, cd_1, 2, 3, 6, 7, 10, 11, 14, 15);
    }

    static QUOIN_INLINE void to_rows(const Value (&column)[4], Value (&row)[4])
    {
      const Value xy_0 = __builtin_shufflevector(column[0], column[1], 0, 8, 2,
                                                 10, 4, 12, 6, 14);
      const Value xy_1 = __builtin_shufflevector(column[0], column[1], 1, 9, 3,
                                                 11, 5, 13, 7, 15);
      const Value zw_0 = __builtin_shufflevector(column[2], column[3], 0, 8, 2,
                                                 10, 4, 12, 6, 14);
      const Value zw_1 = __builtin_shufflevector(column[2], column[3], 1, 9, 3,
                                                 11, 5, 13, 7, 15);
      row[0] = __builtin_shufflevector(xy_0, zw_0, 0, 1, 8, 9, 2, 3, 10, 11);
      row[1] = __builtin_shufflevector(xy_1, zw_1, 0, 1, 8, 9, 2, 3, 10, 11);
      row[2] = __builtin_shufflevector(xy_0, zw_0, 4, 5, 12, 13, 6, 7, 14, 15);
      row[3] = __builtin_shufflevector(xy_1, zw_1, 4, 5, 12, 13, 6, 7, 14, 15);
    }

    static QUOIN_INLINE void add_rows(char *base, const std::uint16_t *offset,
                                      const Value (&row)[4])
    {
      const auto at = [&](const int lane) -> Lanes<4>::Value &
      { return *reinterpret_cast<Lanes<4>::Value *>(base + offset[lane]); };
      for (int r = 0; r < 4; ++r)
        at(lane_of_row(r)) += low(row[r]);
      for (int r = 0; r < 4; ++r)
        at(lane_of_row(r) + 2) += high(row[r]);
    }

    static QUOIN_INLINE void load_columns(const char *base,
                                          const std::uint16_t *offset,
                                          Value (&column)[4])
    {
      Value row[4];
      load_rows(base, 1, offset, row);
      to_columns(row, column);
    }

    static QUOIN_INLINE void add_columns(char *base,
                                         const std::uint16_t *offset,
                                         const Value (&column)[4])
    {
      Value row[4];
      to_rows(column, row);
      add_rows(base, offset, row);
    }
  };
} // namespace quoin

#endif
