#pragma once

#include "solver/method.hpp"

namespace dotyk::solver {

/// What solves a problem where no method is named.
enum class DefaultMethod { linear, pdas, newton };

/// Without rows one linear solve; with friction, or a law that does not tell its springs, newton; else pdas.
DefaultMethod default_method(const problem::Problem& problem);

/// By the method, where one is named, else by the default one. A problem without rows takes one linear solve, whatever the
/// method, unless it cuts bodies into subdomains.
Result solve(const problem::Problem& problem, const Method& method, Beginning from, Monitor& monitor);

}  // namespace dotyk::solver
