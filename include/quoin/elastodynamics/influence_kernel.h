// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_influence_kernel_h
#define quoin_elastodynamics_influence_kernel_h

#include <quoin/base/eigen_core.h>

#include <limits>
#include <vector>

namespace quoin
{
  /** A number of time lags that no memory can hold. */
  constexpr double most_lags = 1e9;

  /** Elements begin to end - 1 of a boundary. */
  struct ElementRange
  {
    unsigned begin;
    unsigned end;

    unsigned size() const
    {
      return end - begin;
    }
  };

  /**
   * What a kernel exp(-lambda t) in time becomes after discretisation: its
   * matrices of lag n are @p ratio to the power n times G, or times H.
   */
  struct DecayFactors
  {
    double ratio;
    double G; /**< [s] */
    double H; /**< [s] */
  };

  /**
   * Influence matrices of a time-stepping boundary element method, two for each
   * time lag.
   *
   * Let u^m [m] be the displacements of all elements at the time t_m = m dt
   * and p^m [Pa] their tractions, at t_m or over the step that ends then,
   * m = 1, 2, ..., and everything at rest before. A solution in the domain
   * satisfies for every M
   * @f[ \sum_{n=0}^{M-1} H^n u^{M-n} = \sum_{n=0}^{M-1} G^n p^{M-n} . @f]
   * The free term of the integral equation, one half of the displacement on
   * a straight element, is part of H^0.
   */
  class InfluenceKernel
  {
  public:
    virtual ~InfluenceKernel() = default;

    /** Number of rows, two per element. */
    virtual unsigned size() const = 0;

    /** Time step [s]. */
    virtual double time_step() const = 0;

    /**
     * Computes the matrices of lag @p n, both size() x size() and resized if
     * need be: @p G [m/Pa] and @p H [1]. Row 2 e + i is the equation of
     * component i on element e.
     */
    virtual void lag(unsigned n, Eigen::MatrixXd &G,
                     Eigen::MatrixXd &H) const = 0;

    /**
     * Computes the blocks of the elements @p rows and @p columns of the lags
     * @p begin to @p end - 1, side by side: those of lag n start at column
     * 2 (n - begin) columns.size().
     */
    virtual void blocks(const ElementRange &rows, const ElementRange &columns,
                        unsigned begin, unsigned end, Eigen::MatrixXd &G,
                        Eigen::MatrixXd &H) const = 0;

    /**
     * The first lag in which the block is not negligible, if no two of its
     * elements are closer to each other than @p distance [m].
     */
    virtual unsigned first_lag(const ElementRange &rows,
                               const ElementRange &columns,
                               double distance) const = 0;

    /**
     * The first lag from which on the block is the sum of exponentials that
     * cut_blocks() gives, if no two points of it are further from each other
     * than @p distance [m]: the S wave has passed for @p share of its
     * travelling time.
     */
    virtual unsigned first_decaying_lag(double distance,
                                        double share) const = 0;

    /**
     * The medium's kernels between rows and columns as a density of decaying
     * exponentials: once the S wave has passed, the kernels of the
     * displacement are the integral of exp(-lambda t) G(lambda) over all
     * lambda > 0, those of the traction that of exp(-lambda t) H(lambda). See
     * CutKernels. Lag n of this method has for them the factors
     * decay_factors(lambda).
     */
    virtual void cut_blocks(const ElementRange &rows,
                            const ElementRange &columns, double lambda,
                            Eigen::MatrixXd &G, Eigen::MatrixXd &H) const = 0;

    virtual DecayFactors decay_factors(double lambda) const = 0;

    /** Rates at which the density jumps, ascending [1/s]. */
    virtual std::vector<double> cut_jumps() const
    {
      return {};
    }

    /** The rate at which the density ends [1/s]. */
    virtual double largest_rate() const
    {
      return std::numeric_limits<double>::infinity();
    }
  };
} // namespace quoin

#endif
