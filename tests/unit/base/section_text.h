// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_base_section_text_h
#define quoin_tests_unit_base_section_text_h

#include "message_of.h"

#include <quoin/base/exceptions.h>
#include <quoin/base/parameter_section.h>

#include <gtest/gtest.h>

#include <string>

namespace quoin
{
  /** What "wall.prm" with the lines @p text in section @p name gives: what
      @p read makes of it, with the parameters that @p declare declares. */
  template <typename Declare, typename Read>
  auto read_section(const std::string &name, const std::string &text,
                    const Declare &declare, const Read &read)
  {
    dealii::ParameterHandler prm;
    prm.enter_subsection(name);
    declare(prm);
    prm.leave_subsection();
    prm.parse_input_from_string("subsection " + name + "\n" + text + "end\n");
    const ParameterSection top(prm, "wall.prm");
    return read(ParameterSection(top, name));
  }

  /** The same of a @p T with a name, as the subsections of 'Joints'. */
  template <typename T>
  T read_named_section(const std::string &name, const std::string &text)
  {
    return read_section(name, text, T::declare,
                        [&](const ParameterSection &section)
                        { return T::read(section, name); });
  }

  /** Expects of @p read that it refuses the parameter @p setting of section
      @p name with a sentence that contains @p why. */
  template <typename Read>
  void expect_section_refused(const std::string &name,
                              const std::string &setting,
                              const std::string &why, const Read &read)
  {
    const std::string message = message_of<InputError>(read);
    EXPECT_EQ(message.find("wall.prm, section '" + name + "': '" + setting), 0U)
        << message;
    EXPECT_NE(message.find(why), std::string::npos) << message;
  }
} // namespace quoin

#endif
