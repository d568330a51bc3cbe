// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_native_lanes_h
#define quoin_base_native_lanes_h

namespace quoin
{
  /** Doubles in a register of the processor that is compiled for. */
#ifdef __AVX512F__
  constexpr unsigned int native_lanes = 8;
#else
  constexpr unsigned int native_lanes = 4;
#endif
} // namespace quoin

#endif
