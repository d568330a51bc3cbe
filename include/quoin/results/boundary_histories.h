// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_boundary_histories_h
#define quoin_results_boundary_histories_h

#include <quoin/base/eigen_core.h>
#include <quoin/farfield/boundary_geometry.h>
#include <quoin/results/history_parameters.h>

#include <string>
#include <vector>

namespace quoin
{
  /** The total field on a boundary at one time, two entries per element. */
  struct BoundaryState
  {
    Eigen::VectorXd displacement; /**< [m] */
    Eigen::VectorXd velocity;     /**< mean over the step [m/s] */
    Eigen::VectorXd traction;     /**< [Pa] */
    Eigen::VectorXd hoop_stress;  /**< hoop stress of each element [Pa] */
  };

  /** The columns of histories.csv of a run of boundary elements. */
  class BoundaryHistories
  {
  public:
    /**
     * Throws an InputError that begins with the section if a point of the
     * domain is not in it, or nearer to the boundary than a quarter of an
     * element, or if a point of the boundary is far from it. @p thickness: of
     * the slice that forces refer to [m].
     */
    BoundaryHistories(const std::vector<HistoryParameters> &parameters,
                      const BoundaryGeometry &geometry,
                      const BoundaryElementParameters &boundaries,
                      double thickness);

    /** "time [s]" and "name [unit]" of each column. */
    std::vector<std::string> column_names() const;

    /** The points in the domain, for set_interior(). */
    const std::vector<dealii::Point<2>> &interior_points() const
    {
      return points;
    }

    /** A row of the table; quantities in the domain are left zero. */
    std::vector<double> row(double time, const BoundaryState &state) const;

    /** Sets quantities in the domain; vectors have two entries per point. */
    void set_interior(std::vector<double> &row,
                      const Eigen::VectorXd &displacement,
                      const Eigen::VectorXd &velocity) const;

  private:
    struct Probe
    {
      HistoryParameters parameters;
      unsigned int entity = 0; /**< element or point */
    };

    double force(const HistoryParameters &wanted,
                 const BoundaryState &state) const;

    std::vector<Probe> probes;
    std::vector<dealii::Point<2>> points;
    const BoundaryGeometry &geometry;
    std::vector<std::string> names; /**< names of the boundaries */
    double thickness;
  };
} // namespace quoin

#endif
