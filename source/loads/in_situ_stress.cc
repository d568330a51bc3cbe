// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/finite_numbers.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/loads/in_situ_stress.h>
#include <quoin/signals/space_time_function.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>

namespace quoin
{
  namespace
  {
    using dealii::Utilities::split_string_list;

    /** The number, or the expression of x and y, of @p name. */
    InSituStress::Field field(const ParameterSection &section,
                              const std::string &name, InSituStress &stress)
    {
      static const std::regex z("\\bz\\b");
      const bool names_z = std::regex_search(section.text(name), z);
      stress.names_z |= names_z;
      const SpaceTimeFunction value = section.made(
          name,
          [&]()
          {
            return SpaceTimeFunction(section.text(name), section.folder(),
                                     names_z ? 3 : 2);
          });
      if (value.depends_on_time())
        section.fail(name, "depends on time, but it is the stress where the "
                           "run begins. Give a number or an expression of x "
                           "and y alone.");
      return [value](const dealii::Point<3> &p) { return value(p, 0.); };
    }

    /** As field(), but a ratio that is a number must not be negative. */
    InSituStress::Field ratio(const ParameterSection &section,
                              const std::string &name, InSituStress &stress)
    {
      const auto value = field(section, name, stress);
      if (!SpaceTimeFunction::names_place(section.text(name))
          && !(value({}) >= 0.))
        section.fail(name, "must be a number that is not negative, or an "
                           "expression of x and y.");
      return value;
    }

    /** The height of the surface as an expression of x or, in three
        dimensions, of x and y. */
    InSituStress::Field height_function(const ParameterSection &section,
                                        InSituStress &stress)
    {
      static const std::regex y("\\by\\b"), z("\\bz\\b");
      const std::string text = section.text("Surface");
      if (std::regex_search(text, z))
        section.fail("Surface",
                     "depends on z, but it is the height of the ground: give "
                     "an expression of x and, in three dimensions, y [m].");
      stress.surface_names_y = std::regex_search(text, y);
      return field(section, "Surface", stress);
    }

    std::vector<std::array<double, 2>>
    read_surface(const ParameterSection &section)
    {
      const std::string must_be
          = "must be the height of a horizontal surface, points x, y; x, y "
            "with x ascending, or an expression of x [m].";
      const bool is_level
          = section.text("Surface").find_first_of(",;") == std::string::npos;
      const auto rows
          = number_rows(section, "Surface", is_level ? 1 : 2, must_be);
      if (rows.empty())
        section.fail("Surface", must_be);
      if (is_level)
        return { { { 0., rows[0][0] } } };
      std::vector<std::array<double, 2>> surface;
      for (const auto &row : rows)
      {
        if (!surface.empty() && row[0] <= surface.back()[0])
          section.fail("Surface", must_be);
        surface.push_back({ { row[0], row[1] } });
      }
      return surface;
    }

    std::vector<InSituStress::Layer>
    read_layers(const ParameterSection &section)
    {
      constexpr double lowest = -std::numeric_limits<double>::infinity();
      std::vector<InSituStress::Layer> layers;
      const auto words = section.list("Unit weight");
      for (unsigned int i = 0; i < words.size(); ++i)
      {
        const bool is_last = i + 1 == words.size();
        const auto values  = finite_numbers(split_string_list(words[i], ':'));
        if (values.size() != (is_last ? 1 : 2) || values[0] < 0.
            || (!is_last && !layers.empty() && values[1] >= layers.back().foot))
          section.fail("Unit weight",
                       "must be a weight [N/m^3], not negative, or those of "
                       "layers downwards, each but the last with the height of "
                       "its foot [m], such as 18e3:-5, 21e3:-12, 26e3.");
        layers.push_back({ values[0], is_last ? lowest : values[1] });
      }
      if (layers.empty())
        section.fail("Unit weight", "must be given for an in-situ stress: "
                                    "density times gravity [N/m^3].");
      return layers;
    }

    void read_out_of_plane_ratio(const ParameterSection &section,
                                 InSituStress &stress)
    {
      if (section.text("Out-of-plane ratio") == "same")
        return;
      stress.has_out_of_plane    = true;
      stress.out_of_plane_ratio  = ratio(section, "Out-of-plane ratio", stress);
      stress.out_of_plane_stress = InSituStress::uniform(0.);
    }
  } // namespace

  double InSituStress::surface_height(const dealii::Point<3> &p) const
  {
    if (surface_function)
      return surface_function(p);
    const double x  = p[0];
    const auto next = std::upper_bound(
        surface.begin(), surface.end(), x,
        [](const double at, const std::array<double, 2> &point)
        { return at < point[0]; });
    if (next == surface.begin())
      return surface.front()[1];
    if (next == surface.end())
      return surface.back()[1];
    const auto &[x0, y0] = *(next - 1);
    return y0 + (x - x0) * ((*next)[1] - y0) / ((*next)[0] - x0);
  }

  std::array<double, 3>
  InSituStress::normal_stress(const dealii::Point<3> &p,
                              const unsigned int vertical_axis) const
  {
    const double height = surface_height(p), y = p[vertical_axis];
    dealii::Point<3> on_surface = p;
    on_surface[vertical_axis]   = height;
    // Points of a horizontal surface must not fall above it by rounding.
    if (y > height + 1e-12 * (1. + std::abs(height)))
      return {};
    double vertical = -pressure(on_surface), top = height;
    for (const Layer &layer : layers)
    {
      const double bottom = std::max(y, layer.foot);
      if (bottom < top)
      {
        vertical -= layer.unit_weight * (top - bottom);
        top = bottom;
      }
    }
    return { { horizontal_ratio(p) * vertical + horizontal_stress(p), vertical,
               out_of_plane_ratio(p) * vertical + out_of_plane_stress(p) } };
  }

  void InSituStress::enter(ParameterEntries &entries)
  {
    entries.other(
        "Surface", "0",
        "Ground surface of an in-situ stress: its height y, points x, y; x, y "
        "of its line, which is horizontal beyond the first and the last point, "
        "or an expression of x; the stress is zero above it. In three "
        "dimensions the height is z, the points are x, z, and the expression "
        "is one of x and y [m]",
        [&](const ParameterSection &section)
        {
          if (SpaceTimeFunction::names_place(section.text("Surface")))
            surface_function = height_function(section, *this);
          else
            surface = read_surface(section);
        });
    entries.other("Unit weight", "",
                  "Unit weight of the ground for an in-situ stress; or of its "
                  "layers from top to bottom, each but the last with the "
                  "height of its base [m]: 18e3:-5, 21e3:-12, 26e3 [N/m^3]",
                  [&](const ParameterSection &section)
                  { layers = read_layers(section); });
    const auto enter_field
        = [&](const std::string &name, Field &value, const std::string &preset,
              const auto &read, const std::string &sentence)
    {
      entries.other(name, preset, sentence,
                    [&](const ParameterSection &section)
                    { value = read(section, name, *this); });
    };
    enter_field(
        "Surface pressure", pressure, "0", field,
        "Pressure on the ground surface of an in-situ stress, in addition to "
        "the weight of the ground: a number or an expression of x [Pa]");
    enter_field("Horizontal ratio", horizontal_ratio, "1", ratio,
                "Ratio K0 of horizontal to vertical stress of an in-situ "
                "stress: a number or an expression of x and y [-]");
    enter_field("Horizontal surface stress", horizontal_stress, "0", field,
                "Horizontal stress of an in-situ stress that is locked in at "
                "every depth, in addition to K0 times the vertical stress, "
                "tension positive: a number or an expression of x and y [Pa]");
    out_of_plane_ratio  = horizontal_ratio;
    out_of_plane_stress = horizontal_stress;
    entries.other(
        "Out-of-plane ratio", "same",
        "Ratio of out-of-plane to vertical stress of an in-situ stress in "
        "plane strain, in three dimensions of the one along y: a number or an "
        "expression of x and y; 'same': as the horizontal stress, including "
        "what is locked in [-]",
        [&](const ParameterSection &section)
        { read_out_of_plane_ratio(section, *this); });
  }
} // namespace quoin
