// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_eigen_core_h
#define quoin_base_eigen_core_h

#include <quoin/base/intrinsics.h>

// GCC 12 warns of reads beyond small matrices in wide loads of Eigen that are
// never executed. Include this before other headers of Eigen.

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Warray-bounds"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <Eigen/Core>
#pragma GCC diagnostic pop

#endif
