#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/monitor.hpp"

namespace dotyk::algebra {

/// factor(k) for every k, the greatest first: in threads of their own, whose products have one thread, or, where there is one or the greatest has most
/// of the work, one after another with all threads for their products. Before each the monitor is told phase(k) and asked whether to stop, and a
/// StopFactoring lives while it goes on. `flops`: of each. The calls must not touch what another one writes.
void factor_in_threads(const std::vector<double>& flops, const std::function<std::string(int)>& phase, Monitor& monitor,
                       const std::function<void(int)>& factor);

}  // namespace dotyk::algebra
