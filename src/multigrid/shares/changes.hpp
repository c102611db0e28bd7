// What each process is told of a new matrix.
#pragma once

#include <set>
#include <vector>

#include "multigrid/shares/piece.hpp"

namespace dotyk::multigrid {

/// Unknowns that are coupled strongly by a row that has become an unknown: of a jump between two bodies, one much stiffer than the other, or of a mean of
/// many displacements. The unknown of the row is among them.
std::set<int> sharing_unknowns(const Matrix& matrix);

/// For each rank what differs. `changed`, `held`: as in algebra::SpdSolver::set().
std::vector<Change> changes(const algebra::Triplets& changed, const std::vector<char>& held, const std::set<int>& sharing, const Numbering& numbering,
                            int ranks);

}  // namespace dotyk::multigrid
