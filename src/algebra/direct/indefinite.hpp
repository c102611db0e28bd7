#pragma once

#include <memory>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// Sparse LU of a square, possibly indefinite matrix (both triangles stored), by UMFPACK.
class SparseLu {
 public:
  /// `a` must live as long.
  explicit SparseLu(const SparseMatrix& a);

  /// The matrix is singular to working precision.
  bool singular() const { return singular_; }
  Vector solve(const Vector& b) const;

 private:
  const SparseMatrix& a_;
  std::shared_ptr<void> numeric_;  ///< UMFPACK's factors
  bool singular_ = false;
};

/// Sparse factorisation A = Qᵀ L D Lᵀ Q (Q a permutation by AMD, D diagonal) of a symmetric matrix
/// that need not be positive definite. It is stable, whatever the order, for a quasidefinite matrix
/// [H Gᵀ; G −F] with H and F positive definite (Vanderbei 1995), and says by the signs of D how many
/// negative eigenvalues A has (Sylvester).
class QuasiDefinite {
 public:
  /// Orders and analyses the pattern of a lower triangle.
  explicit QuasiDefinite(const SparseMatrix& lower);
  ~QuasiDefinite();
  QuasiDefinite(QuasiDefinite&&) noexcept;
  QuasiDefinite& operator=(QuasiDefinite&&) noexcept;

  /// Factors a matrix of the analysed pattern; false where a pivot is zero or not a number.
  bool factor(const SparseMatrix& lower);
  /// A⁻¹ b.
  Vector solve(const Vector& b) const;
  /// How many entries of D are negative.
  int negative_pivots() const;
  /// A vector v with vᵀAv = the first negative entry of D; empty without one.
  Vector negative_direction() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

}  // namespace dotyk::algebra
