// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/layout/gmsh_geometry.h>

namespace quoin
{
  std::string braces(const GmshNumbers &numbers)
  {
    std::string text = "{", line(40, ' '); // room for what stands before
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      const std::string word
          = std::to_string(numbers[i]) + (i + 1 < numbers.size() ? "," : "");
      if (line.size() + word.size() >= 80)
      {
        text += "\n ";
        line = " ";
      }
      if (i > 0)
        text += " ";
      text += word;
      line += " " + word;
    }
    return text + "}";
  }

  std::string physical_names(const std::map<std::string, GmshNumbers> &surfaces,
                             const std::map<std::string, GmshNumbers> &curves)
  {
    std::string text;
    for (const auto &[name, numbers] : surfaces)
      text += "Physical Surface(\"" + name + "\") = " + braces(numbers) + ";\n";
    for (const auto &[name, numbers] : curves)
      text += "Physical Curve(\"" + name + "\") = " + braces(numbers) + ";\n";
    return text;
  }
} // namespace quoin
