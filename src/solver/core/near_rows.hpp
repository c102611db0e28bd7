#pragma once

#include "solver/core/row_subset.hpp"

namespace dotyk::solver {

/// One flag a row: unilateral rows that overlap, at rest or after free bodies have settled as if rigid (settled_overlap()), and their friction; rows of every
/// other law are always among them. Empty where none overlaps, or where leaving rows out would save little.
std::vector<char> rows_that_may_close(const problem::Problem& problem);

/// Contact mostly closes on a small part of the boundary where it may: rows that stay open need not be condensed. A problem is solved
/// on the rows that may close; the gaps of the others are looked at afterwards, and where one has closed its row joins, with those
/// that came nearly as near.
class NearRows : public RowSubset {
 public:
  /// The rows `near`, as rows_that_may_close() has them, and those under `start`, which may be empty, with their friction.
  NearRows(const problem::Problem& problem, std::vector<char> near, const std::vector<char>& start);

  /// Lets rows join that have closed at this displacement; false where none has.
  bool join(const algebra::Vector& u);
};

}  // namespace dotyk::solver
