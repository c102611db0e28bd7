#pragma once
// What a process of dotyk may take of the machine, kept by the system: whatever runs, Lua, C++ or a foreign library.
#include <optional>

namespace dotyk::script {

// Seconds of processors' time, that of the programs that read files included (reader/process.cpp), and of the clock;
// bytes of memory, of one file, and of all files together, the removed ones too. Absent: no limit.
struct ProcessLimits {
  std::optional<double> seconds, clock, memory, file, files;

  // What is absent takes the place of --safe's own: 600 s, half of the machine's memory (2 GB at least), 1 GB a file,
  // 4 GB of files; an hour of the clock, but no limit of it at the prompt.
  void fill_in_for_safe(bool prompt);
};

// OpenBLAS starts its threads before main, each of which asks for memory again and again until it gets it. Where the
// limit, or that of ulimit -v, is tight for as many as the machine has, starts this program anew with one thread, and
// does not return. `words`: as main was given them.
void leave_threads_if_tight(const ProcessLimits& limits, char** words);

// From here on, and for the programs that this one starts; none of them can raise a limit again. A file beyond its
// limit is an error where it is written; the end of the time ends the program, status 1, with a line that says so. Of
// all files together dotyk keeps count (base/whole_file.hpp; of Lua's, watch_files in safe.hpp), not the system.
// Throws std::runtime_error where the memory is less than what is taken already.
void set_limits(const ProcessLimits& limits);

}  // namespace dotyk::script
