// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/farfield/boundary_report.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <array>

namespace quoin
{
  namespace
  {
    /** Values that are given on a boundary. */
    struct GivenValues
    {
      std::string name, unit;
      SignalKind kind;
      const SpaceTimeFunction &function;
    };

    std::vector<GivenValues> given_values(const BoundaryCurveParameters &curve)
    {
      if (curve.shape == BoundaryShape::interface)
        return {};
      const auto of_direction
          = [&](const unsigned int d, const std::string &name) -> GivenValues
      {
        if (curve.traction_is_given[d])
          return { name + " traction", "Pa", SignalKind::velocity,
                   curve.value[d] };
        return { name + " displacement", "m", SignalKind::displacement,
                 curve.value[d] };
      };
      return { of_direction(0, "horizontal"),
               of_direction(1, "vertical"),
               { "pressure", "Pa", SignalKind::velocity, curve.pressure } };
    }

    /** Steps in which waves are integrated from their accelerations or
        velocities. */
    constexpr unsigned int n_intervals = 16384;

    /** Smallest and largest value in the middle of elements. */
    std::array<double, 2> range_on(const SpaceTimeFunction &function,
                                   const std::vector<dealii::Point<2>> &middles,
                                   const double duration)
    {
      std::vector<double> values;
      const std::size_t n = function.depends_on_place() ? middles.size() : 1;
      for (std::size_t i = 0; i < n; ++i)
      {
        const FunctionOfTime there
            = [&](const double t) { return function(middles[i], t); };
        if (n > 1 || !function.depends_on_time())
          for (const double value :
               sampled(there, duration, function.depends_on_time() ? 513 : 2))
            values.push_back(value);
        else
          for (const double value : extremes(there, duration))
            values.push_back(value);
      }
      const auto [low, high]
          = std::minmax_element(values.begin(), values.end());
      return { { *low, *high } };
    }

    /** In the middle of some elements. */
    double frequency_on(const GivenValues &values,
                        const std::vector<dealii::Point<2>> &middles,
                        const double duration)
    {
      constexpr std::size_t most_places = 8;
      const SpaceTimeFunction &function = values.function;
      double highest                    = 0.;
      if (!function.depends_on_time())
        return highest;
      const std::size_t n = std::min(
          middles.size(), function.depends_on_place() ? most_places : 1);
      for (std::size_t i = 0; i < n; ++i)
      {
        const dealii::Point<2> &x = middles[i * middles.size() / n];
        highest
            = std::max(highest, velocity_frequency([&](const double t)
                                                   { return function(x, t); },
                                                   values.kind, duration));
      }
      return highest;
    }
  } // namespace

  std::vector<std::string>
  boundary_lengths(const BoundaryElementParameters &settings,
                   const BoundaryGeometry &geometry)
  {
    std::vector<std::string> lines;
    for (unsigned int k = 0; k < settings.boundaries.size(); ++k)
    {
      unsigned int n = 0;
      double total = 0., least = 1e300, most = 0.;
      for (unsigned int e = 0; e < geometry.owner.size(); ++e)
        if (geometry.owner[e] == k)
        {
          const double length = geometry.boundary.elements[e].length();
          ++n;
          total += length;
          least = std::min(least, length);
          most  = std::max(most, length);
        }
      lines.push_back(text_of("boundary ", settings.boundaries[k].name, ": ", n,
                              " elements over ", total, " m, ",
                              most - least < 1e-6 * most
                                  ? "each " + number_text(most)
                                  : range_text(least, most),
                              " m"));
    }
    return lines;
  }

  std::vector<std::string>
  boundary_lines(const BoundaryElementParameters &settings,
                 const BoundaryGeometry &geometry, const double duration)
  {
    std::vector<std::string> lines;
    for (unsigned int k = 0; k < settings.boundaries.size(); ++k)
    {
      const BoundaryCurveParameters &curve = settings.boundaries[k];
      const auto middles                   = geometry.middles(k);
      const auto all                       = given_values(curve);
      if (all.empty() || middles.empty())
        continue;
      std::vector<std::string> words;
      for (const GivenValues &values : all)
      {
        const auto [low, high] = range_on(values.function, middles, duration);
        if (low != 0. || high != 0. || values.unit != "Pa")
          words.push_back(text_of(values.name, " ", range_text(low, high), " ",
                                  values.unit));
      }
      lines.push_back("boundary " + curve.name + ": "
                      + (words.empty()
                             ? "free of traction"
                             : "given " + boost::algorithm::join(words, ", ")));
    }
    for (const IncidentWaveParameters &wave : settings.waves)
    {
      if (duration == 0.)
        break;
      const bool is_source   = wave.type == IncidentWaveType::line_source;
      const auto [low, high] = extremes(
          wave.function(0., duration, duration / n_intervals), duration);
      lines.push_back(text_of("incident wave ", wave.name, ": ",
                              wave.type_text(),
                              wave.half_plane ? " in the half-plane" : "",
                              is_source ? ", moment " : ", displacement ",
                              range_text(low, high), is_source ? " N" : " m"));
    }
    return lines;
  }

  std::vector<std::string>
  boundary_advice(const BoundaryElementParameters &settings,
                  const BoundaryGeometry &geometry, const double duration,
                  const bool with_stress)
  {
    Shaking fastest;
    for (const IncidentWaveParameters &wave : settings.waves)
      fastest.take_faster(
          "the incident wave " + wave.name,
          velocity_frequency(
              wave.function(0., duration, duration / n_intervals),
              SignalKind::displacement, duration));
    for (unsigned int k = 0; k < settings.boundaries.size(); ++k)
      for (const GivenValues &values : given_values(settings.boundaries[k]))
        fastest.take_faster(
            "what is prescribed on the boundary " + settings.boundaries[k].name,
            frequency_on(values, geometry.middles(k), duration));
    return element_advice(fastest, settings.medium.c2,
                          geometry.boundary.lengths().maxCoeff(), with_stress);
  }

  std::vector<std::string> element_advice(const Shaking &shaking,
                                          const double shear_wave,
                                          const double length,
                                          const bool with_stress)
  {
    /** Elements to an S wave with 3.5 % of error in the hoop stress, and those
        with 1.3 %, which are advised. */
    constexpr double fewest_for_stress = 12., good_for_stress = 20.;
    if (!(length * shaking.frequency
              * (with_stress ? fewest_for_stress : fewest_edges)
          > shear_wave))
      return {};
    const double n = shear_wave / shaking.frequency / length;
    if (n > fewest_edges)
      return { text_of(
          "boundary elements: ", shaking.name, " brings frequencies of up to ",
          shaking.frequency, " Hz, whose S waves are ", n,
          " elements long. That is enough for displacements, but the hoop "
          "stress at that frequency is too low by about ",
          500. / (n * n), " % of its peak. Take ", good_for_stress,
          " elements to a wave for ",
          500. / (good_for_stress * good_for_stress), " %: elements of ",
          shear_wave / shaking.frequency / good_for_stress, " m.") };
    return { text_of(
        "boundary elements: ", shaking.name, " brings frequencies of up to ",
        shaking.frequency, " Hz, whose S waves are ",
        shear_wave / shaking.frequency,
        " m long. They need eight to ten elements, but elements are up to ",
        length, " m long. Take 'Highest frequency = ", shaking.frequency,
        "' instead of their lengths, or lower the frequency.") };
  }

  std::vector<std::string>
  stability_lines(const BoundaryElementParameters &settings,
                  const Boundary &boundary, const double time_step,
                  const std::uint64_t n_steps)
  {
    /**
     * Where tractions are given: c_2 dt / L from which no growth has been seen
     * outside of holes in 30000 steps, for boundaries of up to 64 elements and
     * for longer ones; and for how many steps none was seen with any. Bounded
     * domains may grow at any ratio (doc/boundary_elements.md).
     */
    constexpr double stable_shear_ratio         = 0.55;
    constexpr double stable_shear_ratio_of_many = 0.85;
    constexpr std::size_t few_elements          = 64;
    constexpr std::uint64_t steady_steps        = 500;
    const auto any                              = [&](const auto &is_so)
    {
      return std::any_of(settings.boundaries.begin(), settings.boundaries.end(),
                         is_so);
    };
    if (settings.formulation == Formulation::convolution_quadrature
        || !any(
            [](const BoundaryCurveParameters &curve) {
              return curve.traction_is_given[0] || curve.traction_is_given[1];
            }))
      return {};
    if (settings.formulation == Formulation::collocation)
      return { "Tractions are given: with collocation motion may grow without "
               "end. Take Galerkin or convolution quadrature." };
    // Also a half-plane, whose surface is discretised to a distance.
    const bool is_bounded
        = any([](const BoundaryCurveParameters &curve)
              { return curve.domain == DomainSide::inside; })
          || !any([](const BoundaryCurveParameters &curve)
                  { return curve.domain == DomainSide::outside; });
    const double ratio
        = settings.medium.c2 * time_step / boundary.lengths().maxCoeff();
    const double needed = boundary.n_elements() <= few_elements
                              ? stable_shear_ratio
                              : stable_shear_ratio_of_many;
    if (n_steps <= steady_steps || (!is_bounded && ratio >= needed))
      return {};
    return { text_of(
        "Tractions are given",
        is_bounded ? " on a bounded domain"
                   : text_of(" and c2 dt / L is ", ratio,
                             " on the longest element, below ", needed),
        ": motion may grow slowly after some hundred to thousand steps. Take ",
        is_bounded ? "" : "longer steps, or ",
        "convolution quadrature for long runs.") };
  }

  std::string step_ratio_text(const Boundary &boundary,
                              const ElasticMedium &medium,
                              const double time_step)
  {
    const Eigen::VectorXd lengths = boundary.lengths();
    return "c1 dt / L "
           + range_text(medium.c1 * time_step / lengths.maxCoeff(),
                        medium.c1 * time_step / lengths.minCoeff());
  }

  std::unique_ptr<PassivityReport>
  passivity_of(const InfluenceKernel &kernel, const BoundaryHistory &history,
               const Boundary &boundary, const ElasticMedium &medium,
               const FormulationOptions &options, const double time_step,
               const unsigned int n_frequencies, const MPI_Comm communicator)
  {
    if (n_frequencies == 0)
      return nullptr;
    // As wide as the scan needs to miss little: what rings at a frequency is
    // seen from the next one.
    const double radius = 1. - 0.5 / double(n_frequencies);
    return std::make_unique<PassivityReport>(
        scan_passivity(make_transform(kernel, history, boundary, medium,
                                      options, communicator),
                       boundary, medium, time_step, n_frequencies, radius));
  }
} // namespace quoin
