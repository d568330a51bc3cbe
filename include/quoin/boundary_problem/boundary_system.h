// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_boundary_problem_boundary_system_h
#define quoin_boundary_problem_boundary_system_h

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/farfield/boundary_values.h>
#include <quoin/farfield/domain_points.h>
#include <quoin/farfield/incident_waves.h>
#include <quoin/parameters/parameters.h>
#include <quoin/results/boundary_histories.h>
#include <quoin/output/log.h>
#include <quoin/tdbem/boundary_history.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/tdbem/interior_points.h>
#include <quoin/tdbem/passivity.h>
#include <quoin/tdbem/static_solver.h>
#include <quoin/tdbem/tangential_stress.h>

#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * Boundary, medium, boundary values and operators of a problem of boundary
   * elements alone. The equations are solved for the scattered field, that is,
   * the total one without the incident waves; boundary values and results are
   * those of the total field.
   */
  class BoundarySystem
  {
  public:
    /**
     * @p parameters must outlive this object. Collective. Throws an InputError
     * that begins with the file.
     */
    BoundarySystem(const Parameters &parameters, MPI_Comm communicator);

    /** Makes influence matrices and history of time marching; collective. */
    void make_operators(Log &log);

    /** Boundary values of a step less those of the incident waves. */
    Eigen::VectorXd scattered_values(double begin, double end,
                                     const Eigen::VectorXd &u_incident,
                                     const Eigen::VectorXd &p_incident);
    StaticSolution solve_static();

    /** Points of histories and of the sampled field in the domain [m]. */
    std::vector<dealii::Point<2>> points_in_domain() const;
    /** Whether results in the domain need the record of the boundary. */
    bool needs_record() const;
    /** Total displacements of points in the domain at the ends of some steps
        [m]; collective. */
    Eigen::MatrixXd
    domain_displacements(const BoundaryRecord &all,
                         const std::vector<dealii::Point<2>> &points,
                         const std::vector<unsigned int> &steps) const;

    const Parameters &parameters;
    const BoundaryElementParameters &settings;
    const MPI_Comm communicator;
    std::string fingerprint; /**< see run_fingerprint() */
    const ElasticMedium &medium;
    BoundaryGeometry geometry;
    double dt             = 0.; /**< time step [s] */
    std::uint64_t n_steps = 0;
    std::unique_ptr<BoundaryHistories> histories;
    std::unique_ptr<TangentialStress> hoop_stress;
    std::unique_ptr<BoundaryValues> given;
    DomainPoints sampled; /**< points of the sampled field */
    std::unique_ptr<IncidentWaves> waves;
    std::unique_ptr<InfluenceKernel> kernel;
    std::unique_ptr<BoundaryHistory> history;
    std::unique_ptr<PassivityReport> passivity; /**< null: no check */

  private:
    void choose_time_step();
  };
} // namespace quoin

#endif
