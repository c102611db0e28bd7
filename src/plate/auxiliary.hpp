#pragma once

#include <optional>

#include "plate/family.hpp"
#include "solver/core/method.hpp"

namespace dotyk::plate {

/// The limit case, in which the load does no work against the supports on one motion: every row that notices the motion bears the most, or least, that
/// its law allows on the side to which it would move, so its multiplier is known, and what is left is a problem without these rows, linear where
/// there are no others (P5, lemma 10 and remark 20: Aw = f, ∂ₙw = 0, Tₙw = 0 or −κ). Its solution is moved to where the laws of these rows
/// begin to be obeyed; `all` are the others. Nothing where another motion would become free.
struct LimitCase {
  solver::Result result;
  Family all;
};
std::optional<LimitCase> solve_limit_case(const Model& model, const algebra::Vector& motion, const solver::Method& method, Monitor& monitor);

/// By the method; without one linearly where there are no rows, else by PDAS: on the condensed problem while rows act on few unknowns,
/// else on the unknowns, begun with an interior point method (Pdas::held), as over an obstacle, which has a row at every vertex.
solver::Result run(const problem::Problem& problem, const solver::Method& method, Monitor& monitor);

}  // namespace dotyk::plate
