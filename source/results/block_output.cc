// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/block_output.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>
#include <utility>

namespace quoin
{
  PrincipalStress<2> principal_stress(const std::array<double, 4> &stress)
  {
    const auto &[xx, yy, xy, zz] = stress;
    const double mean            = 0.5 * (xx + yy);
    const double half            = 0.5 * (xx - yy);
    const double radius          = std::hypot(half, xy);
    // atan2(0, 0) = 0: a hydrostatic state has the axes as directions.
    const double angle = 0.5 * std::atan2(xy, half);
    const double c     = std::cos(angle);
    const double s     = std::sin(angle);
    return { { { mean + radius, mean - radius } },
             { { dealii::Point<2>(c, s), dealii::Point<2>(-s, c) } } };
  }

  PrincipalStress<3> principal_stress(const std::array<double, 6> &stress)
  {
    // deal.II has the same order xx, yy, zz, xy, xz, yz.
    dealii::SymmetricTensor<2, 3> tensor;
    for (unsigned int i = 0; i < 6; ++i)
      tensor.access_raw_entry(i) = stress[i];
    const auto pairs = dealii::eigenvectors(
        tensor, dealii::SymmetricTensorEigenvectorMethod::jacobi);
    PrincipalStress<3> result;
    for (unsigned int i = 0; i < 3; ++i)
    {
      result.value[i]     = pairs[i].first;
      result.direction[i] = pairs[i].second;
    }
    return result;
  }

  BlockOutput::BlockOutput(const std::string &output_directory,
                           const MPI_Comm communicator,
                           const FieldFormat format)
    : FieldSeries(output_directory, "blocks", communicator, format)
  {
  }

  template <int dim>
  void BlockOutput::write(const double time, const BlockFields<dim> &fields)
  {
    const std::size_t n_cells = fields.cells.size();
    std::array<std::vector<double>, dim> value;
    std::array<std::vector<dealii::Tensor<1, dim>>, dim> direction;
    for (unsigned int i = 0; i < dim; ++i)
    {
      value[i].reserve(n_cells);
      direction[i].reserve(n_cells);
    }
    for (const auto &stress : fields.stress)
    {
      const PrincipalStress<dim> principal = principal_stress(stress);
      for (unsigned int i = 0; i < dim; ++i)
      {
        value[i].push_back(principal.value[i]);
        direction[i].push_back(principal.direction[i]);
      }
    }

    const std::vector<std::string> six = { "xx", "yy", "zz", "xy", "xz", "yz" };
    VtuGrid grid;
    grid.time      = time;
    grid.dimension = dim;
    grid.cell_type
        = dim == 2 ? VtuCellType::triangle : VtuCellType::tetrahedron;
    grid.points     = flat(fields.position);
    grid.cells      = flat(fields.cells);
    grid.point_data = { { "displacement", dim, flat(fields.displacement) },
                        { "velocity", dim, flat(fields.velocity) } };
    if (!fields.earlier_displacement.empty())
      grid.point_data.push_back(
          { "earlier displacement", dim, flat(fields.earlier_displacement) });
    grid.cell_data.push_back(
        { "stress", dim == 2 ? 4 : 6, flat(fields.stress),
          dim == 2 ? std::vector<std::string>{ "xx", "yy", "xy", "zz" }
                   : six });
    for (unsigned int i = 0; i < dim; ++i)
      grid.cell_data.push_back(
          { "principal stress " + std::to_string(i + 1), 1, value[i] });
    for (unsigned int i = 0; i < dim; ++i)
      grid.cell_data.push_back({ "principal direction " + std::to_string(i + 1),
                                 dim, flat(direction[i]) });
    grid.cell_data.push_back(
        { "strain", dim == 2 ? 3 : 6, flat(fields.strain),
          dim == 2 ? std::vector<std::string>{ "xx", "yy", "xy" } : six });
    grid.cell_data.push_back({ "block", 1, fields.block });
    grid.cell_data.push_back({ "material", 1, fields.material });
    if (!fields.yielding.empty())
    {
      grid.cell_data.push_back({ "yielding", 1, fields.yielding });
      grid.cell_data.push_back(
          { "plastic shear strain", 1, fields.plastic_shear });
    }
    write_grid(std::move(grid));
  }

  template void BlockOutput::write(double, const BlockFields<2> &);
  template void BlockOutput::write(double, const BlockFields<3> &);
} // namespace quoin
