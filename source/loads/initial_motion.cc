// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/point_text.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/loads/initial_motion.h>

#include <deal.II/base/utilities.h>

#include <cmath>

namespace quoin
{
  namespace
  {
    /** The expressions of @p name, which is not empty. */
    InitialMotion::Components read_components(const ParameterSection &section,
                                              const std::string &name)
    {
      const auto parts
          = dealii::Utilities::split_string_list(section.text(name), ';');
      if (parts.size() != 2 && parts.size() != 3)
        section.fail(name, "must be two expressions of x and y, in three "
                           "dimensions three of x, y and z, with semicolons "
                           "between them.");
      InitialMotion::Components value;
      for (const std::string &part : parts)
      {
        value.push_back(section.made(
            name,
            [&]() {
              return SpaceTimeFunction(part, section.folder(), parts.size());
            }));
        if (value.back().depends_on_time())
          section.fail(name, "must not depend on time: it is the motion at "
                             "t = 0. Give expressions of the place alone.");
      }
      return value;
    }

    void enter(ParameterEntries &entries, InitialMotion &motion)
    {
      const auto add = [&](const std::string &name, const std::string &unit,
                           InitialMotion::Components &value)
      {
        entries.other(
            name, "",
            name
                + " at t = 0 of all nodes of the blocks that are there then, "
                  "horizontal and vertical, as two expressions of x and y [m] "
                  "with a semicolon between them; in three dimensions along x, "
                  "y and z, as three expressions of x, y and z; empty: zero "
                + unit,
            [&](const ParameterSection &section)
            {
              if (!section.text(name).empty())
                value = read_components(section, name);
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

  template <int dim>
  void InitialMotion::apply(const NodeMap<dim> &nodes, State<dim> &state) const
  {
    for (const auto &[name, value] :
         { std::make_pair("Displacement", &displacement),
           std::make_pair("Velocity", &velocity) })
      if (!value->empty() && value->size() != dim)
        throw InputError(text_of(
            "section 'Initial motion': '", name, "' has ", value->size(),
            " components, but the model has ", dim,
            " dimensions. Give as many expressions, with semicolons between."));
    for (std::size_t i = 0; i < state.nodes.size(); ++i)
    {
      // Blocks that are placed later come at rest.
      if (state.is_absent(nodes.block_of_node(i)))
        continue;
      NodeRecord<dim> &node = state.nodes[i];
      dealii::Point<3> x;
      dealii::Point<dim> place;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = place[d] = node.X[d];
      for (unsigned int d = 0; d < dim; ++d)
      {
        double &u = node.u[d], &v = state.velocity[i][d];
        u = displacement.empty() ? 0. : displacement[d](x, 0.);
        v = velocity.empty() ? 0. : velocity[d](x, 0.);
        if (!std::isfinite(u) || !std::isfinite(v))
          throw InputError(text_of(
              "section 'Initial motion': the motion at ", point_text(place),
              " m is not a finite number. Correct the expressions."));
      }
    }
  }

  template void InitialMotion::apply(const NodeMap<2> &, State<2> &) const;
  template void InitialMotion::apply(const NodeMap<3> &, State<3> &) const;
} // namespace quoin
