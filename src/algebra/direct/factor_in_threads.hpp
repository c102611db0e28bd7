#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/monitor.hpp"

namespace dotyk::algebra {

/// Calls factor(k) once for every k; the calls with most work begin first. `flops[k]`: the work of a call. The calls run in several threads, and BLAS
/// uses one thread in each. They run one after another, and BLAS may use several threads, if there is only one call, if all of them together are small,
/// or if one call has most of the work and is large enough for several threads.
///
/// Before each call the monitor is asked whether to stop, and is told phase(k, n): this is the n-th call, from 1. StopFactoring holds during the call.
/// A call must not touch what another one writes.
void factor_in_threads(const std::vector<double>& flops, const std::function<std::string(int k, int n)>& phase, Monitor& monitor,
                       const std::function<void(int)>& factor);

}  // namespace dotyk::algebra
