// SPDX-License-Identifier: LGPL-2.1-or-later
#include "apps/chart/processes.h"

#include "core/base/error.h"

#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <list>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ogive::chart
{
namespace
{
using Clock = std::chrono::steady_clock;

/// What a child writes, kept in memory.
class Capture
{
public:
  Capture()
    : file_(::memfd_create("ogive-chart", MFD_CLOEXEC))
  {
    if (file_ < 0)
      throw RunError(std::string("cannot hold the output of a run: ") + std::strerror(errno));
  }
  ~Capture() { ::close(file_); }
  Capture(const Capture &)            = delete;
  Capture &operator=(const Capture &) = delete;

  int file() const { return file_; }

  std::string text() const
  {
    std::string all(static_cast<std::size_t>(::lseek(file_, 0, SEEK_END)), '\0');
    const auto  n = ::pread(file_, all.data(), all.size(), 0);
    all.resize(n < 0 ? 0 : static_cast<std::size_t>(n));
    return all;
  }

private:
  int file_;
};

class Child
{
public:
  Child(const Job &job, std::size_t index)
    : index_(index)
    , limit_(job.limit)
    , start_(Clock::now())
  {
    std::vector<char *> arguments;
    for (const std::string &a : job.command)
      arguments.push_back(const_cast<char *>(a.c_str()));
    arguments.push_back(nullptr);
    const pid_t parent = ::getpid();
    pid_                = ::fork();
    if (pid_ < 0)
      throw RunError(std::string("cannot start a run: ") + std::strerror(errno));
    if (pid_ == 0)
      become(arguments.data(), parent);
  }
  ~Child()
  {
    if (pid_ > 0)
    {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
  }
  Child(const Child &)            = delete;
  Child &operator=(const Child &) = delete;

  std::size_t index() const { return index_; }

  /// Whether it has ended; ends it at its limit.
  bool poll(Ended &e)
  {
    const double wall = std::chrono::duration<double>(Clock::now() - start_).count();
    if (limit_ > 0 && wall > limit_ && !too_long_)
    {
      too_long_ = true;
      ::kill(pid_, SIGKILL);
    }
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) != pid_)
      return false;
    pid_       = 0;
    e.exit     = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    e.signal   = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    e.too_long = too_long_ && e.signal == SIGKILL;
    e.wall_s   = wall;
    e.out      = out_.text();
    e.err      = err_.text();
    return true;
  }

private:
  [[noreturn]] void become(char *const *arguments, pid_t parent) const
  {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent)
      ::_exit(126); // it died before the line above
    const int nothing = ::open("/dev/null", O_RDONLY);
    ::dup2(nothing, STDIN_FILENO);
    ::dup2(out_.file(), STDOUT_FILENO);
    ::dup2(err_.file(), STDERR_FILENO);
    // runs stand side by side: one thread each, unless the user says otherwise
    ::setenv("DEAL_II_NUM_THREADS", "1", 0);
    ::execv(arguments[0], arguments);
    ::_exit(127);
  }

  Capture           out_, err_;
  std::size_t       index_;
  double            limit_;
  Clock::time_point start_;
  pid_t             pid_      = 0;
  bool              too_long_ = false;
};
} // namespace

std::string last_line(const std::string &text)
{
  std::istringstream in(text);
  std::string        last;
  for (std::string line; std::getline(in, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos)
      last = line;
  return last;
}

void run_all(const std::vector<Job> &jobs, int at_once, const std::function<void(std::size_t, const Ended &)> &ended,
             const std::function<void(std::size_t)> &waiting)
{
  constexpr auto   pause      = std::chrono::milliseconds(5);
  constexpr int    wait_every = 20;
  std::list<Child> running;
  std::size_t      next = 0;
  for (int round = 0; next < jobs.size() || !running.empty(); ++round)
  {
    while (next < jobs.size() && running.size() < static_cast<std::size_t>(at_once))
    {
      running.emplace_back(jobs[next], next);
      ++next;
    }
    for (auto child = running.begin(); child != running.end();)
    {
      Ended e;
      if (!child->poll(e))
      {
        ++child;
        continue;
      }
      const std::size_t index = child->index();
      child                   = running.erase(child);
      ended(index, e);
    }
    if (waiting && round % wait_every == 0)
      waiting(running.size());
    std::this_thread::sleep_for(pause);
  }
}

std::string own_program()
{
  return std::filesystem::read_symlink("/proc/self/exe").string();
}
} // namespace ogive::chart
