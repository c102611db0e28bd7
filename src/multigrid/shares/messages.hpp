// What ranks tell one another when slices are made.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "algebra/coarse_functions.hpp"
#include "multigrid/rows/own_functions.hpp"
#include "multigrid/rows/own_rows.hpp"
#include "multigrid/rows/slice.hpp"
#include "multigrid/shares/numbering.hpp"
#include "multigrid/shares/piece.hpp"

namespace dotyk::multigrid {

void send(const Ranks& ranks, int to, const Lists& lists);
Lists receive_lists(const Ranks& ranks, int from);

/// Of entries of the lower triangle, by unknowns, those that a rank stores: it has the row or the column.
Entries entries_of(int rank, const algebra::Triplets& added, const Numbering& numbering);
void send(const Ranks& ranks, int to, const Entries& entries);
Entries receive_entries(const Ranks& ranks);  ///< from rank 0

/// Makes the slice of a rank other than 0, and tells rank 0 its diagonal and how many entries it has.
std::unique_ptr<Slice> told_slice(const Ranks& ranks, HalfRows rows, const std::vector<int>& idle, AllOwnFunctions functions, OwnLoad load = nullptr);

/// Unknowns that are coupled strongly by a row that has become an unknown: of a jump between two bodies, one much stiffer than the other, or of a mean of
/// many displacements. The unknown of the row is among them.
std::set<int> sharing_unknowns(const Matrix& matrix);

/// For each rank what differs. `changed`, `held`: as in algebra::SpdSolver::set().
std::vector<Change> changes(const algebra::Triplets& changed, const std::vector<char>& held, const std::set<int>& sharing, const Numbering& numbering,
                            int ranks);

/// The rows of the functions of coarser meshes that a rank has.
AllOwnFunctions own_functions(const std::vector<algebra::CoarseFunctions>& functions, const Numbering& numbering, int rank);

}  // namespace dotyk::multigrid
