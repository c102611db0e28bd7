#include "multigrid/galerkin.hpp"

#include <algorithm>

namespace dotyk::multigrid {

Galerkin::Galerkin(Mat interpolation, Mat coarse) {
  PetscInt size = 1, columns = 0;
  check(MatGetBlockSize(coarse, &size));
  check(MatGetSize(coarse, nullptr, &columns));
  size_ = size;
  const RowsView P(interpolation);
  support_start_.assign(static_cast<std::size_t>(columns / size_) + 1, 0);
  const auto for_each = [&](auto&& work) {  // block of each row, with the place of its first entry
    for (int i = 0; i < P.count; ++i)
      for (int k = P.starts[i]; k < P.starts[i + 1]; ++k)
        if (k == P.starts[i] || P.columns[k] / size_ != P.columns[k - 1] / size_) work(P.columns[k] / size_, i, k);
  };
  for_each([&](int block, int, int) { ++support_start_[block + 1]; });
  for (std::size_t b = 1; b < support_start_.size(); ++b) support_start_[b] += support_start_[b - 1];
  support_.resize(static_cast<std::size_t>(support_start_.back()));
  first_.resize(support_.size());
  std::vector<int> next(support_start_.begin(), support_start_.end() - 1);
  for_each([&](int block, int row, int place) { support_[next[block]] = row, first_[next[block]++] = place; });
  const auto fine = static_cast<std::size_t>(P.count), all = static_cast<std::size_t>(columns);
  product_.assign(fine * static_cast<std::size_t>(size_), 0.0), in_product_.assign(fine, 0);
  sum_.assign(all * static_cast<std::size_t>(size_), 0.0), in_sum_.assign(all, 0);
  entry_.assign(static_cast<std::size_t>(size_), 0.0);
}

// Row k of `product_` is (A P)_kJ of the block J, since A is symmetric; `sum_` is the block's rows of the coarse matrix, by columns.
template <int fixed>
void Galerkin::compute_block(int block, const RowsView& A, const RowsView& P, RowsView& C) {
  const int m = fixed > 0 ? fixed : size_;
  double* own = entry_.data();
  for (int s = support_start_[block]; s < support_start_[block + 1]; ++s) {
    const int i = support_[s];
    std::fill(own, own + m, 0.0);
    bool empty = true;  // as truncated rows are
    for (int k = first_[s]; k < P.starts[i + 1] && P.columns[k] / m == block; ++k)
      own[P.columns[k] - block * m] = P.values[k], empty = empty && P.values[k] == 0;
    if (empty) continue;
    for (int k = A.starts[i]; k < A.starts[i + 1]; ++k) {
      const int row = A.columns[k];
      if (!in_product_[row]) in_product_[row] = 1, product_rows_.push_back(row);
      double* to = product_.data() + static_cast<std::size_t>(row) * m;
      for (int r = 0; r < m; ++r) to[r] += A.values[k] * own[r];
    }
  }
  for (const int row : product_rows_) {
    double* from = product_.data() + static_cast<std::size_t>(row) * m;
    for (int k = P.starts[row]; k < P.starts[row + 1]; ++k) {
      const int column = P.columns[k];
      if (!in_sum_[column]) in_sum_[column] = 1, sum_rows_.push_back(column);
      double* to = sum_.data() + static_cast<std::size_t>(column) * m;
      for (int r = 0; r < m; ++r) to[r] += P.values[k] * from[r];
    }
    std::fill(from, from + m, 0.0);
    in_product_[row] = 0;
  }
  for (int r = 0; r < m; ++r)
    for (int k = C.starts[block * m + r]; k < C.starts[block * m + r + 1]; ++k)
      C.values[k] = sum_[static_cast<std::size_t>(C.columns[k]) * m + r];
  for (const int column : sum_rows_) {
    std::fill_n(sum_.data() + static_cast<std::size_t>(column) * m, m, 0.0);
    in_sum_[column] = 0;
  }
  product_rows_.clear();
  sum_rows_.clear();
}

std::vector<char> Galerkin::compute(Mat fine, Mat interpolation, Mat coarse, const std::vector<char>& changed) {
  const RowsView A(fine), P(interpolation);
  RowsView C(coarse);
  std::vector<char> computed(static_cast<std::size_t>(C.count), 0);
  for (int b = 0; b + 1 < static_cast<int>(support_start_.size()); ++b) {
    const auto begin = support_.begin() + support_start_[b], end = support_.begin() + support_start_[b + 1];
    if (std::none_of(begin, end, [&](int i) { return changed[i]; })) continue;
    size_ == 6 ? compute_block<6>(b, A, P, C) : size_ == 3 ? compute_block<3>(b, A, P, C) : compute_block<0>(b, A, P, C);
    std::fill_n(computed.begin() + b * size_, size_, char(1));
  }
  return computed;
}

double Galerkin::bytes() const {
  return 4.0 * static_cast<double>(support_.size() + first_.size() + support_start_.size()) + 8.0 * static_cast<double>(product_.size() + sum_.size()) +
         static_cast<double>(in_product_.size() + in_sum_.size());
}

}  // namespace dotyk::multigrid
