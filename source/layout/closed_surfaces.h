// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_layout_closed_surfaces_h
#define quoin_source_layout_closed_surfaces_h

#include <quoin/layout/block_surfaces.h>

namespace quoin
{
  struct Facet
  {
    std::vector<unsigned int> corners; /**< in order around it */
    std::string object;                /**< it hangs together with others of */
    std::string group;
  };

  /** Facets as they stand in a file. */
  struct FacetSoup
  {
    std::vector<dealii::Point<3>> points; /**< [m] */
    std::vector<Facet> facets;
    unsigned int n_ignored = 0; /**< lines of kinds that are not read */
  };

  /** The closed surfaces of @p soup; see read_block_surfaces(). */
  BlockSurfaces closed_surfaces(FacetSoup &soup, const std::string &file);
} // namespace quoin

#endif
