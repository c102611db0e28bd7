#include "multigrid/processes/death_watch.hpp"

#include <poll.h>
#include <sys/syscall.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <thread>

namespace dotyk::multigrid {

namespace {

std::atomic<bool>& may_end() {
  static std::atomic<bool> may{false};
  return may;
}

void end_with(const std::vector<Companion>& companions, std::size_t dead, bool speaks, const termios* terminal) {
  for (const Companion& other : companions) kill(other.process, SIGKILL);
  if (terminal) tcsetattr(STDIN_FILENO, TCSANOW, terminal);
  if (speaks) std::fprintf(stderr, "\ndotyk: %s has died; the run ends on all ranks\n", companions[dead].name.c_str());
  std::fflush(stderr);
  _exit(1);
}

}  // namespace

void watch_for_death(std::vector<Companion> companions, bool speaks) {
  std::vector<pollfd> watched;
  for (const Companion& c : companions) watched.push_back({static_cast<int>(syscall(SYS_pidfd_open, c.process, 0)), POLLIN, 0});
  termios before;
  const bool on_terminal = tcgetattr(STDIN_FILENO, &before) == 0;
  sigset_t all, mask;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &mask);  // the thread's; signals stay the program's
  const bool by_number = std::ranges::any_of(watched, [](const pollfd& p) { return p.fd < 0; });  // old kernels
  std::thread([by_number, companions = std::move(companions), watched = std::move(watched), before, on_terminal, speaks]() mutable {
    constexpr int kMilliseconds = 200;
    for (;;) {
      const int events = poll(watched.data(), watched.size(), by_number ? kMilliseconds : -1);
      const auto gone = [&](std::size_t k) { return watched[k].revents != 0 || (by_number && kill(companions[k].process, 0) != 0); };
      if (may_end()) return;
      for (std::size_t k = 0; events >= 0 && k < watched.size(); ++k)
        if (gone(k)) end_with(companions, k, speaks, on_terminal ? &before : nullptr);
    }
  }).detach();
  pthread_sigmask(SIG_SETMASK, &mask, nullptr);
}

void stop_watching() { may_end() = true; }

}  // namespace dotyk::multigrid
