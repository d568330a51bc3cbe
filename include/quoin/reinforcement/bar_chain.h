// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_reinforcement_bar_chain_h
#define quoin_reinforcement_bar_chain_h

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace quoin
{
  /** Stiffness and strength of a bar with its bond, face plate and anchor. */
  struct BarLaw
  {
    static constexpr double unlimited = std::numeric_limits<double>::max();

    double stiffness      = 0.;        /**< E A [N] */
    double yield          = unlimited; /**< in tension and compression [N] */
    double rupture_strain = unlimited; /**< total strain in tension [-] */
    double bond_stiffness = 0.;        /**< by length [N/m^2] */
    double bond_strength  = unlimited; /**< by length, without pressure [N/m] */
    /** Tangent of the friction angle times the perimeter [m]. */
    double bond_friction         = 0.;
    double plate_stiffness       = 0.;        /**< 0: no plate [N/m] */
    double plate_strength        = unlimited; /**< [N] */
    double anchor_stiffness      = 0.;        /**< 0: no anchor [N/m] */
    double anchor_strength       = unlimited; /**< [N] */
    double dowel_stiffness       = 0.;        /**< across the bar [N/m] */
    double dowel_strength        = unlimited; /**< [N] */
    double dowel_axial_stiffness = 0.;        /**< along the bar [N/m] */
    double dowel_axial_strength  = unlimited; /**< [N] */
    double active_length         = 0.;        /**< [m] */
  };

  /** Geometry of the elements of a bar. */
  struct BarChain
  {
    std::vector<double> length; /**< of each element [m] */
    /** Length of the bond that each node stands for [m]. */
    std::vector<double> bond;

    std::size_t n_nodes() const
    {
      return bond.size();
    }
    std::size_t n_elements() const
    {
      return length.size();
    }
  };

  /** State of the bond at a node of a bar; 'has_slipped' bears less than it
      can. */
  namespace bond_state
  {
    constexpr std::uint8_t elastic = 0, slips = 1, has_slipped = 2;
  } // namespace bond_state

  /**
   * Internal variables of a bar. Slip is the motion of the bar relative to the
   * rock at its nodes, positive towards its far end; forces are positive in
   * tension, those of bond, plate and anchor if they resist a positive slip.
   */
  struct BarState
  {
    std::uint8_t installed = 0;
    std::vector<double> slip;         /**< of each node [m] */
    std::vector<double> bond_plastic; /**< [m] */
    std::vector<double> bond_force;   /**< [N] */
    std::vector<std::uint8_t> bond;   /**< bond_state of each node */
    std::vector<double> pressure;     /**< of the rock on the bond [Pa] */
    std::vector<std::uint8_t> lost;   /**< nodes without rock */
    std::vector<double> stretch;      /**< of the rock, of each element [m] */
    std::vector<double> plastic;      /**< [m] */
    std::vector<double> force;        /**< [N] */
    std::vector<std::uint8_t> broken; /**< elements */
    double plate_offset = 0., plate_plastic = 0.;  /**< [m] */
    double plate_force    = 0.;                    /**< [N] */
    double anchor_plastic = 0., anchor_force = 0.; /**< [m], [N] */
    /** Displacement x, y of the far end of each element relative to its near
        one, and of the far side of each dowel, at installation [m]. */
    std::vector<double> start, dowel_start;
    /** Plastic motion [m] and force [N] of each dowel along and across the
        bar. */
    std::vector<double> dowel_plastic, dowel_force;
    std::vector<double> dowel_motion; /**< last one, along and across [m] */
    std::vector<std::uint8_t> dowel_broken;

    void resize(const BarChain &chain, std::size_t n_dowels);

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(installed, slip, bond_plastic, bond_force, bond, pressure,
                   lost, stretch, plastic, force, broken, plate_offset,
                   plate_plastic, plate_force, anchor_plastic, anchor_force);
      visitor.same(start, dowel_start, dowel_plastic, dowel_force, dowel_motion,
                   dowel_broken);
    }
  };

  /** Energy dissipated by bars [J]. */
  struct BarDissipation
  {
    double plastic  = 0.; /**< yield of bars, plates and dowels */
    double friction = 0.; /**< slip of bond and anchors */
    double fracture = 0.; /**< stored in what breaks or loses its rock */
  };

  /** Force of a plastic spring and what follows from it. */
  struct SpringForce
  {
    double force;   /**< [N] */
    double tangent; /**< [N/m] */
    double plastic; /**< [m] */
  };

  /** Spring @p k [N/m] with force in [@p low, @p high] [N], without hardening:
      @p plastic is its plastic elongation so far [m]. */
  inline SpringForce spring_force(const double k, const double elongation,
                                  const double plastic, const double low,
                                  const double high)
  {
    const double trial = k * (elongation - plastic);
    if (trial > high)
      return { high, 0., elongation - high / k };
    if (trial < low)
      return { low, 0., elongation - low / k };
    return { trial, k, plastic };
  }

  /**
   * Updates @p state for the @p stretch of the rock between the nodes [m]: the
   * bar finds its equilibrium between elements E A / L that yield and break,
   * bond that slips, plate and anchor. The energy of the increment is convex,
   * so that there is one, which Newton's method with a line search finds.
   *
   * @p tangent: derivatives of the element forces by the stretches, row by row
   * [N/m]; null: not wanted. Elements whose strain exceeds that of rupture
   * break at the next call, at the stretch of this one. If @p is_static, so
   * does the bond find a new equilibrium if the pressure on it has changed; if
   * not, the forces before a rupture have acted on the rock in the first half
   * of the step from the last stretch.
   */
  BarDissipation update(const BarLaw &law, const BarChain &chain,
                        const std::vector<double> &stretch, BarState &state,
                        std::vector<double> *tangent = nullptr,
                        bool is_static               = true);

  /**
   * Tensions a new bar against its face plate to @p force [N]. An anchor, if
   * there is one, bears it alone, and the bond begins without stress; otherwise
   * the bond does. Returns whether it can.
   */
  bool pretension(const BarLaw &law, const BarChain &chain, double force,
                  BarState &state);

  /** Recoverable energy of the bar and its dowels [J]. */
  double stored_energy(const BarLaw &law, const BarChain &chain,
                       const BarState &state);
} // namespace quoin

#endif
