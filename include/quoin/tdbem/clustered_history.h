// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_clustered_history_h
#define quoin_tdbem_clustered_history_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/tdbem/boundary_history.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/elastodynamics/influence_kernel.h>
#include <quoin/tdbem/passivity.h>

#include <mpi.h>

#include <algorithm>
#include <vector>

namespace quoin
{
  /**
   * The history at a cost that does not grow with the number of steps.
   *
   * The boundary is cut into clusters of neighbouring elements. Between two of
   * them the matrices of only those lags are kept in which waves pass: from
   * the first arrival of the P wave until some time after the last of the S
   * wave. The rest is a sum of exponentials of the lag (CutKernels): Gauss's
   * rule in each octave of the decay rate lambda, from that of the longest
   * time to that which no longer matters after the shortest. Of the kernel of
   * each rate only the parts in a few directions matter, found by the singular
   * values over all partners of a cluster and all rates; and what is left of
   * the many rates is a few mixtures of them. So the sum is a recursion for a
   * few numbers per rate.
   *
   * History that is known at the start of a block of steps is applied to all
   * of them at once, as a product of matrices: the tractions and displacements
   * of a cluster are kept step after step, and the same memory, read with a
   * shift by one step per column, is the matrix that the lags are multiplied
   * with. What happens within the block is added step by step.
   *
   * Each rank holds the equations of some clusters, and all of the history.
   */
  class ClusteredHistory : public BoundaryHistory
  {
  public:
    struct Options
    {
      /** Relative, of each block's matrices and of the sum. */
      double tolerance = 1e-6;
      /** Number of steps for which the sum of exponentials must be accurate. */
      unsigned long n_steps = 1000000;
      /** Largest number of elements of a cluster; 0: from the number of
       * elements. */
      unsigned cluster_size = 0;
      /** Steps for which known history is applied at once; 0: by number. */
      unsigned block_size = 0;
      /**
       * How long after the last S wave matrices are kept, as a share of its
       * travelling time.
       */
      double share = 0.25;
    };

    /** The most lags that a run of @p n_steps needs. */
    static unsigned lags_wanted(const unsigned long n_steps)
    {
      return unsigned(std::clamp<double>(double(n_steps), 64., most_lags));
    }

    /** Needs the kernel only here. Collective. */
    ClusteredHistory(const InfluenceKernel &kernel, const Boundary &boundary,
                     const Options &options, MPI_Comm communicator);

    const Eigen::VectorXd &predict() override;
    void push(const Eigen::VectorXd &u, const Eigen::VectorXd &p) override;

    unsigned long n_steps() const override
    {
      return step;
    }

    SavedHistory save() const override;
    void restore(const SavedHistory &saved) override;

    /** Bytes of the matrices on this rank. */
    std::size_t memory() const;

    /** The most lags that are kept between two clusters. */
    unsigned n_lags() const
    {
      return longest;
    }

    unsigned period() const override
    {
      return block_size();
    }
    /** Steps for which known history is applied at once. */
    unsigned block_size() const
    {
      return options.block_size;
    }

    /**
     * The largest difference between the first matrix that is left to the
     * exponentials and itself, relative to the largest of that lag: how well
     * the tolerance is kept. Collective; costs as much as one lag.
     */
    double decay_error(const InfluenceKernel &kernel) const;

    /**
     * Sums G(w) and H(w) over all lags without end, as z_transform(), from
     * what is kept. Collective, if there are several ranks; they must request
     * the same w.
     */
    ZTransform transform(const InfluenceKernel &kernel) const;

  private:
    struct Cluster
    {
      ElementRange elements;
      Eigen::MatrixXd row_basis;    /**< basis of the equations */
      Eigen::MatrixXd column_basis; /**< basis of tractions and displacements */
      /** Tractions over traction_scale, then displacements, step by step. */
      std::vector<double> past;
      /** column_basis^T times these. */
      std::vector<double> moments;

      unsigned n_values() const
      {
        return 4 * elements.size();
      }

      unsigned n_moments() const
      {
        return unsigned(column_basis.cols());
      }
    };

    struct Pair
    {
      unsigned row = 0, column = 0; /**< clusters */
      unsigned begin = 0, end = 0;  /**< lags that are kept */
      double surplus = 0.; /**< time since the S wave, at the end [s] */
      /** Matrices of the lags end - 1 to begin, side by side. */
      Eigen::MatrixXd matrices;
      unsigned n_rates = 0; /**< the slowest ones */
      /** Matrices between the bases, side by side for mixtures of the rates. */
      Eigen::MatrixXd decaying;
      /** The share of each rate, a row, in each mixture. */
      Eigen::MatrixXd mixtures;
      /** A column for each rate. */
      Eigen::MatrixXd state;
    };

    struct Rate
    {
      double lambda; /**< [1/s] */
      double weight; /**< weight of Gauss's rule [1/s] */
      DecayFactors factors;
    };

    void make_clusters(const Boundary &boundary, unsigned size);
    void share_clusters();
    void make_pairs(const InfluenceKernel &kernel, const Boundary &boundary,
                    double share);
    void make_rates(const InfluenceKernel &kernel);
    void make_bases(const InfluenceKernel &kernel);
    void fill(const InfluenceKernel &kernel, Pair &pair) const;
    bool is_mine(const Pair &pair) const;
    unsigned first_row(const Pair &pair) const;
    Eigen::MatrixXd cut_matrix(const InfluenceKernel &kernel, const Pair &pair,
                               unsigned rate) const;
    Eigen::MatrixXd stacked(const Eigen::MatrixXd &G,
                            const Eigen::MatrixXd &H) const;
    void make_room();
    void begin_block();

    Options options;
    MPI_Comm communicator;
    double time_step;
    double traction_scale; /**< [Pa/m] */
    unsigned longest = 0;

    std::vector<Rate> rates; /**< ascending */
    std::vector<Cluster> clusters;
    /** Clusters of this rank's rows. */
    unsigned first_cluster = 0, end_cluster = 0;
    /** Row counts and offsets of the ranks. */
    std::vector<int> row_counts, row_offsets;
    std::vector<Pair> pairs; /**< pairs of this rank's rows */

    unsigned long step = 0;
    long first_kept    = 0; /**< step of the first values in past */
    bool block_begun   = false;
    unsigned in_block  = 0; /**< steps taken in it */
    /** Values of this rank's rows, one column per step. */
    Eigen::MatrixXd block;
    Eigen::VectorXd local, sum;
  };
} // namespace quoin

#endif
