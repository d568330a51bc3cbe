// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/blas_kernels.h>
#include <quoin/base/lone_process.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

int
main(int argc, char **argv)
{
  quoin::prepare_lone_process();
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  quoin::choose_blas_kernels();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
