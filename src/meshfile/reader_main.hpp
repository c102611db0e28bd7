#pragma once
// What the programs that read files with foreign libraries have in common: limits, and the answer on standard output.

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <string>

#include "base/memory.hpp"
#include "contents.hpp"

namespace dotyk::meshfile {

/// No more memory than there is, an end when dotyk ends, no core files. `seconds` of processor time; 0: as many as it takes.
inline void limit_reader(double seconds) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  const double memory = 0.9 * available_memory();
  if (std::isfinite(memory)) {
    const rlimit limit{static_cast<rlim_t>(memory), static_cast<rlim_t>(memory)};
    setrlimit(RLIMIT_DATA, &limit);
  }
  if (seconds > 0) {
    const rlimit limit{static_cast<rlim_t>(seconds), static_cast<rlim_t>(seconds) + 1};
    setrlimit(RLIMIT_CPU, &limit);
  }
}

/// Processor time that reading a file may take: far more than it does, so that only an endless loop meets it.
inline double reading_seconds(const std::string& file) {
  std::error_code none;
  return 20 + 1e-6 * static_cast<double>(std::filesystem::file_size(file, none));
}

/// Writes what `contents` returns, status 0, or the message of what it throws, status 1. Libraries that write to
/// standard output do not get into the answer.
inline int answer(const std::function<Contents()>& contents) {
  std::FILE* out = fdopen(dup(STDOUT_FILENO), "wb");
  if (!out || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) return 2;
  try {
    write(out, contents());
    std::fflush(out);
    std::_Exit(0);  // nothing of the libraries' own ends is needed
  } catch (const std::bad_alloc&) {
    std::fputs("it needs more memory than there is; the file may be damaged", out);
  } catch (const std::exception& e) {
    std::fputs(e.what(), out);
  }
  std::fflush(out);
  std::_Exit(1);
}

}  // namespace dotyk::meshfile
