#pragma once
// What the programs that read files with foreign libraries have in common: limits, and the answer on standard output.

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <string>

#include "base/memory.hpp"
#include "reader/bytes.hpp"

namespace dotyk::reader {

/// From here on this process, with all threads it starts, computes, reads files and writes to what it has open, and nothing
/// else: it starts no program, opens no file for writing, removes, renames and makes none, and reaches no network. Such
/// calls fail with EPERM. For libraries that take commands from the files they read. A Linux kernel without seccomp
/// leaves the process as it is.
void wall_in();

/// Beneath what dotyk has itself.
inline void limit(int resource, double most) {
  rlimit value{};
  getrlimit(resource, &value);
  value.rlim_cur = value.rlim_max = std::min(static_cast<rlim_t>(most), value.rlim_cur);
  setrlimit(resource, &value);
}

/// An end when dotyk ends, no core files, no more memory than there is, no program started and no file written.
inline void limit_reader() {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_CORE, 0);
  const double memory = 0.9 * available_memory();
  if (std::isfinite(memory)) limit(RLIMIT_DATA, memory);
  wall_in();
}

/// The same for reading a file, with no more memory and processor time than a hundred times what it takes: only damaged
/// files, with counts of theirs in billions or endless loops, meet that.
inline void limit_reader(const std::string& file) {
  limit_reader();
  std::error_code none;
  const auto bytes = static_cast<double>(std::filesystem::file_size(file, none));
  limit(RLIMIT_DATA, std::min(0.9 * available_memory(), 512e6 + 100 * bytes));
  limit(RLIMIT_CPU, 20 + 1e-6 * bytes);
}

/// Lets `write` write what it reads, status 0; of what it throws, before it has written, the message, status 1, or kNoMemory. Libraries
/// that write to standard output do not get into the answer.
inline int answer(const std::function<void(std::FILE*)>& write) {
  std::FILE* out = fdopen(dup(STDOUT_FILENO), "wb");
  if (!out || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return 2;
  try {
    write(out);
    std::fflush(out);
    std::_Exit(0);  // nothing of the libraries' own ends is needed
  } catch (const std::bad_alloc&) {
    std::_Exit(kNoMemory);
  } catch (const std::exception& e) {
    std::fputs(e.what(), out);
  }
  std::fflush(out);
  std::_Exit(1);
}

}  // namespace dotyk::reader
