#pragma once

#include <vector>

#include "problem/condensed.hpp"

namespace dotyk::solver {

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
    std::vector<char> closed;        ///< scalar rows with slope > 0
    std::vector<char> slipping;      ///< rows of friction points that are closed and slip
    std::vector<char> piece;         ///< row by row: 0 open, 1 closed or stick, 2 slip
    int active = 0, stick = 0, slip = 0;
    int differences(const Value& other) const;
  };
  Value at(const algebra::Vector& lambda, const algebra::Vector& alpha) const;
  /// The pieces with every row that touches at rest closed and sticking (or those flagged).
  Value sticking(const std::vector<char>& start) const;

  /// The Newton system on the rows with a slope (the others have λ' = projected), and α.
  struct System {
    algebra::DenseMatrix matrix;
    algebra::Vector right_side;
    std::vector<int> rows;           ///< of the unknowns λ'
    algebra::Vector fixed;           ///< λ' of the other rows (0 on `rows`)
  };
  System linearise(const Value& v) const;
  void take(const System& system, const algebra::Vector& solved, algebra::Vector& lambda,
            algebra::Vector& alpha) const;

  const algebra::Vector& rho() const { return rho_; }

 private:
  const problem::Problem& problem_;
  const problem::CondensedProblem& condensed_;
  algebra::Vector rho_;
};

}  // namespace dotyk::solver
