// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_joint_law_h
#define quoin_joint_laws_joint_law_h

#include <quoin/joint_laws/barton_bandis_law.h>
#include <quoin/joint_laws/composite_law.h>
#include <quoin/joint_laws/continuously_yielding_law.h>
#include <quoin/joint_laws/coulomb_law.h>
#include <quoin/joint_laws/slip_weakening_law.h>

#include <algorithm>
#include <array>
#include <string>
#include <variant>

namespace quoin
{
  /**
   * The law of a set of joints: all laws there are. This list is all that
   * knows of them; in the parameter file they stand in its order.
   *
   * A law derives from JointLawDefaults, which has what it may leave as it is,
   * or from LinearSprings, which has the energies and stiffnesses of springs
   * of constant stiffness, too, and has
   *
   * - names, the words for it in the parameter file, and kind: laws of one
   *   kind remember the same of a joint, so that stages may exchange them;
   * - read(entries), its parameters (law_entries.h), text() for --check and
   *   reduced(factor), the law with its strength divided by a factor;
   * - Point<dim>, what it reads and overwrites: JointPoint or derived from it;
   *   initialise(point, normal, shear), tractions at rest, and holds(point),
   *   whether these are admissible; wear_out(point), fields() for results;
   * - update_elastic(point, opening, slip), false where the joint fails, slips
   *   or is open, and update_failing() for the rest, which returns what it
   *   dissipated; update(point, opening, slip, tangent), both with the
   *   consistent tangent; update_waiting() and excess() if it waits;
   * - stored_energy(point, opening), for any opening unless
   *   stores_by_opening(point), carried_energy(before, after),
   *   stiffness_at(sigma) and largest_stiffness().
   *
   * Operators visit the variant once for a set, or for a point where no time
   * is lost by it, and are templates of the law below that.
   */
  using JointLaw = std::variant<CoulombLaw, CompositeLaw, BartonBandisLaw,
                                ContinuouslyYieldingLaw, SlipWeakeningLaw>;

  /** Calls @p use with a null pointer to each law of JointLaw, in order. */
  template <typename Use, typename... Laws>
  void for_each_law(const Use &use, const std::variant<Laws...> *)
  {
    (use(static_cast<const Laws *>(nullptr)), ...);
  }
  template <typename Use>
  void for_each_law(const Use &use)
  {
    for_each_law(use, static_cast<const JointLaw *>(nullptr));
  }

  /** The largest kn and ks [Pa/m] that a joint can reach. */
  std::array<double, 2> stiffness_bound(const JointLaw &law);

  /** Whether kn and ks grow with the pressure, from less than the bound. */
  bool stiffens(const JointLaw &law);

  /** Whether the joint may open or slip. */
  bool can_fail(const JointLaw &law);

  /** Whether slip may open the joint. */
  bool can_dilate(const JointLaw &law);

  /** Slip [m] that mobilises the peak strength, beside the elastic one. */
  double slip_of_peak(const JointLaw &law);

  /** Laws of one kind remember the same of a joint. */
  std::string kind_of_law(const JointLaw &law);

  /** Description of the law for --check. */
  std::string law_text(const JointLaw &law);

  /** Warning about the parameters of the law; may be empty. */
  std::string law_warning(const JointLaw &law);

  /** Numbers that a joint point remembers beside those of JointPoint. */
  unsigned int n_internal(const JointLaw &law);

  /**
   * The law with its strength divided by @p factor, for factors of safety.
   * Stiffnesses, fracture energies and slips stay.
   */
  JointLaw reduced(const JointLaw &law, double factor);
} // namespace quoin

#endif
