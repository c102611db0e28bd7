#pragma once

#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// Contact mostly closes on a small part of the boundary where it may: rows that stay open need not be condensed. A problem is solved
/// on the rows that may close; the gaps of the others are looked at afterwards, and where one has closed its row joins, with those
/// that came nearly as near.
class NearRows {
 public:
  /// Unilateral rows that overlap, at rest or after free bodies have settled as if rigid (settled_overlap()), or are under `start`, and their friction.
  /// Rows of every other law are always among them. All rows where none overlaps, or where that would save little.
  NearRows(const problem::Problem& problem, const std::vector<char>& start);

  bool all() const { return rows_.size() == near_.size(); }
  int count() const { return static_cast<int>(rows_.size()); }
  /// The problem with the rows that may close, and without the others.
  problem::Problem restricted() const;
  std::vector<char> restricted(const std::vector<char>& flags) const;
  problem::State restricted(const problem::State& state) const;
  /// Makes a result of restricted() one of the whole problem: the rows left out are open and bear no force.
  void extend(Result& result) const;
  /// Lets rows join that have closed at this displacement; false where none has.
  bool join(const algebra::Vector& u);

 private:
  void take(std::vector<char> near);

  const problem::Problem& problem_;
  std::vector<char> near_;  ///< by row
  std::vector<int> rows_;   ///< those, ascending
};

}  // namespace dotyk::solver
