// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/farfield/incident_waves.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/elastodynamics/line_source.h>
#include <quoin/elastodynamics/plane_wave.h>
#include <quoin/elastodynamics/rayleigh_wave.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace quoin
{
  namespace
  {
    using Eigen::VectorXd;
  } // namespace

  IncidentWaves::IncidentWaves(const BoundaryElementParameters &settings,
                               const ElasticMedium &medium,
                               const Boundary &boundary,
                               const std::vector<dealii::Point<2>> &points,
                               const double duration, const double time_step)
    : boundary(boundary),
      tractions_at_end(settings.formulation
                       == Formulation::convolution_quadrature)
  {
    // How much earlier or later than at the origin a wave can pass: hardly any
    // is slower than 0.85 c2, and signals are correct beyond their range, too.
    double reach = 0.;
    for (const BoundaryElement &element : boundary.elements)
      reach = std::max({ reach, element.a.norm(), element.b.norm() });
    for (const dealii::Point<2> &x : points)
      reach = std::max(reach, x.norm());
    const double delay = reach / (0.85 * medium.c2);
    // Tractions of convolution quadrature are needed half a step later.
    const double end = duration + time_step;
    const SignalRange range{ -delay, end + delay, 0.5 * time_step };

    for (const IncidentWaveParameters &wave : settings.waves)
    {
      using Type = IncidentWaveType;
      check_place(wave, points);
      // Analytic signals want the signal for as long again.
      const auto signal
          = wave.function(0., 2. * range.end - range.begin, range.step);
      try
      {
        switch (wave.type)
        {
        case Type::plane_p:
        case Type::plane_sv:
          waves.push_back(std::make_unique<PlaneWave>(
              medium,
              wave.type == Type::plane_p ? PlaneWave::Type::P
                                         : PlaneWave::Type::SV,
              wave.half_plane, wave.angle, signal, range));
          break;
        case Type::rayleigh:
          waves.push_back(std::make_unique<RayleighWave>(
              medium, wave.angle > 0., signal, range));
          break;
        case Type::line_source:
          waves.push_back(std::make_unique<LineSource>(
              medium, dealii::Point<2>(wave.position[0], wave.position[1]),
              signal, SignalRange{ 0., end, 0.25 * time_step }));
          break;
        }
      }
      catch (const InputError &error)
      {
        throw InputError("section 'Incident waves/" + wave.name
                         + "': " + error.what());
      }
      check_start(wave, *waves.back(), signal, duration, time_step);
      if (!wave.signal.report.empty())
        report_texts.push_back("incident wave " + wave.name + ": "
                               + wave.signal.report);
    }
  }

  void
  IncidentWaves::check_place(const IncidentWaveParameters &wave,
                             const std::vector<dealii::Point<2>> &points) const
  {
    const std::string section = "section 'Incident waves/" + wave.name + "': ";
    if (wave.half_plane)
      for (const BoundaryElement &element : boundary.elements)
      {
        const double slack = 1e-9 * element.length();
        if (element.a[1] > slack || element.b[1] > slack)
          throw InputError(section
                           + "'Space = half-plane' is the medium below y = "
                             "0, but the boundary comes above it. Move it "
                             "down.");
      }
    if (wave.type != IncidentWaveType::line_source)
      return;
    const dealii::Point<2> source(wave.position[0], wave.position[1]);
    const std::string position = "'Position = " + number_text(source[0]) + ", "
                                 + number_text(source[1]) + "'";
    const NearestElement nearest = nearest_element(boundary, source);
    const double length          = boundary.elements[nearest.element].length();
    if (!nearest.inside_domain || nearest.distance < length)
      throw InputError(section + position
                       + " is not in the domain, or less than an element, "
                       + number_text(length)
                       + " m, away from the boundary. Move the source, or give "
                         "shorter elements.");
    for (const dealii::Point<2> &x : points)
      if ((x - source).norm() < 1e-6 * length)
        throw InputError(section + position
                         + " is a point where the field is evaluated, by "
                           "'Histories' or the 'Sampled field': the field "
                           "has no value there. Move one of them.");
  }

  void IncidentWaves::check_start(const IncidentWaveParameters &wave,
                                  const IncidentField &field,
                                  const std::function<double(double)> &signal,
                                  const double duration, const double time_step)
  {
    const std::string section = "section 'Incident waves/" + wave.name + "': '"
                                + wave.signal_entry + "': ";
    double peak = 0.;
    // All steps, or of a very long run as many as take no time to look at.
    constexpr std::uint64_t most_samples = 1000000;
    const auto n                         = std::uint64_t(duration / time_step);
    for (std::uint64_t k = 0; k <= n; k += 1 + n / most_samples)
    {
      const double t = double(k) * time_step;
      if (!std::isfinite(signal(t)))
        throw InputError(section + "it is not finite at t = " + number_text(t)
                         + " s. Change the expression so that it has a value "
                           "at all times of the run.");
      peak = std::max(peak, std::abs(signal(t)));
    }
    if (wave.type == IncidentWaveType::line_source)
    {
      if (!(std::abs(signal(0.)) <= 1e-3 * peak))
        throw InputError(section + "the moment is " + number_text(signal(0.))
                         + " N at t = 0 already. Let it begin at 0.");
      return;
    }
    const auto motion = [&](const double t)
    { return field.displacements(boundary, t).lpNorm<Eigen::Infinity>(); };
    const double start = motion(0.);
    // How much later the wave must come so that little precedes it at 0.
    const auto delay = [&]()
    {
      double result = time_step;
      while (!(motion(-result) <= 1e-3 * peak) && result < 1e3 * duration)
        result *= 1.1;
      return result;
    };
    if (!(start <= 1e-3 * peak))
      throw InputError(
          section + "at t = 0 the wave moves the boundary by "
          + number_text(start) + " m already"
          + (field.has_precursors()
                 ? ", more than a thousandth of the peak, " + number_text(peak)
                       + " m. Its displacement contains the Hilbert transform "
                         "of the signal, which precedes the wave, far ahead if "
                         "the signal has a mean. Let it start "
                       + number_text(delay())
                       + " s later, or, if it has a mean, take one without, "
                         "such as 'wavelet Ricker'."
                 : std::string(". Everything must be at rest then: let it "
                               "start later, and be 0 before.")));
    if (field.has_precursors() && peak > 0.)
      report_texts.push_back(
          "incident wave " + wave.name
          + ": its displacement contains the Hilbert transform of the signal; "
            "at t = 0 the boundary has "
          + number_text(start / peak) + " of the peak");
  }

  dealii::Tensor<1, 2> IncidentWaves::displacement(const dealii::Point<2> &x,
                                                   const double time) const
  {
    dealii::Tensor<1, 2> sum = dealii::Tensor<1, 2>();
    for (const auto &wave : waves)
      sum += wave->displacement(x, time);
    return sum;
  }

  double IncidentWaves::energy(const ElasticMedium &medium,
                               const std::vector<unsigned int> &elements,
                               const double duration,
                               const double time_step) const
  {
    constexpr std::size_t n_places = 16;
    const std::size_t stride       = 1 + (elements.size() - 1) / n_places;
    double length = 0., square = 0.; // of v over time [m^2/s]
    for (std::size_t k = 0; k < elements.size(); ++k)
    {
      const BoundaryElement &element = boundary.elements[elements[k]];
      length += element.length();
      if (k % stride != 0)
        continue;
      auto last = displacement(element.middle(), 0.);
      for (double t = time_step; t < duration + time_step; t += time_step)
      {
        const auto now = displacement(element.middle(), t);
        square += (now - last).norm_square() / time_step;
        last = now;
      }
    }
    const double places = double((elements.size() - 1) / stride + 1);
    return medium.density * medium.c2 * length * square / places;
  }

  VectorXd IncidentWaves::displacements(const double time) const
  {
    VectorXd sum = VectorXd::Zero(Eigen::Index(boundary.n_unknowns()));
    for (const auto &wave : waves)
      sum += wave->displacements(boundary, time);
    return sum;
  }

  VectorXd IncidentWaves::tractions(const double begin, const double end) const
  {
    // The value at the end, of which a mean about it is one of second order.
    const double shift = tractions_at_end ? 0.5 * (end - begin) : 0.;
    VectorXd sum       = VectorXd::Zero(Eigen::Index(boundary.n_unknowns()));
    for (const auto &wave : waves)
      sum += wave->mean_tractions(boundary, begin + shift, end + shift);
    return sum;
  }
} // namespace quoin
