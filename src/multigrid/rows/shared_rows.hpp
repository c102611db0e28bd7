// What sweeps do not smooth on the finest level.
#pragma once

#include <vector>

#include "multigrid/rows/half_matrix.hpp"
#include "multigrid/rows/local_rows.hpp"

namespace dotyk::multigrid {

/// Solves exactly, by CHOLMOD, at unknowns of a stiff and a soft body that a row couples. There sweeps alone would be as many times slower as the root of the
/// contrast (on elements of order 2, whose rows are means, seven times). Before the coarse correction it follows the sweep,
/// after it it comes first, so that the cycle is symmetric. All functions are collective, except any().
class SharedRows {
 public:
  /// Takes the numbers of `matrix` at rows of this rank, counted from its first, ascending; there may be none. False where they are not definite.
  bool set(const HalfMatrix& matrix, const std::vector<int>& shared);
  bool any() const { return any_; }  ///< on any rank
  /// Changes x at the shared unknowns so that b − A x is zero there.
  void solve(Vec b, Vec x);

 private:
  bool any_ = false;
  std::vector<int> shared_;
  OwnedMat rows_, block_;    ///< of the matrix, at the shared unknowns
  OwnedKsp exact_;
  OwnedVec left_, change_;
};

/// Makes `ksp` solve with a sparse matrix that is small enough for a factor, on every rank the same one. Collective.
void factor_on_each(KSP ksp, Mat matrix, MatFactorShiftType shift, MatSolverType library);

/// Makes the factors that `ksp` needs. False where a matrix is not positive definite. Collective; may be false on some ranks only.
bool set_up(KSP ksp);

}  // namespace dotyk::multigrid
