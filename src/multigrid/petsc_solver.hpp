// Conjugate gradients with a V-cycle over a hierarchy.
#pragma once

#include "multigrid/door.hpp"
#include "multigrid/finest_smoother.hpp"
#include "multigrid/hierarchy.hpp"

namespace dotyk::multigrid {

class PetscSolver {
 public:
  explicit PetscSolver(const Matrix& matrix);

  bool set(const algebra::SparseMatrix& lower, const std::vector<char>& held);
  Outcome solve(const double* b, double tolerance, double* x, const Watcher& watcher);
  Facts facts() const;

 private:
  void make_cycle();

  Hierarchy hierarchy_;
  FinestSmoother finest_;
  OwnedKsp ksp_;
  OwnedVec b_, x_;
  int iterations_ = 0;
};

}  // namespace dotyk::multigrid
