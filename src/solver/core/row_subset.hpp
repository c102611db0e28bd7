#pragma once

#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// A problem on some of its rows, as if the others were not there, and its results as results of the whole problem. Scalar laws go by a row's number in its
/// group: where they differ by row, the group is kept whole.
class RowSubset {
 public:
  /// All rows, or those with a flag. The problem must outlive this.
  explicit RowSubset(const problem::Problem& problem) : RowSubset(problem, std::vector<char>(problem.rows(), 1)) {}
  RowSubset(const problem::Problem& problem, std::vector<char> kept) : problem_(problem) { take(std::move(kept)); }

  bool all() const { return rows_.size() == kept_.size(); }
  int count() const { return static_cast<int>(rows_.size()); }
  const std::vector<char>& kept() const { return kept_; }  ///< by row
  /// Where the rows of a part of this subset stand in restricted().
  std::vector<int> places(const std::vector<char>& part) const;
  problem::Problem restricted() const;
  std::vector<char> restricted(const std::vector<char>& flags) const;
  problem::State restricted(const problem::State& state) const;
  Beginning restricted(const Beginning& from) const;
  /// Makes a result of restricted() one of the whole problem: the rows left out are open and bear no force.
  void extend(Result& result) const;

 protected:
  const problem::Problem& problem() const { return problem_; }
  void take(std::vector<char> kept);

 private:
  const problem::Problem& problem_;
  std::vector<char> kept_;
  std::vector<int> rows_;  ///< those, ascending
};

}  // namespace dotyk::solver
