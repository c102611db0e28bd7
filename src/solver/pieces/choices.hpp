#pragma once

#include <vector>

#include "problem/problem.hpp"

namespace dotyk::solver {

/// A row or two whose pieces are chosen together.
struct Choice {
  int row = -1;            ///< of contact
  int tangent = -1;        ///< of friction
  int pieces = 2;          ///< open, closed; stick, forward, backward; open, stick, forward, backward
  double bound = 0;        ///< of given friction
  double coefficient = 0;  ///< ∂b/∂λ_n
};

/// Of unilateral rows, alone or with the friction of the same point, and of given friction in the plane. Throws InputError for other laws and where
/// there are more than 2²⁰ combinations.
std::vector<Choice> choices_of(const problem::Problem& problem);

}  // namespace dotyk::solver
