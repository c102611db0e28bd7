#pragma once
// The steps of a quasi-static history, as dotyk.solve takes them.
#include <vector>

#include "scene/statement/loading.hpp"
#include "script/bridge/arguments.hpp"

namespace dotyk::script {

Key steps_key();
std::vector<scene::Step> read_steps(const Arguments& options, const scene::Scene& scene);

}  // namespace dotyk::script
