// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_reinforcement_bar_placement_h
#define quoin_reinforcement_bar_placement_h

#include <quoin/base/thickness.h>
#include <quoin/base/node_record.h>
#include <quoin/mesh/node_map.h>
#include <quoin/reinforcement/bar_chain.h>
#include <quoin/reinforcement/cable_parameters.h>

#include <array>
#include <limits>
#include <vector>

namespace quoin
{
  /** A point of a cell, on a bar. */
  struct BarHost
  {
    std::array<unsigned int, 3> nodes;  /**< local */
    std::array<unsigned int, 3> places; /**< of the nodes in PlacedBar::nodes */
    std::array<double, 3> weights;      /**< [-] */
    unsigned int block;
    unsigned int cell;  /**< own deformable cell, or NodeMap::none */
    dealii::Point<2> X; /**< [m] */
  };
  /** Both sides of a joint where a bar crosses it. */
  struct BarDowel
  {
    BarHost near, far;
    unsigned int element;
  };
  /** A bolt or cable and the cells that it lies in. */
  struct PlacedBar
  {
    unsigned int cable = 0; /**< number of its section */
    BarLaw law;             /**< in the thickness of the model */
    double number;          /**< of bars in that thickness [-] */
    dealii::Tensor<1, 2> direction;
    BarChain chain;
    std::vector<BarHost> hosts;
    std::vector<BarDowel> dowels;
    /** Places where it crosses joints. */
    std::vector<dealii::Point<2>> crossings;
    /** The longest active length for which its bonded parts beside joints have
        room: a longer one is cut [m]. */
    double longest_active_length = std::numeric_limits<double>::infinity();
    /** Local nodes of all hosts, those of the far end first. */
    std::vector<unsigned int> nodes;
  };

  /** Displacement of a point of a cell [m]. */
  dealii::Tensor<1, 2> displacement_of(const BarHost &host,
                                       const NodeRecord<2> *nodes);

  /** The bar of @p given from @p ends[0] to @p ends[1] [m] through the cells
      @p crossed; @p thickness of each cell group [m]. Throws an InputError
     about a bar that does not lie in blocks. */
  PlacedBar place_bar(const CableParameters &given, const BarEnds &ends,
                      const std::vector<CrossedCell> &crossed,
                      const NodeMap<2> &nodes, const Thickness &thickness);
} // namespace quoin

#endif
