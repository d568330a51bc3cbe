// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/farfield/boundary_parameters.h>
#include <quoin/signals/signal_text.h>

#include <cmath>

namespace quoin
{
  namespace
  {
    const std::vector<std::pair<std::string, IncidentWaveType>> wave_words
        = { { "plane P", IncidentWaveType::plane_p },
            { "plane SV", IncidentWaveType::plane_sv },
            { "Rayleigh", IncidentWaveType::rayleigh },
            { "line source", IncidentWaveType::line_source } };

    void check_wave(const ParameterSection &section,
                    const IncidentWaveParameters &wave)
    {
      const bool has_signal = wave.signal_entry == "Signal";
      if (has_signal && section.text("Displacement") != "0")
        section.fail("Displacement", "is given beside 'Signal': give one of "
                                     "them.");
      if (!has_signal && wave.n_integrations > 0)
        section.fail("Motion", "is for 'Signal': give that, and no "
                               "'Displacement'.");
      if (wave.type == IncidentWaveType::line_source)
      {
        if (wave.half_plane)
          section.fail("Space",
                       "is not for a line source, whose field is that "
                       "of the full plane: leave it at 'full plane' and "
                       "make the free surface a boundary.");
        if (!has_signal)
          section.fail("Signal",
                       "must give the moment of the line source, by a "
                       "factor 'Amplitude'.");
        if (wave.n_integrations > 0)
          section.fail("Motion",
                       "is not for a line source: its 'Signal' is the "
                       "moment. Leave it at 'displacement'.");
      }
    }

    void enter_angle(ParameterEntries &entries, IncidentWaveParameters &wave)
    {
      const ParameterSection *section = entries.read_section();
      const bool surface              = wave.type == IncidentWaveType::rayleigh;
      if (section && surface && !wave.half_plane)
        section->fail("Space", "has no surface for a Rayleigh wave: it needs "
                               "'half-plane'.");
      const double limit = wave.half_plane && !surface ? 89. : 360.;
      if (section && surface && std::abs(section->number("Angle")) != 90.)
        section->fail("Angle", "must be 90 or -90 for a Rayleigh wave, which "
                               "travels along the surface to +x or -x.");
      entries.within("Angle", wave.angle, -limit, limit,
                     "Direction of propagation, from the upward vertical "
                     "towards +x; 90 or -90 for Rayleigh waves [deg]",
                     constants::degree);
    }

    /** Refuses a signal of another motion than 'Motion' says. */
    void check_motion(const ParameterSection &section, const std::string &text,
                      const IncidentWaveParameters &wave)
    {
      std::string why = other_motion_text(text, int(wave.n_integrations));
      if (why.empty() || wave.type == IncidentWaveType::line_source)
        return;
      for (const int derivative : { 0, 1, 2 })
        if (other_motion_text(text, derivative).empty())
          why += ", or give it as 'Signal' with 'Motion = "
                 + motion_word(derivative) + "'";
      section.fail(wave.signal_entry, why + ".");
    }

    void enter_wave(ParameterEntries &entries, IncidentWaveParameters &wave)
    {
      using Type = IncidentWaveType;
      entries.choice(
          "Type", wave.type, wave_words,
          "Type of the wave. plane P: motion along the direction of "
          "propagation; plane SV: motion across it; Rayleigh: along the free "
          "surface; line source: an explosion in the domain.");
      entries.choice("Space", wave.half_plane,
                     { { "full plane", false }, { "half-plane", true } },
                     "Medium of the wave. full plane: no free surface; "
                     "half-plane: the medium is below y = 0, where the wave is "
                     "reflected, and no boundary may be above. Rayleigh waves "
                     "need 'half-plane', line sources 'full plane'.");
      enter_angle(entries, wave);
      if (entries.reads_if(wave.type == Type::line_source))
        entries.numbers("Position", wave.position,
                        "Position x, y of a line source [m]");
      std::string signal, displacement = "0";
      entries.text(
          "Signal", signal,
          "Time history of the wave, a function of t [s]: motion of the "
          "incident wave at the origin, which is the vertical one for a "
          "Rayleigh wave, or moment per length of a line source. It is given "
          "by an expression, table, wavelet, pulse, record or synthetic "
          "motion, and is 0 before the wave's start.");
      entries.choice<unsigned int>(
          "Motion", wave.n_integrations,
          { { "displacement", 0 }, { "velocity", 1 }, { "acceleration", 2 } },
          "Quantity of 'Signal'. Velocities and accelerations are integrated "
          "from t = 0 on, or in closed form; the moment of a line source is "
          "not integrated.");
      entries.number("Amplitude", wave.amplitude,
                     "Factor on the signal [m, m/s, m/s^2; line source: N]");
      entries.text("Displacement", displacement,
                   "Displacement of the incident wave as a function of t, "
                   "instead of 'Signal', for 'Motion = displacement' [m]");
      wave.signal_entry = signal.empty() ? "Displacement" : "Signal";
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      check_wave(*section, wave);
      const std::string &text = signal.empty() ? displacement : signal;
      wave.signal             = section->made(
                      wave.signal_entry,
                      [&]() { return TimeFunction(text, section->folder()).signal(); });
      check_motion(*section, text, wave);
      if (TimeFunction::names_total(text))
        section->fail(wave.signal_entry,
                      "depends on T, the time of the run, but waves are "
                      "functions of t alone, the time since the boundary "
                      "elements began to act. Write t.");
    }
  } // namespace

  void IncidentWaveParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_wave);
  }

  IncidentWaveParameters
  IncidentWaveParameters::read(const ParameterSection &section,
                               const std::string &name)
  {
    IncidentWaveParameters wave = read_entries(section, enter_wave);
    wave.name                   = name;
    return wave;
  }

  std::string IncidentWaveParameters::type_text() const
  {
    return word_of(wave_words, type)
           + (type == IncidentWaveType::line_source ? "" : " wave");
  }

  std::function<double(double)>
  IncidentWaveParameters::function(const double begin, const double end,
                                   const double step) const
  {
    return [f      = integrated(signal, n_integrations, begin, end, step),
            factor = amplitude](const double t) { return factor * f(t); };
  }
} // namespace quoin
