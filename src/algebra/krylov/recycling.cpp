#include "algebra/krylov/recycling.hpp"

#include <algorithm>

#include "algebra/dense/decompositions.hpp"

namespace dotyk::algebra {

constexpr int kFewestPairs = 10, kMostPairs = 30;

int number_by_gap(const Vector& values) {
  const int n = static_cast<int>(values.size());
  int best = std::min(n, 1);
  double gap = 0;
  for (int i = n > kFewestPairs ? kFewestPairs : 1; i <= std::min(n - 1, kMostPairs); ++i)
    if (values[i] > gap * values[i - 1]) {
      gap = values[i] / values[i - 1];
      best = i;
    }
  return best;
}

CgResult Cglan::solve(const Vector& b, Monitor& monitor) {
  if (basis_.count() > 0)
    return conjugate_gradient(preconditioner_, b, settings_, monitor, {.basis = &basis_, .conjugate = deflate_});
  LanczosRecord record;
  CgResult result = conjugate_gradient(preconditioner_, b, settings_, monitor, {.record = &record});
  if (record.steps() > 0) keep_lowest(record);
  return result;
}

void Cglan::keep_lowest(const LanczosRecord& record) {
  const Eigenpairs lowest = lowest_eigenpairs(record.diagonal(), record.off_diagonal(), kMostPairs + 1);
  const int count = number_by_gap(lowest.values);
  values_ = lowest.values.head(count);
  const DenseMatrix ritz = record.vectors() * lowest.vectors.leftCols(count);
  for (int i = 0; i < count; ++i) {
    Vector y = ritz.col(i);
    if (!basis_.conjugate(y)) continue;
    const Vector w = preconditioner_.apply(y);
    if (y.dot(w) > 0) basis_.add(y, w);
  }
  loss_ = record.loss();
  bytes_ = record.bytes() + basis_.bytes();
}

}  // namespace dotyk::algebra
