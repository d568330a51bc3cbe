// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cstdlib>

int
main(int argc, char **argv)
{
  // No daemon of Open MPI beside a process that was started alone.
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
