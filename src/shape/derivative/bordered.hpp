#pragma once

#include <optional>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/lu.hpp"
#include "base/monitor.hpp"
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

/// P7 (16)–(17) on the rows, its dual: minimise ½yᵀHy − gᵀy subject to Gy = e and y ≥ 0 in weak contact, with H = FᵀWE + C
/// and G = NᵀE symmetric and semidefinite, (g, e) the right side `b` of Bordered. Returns the unknowns y that are not 0 by
/// their bound: all but those in weak contact that open.
/// Throws InputError where a motion that no row stops would grow at once: the solution then has no derivative.
std::vector<int> closing(const Bordered& bordered, const std::vector<int>& weak, const algebra::Vector& b, Monitor& monitor);

/// Are weak contact's signs right at (y, α)? Throws std::runtime_error where they are not, up to rounding.
void require_complementary(const Bordered& bordered, const std::vector<int>& weak, const algebra::Vector& b, const algebra::Vector& solved);

}  // namespace dotyk::shape
