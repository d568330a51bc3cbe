// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/output/atomic_file.h>
#include <quoin/output/log.h>

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <iostream>

namespace quoin
{
  namespace
  {
    /** 0 if there is no screen on which a line can be redrawn. */
    unsigned int terminal_width()
    {
      // mpirun gives its processes a terminal without a size even if its own
      // output goes to a file, where a line cannot be redrawn.
      winsize size{};
      return ::isatty(STDOUT_FILENO) != 0
                     && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0
                 ? size.ws_col
                 : 0;
    }
  } // namespace

  Log::Log(const bool active, const bool quiet)
    : active(active), quiet(quiet),
      terminal(active && !quiet && terminal_width() > 0)
  {
  }

  Log::~Log()
  {
    status("");
  }

  void Log::open(const std::string &path, const bool append)
  {
    if (!active)
      return;
    errno = 0;
    file.open(path, append ? std::ios::app : std::ios::trunc);
    if (!file)
      throw RunError(write_failure(path, errno));
    this->path = path;
    file << earlier << std::flush;
    earlier.clear();
  }

  void Log::message(const std::string &text)
  {
    to_file(text);
    if (!quiet)
      to_screen(text);
  }

  void Log::warning(const std::string &text)
  {
    to_file("Warning: " + text);
    to_screen("Warning: " + text);
  }

  void Log::progress(const std::string &text)
  {
    to_file(text);
    if (!quiet && !terminal)
      to_screen(text);
  }

  void Log::status(const std::string &text)
  {
    if (!terminal || (text.empty() && shown_status.empty()))
      return;
    // A line longer than the terminal would wrap and could not be erased.
    shown_status = text.substr(0, std::max(terminal_width(), 1U) - 1);
    std::cout << "\r\033[K" << shown_status << std::flush;
  }

  void Log::to_file(const std::string &text)
  {
    if (!active)
      return;
    if (!file.is_open())
    {
      earlier += text + "\n";
      return;
    }
    file << text << std::endl;
    if (!file && !file_failed)
    {
      file_failed = true;
      std::cerr << "Warning: " << write_failure(path, errno) << std::endl;
    }
  }

  void Log::to_screen(const std::string &text)
  {
    if (!active)
      return;
    if (shown_status.empty())
      std::cout << text << std::endl;
    else
      std::cout << "\r\033[K" << text << "\n" << shown_status << std::flush;
  }
} // namespace quoin
