#pragma once

#include <string>
#include <vector>

#include "base/monitor.hpp"

namespace dotyk::reader {

/// The program of this name beside dotyk, in its library folder or in the build tree. Where it is not there, throws
/// std::runtime_error: that dotyk was built without `library`, which says too what can be done, or that the program was
/// built and has been lost.
std::string require_program(const std::string& name, const std::string& library);

/// What the program writes to its standard output. It runs in a process of its own, so that a damaged file that
/// makes a library crash or take all memory ends that process and no more. Its standard error is not shown.
///
/// Throws InputError, beginning with `what`: the program's own message (its output, where it ends with status 1),
/// or that it crashed or took more time or memory than it may, then `why`, what that may come from; Interrupted where the
/// monitor asks to stop; std::runtime_error where it cannot start.
std::string output_of(const std::string& program, const std::vector<std::string>& arguments, const std::string& what,
                      Monitor& monitor, const std::string& why = "the file may be damaged");

}  // namespace dotyk::reader
