#include "multigrid/galerkin.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace dotyk::multigrid {

namespace {

OwnedMat ones(const Ranks& ranks, Rows& rows, int own_columns) {
  rows.values.assign(rows.columns.size(), 1.0);
  return copied(ranks, rows, own_columns);
}

/// 1 for each pair of nodes that A couples.
OwnedMat of_nodes(const HalfMatrix& A) {
  Rows nodes;
  std::vector<int> row;
  for (int node = 0; node < A.nodes(); ++node) {
    A.each_block(node, [&](int other, const double*, HalfMatrix::Read) { row.push_back(A.number(other)); });
    nodes.append_columns(row);
  }
  return ones(A.ranks(), nodes, A.nodes());
}

/// 1 for each pair of a node of the rows and one of the columns that have entries.
OwnedMat of_nodes(Mat interpolation) {
  const BlockSize size(interpolation);
  const LocalRows view(interpolation);
  Rows nodes;
  std::vector<int> row;
  for (int first = 0; first < view.count(); first += size.rows) {
    for (int r = first; r < first + size.rows; ++r) view.for_each(r, [&](int column, double) { row.push_back(column / size.columns); });
    nodes.append_columns(row);
  }
  return ones(ranks_of(interpolation), nodes, view.own_columns / size.columns);
}

}  // namespace

HalfMatrix coarse_matrix(const HalfMatrix& A, Mat P) {
  const OwnedMat fine = of_nodes(A), interpolation = of_nodes(P);
  OwnedMat pairs;
  check(MatPtAP(fine, interpolation, MAT_INITIAL_MATRIX, PETSC_DEFAULT, pairs.put()));
  Rows nodes;
  std::vector<int> row;
  const LocalRows view(pairs);
  for (int i = 0; i < view.count(); ++i) {
    view.for_each(i, [&](int other, double) { row.push_back(other); });
    nodes.append_columns(row);
  }
  HalfMatrix C(A.ranks(), HalfRows(BlockSize(P).columns, view.first_row, nodes));
  for (int i = 0; i < C.rows(); ++i) C.diagonal(i) = 1;
  return C;
}

Galerkin::Galerkin(const HalfMatrix& fine, Mat interpolation, const HalfMatrix& coarse) : size_(coarse.block()), fine_(fine.block()), own_(fine.nodes()) {
  const Ranks& ranks = fine.ranks();
  PetscInt columns = 0;
  check(MatGetSize(interpolation, nullptr, &columns));
  firsts_ = ranks.gather(coarse.first_row() / size_);
  if (!ranks.alone()) {
    const std::vector<int>& others = fine.others();
    below_ = static_cast<int>(std::ranges::lower_bound(others, fine.first_row() / fine_) - others.begin());
    std::vector<PetscInt> rows;
    const auto add = [&](int node) {
      for (int r = 0; r < fine_; ++r) rows.push_back(node * fine_ + r);
    };
    for (int o = 0; o < below_; ++o) add(others[o]);
    for (int node = 0; node < own_; ++node) add(fine.number(node));
    for (std::size_t o = static_cast<std::size_t>(below_); o < others.size(); ++o) add(others[o]);
    check(ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(rows.size()), rows.data(), PETSC_COPY_VALUES, rows_.put()));
    check(ISCreateStride(PETSC_COMM_SELF, columns, 0, 1, columns_.put()));
    const IS some = rows_, all = columns_;
    check(MatCreateSubMatrices(interpolation, 1, &some, &all, MAT_INITIAL_MATRIX, reached_.put()));
  }
  const RowsView P(reached_ ? *reached_ : interpolation);
  const auto for_each = [&](auto&& work) {  // block of each own row, with the place of its first entry
    for (int i = reached_row(0); i < reached_row(0) + fine.rows(); ++i)
      for (int k = P.starts[i]; k < P.starts[i + 1]; ++k)
        if (k == P.starts[i] || P.columns[k] / size_ != P.columns[k - 1] / size_) work(P.columns[k] / size_, i, k);
  };
  const int blocks = columns / size_;
  support_ = Buckets(blocks, [&](auto&& put) { for_each([&](int block, int row, int) { put(block, row); }); });
  first_ = Buckets(blocks, [&](auto&& put) { for_each([&](int block, int, int place) { put(block, place); }); });
  entries_.assign(static_cast<std::size_t>(fine_ * size_), 0.0);
  product_ = SomeRows(own_ + static_cast<int>(fine.others().size()), fine_ * size_);
  sum_ = SomeRows(columns, size_);
}

int Galerkin::reached_row(int node) const {
  if (node < own_) return (below_ + node) * fine_;
  const int other = node - own_;
  return (other < below_ ? other : other + own_) * fine_;
}

/// Adds A_ki P_iJ to product_ for the nodes k that A couples to a fine node i; P_iJ is in entries_. Most often each row of P_iJ has one entry.
template <int rows_of_node, int columns>
void Galerkin::add_node(int node, const HalfMatrix& A) {
  const int n = rows_of_node > 0 ? rows_of_node : fine_, m = columns > 0 ? columns : size_;
  struct Factor {
    int row, column;
    double number;
  };
  std::array<Factor, kMostRows * kMostRows> factors;
  int count = 0;
  for (int r = 0; r < n; ++r)
    for (int q = 0; q < m; ++q)
      if (const double number = entries_[r * m + q]; number != 0) factors[count++] = {r, q, number};
  if (count == 0) return;  // as truncated rows are
  A.each_block(node, [&](int other, const double* block, HalfMatrix::Read read) {
    double* to = product_.at(other);
    for (int f = 0; f < count; ++f) {
      const auto [r, q, number] = factors[f];
      for (int c = 0; c < n; ++c) to[c * m + q] += A.entry(block, read, r, c) * number;
    }
  });
}

/// Adds P_kᵀ (A P)_kJ to sum_, for all fine nodes k in product_. Then product_ is empty.
template <int columns>
void Galerkin::add_product(const RowsView& P) {
  const int m = columns > 0 ? columns : size_;
  for (std::size_t p = 0; p < product_.rows().size(); ++p)
    for (int member = 0; member < fine_; ++member) {
      const int row = reached_row(product_.rows()[p]) + member;
      const double* from = product_.numbers(p) + member * m;
      for (int k = P.starts[row]; k < P.starts[row + 1]; ++k) {
        double* to = sum_.at(P.columns[k]);
        for (int r = 0; r < m; ++r) to[r] += P.values[k] * from[r];
      }
    }
  product_.clear();
}

template <int rows_of_node, int columns>
void Galerkin::compute_block(int block, const HalfMatrix& A, const RowsView& P) {
  const int n = rows_of_node > 0 ? rows_of_node : fine_, m = columns > 0 ? columns : size_;
  const auto rows = support_[block], first = first_[block];
  for (std::size_t s = 0; s < rows.size();) {
    const int node = rows[s] / n - below_;
    std::fill(entries_.begin(), entries_.end(), 0.0);
    for (; s < rows.size() && rows[s] / n - below_ == node; ++s)
      for (int k = first[s]; k < P.starts[rows[s] + 1] && P.columns[k] / m == block; ++k) entries_[rows[s] % n * m + P.columns[k] - block * m] = P.values[k];
    add_node<rows_of_node, columns>(node, A);
  }
  add_product<columns>(P);
}

void Galerkin::put_block(int block, HalfMatrix& C) {
  C.each_own_block(block - C.first_row() / size_, [&](int other, double* numbers) {
    for (int c = 0; c < size_; ++c) {
      const double* computed = sum_.at(C.number(other) * size_ + c);
      for (int r = 0; r < size_; ++r) numbers[r * size_ + c] = computed[r];
    }
  });
}

void Galerkin::append_block(int block, int rank, Outgoing& out) {
  std::vector<int> nodes;
  for (const int column : sum_.rows()) nodes.push_back(column / size_);
  std::ranges::sort(nodes);
  nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
  out.nodes[rank].push_back(static_cast<int>(nodes.size()));
  out.nodes[rank].push_back(block);
  out.nodes[rank].insert(out.nodes[rank].end(), nodes.begin(), nodes.end());
  for (const int node : nodes)
    for (int c = 0; c < size_; ++c) {
      const double* computed = sum_.at(node * size_ + c);
      out.numbers[rank].insert(out.numbers[rank].end(), computed, computed + size_);
    }
}

void Galerkin::add(const Outgoing& in, HalfMatrix& C) const {
  for (std::size_t rank = 0; rank < in.nodes.size(); ++rank) {
    const double* number = in.numbers[rank].data();
    for (auto at = in.nodes[rank].begin(); at != in.nodes[rank].end();) {
      const int count = *at++, row = *at++ * size_ - C.first_row();
      for (const auto end = at + count; at != end; ++at)
        for (int c = 0; c < size_; ++c)
          for (int r = 0; r < size_; ++r, ++number) {
            const int column = *at * size_ + c;
            if (*number == 0 || (C.has(column) && *at * size_ > C.first_row() + row)) continue;
            double* sum = C.find(row + r, column);
            if (!sum) throw std::runtime_error("multigrid: a coarse matrix has another pattern than that of the product");
            *sum += *number;
          }
    }
  }
}

void Galerkin::fetch(Mat interpolation) {
  if (!reached_) return;
  const IS some = rows_, all = columns_;
  check(MatCreateSubMatrices(interpolation, 1, &some, &all, MAT_REUSE_MATRIX, reached_.put()));
}

std::vector<char> Galerkin::compute(const HalfMatrix& fine, Mat interpolation, HalfMatrix& coarse, const std::vector<char>& changed) {
  const Ranks& ranks = coarse.ranks();
  std::vector<char> due(static_cast<std::size_t>(support_.count()), 0), computed(static_cast<std::size_t>(coarse.rows()), 0);
  for (int b = 0; b < support_.count(); ++b) due[b] = std::ranges::any_of(support_[b], [&](int i) { return changed[i - reached_row(0)]; });
  if (!ranks.alone()) MPI_Allreduce(MPI_IN_PLACE, due.data(), static_cast<int>(due.size()), MPI_BYTE, MPI_BOR, ranks.comm());
  Outgoing out{std::vector<std::vector<int>>(firsts_.size()), std::vector<std::vector<double>>(firsts_.size())};
  const RowsView P(reached_ ? *reached_ : interpolation);
  for (int b = 0; b < support_.count(); ++b) {
    const bool mine = coarse.has(b * size_);
    if (!due[b] || (!mine && support_[b].empty())) continue;
    if (fine_ == 3 && size_ == 3) compute_block<3, 3>(b, fine, P);
    else if (size_ == 6) compute_block<0, 6>(b, fine, P);
    else compute_block<0, 0>(b, fine, P);
    if (mine) {
      put_block(b, coarse);
      std::fill_n(computed.begin() + b * size_ - coarse.first_row(), size_, char(1));
    } else {
      append_block(b, static_cast<int>(std::ranges::upper_bound(firsts_, b) - firsts_.begin()) - 1, out);
    }
    sum_.clear();
  }
  if (!ranks.alone()) add({ranks.exchange(out.nodes), ranks.exchange(out.numbers)}, coarse);
  return computed;
}

double Galerkin::bytes() const {
  return static_cast<double>(support_.bytes() + first_.bytes()) + product_.bytes() + sum_.bytes();
}

}  // namespace dotyk::multigrid
