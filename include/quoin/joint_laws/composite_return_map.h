// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_composite_return_map_h
#define quoin_joint_laws_composite_return_map_h

#include <quoin/joint_laws/composite_law.h>

namespace quoin
{
  /** End of an increment and its plastic multipliers. */
  struct CompositeFlow
  {
    double sigma    = 0.; /**< [Pa] */
    double tau      = 0.; /**< |tau| [Pa] */
    double opening  = 0.; /**< plastic multiplier dl1 of f1 [m] */
    double slip     = 0.; /**< plastic multiplier dl2 of f2 [m] */
    double cap      = 0.; /**< plastic multiplier dl3 of f3 [m/Pa] */
    double bond     = 1.;
    double crushing = 0.; /**< k3 [m] */
  };

  /**
   * Backward Euler for CompositeLaw from the bond and crushing of a point and
   * given trial tractions [Pa], of shear the size: its direction stays.
   *
   * The usual increment is found by Newton's method for the surfaces that the
   * trial is beyond, or for crushing alone, and checked against the others.
   * Failing that the three modes are nested: crushed() returns onto the cap,
   * slipped() seeks the slip for which what crushed() returns is on f2, and
   * opened() the opening for which what slipped() returns is on f1; either of
   * them is zero if that surface is not reached without. Every search has a
   * bracket, so that corners need no guess of the active set, and there is
   * always an answer.
   */
  class CompositeReturnMap
  {
  public:
    CompositeReturnMap(const CompositeLaw &law, double bond_start,
                       double crushing_start, double sigma_trial,
                       double tau_trial);

    /** The end of the increment. */
    CompositeFlow end() const;

    /** tan(psi) [-] at the end of @p flow. */
    double dilation(const CompositeFlow &flow) const;

    /** tan(psi) [-] without pressure, which lowers it. */
    double free_dilation(double bond) const;

    /** crush() gives up where the slope of its equation is below this share of
        that without softening: rounding would have a multiple of itself in the
        tractions [-]. */
    static constexpr double steepest_softening = 0.25;
    /** Largest square of the last step of crush() in y, times the smaller of 1
        and 2 kn Cnn k3 / |grad f3|: its error is of the order of the square,
       and larger where the cap begins to harden. */
    static constexpr double accurate_step = 1e-17;

    const CompositeLaw &law;
    const double fade; /**< tan(psi) goes with bond^fade */

  private:
    /**
     * Newton's method for f1 = 0 if the joint @p opens and f2 = 0 if it
     * @p slips, without crushing. Whether it found what no other surface
     * objects to.
     */
    bool iterate(CompositeFlow &flow, bool opens, bool slips) const;

    /** As iterate(), for slip alone without dilation: one equation. */
    bool slide(CompositeFlow &flow) const;

    /**
     * Newton's method for f3 = 0 by y = 2 kn Cnn dl3, if the joint crushes
     * without opening or slip: sigma + Cn/(2 Cnn) is divided by 1 + y, tau by
     * 1 + y ks Css/(kn Cnn). Whether it found what no other surface objects to.
     */
    bool crush(CompositeFlow &flow) const;

    /** Whether the tractions of @p flow leave the cap as it was. */
    bool within_cap(const CompositeFlow &flow) const;

    /** The flow with whatever opening there must be. */
    CompositeFlow opened() const;

    /** The flow with the opening that leaves @p sigma of the normal trial. */
    CompositeFlow slipped(double sigma) const;

    /** The flow with the opening and slip that leave @p sigma and @p tau. */
    CompositeFlow crushed(double sigma, double tau) const;

    /** As crushed(), without crushing. */
    CompositeFlow loosened(double sigma, double tau) const;

    /**
     * Tractions after flow on the cap that leaves the @p share
     * 1/(1 + 2 kn Cnn dl3) of the distance to its centre, and after dilation.
     */
    void relax(CompositeFlow &flow, double sigma, double tau,
               double share) const;

    /** The yield functions f1, f2 [Pa] and f3 [Pa^2]. */
    double opening_excess(const CompositeFlow &flow) const;
    double slip_excess(const CompositeFlow &flow) const;
    double overload(const CompositeFlow &flow) const;

    /** Tolerance of f1 and f2 [Pa], with rounding errors of @p sigma [Pa]. */
    double tolerance(double sigma) const;

    const double bond_start, crushing_start;
    const double sigma_trial, tau_trial;
  };
} // namespace quoin

#endif
