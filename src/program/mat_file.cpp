#include "program/program_file.hpp"

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "base/error.hpp"
#include "base/memory.hpp"
#include "base/place.hpp"
#include "program/mat_variable.hpp"
#include "reader/process.hpp"

namespace dotyk::program {
namespace {

/// 1e20 less the rounding of a scaling.
constexpr double kInfinite = 0.99e20;

template <class Matrix>
Matrix matrix_of(const MatVariable& v) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t k = 0; k < v.value.size(); ++k) entries.emplace_back(v.row[k], v.column[k], v.value[k]);
  Matrix a(v.rows, v.columns);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

/// A row or a column.
Vector vector_of(const MatVariable& v) {
  Vector x = Vector::Zero(static_cast<Eigen::Index>(v.rows) * v.columns);
  for (std::size_t k = 0; k < v.value.size(); ++k) x[v.row[k] + v.column[k]] = v.value[k];
  return x;
}

}  // namespace

QuadraticProgram read_mat(const std::string& file, Monitor& monitor) {
  require_readable(file);
  const std::string what = "'" + file + "'";
  const std::string program = reader::require_program("dotyk_mat", "libmatio (apt-get install libmatio-dev, then build again)");
  const std::string bytes = reader::output_of(program, {file, "P", "q", "r", "A", "l", "u"}, what, monitor);
  reader::Answer answer(bytes);
  MatVariable found[6];
  for (MatVariable& v : found) v = read_variable(answer);
  answer.end();
  double needed = 8.0 * static_cast<double>(bytes.size());
  for (const MatVariable& v : found) needed += 40.0 * (static_cast<double>(v.rows) + v.columns);
  require_memory(needed, what);
  const auto& [P, q, r, A, l, u] = found;
  const auto fail = [&](const char* name, const char* problem) {
    throw InputError(what + ": variable '" + name + "' " + problem);
  };
  for (const auto& [name, v] : {std::pair{"P", &P}, std::pair{"q", &q}, std::pair{"A", &A}, std::pair{"l", &l}, std::pair{"u", &u}})
    if (v->rows < 0) fail(name, "is missing; it must have P, q, A, l and u");
  for (const auto& [name, v] : {std::pair{"q", &q}, std::pair{"l", &l}, std::pair{"u", &u}})
    if (v->rows > 1 && v->columns > 1) fail(name, "is not a vector");
  if (r.rows >= 0 && (r.rows != 1 || r.columns != 1)) fail("r", "is not a number");
  if (P.rows != P.columns) fail("P", "is not square");

  QuadraticProgram p;
  const SparseMatrix full = matrix_of<SparseMatrix>(P), transposed = full.transpose();
  if ((full - transposed).norm() > 1e-12 * full.norm()) fail("P", "is not symmetric");
  p.P = full.triangularView<Eigen::Lower>();
  p.q = vector_of(q);
  p.r = r.value.empty() ? 0 : r.value.front();
  if (!std::isfinite(p.r)) fail("r", "is not finite");
  p.A = matrix_of<SparseRows>(A);
  p.low = vector_of(l), p.high = vector_of(u);
  for (double& x : p.low) x = x <= -kInfinite ? -INFINITY : x;
  for (double& x : p.high) x = x >= kInfinite ? INFINITY : x;
  p.name = std::filesystem::path(file).stem();
  check(p);
  return p;
}

}  // namespace dotyk::program
