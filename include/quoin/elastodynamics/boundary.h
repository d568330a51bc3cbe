// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_boundary_h
#define quoin_elastodynamics_boundary_h

#include <quoin/base/eigen_core.h>

#include <deal.II/base/point.h>

#include <cstddef>
#include <vector>

namespace quoin
{
  /** A straight boundary element; the domain is on the left from a to b. */
  struct BoundaryElement
  {
    dealii::Point<2> a; /**< start [m] */
    dealii::Point<2> b; /**< end [m] */

    /** [m] */
    double length() const
    {
      return (b - a).norm();
    }

    /** Unit vector from a to b. */
    dealii::Tensor<1, 2> tangent() const
    {
      return (b - a) / length();
    }

    /** Unit normal, outward from the domain: (t_y, -t_x). */
    dealii::Tensor<1, 2> normal() const
    {
      const dealii::Tensor<1, 2> t = tangent();
      return dealii::Point<2>(t[1], -t[0]);
    }

    dealii::Point<2> middle() const
    {
      return 0.5 * (a + b);
    }
  };

  /**
   * The boundary of a domain, cut into straight elements: any number of
   * disjoint closed or open curves.
   *
   * Displacements [m] and tractions [Pa] on it are constant on each element
   * and stored element by element: entry 2 e + i is component i of element e.
   * The tractions p = sigma n are those on the domain, n its outward normal.
   */
  class Boundary
  {
  public:
    std::vector<BoundaryElement> elements;

    std::size_t n_elements() const
    {
      return elements.size();
    }

    /** Number of unknowns of one field, two per element. */
    std::size_t n_unknowns() const
    {
      return 2 * elements.size();
    }

    /** The lengths of the elements [m]. */
    Eigen::VectorXd lengths() const;

    /** Greatest distance between two points of the boundary [m]. */
    double diameter() const;

    /**
     * Adds the curve through @p points, element k from point k to point k+1,
     * the domain on its left; @p closed adds one from the last to the first.
     */
    void add_curve(const std::vector<dealii::Point<2>> &points, bool closed);

    /**
     * The polygon through @p vertices, given anticlockwise, its edges cut into
     * equal elements not longer than @p element_length [m]. The domain is
     * inside, or outside if @p exterior; the elements then run clockwise.
     */
    static Boundary polygon(const std::vector<dealii::Point<2>> &vertices,
                            double element_length, bool exterior);

    /**
     * The regular polygon with @p n edges, one element each, whose vertices
     * are on the circle of the given centre and radius [m]; the first is at
     * angle zero. The domain is inside, or outside if @p exterior: the
     * elements then run clockwise.
     */
    static Boundary circle(const dealii::Point<2> &centre, double radius,
                           unsigned n, bool exterior);
  };
} // namespace quoin

#endif
