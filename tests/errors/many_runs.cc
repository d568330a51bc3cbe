// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// quoin, run as often as asked, each time in a process of its own, which begins
// where the libraries are loaded: that is most of the cost of a short run. What
// to run comes through the standard input, each word ended by a zero byte and
// each run by an empty word; the first word is the file that takes what is
// printed, the others are the command line. Answers with the exit status, less
// than zero for that of a signal.

#include <quoin/application/command_line.h>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace
{
  constexpr unsigned int time_limit = 120; // s

  [[noreturn]] void run(std::vector<std::string> &words)
  {
    const int nothing = open("/dev/null", O_RDONLY),
              printed
              = open(words[0].c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (nothing < 0 || printed < 0)
      std::_Exit(127);
    dup2(nothing, STDIN_FILENO);
    dup2(printed, STDOUT_FILENO);
    dup2(printed, STDERR_FILENO);
    close(nothing);
    close(printed);
    alarm(time_limit);
    std::vector<char *> arguments;
    for (std::size_t i = 1; i < words.size(); ++i)
      arguments.push_back(words[i].data());
    arguments.push_back(nullptr);
    std::exit(quoin::run_command_line(int(words.size()) - 1, arguments.data()));
  }
} // namespace

int
main()
{
  std::vector<std::string> words;
  std::string word;
  while (std::getline(std::cin, word, '\0'))
  {
    if (!word.empty())
    {
      words.push_back(word);
      continue;
    }
    const pid_t child = fork();
    if (child == 0)
      run(words);
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) < 0)
      return 1;
    std::cout << (WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status))
              << std::endl;
    words.clear();
  }
  return 0;
}
