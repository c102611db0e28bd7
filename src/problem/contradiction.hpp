#pragma once

#include <optional>

#include "problem/problem.hpp"

namespace dotyk::problem {

/// Rows that no displacement satisfies together.
struct Contradiction {
  int row;     ///< one that pushes most, one-sided where there is one
  double by;   ///< a displacement: how far it is violated where all others hold
  std::vector<int> others;  ///< the one that counts most first
};

/// Of the one-sided rows (B u ≤ c) and the bilateral ones (B u = c), or nothing; what rest satisfies to `tol`, a displacement, is no contradiction. By
/// Farkas's lemma there is one exactly if μ, not negative on one-sided rows, has Bᵀμ = 0 and cᵀμ < 0. Rows with an unknown of their own take part
/// in none; of the others the least ‖(Bᵀμ, 1 + cᵀμ)‖ is sought (C. L. Lawson, R. J. Hanson, Solving least squares problems, 1974, chapter 23: it is
/// 1/√(1 + ‖u‖²) with u the shortest displacement that satisfies them). Displacements of a million times the violation do not count as a way out.
std::optional<Contradiction> contradiction(const Problem& problem, double tol);

}  // namespace dotyk::problem
