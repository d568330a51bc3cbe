// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_advice_contact_advice_h
#define quoin_advice_contact_advice_h

#include <quoin/advice/advice.h>

#include <string>
#include <vector>

namespace quoin
{
  /**
   * Two squares, or cubes, as heavy as the median of the blocks on which a set
   * of joints acts, which meet with a whole side: masses on springs and
   * dashpots.
   */
  struct TypicalImpact
  {
    bool exists        = false; /**< whether the set acts on a block */
    double mass        = 0.;    /**< mass of a block [kg] */
    double size        = 0.;    /**< length of an edge [m] */
    double density     = 0.;    /**< [kg/m^3] */
    double stiffness   = 0.;    /**< normal one of the set [Pa/m] */
    double frequency   = 0.;    /**< undamped [Hz] */
    double duration    = 0.;    /**< duration of the contact [s] */
    double restitution = 1.;    /**< [-] */
    /** kn L/E with the side L; 0: blocks are rigid. */
    double by_block = 0.;
  };

  /** An impact of typical blocks for each joint set of @p model, at the set's
      largest stiffness. Collective. */
  template <int dim>
  std::vector<TypicalImpact> typical_impacts(const Model<dim> &model);

  /** A line for --check about each joint set that has dashpots or is for new
      contacts, and with large displacements one about the gaps between the
      blocks of @p state. Collective. */
  template <int dim>
  std::vector<std::string> contact_lines(const Model<dim> &model,
                                         const State<dim> &state);

  /** Warns of restitution that waves in blocks will change, and of sets
      for new contacts alone beside which blocks do not deform. */
  template <int dim>
  void check_contacts(const Model<dim> &model, Advice &advice);

  /** Warns of sets between rigid blocks that sink into each other under
      @p gravity [m/s^2] of a column as high as the model. Collective. */
  void check_rigid_blocks(const Model<2> &model, double gravity,
                          Advice &advice);

  /** Motion of blocks under the loads of a stage; 0: not known. */
  struct Agitation
  {
    Shaking shaking;          /**< the fastest of them */
    double speed        = 0.; /**< largest one that they prescribe [m/s] */
    double acceleration = 0.; /**< largest one of gravity [m/s^2] */
  };

  /** Warns of new contacts too soft for @p loads of a stage, for the gaps
      between the blocks of @p state and for the blocks. Collective. */
  void check_soft_contacts(const Model<2> &model, const State<2> &state,
                           const Agitation &loads, Checks &checks);
} // namespace quoin

#endif
