// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/shaking.h>
#include <quoin/problems/signal_frequency.h>
#include <quoin/base/number_text.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** A power of two and one: transforms are fast. */
    constexpr unsigned int n_samples = 16385;

    /** What a function of time stands for beside a velocity of particles. */
    enum class Kind
    {
      velocity,     /**< or a stress, which goes with it in a wave */
      displacement, /**< or the moment of a source */
      acceleration
    };

    double frequency_of(const FunctionOfTime &function, const Kind kind,
                        const double duration)
    {
      const double interval = duration / (n_samples - 1);
      const auto samples    = sampled(function, duration, n_samples);
      if (!std::all_of(samples.begin(), samples.end(),
                       [](const double v) { return std::isfinite(v); }))
        return 0.; // the run will say where
      switch (kind)
      {
      case Kind::displacement:
        return highest_frequency(derivative(samples, interval), interval);
      case Kind::acceleration:
        return highest_frequency(integral(samples, interval), interval);
      default:
        return highest_frequency(samples, interval);
      }
    }

    Kind kind_of(const LoadParameters &load, const LoadComponent &component)
    {
      if (load.type == LoadType::gravity)
        return Kind::acceleration;
      return component.quantity == LoadQuantity::displacement
                 ? Kind::displacement
                 : Kind::velocity;
    }

    void take_faster(const std::string &name, const double frequency,
                     Shaking &fastest)
    {
      if (frequency > fastest.frequency)
        fastest = { name, frequency };
    }

    /** In the middle of an element, at some elements of boundary @p curve. */
    double frequency_of(const SpaceTimeFunction &function, const Kind kind,
                        const BoundaryGeometry &geometry,
                        const unsigned int curve, const double duration)
    {
      constexpr unsigned int most_places = 8;
      if (!function.depends_on_time())
        return 0.;
      std::vector<Eigen::Vector2d> places;
      for (unsigned int e = 0; e < geometry.owner.size(); ++e)
        if (geometry.owner[e] == curve)
          places.push_back(0.5
                           * (geometry.boundary.elements[e].a
                              + geometry.boundary.elements[e].b));
      const std::size_t n
          = function.depends_on_place()
                ? std::min<std::size_t>(most_places, places.size())
                : 1;
      double highest = 0.;
      for (std::size_t i = 0; i < n && !places.empty(); ++i)
      {
        const Eigen::Vector2d &x = places[i * places.size() / n];
        highest = std::max(highest, frequency_of([&](const double t)
                                                 { return function(x, t); },
                                                 kind, duration));
      }
      return highest;
    }
  } // namespace

  double start_of_stage(const std::vector<StageParameters> &stages,
                        const unsigned int index)
  {
    double start = 0.;
    for (unsigned int i = 0; i < index; ++i)
      if (stages[i].end == StageEnd::time)
        start += stages[i].duration;
    return start;
  }

  const LoadParameters *find_load(const Parameters &parameters,
                                  const std::string &name)
  {
    for (const LoadParameters &load : parameters.loads)
      if (load.name == name)
        return &load;
    return nullptr;
  }

  Shaking fastest_load(const Parameters &parameters, const unsigned int index)
  {
    const StageParameters &stage = parameters.stages[index];
    const double start           = start_of_stage(parameters.stages, index);
    Shaking fastest;
    for (const std::string &name : stage.loads)
      if (const LoadParameters *load = find_load(parameters, name))
        for (const LoadComponent &component : load->components)
          if (component.quantity != LoadQuantity::free)
            take_faster("the load " + name,
                        frequency_of(
                            [&](const double t) {
                              return component.value({ t, start + t });
                            },
                            kind_of(*load, component), stage.duration),
                        fastest);
    return fastest;
  }

  Shaking fastest_boundary_value(const BoundaryElementParameters &parameters,
                                 const BoundaryGeometry &geometry,
                                 const double duration)
  {
    const double interval = duration / (n_samples - 1);
    Shaking fastest;
    for (const IncidentWaveParameters &wave : parameters.waves)
      take_faster("the incident wave " + wave.name,
                  frequency_of(wave.function(0., duration, interval),
                               Kind::displacement, duration),
                  fastest);
    for (unsigned int k = 0; k < parameters.boundaries.size(); ++k)
    {
      const BoundaryCurveParameters &curve = parameters.boundaries[k];
      if (curve.shape == BoundaryShape::interface)
        continue;
      const std::string name = "what is given on the boundary " + curve.name;
      for (unsigned int d = 0; d < 2; ++d)
        take_faster(name,
                    frequency_of(curve.value[d],
                                 curve.traction_is_given[d]
                                     ? Kind::velocity
                                     : Kind::displacement,
                                 geometry, k, duration),
                    fastest);
      take_faster(
          name,
          frequency_of(curve.pressure, Kind::velocity, geometry, k, duration),
          fastest);
    }
    return fastest;
  }

  std::vector<std::string> element_advice(const Shaking &shaking,
                                          const double shear_wave,
                                          const double length)
  {
    if (!(length * shaking.frequency * fewest_edges > shear_wave))
      return {};
    return { "boundary elements: " + shaking.name
             + " brings frequencies of up to " + number_text(shaking.frequency)
             + " Hz, whose S waves are "
             + number_text(shear_wave / shaking.frequency)
             + " m long. They need eight to ten elements, but elements are up "
               "to "
             + number_text(length) + " m long. Take 'Highest frequency = "
             + number_text(shaking.frequency)
             + "' instead of their lengths, or lower the frequency." };
  }
} // namespace quoin
