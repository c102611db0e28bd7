#pragma once

#include <optional>
#include <vector>

#include "problem/condensed.hpp"

namespace dotyk::solver {

/// The laws of a problem's rows as linear equations A z = b in columns z with bounds low ≤ z ≤ high, and pairs of columns of which one is at a
/// bound; see PieceSearch. Columns are scaled to length 1.
struct PieceProgramme {
  /// Complementarity: `column` is 0, or all `others` are 0 (with `at_high`: at their upper bounds).
  struct Pair {
    int column;
    std::vector<int> others;
    bool at_high = false;
  };

  /// Multipliers and amounts of rigid motion of a point.
  algebra::Vector lambda(const algebra::Vector& z) const;
  algebra::Vector alpha(const algebra::Vector& z) const;

  algebra::DenseMatrix A;
  algebra::SparseRows transposed;  ///< Aᵀ
  algebra::Vector b, low, high;
  std::vector<Pair> pairs;
  algebra::Vector root;                  ///< √ρ: v = λ/√ρ and √ρ x are in one unit
  algebra::DenseMatrix R;                ///< of √ρ N = Q R
  std::vector<algebra::Vector> forces;   ///< v, by column; empty: none
  algebra::Vector size;                  ///< of the columns before they were scaled
  std::vector<int> motions;              ///< columns
};

/// Every law tells its springs; see tells_springs(). Nothing where points of friction share a normal row.
std::optional<PieceProgramme> piece_programme(const problem::Problem& problem, const problem::CondensedProblem& condensed);

}  // namespace dotyk::solver
