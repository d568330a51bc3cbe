// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_elements_tetrahedron_h
#define quoin_block_elements_tetrahedron_h

#include <quoin/materials/linear_elastic.h>
#include <quoin/materials/space_strain.h>

#include <array>

/**
 * The constant-strain tetrahedron in a frame that rotates with it.
 *
 * As for the triangle the displacement gradient H is taken from differences
 * of displacements, and with F = I + H = R U the strain is Biot's, e = U - I;
 * see PolarDecomposition.
 *
 * det F has a sign: an inverted tetrahedron has one negative stretch, and its
 * forces push it back. They are no longer unique where the two smallest
 * stretches add up to zero, D = 0.
 *
 * Functions are templates of the lanes: OneLane here, several cells at once in
 * the block kernel.
 */
namespace quoin
{
  /** Reference geometry of tetrahedra; det > 0. */
  template <typename L>
  struct Tetrahedron
  {
    using Value = typename L::Value;

    /** Row k is the gradient of the shape function of node k + 1 times
        det [m^2]. */
    Value cofactor[3][3];
    Value det; /**< six times the volume, with its sign [m^3] */

    /** @p e: reference edges from node 0 to nodes 1, 2, 3 [m]. */
    [[gnu::always_inline]] inline void set_edges(const Value (&e)[3][3])
    {
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int i = 0; i < 3; ++i)
        {
          const auto &a = e[(k + 1) % 3], &b = e[(k + 2) % 3];
          const unsigned int p = (i + 1) % 3, q = (i + 2) % 3;
          cofactor[k][i] = a[p] * b[q] - a[q] * b[p];
        }
      det = e[0][0] * cofactor[0][0] + e[0][1] * cofactor[0][1]
            + e[0][2] * cofactor[0][2];
    }

    /** Lets (I + @p q) act on the nodal gradients, as for a triangle. */
    void flow(const Value (&q)[6])
    {
      for (unsigned int k = 0; k < 3; ++k)
      {
        const Value c[3] = { cofactor[k][0], cofactor[k][1], cofactor[k][2] };
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            cofactor[k][i] += q[symmetric_index[i][j]] * c[j];
      }
    }

    /** Gradient H_ij = d u_i / d X_j of a field by its values at nodes 1, 2, 3
        less that at node 0. */
    [[gnu::always_inline]] inline void gradient(const Value (&d)[3][3],
                                                Value (&H)[3][3]) const
    {
      const Value inverse = 1. / det;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const Value a = d[0][i] * inverse, b = d[1][i] * inverse,
                    c = d[2][i] * inverse;
        for (unsigned int j = 0; j < 3; ++j)
          H[i][j]
              = a * cofactor[0][j] + b * cofactor[1][j] + c * cofactor[2][j];
      }
    }

    /** det P grad N of nodes 1, 2, 3: their forces, if P is the first
        Piola-Kirchhoff stress times -1/6. That of node 0 is minus their sum. */
    [[gnu::always_inline]] inline void nodal_forces(const Value (&P)[3][3],
                                                    Value (&f)[3][3]) const
    {
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int i = 0; i < 3; ++i)
          f[k][i] = P[i][0] * cofactor[k][0] + P[i][1] * cofactor[k][1]
                    + P[i][2] * cofactor[k][2];
    }
  };

  /**
   * Largest squared circular frequency [1/s^2] of one free element whose mass
   * is lumped to its nodes in equal quarters; see that of the triangle. With
   * the nodal gradients b_i and the principal values alpha_k of their
   * A = sum b_i b_i^T the eigenvalues of B^T C B are mu (alpha_k + alpha_l),
   * of the shear components, and those of the matrix
   * lambda sqrt(alpha_k alpha_l) + 2 mu alpha_k delta_kl.
   */
  double largest_eigenvalue_squared_frequency(const Tetrahedron<OneLane> &cell,
                                              const SpaceStiffness &stiffness,
                                              double density);
} // namespace quoin

#endif
