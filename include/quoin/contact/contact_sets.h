// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_contact_contact_sets_h
#define quoin_contact_contact_sets_h

#include <quoin/joint_laws/joint_parameters.h>

#include <string>
#include <vector>

namespace quoin
{
  /** No set says how two materials touch. */
  constexpr unsigned int no_contact_set = -1;

  /**
   * The set that new contacts between two of @p materials follow: entry
   * i n + j of a square table is an index into @p sets, or no_contact_set.
   * Throws an InputError about unknown materials and pairs named twice.
   */
  std::vector<unsigned int>
  sets_of_new_contacts(const std::vector<JointSetParameters> &sets,
                       const std::vector<std::string> &materials);
} // namespace quoin

#endif
