#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "algebra/direct/ordering.hpp"
#include "algebra/types.hpp"

struct cholmod_factor_struct;

namespace dotyk::algebra {

/// The forward sweep Y = L⁻¹ P Bᵀ with a supernodal factor A = Pᵀ L Lᵀ P, for sparse rows B (rows × unknowns). Y is zero but where the elimination tree
/// leads from an unknown of B up to the root (Davis 2006 §3.2): there alone it is made.
class ReachedSweep {
 public:
  /// `factor` and `rows` must outlive this object. `also`: further positions in the factor's order that count as reached.
  ReachedSweep(const cholmod_factor_struct& factor, const SparseRows& rows, const std::vector<int>& also);

  Eigen::Index rows() const { return rows_.rows(); }
  double flops() const { return 2.0 * entries_ * static_cast<double>(rows()); }
  double bytes() const { return 8.0 * static_cast<double>(positions_.size()) * static_cast<double>(rows()); }
  /// Where Y may differ from zero, ascending.
  const std::vector<int>& positions() const { return positions_; }
  /// Y there: positions × rows.
  DenseMatrix values() const;

 private:
  const cholmod_factor_struct& factor_;
  const SparseRows& rows_;
  std::vector<int> supernodes_, positions_;  ///< reached, ascending
  std::vector<int> place_;                   ///< of a position among positions_, or -1
  double entries_ = 0;                       ///< of L, in the columns that are reached
};

/// Lower triangles: the matrix with entry(i, j) added at (unknowns[i], unknowns[j]), i ≥ j. `unknowns`: ascending.
SparseMatrix with_block(const SparseMatrix& lower, const std::vector<int>& unknowns, const std::function<double(int i, int j)>& entry);

/// Sparse Cholesky factorisation A = Pᵀ L Lᵀ P of a symmetric positive definite matrix, with an optional set Γ of unknowns eliminated
/// last. The trailing block L_Γ of the factor then gives the Schur complement onto Γ, S = A_ΓΓ − A_ΓI A_II⁻¹ A_IΓ = L_Γ L_Γᵀ, and one
/// forward and one backward sweep around a problem on Γ solve the whole.
class Cholesky {
 public:
  /// Orders and analyses. `lower`: lower triangle; `node`, `last` as in order(). `full_boundary`: what is factored will have
  /// entries between all unknowns of Γ (with_block()), which the ordering need not see.
  Cholesky(const SparseMatrix& lower, const std::vector<int>& node, const std::vector<int>& last,
           Ordering ordering = Ordering::automatic, bool full_boundary = false);
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;
  Cholesky& operator=(Cholesky&&) noexcept;

  /// Factors a matrix of the analysed pattern. False where it is not positive
  /// definite to working precision; failed_unknown() then tells where.
  bool factor(const SparseMatrix& lower);
  /// The unknown whose pivot was not positive, or -1.
  int failed_unknown() const;

  /// The squares of L's diagonal, one an unknown: what was left of A's diagonal when the unknown's turn came.
  Vector pivots() const;

  /// A⁻¹ b for every column of b. Like the sweeps below it may be called by several threads at once.
  DenseMatrix solve(const DenseMatrix& b) const;

  /// Γ: unknown of each row of the condensed quantities below, in the factor's order.
  const std::vector<int>& boundary() const;
  /// L_Γ, lower triangular, |Γ| × |Γ|.
  DenseMatrix boundary_factor() const;

  /// The forward sweep L y = P b. Kept whole; its Γ part is L_Γ⁻¹ times the condensed right-hand side.
  Vector forward(const Vector& b) const;
  /// Γ part of a swept vector, and its replacement.
  Vector boundary_part(const Vector& swept) const;
  void set_boundary_part(Vector& swept, const Vector& part) const;
  /// The backward sweep: x with Lᵀ P x = y.
  Vector backward(const Vector& swept) const;

  /// The forward sweep L⁻¹ P Bᵀ of sparse rows B, at the positions that B reaches and on Γ. B and this factor must outlive the result.
  ReachedSweep sweep(const SparseRows& rows) const;
  /// The rows of the sweep's values that belong to Γ, in boundary() order.
  DenseMatrix boundary_part(const ReachedSweep& sweep, const DenseMatrix& values) const;

  double flops() const;              ///< predicted by the ordering
  double bytes() const;              ///< of the factor's numbers
  static constexpr double kMostBytes = 8 * 2147483647.0;  ///< for as many as CHOLMOD's indices of 32 bits reach, whatever the memory
  const std::string& method() const; ///< of the ordering

 private:
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

}  // namespace dotyk::algebra
