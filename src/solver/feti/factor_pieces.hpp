#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "solver/feti/torn_problem.hpp"

namespace dotyk::solver {

/// factor(k) for every k, the greatest first, in threads (a single one with all threads for its products). Between them
/// the monitor is told "what 3 of 64" and asked whether to stop. `flops`: of each.
void factor_in_threads(const std::vector<double>& flops, const std::string& what, Monitor& monitor,
                       const std::function<void(int)>& factor);

/// Throws the InputError that K of a piece has more motions for kernel than said. `unknown`: where, or -1.
[[noreturn]] void refuse_singular(const Piece& piece, int unknown);

}  // namespace dotyk::solver
