// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/cable_output.h>

#include <deal.II/base/mpi.h>

#include <numeric>
#include <utility>

namespace quoin
{
  CableOutput::CableOutput(const std::string &output_directory,
                           const MPI_Comm communicator,
                           const FieldFormat format)
    : FieldSeries(output_directory, "cables", communicator, format),
      is_first(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
  }

  void CableOutput::write(const double time, const CableFields &all)
  {
    const CableFields fields = is_first ? all : CableFields();
    VtuGrid grid;
    grid.time      = time;
    grid.cell_type = VtuCellType::line;
    for (std::size_t i = 0; i < fields.position.size(); ++i)
      append_vector(grid.points, fields.position[i] + fields.displacement[i]);
    grid.cells.resize(fields.position.size());
    std::iota(grid.cells.begin(), grid.cells.end(), 0);
    grid.point_data = { { "displacement", 2, flat(fields.displacement) },
                        { "bond slip", 1, fields.slip },
                        { "bond force", 1, fields.bond_force },
                        { "bond state", 1, fields.bond } };
    grid.cell_data  = { { "axial force", 1, fields.axial_force },
                        { "axial strain", 1, fields.axial_strain },
                        { "shear force", 1, fields.shear_force },
                        { "state", 1, fields.state },
                        { "cable", 1, fields.cable } };
    write_grid(std::move(grid));
  }
} // namespace quoin
