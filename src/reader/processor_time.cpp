#include "reader/processor_time.hpp"

#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <csignal>

namespace dotyk::reader {
namespace {

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

}  // namespace

void count_running(pid_t program) {
  if (std::isfinite(allowed())) end_where_spent(taken_by_running(program));
}

void count_ended() {
  if (!std::isfinite(allowed())) return;
  end_where_spent(0);
  rlimit limit = own_limit();
  limit.rlim_cur = static_cast<rlim_t>(std::max(1.0, std::ceil(allowed() - taken_by(RUSAGE_CHILDREN))));
  setrlimit(RLIMIT_CPU, &limit);
}

}  // namespace dotyk::reader
