// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_materials_space_strain_h
#define quoin_materials_space_strain_h

#include <array>

/**
 * Rotation and Biot strain e = U - I of a displacement gradient in space,
 * F = I + H = R U.
 *
 * Neither R nor U is computed by iterating matrices: with
 * @f[ G = F^T F - I = H + H^T + H^T H, \quad j = \det F - 1, @f]
 * all of which keep the digits of small strains, the trace a of the strain
 * is the largest root of a polynomial of degree four,
 * @f[ \varphi(a) = (10 + 4 a) a + (6 + 4 a + b) b - (6 + 2 a) j - 2 g_1 - g_2
 *     = 0, \quad b = a + \tfrac12 (a^2 - g_1), @f]
 * with the invariants g_1, g_2 of G; b is the second invariant of e. By the
 * theorem of Cayley and Hamilton
 * @f[ F - R = R e = \frac1D \left[ F G + (3 + a) (F - \mathrm{cof} F)
 *     + ((4 + a) (a + b) - j) F \right], \quad
 *     D = (3 + a) (3 + 2 a + b) - 1 - j , @f]
 * D being the product of the sums of any two principal stretches. This has
 * no cancellation at small strains and no singularity at any rotation.
 *
 * Functions are templates of the lanes: OneLane here, several cells at once in
 * the block kernel.
 */
namespace quoin
{
  /** Six components of a symmetric tensor: 11, 22, 33, 12, 13, 23. */
  using SpaceTensor = std::array<double, 6>;

  /** Index of component i, j of a symmetric tensor. */
  constexpr unsigned int symmetric_index[3][3]
      = { { 0, 3, 4 }, { 3, 1, 5 }, { 4, 5, 2 } };

  /** One cell at a time. */
  struct OneLane
  {
    using Value = double;

    /** Whether a > b in any lane. */
    static bool greater(const double a, const double b)
    {
      return a > b;
    }
  };

  /** Lamé's moduli, possibly times a common factor of all stresses. */
  template <typename L>
  struct LameModuli
  {
    typename L::Value lambda;
    typename L::Value mu;
  };

  /**
   * Rotation and Biot strain of displacement gradients. Set H, call
   * find_tensors() and find_trace(), then the rest.
   */
  template <typename L>
  struct PolarDecomposition
  {
    using Value = typename L::Value;

    Value H[3][3];   /**< displacement gradient */
    Value G[6];      /**< F^T F - I */
    Value K[3][3];   /**< F - cof F */
    Value j;         /**< det F - 1 */
    Value a;         /**< tr e */
    Value factor;    /**< (4 + a) (a + b) - j */
    Value inverse_D; /**< 1/D */

    /** G, K and j of the gradient H. */
    [[gnu::always_inline]] inline void find_tensors()
    {
      Value cofactor[3][3];
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int s = 0; s < 3; ++s)
        {
          const auto &p = H[(r + 1) % 3], &q = H[(r + 2) % 3];
          cofactor[r][s] = p[(s + 1) % 3] * q[(s + 2) % 3]
                           - p[(s + 2) % 3] * q[(s + 1) % 3];
        }
      const Value trace = H[0][0] + H[1][1] + H[2][2];
      j = trace + (cofactor[0][0] + cofactor[1][1] + cofactor[2][2])
          + (H[0][0] * cofactor[0][0] + H[0][1] * cofactor[0][1]
             + H[0][2] * cofactor[0][2]);
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int s = r; s < 3; ++s)
        {
          const Value twice        = H[r][s] + H[s][r];
          G[symmetric_index[r][s]] = twice + H[0][r] * H[0][s]
                                     + H[1][r] * H[1][s] + H[2][r] * H[2][s];
          if (r == s)
            K[r][r] = (twice - trace) - cofactor[r][r];
          else
          {
            K[r][s] = twice - cofactor[r][s];
            K[s][r] = twice - cofactor[s][r];
          }
        }
    }

    /** Finds tr e by Newton's method and what follows from it. */
    [[gnu::always_inline]] inline void find_trace()
    {
      find_trace([](unsigned int) {});
    }

    /**
     * Finds tr e, as above, by a chain of dependent operations that is longer
     * than a processor looks ahead. Between them @p meanwhile, called with 0
     * and then with 1, may do something else, in two parts and without
     * branches.
     */
    template <typename Meanwhile>
    [[gnu::always_inline]] inline void find_trace(const Meanwhile &meanwhile)
    {
      const Value g1     = G[0] + G[1] + G[2];
      const Value square = (G[0] * G[0] + G[1] * G[1] + G[2] * G[2])
                           + 2. * (G[3] * G[3] + G[4] * G[4] + G[5] * G[5]);
      const Value g2   = 0.5 * (g1 * g1 - square);
      const Value rest = 6. * j + (g1 + g1 + g2);

      const Value one_j          = 1. + j;
      const auto product_of_sums = [&](const Value &a, const Value &b) -> Value
      { return (3. + a) * ((3. + b) + (a + a)) - one_j; };
      // phi, of which the derivative is 2 D.
      const auto residual = [&](const Value &a, const Value &b) -> Value
      { return (10. + 4. * a - 2. * j) * a + ((6. + 4. * a + b) * b - rest); };

      // From the Taylor series up to G^2 one step leaves |G|^5 / 160 of the
      // strain, below rounding for strains of less than 5e-4; its square is
      // below rounding, too.
      const Value eighth  = 0.125 * square;
      const Value a0      = 0.5 * g1 - eighth;
      const Value b0      = 0.5 * a0 * a0 - eighth;
      const Value inverse = 1. / product_of_sums(a0, b0);
      meanwhile(0);
      const Value step  = 0.5 * residual(a0, b0) * inverse;
      const Value slope = ((3. + b0) + (a0 + a0)) + (3. + a0) * (3. + a0);
      a                 = a0 - step;
      Value b           = b0 - step * (1. + a0);
      inverse_D         = inverse + inverse * inverse * slope * step;
      meanwhile(1);
      if (L::greater(square, Value{} + 1e-6))
      {
        // Newton's method from above, where it converges monotonically.
        a = 0.5 * g1;
        Value step;
        unsigned int n = 0;
        do
        {
          b    = a + 0.5 * (a * a - g1);
          step = 0.5 * residual(a, b) / product_of_sums(a, b);
          a -= step;
        } while (L::greater(step * step, Value{} + 1e-20) && ++n < 100);
        b         = a + 0.5 * (a * a - g1);
        inverse_D = 1. / product_of_sums(a, b);
      }
      factor = (4. + a) * (a + b) - j;
    }

    /** P = R (lambda tr e I + 2 mu e): first Piola-Kirchhoff stress of
        isotropic elasticity. P F^T is symmetric: no moment. */
    [[gnu::always_inline]] inline void
    elastic_stress(const LameModuli<L> &moduli, Value (&P)[3][3]) const
    {
      elastic_stress(moduli.lambda * a, moduli.mu, P);
    }

    /** The elastic stress with @p isotropic in place of lambda tr e. */
    [[gnu::always_inline]] inline void elastic_stress(const Value &isotropic,
                                                      const Value &mu,
                                                      Value (&P)[3][3]) const
    {
      // 2 mu (F - R) + isotropic (F - (F - R))
      const Value s       = (mu + mu - isotropic) * inverse_D;
      const Value forward = s * factor + isotropic;
      combine(s, forward, P);
    }

    /** R and e, component i, j of which is at symmetric_index[i][j]. */
    [[gnu::always_inline]] inline void rotation_and_strain(Value (&R)[3][3],
                                                           Value (&e)[6]) const
    {
      Value Re[3][3];
      combine(inverse_D, inverse_D * factor, Re);
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
        {
          R[r][c] = H[r][c] - Re[r][c];
          if (r == c)
            R[r][c] += 1.;
        }
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = r; c < 3; ++c)
          e[symmetric_index[r][c]]
              = R[0][r] * Re[0][c] + R[1][r] * Re[1][c] + R[2][r] * Re[2][c];
    }

    /** Axial vector y of a skew Y by that of Y U + U Y, w:
        (tr U I - U) y = w. */
    [[gnu::always_inline]] inline void solve_spin(const Value (&w)[3],
                                                  Value (&y)[3]) const
    {
      // The inverse is (U^2 + (3 + 2 a + b) I) / D.
      const Value b    = a + 0.5 * (a * a - (G[0] + G[1] + G[2]));
      const Value unit = 4. + (a + a) + b;
      for (unsigned int r = 0; r < 3; ++r)
        y[r] = inverse_D
               * (unit * w[r] + G[symmetric_index[r][0]] * w[0]
                  + G[symmetric_index[r][1]] * w[1]
                  + G[symmetric_index[r][2]] * w[2]);
    }

    /**
     * T of the first Piola-Kirchhoff stress R T of a stress S that turns with
     * the cell: the gradient of the energy S : e with respect to F,
     * T = S - 2 Z with the skew Z U + U Z = (S e - e S) / 2. The second term,
     * small as the strains are, makes the moment of the forces vanish.
     */
    [[gnu::always_inline]] inline void turning_stress(const Value (&S)[6],
                                                      const Value (&e)[6],
                                                      Value (&T)[3][3]) const
    {
      Value w[3], y[3];
      commutator(S, e, w);
      solve_spin(w, y);
      for (unsigned int r = 0; r < 3; ++r)
      {
        const unsigned int p = (r + 1) % 3, q = (r + 2) % 3;
        T[r][r] = S[r];
        T[q][p] = S[symmetric_index[p][q]] - y[r];
        T[p][q] = S[symmetric_index[p][q]] + y[r];
      }
    }

    /** Axial vector of A B - B A of symmetric tensors. */
    [[gnu::always_inline]] static inline void
    commutator(const Value (&A)[6], const Value (&B)[6], Value (&w)[3])
    {
      const auto product = [&](const unsigned int r, const unsigned int c)
      {
        return Value(A[symmetric_index[r][0]] * B[symmetric_index[0][c]]
                     + A[symmetric_index[r][1]] * B[symmetric_index[1][c]]
                     + A[symmetric_index[r][2]] * B[symmetric_index[2][c]]);
      };
      for (unsigned int r = 0; r < 3; ++r)
      {
        const unsigned int p = (r + 1) % 3, q = (r + 2) % 3;
        w[r] = product(q, p) - product(p, q);
      }
    }

  private:
    /** s (F G + (3 + a) (F - cof F)) + t F. */
    [[gnu::always_inline]] inline void combine(const Value &s, const Value &t,
                                               Value (&result)[3][3]) const
    {
      const Value sum = s * (3. + a);
      Value T[6];
      for (unsigned int k = 0; k < 6; ++k)
        T[k] = k < 3 ? s * G[k] + t : s * G[k];
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
          result[r][c] = T[symmetric_index[r][c]] + sum * K[r][c]
                         + H[r][0] * T[symmetric_index[0][c]]
                         + H[r][1] * T[symmetric_index[1][c]]
                         + H[r][2] * T[symmetric_index[2][c]];
    }
  };

  /** The polar decomposition of one displacement gradient. */
  struct SpaceStrain
  {
    PolarDecomposition<OneLane> polar;
    double R[3][3];
    SpaceTensor e; /**< in the frame that rotates with R */

    SpaceStrain() = default;

    explicit SpaceStrain(const double (&H)[3][3])
    {
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
          polar.H[r][c] = H[r][c];
      polar.find_tensors();
      polar.find_trace();
      double strain[6];
      polar.rotation_and_strain(R, strain);
      for (unsigned int i = 0; i < 6; ++i)
        e[i] = strain[i];
    }

    /** T of the first Piola-Kirchhoff stress R T of a stress @p s in the
        rotating frame, see PolarDecomposition::turning_stress(). */
    void turning_stress(const SpaceTensor &s, double (&T)[3][3]) const
    {
      double stress[6], strain[6];
      for (unsigned int i = 0; i < 6; ++i)
      {
        stress[i] = s[i];
        strain[i] = e[i];
      }
      polar.turning_stress(stress, strain, T);
    }

    /** R t R^T: from the rotating frame to the fixed one. */
    SpaceTensor to_global(const SpaceTensor &t) const
    {
      return turned(t,
                    [this](unsigned int i, unsigned int k) { return R[i][k]; });
    }

    /** R^T t R: from the fixed frame to the rotating one. */
    SpaceTensor to_rotating(const SpaceTensor &t) const
    {
      return turned(t,
                    [this](unsigned int i, unsigned int k) { return R[k][i]; });
    }

  private:
    template <typename Rotation>
    static SpaceTensor turned(const SpaceTensor &t, const Rotation &Q)
    {
      SpaceTensor result{};
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          for (unsigned int k = 0; k < 3; ++k)
            for (unsigned int l = 0; l < 3; ++l)
              result[symmetric_index[i][j]]
                  += Q(i, k) * t[symmetric_index[k][l]] * Q(j, l);
      return result;
    }
  };
} // namespace quoin

#endif
