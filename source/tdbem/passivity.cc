// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_core.h>
#include <quoin/tdbem/passivity.h>

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <sstream>

namespace quoin
{
  namespace
  {
    /**
     * Smallest eigenvalue of the Hermitian part of an operator on vectors of
     * size @p n by Lanczos' method with full orthogonalisation.
     *
     * Stops when the residual is below a thousandth of the eigenvalue, or 1e-7
     * of @p unit; the error of the eigenvalue itself is smaller still unless
     * others are close to it, and then it does not matter.
     */
    double smallest_eigenvalue(
        const std::function<void(Eigen::VectorXcd &)> &operation,
        const Eigen::Index n, const double unit)
    {
      // Along no symmetry of the boundary, and always the same.
      std::mt19937 random(1);
      std::uniform_real_distribution<double> uniform(-1., 1.);
      Eigen::VectorXcd v(n);
      for (std::complex<double> &entry : v)
        entry = { uniform(random), uniform(random) };
      v.normalize();

      Eigen::MatrixXcd basis(n, std::min<Eigen::Index>(n, 64));
      Eigen::VectorXd diagonal(n), off_diagonal(n);
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
      for (Eigen::Index k = 0; k < n; ++k)
      {
        if (k == basis.cols())
          basis.conservativeResize(n, std::min(n, 2 * k));
        basis.col(k) = v;
        operation(v);
        diagonal(k) = basis.col(k).dot(v).real();
        for (int repeat = 0; repeat < 2; ++repeat) // twice is enough
        {
          const Eigen::VectorXcd along = basis.leftCols(k + 1).adjoint() * v;
          v -= basis.leftCols(k + 1) * along;
        }
        off_diagonal(k) = v.norm();
        const bool exhausted
            = k + 1 == n
              || off_diagonal(k) < 1e-13 * diagonal.head(k + 1).norm();
        if (k % 8 == 7 || exhausted)
        {
          eigen.computeFromTridiagonal(diagonal.head(k + 1),
                                       off_diagonal.head(k));
          const double residual
              = off_diagonal(k) * std::abs(eigen.eigenvectors()(k, 0));
          if (exhausted
              || residual < std::max(1e-3 * std::abs(eigen.eigenvalues()(0)),
                                     1e-7 * unit))
            break;
        }
        v /= off_diagonal(k);
      }
      return eigen.eigenvalues()(0);
    }
  } // namespace

  ZTransform z_transform(const InfluenceKernel &kernel, const unsigned n_lags)
  {
    struct Lags
    {
      std::vector<Eigen::MatrixXd> G, H;
    };
    // Shared, because a std::function is copied.
    const auto lags = std::make_shared<Lags>();
    lags->G.resize(n_lags);
    lags->H.resize(n_lags);
    for (unsigned n = 0; n < n_lags; ++n)
      kernel.lag(n, lags->G[n], lags->H[n]);
    return [lags, n_lags](const std::complex<double> w, Eigen::MatrixXcd &G,
                          Eigen::MatrixXcd &H)
    {
      const auto rows = lags->G[0].rows();
      G.setZero(rows, rows);
      H.setZero(rows, rows);
      std::complex<double> power = 1.;
      for (unsigned n = 0; n < n_lags; ++n)
      {
        G += power * lags->G[n];
        H += power * lags->H[n];
        power *= w;
      }
    };
  }

  std::string PassivityReport::advice() const
  {
    double gap = 0.;
    for (std::size_t k = 1; k < frequencies.size(); ++k)
      gap = std::max(gap, frequencies[k] - frequencies[k - 1]);
    std::ostringstream text;
    text.precision(3);
    text << "The discrete impedance of the boundary elements ";
    if (passive())
    {
      text << "is passive at all " << n_scanned << " frequencies up to "
           << nyquist
           << " Hz: they create no energy there. Bands narrower than the "
              "spacing of these, "
           << gap << " Hz at most, may be missed.";
      return text.str();
    }
    text << "is not passive: they may add energy to motions at " << frequency
         << " Hz, " << frequency / nyquist
         << " of the highest frequency, where the smallest eigenvalue of its "
            "Hermitian part is "
         << smallest_eigenvalue
         << " rho c2 if all displacements are prescribed, as on an interface. ";
    if (smallest_eigenvalue > -1.)
      text << "The radiation of other modes and the dissipation in blocks "
              "usually outweigh this: check 'radiated' in a long run. ";
    else
      text << "A run may become unstable. ";
    text << "Remedies: Galerkin with a step of 1 to 1.5 times the element "
            "length over c1 (1.2 to 1.5 if Poisson's ratio is above 0.35); "
            "convolution quadrature.";
    return text.str();
  }

  namespace
  {
    struct Sample
    {
      double angle, eigenvalue;
    };

    /** The discrete impedance on a circle about zero. */
    class Impedance
    {
    public:
      Impedance(const ZTransform &transform, const Boundary &boundary,
                const ElasticMedium &medium, const double time_step,
                const double radius)
        : transform(transform), time_step(time_step), radius(radius),
          unit(medium.density * medium.c2), inverse_root(boundary.n_unknowns())
      {
        for (Eigen::Index k = 0; k < inverse_root.size(); ++k)
          inverse_root(k)
              = 1. / std::sqrt(boundary.elements[std::size_t(k / 2)].length());
      }

      /** The smallest eigenvalue of its Hermitian part [rho c2]. */
      Sample look_at(const double angle)
      {
        const std::complex<double> w = std::polar(radius, angle);
        transform(w, G, H);
        // L G^-1 H L^-1 = (G L^-1)^-1 (H L^-1) with L the lengths' roots.
        G *= inverse_root.asDiagonal();
        H *= inverse_root.asDiagonal();
        const Eigen::Index n              = inverse_root.size();
        const std::complex<double> factor = 0.5 * time_step / (1. - w);
        const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(G);
        Eigen::VectorXcd image(n), forward(n), backward(n);
        const auto hermitian_part = [&](Eigen::VectorXcd &x)
        {
          image.noalias() = H * x;
          forward         = lu.solve(image);
          // lu.adjoint() would copy the factors.
          lu.matrixLU().triangularView<Eigen::Upper>().adjoint().solveInPlace(
              x);
          lu.matrixLU()
              .triangularView<Eigen::UnitLower>()
              .adjoint()
              .solveInPlace(x);
          backward    = lu.permutationP().transpose() * x;
          x.noalias() = std::conj(factor) * (H.adjoint() * backward);
          x += factor * forward;
        };
        return { angle, smallest_eigenvalue(hermitian_part, n, unit) / unit };
      }

    private:
      const ZTransform &transform;
      const double time_step, radius, unit;
      Eigen::VectorXd inverse_root;
      Eigen::MatrixXcd G, H;
    };

    /** Halves up to @p n_more intervals, those with the lowest values first,
        down to @p resolution. */
    void refine(std::vector<Sample> &samples, const unsigned n_more,
                const double resolution, Impedance &impedance)
    {
      const auto value = [&](const std::size_t interval)
      {
        return std::min(samples[interval].eigenvalue,
                        samples[interval + 1].eigenvalue);
      };
      for (unsigned k = 0; k < n_more; ++k)
      {
        std::size_t lowest = samples.size();
        for (std::size_t i = 0; i + 1 < samples.size(); ++i)
          if (samples[i + 1].angle - samples[i].angle > resolution
              && (lowest == samples.size() || value(i) < value(lowest)))
            lowest = i;
        if (lowest == samples.size())
          break;
        samples.insert(
            samples.begin() + std::ptrdiff_t(lowest) + 1,
            impedance.look_at(
                0.5 * (samples[lowest].angle + samples[lowest + 1].angle)));
      }
    }
  } // namespace

  PassivityReport
  scan_passivity(const ZTransform &transform, const Boundary &boundary,
                 const ElasticMedium &medium, const double time_step,
                 const unsigned n_frequencies, const double radius)
  {
    if (!(radius > 0. && radius < 1.) || n_frequencies == 0)
      throw InputError("Passivity scan: the radius must be between 0 and 1 "
                       "and the number of frequencies positive.");
    using constants::pi;
    Impedance impedance(transform, boundary, medium, time_step, radius);

    // In the middles of equal intervals: at zero itself Z is singular for
    // radius = 1 and purely static.
    std::vector<Sample> samples;
    for (unsigned k = 0; k < n_frequencies; ++k)
      samples.push_back(impedance.look_at(pi * (k + 0.5) / n_frequencies));
    // Then where it is lowest, down to the width of the bands.
    refine(samples, n_frequencies / 2, 0.5 * (1. - radius), impedance);

    const auto worst       = std::min_element(samples.begin(), samples.end(),
                                              [](const Sample &a, const Sample &b) {
                                          return a.eigenvalue < b.eigenvalue;
                                        });
    const double per_angle = 1. / (2. * pi * time_step);
    PassivityReport report{ worst->eigenvalue,
                            worst->angle * per_angle,
                            0.5 / time_step,
                            unsigned(samples.size()),
                            {},
                            {} };
    for (const Sample &sample : samples)
    {
      report.frequencies.push_back(sample.angle * per_angle);
      report.eigenvalues.push_back(sample.eigenvalue);
    }
    return report;
  }
} // namespace quoin
