// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_blas_kernels_h
#define quoin_base_blas_kernels_h

namespace quoin
{
  /**
   * Lets OpenBLAS compute with one thread and with the kernels that suit the
   * processor: one that is newer than the library has its slowest kernels, for
   * SSE3, although it has AVX2 or AVX-512, and boundary elements take twice as
   * long. What the environment variable OPENBLAS_CORETYPE says stays. Before
   * the first matrix product.
   */
  void choose_blas_kernels();
} // namespace quoin

#endif
