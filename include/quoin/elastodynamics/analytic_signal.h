// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_elastodynamics_analytic_signal_h
#define quoin_elastodynamics_analytic_signal_h

#include <complex>
#include <functional>
#include <vector>

namespace quoin
{
  /** Times at which a signal is evaluated, and the spacing of samples [s]. */
  struct SignalRange
  {
    double begin = 0.;
    double end   = 0.;
    double step  = 0.;
  };

  /**
   * The analytic signal F = f + i H f of a real signal f, at complex times.
   *
   * H is the Hilbert transform, H f(t) = 1/pi PV int f(tau) / (t - tau) dtau,
   * which makes a sine of a cosine. Where f = Re sum a exp(i w t), w > 0,
   * F(t + i d) = sum a exp(i w t - w d): a wave whose amplitude falls with
   * depth as exp(-w d) has the signal F at times with the imaginary part d >=
   * 0.
   *
   * H f is not causal: before f begins it is
   * -1/pi int f(tau) / (tau - t) dtau, which falls with the distance in time
   * as 1/t, and as 1/t^3 if f and t f have no integral (Ricker's wavelet).
   *
   * f is sampled and taken as the band-limited function through its samples,
   * F(z) = sum_k f_k s(z/h - k), s(z) = (exp(i pi z) - 1) / (i pi z): exact
   * below half the sampling frequency, and not periodic. Sums on grids of
   * times for a number of depths are convolutions (FFT); polynomials of degree
   * 7 in between are exact to 1e-6 of the peak for 20 samples a period.
   * What f has been before the range is taken as zero, and what comes after it
   * as f again, faded out over a time as long as the range.
   *
   * Tables are made when a depth is first used: not for several threads.
   */
  class AnalyticSignal
  {
  public:
    /** Throws InputError if the range is empty. */
    AnalyticSignal(std::function<double(double)> f, const SignalRange &range);

    /**
     * F at @p time [s], imaginary part >= 0 (anything below is taken as 0). Its
     * real part is f itself if @p time is real. Times outside of the range are
     * correct, too, but cost a sum over all samples.
     */
    std::complex<double> operator()(const std::complex<double> &time) const;

  private:
    using Complex = std::complex<double>;

    /** Sum at the complex time z in samples. */
    Complex sum(const Complex &z) const;
    const std::vector<Complex> &level(std::size_t m) const;

    std::function<double(double)> f;
    SignalRange range;
    long n_steps; /**< number of steps of the range */
    std::vector<double> samples;
    /** Spectrum of the samples, padded with zeros. */
    std::vector<Complex> spectrum;
    mutable std::vector<std::vector<Complex>> levels;
  };
} // namespace quoin

#endif
