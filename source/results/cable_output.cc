// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/cable_output.h>
#include <quoin/results/result_origin.h>

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

  void CableOutput::write(const double time, const CableFields &all,
                          const std::vector<dealii::Tensor<1, 2>> &earlier)
  {
    CableFields fields = is_first ? all : CableFields();
    VtuGrid grid;
    grid.time      = time;
    grid.cell_type = VtuCellType::line;
    for (std::size_t i = 0; i < fields.position.size(); ++i)
      append_vector(grid.points, fields.position[i] + fields.displacement[i]);
    if (!earlier.empty())
    {
      // Where the rock was, as blocks have it.
      for (std::size_t i = 0; i < fields.displacement.size(); ++i)
        fields.displacement[i] -= earlier[i];
    }
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
    if (!earlier.empty())
      grid.point_data.push_back(
          { "earlier displacement", 2,
            flat(is_first ? earlier : std::vector<dealii::Tensor<1, 2>>()) });
    write_grid(std::move(grid));
  }

  std::vector<dealii::Tensor<1, 2>>
  earlier_displacement(const Reinforcement &reinforcement,
                       const State<2> &state)
  {
    const auto *origin = state.find<ResultOrigin<2>>();
    if (!origin || origin->displacement.empty())
      return {};
    State<2> then = state;
    for (unsigned int i = 0; i < then.nodes.size(); ++i)
      then.nodes[i].u = origin->displacement[i];
    return cable_fields(reinforcement, then).displacement;
  }
} // namespace quoin
