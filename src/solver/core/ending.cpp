#include "solver/core/ending.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace dotyk::solver {
namespace {

std::size_t first_clause(const std::string& reason) { return std::min(reason.find("; "), reason.size()); }

}  // namespace

std::string ending(const Result& r) {
  const std::size_t end = first_clause(r.reason);
  return text(r.converged ? "converged: " : "NOT CONVERGED: ", r.reason.substr(0, end), " (", r.method, ", ", r.iterations,
              r.iterations == 1 ? " iteration)" : " iterations)", r.reason.substr(end));
}

std::string doubt(const Result& r) {
  return r.converged ? "" : "not converged: " + r.reason.substr(0, first_clause(r.reason));
}

}  // namespace dotyk::solver
