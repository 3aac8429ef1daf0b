// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/processes.h"

#include "core/base/error.h"
#include "core/parallel/together.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iostream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ogive::apps
{
namespace
{
/// Wall time that ranks have to come to the same error, s: they may share cores
/// with many others.
constexpr double patience = 10;

volatile sig_atomic_t child_of_relay = 0;

/// Hands a signal on. A terminal sends its own to all processes by itself.
void relay(int number, siginfo_t *info, void *)
{
  if (info->si_code <= 0 && child_of_relay > 0)
    kill(child_of_relay, number);
}

std::vector<std::string> command_line(int ranks, char *const argv[])
{
  std::array<char, 4096> self{};
  const ssize_t          n = readlink("/proc/self/exe", self.data(), self.size() - 1);
  // Quiet: mpirun would comment on every exit status but 0. Ranks that wait give
  // way, or more of them than cores would stand in each other's way.
  std::vector<std::string> line = {"mpirun", "-q", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none",
                                   "--mca", "mpi_yield_when_idle", "1", "-n", std::to_string(ranks),
                                   n > 0 ? std::string(self.data(), static_cast<std::size_t>(n)) : argv[0]};
  for (int i = 1; argv[i] != nullptr; ++i)
    line.emplace_back(argv[i]);
  return line;
}

/// In the child: becomes the command, or tells why not.
[[noreturn]] void become(std::vector<std::string> line, int complaints)
{
  prctl(PR_SET_PDEATHSIG, SIGTERM); // whoever kills the parent means all
  std::vector<char *> words;
  for (std::string &word : line)
    words.push_back(word.data());
  words.push_back(nullptr);
  execvp(words[0], words.data());
  const int error = errno;
  if (write(complaints, &error, sizeof error) < 0)
    _exit(127);
  _exit(127);
}

/// The child's exit status as waitpid() has it; throws if it could not begin.
int run_child(const std::vector<std::string> &line)
{
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
    throw RunError(std::string("cannot start processes: ") + std::strerror(errno));
  struct sigaction action = {};
  action.sa_sigaction     = relay;
  action.sa_flags         = SA_SIGINFO | SA_RESTART;
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    sigaction(number, &action, nullptr); // a program that begins has its own again
  const pid_t child = fork();
  if (child == 0)
    become(line, pipe_ends[1]);
  child_of_relay = child;
  close(pipe_ends[1]);
  int        error = 0;
  const bool failed = child < 0 || read(pipe_ends[0], &error, sizeof error) > 0;
  close(pipe_ends[0]);
  int status = 0;
  if (child > 0)
    waitpid(child, &status, 0);
  if (failed && error == ENOENT)
    throw InputError("-n: mpirun is not there; it starts the processes: install it (Debian: openmpi-bin), or leave -n out");
  if (failed)
    throw RunError(std::string("mpirun cannot be started: ") + std::strerror(error));
  return status;
}
} // namespace

int start_ranks(int ranks, char *const argv[])
{
  const int status = run_child(command_line(ranks, argv));
  // mpirun passes the signal of a process on as a shell does
  const int code   = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  const int number = code - 128;
  if (number <= 0)
    return code;
  throw RunError("the run was ended by signal " + std::to_string(number) + " (" + strsignal(number) + ") of one of its " +
                 std::to_string(ranks) + " processes" +
                 (number == SIGKILL ? "; was there not enough memory?" : std::string()));
}

void expect_ranks(const Ranks &ranks, int wanted)
{
  if (wanted != 0 && wanted != ranks.size())
    throw InputError("-n " + std::to_string(wanted) + ": mpirun has started " + std::to_string(ranks.size()) +
                     (ranks.alone() ? " process" : " processes") + "; leave -n out, or mpirun");
}

void expect_alone(const Ranks &ranks, const char *command)
{
  if (!ranks.alone())
    throw InputError("\"" + std::string(command) + "\" runs on one process; start it without mpirun");
}

int finish(const Ranks &ranks, const std::function<int()> &command)
{
  Ending end;
  try
  {
    return command();
  }
  catch (const InputError &e)
  {
    end = {bad_input, std::string("ogive: ") + e.what()};
  }
  catch (const std::exception &e)
  {
    end = {run_failed, std::string("ogive: ") + e.what()};
  }
  end = end_together(ranks, end, run_failed, patience);
  if (!end.message.empty())
    std::cerr << end.message << '\n';
  return end.status;
}
} // namespace ogive::apps
