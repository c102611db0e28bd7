#pragma once

#include <optional>
#include <vector>

#include "algebra/dense/decompositions.hpp"
#include "base/monitor.hpp"
#include "problem/condensed.hpp"
#include "problem/problem.hpp"

namespace dotyk::shape {

/// A point of friction that slips along d = x_t/‖x_t‖.
struct Slip {
  int row;                   ///< the first of its rows
  algebra::Vector direction; ///< d, one component a row
};

/// How the multipliers of all rows follow the rows at a state: with one unknown y for each direction of multipliers that
/// is not settled by its law alone, and x' the derivative of Bu − c,
///   λ' = E y + Σ_p b'_p d_p,     Fᵀx' = C y   (weak contact: y ≥ 0, Fᵀx' ≤ C y, one of them an equality).
/// Strong contact, stick and other rows that are held: C = 0; springs: C = 1/k; slip in space: across d, C = ‖x_t‖/b;
/// Coulomb's slip: b' = F λ'_n, in E beside the normal row's unknown, so that E ≠ F. Open rows: no unknown.
struct LawDerivative {
  algebra::SparseMatrix E, F;  ///< rows × unknowns y
  algebra::Vector C;           ///< compliances, displacement per force
  std::vector<int> weak;       ///< unknowns y in weak contact
  std::vector<int> weak_row;   ///< their rows
  std::vector<Slip> slips;     ///< of points whose bound b' is given
  bool symmetric = true;       ///< E = F
  int size() const { return static_cast<int>(C.size()); }
};

/// `touching`: what counts as nothing, relative, as problem::Measure::nothing() says; of multipliers at least force_error, by which they may
/// be wrong, and of gaps and slip at least that over the row's stiffness. A row that touches with no force is in weak contact. So are rows of other laws at the end of what they can bear.
/// Throws InputError, naming the node, where force_error alone makes nothing of a force, gap or slip, where friction is about to slip or stick (‖λ_t‖ is the bound, the slip nothing; of
/// Coulomb's also weak contact), and where a spring with two stiffnesses bears nothing: the derivative is then not one of
/// a quadratic program.
LawDerivative law_derivative(const problem::Problem& problem, const problem::State& state, double touching, double force_error);

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
