#pragma once

#include <vector>

#include "algebra/direct/cholesky.hpp"
#include "algebra/types.hpp"

namespace dotyk::algebra {

/// Unknowns outside Γ (`unknowns`) to add to it where a motion of the kernel moves the body more than ten times as far as Γ, as a rotation about a small
/// contact part does: digits would be lost. Motions that vanish on Γ vanish on them, so that Γ feels no more motions than before. Chosen by
/// fixing_unknowns(), mostly none. `kernel`: as for Condensation.
std::vector<int> far_unknowns(const DenseMatrix& kernel, const std::vector<int>& unknowns);

/// A symmetric positive semidefinite K condensed onto unknowns Γ: the Schur complement S from the trailing block of one
/// factor, and what is needed to work with it. A kernel R of K (rigid modes) is allowed: with R̂ an orthonormal basis of R on Γ, K + τ R̂R̂ᵀ is factored, so that
/// M = S + τ R̂R̂ᵀ = L_Γ L_Γᵀ is positive definite and M⁻¹ a generalised inverse of S. Motions in the kernel that vanish on Γ
/// are held by a diagonal added at as many well-chosen unknowns (fixing_unknowns): it carries nothing for loads in
/// equilibrium, so S is as it would be.
class Condensation {
 public:
  /// Orders and analyses. `node`, `last`: groups of unknowns, and which of them are Γ, see order(). `kernel`: K.rows() × modes.
  Condensation(const SparseMatrix& K, const std::vector<int>& node, const std::vector<int>& last,
               const DenseMatrix& kernel, Ordering ordering = Ordering::automatic);

  /// Factors. False where K is not positive definite apart from its kernel;
  /// failed_unknown() then tells an unknown that is not held (-1: none in particular).
  bool factor(const SparseMatrix& K);
  int failed_unknown() const { return factor_.failed_unknown(); }

  const std::vector<int>& boundary() const { return factor_.boundary(); }  ///< unknowns of Γ
  int kernel_size() const { return static_cast<int>(kernel_.cols()); }
  /// R restricted to Γ, |Γ| × modes, in the basis given.
  const DenseMatrix& boundary_kernel() const { return kernel_; }

  /// Sweeps f down to Γ and returns the condensed load f_Γ − K_ΓI K_II⁻¹ f_I.
  Vector condense(const Vector& f);
  /// S on Γ, semidefinite with a kernel.
  DenseMatrix schur() const;
  /// M⁻¹ b, b on Γ (S⁻¹ b without a kernel).
  Vector solve(const Vector& b) const;
  /// X = L_Γ⁻¹ Bᵀ for a sparse B (rows × |Γ|, columns in boundary() order), so that XᵀX = B M⁻¹ Bᵀ.
  DenseMatrix half_compliance(const SparseRows& B) const;
  /// What further rows C on all unknowns add to W. K⁻¹ is a generalised inverse if there is a kernel.
  struct Further {
    DenseMatrix compliance;   ///< C K⁻¹ Cᵀ
    DenseMatrix on_boundary;  ///< K⁻¹ Cᵀ on Γ
  };
  /// `sweep`: of C, with cholesky().
  Further further(const ReachedSweep& sweep) const;
  /// Whether rigid motions move such rows much further than they move Γ. Then the rigid part of K⁻¹ Cᵀ is large, and digits are lost when it cancels.
  /// `kernel`: the one given to the constructor.
  bool are_far(const SparseRows& rows, const DenseMatrix& kernel) const;
  /// The whole u from u_Γ, for the f of the last condense(): one backward sweep.
  Vector recover(const Vector& boundary_values) const;

  /// The displacement under other forces f (of a generalised inverse where there is a kernel), to which the one is added that has the values
  /// `added` on Γ and no forces off it: one forward and one backward sweep.
  Vector response(const Vector& f, const Vector& added) const;

  const Cholesky& cholesky() const { return factor_; }

 private:
  Vector from_boundary(Vector swept, const Vector& boundary_values) const;

  Cholesky factor_;
  std::vector<int> pinned_;   ///< unknowns off Γ that hold the motions vanishing on Γ
  DenseMatrix kernel_;        ///< R on Γ
  DenseMatrix basis_;         ///< R̂ = R V
  DenseMatrix felt_;          ///< V
  DenseMatrix unfelt_;        ///< combinations of R that vanish on Γ
  double tau_ = 0;
  DenseMatrix l_gamma_;       ///< L_Γ, of M
  Vector swept_;
};

}  // namespace dotyk::algebra
