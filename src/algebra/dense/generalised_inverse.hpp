#pragma once

#include <vector>

#include "algebra/direct/cholesky.hpp"
#include "algebra/symmetric_matrix.hpp"

namespace dotyk::algebra {

/// Unknowns F that hold a kernel when they are fixed, one for each of its d columns: pivoted QR on the
/// transpose of an orthonormal basis of R takes, one after another, the unknown that moves most in
/// the motions still free; exchanges then make |det R_F| as great as no single exchange could by a
/// tenth, so that |R R_F⁻¹| ≤ 1.1 in each entry and GeneralisedInverse::regularity() is at least
/// 1/√(1 + 1.21 d (n − d)) for n unknowns. For rigid modes F lies far apart; in space three nodes not
/// in a line. `kernel`: n × d, linearly independent columns. The choice depends on its span alone.
std::vector<int> fixing_unknowns(const DenseMatrix& kernel);
/// Of every piece of it, see pieces().
std::vector<int> fixing_unknowns(const SparseMatrix& kernel);

/// How far K R is from zero: for each column r of R the greatest |K r|_i / Σ_j |K_ij|, relative to r's
/// greatest entry. Row by row, so that soft parts of a body count as stiff ones do. Rounding leaves a few
/// 1e-16 for rigid modes; one product with K a column.
Vector kernel_residual(const SymmetricMatrix& K, const DenseMatrix& R);

/// K with the rows and columns of the unknowns emptied but for their diagonal entries, which become K's greatest (1 where
/// that is zero): these unknowns then neither move nor act. The pattern stays.
SparseMatrix hold(SparseMatrix lower, const std::vector<int>& unknowns);

/// A generalised inverse K⁺ of a symmetric positive semidefinite K with known kernel R (P2): with as
/// many unknowns F fixed as R has columns, R_F regular, the rest K_JJ is positive definite, and
///   K⁺ = [K_JJ⁻¹ on J, 0 on F],     K K⁺ K = K,   K K⁺ f = f for every f ⟂ R.
/// K⁺ is symmetric and reflexive; it differs from the Moore–Penrose inverse K† by the kernel,
///   K† = P K⁺ P,  P = I − R̂R̂ᵀ,     ‖K⁺‖ ≤ ‖K†‖ / regularity²
/// (K⁺ = E K† Eᵀ with E the projection along R onto u_F = 0, whose norm is 1/regularity).
class GeneralisedInverse {
 public:
  /// Orders and analyses. `lower`, `node`, `ordering` as for Cholesky; `fixed`: F. Throws InputError
  /// where fixing F leaves a motion of R free.
  GeneralisedInverse(const SparseMatrix& lower, const std::vector<int>& node, const DenseMatrix& kernel,
                     std::vector<int> fixed, Ordering ordering = Ordering::automatic);
  /// With F = fixing_unknowns(kernel).
  GeneralisedInverse(const SparseMatrix& lower, const std::vector<int>& node, const DenseMatrix& kernel,
                     Ordering ordering = Ordering::automatic);

  /// Factors K_JJ. False where it is not positive definite to working precision: K's kernel is then
  /// more than R; failed_unknown() tells where (-1: nowhere in particular).
  bool factor(const SparseMatrix& lower);
  int failed_unknown() const { return factor_.failed_unknown(); }

  /// K⁺ f for every column of f; zero on F. Several threads may call it at once.
  DenseMatrix apply(const DenseMatrix& f) const;

  const std::vector<int>& fixed() const { return fixed_; }
  /// Least singular value of R̂_F, R̂ an orthonormal basis of R: 1 at best, 0 where F does not hold R.
  double regularity() const { return regularity_; }
  /// R̂, an orthonormal basis of R.
  const DenseMatrix& basis() const { return basis_; }
  const Cholesky& cholesky() const { return factor_; }

 private:
  std::vector<int> fixed_;
  DenseMatrix basis_;  ///< R̂
  double regularity_;
  Cholesky factor_;
};

}  // namespace dotyk::algebra
