#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algebra/direct/ordering.hpp"
#include "algebra/field.hpp"
#include "base/monitor.hpp"

namespace dotyk::algebra {

/// A⁻¹ b for symmetric positive definite matrices of one pattern, which differ in their numbers.
class SpdSolver {
 public:
  virtual ~SpdSolver() = default;
  /// Other numbers of entries of the lower triangle, no place twice; all other entries keep theirs. `held`, one flag an unknown: rows and columns of A that
  /// are empty but for their diagonal. False where A is seen not to be positive definite.
  virtual bool set(const Triplets& changed, const std::vector<char>& held) = 0;
  /// x with ‖b − A x‖ ≤ tolerance ‖b‖; direct solvers go as far as rounding lets them, whatever the tolerance. `left`, where it is given: b − A x, as
  /// iterations know it; direct solvers leave it as it is.
  virtual Vector solve(const Vector& b, double tolerance, Vector* left = nullptr) = 0;
  struct Solved {
    bool found = true;       ///< else x has no meaning
    bool left_told = false;  ///< is `left` set? It is b − A x, as iterations know it
  };
  /// solve() for vectors of one place. b may change meanwhile, and is restored unless this throws.
  virtual Solved solve_fields(Field& b, double tolerance, Field& x, Field& left) {
    Vector rest;
    const Vector solution = solve(b.get(), tolerance, &rest);
    x.put(solution);
    if (rest.size() > 0) left.put(rest);
    return {solution.allFinite(), rest.size() > 0};
  }
  /// fine = P coarse, where the solver has made the matrix of the next coarser mesh, and `coarse` lies with its slices. Else false.
  virtual bool interpolate(const Field& /*coarse*/, Field& /*fine*/) const { return false; }
  /// Does the work grow with the digits asked for?
  virtual bool iterates() const { return true; }
  virtual int iterations() const { return 0; }  ///< of all calls of solve() together, where it tells
  virtual int levels() const { return 0; }      ///< of a hierarchy of matrices, the given one included; 0 where there is none
  virtual double bytes() const = 0;        ///< of what it keeps beside A
  virtual std::string method() const = 0;  ///< "METIS", "conjugate gradients, …"
};

/// By a sparse Cholesky factor. `lower`, `node`, `ordering` as for Cholesky.
std::unique_ptr<SpdSolver> factored(const SparseMatrix& lower, const std::vector<int>& node, Ordering ordering);
/// By conjugate gradients, preconditioned by an incomplete Cholesky factor: as much memory as A, however many unknowns.
std::unique_ptr<SpdSolver> incompletely_factored(const SparseMatrix& lower, Monitor& monitor);

}  // namespace dotyk::algebra
