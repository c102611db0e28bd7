#include "reader/process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cmath>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"
#include "reader/processor_time.hpp"

extern char** environ;

namespace dotyk::reader {
namespace {

std::string own_folder() {
  char path[PATH_MAX];
  const ssize_t n = readlink("/proc/self/exe", path, sizeof path);
  const std::string program(path, n > 0 ? static_cast<std::size_t>(n) : 0);
  return program.substr(0, program.rfind('/') == std::string::npos ? 0 : program.rfind('/'));
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
  const std::string here = own_folder();
  const std::vector<std::string> places{here + "/" + name, here + "/../lib/dotyk/" + name, here + "/../" DOTYK_READER_LIBDIR "/dotyk/" + name,
                                        DOTYK_READER_BUILD "/" + name};
  for (const std::string& place : places)
    if (access(place.c_str(), X_OK) == 0) return place;
  const bool built = std::string(" " DOTYK_READERS " ").find(" " + name + " ") != std::string::npos;
  throw std::runtime_error(built ? "the program " + name + ", which reads such files, is not beside dotyk or in its library folder: install or build dotyk again"
                                 : "this dotyk was built without " + library);
}

std::string output_of(const std::string& program, const std::vector<std::string>& arguments, const std::string& what,
                      Monitor& monitor) {
  Child child(program, arguments);
  std::string out = child.output(monitor);
  const int status = child.wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return out;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 1) throw InputError(what + ": " + out);
  constexpr int cannot_begin = 127;
  if (WIFEXITED(status) && WEXITSTATUS(status) == cannot_begin && std::isfinite(address_space_left()))
    throw std::runtime_error(what + ": " + program + " cannot begin within the limit of memory (--memory, ulimit -v)");
  if (!WIFSIGNALED(status)) throw std::runtime_error(text(what, ": ", program, " failed with status ", WEXITSTATUS(status)));
  switch (const int signal = WTERMSIG(status)) {
    case SIGINT: throw Interrupted();
    case SIGXCPU:
    case SIGKILL: throw InputError(what + ": reading it took too long, or more memory than there is; the file may be damaged");
    default: throw InputError(text(what, ": the library that reads it crashed on it (", strsignal(signal), "); the file may be damaged"));
  }
}

}  // namespace dotyk::reader
