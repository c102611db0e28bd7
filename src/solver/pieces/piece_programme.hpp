#pragma once

#include <utility>
#include <vector>

#include "problem/condensed.hpp"

namespace dotyk::solver {

/// The laws of a problem's rows as linear equations A z = b in columns z with bounds low ≤ z ≤ high, and pairs of columns of which one is at a
/// bound; see PieceSearch. Columns are scaled to length 1.
class PieceProgramme {
 public:
  /// Complementarity: `column` is 0, or all `others` are 0 (with `at_high`: at their upper bounds).
  struct Pair {
    int column;
    std::vector<int> others;
    bool at_high = false;
  };

  /// Every law tells its springs; see tells_springs().
  PieceProgramme(const problem::Problem& problem, const problem::CondensedProblem& condensed);

  /// False where points of friction share a normal row.
  bool treatable() const { return treatable_; }
  const algebra::DenseMatrix& A() const { return A_; }
  const algebra::SparseRows& transposed() const { return transposed_; }  ///< Aᵀ
  const algebra::Vector& b() const { return b_; }
  const std::vector<Pair>& pairs() const { return pairs_; }
  algebra::Vector low() const { return bounds(low_).cwiseMax(-most()); }
  algebra::Vector high() const { return bounds(high_).cwiseMin(most()); }

  /// Multipliers and amounts of rigid motion of a point.
  algebra::Vector lambda(const algebra::Vector& z) const;
  algebra::Vector alpha(const algebra::Vector& z) const;

 private:
  int add_column(algebra::Vector v, algebra::Vector displaces, double low, double high);
  algebra::Vector bounds(const std::vector<double>& of) const;
  algebra::Vector unit(int row, double value = 1) const;
  double most() const;
  void add(const problem::Law& law, int index, int r);
  void add(const problem::FrictionGroup& group, std::vector<char>& rubs);
  void add_cone(const problem::FrictionGroup& group, int k, double mu, std::vector<char>& rubs);
  int add_edge(int n, const std::vector<int>& rows, const std::vector<double>& tangent);
  std::vector<int> add_polygon(int n, int t, double mu);
  void add_given(const problem::FrictionGroup& group, int k, double bound);
  std::pair<int, int> slip(int t, int against_ahead, int against_back);
  void assemble();

  const problem::Problem& problem_;
  const problem::CondensedProblem& condensed_;
  const algebra::Vector root_;          ///< √ρ: v = λ/√ρ and √ρ x are in one unit
  std::vector<char> stated_;            ///< rows whose equation is asked for
  algebra::DenseMatrix Q_, R_;          ///< of √ρ N
  std::vector<algebra::Vector> forces_, displaces_;  ///< by column; empty: none
  std::vector<double> low_, high_;
  std::vector<int> motions_;
  std::vector<Pair> pairs_;
  double yields_ = 1;                   ///< of springs against what a row sees, the greatest
  bool treatable_ = true;
  algebra::DenseMatrix A_;
  algebra::SparseRows transposed_;
  algebra::Vector b_, size_;
};

}  // namespace dotyk::solver
