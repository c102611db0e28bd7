#pragma once

#include <istream>
#include <string>

#include "base/monitor.hpp"
#include "program/program.hpp"

namespace dotyk::program {

/// A program in QPS format (MPS with QUADOBJ or QMATRIX; Maros and Mészáros 1999), fields separated by
/// blanks, names without blanks. Understood: NAME, OBJSENSE, ROWS (N, E, L, G; N rows after the first are
/// left out), COLUMNS, RHS (of the objective: minus its constant), RANGES, BOUNDS (LO, UP, FX, FR, MI, PL),
/// QUADOBJ and QSECTION (one triangle), QMATRIX (both), ENDATA. Variables are ≥ 0 unless bounded otherwise;
/// an UP bound below zero without a lower bound makes the lower one −∞. Of several RHS, RANGES or BOUNDS
/// sets the first is taken. OBJSENSE MAX: the objective is negated. Finite bounds of variables become
/// single-entry rows after the others. Throws InputError "file:line: …".
QuadraticProgram read_qps(const std::string& file);
/// The same from a stream; `name` stands for the file in messages.
QuadraticProgram read_qps(std::istream& in, const std::string& name);

/// A program in a MATLAB file of version 5 to 7 (one of 4 or 7.3 is refused) as the Maros–Mészáros collection of qpsolvers keeps it: variables P
/// (n × n, both triangles), q, r, A (m × n, bounds are rows of it), l, u; ±1e20 and beyond is infinite.
/// A program of its own reads it (reader/process.hpp). Throws InputError naming file and variable; Interrupted where the
/// monitor asks to stop; std::runtime_error where dotyk was built without libmatio.
QuadraticProgram read_mat(const std::string& file, Monitor& monitor);

}  // namespace dotyk::program
