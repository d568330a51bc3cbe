// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/eigen_core.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/base/point_text.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/absorbing/plane_waves.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

namespace quoin
{
  namespace
  {
    using Vector = dealii::Tensor<1, 3>;

    std::string section_of(const LoadParameters &load)
    {
      return "section 'Loads/" + load.name + "': ";
    }

    Vector unit(const unsigned int d)
    {
      Vector e;
      e[d] = 1.;
      return e;
    }

    constexpr const char *signal_names[]
        = { "Incident normal velocity", "Incident shear velocity",
            "Incident lateral velocity" };
  } // namespace

  PlaneWaves::PlaneWaves(const LoadParameters &load, const Impedance &impedance)
    : impedance(impedance)
  {
    const double density = impedance.density;
    speed[0]             = impedance.normal / density;
    speed[1]             = impedance.shear / density;
    mu                   = impedance.shear * speed[1];
    lambda               = impedance.normal * speed[0] - 2. * mu;
    direction            = *load.wave_direction / load.wave_direction->norm();
    Vector ahead         = direction - direction[2] * unit(2);
    ahead                = ahead.norm() > 1e-9 ? ahead / ahead.norm() : unit(0);
    across               = cross_product_3d(unit(2), ahead);
    const Vector polarisation[3]
        = { direction, cross_product_3d(across, direction), across };
    if (load.wave_origin)
      origin = *load.wave_origin;
    for (const unsigned int k : { 0, 1, 2 })
    {
      if (load.components[k].quantity == LoadQuantity::free)
        continue;
      const Component incident{ k, polarisation[k],
                                direction / speed[k == 0 ? 0 : 1], 0. };
      waves.push_back(incident);
      if (load.free_surface)
        reflect(incident, load);
    }
  }

  void PlaneWaves::reflect(const Component &incident,
                           const LoadParameters &load)
  {
    if (!(direction[2] > 1e-9))
      throw InputError(section_of(load)
                       + "the wave does not rise to the 'Free surface'. Give "
                         "an 'Incident direction' with a positive z, or set "
                         "'Free surface = none'.");
    // At the surface above the origin all have the delay of the incident one.
    const double height = *load.free_surface - origin[2];
    const auto push     = [&](Component wave)
    {
      wave.delay = (incident.slowness[2] - wave.slowness[2]) * height;
      waves.push_back(wave);
    };
    if (incident.signal == 2) // comes back as it is, at any angle
    {
      push({ 2, across, incident.slowness - 2. * incident.slowness[2] * unit(2),
             0. });
      return;
    }
    const Vector along = incident.slowness - incident.slowness[2] * unit(2);
    // Reflected P, SV and SH wave go down, as fast along the surface.
    Component reflected[3];
    Eigen::Matrix3d tractions;
    for (const unsigned int k : { 0, 1, 2 })
    {
      const double c     = speed[k == 0 ? 0 : 1];
      const double steep = 1. / (c * c) - along.norm_square();
      if (steep <= 0.)
        throw InputError(text_of(
            section_of(load), "the SV wave meets the 'Free surface' at ",
            std::asin(along.norm() * speed[1]) / constants::degree,
            " degrees from the vertical, and beyond the critical angle of ",
            std::asin(speed[1] / speed[0]) / constants::degree,
            " degrees the P wave that it makes clings to the surface. Make it "
            "steeper, or set 'Free surface = none'."));
      const Vector s         = along - std::sqrt(steep) * unit(2);
      const Vector d         = c * s;
      reflected[k].signal    = incident.signal;
      reflected[k].slowness  = s;
      reflected[k].amplitude = k == 0   ? d
                               : k == 1 ? cross_product_3d(across, d)
                                        : across;
      const Vector t         = stress_vector(reflected[k], unit(2));
      for (unsigned int c = 0; c < 3; ++c)
        tractions(c, k) = t[c];
    }
    const Vector t = stress_vector(incident, unit(2));
    const Eigen::Vector3d factor
        = tractions.lu().solve(Eigen::Vector3d(-t[0], -t[1], -t[2]));
    for (const unsigned int k : { 0, 1, 2 })
      if (std::abs(factor[k]) > 1e-12)
      {
        reflected[k].amplitude *= factor[k];
        push(reflected[k]);
      }
  }

  double PlaneWaves::arrival(const Component &wave,
                             const dealii::Point<3> &x) const
  {
    return wave.slowness * (x - origin) + wave.delay;
  }

  Vector PlaneWaves::stress_vector(const Component &wave, const Vector &n) const
  {
    const Vector &a = wave.amplitude, &s = wave.slowness;
    return -lambda * (a * s) * n - mu * ((s * n) * a + (a * n) * s);
  }

  Vector PlaneWaves::traction(const Component &wave, const Vector &n) const
  {
    const Vector &a = wave.amplitude;
    return stress_vector(wave, n) + impedance.shear * a
           + (impedance.normal - impedance.shear) * (a * n) * n;
  }

  namespace
  {
    /** The place of the boundary that the wave of @p load reaches first. */
    dealii::Point<3> first_place(const LoadParameters &load,
                                 const std::vector<BoundaryFace<3>> &faces)
    {
      dealii::Point<3> first = faces.front().points[0];
      for (const BoundaryFace<3> &face : faces)
        for (const dealii::Point<3> &p : face.points)
          if (*load.wave_direction * (p - first) < 0.)
            first = p;
      return first;
    }

    void refuse_other_media(const LoadParameters &load,
                            const std::vector<BoundaryFace<3>> &faces,
                            const std::vector<Impedance> &impedance)
    {
      const Impedance &medium = impedance[faces.front().group];
      for (const BoundaryFace<3> &face : faces)
        if (const Impedance &z = impedance[face.group];
            z.normal != medium.normal || z.shear != medium.shear
            || z.density != medium.density)
          throw InputError(
              section_of(load)
              + "a plane wave with an 'Incident direction' passes one medium, "
                "but different materials stand at the boundary. Name that of "
                "the medium as 'Far field material', or let the wave rise "
                "vertically, without a direction.");
    }

    void refuse_low_surface(const LoadParameters &load,
                            const std::vector<BoundaryFace<3>> &faces)
    {
      if (!load.free_surface)
        return;
      for (const BoundaryFace<3> &face : faces)
        for (const dealii::Point<3> &p : face.points)
          if (p[2] > *load.free_surface + 1e-6 * std::abs(p[2]))
            throw InputError(text_of(
                section_of(load), "'Free surface = ", *load.free_surface,
                "' is below ", point_text(p),
                " m of the boundary. Give the height of the ground above the "
                "model."));
    }

    void refuse_late_origin(const LoadParameters &load,
                            const dealii::Point<3> &place, const double delay)
    {
      throw InputError(text_of(
          section_of(load), "the wave passes 'Incident origin' at t = 0, but (",
          place[0], ", ", place[1], ", ", place[2], ") m of the boundary ",
          -delay,
          " s earlier. Move the origin against the direction, or leave it "
          "empty: then the wave reaches the boundary at t = 0."));
    }

    /** Refuses signals that are not zero in the time @p last [s] before 0. */
    void refuse_early_signals(const LoadParameters &load, const double last)
    {
      constexpr unsigned int n = 200;
      for (const unsigned int k : { 0, 1, 2 })
        for (unsigned int i = 1; i <= n; ++i)
        {
          const double t     = -last * i / n;
          const double value = load.components[k].quantity == LoadQuantity::free
                                   ? 0.
                                   : load.components[k].value({ t, t });
          if (std::abs(value) > 1e-12)
            throw InputError(text_of(
                section_of(load), "'", signal_names[k], "' is ", value,
                " m/s at t = ", t,
                " s, before the wave passes the origin. Make it 0 there, as "
                "if(t < 0, 0, ...)."));
        }
    }
  } // namespace

  void find_wave_origins(const NodeMap<3> &node_map,
                         std::vector<LoadParameters> &loads)
  {
    const auto seeks = [](const LoadParameters &load)
    { return load.wave_direction && !load.wave_origin; };
    const auto unit_direction = [](const LoadParameters &load)
    { return *load.wave_direction / load.wave_direction->norm(); };
    std::vector<std::optional<dealii::Point<3>>> origins(loads.size());
    for (unsigned int i = 0; i < loads.size(); ++i)
    {
      if (!seeks(loads[i]))
        continue;
      std::vector<BoundaryFace<3>> faces;
      for (const LoadParameters &other : loads)
      {
        if (!seeks(other)
            || (unit_direction(other) - unit_direction(loads[i])).norm() > 1e-9)
          continue;
        const auto more
            = faces_of_curves(node_map, other.boundaries, other.name);
        faces.insert(faces.end(), more.begin(), more.end());
      }
      origins[i] = first_place(loads[i], faces);
    }
    for (unsigned int i = 0; i < loads.size(); ++i)
      if (origins[i])
        loads[i].wave_origin = origins[i];
  }

  PlaneWaveForces::PlaneWaveForces(const LoadParameters &load,
                                   const NodeMap<3> &node_map,
                                   const std::vector<BoundaryFace<3>> &faces,
                                   const std::vector<Impedance> &impedance,
                                   const std::vector<unsigned int> &nodes)
  {
    refuse_other_media(load, faces, impedance);
    refuse_low_surface(load, faces);
    LoadParameters placed = load;
    if (!load.wave_origin)
      placed.wave_origin = first_place(load, faces);
    const PlaneWaves waves(placed, impedance[faces.front().group]);
    std::vector<Arrival> all;
    double last = 0.;
    for (const BoundaryFace<3> &face : faces)
    {
      const Vector outward = outward_area(face.points);
      const double area    = outward.norm();
      for (const auto &wave : waves.components())
      {
        const Vector force = area / 3. * waves.traction(wave, outward / area);
        for (unsigned int k = 0; k < 3; ++k)
        {
          const double delay = waves.arrival(wave, face.points[k]);
          last               = std::max(last, delay);
          if (delay < -1e-9 * last - 1e-12)
            refuse_late_origin(load, face.points[k], delay);
          const unsigned int v = face.nodes[k];
          if (!node_map.exchange().owns(v))
            continue;
          const unsigned int node
              = std::lower_bound(nodes.begin(), nodes.end(),
                                 node_map.exchange().local(v))
                - nodes.begin();
          all.push_back({ wave.signal, node, delay, force });
        }
      }
    }
    refuse_early_signals(load, last);
    // Faces that share a node have one arrival there.
    const auto key
        = [](const Arrival &a) { return std::tie(a.signal, a.delay, a.node); };
    std::sort(all.begin(), all.end(),
              [&](const Arrival &a, const Arrival &b)
              { return key(a) < key(b); });
    for (const Arrival &arrival : all)
      if (!arrivals.empty() && key(arrivals.back()) == key(arrival))
        arrivals.back().force += arrival.force;
      else
        arrivals.push_back(arrival);
  }

  void PlaneWaveForces::find(const std::array<LoadComponent, 3> &components,
                             const TimePoint &time,
                             std::vector<Vector> &force) const
  {
    std::fill(force.begin(), force.end(), Vector());
    double value          = 0.;
    const Arrival *before = nullptr; // with the value
    for (const Arrival &arrival : arrivals)
    {
      if (!before || before->signal != arrival.signal
          || before->delay != arrival.delay)
        value = components[arrival.signal].value(
            { time.stage - arrival.delay, time.total - arrival.delay });
      before = &arrival;
      force[arrival.node] += value * arrival.force;
    }
  }
} // namespace quoin
