// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_structures_beam_line_h
#define quoin_structures_beam_line_h

#include <quoin/structures/beam_parameters.h>
#include <quoin/structures/beam_state.h>

#include <deal.II/base/point.h>

#include <boost/container/static_vector.hpp>

#include <array>
#include <vector>

namespace quoin
{
  /**
   * An Euler-Bernoulli beam as a discrete elastic rod: nodes with two
   * displacements each, straight segments with the axial force
   * N = E A (l - l0) / l0 and at nodes the moment M = E I (phi - phi0) / l0,
   * with the turning angle phi from one segment to the next and the mean length
   * l of both, which never is above the hinge moment. Of a line that is curved
   * at rest M = E I (phi / l0 - phi0 l / l0^2). Forces are the exact
   * derivatives of the stored energy, whatever the rotations.
   *
   * Nodes have their numbers in BeamState, and so have segments, by the node
   * where they begin. Stiffness, strength and forces are those in the thickness
   * of the model.
   */
  struct BeamLine
  {
    /** A segment now. */
    struct Segment
    {
      dealii::Tensor<1, 2> direction; /**< unit vector */
      double length, rest;            /**< [m] */
    };
    /** A node of a beam at rest. */
    struct AtRest
    {
      double segment   = 0.; /**< length of that which begins here [m] */
      double length    = 0.; /**< mean one [m] */
      double angle     = 0.; /**< turning angle [rad] */
      double curvature = 0.; /**< where the line is curved, 0 else [1/m] */
    };

    /** The beam @p given in a model, or on blocks, of the @p thickness [m]; its
        nodes are at @p places in the mesh and have numbers from @p begin on. */
    BeamLine(const BeamParameters &given, double thickness, unsigned int begin,
             const std::vector<dealii::Point<2>> &places, bool is_closed);

    unsigned int n_segments() const
    {
      return end - begin - (is_closed ? 0 : 1);
    }
    /** Node at the end of the segment @p first. */
    unsigned int next(const unsigned int first) const
    {
      return first + 1 == end ? begin : first + 1;
    }
    /** The segments that end and begin at @p node, in this order. */
    boost::container::static_vector<unsigned int, 2>
    segments_at(unsigned int node) const;
    const AtRest &at_rest(const unsigned int node) const
    {
      return rest[node - begin];
    }
    /** Whether a support holds component @p d of the displacement. */
    bool held(unsigned int node, unsigned int d) const;

    /** Finds what follows from the places at rest in @p beams. */
    void find_rest(const BeamState &beams);

    Segment segment(unsigned int first, const BeamState &beams) const;
    /** Whether there is a moment at @p node, and the @p angle that it bends:
        phi - phi0, of a curved line phi - phi0 l/l0 [rad]. */
    bool turning(unsigned int node, const BeamState &beams,
                 double &angle) const;
    /** Largest moment at @p node [N m] and its derivative by the axial force
        there [m]. */
    std::array<double, 2> hinge_moment(unsigned int node,
                                       const BeamState &beams) const;
    /** Moment at @p node [N m] for the elastic and plastic angles; @p plastic
        is updated. */
    double moment(unsigned int node, const BeamState &beams, double angle,
                  double &plastic) const;
    /** Axial force of the segment @p s that begins at @p first [N]. */
    double axial_force(unsigned int first, const Segment &s,
                       const BeamState &beams) const;
    /** Updates plastic angles and moments; adds forces to the nodes of all
        beams and returns the sum of their sizes [N]. */
    double add_forces(BeamState &beams, EnergyAccounts &energy,
                      dealii::Tensor<1, 2> *force) const;
    /** Loads of all nodes at @p time, @p grown of the given ones [-] and weight
        by the @p acceleration [m/s^2], [N]. */
    std::vector<dealii::Tensor<1, 2>>
    loads(const TimePoint &time, double grown,
          const dealii::Tensor<1, 2> &acceleration) const;

    BeamParameters given;
    unsigned int begin, end; /**< nodes */
    bool is_closed;
    double share;             /**< thickness by the spacing [-] */
    double axial_stiffness;   /**< E A [N] */
    double bending_stiffness; /**< E I [N m^2] */
    double hinge; /**< largest moment [N m], or BeamParameters::by_section */
    std::vector<dealii::Point<2>> places; /**< in the mesh [m] */

  private:
    bool has_before(const unsigned int node) const
    {
      return node > begin || is_closed;
    }
    bool has_after(const unsigned int node) const
    {
      return node + 1 < end || is_closed;
    }
    unsigned int previous(const unsigned int node) const
    {
      return (node == begin ? end : node) - 1;
    }

    std::vector<AtRest> rest; /**< of each node */
  };
} // namespace quoin

#endif
