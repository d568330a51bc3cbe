// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loads/load_field.h>
#include <quoin/loads/stress_entries.h>

#include <deal.II/base/utilities.h>

namespace quoin
{
  namespace
  {
    /** The functions of @p name with semicolons between them, by place. */
    std::vector<SpaceTimeFunction>
    stress_fields(const ParameterSection &section, const std::string &name)
    {
      std::vector<SpaceTimeFunction> fields;
      const auto texts
          = dealii::Utilities::split_string_list(section.text(name), ';');
      for (const std::string &text : texts)
      {
        fields.push_back(section.made(name,
                                      [&]()
                                      {
                                        return SpaceTimeFunction(
                                            text, section.folder(),
                                            texts.size() == 6 ? 3 : 2);
                                      }));
        if (fields.back().depends_on_time())
          section.fail(name, "depends on time, but it is the stress where the "
                             "run begins. Give expressions of x and y alone.");
      }
      return fields;
    }

    void read_stress(const ParameterSection &section, LoadParameters &load)
    {
      const bool has_numbers
          = section.text("Stress").find(';') == std::string::npos;
      const std::string must_be
          = "must be three numbers with commas between them, or three "
            "expressions of x and y with semicolons; in three dimensions six "
            "numbers, or six expressions of x, y and z.";
      if (has_numbers && section.list("Stress").size() == 6)
      {
        load.space_stress = section.numbers<6>("Stress");
        if (section.list("Stress gradient").size() == 6)
          load.space_gradient = section.numbers<6>("Stress gradient");
        else if (section.numbers<3>("Stress gradient")
                 != std::array<double, 3>{})
          section.fail("Stress gradient", "must be six numbers, as 'Stress'.");
        return;
      }
      if (has_numbers)
      {
        if (section.list("Stress").size() != 3)
          section.fail("Stress", must_be);
        load.stress          = section.numbers<3>("Stress");
        load.stress_gradient = section.numbers<3>("Stress gradient");
        return;
      }
      load.stress_fields = stress_fields(section, "Stress");
      if (load.stress_fields.size() != 3 && load.stress_fields.size() != 6)
        section.fail("Stress", must_be);
      if (section.list("Stress gradient").size() != 3
          || section.numbers<3>("Stress gradient") != std::array<double, 3>{})
        section.fail("Stress gradient",
                     "goes with numbers for 'Stress'; it has expressions: "
                     "write the change with y into these.");
    }

    void read_stress_zz(const ParameterSection &section, LoadParameters &load)
    {
      const std::string text = section.text("Stress zz");
      if (text == "elastic")
        return;
      if (load.space_stress || load.stress_fields.size() == 6)
        section.fail("Stress zz", "is one of the six components of 'Stress' in "
                                  "three dimensions. Leave it at 'elastic'.");
      if (load.stress_fields.empty())
      {
        load.stress_zz = section.numbers<2>("Stress zz");
        return;
      }
      const auto zz = stress_fields(section, "Stress zz");
      if (zz.size() != 1)
        section.fail("Stress zz", "must be 'elastic' or one expression of x "
                                  "and y, as 'Stress' has such.");
      load.stress_fields.push_back(zz.front());
    }
  } // namespace

  void enter_initial_stress(ParameterEntries &entries, LoadParameters &load)
  {
    const ParameterSection *section = entries.read_section();
    const bool is_in_situ
        = section && section->text("Type") == "in-situ stress";
    if (entries.reads_if(!is_in_situ))
    {
      entries.other(
          "Stress", "0, 0, 0",
          "Initial stress xx, yy, xy at y = 0, tension positive; or three "
          "expressions of x and y [m] with semicolons between them. In three "
          "dimensions xx, yy, zz, xy, xz, yz at z = 0, or six expressions of "
          "x, y and z [Pa]",
          [&](const ParameterSection &from) { read_stress(from, load); });
      entries.other("Stress gradient", "0, 0, 0",
                    "Gradient of the initial stress xx, yy, xy with y; in "
                    "three dimensions of the six components with z [Pa/m]",
                    [](const ParameterSection &) {});
      entries.other(
          "Stress zz", "elastic",
          "Initial out-of-plane stress in plane strain: its value at y = 0 "
          "[Pa] and its gradient with y [Pa/m]; one expression if 'Stress' "
          "has expressions; or 'elastic' for Poisson's ratio times (xx + "
          "yy). Laws that yield depend on it.",
          [&](const ParameterSection &from) { read_stress_zz(from, load); });
    }
    if (entries.reads_if(is_in_situ))
      load.in_situ.emplace().enter(entries);
  }

  std::array<double, 4>
  LoadParameters::initial_stress(const double x, const double y,
                                 const double poisson) const
  {
    if (in_situ)
      return in_situ->stress(x, y);
    std::array<double, 4> result{};
    const dealii::Point<2> place(x, y);
    for (unsigned int k = 0; k < 3; ++k)
      result[k] = stress_fields.empty() ? stress[k] + y * stress_gradient[k]
                                        : stress_fields[k](place, 0.);
    if (stress_fields.size() == 4)
      result[3] = stress_fields[3](place, 0.);
    else
      result[3] = stress_zz ? (*stress_zz)[0] + y * (*stress_zz)[1]
                            : poisson * (result[0] + result[1]);
    return result;
  }

  std::array<double, 6>
  LoadParameters::initial_stress(const dealii::Point<3> &place) const
  {
    std::array<double, 6> result{};
    if (in_situ)
    {
      const auto normal = in_situ->normal_stress(place, 2);
      return { { normal[0], normal[2], normal[1], 0., 0., 0. } };
    }
    for (unsigned int k = 0; k < 6; ++k)
      if (stress_fields.size() == 6)
        result[k] = stress_fields[k](place, 0.);
      else if (space_stress)
        result[k] = (*space_stress)[k] + place[2] * space_gradient[k];
    return result;
  }
} // namespace quoin
