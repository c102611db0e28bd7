#pragma once

#include <functional>
#include <vector>

#include "algebra/types.hpp"
#include "base/parallel.hpp"

namespace dotyk::algebra {

/// The product A V of a symmetric matrix A, given as its lower triangle, with a vector V or a row-major matrix V, in V's number type. A is read once, whatever
/// the number of columns. `of` is applied to each entry of A first: with the modulus the result is |A| V. The order of summation, and so rounding, depends on
/// the number of threads.
template <class Numbers, class Of = std::identity>
typename Numbers::PlainObject symmetric_product(const SparseMatrix& lower, const Numbers& V, Of of = {}) {
  using Plain = typename Numbers::PlainObject;
  using Number = typename Numbers::Scalar;
  static_assert(Numbers::ColsAtCompileTime == 1 || Numbers::IsRowMajor);
  const int n = static_cast<int>(lower.cols());
  constexpr Eigen::Index known = Numbers::ColsAtCompileTime;
  const Eigen::Index count = known == Eigen::Dynamic ? V.cols() : known;
  const auto add = [&](Number* to, int from, double a) {
    for (Eigen::Index c = 0; c < count; ++c) to[c] += a * V.data()[from * count + c];
  };
  constexpr Eigen::Index kFew = 1'000'000;  // entries, for a thread
  const int threads = threads_for(lower.nonZeros(), kFew);
  Plain product = Plain::Zero(V.rows(), V.cols());
  std::vector<Plain> beyond(static_cast<std::size_t>(threads));  // what a range of columns adds to the rows after it
  parallel_ranges(n, threads, [&](int k, int first, int end) {
    Plain& after = beyond[k] = Plain::Zero(n - end, V.cols());
    for (int j = first; j < end; ++j)
      for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
        const int i = static_cast<int>(it.row());
        if (i < j) continue;
        const double a = of(it.value());
        add(i < end ? product.data() + i * count : after.data() + (i - end) * count, j, a);
        if (i != j) add(product.data() + j * count, i, a);
      }
  });
  for (const Plain& after : beyond) product.bottomRows(after.rows()) += after;
  return product;
}

}  // namespace dotyk::algebra
