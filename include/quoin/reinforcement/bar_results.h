// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_reinforcement_bar_results_h
#define quoin_reinforcement_bar_results_h

#include <quoin/reinforcement/reinforcement.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /** What histories record of bars, forces of one bar [N]. */
  enum class CableQuantity : unsigned int
  {
    axial_force,     /**< of the element nearest to a point */
    largest_force,   /**< of all elements of a section, by magnitude */
    head_force,      /**< at the head nearest to a point */
    bond_slip,       /**< of the node nearest to a point [m] */
    shear_force,     /**< of the dowel nearest to a point */
    shear_motion,    /**< of that dowel [m] */
    n_broken,        /**< elements that have broken */
    n_yielded,       /**< elements that have yielded, broken ones included */
    slipped_length,  /**< of the bond that slips or has slipped, all bars [m] */
    slipped_share,   /**< the same by the length of the bond [-] */
    largest_tension, /**< of all elements of a section, or 0 */
    largest_compression /**< the same, positive */
  };

  /** Fields of bars for cables.pvd. */
  struct CableFields
  {
    // Each element has two points.
    std::vector<dealii::Tensor<1, 2>> position, displacement;
    std::vector<double> slip;       /**< of the bond [m] */
    std::vector<double> bond_force; /**< by length, of one bar [N/m] */
    std::vector<std::uint8_t> bond; /**< see bond_state; 3: there is none */
    // Each element has one of these.
    std::vector<double> axial_force;  /**< of one bar [N] */
    std::vector<double> axial_strain; /**< [-] */
    std::vector<double> shear_force;  /**< of its dowel [N] */
    std::vector<std::uint8_t> state;  /**< 0 elastic, 1 yielded, 2 broken */
    std::vector<std::int32_t> cable;  /**< number of the section */
  };

  /** Value for histories of the bars of section @p cable; @p point: where
      [m]. */
  double cable_value(const Reinforcement &reinforcement, const State<2> &state,
                     const std::string &cable, CableQuantity quantity,
                     const std::array<double, 3> &point);

  /** Fields of all bars that are installed. */
  CableFields cable_fields(const Reinforcement &reinforcement,
                           const State<2> &state);

  /**
   * The motion of a joint along a bar across it, or across a dowel, in which
   * the bar comes to bear as much as it can, or @p most [N], from the force in
   * it now on: the largest of all bars that are installed and the joints that
   * they cross [m]. By the stiffness of a bar that bears nothing yet.
   */
  double mobilising_motion(const Reinforcement &reinforcement,
                           const State<2> &state, double most);

  /** About bars of each section that begin with the @p stage, the first one of
      the run or not, and lie in part in blocks that are absent there. */
  std::vector<std::string> absent_host_texts(const Reinforcement &reinforcement,
                                             const State<2> &state,
                                             const std::string &stage,
                                             bool is_first);

  /** Lines about the bars for --check. */
  std::string cable_text(const Reinforcement &reinforcement);
} // namespace quoin

#endif
