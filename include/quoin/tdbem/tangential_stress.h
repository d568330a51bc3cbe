// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_tangential_stress_h
#define quoin_tdbem_tangential_stress_h

#include <quoin/base/eigen_core.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/elastodynamics/elastic_medium.h>

#include <array>
#include <vector>

namespace quoin
{
  /**
   * The normal stress along the boundary (of a hole: the hoop stress), which
   * is no unknown of the boundary element method: from the traction across the
   * boundary and the strain along it,
   * @f[ \sigma_{tt} = \frac{\lambda}{\lambda + 2 \mu} \sigma_{nn}
   *     + \frac{4 \mu (\lambda + \mu)}{\lambda + 2 \mu} \epsilon_{tt} . @f]
   *
   * The strain at an element comes from displacements and places of its
   * neighbours and its own. Both are interpolated by the same quadratic
   * polynomials of s, the length along the elements, and
   * epsilon_tt = u' . x' / x' . x', with an error of second order in the
   * element length. At open ends and at corners of more than 30 degrees the
   * next two elements on one side are used; if there is only one, the
   * difference to it. An element between two corners takes its neighbours all
   * the same, and one without neighbours has no strain.
   *
   * The place of an element is not quite its middle. Elements of length L that
   * turn by an angle theta from one to the next stand for a curve, and
   * displacements that are constant on each come out as those of the circle of
   * the same length. Its points are L theta / 12 farther out than the middles,
   * to leading order; without this the strain of a circle with 32 elements
   * would be 0.3 % too large.
   */
  class TangentialStress
  {
  public:
    TangentialStress(const Boundary &boundary, const ElasticMedium &medium);

    /**
     * [Pa], tension positive, an entry for each element; for displacements
     * @p u [m] and tractions @p p [Pa], two entries each.
     */
    Eigen::VectorXd operator()(const Eigen::VectorXd &u,
                               const Eigen::VectorXd &p) const;

  private:
    /** The strain of an element is the sum of weight . displacement. */
    struct Stencil
    {
      std::array<unsigned, 3> elements;
      std::array<dealii::Tensor<1, 2>, 3> weights;
    };

    std::vector<Stencil> stencils;
    std::vector<dealii::Tensor<1, 2>> normals;
    double of_traction; /**< factor of sigma_nn */
    double of_strain;   /**< [Pa] */
  };
} // namespace quoin

#endif
