#pragma once

#include <string>
#include <vector>

#include "scene/result/solution.hpp"

namespace dotyk::scene {

/// What makes the answer of a scene doubtful however well its equations are solved: a mesh or elements that cannot show
/// what the scene asks for. One sentence each, without a capital and a full stop, that names body or contact, says how great the error is
/// and what to do; mostly none. Costs a pass over contacts and materials; nothing is assembled.
std::vector<std::string> doubts(const Scene& scene);
/// The same when it is solved: of contacts what presses is looked at, not all that might; strains and
/// rotations beyond small ones are added, which takes a pass over all cells.
std::vector<std::string> doubts(const Solution& solution);

/// "\n  warning: …" for each of them.
std::string describe(const std::vector<std::string>& doubts);

}  // namespace dotyk::scene
