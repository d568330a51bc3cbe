// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_run_fingerprint_h
#define quoin_problems_run_fingerprint_h

#include <quoin/mesh/mesh_data.h>
#include <quoin/problems/parameters.h>

#include <string>

namespace quoin
{
  /**
   * What a run must have in common with the one that it resumes: a
   * fingerprint() of all parameters, of the mesh as it was read or generated,
   * and of the files of tables and records.
   */
  std::string run_fingerprint(const Parameters &parameters,
                              const MeshData &mesh);
} // namespace quoin

#endif
