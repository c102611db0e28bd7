#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "solver/feti/torn_problem.hpp"

namespace dotyk::solver {

/// The pieces sorted into kinds, in the order of their first members. Two are of one kind where one factor serves
/// both: same pattern of K, same unknowns at one node, entries that differ by at most 1e-12 of the lesser diagonal
/// entry of their row and column (a shift of a mesh leaves less), and kernels of the same span.
std::vector<std::vector<int>> equal_pieces(const std::vector<Piece>& pieces);

/// The kinds divided further: equal pieces that rows touch alike.
std::vector<std::vector<int>> alike_pieces(const std::vector<std::vector<int>>& kinds, const std::vector<Piece>& pieces);

/// Pieces of one kind that are treated together, each a column: a factor is read once for all of them.
struct Batch {
  int kind;
  std::vector<int> pieces;
};

/// Each kind's pieces in batches of about eight, the most work first. They do not depend on how many threads there
/// are, so that no result does.
std::vector<Batch> batches(const std::vector<std::vector<int>>& kinds, const std::vector<Piece>& pieces);

/// What a block of A (one a kind) makes of columns, in their place. Called by several threads at once.
using OnColumns = std::function<void(const Batch&, algebra::DenseMatrix& columns)>;

/// B̂WAWB̂ᵀλ, W = k⁻¹ (TornProblem): with A a stiffness a preconditioner of F, as B̂WB̂ᵀ = I but for rows of the problem
/// that share an unknown. Rows touch all pieces of a batch alike. Columns: the touched unknowns alone.
algebra::Vector through_touched(const TornProblem& torn, const std::vector<Batch>& batches,
                                const algebra::Vector& lambda, const OnColumns& A);

/// A f for all of f: copies → copies.
algebra::Vector on_pieces(const TornProblem& torn, const std::vector<Batch>& batches, const algebra::Vector& f,
                          const OnColumns& A);

/// Throws the InputError that K of a piece has more motions for kernel than said. `unknown`: where, or -1.
[[noreturn]] void refuse_singular(const Piece& piece, int unknown);

}  // namespace dotyk::solver
