// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_output_lock_h
#define quoin_output_output_lock_h

#include <string>

namespace quoin
{
  /**
   * Keeps other runs out of an output directory: the empty file 'lock' in it,
   * held with flock(). The system releases it with the process, however that
   * ends, so that a killed run can be resumed at once; the file stays.
   *
   * One rank holds it for all. On file systems without such locks, or where
   * the file cannot be made, nothing is held. NFS keeps them between machines
   * since Linux 2.6.12; with older servers, or mounted with local_lock=flock,
   * only runs of one machine see each other.
   */
  class OutputLock
  {
  public:
    OutputLock() = default;
    ~OutputLock();
    OutputLock(const OutputLock &)            = delete;
    OutputLock &operator=(const OutputLock &) = delete;

    /** @throws InputError if another run holds @p directory */
    void take(const std::string &directory);

  private:
    int descriptor = -1;
  };
} // namespace quoin

#endif
