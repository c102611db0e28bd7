#pragma once

#include <string>

#include "beam/model.hpp"

namespace dotyk::beam {

/// Are there reactions that the supports can give and that balance the load? Throws InputError where there are none: with
/// the motion of the ends that nothing stops, the work of the load on it, and the resultants ⟨q, 1 − x/L⟩ and ⟨q, x/L⟩ that
/// the conditions of P4 are about (theorem 2: one-sided elastic, 3: Signorini, 4 and 5: friction). Otherwise
/// what is to be known: that the solution is unique up to a motion, or a limit case; empty where it is unique.
std::string require_solvable(const Beam& beam, const Model& model);

/// The theorems of P4 that are about these supports; empty where none is.
std::string theorem(const Beam& beam);

/// The motion u = translation + rotation (x/ℓ − ½) by its deflections at the ends, the greater 1.
std::string ends(double translation, double rotation);

/// Do the reactions of the rows balance the load of the problem's one block? Not where a spring that alone holds the beam is too
/// weak to be told from none, nor where cells are so small beside the length that rounding hides the reactions.
bool balanced(const problem::Problem& problem, const algebra::Vector& lambda);
inline constexpr const char* kUnbalanced =
    "the reactions do not balance the load: rounding hides them, as where a spring is too weak beside the beam, or supports are too close together for its stiffness";

}  // namespace dotyk::beam
