// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/results/boundary_output.h>

#include <utility>

namespace quoin
{
  BoundaryOutput::BoundaryOutput(const std::string &output_directory,
                                 const MPI_Comm communicator,
                                 const FieldFormat format)
    : FieldSeries(output_directory, "boundary", communicator, format)
  {
  }

  void BoundaryOutput::write(const double time, const BoundaryFields &fields)
  {
    VtuGrid grid;
    grid.time      = time;
    grid.cell_type = VtuCellType::line;
    for (std::size_t e = 0; e < fields.a.size(); ++e)
    {
      // Ends are not shared, as fields are discontinuous between elements.
      for (const auto *end : { &fields.a[e], &fields.b[e] })
      {
        grid.cells.push_back(static_cast<std::int32_t>(grid.points.size() / 2));
        append_vector(grid.points, *end);
      }
    }
    grid.cell_data = { { "displacement", 2, flat(fields.displacement) },
                       { "velocity", 2, flat(fields.velocity) },
                       { "traction", 2, flat(fields.traction) },
                       { "hoop stress", 1, fields.hoop_stress },
                       { "boundary", 1, fields.boundary } };
    write_grid(std::move(grid));
  }

  SampledFieldOutput::SampledFieldOutput(const std::string &output_directory,
                                         const MPI_Comm communicator,
                                         const FieldFormat format)
    : FieldSeries(output_directory, "field", communicator, format)
  {
  }

  void SampledFieldOutput::write(const double time, const SampledFields &fields)
  {
    VtuGrid grid;
    grid.time       = time;
    grid.cell_type  = VtuCellType::triangle;
    grid.points     = flat(fields.position);
    grid.cells      = flat(fields.triangles);
    grid.point_data = { { "displacement", 2, flat(fields.displacement) },
                        { "velocity", 2, flat(fields.velocity) } };
    write_grid(std::move(grid));
  }
} // namespace quoin
