#pragma once

#include <optional>

#include "problem/measure.hpp"
#include "solver/active/step.hpp"

namespace dotyk::solver {

/// Where to begin an active-set iteration on rows that follow one another along edges (Problem::chains): the problem is first solved on a few
/// of them, each bearing what those about it could, by a barrier method, then on every second of the rest, and so on, by active sets; a row
/// begins on the piece of its law that its neighbours ended on, one between two different pieces on that which its displacement asks for. Without it
/// the number of iterations grows with the number of rows, since an end of a contact zone moves by few rows a step.
struct NestedStart {
  Linearisation linearisation;
  int solves = 0;  ///< on `step`, a problem of all rows, and steps of the barrier method
};
/// Nothing where no chain is long enough.
std::optional<NestedStart> nested_start(const problem::Problem& problem, const problem::CondensedProblem& condensed, const problem::Measure& measure,
                                        const algebra::Vector& rho, Step& step);

}  // namespace dotyk::solver
