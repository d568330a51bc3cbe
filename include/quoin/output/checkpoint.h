// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_checkpoint_h
#define quoin_output_checkpoint_h

#include <quoin/operators/archive.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <streambuf>
#include <string>

namespace quoin
{
  /** Description of a checkpoint. */
  struct CheckpointInfo
  {
    std::uint64_t step = 0;
    double time        = 0.; /**< [s] */
    std::string version;     /**< version of the program */
    std::string parameters;  /**< fingerprint() of the effective ones */
  };

  /** The rank that wrote an archive. */
  struct ArchiveOrigin
  {
    unsigned int rank    = 0;
    unsigned int n_ranks = 1;
    /** Whether there are as many ranks as then, and this is the same one.
        Otherwise each rank reads the archives of all, the first rank's last. */
    bool is_own = true;
  };

  /** A short text that differs if @p text does (64-bit FNV-1a, hex). */
  std::string fingerprint(const std::string &text);

  /** Whether <output directory>/checkpoint/latest exists. */
  bool checkpoint_exists(const std::string &output_directory);

  /**
   * Removes the checkpoint in an output directory, whole or in parts, and
   * nothing else that may be there.
   */
  void remove_checkpoint(const std::string &output_directory);

  /** Part of save_checkpoint(); @p write fills this rank's archive. */
  void
  save_checkpoint_archives(const std::string &output_directory,
                           const MPI_Comm communicator,
                           const CheckpointInfo &info,
                           const std::function<void(std::streambuf &)> &write);

  /**
   * Collective. Checks the archives that save_checkpoint_archives() wrote and
   * gives them to @p read: to each rank its own or, if the number of ranks
   * differs, to each rank all of them in turn, that of the highest rank first.
   * @p changes: how the parameters differ from those of the run that wrote
   * them, for the message if their fingerprints do.
   *
   * @throws InputError on all ranks, as load_checkpoint()
   */
  CheckpointInfo load_checkpoint_archives(
      const std::string &output_directory, const MPI_Comm communicator,
      const std::string &version, const std::string &parameters,
      const std::function<void(std::streambuf &, const ArchiveOrigin &)> &read,
      const std::string &changes = "");

  /**
   * Collective. Writes @p data of every rank as a binary archive
   *
   *     checkpoint/<step>/rank_<r>.bin
   *
   * below the output directory, and after that the manifest checkpoint/latest,
   * which has the name of the directory, the info, and size and CRC-32 of each
   * archive. Both are written under temporary names, synchronised with the disk
   * and renamed, so that a crash at any moment leaves either the older or the
   * newer checkpoint valid. Older directories are removed at the end.
   *
   * @throws RunError on all ranks if one of them cannot write
   */
  template <typename T>
  void save_checkpoint(const std::string &output_directory,
                       const MPI_Comm communicator, const CheckpointInfo &info,
                       const T &data)
  {
    save_checkpoint_archives(output_directory, communicator, info,
                             [&](std::streambuf &buffer)
                             {
                               boost::archive::binary_oarchive archive(buffer);
                               archive << data;
                             });
  }

  /**
   * Collective. Reads what save_checkpoint() wrote on the same number of ranks;
   * bitwise identical.
   *
   * @throws InputError on all ranks if there is no checkpoint, if it is of
   * another version or format or other parameters, or if it is damaged; @p data
   * is unchanged unless the archive itself is unreadable though its CRC-32 is
   * right
   */
  template <typename T>
  CheckpointInfo load_checkpoint(const std::string &output_directory,
                                 const MPI_Comm communicator,
                                 const std::string &version,
                                 const std::string &parameters, T &data)
  {
    return load_checkpoint_archives(
        output_directory, communicator, version, parameters,
        [&](std::streambuf &buffer, const ArchiveOrigin &)
        {
          boost::archive::binary_iarchive archive(buffer);
          archive >> data;
        });
  }
} // namespace quoin

#endif
