// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loads/load_components.h>
#include <quoin/loads/load_field.h>
#include <quoin/signals/signal_text.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>
#include <vector>

namespace quoin
{
  TimeFunction time_function(const ParameterSection &section,
                             const std::string &name, const std::string &text)
  {
    if (SpaceTimeFunction::names_place(text))
      section.fail(name, "differs from place to place, as only tractions and "
                         "prescribed motions may. Give a function of t and T"
                             + std::string(section.text("Type") == "gravity"
                                               ? ", and its factor by place as "
                                                 "'Distribution'."
                                               : "."));
    return section.made(name,
                        [&]() { return TimeFunction(text, section.folder()); });
  }

  namespace
  {
    /** A component from @p text, by place if the load may differ there. */
    LoadComponent made_component(const ParameterSection &section,
                                 const std::string &name,
                                 const LoadQuantity quantity,
                                 const std::string &text)
    {
      const std::string type = section.text("Type");
      if ((type != "traction" && type != "prescribed motion")
          || !SpaceTimeFunction::names_place(text))
        return { quantity, time_function(section, name, text) };
      // Where there are two dimensions along_axes() refuses z.
      const auto function = section.made(
          name,
          [&]() { return SpaceTimeFunction(text, section.folder(), 3, true); });
      return { quantity, {}, std::make_shared<LoadField>(function) };
    }

    /** The points of the line @p text, x and height by turns [m]. */
    std::vector<std::array<double, 2>>
    line_through(const ParameterSection &section, const std::string &name,
                 const std::string &text)
    {
      const auto refuse = [&]()
      {
        section.fail(name,
                     "needs two points or more, x and the height "
                     "[m], with ascending x: 'water through 0, 12; 30, 10; 50, "
                     "3'.");
      };
      std::vector<std::array<double, 2>> points;
      std::istringstream parts(text);
      for (std::string part; std::getline(parts, part, ';');)
      {
        std::replace(part.begin(), part.end(), ',', ' ');
        std::istringstream words(part);
        std::array<double, 2> point;
        std::string rest;
        if (!(words >> point[0] >> point[1]) || words >> rest
            || (!points.empty() && !(point[0] > points.back()[0])))
          refuse();
        points.push_back(point);
      }
      if (points.size() < 2)
        refuse();
      return points;
    }

    /** The pressure of "water LEVEL". */
    LoadComponent water_pressure(const ParameterSection &section,
                                 const std::string &name)
    {
      const std::string text
          = section.text(name).substr(std::string("water").size());
      if (text.empty())
        section.fail(name, "needs the height up to which the water stands, a "
                           "function of time [m]: 'water LEVEL', such as "
                           "'water 12'.");
      const std::string through = " through ";
      if (text.rfind(through, 0) == 0)
        return { LoadQuantity::force,
                 {},
                 std::make_shared<LoadField>(
                     LoadField::water_below(line_through(
                         section, name, text.substr(through.size())))) };
      const TimeFunction level = time_function(section, name, text);
      return { LoadQuantity::force, level, std::make_shared<LoadField>(level) };
    }

    /** Refuses a signal that is known to be another motion than that which is
        once (velocity: 1) derived by time. */
    void refuse_other_motion(const ParameterSection &section,
                             const std::string &name, const std::string &text,
                             const int derivative)
    {
      const std::string why = other_motion_text(text, derivative);
      if (!why.empty())
        section.fail(name, why + ".");
    }

    int derivative_of(const LoadQuantity quantity)
    {
      return quantity == LoadQuantity::displacement ? 0
             : quantity == LoadQuantity::velocity   ? 1
                                                    : 2;
    }

    /** Words before a function of time and the quantities they name. */
    using Words = std::vector<std::pair<std::string, LoadQuantity>>;

    const Words platen_words = { { "velocity", LoadQuantity::velocity },
                                 { "displacement", LoadQuantity::displacement },
                                 { "force", LoadQuantity::force } };
    const Words rotation_words
        = { { "velocity", LoadQuantity::velocity },
            { "displacement", LoadQuantity::displacement },
            { "moment", LoadQuantity::force } };

    /** "free", or one of @p words and a function of time. */
    LoadComponent component_by_word(const ParameterSection &section,
                                    const std::string &name, const Words &words)
    {
      const std::string text = section.text(name);
      if (text == "free")
        return {};
      std::string known = "'free'";
      for (const auto &[word, quantity] : words)
      {
        if (text.rfind(word + " ", 0) == 0)
        {
          const std::string function = text.substr(word.size());
          // First what is wrong with the function itself.
          LoadComponent made
              = made_component(section, name, quantity, function);
          if (quantity != LoadQuantity::force)
            refuse_other_motion(section, name, function,
                                derivative_of(quantity));
          return made;
        }
        known += " or begin with '" + word + "'";
      }
      section.fail(name, "must be " + known + ".");
    }
  } // namespace

  LoadComponent platen_component(const ParameterSection &section,
                                 const std::string &name)
  {
    return component_by_word(section, name, platen_words);
  }

  LoadComponent rotation_component(const ParameterSection &section,
                                   const std::string &name)
  {
    return component_by_word(section, name, rotation_words);
  }

  LoadComponent load_component(const ParameterSection &section,
                               const std::string &name,
                               const LoadQuantity quantity)
  {
    const std::string text = section.text(name);
    if (text == "free")
      return {};
    const std::string type = section.text("Type");
    for (const std::string word :
         { "velocity", "displacement", "force", "moment" })
      if (text.rfind(word + " ", 0) == 0)
      {
        if (type == "prescribed motion"
            && (word == "velocity" || word == "displacement"))
          return platen_component(section, name);
        section.fail(name, "is a " + word + ", which a load of type '" + type
                               + "' does not take: give a plain function of "
                                 "time"
                               + (type == "prescribed motion"
                                      ? ", or use the type 'traction' or "
                                        "'platen'."
                                      : "."));
      }
    LoadComponent made = made_component(section, name, quantity, text);
    if (quantity != LoadQuantity::force || type == "gravity")
      refuse_other_motion(section, name, text, derivative_of(quantity));
    return made;
  }

  LoadComponent pressure_component(const ParameterSection &section,
                                   const std::string &name)
  {
    const std::string text = section.text(name);
    if (text == "uplift")
      return { LoadQuantity::force, {} };
    return text.substr(0, text.find(' ')) == "water"
               ? water_pressure(section, name)
               : load_component(section, name, LoadQuantity::force);
  }
} // namespace quoin
