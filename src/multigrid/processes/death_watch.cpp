#include "multigrid/processes/death_watch.hpp"

#include <poll.h>
#include <sys/syscall.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "base/text.hpp"

namespace dotyk::multigrid {

namespace {

std::atomic<bool>& may_end() {
  static std::atomic<bool> may{false};
  return may;
}

struct Terminal {
  termios before{};
  bool there = tcgetattr(STDIN_FILENO, &before) == 0;
};

/// Ends this process with status 1, and says what has happened, unless `what` is empty.
[[noreturn]] void end_run(const std::string& what, const Terminal& terminal) {
  if (terminal.there) tcsetattr(STDIN_FILENO, TCSANOW, &terminal.before);
  if (!what.empty()) std::fprintf(stderr, "\ndotyk: %s; the run ends on all ranks\n", what.c_str());
  std::fflush(stderr);
  _exit(1);
}

/// Starts a thread with all signals blocked: other threads of the program receive them.
std::jthread quiet_thread(auto work) {
  sigset_t all, mask;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &mask);
  std::jthread thread(std::move(work));
  pthread_sigmask(SIG_SETMASK, &mask, nullptr);
  return thread;
}

std::vector<pid_t> children(pid_t process) {
  std::vector<pid_t> all;
  for (const auto& thread : std::filesystem::directory_iterator(text("/proc/", process, "/task"))) {
    std::ifstream list(thread.path() / "children");
    std::copy(std::istream_iterator<pid_t>(list), {}, std::back_inserter(all));
  }
  return all;
}

/// The process of MPI's daemon, a child of this one. 0: there is none.
pid_t find_daemon() {
  for (const pid_t child : children(getpid())) {
    std::string name;
    std::ifstream(text("/proc/", child, "/comm")) >> name;
    if (name == "orted") return child;
  }
  return 0;
}

void watch_start(const std::stop_token& ended) {
  using namespace std::chrono;
  const Terminal terminal;
  const auto latest = steady_clock::now() + minutes(1);
  for (bool seen = false; !ended.stop_requested(); std::this_thread::sleep_for(milliseconds(20))) {
    try {
      const pid_t daemon = find_daemon();
      const bool there = daemon && !children(daemon).empty();
      if (ended.stop_requested()) return;
      if (seen && !there) end_run("a rank has died while it started", terminal);
      if (daemon && !there && steady_clock::now() > latest) end_run("MPI has started no other rank within a minute", terminal);
      seen = there;
    } catch (const std::exception&) {
      // A process has ended while its files were read: the next look tells.
    }
  }
}

}  // namespace

StartWatch::StartWatch() : thread_(quiet_thread(watch_start)) {}

void watch_for_death(std::vector<Companion> companions, bool speaks) {
  std::vector<pollfd> watched;
  for (const Companion& c : companions) watched.push_back({static_cast<int>(syscall(SYS_pidfd_open, c.process, 0)), POLLIN, 0});
  const bool by_number = std::ranges::any_of(watched, [](const pollfd& p) { return p.fd < 0; });  // old kernels
  quiet_thread([by_number, companions = std::move(companions), watched = std::move(watched), terminal = Terminal(), speaks]() mutable {
    constexpr int kMilliseconds = 200;
    for (;;) {
      const int events = poll(watched.data(), watched.size(), by_number ? kMilliseconds : -1);
      const auto gone = [&](std::size_t k) { return watched[k].revents != 0 || (by_number && kill(companions[k].process, 0) != 0); };
      if (may_end()) return;
      for (std::size_t k = 0; events >= 0 && k < watched.size(); ++k) {
        if (!gone(k)) continue;
        for (const Companion& other : companions) kill(other.process, SIGKILL);
        end_run(speaks ? companions[k].name + " has died" : "", terminal);
      }
    }
  }).detach();
}

void stop_watching() { may_end() = true; }

}  // namespace dotyk::multigrid
