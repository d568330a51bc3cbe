// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_formulation_h
#define quoin_tdbem_formulation_h

#include <quoin/elastodynamics/boundary.h>
#include <quoin/tdbem/boundary_history.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/elastodynamics/influence_kernel.h>
#include <quoin/elastodynamics/laplace_kernels.h>
#include <quoin/tdbem/passivity.h>

#include <mpi.h>

#include <memory>

namespace quoin
{
  /** The ways to discretise the boundary integral equation. */
  enum class Formulation
  {
    galerkin,    /**< InfluenceMatrices, in the mean over each element */
    collocation, /**< InfluenceMatrices, at the middles of the elements */
    convolution_quadrature /**< ConvolutionQuadrature, in the mean */
  };

  /** Options of a formulation. */
  struct FormulationOptions
  {
    Formulation formulation = Formulation::galerkin;
    double time_step        = 0.; /**< [s] */

    /** Decay of InfluenceMatrices [1/s]; not for convolution quadrature. */
    double decay = 0.;
    /** Rayleigh damping, for convolution quadrature only. */
    RayleighDamping damping = {};

    /** Whether the history is summed directly, at growing cost. */
    bool direct_history = false;
    /** Relative tolerance of the compressed history. */
    double tolerance = 1e-6;
    /** Largest number of steps. */
    unsigned long n_steps = 1000000;
  };

  /** The kernel of @p options. Throws InputError about wrong options. */
  std::unique_ptr<InfluenceKernel>
  make_lag_kernel(const Boundary &boundary, const ElasticMedium &medium,
                  const FormulationOptions &options);

  /**
   * The history of @p options. The rows of a compressed one are shared by the
   * ranks of @p communicator. @p kernel must be of the same boundary, medium
   * and options and must outlive a direct history.
   */
  std::unique_ptr<BoundaryHistory>
  make_history(const InfluenceKernel &kernel, const Boundary &boundary,
               const FormulationOptions &options, MPI_Comm communicator);

  /**
   * G(w) and H(w) over all lags without end, for scan_passivity(). @p kernel
   * and @p history must be of the same boundary, medium and options and
   * outlive the result. Collective, as its calls are.
   */
  ZTransform
  make_transform(const InfluenceKernel &kernel, const BoundaryHistory &history,
                 const Boundary &boundary, const ElasticMedium &medium,
                 const FormulationOptions &options, MPI_Comm communicator);
} // namespace quoin

#endif
