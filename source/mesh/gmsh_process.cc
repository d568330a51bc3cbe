// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/mesh/gmsh_process.h>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/personality.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

extern char **environ;

namespace quoin
{
  namespace
  {
    namespace fs = std::filesystem;

    /** With this value personality() sets nothing and returns what is set. */
    constexpr unsigned long ask_personality = 0xffffffff;

    std::string gmsh_program()
    {
      std::error_code ignored;
      const fs::path folder
          = fs::read_symlink("/proc/self/exe", ignored).parent_path();
      const fs::path beside = folder / "quoin_gmsh";
      const fs::path above  = folder.parent_path() / "quoin_gmsh";
      return !fs::exists(beside, ignored) && fs::exists(above, ignored)
                 ? above
                 : beside;
    }

    /** A file descriptor, closed with this object and in other programs. */
    class Descriptor
    {
    public:
      explicit Descriptor(const int number) : number(number)
      {
      }
      ~Descriptor()
      {
        close();
      }
      Descriptor(const Descriptor &)            = delete;
      Descriptor &operator=(const Descriptor &) = delete;

      void close()
      {
        if (number >= 0)
          ::close(number);
        number = -1;
      }

      int number;
    };

    /** A file without a name that holds @p text. */
    int anonymous_file(const std::string &text)
    {
      const int file = memfd_create("geometry", MFD_CLOEXEC);
      for (std::size_t done = 0; file >= 0 && done < text.size();)
      {
        const ssize_t n = write(file, text.data() + done, text.size() - done);
        if (n < 0 && errno != EINTR)
          break;
        done += std::max<ssize_t>(n, 0);
      }
      return file;
    }

    /** @p program with its input and its output; 0 or the number of an error.
     */
    int spawn(pid_t &process, const std::string &program,
              const std::vector<std::string> &arguments, const int input,
              const int output)
    {
      std::vector<char *> words = { const_cast<char *>(program.c_str()) };
      for (const std::string &argument : arguments)
        words.push_back(const_cast<char *>(argument.c_str()));
      words.push_back(nullptr);
      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
      posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
      // gmsh orders entities by their addresses: with addresses at random each
      // run would get another mesh of the same geometry. A system that refuses
      // to fix them leaves it at that.
      const int before = personality(ask_personality);
      if (before != -1)
        personality(before | ADDR_NO_RANDOMIZE);
      const int error = posix_spawn(&process, program.c_str(), &actions,
                                    nullptr, words.data(), environ);
      if (before != -1)
        personality(before);
      posix_spawn_file_actions_destroy(&actions);
      return error;
    }

    /** Whether @p signal says that a program has failed by itself. */
    bool is_crash(const int signal)
    {
      return signal == SIGSEGV || signal == SIGBUS || signal == SIGFPE
             || signal == SIGILL || signal == SIGABRT;
    }
  } // namespace

  void fail_on_mesh(const std::string &source, const std::string &what)
  {
    throw InputError("Mesh '" + source + "': " + what);
  }

  GmshMesh run_gmsh(const std::string &source,
                    const std::vector<std::string> &arguments,
                    const std::string &input, const std::string &cure)
  {
    // 1. Start it.
    const std::string program = gmsh_program();
    std::array<int, 2> ends   = { { -1, -1 } };
    Descriptor input_file(anonymous_file(input));
    if (input_file.number < 0 || pipe2(ends.data(), O_CLOEXEC) != 0)
      fail_on_mesh(source, std::string("no pipe to gmsh can be made: ")
                               + std::strerror(errno));
    Descriptor own_end(ends[0]), other_end(ends[1]);
    pid_t process;
    const int error = spawn(process, program, arguments, input_file.number,
                            other_end.number);
    if (error != 0)
      fail_on_mesh(source,
                   "the program '" + program
                       + "', which runs gmsh, cannot be started: "
                       + std::strerror(error)
                       + ". Put it beside this program, with which it is "
                         "built.");
    other_end.close();
    input_file.close();

    // 2. Take what it sends until it is over.
    GmshMesh mesh;
    std::FILE *stream = fdopen(own_end.number, "rb");
    GmshChannel channel(stream, GmshChannel::Direction::receive);
    mesh.transfer(channel);
    std::fclose(stream);
    own_end.number = -1;
    int status     = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR)
    {
    }

    // 3. What it came to.
    if (WIFSIGNALED(status) && !is_crash(WTERMSIG(status)))
      fail_on_mesh(source,
                   std::string("gmsh was ended from outside (")
                       + strsignal(WTERMSIG(status))
                       + "), perhaps because memory is short. Coarsen the "
                         "mesh or use a larger machine.");
    if (!channel.is_complete())
      fail_on_mesh(
          source,
          "gmsh ended while it read or meshed the geometry. " + cure
              + " If coordinates are those of a map, subtract an offset "
                "from them: millions of metres leave gmsh no digits for "
                "small cells.");
    return mesh;
  }
} // namespace quoin
