// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/block_output.h>

#include <cmath>
#include <utility>

namespace quoin
{
  PrincipalStress principal_stress(const double xx, const double yy,
                                   const double xy)
  {
    const double mean   = 0.5 * (xx + yy);
    const double half   = 0.5 * (xx - yy);
    const double radius = std::hypot(half, xy);
    // atan2(0, 0) = 0: a hydrostatic state has the axes as directions.
    const double angle = 0.5 * std::atan2(xy, half);
    const double c     = std::cos(angle);
    const double s     = std::sin(angle);
    return { mean + radius, mean - radius, { { c, s } }, { { -s, c } } };
  }

  BlockOutput::BlockOutput(const std::string &output_directory,
                           const MPI_Comm communicator)
    : VtuSeries(output_directory, "blocks", communicator)
  {
  }

  void BlockOutput::write(const double time, const BlockFields &fields)
  {
    const std::size_t n_cells = fields.cells.size();
    std::vector<double> s1(n_cells), s2(n_cells);
    std::vector<std::array<double, 2>> direction1(n_cells), direction2(n_cells);
    for (std::size_t cell = 0; cell < n_cells; ++cell)
    {
      const std::array<double, 4> &stress = fields.stress[cell];
      const PrincipalStress principal
          = principal_stress(stress[0], stress[1], stress[2]);
      s1[cell]         = principal.s1;
      s2[cell]         = principal.s2;
      direction1[cell] = principal.direction1;
      direction2[cell] = principal.direction2;
    }

    VtuGrid grid;
    grid.time       = time;
    grid.cell_type  = VtuCellType::triangle;
    grid.points     = fields.position;
    grid.cells      = flat(fields.cells);
    grid.point_data = { { "displacement", 2, flat(fields.displacement) },
                        { "velocity", 2, flat(fields.velocity) } };
    grid.cell_data
        = { { "stress", 4, flat(fields.stress), { "xx", "yy", "xy", "zz" } },
            { "principal stress 1", 1, s1 },
            { "principal stress 2", 1, s2 },
            { "principal direction 1", 2, flat(direction1) },
            { "principal direction 2", 2, flat(direction2) },
            { "strain", 3, flat(fields.strain), { "xx", "yy", "xy" } },
            { "block", 1, fields.block },
            { "material", 1, fields.material } };
    if (!fields.yielding.empty())
    {
      grid.cell_data.push_back({ "yielding", 1, fields.yielding });
      grid.cell_data.push_back(
          { "plastic shear strain", 1, fields.plastic_shear });
    }
    write_grid(std::move(grid));
  }
} // namespace quoin
