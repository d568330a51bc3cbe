// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_boundary_output_h
#define quoin_results_boundary_output_h

#include <quoin/output/field_series.h>

#include <array>
#include <cstdint>
#include <vector>

namespace quoin
{
  /** Boundary elements at an output time, one entry each. */
  struct BoundaryFields
  {
    std::vector<dealii::Point<2>> a, b;             /**< ends [m] */
    std::vector<dealii::Tensor<1, 2>> displacement; /**< [m] */
    std::vector<dealii::Tensor<1, 2>> velocity;     /**< [m/s] */
    std::vector<dealii::Tensor<1, 2>> traction;     /**< [Pa] */
    std::vector<double> hoop_stress;                /**< [Pa] */
    std::vector<std::int32_t> boundary; /**< number of the boundary */
  };

  /** The series boundary.pvd: a line for each boundary element. */
  class BoundaryOutput : public FieldSeries
  {
  public:
    BoundaryOutput(const std::string &output_directory,
                   const MPI_Comm communicator,
                   const FieldFormat format = FieldFormat::vtu);

    /** Collective. Writes the fields of the time @p time [s]. */
    void write(const double time, const BoundaryFields &fields);
  };

  /** Points in the domain at an output time, with triangles between them. */
  struct SampledFields
  {
    std::vector<dealii::Point<2>> position; /**< [m] */
    std::vector<std::array<std::int32_t, 3>> triangles;
    std::vector<dealii::Tensor<1, 2>> displacement; /**< [m] */
    std::vector<dealii::Tensor<1, 2>> velocity;     /**< [m/s] */
  };

  /** The series field.pvd: the field in the domain of boundary elements. */
  class SampledFieldOutput : public FieldSeries
  {
  public:
    SampledFieldOutput(const std::string &output_directory,
                       const MPI_Comm communicator,
                       const FieldFormat format = FieldFormat::vtu);

    /** Collective. Writes the fields of the time @p time [s]. */
    void write(const double time, const SampledFields &fields);
  };
} // namespace quoin

#endif
