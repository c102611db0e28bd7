#include "script/guard/process_limits.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "base/whole_file.hpp"

namespace dotyk::script {
namespace {

constexpr double bytes_of_a_thread = 150e6;  // OpenBLAS's buffer, and a stack
constexpr double bytes_to_begin = 8e6;       // of a script's own, above what dotyk takes before it

void time_is_up(int signal) {
  const std::string_view message = signal == SIGXCPU ? "dotyk: the limit of processors' time is reached (--seconds)\n"
                                                     : "dotyk: the limit of time is reached (--clock)\n";
  const auto written = ::write(STDERR_FILENO, message.data(), message.size());
  _exit(written > 0 ? 1 : 3);
}

// Nobody can raise it again. `beyond` it the system ends the program without a word.
void limit(int resource, double value, double beyond = 0) {
  rlimit limits{};
  getrlimit(resource, &limits);
  limits.rlim_cur = std::min(static_cast<rlim_t>(value), limits.rlim_max);
  limits.rlim_max = std::min(static_cast<rlim_t>(value + beyond), limits.rlim_max);
  setrlimit(resource, &limits);
}

}  // namespace

void ProcessLimits::fill_in_for_safe(bool prompt) {
  if (!seconds) seconds = 600;
  if (!clock && !prompt) clock = 3600;
  if (!file) file = 1e9;
  if (!files) files = 4e9;
#ifndef __SANITIZE_ADDRESS__  // which takes all of the address space
  if (!memory) memory = std::max(2e9, 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)));
#endif
}

void leave_threads_if_tight(const ProcessLimits& limits, char** words) {
  rlimit own{};
  double memory = limits.memory.value_or(INFINITY);
  if (getrlimit(RLIMIT_AS, &own) == 0 && own.rlim_cur != RLIM_INFINITY) memory = std::min(memory, static_cast<double>(own.rlim_cur));
  if (4 * bytes_of_a_thread * cores() <= memory) return;
  const char* name = "OPENBLAS_NUM_THREADS";
  const char* threads = std::getenv(name);
  if (threads && std::string(threads) == "1") return;
  setenv(name, "1", 1);
  execv("/proc/self/exe", words);  // where that fails, the threads stay
}

void set_limits(const ProcessLimits& limits) {
  std::signal(SIGXFSZ, SIG_IGN);  // of ulimit -f, too
  file_bytes_left = limits.files.value_or(INFINITY);
  if (limits.file || limits.files) {
    limit(RLIMIT_FSIZE, std::min(limits.file.value_or(INFINITY), file_bytes_left));
    limit(RLIMIT_CORE, 0);
  }
  if (limits.memory) {
    const double least = address_space_taken() + bytes_to_begin;
    if (*limits.memory < least)
      throw std::runtime_error(text("--memory ", *limits.memory * 1e-6, "M is less than dotyk needs to start (about ", std::ceil(least * 1e-6), "M)"));
    limit(RLIMIT_AS, *limits.memory);
  }
  if (std::isfinite(address_space_left())) {
    mallopt(M_ARENA_MAX, 1);  // each thread's arena would take 64 MB of address space
    mallopt(M_MMAP_THRESHOLD, 1 << 22), mallopt(M_TRIM_THRESHOLD, 1 << 22);  // a freed array gives its address space back
  }
  memory_limit();  // as it is now
  for (const int signal : {SIGXCPU, SIGALRM}) std::signal(signal, time_is_up);
  if (limits.seconds) limit(RLIMIT_CPU, std::ceil(*limits.seconds), 5);
  if (!limits.clock) return;
  constexpr double longest = 1e8;  // three years; more is more than the system's timer takes
  const itimerval timer{{0, 0}, {static_cast<time_t>(std::ceil(std::min(*limits.clock, longest))), 0}};
  setitimer(ITIMER_REAL, &timer, nullptr);
}

}  // namespace dotyk::script
