// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/output/collective.h>

namespace quoin
{
  std::string first_message(const MPI_Comm communicator,
                            const std::string &message)
  {
    int rank, n_ranks;
    MPI_Comm_rank(communicator, &rank);
    MPI_Comm_size(communicator, &n_ranks);

    int mine = message.empty() ? n_ranks : rank;
    int root = n_ranks;
    MPI_Allreduce(&mine, &root, 1, MPI_INT, MPI_MIN, communicator);
    if (root == n_ranks)
      return "";

    int length = static_cast<int>(message.size());
    MPI_Bcast(&length, 1, MPI_INT, root, communicator);
    std::string result = rank == root ? message : std::string(length, ' ');
    MPI_Bcast(result.data(), length, MPI_CHAR, root, communicator);
    return result;
  }
} // namespace quoin
