#pragma once

#include <optional>
#include <vector>

#include "algebra/direct/quasi_definite.hpp"

namespace dotyk::thermoelastic {

/// A symmetric quasidefinite system A x = b with the unknowns off Γ eliminated, once for many b:
///   S = A_ΓΓ − A_ΓI A_II⁻¹ A_IΓ,   S x_Γ = g,   x_I = A_II⁻¹ b_I + W x_Γ,   W = −A_II⁻¹ A_IΓ,   g = b_Γ + Wᵀ b_I.
class Condensation {
 public:
  /// `lower`: A's lower triangle; A_II must be regular.
  Condensation(const algebra::SparseMatrix& lower, std::vector<int> gamma);
  const std::vector<int>& gamma() const { return gamma_; }
  const algebra::DenseMatrix& schur() const { return S_; }
  algebra::Vector condensed(const algebra::Vector& b) const;
  algebra::Vector recovered(const algebra::Vector& b, const algebra::Vector& on_gamma) const;

 private:
  std::vector<int> gamma_, inner_;
  std::optional<algebra::QuasiDefinite> factor_;  ///< of A_II
  algebra::DenseMatrix W_, S_;
};

}  // namespace dotyk::thermoelastic
