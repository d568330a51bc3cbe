// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/base/eigen_vectors.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/tdbem/element_integrals.h>
#include <quoin/tdbem/interior_points.h>
#include <quoin/elastodynamics/static_kernels.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    using Eigen::Matrix2d;

    /**
     * The kernels of a point and an element for all lags, each component one
     * after the other and the latest lag first, so that a step is a product
     * with the beginning of the record.
     */
    class LagSeries
    {
    public:
      explicit LagSeries(const unsigned n_lags)
        : n_lags(n_lags), G(n_lags, 4), H(n_lags, 4)
      {
      }

      void compute(const BoundaryElement &element, const ElasticMedium &medium,
                   const dealii::Point<2> &point, const BoundaryRecord &record)
      {
        const double dt = record.time_step;
        // Lag n sees waves until (n + 1) dt. The margin is for rounding: the
        // integrals themselves are zero before the arrival.
        const double arrival = distance_to_segment(point, element.a, element.b)
                               / (medium.c1 * dt);
        first = arrival < n_lags ? unsigned(arrival * (1. - 1e-12)) : n_lags;

        const dealii::Tensor<1, 2> t = element.tangent(), n = element.normal();
        const dealii::Tensor<1, 2> arm = element.a - point;
        const double d = arm * n, s = arm * t;
        const double length = element.length();
        Matrix2d frame;
        frame << t[0], n[0], t[1], n[1];
        TimeKernels last{ Matrix2d::Zero(), Matrix2d::Zero() };
        Matrix2d B_before = Matrix2d::Zero();
        for (unsigned lag = first; lag < n_lags; ++lag)
        {
          const TimeKernels now = local_element_integrals(
              medium, (lag + 1) * dt, d, s, s + length);
          const double factor
              = record.decay == 0. ? 1. : std::exp(-record.decay * lag * dt);
          // Row of the equation: the direction of the force, second index.
          const Matrix2d g = factor * frame * (now.A - last.A).transpose()
                             * frame.transpose();
          const Matrix2d h = factor / dt * frame
                             * (now.B - 2. * last.B + B_before).transpose()
                             * frame.transpose();
          for (unsigned k = 0; k < 4; ++k)
          {
            G(n_lags - 1 - lag, k) = g(k / 2, k % 2);
            H(n_lags - 1 - lag, k) = h(k / 2, k % 2);
          }
          B_before = last.B;
          last     = now;
        }
      }

      /** What the element contributes at the end of a step. */
      dealii::Tensor<1, 2> at_step(const unsigned step, const unsigned element,
                                   const BoundaryRecord &record) const
      {
        dealii::Tensor<1, 2> sum;
        if (step <= first)
          return sum;
        const Eigen::Index n = step - first, begin = n_lags - step;
        for (unsigned k = 0; k < 4; ++k)
        {
          const Eigen::Index column = 2 * element + k % 2;
          sum[k / 2] += G.col(k).segment(begin, n).dot(
                            record.traction.col(column).head(n))
                        - H.col(k).segment(begin, n).dot(
                            record.displacement.col(column).head(n));
        }
        return sum;
      }

    private:
      unsigned n_lags;
      unsigned first = 0; /**< lag that is not zero */
      Eigen::MatrixXd G, H;
    };
  } // namespace

  Eigen::MatrixXd interior_displacements(
      const Boundary &boundary, const ElasticMedium &medium,
      const BoundaryRecord &record, const std::vector<dealii::Point<2>> &points,
      const std::vector<unsigned> &steps, const MPI_Comm communicator)
  {
    Eigen::MatrixXd result
        = Eigen::MatrixXd::Zero(2 * points.size(), steps.size());
    if (points.empty() || steps.empty())
      return result;
    int rank, n_ranks;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &n_ranks);
    LagSeries series(*std::max_element(steps.begin(), steps.end()));
    for (std::size_t k = rank; k < points.size(); k += n_ranks)
      for (unsigned e = 0; e < boundary.n_elements(); ++e)
      {
        series.compute(boundary.elements[e], medium, points[k], record);
        for (std::size_t l = 0; l < steps.size(); ++l)
        {
          auto column = result.col(l);
          add_to_vector(column, k, series.at_step(steps[l], e, record));
        }
      }
    // Others have added nothing to a point.
    MPI_Allreduce(MPI_IN_PLACE, result.data(), int(result.size()), MPI_DOUBLE,
                  MPI_SUM, communicator);
    return result;
  }

  Eigen::VectorXd
  static_interior_displacements(const Boundary &boundary,
                                const ElasticMedium &medium,
                                const StaticSolution &solution,
                                const std::vector<dealii::Point<2>> &points)
  {
    Eigen::VectorXd result(2 * points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const StaticMatrices matrices
          = static_point_matrices(boundary, medium, points[k]);
      result.segment<2>(2 * k) = matrices.G * solution.traction
                                 - matrices.H * solution.displacement
                                 + to_eigen(solution.constant);
    }
    return result;
  }
} // namespace quoin
