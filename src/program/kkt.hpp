#pragma once

#include <functional>
#include <vector>

#include "algebra/direct/indefinite.hpp"
#include "program/program.hpp"

namespace dotyk::program {

/// The KKT matrix of a program with some of its rows taken, regularised so that it is quasidefinite
/// whatever P, the rows and their dependence:
///   [P + δI   A_Wᵀ]
///   [A_W       −D ],  δ > 0, D > 0 diagonal; rows not taken become −y_r = ….
/// It plays the part of the modified Cholesky factorisation of algorithm 3.1 (Netuka, ODAM 2001,
/// (83)): a matrix that is safely regular is changed by δ ≪ its eigenvalues only, and refine() takes that change back.
/// One symbolic analysis serves every choice of rows.
class Kkt {
 public:
  explicit Kkt(const QuadraticProgram& program);

  /// Factors with the rows of `taken` (m flags) and D (m). False where rounding has changed the number of
  /// negative pivots from m: δ and D are then too small for this matrix.
  bool factor(double delta, const Vector& D, const std::vector<char>& taken);
  /// z (n + m) with the regularised matrix times z = b.
  Vector solve(const Vector& b) const { return factor_.solve(b); }

 private:
  const QuadraticProgram& program_;
  algebra::QuasiDefinite factor_;
};

/// [P A_Wᵀ; A_W 0] z for z (n + m); entries of rows not in W are zero.
Vector kkt_times(const QuadraticProgram& program, const std::vector<char>& taken, const Vector& z);

struct Refined {
  Vector z;         ///< the best found
  Vector residual;  ///< b − K z
};

using Apply = std::function<Vector(const Vector&)>;

/// Iterative refinement of K z = b, until no entry of the residual exceeds `target`, with at most so many solves of a
/// regularised, nearby matrix, accelerated by GMRES (Saad and Schultz 1986; for refinement with a regularised factor
/// Arioli, Duff, Gratton and Pralet 2007). A consistent singular system is solved; for an inconsistent symmetric one the
/// residual tends to the part of b in K's kernel.
Refined refine(const Apply& K, const Apply& regularised, const Vector& b, double target, int most_steps);

}  // namespace dotyk::program
