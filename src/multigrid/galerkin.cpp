#include "multigrid/galerkin.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dotyk::multigrid {

namespace {

/// The blocks of a matrix that have entries, by rows of blocks; columns of a row in no order.
struct Blocks {
  explicit Blocks(Mat matrix) {
    PetscInt height = 1, width = 1, columns = 0;
    check(MatGetBlockSizes(matrix, &height, &width));
    check(MatGetSize(matrix, nullptr, &columns));
    count = columns / width;
    const RowsView rows(matrix);
    std::vector<int> seen(static_cast<std::size_t>(count), -1);
    for (int block = 0; block < rows.count / height; ++block) {
      for (int k = rows.starts[block * height]; k < rows.starts[(block + 1) * height]; ++k) {
        const int column = rows.columns[k] / width;
        if (std::exchange(seen[column], block) != block) columns_of.push_back(column);
      }
      starts.push_back(static_cast<int>(columns_of.size()));
    }
  }

  Blocks transposed() const {
    Blocks t;
    t.count = static_cast<int>(starts.size()) - 1;
    t.starts.assign(static_cast<std::size_t>(count) + 1, 0);
    for (const int column : columns_of) ++t.starts[column + 1];
    std::partial_sum(t.starts.begin(), t.starts.end(), t.starts.begin());
    t.columns_of.resize(columns_of.size());
    std::vector<int> next = t.starts;
    for_each([&](int row, int column) { t.columns_of[next[column]++] = row; });
    return t;
  }

  template <class Visit>
  void for_each(Visit&& visit) const {
    for (int row = 0; row + 1 < static_cast<int>(starts.size()); ++row) for_each(row, [&](int column) { visit(row, column); });
  }
  template <class Visit>
  void for_each(int row, Visit&& visit) const {
    for (int k = starts[row]; k < starts[row + 1]; ++k) visit(columns_of[k]);
  }

  int count = 0;  ///< columns
  std::vector<int> starts{0}, columns_of;

 private:
  Blocks() = default;
};

}  // namespace

OwnedMat coarse_matrix(Mat A, Mat P) {
  PetscInt block = 1;
  check(MatGetBlockSizes(P, nullptr, &block));
  const Blocks fine(A), leads(P), from = leads.transposed();
  std::vector<int> starts{0}, columns, row;
  std::vector<int> met(static_cast<std::size_t>(fine.count), -1), seen(static_cast<std::size_t>(leads.count), -1);
  for (int coarse = 0; coarse < leads.count; ++coarse) {
    row = {coarse};
    seen[coarse] = coarse;
    from.for_each(coarse, [&](int i) {
      fine.for_each(i, [&](int k) {
        if (std::exchange(met[k], coarse) == coarse) return;
        leads.for_each(k, [&](int other) {
          if (std::exchange(seen[other], coarse) != coarse) row.push_back(other);
        });
      });
    });
    std::sort(row.begin(), row.end());
    for (int r = 0; r < block; ++r) {
      for (const int node : row)
        for (int c = 0; c < block; ++c) columns.push_back(node * block + c);
      starts.push_back(static_cast<int>(columns.size()));
    }
  }
  const PetscInt size = leads.count * block;
  OwnedMat C;
  check(MatCreate(PETSC_COMM_SELF, C.put()));
  check(MatSetSizes(C, size, size, size, size));
  check(MatSetType(C, MATSEQAIJ));
  check(MatSetBlockSize(C, block));
  check(MatSeqAIJSetPreallocationCSR(C, starts.data(), columns.data(), nullptr));
  check(MatShift(C, 1));
  return C;
}

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
  entry_.assign(static_cast<std::size_t>(size_), 0.0);
  product_.place.assign(static_cast<std::size_t>(P.count), -1);
  sum_.place.assign(static_cast<std::size_t>(columns), -1);
}

double* Galerkin::Rows::at(int row, int size) {
  if (place[row] < 0) {
    place[row] = static_cast<int>(rows.size());
    rows.push_back(row);
    numbers.resize(rows.size() * static_cast<std::size_t>(size), 0.0);
  }
  return numbers.data() + static_cast<std::size_t>(place[row]) * size;
}

void Galerkin::Rows::clear() {
  for (const int row : rows) place[row] = -1;
  rows.clear(), numbers.clear();
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
      double* to = product_.at(A.columns[k], m);
      for (int r = 0; r < m; ++r) to[r] += A.values[k] * own[r];
    }
  }
  for (std::size_t p = 0; p < product_.rows.size(); ++p) {
    const double* from = product_.numbers.data() + p * m;
    const int row = product_.rows[p];
    for (int k = P.starts[row]; k < P.starts[row + 1]; ++k) {
      double* to = sum_.at(P.columns[k], m);
      for (int r = 0; r < m; ++r) to[r] += P.values[k] * from[r];
    }
  }
  for (int r = 0; r < m; ++r)
    for (int k = C.starts[block * m + r]; k < C.starts[block * m + r + 1]; ++k) C.values[k] = sum_.at(C.columns[k], m)[r];
  product_.clear(), sum_.clear();
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
  return 4.0 * static_cast<double>(support_.size() + first_.size() + support_start_.size()) + 4.0 * static_cast<double>(product_.place.size() + sum_.place.size());
}

}  // namespace dotyk::multigrid
