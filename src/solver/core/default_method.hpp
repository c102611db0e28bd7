#pragma once

#include <limits>
#include <optional>

#include "solver/core/method.hpp"

namespace dotyk::solver {

/// What solves a problem where no method is named: made once, from sizes and a stated limit of memory, and passed down.
struct Choice {
  enum class By {
    linear,    ///< one linear solve, without rows
    pdas,      ///< on the condensed rows
    newton,    ///< the same with friction, or with a law that does not tell its springs
    held,      ///< pdas on all unknowns, a sparse factor an iteration (reduced = false)
    interior,  ///< held, begun where an interior point method ends
    multigrid  ///< pdas on all unknowns, by conjugate gradients
  };
  By by = By::linear;
  std::vector<char> near = {};  ///< one flag a row: where condensing begins, see rows_that_may_close(); empty: all
  bool turned = false;          ///< first with turned nodes (TurnedNodes), for which by_factors() chooses
  bool factors_fit = true;      ///< by the estimate: else nothing is left to try where multigrid gives up
  double most_iterations = std::numeric_limits<double>::infinity();  ///< of multigrid, beyond which factors are faster
  std::string costs = {};  ///< estimates for a large solid; continues a sentence that names the method
};

/// The choice without multigrid. `held` where all of at least 150 rows are linear, as those of glue, one factorisation
/// in all, and where the cube of at least 150 rows is more work than a sparse factor of all unknowns a step, as on strips
/// that touch all along, and of many small bodies. `kept`: shared by the steps of a history, whose rows are all condensed
/// once, where condensing is less work or all are linear; null: there is one step.
Choice by_factors(const problem::Problem& problem, const problem::Condenser* kept = nullptr);

/// Large solid bodies are solved by multigrid, where it is installed, if it promises to be faster than factors, or if
/// these do not fit: into `memory` bytes, a limit that stays while the program runs (memory_limit()), or into CHOLMOD's
/// indices. All else as by_factors(). Estimates are right to a factor of two. K and loads count only for free bodies.
Choice choose(const problem::Problem& problem, double memory, const problem::Condenser* kept = nullptr);

/// As chosen. `held` and `multigrid` are followed by the condensed rows where they do not converge or do not solve a
/// linear system, or where multigrid's library cannot be opened. Refusals, and want of memory, end the solve.
Result solve_chosen(const problem::Problem& problem, const Choice& choice, Beginning from, Monitor& monitor);

/// By the method, where one is named, else as choose() says. A problem without rows takes one linear solve, whatever the
/// method, unless it cuts bodies into subdomains. `condensed`: whether pdas condenses, by a model that knows better than the count of
/// rows, as beams and plates, whose deflections between near supports are small differences on condensed rows.
Result solve(const problem::Problem& problem, const Method& method, Beginning from, Monitor& monitor, std::optional<bool> condensed = {});

}  // namespace dotyk::solver
