#pragma once

#include <optional>

#include "solver/core/method.hpp"

namespace dotyk::solver {

/// What solves a problem where no method is named.
enum class DefaultMethod { linear, pdas, held, newton, multigrid };

/// Multigrid, for solid bodies, where it is installed and promises to be faster, or memory for factors is short at this moment. Otherwise: without rows, one
/// linear solve; with friction, or a law that does not tell its springs, newton; else pdas on the condensed rows, or held on all unknowns (reduced = false).
/// That is where all of at least 150 rows are glue, or linear otherwise, one factorisation in all, and where rows are more than 3000 and more than a tenth of
/// the unknowns, as on strips and plates that touch all along: a dense factor takes the cube of their number then, sparse ones of a thin body far less.
DefaultMethod default_method(const problem::Problem& problem);

/// Whether multigrid may be chosen: it is installed, bodies are solid, laws tell their springs, and the problem is large enough for an estimate.
bool multigrid_is_possible(const problem::Problem& problem);

/// Estimates for solid bodies on one core, right to a factor of two. The seconds of multigrid include the opening of its library; few iterations are assumed.
/// There must be a body.
struct Expected {
  struct Cost {
    double seconds, bytes;
  } factors, multigrid;
};
Expected expected(const problem::Problem& problem);

/// By the method, where one is named, else by the default one. A problem without rows takes one linear solve, whatever the
/// method, unless it cuts bodies into subdomains. `condensed`: whether pdas condenses, by a model that knows better than the count of
/// rows, as beams and plates, whose deflections between near supports are small differences on condensed rows.
Result solve(const problem::Problem& problem, const Method& method, Beginning from, Monitor& monitor, std::optional<bool> condensed = {});

}  // namespace dotyk::solver
