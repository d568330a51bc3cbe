// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/tdbem/convolution_quadrature.h>

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/fourier_plan.h>
#include <quoin/elastodynamics/cut_kernels.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace quoin
{
  std::complex<double> bdf2_symbol(const std::complex<double> w)
  {
    return 1.5 - w * (2. - 0.5 * w);
  }

  Eigen::MatrixXd power_series_coefficients(
      const unsigned n, const Eigen::Index n_values,
      const std::function<void(std::complex<double>, Eigen::VectorXcd &)>
          &values)
  {
    using constants::pi;
    constexpr double aliasing = 1e-10;
    const unsigned points     = 2 * n;
    const double radius       = std::pow(aliasing, 1. / points);

    // The function is real on the real axis: half the circle says all.
    Eigen::MatrixXcd spectrum(n_values, n + 1);
    Eigen::VectorXcd at_point(n_values);
    for (unsigned k = 0; k <= n; ++k)
    {
      values(std::polar(radius, -2. * pi * k / points), at_point);
      spectrum.col(k) = at_point;
    }

    Eigen::VectorXcd row(n + 1);
    Eigen::VectorXd sums(points);
    const FourierPlan plan = owned(fftw_plan_dft_c2r_1d(
        int(points), reinterpret_cast<fftw_complex *>(row.data()), sums.data(),
        FFTW_ESTIMATE));
    Eigen::VectorXd scaling(n);
    for (unsigned k = 0; k < n; ++k)
      scaling(k) = std::pow(radius, -double(k)) / points;

    Eigen::MatrixXd coefficients(n_values, n);
    for (Eigen::Index value = 0; value < n_values; ++value)
    {
      row = spectrum.row(value).transpose();
      fftw_execute(plan.get());
      coefficients.row(value) = sums.head(n).cwiseProduct(scaling);
    }
    return coefficients;
  }

  ConvolutionQuadrature::ConvolutionQuadrature(const Boundary &boundary,
                                               const ElasticMedium &medium,
                                               const double time_step,
                                               const unsigned n_lags,
                                               const Projection projection,
                                               const RayleighDamping &damping)
    : boundary_(boundary), medium_(medium), projection_(projection),
      damping_(damping), size_(unsigned(boundary.n_unknowns())),
      time_step_(time_step)
  {
    if (!(time_step > 0.) || n_lags == 0)
      throw InputError("Convolution quadrature: the time step and the number "
                       "of lags must be positive.");
    // The square of many elements is beyond an unsigned number.
    const Eigen::Index entries = Eigen::Index(size_) * size_;
    const Eigen::MatrixXd both = power_series_coefficients(
        n_lags, 2 * entries,
        [&](const std::complex<double> w, Eigen::VectorXcd &result)
        {
          const LaplaceMatrices matrices
              = laplace_matrices(boundary, medium, bdf2_symbol(w) / time_step,
                                 projection, damping);
          result.head(entries) = matrices.G.reshaped();
          result.tail(entries) = matrices.H.reshaped();
        });
    G_ = both.topRows(entries);
    H_ = both.bottomRows(entries);
  }

  void ConvolutionQuadrature::lag(const unsigned n, Eigen::MatrixXd &G,
                                  Eigen::MatrixXd &H) const
  {
    if (n >= G_.cols())
      throw std::out_of_range("Convolution quadrature: lag " + std::to_string(n)
                              + " was not computed.");
    G = G_.col(n).reshaped(size_, size_);
    H = H_.col(n).reshaped(size_, size_);
  }

  void ConvolutionQuadrature::blocks(const ElementRange &rows,
                                     const ElementRange &columns,
                                     const unsigned begin, const unsigned end,
                                     Eigen::MatrixXd &G,
                                     Eigen::MatrixXd &H) const
  {
    if (end > G_.cols())
      throw std::out_of_range("Convolution quadrature: lag "
                              + std::to_string(end - 1) + " was not computed.");
    const unsigned n_rows = 2 * rows.size(), n_columns = 2 * columns.size();
    G.resize(n_rows, n_columns * (end - begin));
    H.resize(n_rows, n_columns * (end - begin));
    for (unsigned n = begin; n < end; ++n)
      for (unsigned k = 0; k < n_columns; ++k)
      {
        const Eigen::Index first
            = Eigen::Index(2 * columns.begin + k) * size_ + 2 * rows.begin;
        const unsigned column = (n - begin) * n_columns + k;
        G.col(column)         = G_.col(n).segment(first, n_rows);
        H.col(column)         = H_.col(n).segment(first, n_rows);
      }
  }

  unsigned ConvolutionQuadrature::first_lag(const ElementRange &rows,
                                            const ElementRange &columns,
                                            const double distance) const
  {
    // The accuracy of the matrices themselves.
    constexpr double negligible = 1e-9;
    const unsigned arrival      = unsigned(
        std::min(distance / (medium_.c1 * time_step_), double(G_.cols())));
    Eigen::MatrixXd G, H;
    blocks(rows, columns, 0, arrival, G, H);
    const double G_least = negligible * G_.lpNorm<Eigen::Infinity>();
    const double H_least = negligible * H_.lpNorm<Eigen::Infinity>();
    const unsigned width = 2 * columns.size();
    unsigned n           = 0;
    while (n < arrival
           && G.middleCols(n * width, width).lpNorm<Eigen::Infinity>() < G_least
           && H.middleCols(n * width, width).lpNorm<Eigen::Infinity>()
                  < H_least)
      ++n;
    return n;
  }

  unsigned ConvolutionQuadrature::decaying_lag(const ElasticMedium &medium,
                                               const double time_step,
                                               const double distance,
                                               const double share,
                                               const double stiffness_damping)
  {
    // The second pole of decay_factors() has lost its power by 3 a step.
    constexpr double least = 24.;
    const double travel    = distance / (medium.c2 * time_step);
    double after           = std::max(share * travel, 4. * std::sqrt(travel));
    // Stiffness damping b spreads a front over sqrt(b travel). The part of the
    // density that is left out, and what grows with the distance in it, decay
    // by the time s after the front like exp(-s^2/(2 b travel)) or exp(-s/b).
    if (share > 0.)
    {
      const double b = stiffness_damping / time_step;
      after = std::max({ after, std::sqrt(45. * b * travel), 25. * b });
    }
    return unsigned(std::min(most_lags, std::ceil(least + travel + after)));
  }

  void ConvolutionQuadrature::cut_blocks(const ElementRange &rows,
                                         const ElementRange &columns,
                                         const double lambda,
                                         Eigen::MatrixXd &G,
                                         Eigen::MatrixXd &H) const
  {
    CutKernels(medium_, lambda, damping_)
        .integrate(boundary_, rows, columns, projection_, G, H);
  }

  DecayFactors ConvolutionQuadrature::decay_factors(const double lambda) const
  {
    const double root   = std::sqrt(1. - 2. * lambda * time_step_);
    const double ratio  = 1. / (2. - root);
    const double factor = time_step_ / root * ratio;
    return { ratio, factor, factor };
  }

  std::vector<double> ConvolutionQuadrature::cut_jumps() const
  {
    if (damping_.mass > 0.)
      return { damping_.mass };
    return {};
  }

  double ConvolutionQuadrature::largest_rate() const
  {
    // Near the end itself the density has a root in the denominator.
    const double end = 0.499 / time_step_;
    return damping_.stiffness > 0. ? std::min(end, 0.9 / damping_.stiffness)
                                   : end;
  }
} // namespace quoin
