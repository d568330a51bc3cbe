// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_rtree_h
#define quoin_base_rtree_h

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>

// GCC 12 warns of boxes that are set in loops which it does not unroll.

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <boost/geometry/index/rtree.hpp>
#pragma GCC diagnostic pop

#endif
