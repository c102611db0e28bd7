#include "multigrid/galerkin.hpp"

#include <algorithm>
#include <utility>

namespace dotyk::multigrid {

namespace {

/// How many rows and columns a node has in a matrix.
struct BlockSize {
  explicit BlockSize(Mat matrix) { check(MatGetBlockSizes(matrix, &rows, &columns)); }
  PetscInt rows = 1, columns = 1;
};

/// For each node of the rows the nodes of columns that it has entries with, in no order.
Buckets coupled_nodes(Mat matrix) {
  const BlockSize size(matrix);
  PetscInt columns = 0;
  check(MatGetSize(matrix, nullptr, &columns));
  const RowsView view(matrix);
  return Buckets(view.count / size.rows, [&](auto&& put) {
    std::vector<int> seen(static_cast<std::size_t>(columns / size.columns), -1);
    for (int row = 0; row < view.count; ++row)
      for (int k = view.starts[row]; k < view.starts[row + 1]; ++k) {
        const int node = row / size.rows, other = view.columns[k] / size.columns;
        if (std::exchange(seen[other], node) != node) put(node, other);
      }
  });
}

}  // namespace

OwnedMat coarse_matrix(Mat A, Mat P) {
  const PetscInt block = BlockSize(P).columns;
  PetscInt size = 0;
  check(MatGetSize(P, nullptr, &size));
  const Buckets fine = coupled_nodes(A), coarse_of = coupled_nodes(P);
  const Buckets fine_of(size / block, [&](auto&& put) {
    for (int node = 0; node < coarse_of.count(); ++node)
      for (const int coarse : coarse_of[node]) put(coarse, node);
  });
  std::vector<int> starts{0}, columns, row;
  std::vector<int> met(static_cast<std::size_t>(fine.count()), -1), seen(static_cast<std::size_t>(fine_of.count()), -1);
  for (int coarse = 0; coarse < fine_of.count(); ++coarse) {
    row = {coarse};
    seen[coarse] = coarse;
    for (const int node : fine_of[coarse])
      for (const int neighbour : fine[node]) {
        if (std::exchange(met[neighbour], coarse) == coarse) continue;
        for (const int other : coarse_of[neighbour])
          if (std::exchange(seen[other], coarse) != coarse) row.push_back(other);
      }
    std::sort(row.begin(), row.end());
    for (int r = 0; r < block; ++r) {
      for (const int node : row)
        for (int c = 0; c < block; ++c) columns.push_back(node * block + c);
      starts.push_back(static_cast<int>(columns.size()));
    }
  }
  OwnedMat C;
  check(MatCreate(PETSC_COMM_SELF, C.put()));
  check(MatSetSizes(C, size, size, size, size));
  check(MatSetType(C, MATSEQAIJ));
  check(MatSetBlockSize(C, block));
  check(MatSeqAIJSetPreallocationCSR(C, starts.data(), columns.data(), nullptr));
  check(MatShift(C, 1));  // nodes without functions keep a diagonal
  return C;
}

Galerkin::Galerkin(Mat interpolation, Mat coarse) {
  PetscInt size = 1, columns = 0;
  check(MatGetBlockSize(coarse, &size));
  check(MatGetSize(coarse, nullptr, &columns));
  size_ = size;
  const RowsView P(interpolation);
  const auto for_each = [&](auto&& work) {  // block of each row, with the place of its first entry
    for (int i = 0; i < P.count; ++i)
      for (int k = P.starts[i]; k < P.starts[i + 1]; ++k)
        if (k == P.starts[i] || P.columns[k] / size_ != P.columns[k - 1] / size_) work(P.columns[k] / size_, i, k);
  };
  const int blocks = columns / size_;
  support_ = Buckets(blocks, [&](auto&& put) { for_each([&](int block, int row, int) { put(block, row); }); });
  first_ = Buckets(blocks, [&](auto&& put) { for_each([&](int block, int, int place) { put(block, place); }); });
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
  const auto rows = support_[block], first = first_[block];
  for (std::size_t s = 0; s < rows.size(); ++s) {
    const int i = rows[s];
    std::fill(own, own + m, 0.0);
    bool empty = true;  // as truncated rows are
    for (int k = first[s]; k < P.starts[i + 1] && P.columns[k] / m == block; ++k)
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
  for (int b = 0; b < support_.count(); ++b) {
    if (std::ranges::none_of(support_[b], [&](int i) { return changed[i]; })) continue;
    size_ == 6 ? compute_block<6>(b, A, P, C) : size_ == 3 ? compute_block<3>(b, A, P, C) : compute_block<0>(b, A, P, C);
    std::fill_n(computed.begin() + b * size_, size_, char(1));
  }
  return computed;
}

double Galerkin::bytes() const {
  return static_cast<double>(support_.bytes() + first_.bytes()) + 4.0 * static_cast<double>(product_.place.size() + sum_.place.size());
}

}  // namespace dotyk::multigrid
