// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_intrinsics_h
#define quoin_base_intrinsics_h

// GCC 12 warns of uninitialised reads in its own AVX-512 intrinsics. Warnings
// are switched off by the place of the code, so this header must come before
// others that include immintrin.h.

#ifdef __AVX__
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop
#endif

#endif
