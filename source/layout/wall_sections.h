// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_wall_sections_h
#define quoin_layout_wall_sections_h

#include <quoin/layout/wall_parameters.h>

#include <vector>

namespace quoin
{
  /** The openings of the entry 'Openings', in courses from 1 to @p n_courses.
   */
  std::vector<WallOpening> read_openings(const ParameterSection &section,
                                         unsigned int n_courses);

  /**
   * The segments of a wall in three dimensions, none of a plane wall; the
   * length of @p wall becomes that of all of them. Their openings are all in
   * the first storey, with courses counted through all storeys. Throws an
   * InputError about entries that do not go with the dimension.
   */
  void read_segments(const ParameterSection &top, WallParameters &wall);

  /**
   * Gives the segments of @p wall the openings of its storeys, and checks how
   * they meet and whether their bond can be laid in three dimensions.
   */
  void check_segments(const ParameterSection &top, WallParameters &wall);
} // namespace quoin

#endif
