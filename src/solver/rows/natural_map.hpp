#pragma once

#include <vector>

#include "algebra/dense/decompositions.hpp"
#include "problem/condensed.hpp"

namespace dotyk::solver {

/// Multipliers of all rows, and amounts of rigid motions.
struct Iterate {
  algebra::Vector lambda, alpha;
  bool finite() const { return lambda.allFinite() && alpha.allFinite(); }
  friend Iterate operator+(const Iterate& a, const Iterate& b) { return {a.lambda + b.lambda, a.alpha + b.alpha}; }
  friend Iterate operator-(const Iterate& a, const Iterate& b) { return {a.lambda - b.lambda, a.alpha - b.alpha}; }
  friend Iterate operator*(double s, const Iterate& a) { return {s * a.lambda, s * a.alpha}; }
};

/// F(λ, α) = (λ_n − P(y_n), λ_t − π_b(y_t)), y = λ + ρx, on a condensed problem, and its generalised
/// derivative.
class NaturalMap {
 public:
  NaturalMap(const problem::Problem& problem, const problem::CondensedProblem& condensed,
             const algebra::Vector& rho);  ///< a friction point takes its normal row's ρ throughout

  /// F with what its pieces are at (λ, α).
  struct Value {
    algebra::Vector projected;       ///< P(y), π_b(y): F = λ − projected
    algebra::Vector y, x;            ///< x = x₀ − Wλ + Nα
    /// ∂projected/∂y, row by row: entries (row, column, value) on rows of one node only.
    std::vector<Eigen::Triplet<double>> slope;
    double norm = 0;                 ///< of F and of e − Nᵀλ
    double scaled_norm = 0;          ///< of D^{-1/2} F
    algebra::Vector unbalanced;      ///< of λ, scaled
    std::vector<char> closed;        ///< scalar rows with slope > 0
    std::vector<char> slipping;      ///< rows of friction points that are closed and slip
    std::vector<char> piece;         ///< row by row: 0 open, 1 closed or stick, 2 slip
    Iterate from;                    ///< (λ, α); empty: 0
    int active = 0, stick = 0, slip = 0;
    int differences(const Value& other) const;
  };
  Value at(const algebra::Vector& lambda, const algebra::Vector& alpha) const { return with_jump({lambda, alpha}, condensed_->jump(lambda, alpha)); }
  Value at(const Iterate& it) const { return at(it.lambda, it.alpha); }
  /// The same where the jump is x, known better than the condensed problem does.
  Value with_jump(const Iterate& from, algebra::Vector x) const;
  /// The pieces with every row that touches at rest closed and sticking (or those flagged).
  Value sticking(const std::vector<char>& start) const;

  /// Unknowns in one unit, the root of an energy: v = D^{-1/2} λ, a = Rα, where D = diag ρ and D^{1/2}N = QR
  /// with orthonormal columns of Q. A friction point has one ρ, so that D commutes with ∂P.
  algebra::Vector scaled_lambda(const algebra::Vector& lambda) const { return lambda.cwiseQuotient(root_); }
  algebra::Vector lambda(const algebra::Vector& v) const { return v.cwiseProduct(root_); }
  algebra::Vector scaled_alpha(const algebra::Vector& alpha) const;
  algebra::Vector alpha(const algebra::Vector& a) const;
  /// R^{-T}(e − Nᵀλ), in the same unit.
  algebra::Vector unbalanced(const algebra::Vector& lambda) const;
  /// The forces on the rows, the least ones in D^{-1}, that would put such a lack of balance right.
  algebra::Vector balancing(const algebra::Vector& unbalanced) const;
  /// Not less than the greatest eigenvalue of W̃ + QQᵀ, W̃ = D^{1/2} W D^{1/2}.
  double greatest_compliance() const;

  /// The Newton system in the changes of (v, a) from where the value was taken, on the rows with a slope; the others have λ' = projected, rows of the identity:
  ///   [ I − S(I − W̃)  −SQ ]
  ///   [ Qᵀ              0  ],   S = ∂projected/∂y,  W̃ = D^{1/2} W D^{1/2}.
  struct System {
    algebra::DenseMatrix matrix;
    algebra::Vector right_side;
    std::vector<int> rows;           ///< of the unknowns v
    algebra::Vector fixed;           ///< changes of the other rows' λ (0 on `rows`)
    Iterate from;
    algebra::Vector motion;          ///< a there
    /// Holds motions by springs: δ(a − a₀) is added to the equations of equilibrium.
    void hold(double spring, const algebra::Vector& anchor);
  };
  System linearise(const Value& v) const;
  /// (λ', α') of a solution of the system; without one, of that by LU.
  Iterate take(const System& system, const algebra::Vector& solved) const;
  Iterate solve(const System& system) const { return take(system, algebra::Lu(system.matrix).solve(system.right_side)); }
  /// The solution by an LU factorisation of the system's matrix G, of which `least` = 1/‖G⁻¹‖₁ is an estimate. Where G is singular, as where two
  /// contacts stick at one node: the least-squares solution of least norm, or NaN where the matrix is too large for that.
  static algebra::Vector solved(const System& system, const algebra::Lu& lu, double least);
  static bool singular(double least) { return !(least > 1e-12); }

  const algebra::Vector& rho() const { return rho_; }

 private:
  const problem::Problem* problem_;
  const problem::CondensedProblem* condensed_;
  algebra::Vector rho_, root_;  ///< ρ, √ρ
  algebra::DenseMatrix Q_, R_;
};

}  // namespace dotyk::solver
