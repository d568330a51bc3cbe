// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/beam_output.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace quoin
{
  BeamOutput::BeamOutput(const std::string &output_directory,
                         const MPI_Comm communicator, const FieldFormat format)
    : FieldSeries(output_directory, "beams", communicator, format),
      is_first_rank(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
  }

  void BeamOutput::write(const double time, const Beams &beams,
                         const State<2> &state)
  {
    VtuGrid grid;
    grid.time      = time;
    grid.cell_type = VtuCellType::line;
    std::vector<double> displacement, axial, shear, moment, plastic, least,
        largest, used, normal, tangential, opening, slip, states;
    std::vector<std::int32_t> numbers;
    const auto append
        = [](std::vector<double> &to, const std::vector<double> &from)
    { to.insert(to.end(), from.begin(), from.end()); };
    // All ranks have all beams; one of them writes.
    for (unsigned int b = 0; is_first_rank && b < beams.all().size(); ++b)
    {
      if (!state.get<BeamState>().placed[b])
        continue;
      const BeamFields fields  = beam_fields(beams.all()[b], state);
      const std::int32_t first = grid.points.size() / 2;
      const std::int32_t n     = fields.position.size();
      append(grid.points, flat(fields.position));
      append(displacement, flat(fields.displacement));
      append(axial, fields.axial);
      append(shear, fields.shear);
      append(moment, fields.moment);
      append(plastic, fields.plastic);
      append(least, fields.least_stress);
      append(largest, fields.largest_stress);
      append(used, fields.utilisation);
      append(normal, fields.normal_traction);
      append(tangential, fields.shear_traction);
      append(opening, fields.opening);
      append(slip, fields.slip);
      append(states, fields.state);
      for (std::int32_t i = 0; i + (fields.is_closed ? 0 : 1) < n; ++i)
      {
        grid.cells.push_back(first + i);
        grid.cells.push_back(first + (i + 1) % n);
        numbers.push_back(b);
      }
    }
    grid.point_data = { { "displacement", 2, displacement },
                        { "axial force", 1, axial },
                        { "shear force", 1, shear },
                        { "moment", 1, moment },
                        { "plastic rotation", 1, plastic },
                        { "least stress", 1, least },
                        { "largest stress", 1, largest },
                        { "utilisation", 1, used },
                        { "normal traction", 1, normal },
                        { "shear traction", 1, tangential },
                        { "opening", 1, opening },
                        { "slip", 1, slip },
                        { "state", 1, states } };
    grid.cell_data  = { { "beam", 1, numbers } };
    write_grid(std::move(grid));
  }

  double beam_value(const BeamFields &fields, const unsigned int node,
                    const unsigned int component)
  {
    const auto largest = [](const std::vector<double> &values)
    {
      double result = 0.;
      for (const double value : values)
        result = std::max(result, std::abs(value));
      return result;
    };
    switch (component)
    {
    case 0:
    case 1:
      return fields.displacement[node][component];
    case 2:
      return fields.axial[node];
    case 3:
      return fields.shear[node];
    case 4:
      return fields.moment[node];
    case 5:
    {
      double most = 0.;
      for (const auto &u : fields.displacement)
        most = std::max(most, std::hypot(u[0], u[1]));
      return most;
    }
    case 6:
      return largest(fields.axial);
    case 7:
      return largest(fields.shear);
    case 8:
      return largest(fields.moment);
    case 9:
      return fields.utilisation[node];
    default:
      return largest(fields.utilisation);
    }
  }
} // namespace quoin
