#include "multigrid/galerkin.hpp"

#include <algorithm>
#include <utility>

namespace dotyk::multigrid {

namespace {

/// A square or oblong matrix of this pattern, with its values or, where there are none, zeros; `block`: rows and columns of a node.
OwnedMat with_pattern(const Ranks& ranks, const Rows& pattern, int own_columns, int block) {
  const int rows = static_cast<int>(pattern.starts.size()) - 1;
  const double* values = pattern.values.empty() ? nullptr : pattern.values.data();
  OwnedMat m;
  check(MatCreate(ranks.comm(), m.put()));
  check(MatSetSizes(m, rows, own_columns, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(m, ranks.alone() ? MATSEQAIJ : MATMPIAIJ));
  check(MatSetBlockSize(m, block));
  check(ranks.alone() ? MatSeqAIJSetPreallocationCSR(m, pattern.starts.data(), pattern.columns.data(), values)
                      : MatMPIAIJSetPreallocationCSR(m, pattern.starts.data(), pattern.columns.data(), values));
  return m;
}

/// 1 for each pair of a node of the rows and one of the columns that have entries.
OwnedMat of_nodes(Mat matrix) {
  const BlockSize size(matrix);
  const LocalRows view(matrix);
  Rows nodes;
  std::vector<int> met;
  for (int row = 0; row < view.count(); ++row) {
    view.for_each(row, [&](int column, double) {
      if (met.empty() || met.back() != column / size.columns) met.push_back(column / size.columns);
    });
    if ((row + 1) % size.rows != 0) continue;
    std::sort(met.begin(), met.end());
    nodes.columns.insert(nodes.columns.end(), met.begin(), std::unique(met.begin(), met.end()));
    nodes.starts.push_back(static_cast<int>(nodes.columns.size()));
    met.clear();
  }
  nodes.values.assign(nodes.columns.size(), 1.0);
  return with_pattern(ranks_of(matrix), nodes, view.own_columns / size.columns, 1);
}

}  // namespace

OwnedMat coarse_matrix(Mat A, Mat P) {
  const PetscInt block = BlockSize(P).columns;
  const OwnedMat fine = of_nodes(A), interpolation = of_nodes(P);
  OwnedMat pairs;
  check(MatPtAP(fine, interpolation, MAT_INITIAL_MATRIX, PETSC_DEFAULT, pairs.put()));
  Rows pattern;
  std::vector<int> nodes;
  {
    const LocalRows view(pairs);
    for (int row = 0; row < view.count(); ++row) {
      nodes = {view.first_row + row};  // those without functions keep a diagonal
      view.for_each(row, [&](int other, double) { nodes.push_back(other); });
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      for (int r = 0; r < block; ++r) {
        for (const int node : nodes)
          for (int c = 0; c < block; ++c) pattern.columns.push_back(node * block + c);
        pattern.starts.push_back(static_cast<int>(pattern.columns.size()));
      }
    }
  }
  OwnedMat C = with_pattern(ranks_of(A), pattern, static_cast<int>(pattern.starts.size()) - 1, block);
  check(MatSetOption(C, MAT_NEW_NONZERO_LOCATION_ERR, PETSC_TRUE));
  check(MatShift(C, 1));
  return C;
}

Galerkin::Galerkin(Mat fine, Mat interpolation, Mat coarse) {
  PetscInt size = 1, columns = 0, own = 0;
  check(MatGetBlockSize(coarse, &size));
  check(MatGetSize(coarse, nullptr, &columns));
  check(MatGetLocalSize(interpolation, &own, nullptr));
  size_ = size;
  if (!ranks_of(fine).alone()) {
    check(MatGetBrowsOfAcols(fine, interpolation, MAT_INITIAL_MATRIX, rows_.put(), columns_.put(), reached_.put()));
    const LocalRows A(fine);
    below_ = static_cast<int>(std::lower_bound(A.others, A.others + A.others_count, A.first_column) - A.others);
  }
  const RowsView P(reached_ ? Mat(reached_) : interpolation);
  const auto for_each = [&](auto&& work) {  // block of each own row, with the place of its first entry
    for (int i = below_; i < below_ + own; ++i)
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

double* Galerkin::SomeRows::at(int row, int size) {
  if (place[row] < 0) {
    place[row] = static_cast<int>(rows.size());
    rows.push_back(row);
    numbers.resize(rows.size() * static_cast<std::size_t>(size), 0.0);
  }
  return numbers.data() + static_cast<std::size_t>(place[row]) * size;
}

void Galerkin::SomeRows::clear() {
  for (const int row : rows) place[row] = -1;
  rows.clear(), numbers.clear();
}

template <int fixed>
void Galerkin::compute_block(int block, const LocalRows& A, const RowsView& P) {
  const int m = fixed > 0 ? fixed : size_;
  double* own = entry_.data();
  const auto rows = support_[block], first = first_[block];
  const auto add = [&](double* to, double factor, const double* numbers) {
    for (int r = 0; r < m; ++r) to[r] += factor * numbers[r];
  };
  for (std::size_t s = 0; s < rows.size(); ++s) {
    const int i = rows[s], row = i - below_;
    std::fill(own, own + m, 0.0);
    bool empty = true;  // as truncated rows are
    for (int k = first[s]; k < P.starts[i + 1] && P.columns[k] / m == block; ++k)
      own[P.columns[k] - block * m] = P.values[k], empty = empty && P.values[k] == 0;
    if (empty) continue;
    for (int k = A.own->starts[row]; k < A.own->starts[row + 1]; ++k) add(product_.at(below_ + A.own->columns[k], m), A.own->values[k], own);
    if (!A.other) continue;
    for (int k = A.other->starts[row]; k < A.other->starts[row + 1]; ++k) {
      const int column = A.other->columns[k];
      add(product_.at(column < below_ ? column : column + A.own_columns, m), A.other->values[k], own);
    }
  }
  for (std::size_t p = 0; p < product_.rows.size(); ++p) {
    const double* from = product_.numbers.data() + p * m;
    const int row = product_.rows[p];
    for (int k = P.starts[row]; k < P.starts[row + 1]; ++k) add(sum_.at(P.columns[k], m), P.values[k], from);
  }
  product_.clear();
}

void Galerkin::put_block(int block, LocalRows& C) {
  for (int r = 0; r < size_; ++r) {
    const int row = block * size_ + r - C.first_row;
    for (int k = C.own->starts[row]; k < C.own->starts[row + 1]; ++k) C.own->values[k] = sum_.at(C.first_column + C.own->columns[k], size_)[r];
    if (!C.other) continue;
    for (int k = C.other->starts[row]; k < C.other->starts[row + 1]; ++k) C.other->values[k] = sum_.at(C.others[C.other->columns[k]], size_)[r];
  }
}

void Galerkin::send_block(int block, Mat C) {
  std::vector<double> values(sum_.rows.size());
  for (int r = 0; r < size_; ++r) {
    const PetscInt row = block * size_ + r;
    for (std::size_t p = 0; p < values.size(); ++p) values[p] = sum_.numbers[p * size_ + r];
    check(MatSetValues(C, 1, &row, static_cast<PetscInt>(values.size()), sum_.rows.data(), values.data(), ADD_VALUES));
  }
}

void Galerkin::fetch(Mat fine, Mat interpolation) {
  if (reached_) check(MatGetBrowsOfAcols(fine, interpolation, MAT_REUSE_MATRIX, rows_.put(), columns_.put(), reached_.put()));
}

std::vector<char> Galerkin::compute(Mat fine, Mat interpolation, Mat coarse, const std::vector<char>& changed) {
  const Ranks ranks = ranks_of(coarse);
  std::vector<char> due(static_cast<std::size_t>(support_.count()), 0);
  for (int b = 0; b < support_.count(); ++b) due[b] = std::ranges::any_of(support_[b], [&](int i) { return changed[i - below_]; });
  if (!ranks.alone()) MPI_Allreduce(MPI_IN_PLACE, due.data(), static_cast<int>(due.size()), MPI_BYTE, MPI_BOR, ranks.comm());
  std::vector<char> computed;
  {
    const LocalRows A(fine);
    const RowsView P(reached_ ? Mat(reached_) : interpolation);
    LocalRows C(coarse);
    computed.assign(static_cast<std::size_t>(C.count()), 0);
    for (int b = 0; b < support_.count(); ++b) {
      const int row = b * size_ - C.first_row;
      const bool mine = row >= 0 && row < C.count();
      if (!due[b] || (!mine && support_[b].empty())) continue;
      size_ == 6 ? compute_block<6>(b, A, P) : size_ == 3 ? compute_block<3>(b, A, P) : compute_block<0>(b, A, P);
      if (mine) {
        put_block(b, C);
        std::fill_n(computed.begin() + row, size_, char(1));
      } else {
        send_block(b, coarse);
      }
      sum_.clear();
    }
  }
  if (!ranks.alone()) {
    check(MatAssemblyBegin(coarse, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(coarse, MAT_FINAL_ASSEMBLY));
  }
  return computed;
}

double Galerkin::bytes() const {
  return static_cast<double>(support_.bytes() + first_.bytes()) + 4.0 * static_cast<double>(product_.place.size() + sum_.place.size());
}

}  // namespace dotyk::multigrid
