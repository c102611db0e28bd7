#pragma once

#include <vector>

#include "solver/feti/torn_problem.hpp"

namespace dotyk::solver {

/// The pieces sorted into kinds, in the order of their first members. Two are of one kind where one factor serves
/// both: same pattern of K, same unknowns at one node, entries that differ by at most 1e-12 of the lesser diagonal
/// entry of their row and column (a shift of a mesh leaves less), and kernels of the same span.
std::vector<std::vector<int>> equal_pieces(const std::vector<Piece>& pieces);

/// The kinds divided further: equal pieces that rows touch alike.
std::vector<std::vector<int>> alike_pieces(const std::vector<std::vector<int>>& kinds, const std::vector<Piece>& pieces);

}  // namespace dotyk::solver
