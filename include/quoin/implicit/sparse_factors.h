// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_sparse_factors_h
#define quoin_implicit_sparse_factors_h

#include <quoin/base/eigen_core.h>

#include <vector>

namespace quoin
{
  /**
   * LU factors of a sparse matrix whose pattern is symmetric, its values need
   * not be: the multifrontal method (@cite DuffReid1983) on the supernodes that
   * CHOLMOD finds for an ordering by nested dissection. Ordering and supernodes
   * follow from the pattern and serve all values. Rows are exchanged within a
   * supernode only, so the caller checks what a solution leaves.
   */
  class SparseFactors
  {
  public:
    /** Takes the pattern of @p n compressed rows; false: it is not symmetric,
        and there are no factors. */
    bool analyse(int n, const int *starts, const int *columns);
    /** Factorises the matrix with the @p values of the pattern's entries;
        false: a pivot is zero. */
    bool factorise(const double *values);
    /** Solves for @p right_hand_side, n long. */
    void solve(const double *right_hand_side, double *solution);

  private:
    /** Where an entry of the matrix goes in the front of its supernode. */
    struct Entry
    {
      int value, offset;
    };
    struct Supernode
    {
      int first, n_columns, n_rows; /**< n_rows with its own columns */
      std::vector<int> rows;        /**< permuted, own columns first */
      std::vector<int> in_parent;   /**< places of the other rows there */
      std::vector<Entry> entries;
      unsigned int n_children = 0;
      Eigen::MatrixXd lower;     /**< all rows, own columns */
      Eigen::MatrixXd upper;     /**< transposed: other rows, own columns */
      Eigen::VectorXi exchanges; /**< of own rows */
    };

    /** Eliminates @p size columns of a supernode; false: a pivot is zero. */
    static bool eliminate(Supernode &node, int begin, int size);

    std::vector<int> permutation; /**< numbers in the matrix */
    std::vector<Supernode> supernodes;
    /** Updates are a stack. Aligned, as rounding of sums in registers depends
       on where these begin. */
    Eigen::VectorXd front, updates;
    Eigen::VectorXd work, gathered;
  };
} // namespace quoin

#endif
