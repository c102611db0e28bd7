#pragma once

#include <optional>

#include "problem/problem.hpp"

namespace dotyk::problem {

/// A one-sided row that no displacement satisfies, as bilateral rows hold B_r u.
struct Contradiction {
  int row;
  double by;  ///< of B_r u − c_r > 0, a displacement
};

/// The first one of those that are violated at rest by more than `tol`, a displacement, where B_r is a combination of the bilateral rows B_k that
/// share unknowns with it, and the same combination of their c_k exceeds c_r by as much. Nothing where there is none of this kind.
std::optional<Contradiction> contradiction(const Problem& problem, double tol);

}  // namespace dotyk::problem
