// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_farfield_boundary_values_h
#define quoin_farfield_boundary_values_h

#include <quoin/base/eigen_core.h>
#include <quoin/farfield/boundary_geometry.h>

#include <vector>

namespace quoin
{
  /**
   * Prescribed displacements and tractions of the boundary elements, as means
   * over each element by three Gauss points. Displacements are those at
   * the end of a step. Tractions are means over it, by four Gauss points, so
   * that what is switched on where a step begins counts for all of it; or
   * those at its end, as convolution quadrature and statics need them.
   */
  class BoundaryValues
  {
  public:
    /** @p geometry and @p parameters must outlive this object. */
    BoundaryValues(const BoundaryGeometry &geometry,
                   const BoundaryElementParameters &parameters);

    /** Whether the traction is prescribed, for each unknown. */
    const std::vector<bool> &traction_is_given() const
    {
      return is_traction;
    }

    /**
     * For the step from @p begin to @p end [s]; entry 2 e + i. Throws a
     * RunError that names the boundary if a value is not finite.
     */
    Eigen::VectorXd operator()(double begin, double end);

    /** Displacements and tractions, both at the time @p time [s]. */
    Eigen::VectorXd at(double time);

    /** Throws an InputError if a displacement is not zero at t = 0. */
    void check_start();

  private:
    /** A function on the elements of one boundary. */
    struct Means
    {
      const SpaceTimeFunction *function = nullptr;
      std::vector<double> values;
      bool are_final = false; /**< the function does not change in time */
    };

    Eigen::VectorXd evaluate(double begin, double end, bool mean);
    void update(Means &means, unsigned int curve, double begin, double end,
                bool mean_in_time) const;

    const BoundaryGeometry &geometry;
    const BoundaryElementParameters &parameters;
    bool mean_of_tractions;
    std::vector<bool> is_traction;
    /** Elements of each boundary. */
    std::vector<std::vector<unsigned int>> elements;
    std::vector<std::array<Means, 3>> means; /**< x, y and pressure */
  };

  /** The domain beyond blocks with all that @p settings, which must outlive it
      as @p geometry must, give on its boundary. Throws an InputError about
      values that begin with a jump. */
  FarFieldDomain far_field_domain(const BoundaryGeometry &geometry,
                                  const BoundaryElementParameters &settings);
} // namespace quoin

#endif
