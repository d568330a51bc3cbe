// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_tdbem_regular_polygon_h
#define quoin_tests_tdbem_regular_polygon_h

#include <quoin/base/eigen_vectors.h>
#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/tdbem/convolution_quadrature.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/elastodynamics/influence_kernel.h>
#include <quoin/tdbem/laplace_matrices.h>
#include <quoin/elastodynamics/projection.h>

#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <functional>
#include <vector>

/**
 * Stability of time stepping on a regular polygon with one element on each
 * side, where a whole scheme comes down to some functions of one variable.
 *
 * In the frames of the elements all blocks (e, e + k) of a matrix are equal,
 * so that the displacements u_e = U exp(2 pi i m e / N), m = 0 ... N - 1, do
 * not mix. With the transform w of a delay by one step the equation of such a
 * mode is H_m(w) U = G_m(w) P with 2x2 matrices. Motions that grow without
 * load have the factor 1 / w in each step, with w a zero of det H_m in
 * |w| < 1; tractions without motion, of det G_m. Their number is the winding
 * number of the determinant along a circle just inside the unit circle.
 */
namespace quoin::test
{
  using Complex = std::complex<double>;

  /** The blocks (0, k) of a matrix in the frames of the elements, one by one.
   */
  template <typename Matrix>
  std::vector<Eigen::Matrix<typename Matrix::Scalar, 2, 2>>
  blocks_in_frames(const Boundary &polygon, const Matrix &matrix)
  {
    const auto frame = [](const BoundaryElement &element)
    {
      Eigen::Matrix2d result;
      result << to_eigen(element.tangent()), to_eigen(element.normal());
      return result;
    };
    const Eigen::Matrix2d first = frame(polygon.elements[0]);
    std::vector<Eigen::Matrix<typename Matrix::Scalar, 2, 2>> blocks;
    for (unsigned k = 0; k < polygon.n_elements(); ++k)
      blocks.push_back(first.transpose() * matrix.template block<2, 2>(0, 2 * k)
                       * frame(polygon.elements[k]));
    return blocks;
  }

  /**
   * The 2x2 matrices of the modes 0 ... N/2, side by side. The others are
   * mirror images, N - m of m, and have the same determinants.
   */
  template <typename Block>
  Eigen::Matrix2Xcd modes(const std::vector<Block> &blocks)
  {
    const unsigned n = unsigned(blocks.size()), n_modes = n / 2 + 1;
    Eigen::Matrix2Xcd result = Eigen::Matrix2Xcd::Zero(2, 2 * n_modes);
    for (unsigned m = 0; m < n_modes; ++m)
      for (unsigned k = 0; k < n; ++k)
        result.middleCols<2>(2 * m)
            += std::polar(1., 2. * M_PI * ((m * k) % n) / n) * blocks[k];
    return result;
  }

  /** Determinants of the modes 0 ... N/2 of G and of H at w. */
  struct Determinants
  {
    Eigen::VectorXcd G, H;
  };

  inline Determinants determinants(const Eigen::Matrix2Xcd &G,
                                   const Eigen::Matrix2Xcd &H)
  {
    Determinants result{ Eigen::VectorXcd(G.cols() / 2),
                         Eigen::VectorXcd(G.cols() / 2) };
    for (Eigen::Index m = 0; m < result.G.size(); ++m)
    {
      result.G(m) = G.middleCols<2>(2 * m).determinant();
      result.H(m) = H.middleCols<2>(2 * m).determinant();
    }
    return result;
  }

  /** Sums over the lags of a kernel, mode by mode. */
  class PolygonSymbol
  {
  public:
    /**
     * Computes the lags 0 to @p n_lags - 1. Later ones continue the last one:
     * G^n like log((n + 1) / n) and H^n like n^-3, their leading terms.
     */
    PolygonSymbol(const Boundary &polygon, const InfluenceKernel &kernel,
                  const unsigned n_lags)
    {
      const ElementRange first{ 0, 1 };
      const ElementRange all{ 0, unsigned(polygon.n_elements()) };
      Eigen::MatrixXd G_lags, H_lags;
      kernel.blocks(first, all, 0, n_lags, G_lags, H_lags);
      for (unsigned n = 0; n < n_lags; ++n)
      {
        const auto of_lag = [&](const Eigen::MatrixXd &lags)
        {
          return modes(blocks_in_frames(
              polygon,
              Eigen::MatrixXd(lags.middleCols(2 * n * all.end, 2 * all.end))));
        };
        G.push_back(of_lag(G_lags));
        H.push_back(of_lag(H_lags));
      }
      for (double n = 0.; n < 1e5; n += 1.)
      {
        G_late.push_back(std::log1p(1. / n));
        H_late.push_back(1. / (n * n * n));
      }
    }

    Determinants operator()(const Complex w) const
    {
      Eigen::Matrix2Xcd G_sum = G[0], H_sum = H[0];
      Complex power        = 1.;
      const std::size_t n0 = G.size();
      for (std::size_t n = 1; n < n0; ++n)
      {
        power *= w;
        G_sum += power * G[n];
        H_sum += power * H[n];
      }
      Complex G_tail = 0., H_tail = 0.;
      for (std::size_t n = n0; n < G_late.size() && std::norm(power) > 1e-14;
           ++n)
      {
        power *= w;
        G_tail += G_late[n] * power;
        H_tail += H_late[n] * power;
      }
      G_sum += G_tail / G_late[n0 - 1] * G.back();
      H_sum += H_tail / H_late[n0 - 1] * H.back();
      return determinants(G_sum, H_sum);
    }

  private:
    std::vector<Eigen::Matrix2Xcd> G, H;
    std::vector<double> G_late, H_late;
  };

  /**
   * The same of convolution quadrature, at once for all lags: the Laplace
   * matrices of the first element with each of the others, one after another.
   */
  inline Determinants convolution_quadrature_symbol(const Boundary &polygon,
                                                    const ElasticMedium &medium,
                                                    const double time_step,
                                                    const Projection projection,
                                                    const Complex w)
  {
    const unsigned n   = unsigned(polygon.n_elements());
    Eigen::MatrixXcd G = Eigen::MatrixXcd::Zero(2, 2 * n), H = G;
    for (unsigned k = 1; 2 * k <= n; ++k)
    {
      Boundary pair;
      pair.elements = { polygon.elements[0], polygon.elements[k] };
      const LaplaceMatrices matrices = laplace_matrices(
          pair, medium, bdf2_symbol(w) / time_step, projection);
      G.leftCols<2>()        = matrices.G.topLeftCorner<2, 2>();
      H.leftCols<2>()        = matrices.H.topLeftCorner<2, 2>();
      G.middleCols<2>(2 * k) = matrices.G.topRightCorner<2, 2>();
      H.middleCols<2>(2 * k) = matrices.H.topRightCorner<2, 2>();
    }
    // Seen in a mirror the others are the same, with opposite tangents.
    auto G_blocks = blocks_in_frames(polygon, G);
    auto H_blocks = blocks_in_frames(polygon, H);
    Eigen::Matrix2cd mirror;
    mirror << -1., 0., 0., 1.;
    for (unsigned k = n / 2 + 1; k < n; ++k)
    {
      G_blocks[k] = mirror * G_blocks[n - k] * mirror;
      H_blocks[k] = mirror * H_blocks[n - k] * mirror;
    }
    return determinants(modes(G_blocks), modes(H_blocks));
  }

  /** Numbers of zeros in |w| < radius, all modes together. */
  struct UnstableRoots
  {
    int of_G; /**< from motion to traction */
    int of_H; /**< from traction to motion */
    unsigned n_evaluations;
  };

  /**
   * Follows the phases of the determinants along the upper half circle, from
   * @p n_intervals equal ones on, each halved until the phases of both halves
   * turn by less than an eighth, so that no jump is more than a quarter. On the
   * lower half they are the conjugate ones. Two zeros of one mode are missed
   * if both are much closer to the circle than an interval is long, and no
   * further from each other than that.
   */
  inline UnstableRoots
  count_unstable_roots(const std::function<Determinants(Complex)> &symbol,
                       const unsigned n_sides, const double radius,
                       const unsigned n_intervals)
  {
    unsigned n_evaluations = 0;
    const auto at          = [&](const double angle)
    {
      ++n_evaluations;
      return symbol(std::polar(radius, angle));
    };
    const auto turns
        = [](const Eigen::VectorXcd &from, const Eigen::VectorXcd &to)
    {
      return Eigen::VectorXd((to.array() / from.array()).arg().matrix()
                             / (2. * M_PI));
    };
    const auto greatest = [](const Eigen::VectorXd &values)
    { return values.cwiseAbs().maxCoeff(); };

    Eigen::VectorXd G = Eigen::VectorXd::Zero(n_sides / 2 + 1), H = G;
    const std::function<void(double, const Determinants &, double,
                             const Determinants &)>
        follow = [&](const double begin, const Determinants &first,
                     const double end, const Determinants &last)
    {
      const double middle       = 0.5 * (begin + end);
      const Determinants half   = at(middle);
      const Eigen::VectorXd G_1 = turns(first.G, half.G),
                            G_2 = turns(half.G, last.G),
                            H_1 = turns(first.H, half.H),
                            H_2 = turns(half.H, last.H);
      if (end - begin > 1e-7
          && std::max(
                 { greatest(G_1), greatest(G_2), greatest(H_1), greatest(H_2) })
                 > 0.125)
      {
        follow(begin, first, middle, half);
        follow(middle, half, end, last);
        return;
      }
      G += G_1 + G_2;
      H += H_1 + H_2;
    };
    Determinants first = at(0.);
    for (unsigned k = 0; k < n_intervals; ++k)
    {
      const double begin      = M_PI * k / n_intervals;
      const double end        = M_PI * (k + 1) / n_intervals;
      const Determinants last = at(end);
      follow(begin, first, end, last);
      first = last;
    }

    // A mode and its mirror image are different modes except at both ends.
    const auto total = [&](const Eigen::VectorXd &half_turns)
    {
      double sum = 0.;
      for (unsigned m = 0; m < half_turns.size(); ++m)
        sum += (m == 0 || 2 * m == n_sides ? 1. : 2.) * 2. * half_turns(m);
      return int(std::lround(sum));
    };
    return { total(G), total(H), n_evaluations };
  }
} // namespace quoin::test

#endif
