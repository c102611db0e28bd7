#include "algebra/direct/factor_in_threads.hpp"

#include <algorithm>
#include <mutex>
#include <numeric>

#include "algebra/direct/blas_threads.hpp"
#include "algebra/direct/stop_factoring.hpp"
#include "base/parallel.hpp"

namespace dotyk::algebra {
namespace {

/// Below so many flops together threads are not worth their beginning.
constexpr double kWorthThreads = 1e8;
/// If one call has more than this share of the work, it is faster to let BLAS use several threads, one call after another.
constexpr double kMost = 2.0 / 3;

}  // namespace

void factor_in_threads(const std::vector<double>& flops, const std::function<std::string(int k, int n)>& phase, Monitor& monitor,
                       const std::function<void(int)>& factor) {
  if (flops.empty()) return;
  std::vector<int> order(flops.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return flops[a] > flops[b]; });
  std::mutex watching;
  int begun = 0;
  const auto one = [&](int k) {
    {
      const std::lock_guard lock(watching);
      monitor.check();
      monitor.phase(phase(order[k], ++begun));
    }
    const StopFactoring stop(monitor);
    factor(order[k]);
  };
  const double total = std::accumulate(flops.begin(), flops.end(), 0.0), greatest = flops[order.front()];
  if (order.size() == 1 || total < kWorthThreads || (greatest > kMost * total && blas_shares_out(greatest))) {
    for (std::size_t k = 0; k < order.size(); ++k) one(static_cast<int>(k));
    return;
  }
  const OneBlasThread single;
  parallel_for(static_cast<int>(order.size()), one, single.workers());
}

}  // namespace dotyk::algebra
