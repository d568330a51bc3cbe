// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_fourier_plan_h
#define quoin_base_fourier_plan_h

#include <quoin/base/exceptions.h>

#include <fftw3.h>

#include <memory>

namespace quoin
{
  using FourierPlan
      = std::unique_ptr<fftw_plan_s, decltype(&fftw_destroy_plan)>;

  /** Owns @p plan of FFTW. Throws a RunError if FFTW could not create one. */
  inline FourierPlan owned(const fftw_plan plan)
  {
    if (!plan)
      throw RunError("A Fourier transform could not be planned: memory may be "
                     "short.");
    return { plan, &fftw_destroy_plan };
  }
} // namespace quoin

#endif
