#include <cmath>

#include "program/active_set.hpp"
#include "program/lcp.hpp"

namespace dotyk::program {

using algebra::DenseMatrix;

namespace {

/// Linear program over the solutions that belong to a set: w = 0 and z ≥ 0 on it, z = 0 and w ≥ 0 off it.
QuadraticProgram over_set(const Lcp& lcp, const FreeSet& free, const Vector& cost) {
  const int n = lcp.size();
  QuadraticProgram p;
  p.P = SparseMatrix(n, n);
  p.q = cost;
  DenseMatrix a(2 * n, n);
  a << lcp.M, DenseMatrix::Identity(n, n);
  p.A = a.sparseView(0, 0);
  p.low.resize(2 * n), p.high.resize(2 * n);
  for (int i = 0; i < n; ++i) {
    p.low[i] = -lcp.q[i], p.high[i] = free[i] ? -lcp.q[i] : INFINITY;
    p.low[n + i] = 0, p.high[n + i] = free[i] ? INFINITY : 0;
  }
  return p;
}

class Search {
 public:
  Search(const Lcp& lcp, int most, Monitor& monitor) : lcp_(lcp), most_(most), monitor_(monitor) {}

  Enumeration run() {
    const int n = lcp_.size();
    for (unsigned long set = 0; set < (1ul << n) && static_cast<int>(out_.solutions.size()) < most_; ++set) {
      if (monitor_.stop()) {  // a singular set may take milliseconds
        out_.complete = false;
        break;
      }
      FreeSet free(n);
      for (int i = 0; i < n; ++i) free[i] = set >> i & 1;
      const Vector z = on_set(lcp_, free);
      if (z.size()) add(z);
      else singular(free);
    }
    return out_;
  }

 private:
  void add(const Vector& z) {
    if (z.minCoeff() < -1e-10 * (1 + z.lpNorm<Eigen::Infinity>()) || residual(lcp_, z) > 1e-9) return;
    for (const Vector& known : out_.solutions)
      if ((known - z).lpNorm<Eigen::Infinity>() <= 1e-7 * (1 + z.lpNorm<Eigen::Infinity>())) return;
    if (static_cast<int>(out_.solutions.size()) < most_) out_.solutions.push_back(z);
  }

  /// Where M is singular on a set there may be a segment of solutions: its ends in two opposite directions.
  void singular(const FreeSet& free) {
    Monitor quiet;
    const int n = lcp_.size();
    Vector cost(n);
    for (int i = 0; i < n; ++i) cost[i] = 1 + 0.37 * std::sin(1.0 + 7.0 * i);  // positive: z ≥ 0 keeps it bounded
    ActiveSet settings;
    settings.start = ActiveSet::Start::cold;
    const Result least = solve(over_set(lcp_, free, cost), settings, quiet);
    if (least.status != Status::solved) return;
    const std::size_t before = out_.solutions.size();
    add(least.x);
    const Result most = solve(over_set(lcp_, free, -cost), settings, quiet);
    if (most.status == Status::solved) add(most.x);
    if (most.status == Status::unbounded) add(least.x + (1 + least.x.norm()) * most.direction);
    out_.continuum = out_.continuum || most.status == Status::unbounded || out_.solutions.size() >= before + 2;
  }

  const Lcp& lcp_;
  int most_;
  Monitor& monitor_;
  Enumeration out_;
};

}  // namespace

Enumeration enumerate(const Lcp& lcp, int most, Monitor& monitor) { return Search(lcp, most, monitor).run(); }

}  // namespace dotyk::program
