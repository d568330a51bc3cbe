// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_output_log_h
#define quoin_output_log_h

#include <quoin/base/number_text.h>

#include <fstream>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * The log of a run: each message goes to the log file and, unless quiet, to
   * the screen. The last line of a terminal may be a status that changes in
   * place; messages then scroll above it.
   *
   * Only rank 0 has a file and a screen; other ranks write nothing. Messages
   * never throw, so that failures can be reported with them.
   */
  class Log
  {
  public:
    /** @param active is true on rank 0 @param quiet silences the screen */
    Log(const bool active, const bool quiet);
    ~Log();

    /**
     * Opens the log file; a resumed run appends to it. Earlier messages are
     * written to the file, too. @throws RunError
     */
    void open(const std::string &path, const bool append);

    /** A line (or several) for the screen and the file. */
    void message(const std::string &text);

    /** A message after "Warning: "; shown even if quiet. */
    void warning(const std::string &text);

    /** A message of text_of() @p parts. */
    template <typename... Parts>
    void message(const Parts &...parts)
    {
      message(text_of(parts...));
    }
    template <typename... Parts>
    void warning(const Parts &...parts)
    {
      warning(text_of(parts...));
    }

    /** All @p lines, or warnings, one after the other. */
    void messages(const std::vector<std::string> &lines)
    {
      for (const std::string &line : lines)
        message(line);
    }
    void warnings(const std::vector<std::string> &lines)
    {
      for (const std::string &line : lines)
        warning(line);
    }

    /** A line for the file and, unless it is a terminal, the screen. */
    void progress(const std::string &text);

    /** The line at the bottom of a terminal; empty removes it. */
    void status(const std::string &text);

    /** Whether the screen is a terminal that shows a status. */
    bool has_terminal() const
    {
      return terminal;
    }

    bool is_active() const
    {
      return active;
    }

  private:
    void to_file(const std::string &text);
    void to_screen(const std::string &text);

    bool active;
    bool quiet;
    bool terminal;
    bool file_failed = false;
    std::string path;
    std::string shown_status;
    std::string earlier; /**< messages before the file was open */
    std::ofstream file;
  };
} // namespace quoin

#endif
