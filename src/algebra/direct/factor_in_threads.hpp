#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/monitor.hpp"

namespace dotyk::algebra {

/// factor(k) for every k, the greatest first. Each has a thread, and its products have no others. Where there is one, where the work is small, or where the
/// greatest has most of it and its products may have several threads, they go on one after another on this thread. Before each the monitor is told phase(k) and asked whether to stop, and a
/// StopFactoring lives while it goes on. `flops`: of each. The calls must not touch what another one writes.
void factor_in_threads(const std::vector<double>& flops, const std::function<std::string(int)>& phase, Monitor& monitor,
                       const std::function<void(int)>& factor);

}  // namespace dotyk::algebra
