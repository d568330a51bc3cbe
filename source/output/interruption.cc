// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/output/interruption.h>

#include <unistd.h>

#include <csignal>
#include <cstring>
#include <ctime>
#include <string>

namespace quoin
{
  namespace
  {
    constexpr int signals[] = { SIGINT, SIGTERM, SIGUSR1 };
    /** Time within which further signals belong to the first one [s]. */
    constexpr double one_request = 0.5;

    // A handler of signals can reach nothing else than variables like these.
    volatile std::sig_atomic_t is_first     = 0; // this rank
    volatile std::sig_atomic_t steps_begun  = 0;
    volatile std::sig_atomic_t first_signal = 0;
    timespec time_of_first{};

    const char *name_of(const int number)
    {
      return number == SIGINT    ? "SIGINT"
             : number == SIGTERM ? "SIGTERM"
                                 : "SIGUSR1";
    }

    /** Ends the process as soon as the handler returns. */
    void end_process(const int number)
    {
      std::signal(number, SIG_DFL);
      std::raise(number);
    }

    void say(const char *const text)
    {
      // Nobody can be told if it fails.
      [[maybe_unused]] const auto written
          = ::write(STDERR_FILENO, text, std::strlen(text));
    }

    extern "C" void take_signal(const int number)
    {
      if (steps_begun == 0 && is_first != 0)
      {
        say("interrupted by ");
        say(name_of(number));
        say(" before the first step: nothing was computed\n");
        end_process(number);
        return;
      }
      timespec now{};
      clock_gettime(CLOCK_MONOTONIC, &now);
      if (first_signal == 0)
      {
        time_of_first = now;
        first_signal  = number;
        return;
      }
      const double passed
          = double(now.tv_sec - time_of_first.tv_sec)
            + 1e-9 * double(now.tv_nsec - time_of_first.tv_nsec);
      if (passed >= one_request)
        end_process(number);
    }
  } // namespace

  void Interruption::begin(const bool is_first_rank)
  {
    is_first     = is_first_rank;
    steps_begun  = 0;
    first_signal = 0;
    struct sigaction action
    {
    };
    action.sa_handler = take_signal;
    action.sa_flags   = SA_RESTART;
    // One after the other: they share the variables.
    for (const int number : signals)
      sigaddset(&action.sa_mask, number);
    for (const int number : signals)
      sigaction(number, &action, nullptr);
  }

  void Interruption::begin_steps()
  {
    steps_begun = 1;
  }

  int Interruption::received()
  {
    return first_signal;
  }

  std::string signal_name(const int number)
  {
    return name_of(number);
  }
} // namespace quoin
