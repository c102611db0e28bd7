#pragma once
// What a process of dotyk may take of the machine, kept by the system: whatever runs, Lua, C++ or a foreign library.
#include <optional>

namespace dotyk::script {

// Bytes, and seconds of processors' time, that of the programs that read files included (reader/process.cpp); absent:
// no limit.
struct ProcessLimits {
  std::optional<double> seconds, memory, file;

  // What is absent takes the place of --safe's own: 600 s, half of the machine's memory (2 GB at least), 1 GB a file.
  void fill_in_for_safe();
};

// OpenBLAS starts its threads before main, each of which asks for memory again and again until it gets it. Where the
// limit, or that of ulimit -v, is tight for as many as the machine has, starts this program anew with one thread, and
// does not return. `words`: as main was given them.
void leave_threads_if_tight(const ProcessLimits& limits, char** words);

// From here on. A file beyond its limit is an error where it is written; the end of the time ends the program, status 1,
// with a line that says so. Throws std::runtime_error where the memory is less than what is taken already.
void set_limits(const ProcessLimits& limits);

}  // namespace dotyk::script
