#pragma once

#include <string>

#include "base/monitor.hpp"
#include "program/program.hpp"

namespace dotyk::program {

/// A program in a MATLAB file of version 5 to 7 (one of 4 or 7.3 is refused) as the Maros–Mészáros collection of qpsolvers keeps it: variables P
/// (n × n, both triangles), q, r, A (m × n, bounds are rows of it), l, u; ±1e20 and beyond is infinite.
/// A program of its own reads it (reader/process.hpp). Throws InputError naming file and variable; Interrupted where the
/// monitor asks to stop; std::runtime_error where dotyk was built without libmatio.
QuadraticProgram read_mat(const std::string& file, Monitor& monitor);

}  // namespace dotyk::program
