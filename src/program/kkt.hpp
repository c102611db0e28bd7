#pragma once

#include <vector>

#include "algebra/direct/quasi_definite.hpp"
#include "program/program.hpp"

namespace dotyk::program {

/// The KKT matrix of a program with some of its rows taken, regularised so that it is quasidefinite
/// whatever P, the rows and their dependence:
///   [P + δI   A_Wᵀ]
///   [A_W       −D ],  δ > 0, D > 0 diagonal; rows not taken become −y_r = ….
/// It plays the part of the modified Cholesky factorisation of algorithm 3.1 (Netuka, ODAM 2001,
/// (83)): a matrix that is safely regular is changed by δ ≪ its eigenvalues only, and the refinement of
/// refine() takes that change back. One symbolic analysis serves every choice of rows.
class Kkt {
 public:
  explicit Kkt(const QuadraticProgram& program);

  /// Factors with the rows of `taken` (m flags) and D (m). False where rounding has changed the number of
  /// negative pivots from m: δ and D are then too small for this matrix.
  bool factor(double delta, const Vector& D, const std::vector<char>& taken);
  /// z (n + m) with the regularised matrix times z = b.
  Vector solve(const Vector& b) const { return factor_.solve(b); }

  const QuadraticProgram& program() const { return *program_; }

 private:
  const QuadraticProgram* program_;
  SparseMatrix matrix_;  ///< lower triangle
  std::vector<int> diagonal_, row_entry_, row_of_;  ///< places in matrix_: diagonal (n + m), entries of A and their rows
  std::vector<int> P_entry_;                        ///< places of P's entries
  algebra::QuasiDefinite factor_;
};

/// [P A_Wᵀ; A_W 0] z for z (n + m); entries of rows not in W are zero.
Vector kkt_times(const QuadraticProgram& program, const std::vector<char>& taken, const Vector& z);

}  // namespace dotyk::program
