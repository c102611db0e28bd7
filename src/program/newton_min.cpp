#include "algebra/dense/decompositions.hpp"
#include <algorithm>

#include "program/lcp.hpp"

namespace dotyk::program {

using algebra::DenseMatrix;
using algebra::Vector;

Vector on_set(const Lcp& lcp, const FreeSet& free) {
  std::vector<int> index;
  for (int i = 0; i < lcp.size(); ++i)
    if (free[i]) index.push_back(i);
  Vector z = Vector::Zero(lcp.size());
  const auto k = static_cast<Eigen::Index>(index.size());
  if (k == 0) return z;
  DenseMatrix m(k, k);
  Vector b(k);
  for (Eigen::Index i = 0; i < k; ++i) {
    b[i] = -lcp.q[index[i]];
    for (Eigen::Index j = 0; j < k; ++j) m(i, j) = lcp.M(index[i], index[j]);
  }
  const algebra::PivotedLu lu(m);
  if (!lu.regular()) return {};
  const Vector x = lu.solve(b);
  if (!x.allFinite()) return {};
  for (Eigen::Index i = 0; i < k; ++i) z[index[i]] = x[i];
  return z;
}

NewtonMin newton_min(const Lcp& lcp, FreeSet free, int max_solves) {
  NewtonMin out;
  free.resize(lcp.size(), 0);
  std::vector<FreeSet> seen;
  for (;;) {
    const auto before = std::find(seen.begin(), seen.end(), free);
    if (before != seen.end()) {
      // The set that repeats itself is the solution's; any longer loop is a cycle.
      out.cycle.assign(before, seen.end());
      out.end = out.cycle.size() == 1 ? NewtonMin::End::solved : NewtonMin::End::cycle;
      if (out.cycle.size() == 1) out.cycle.clear();
      return out;
    }
    if (out.solves == max_solves) return out;
    const Vector z = on_set(lcp, free);
    if (z.size() == 0) {
      out.end = NewtonMin::End::singular;
      return out;
    }
    ++out.solves;
    out.z = z;
    Vector w = lcp.M * z + lcp.q;
    seen.push_back(free);
    for (int i = 0; i < lcp.size(); ++i) {
      if (free[i]) w[i] = 0;  // exactly, so that rounding does not decide
      free[i] = z[i] > w[i];
    }
  }
}

}  // namespace dotyk::program
