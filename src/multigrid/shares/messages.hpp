// What ranks tell one another when slices are made.
#pragma once

#include <memory>
#include <vector>

#include "multigrid/rows/own_rows.hpp"
#include "multigrid/rows/slice.hpp"
#include "multigrid/shares/numbering.hpp"

namespace dotyk::multigrid {

void send(const Ranks& ranks, int to, const Lists& lists);
Lists receive_lists(const Ranks& ranks, int from);

/// Of entries of the lower triangle, by unknowns, those that a rank stores: it has the row or the column.
Entries entries_of(int rank, const algebra::Triplets& added, const Numbering& numbering);
void send(const Ranks& ranks, int to, const Entries& entries);
Entries receive_entries(const Ranks& ranks);  ///< from rank 0

/// Makes the slice of a rank other than 0, and tells rank 0 its diagonal and how many entries it has.
std::unique_ptr<Slice> told_slice(const Ranks& ranks, HalfRows rows, const std::vector<int>& idle, AllOwnFunctions functions, OwnLoad load = nullptr);

}  // namespace dotyk::multigrid
