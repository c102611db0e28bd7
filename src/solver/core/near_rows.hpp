#pragma once

#include "solver/core/row_subset.hpp"

namespace dotyk::solver {

/// Contact mostly closes on a small part of the boundary where it may: rows that stay open need not be condensed. A problem is solved
/// on the rows that may close; the gaps of the others are looked at afterwards, and where one has closed its row joins, with those
/// that came nearly as near.
class NearRows : public RowSubset {
 public:
  /// Unilateral rows that overlap, at rest or after free bodies have settled as if rigid (settled_overlap()), or are under `start`, and their friction.
  /// Rows of every other law are always among them. All rows where none overlaps, or where that would save little.
  NearRows(const problem::Problem& problem, const std::vector<char>& start);

  /// Lets rows join that have closed at this displacement; false where none has.
  bool join(const algebra::Vector& u);
};

}  // namespace dotyk::solver
