#pragma once
// Programs as scripts give them: matrices as tables of rows or as triplets, limits, files.
#include "program/lcp.hpp"
#include "program/program.hpp"
#include "script/bridge/call.hpp"

namespace dotyk::script {

template <> struct Wrapped<program::QuadraticProgram> : Called<"program"> {};

// A result remembers the program it belongs to.
struct ProgramResult {
  std::shared_ptr<program::QuadraticProgram> program;
  program::Result result;
  std::string method;
};
template <> struct Wrapped<ProgramResult> : Called<"program_result"> {};
template <> struct Wrapped<program::LcpResult> : Called<"lcp_result"> {};

// A matrix as rows of numbers or as triplets, and how it is read as one of n rows and columns; `vector` names what else has
// n entries. Throws InputError.
Key matrix_key(std::string name, std::string help);
algebra::SparseMatrix square_matrix(const Arguments& given, const std::string& name, int n, const std::string& vector);

// The keys of dotyk.qp that say what the program is.
std::vector<Key> program_keys();
// The program they describe. Throws InputError.
std::shared_ptr<program::QuadraticProgram> read_program(const Arguments& given, Monitor& monitor);

}  // namespace dotyk::script
