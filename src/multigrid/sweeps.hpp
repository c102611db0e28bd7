// Sweeps of Gauss and Seidel.
#pragma once

#include <vector>

#include "multigrid/half_matrix.hpp"

namespace dotyk::multigrid {

/// Relaxed sweeps over the rows of each rank, which take the values that other ranks had before. They need a matrix roughly: they read it in single precision,
/// as their time is that of reading it. Its numbers stay those of a symmetric matrix, so that a forward sweep before the coarse correction and a
/// backward one after it make a symmetric cycle. Vectors: of own rows. All functions are collective, except bytes().
class Sweeps {
 public:
  /// `A` must outlive this.
  explicit Sweeps(HalfMatrix& A) : A_(A) {}

  /// Takes the numbers of A, and the relaxation ω.
  void set(double omega);
  /// x = M⁻¹ b where M is a sweep, and left = b − A x, which costs nothing beside it. `left` may be `b`.
  void forward(const double* b, double* x, double* left);
  /// x += M⁻ᵀ (b − A x).
  void backward(const double* b, double* x);
  double bytes() const { return 4.0 * static_cast<double>(below_.size() + diagonal_.size() + inverse_.size()); }

 private:
  HalfBlocks<float> half() const;

  HalfMatrix& A_;
  double scale_ = 1;  ///< of the numbers over those of A: a power of two that brings them to about 1, within the range of floats
  std::vector<float> below_, diagonal_;
  std::vector<float> inverse_;  ///< ω / D, by rows
};

/// The relaxation factor ω of such sweeps; 1 on one rank. A = A_local + A_between, where A_between couples rows of different ranks, and D is the diagonal of A.
/// The matrix M of a sweep satisfies M + Mᵀ − A = (2/ω − 1) D − A_between. If this is positive definite, the sweep converges and a V-cycle of it is positive
/// definite (Baker, Falgout, Kolev and Yang, SIAM J. Sci. Comput. 33 (2011), §4). So ω = min(1, 2/(1 + c)) where c is the greatest eigenvalue of
/// D^−1/2 A_between D^−1/2, by Lanczos and 3 % more. c is below 1 if pieces are large, and up to 3.3 if most rows of a rank are coupled to rows of others.
/// `solved`: rows of this rank, counted from its first, ascending, that are solved exactly as well; they are left out of the eigenvalue problem.
/// Collective.
double damping(HalfMatrix& A, const std::vector<int>& solved = {});

}  // namespace dotyk::multigrid
