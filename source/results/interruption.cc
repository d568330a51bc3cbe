// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/interruption.h>

#include <csignal>
#include <ctime>
#include <string>

namespace quoin
{
  namespace
  {
    constexpr int signals[] = { SIGINT, SIGTERM, SIGUSR1 };
    /** Time within which further signals belong to the first one [s]. */
    constexpr double one_request = 0.1;

    // A handler of signals can reach nothing else than variables like these.
    volatile std::sig_atomic_t first_signal = 0;
    timespec time_of_first{};

    extern "C" void take_signal(const int number)
    {
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
      if (passed < one_request)
        return;
      // It ends the process as soon as this function returns.
      std::signal(number, SIG_DFL);
      std::raise(number);
    }
  } // namespace

  Interruption::Interruption()
  {
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

  Interruption::~Interruption()
  {
    for (const int number : signals)
      std::signal(number, SIG_DFL);
  }

  int Interruption::received()
  {
    return first_signal;
  }

  std::string signal_name(const int number)
  {
    return number == SIGINT    ? "SIGINT"
           : number == SIGTERM ? "SIGTERM"
                               : "SIGUSR1";
  }
} // namespace quoin
