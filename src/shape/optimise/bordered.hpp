#pragma once

#include <optional>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/lu.hpp"
#include "problem/condensed.hpp"
#include "shape/derivative/law_derivative.hpp"

namespace dotyk::shape {

/// The rows' derivative on the condensed problem: with x' = x₀ − Wλ' + Nα, Nᵀλ' = e (see CondensedProblem) and a
/// LawDerivative, the unknowns y of equalities and the amounts α of rigid motion solve
///   [ FᵀWE + C   −FᵀN ] [y]   [ Fᵀ(x₀ − Wμ) ]
///   [ NᵀE          0  ] [α] = [ e − Nᵀμ     ],     μ = Σ b'_p d_p.
struct Bordered {
  algebra::DenseMatrix A;  ///< (y, α) × (y, α)
  int unknowns;            ///< y
  Bordered(const problem::CondensedProblem& condensed, const LawDerivative& law);
  /// With some of the unknowns y only, in their order; all of α.
  Bordered restricted(const std::vector<int>& kept) const;

 private:
  Bordered(algebra::DenseMatrix matrix, int count) : A(std::move(matrix)), unknowns(count) {}
};

/// A factor of such a matrix, its rows and columns scaled alike. Where the matrix is singular (two conditions on one
/// displacement) the least solution, if there is one.
class BorderedFactor {
 public:
  explicit BorderedFactor(const Bordered& bordered);
  /// Throws InputError where there is no solution.
  algebra::Vector solve(const algebra::Vector& b) const;
  /// Of the transposed matrix.
  algebra::Vector solve_transposed(const algebra::Vector& b) const;

 private:
  algebra::DenseMatrix A_;  ///< scaled
  algebra::Vector scale_;
  algebra::Lu lu_;
  std::optional<algebra::MinimumNorm> dependent_;
};

}  // namespace dotyk::shape
