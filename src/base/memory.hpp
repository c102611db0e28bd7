#pragma once

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "base/error.hpp"

namespace dotyk {

namespace detail {

/// The number that a one-line file of /proc or /sys begins with; infinite where it has none ("max").
inline double number_in(const std::string& file) {
  std::ifstream in(file);
  double value = 0;
  return in >> value ? value : INFINITY;
}

}  // namespace detail

/// Bytes of address space that this process has taken; 0 where the system does not say.
inline double address_space_taken() {
  const double pages = detail::number_in("/proc/self/statm");
  return std::isfinite(pages) ? pages * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0;
}

/// Bytes of address space that this process's own limit (ulimit -v, --memory) leaves; infinite without one.
inline double address_space_left() {
  rlimit own{};
  if (getrlimit(RLIMIT_AS, &own) != 0 || own.rlim_cur == RLIM_INFINITY) return INFINITY;
  return std::max(0.0, static_cast<double>(own.rlim_cur) - address_space_taken());
}

/// Throws InputError where that is less than `bytes`, for libraries that end the program, or ask for ever, where they do not
/// get what they need. `what` begins the message.
inline void require_address_space(double bytes, const std::string& what) {
  const double left = address_space_left();
  if (bytes > left)
    throw InputError(text(what, " needs ", std::ceil(bytes * 1e-6), " MB of memory, and the limit (--memory, ulimit -v) leaves ", std::floor(left * 1e-6), " MB"));
}

/// The least that `of` says of a control group that this process is in, by its folder.
template <class Of>
double least_of_groups(const Of& of) {
  double least = INFINITY;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    if (!line.starts_with("0::/")) continue;
    for (std::string group = line.substr(3); !group.empty(); group.resize(group.rfind('/'))) least = std::min(least, of("/sys/fs/cgroup" + group));
  }
  return std::min(least, of("/sys/fs/cgroup"));
}

/// Bytes that this process may take in all, as they were at the first call, which a program makes when it begins: the machine's memory, what a control group
/// allows, and what its own limit (--memory, ulimit -v) left then. Whatever else takes memory does not change the answer.
inline double memory_limit() {
  static const double limit = [] {
    const double machine = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    return std::min({machine, least_of_groups([](const std::string& group) { return detail::number_in(group + "/memory.max"); }), address_space_left()});
  }();
  return limit;
}

/// Bytes this process may still take without swapping: what the machine has available, its control
/// groups leave and its own limit (ulimit -v) allows. Infinite where none of them is known.
inline double available_memory() {
  double available = INFINITY;
  std::ifstream machine("/proc/meminfo");
  std::string word;
  while (machine >> word)
    if (word == "MemAvailable:" && machine >> available) available *= 1024;
  const double groups = least_of_groups([](const std::string& group) {
    const double most = detail::number_in(group + "/memory.max"), used = detail::number_in(group + "/memory.current");
    return std::isfinite(used) ? std::max(0.0, most - used) : INFINITY;
  });
  return std::min({available, groups, address_space_left()});
}

/// Are so many bytes available? If not, memory that malloc keeps for later arrays is given back to the system, and the question is asked again.
inline bool memory_for(double bytes) { return bytes <= available_memory() || (malloc_trim(0), bytes <= available_memory()); }

/// Throws InputError where `bytes` are more than are available: Linux would promise them, and end the
/// program when they are used. `what` begins the message: "a mesh of 5e7 cells".
inline void require_memory(double bytes, const std::string& what) {
  if (bytes < 64e6 || memory_for(bytes)) return;  // fewer bytes are not worth asking for
  throw InputError(text(what, " needs ", bytes * 1e-9, " GB of memory, ", available_memory() * 1e-9,
                        " GB are available: use fewer cells, half the body where it is symmetric, or finer "
                        "cells only where they matter (grading)"));
}

}  // namespace dotyk
