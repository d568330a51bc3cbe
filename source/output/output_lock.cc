// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/output/output_lock.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace quoin
{
  OutputLock::~OutputLock()
  {
    if (descriptor >= 0)
      ::close(descriptor);
  }

  void OutputLock::take(const std::string &directory)
  {
    // NFS needs a writable file. If it is not writable, the files of the run
    // are not either and give a better message.
    descriptor = ::open((directory + "/lock").c_str(),
                        O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0
        && errno == EWOULDBLOCK)
      throw InputError("another run is writing to the output directory '"
                       + directory
                       + "'. Wait for its end, or choose another with 'Output "
                         "directory' or --output.");
  }
} // namespace quoin
