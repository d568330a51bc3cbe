// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/loads/initial_motion.h>

#include <deal.II/base/utilities.h>

#include <cmath>

namespace quoin
{
  namespace
  {
    /** The two expressions of @p name, which is not empty. */
    void read_pair(const ParameterSection &section, const std::string &name,
                   std::array<SpaceTimeFunction, 2> &value)
    {
      const auto parts
          = dealii::Utilities::split_string_list(section.text(name), ';');
      if (parts.size() != 2)
        section.fail(name, "must be two expressions of x and y with a "
                           "semicolon between them.");
      for (unsigned int d = 0; d < 2; ++d)
      {
        value[d] = section.made(
            name,
            [&]() { return SpaceTimeFunction(parts[d], section.folder()); });
        if (value[d].depends_on_time())
          section.fail(name, "must not depend on time: it is the motion at "
                             "t = 0. Give expressions of x and y alone.");
      }
    }

    void enter(ParameterEntries &entries, InitialMotion &motion)
    {
      const auto add = [&](const std::string &name, const std::string &unit,
                           std::array<SpaceTimeFunction, 2> &value)
      {
        entries.other(name, "",
                      name
                          + " of all nodes at t = 0, horizontal and vertical: "
                            "two expressions of x and y [m] with a semicolon "
                            "between; empty: none "
                          + unit,
                      [&](const ParameterSection &section)
                      {
                        if (section.text(name).empty())
                          return;
                        read_pair(section, name, value);
                        motion.is_given = true;
                      });
      };
      add("Displacement", "[m]", motion.displacement);
      add("Velocity", "[m/s]", motion.velocity);
    }
  } // namespace

  void InitialMotion::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter);
  }

  InitialMotion InitialMotion::read(const ParameterSection &section)
  {
    return read_entries(section, enter);
  }

  void InitialMotion::apply(State<2> &state) const
  {
    for (std::size_t i = 0; i < state.nodes.size(); ++i)
    {
      NodeRecord<2> &node = state.nodes[i];
      const Eigen::Vector2d x(node.X[0], node.X[1]);
      for (unsigned int d = 0; d < 2; ++d)
      {
        node.u[d]              = displacement[d](x, 0.);
        state.velocity[i].v[d] = velocity[d](x, 0.);
        if (!std::isfinite(node.u[d]) || !std::isfinite(state.velocity[i].v[d]))
          throw InputError(text_of(
              "section 'Initial motion': the motion at (", x[0], ", ", x[1],
              ") m is not a finite number. Correct the expressions."));
      }
    }
  }
} // namespace quoin
