#include "reader/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include "base/open_library.hpp"
#include "reader/bytes.hpp"

extern char** environ;

namespace dotyk::reader {
namespace {

// The limit of processors' time of this process (--seconds, ulimit -t) is one for it and the programs that it starts together:
// where that time is spent, this process ends as by the limit (SIGXCPU).

/// Of this process alone, as the system keeps it now.
rlimit own_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_CPU, &limit) != 0) limit.rlim_cur = RLIM_INFINITY;
  return limit;
}

/// Seconds for all together; what it is when the first program is started, for count_ended() lowers the system's.
double allowed() {
  static const double seconds = own_limit().rlim_cur == RLIM_INFINITY ? INFINITY : static_cast<double>(own_limit().rlim_cur);
  return seconds;
}

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); }

double taken_by(int who) {
  rusage usage{};
  return getrusage(who, &usage) == 0 ? seconds(usage.ru_utime) + seconds(usage.ru_stime) : 0;
}

double taken_by_running(pid_t program) {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(program, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void end_where_spent(double more) {
  if (taken_by(RUSAGE_SELF) + taken_by(RUSAGE_CHILDREN) + more >= allowed()) std::raise(SIGXCPU);
}

/// To be called from time to time while the program runs, so that it gets no more than what is left.
void count_running(pid_t program) {
  if (std::isfinite(allowed())) end_where_spent(taken_by_running(program));
}

/// To be called when a program has ended and been waited for: what it took is no longer this process's.
void count_ended() {
  if (!std::isfinite(allowed())) return;
  end_where_spent(0);
  rlimit limit = own_limit();
  limit.rlim_cur = static_cast<rlim_t>(std::max(1.0, std::ceil(allowed() - taken_by(RUSAGE_CHILDREN))));
  setrlimit(RLIMIT_CPU, &limit);
}

/// The reading end of a pipe to a running program.
class Child {
 public:
  Child(const std::string& program, const std::vector<std::string>& arguments) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(text("cannot start ", program, ": ", std::strerror(errno)));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    const int failed = posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    out_ = ends[0];
    if (failed) {
      close(out_);
      throw std::runtime_error(text("cannot start ", program, ": ", std::strerror(failed)));
    }
  }
  ~Child() {
    close(out_);
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::string output(Monitor& monitor) {
    std::string all;
    std::vector<char> some(1 << 16);
    for (;;) {
      count_running(pid_);
      pollfd ready{out_, POLLIN, 0};
      if (poll(&ready, 1, 100) <= 0) {
        monitor.check();
        continue;
      }
      const ssize_t n = ::read(out_, some.data(), some.size());
      if (n > 0) all.append(some.data(), static_cast<std::size_t>(n));
      else if (n == 0 || errno != EINTR) return all;
    }
  }

  /// The status of its end.
  int wait() {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = 0;
    count_ended();
    return status;
  }

 private:
  pid_t pid_ = 0;
  int out_ = -1;
};

}  // namespace

std::string require_program(const std::string& name, const std::string& library) {
  for (const std::string& place : places_of(name, DOTYK_READER_LIBDIR, DOTYK_READER_BUILD "/" + name))
    if (access(place.c_str(), X_OK) == 0) return place;
  const bool built = std::string(" " DOTYK_READERS " ").find(" " + name + " ") != std::string::npos;
  throw std::runtime_error(built ? "the program " + name + ", which reads such files, is not beside dotyk or in its library folder: install or build dotyk again"
                                 : "this dotyk was built without " + library);
}

std::string output_of(const std::string& program, const std::vector<std::string>& arguments, const std::string& what,
                      Monitor& monitor, const std::string& why) {
  Child child(program, arguments);
  std::string out = child.output(monitor);
  const int status = child.wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return out;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 1) throw InputError(what + ": " + out);
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNoMemory) throw InputError(what + ": it needs more memory than there is; " + why);
  constexpr int cannot_begin = 127;
  if (WIFEXITED(status) && WEXITSTATUS(status) == cannot_begin && std::isfinite(address_space_left()))
    throw std::runtime_error(what + ": " + program + " cannot begin within the limit of memory (--memory, ulimit -v)");
  if (!WIFSIGNALED(status)) throw std::runtime_error(text(what, ": ", program, " failed with status ", WEXITSTATUS(status)));
  switch (const int signal = WTERMSIG(status)) {
    case SIGINT: throw Interrupted();
    case SIGXCPU: throw InputError(what + ": it takes more processors' time than it may; " + why);
    case SIGKILL: throw InputError(what + ": the system has ended its reader, as it does where memory is short; " + why);
    default: throw InputError(text(what, ": the library that reads it crashed on it (", strsignal(signal), "); ", why));
  }
}

}  // namespace dotyk::reader
