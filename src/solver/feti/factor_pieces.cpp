#include "solver/feti/factor_pieces.hpp"

#include <algorithm>
#include <mutex>
#include <numeric>

#include "algebra/direct/blas_threads.hpp"
#include "algebra/direct/stop_factoring.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"

namespace dotyk::solver {

void factor_in_threads(const std::vector<double>& flops, const std::string& what, Monitor& monitor,
                       const std::function<void(int)>& factor) {
  std::vector<int> order(flops.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return flops[a] > flops[b]; });
  std::mutex watching;
  int begun = 0;
  const auto one = [&](int k) {
    {
      const std::lock_guard lock(watching);
      monitor.check();
      monitor.phase(text(what, " ", ++begun, " of ", flops.size()));
    }
    const algebra::StopFactoring stop(monitor);
    factor(order[k]);
  };
  if (order.size() == 1) return one(0);
  const algebra::OneBlasThread single;
  parallel_for(static_cast<int>(order.size()), one, single.workers());
}

void refuse_singular(const Piece& piece, int unknown) {
  throw InputError(text(
      "the stiffness of ", piece.name, " is singular",
      unknown >= 0 ? text(" (node ", (*piece.node)[unknown] + 1, " is not held)") : "",
      piece.kernel->cols() > 0 ? text(" beyond its ", piece.kernel->cols(), " rigid motions") : "",
      ": a material, spring or mesh value is out of range, or cells hang together at single nodes only"));
}

}  // namespace dotyk::solver
