// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_influence_matrices_h
#define quoin_tdbem_influence_matrices_h

#include <quoin/elastodynamics/boundary.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/elastodynamics/influence_kernel.h>
#include <quoin/elastodynamics/projection.h>
#include <quoin/elastodynamics/time_kernels.h>

#include <array>
#include <memory>
#include <vector>

namespace quoin
{
  /**
   * Influence matrices of each time lag, for the boundary integral equation of
   * elastodynamics in the time domain (@cite JinWangZhang1998, Eqs. 2-10) on
   * straight elements: tractions and velocities are constant on an element
   * during a time step, and the equation holds at the end of each step.
   *
   * Let A_n and B_n be the integrals of the kernels of time_kernels.h over
   * the elements at the time (n + 1) dt, zero for n < 0. Then
   * @f[ G^n = A_n - A_{n-1}, \quad
   *     H^n = \frac{B_n - 2 B_{n-1} + B_{n-2}}{\Delta t}
   *           + \frac{\delta_{n0}}{2} I . @f]
   * Row 2 e + j is the equation of a force in direction j on element e, column
   * 2 f + i belongs to component i on element f. In the statics of a closed
   * curve the sum of H^n over all lags and elements is zero for a domain inside
   * and the identity for one outside.
   *
   * The original places the equation at the middle of each element, which is
   * unstable for small steps. Averaging it over each element instead gives
   * the energetic scheme, because tractions that are constant in each step
   * make the average of the power over a step a difference between the ends
   * of that step; then also G^n is symmetric once its rows are multiplied by
   * the length of their elements. That average is taken by quadrature, in
   * pieces between the points where a wave front touches an end or the foot
   * of the source on the other element; the inner integral is exact. Pairs of
   * elements far from each other and from the fronts are integrated by
   * quadrature in both. Relative errors of A_n and B_n are below 1e-6 of their
   * greatest entries.
   */
  class InfluenceMatrices : public InfluenceKernel
  {
  public:
    struct Options
    {
      Projection projection = Projection::galerkin;

      /**
       * Rate alpha [1/s] of the decay exp(-alpha n dt) of both matrices
       * (@cite JinWangZhang1998, Eqs. 11-13): damping ratio times circular
       * frequency of the mode that has this ratio. It makes the ground softer
       * also in statics.
       */
      double decay = 0.;

      /**
       * Whether the rounding and quadrature errors in the symmetry of the
       * Galerkin scheme's A are averaged out.
       */
      bool symmetrise = true;
    };

    /** @p time_step in seconds. */
    InfluenceMatrices(const Boundary &boundary, const ElasticMedium &medium,
                      double time_step);
    InfluenceMatrices(const Boundary &boundary, const ElasticMedium &medium,
                      double time_step, const Options &options);

    unsigned size() const override;
    double time_step() const override;

    /**
     * Cheapest if called for consecutive lags, whose integrals are kept. Not
     * to be called by two threads at once.
     */
    void lag(unsigned n, Eigen::MatrixXd &G, Eigen::MatrixXd &H) const override;

    void blocks(const ElementRange &rows, const ElementRange &columns,
                unsigned begin, unsigned end, Eigen::MatrixXd &G,
                Eigen::MatrixXd &H) const override;
    unsigned first_lag(const ElementRange &rows, const ElementRange &columns,
                       double distance) const override;
    unsigned first_decaying_lag(double distance, double share) const override;
    void cut_blocks(const ElementRange &rows, const ElementRange &columns,
                    double lambda, Eigen::MatrixXd &G,
                    Eigen::MatrixXd &H) const override;
    DecayFactors decay_factors(double lambda) const override;

    /** The integrals A [m^2/N] and B [s] over all elements at a time [s]. */
    struct Integrals
    {
      Eigen::MatrixXd A, B;
    };

    Integrals integrals(double time) const;

  private:
    /** A straight element with its frame. */
    struct Element
    {
      BoundaryElement shape;
      dealii::Point<2> a, b;
      dealii::Tensor<1, 2> tangent, normal;
      double length;
    };

    /** Two elements, and the distances between points of them [m]. */
    struct Pair
    {
      const Element &e, &f;
      double nearest, farthest;
    };

    /** Blocks of the equation of each element of a pair on the other. */
    struct PairIntegrals
    {
      Eigen::Matrix2d A_ef, B_ef, A_fe, B_fe;
    };

    Pair pair(unsigned e, unsigned f) const;
    /** Integrals of @p pair; collocation leaves out those of the equation of
        the second element. */
    PairIntegrals integrate(const Pair &pair, double time) const;
    TimeKernels near_integral(const Element &outer, const Element &inner,
                              double time, bool close) const;
    PairIntegrals far_integrals(const Pair &pair, double time,
                                unsigned n_points) const;
    const Integrals &at_step(unsigned step) const;

    Boundary boundary;
    std::vector<Element> elements;
    ElasticMedium medium;
    double dt;
    Options options;

    /** The last three times, by step modulo three. */
    struct Recent
    {
      unsigned step;
      std::unique_ptr<const Integrals> integrals;
    };
    mutable std::array<Recent, 3> recent;
  };
} // namespace quoin

#endif
