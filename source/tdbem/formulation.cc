// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/tdbem/formulation.h>

#include <quoin/base/exceptions.h>
#include <quoin/tdbem/clustered_history.h>
#include <quoin/tdbem/convolution_quadrature.h>
#include <quoin/tdbem/direct_history.h>
#include <quoin/tdbem/influence_matrices.h>
#include <quoin/tdbem/laplace_matrices.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace quoin
{
  namespace
  {
    /** Far more than travelling times of boundaries that fit into memory. */
    constexpr unsigned long most_compressed_lags = 20000;

    std::string text(const double value)
    {
      std::ostringstream stream;
      stream << value;
      return stream.str();
    }

    ClusteredHistory::Options
    clustered_options(const FormulationOptions &options)
    {
      ClusteredHistory::Options result;
      result.tolerance = options.tolerance;
      result.n_steps   = options.n_steps;
      return result;
    }
  } // namespace

  std::unique_ptr<InfluenceKernel>
  make_lag_kernel(const Boundary &boundary, const ElasticMedium &medium,
                  const FormulationOptions &options)
  {
    if (options.formulation == Formulation::convolution_quadrature)
    {
      if (options.decay != 0.)
        throw InputError("Boundary elements: decay is not for convolution "
                         "quadrature. Use Rayleigh damping.");
      // Lags of the compressed history and one to compare the rest with.
      const unsigned long n_lags
          = options.direct_history
                ? options.n_steps
                : std::min(ConvolutionQuadrature::decaying_lag(
                               medium, options.time_step, boundary.diameter(),
                               ClusteredHistory::Options().share,
                               options.damping.stiffness),
                           ClusteredHistory::lags_wanted(options.n_steps))
                      + 2;
      if (!options.direct_history && n_lags > most_compressed_lags)
        throw InputError(
            "section 'Boundary elements': 'Stiffness damping = "
            + text(options.damping.stiffness) + "' spreads waves so far that "
            + std::to_string(n_lags)
            + " lags would have to be kept. Give less, longer time steps, or, "
              "for a short run, 'History = direct'.");
      return std::make_unique<ConvolutionQuadrature>(
          boundary, medium, options.time_step, unsigned(n_lags),
          Projection::galerkin, options.damping);
    }
    if (options.damping.mass != 0. || options.damping.stiffness != 0.)
      throw InputError("Boundary elements: Rayleigh damping needs the "
                       "formulation convolution quadrature.");
    InfluenceMatrices::Options lag_options;
    lag_options.projection = options.formulation == Formulation::galerkin
                                 ? Projection::galerkin
                                 : Projection::collocation;
    lag_options.decay      = options.decay;
    return std::make_unique<InfluenceMatrices>(boundary, medium,
                                               options.time_step, lag_options);
  }

  std::unique_ptr<BoundaryHistory>
  make_history(const InfluenceKernel &kernel, const Boundary &boundary,
               const FormulationOptions &options, MPI_Comm communicator)
  {
    if (options.direct_history)
      return std::make_unique<DirectHistory>(kernel);
    return std::make_unique<ClusteredHistory>(
        kernel, boundary, clustered_options(options), communicator);
  }

  ZTransform
  make_transform(const InfluenceKernel &kernel, const BoundaryHistory &history,
                 const Boundary &boundary, const ElasticMedium &medium,
                 const FormulationOptions &options, MPI_Comm communicator)
  {
    if (const auto clustered = dynamic_cast<const ClusteredHistory *>(&history))
      return clustered->transform(kernel);
    if (options.formulation == Formulation::convolution_quadrature)
      return
          [&boundary, &medium, dt = options.time_step,
           damping = options.damping](const std::complex<double> w,
                                      Eigen::MatrixXcd &G, Eigen::MatrixXcd &H)
      {
        LaplaceMatrices matrices
            = laplace_matrices(boundary, medium, bdf2_symbol(w) / dt,
                               Projection::galerkin, damping);
        G.swap(matrices.G);
        H.swap(matrices.H);
      };
    // The direct sum has no end to its lags.
    const auto clustered = std::make_shared<ClusteredHistory>(
        kernel, boundary, clustered_options(options), communicator);
    return [clustered, transform = clustered->transform(kernel)](
               const std::complex<double> w, Eigen::MatrixXcd &G,
               Eigen::MatrixXcd &H) { transform(w, G, H); };
  }
} // namespace quoin
