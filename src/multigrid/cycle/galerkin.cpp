#include "multigrid/cycle/galerkin.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace dotyk::multigrid {

Galerkin::Galerkin(const HalfMatrix& fine, Mat interpolation)
    : size_(BlockSize(interpolation).columns), fine_(fine.block()), asked_(fine.asked()),
      fine_nodes_(fine.nodes() + static_cast<int>(fine.others().size())) {
  PetscInt columns = 0, first = 0, end = 0;
  check(MatGetSize(interpolation, nullptr, &columns));
  check(MatGetOwnershipRangeColumn(interpolation, &first, &end));
  first_own_ = first / size_, own_blocks_ = (end - first) / size_;
  firsts_ = fine.ranks().gather(first_own_);
  fetch(interpolation);
  const LocalRows own(interpolation);
  const ReachedRows P = reached(*own.own);
  const auto for_each = [&](auto&& work) {  // block of each own row, with the place of its first entry
    for (int i = 0; i < fine.rows(); ++i)
      for (int k = P.starts[i]; k < P.starts[i + 1]; ++k)
        if (k == P.starts[i] || P.columns[k] / size_ != P.columns[k - 1] / size_) work(P.columns[k] / size_, i, k);
  };
  const int blocks = columns / size_;
  support_ = Buckets(blocks, [&](auto&& put) { for_each([&](int block, int row, int) { put(block, row); }); });
  first_ = Buckets(blocks, [&](auto&& put) { for_each([&](int block, int, int place) { put(block, place); }); });
  entries_.assign(static_cast<std::size_t>(fine_ * size_), 0.0);
  product_ = SomeRows(fine_nodes_, fine_ * size_);
  sum_ = SomeRows(blocks, size_ * size_);
}

Galerkin::ReachedRows Galerkin::reached(const RowsView& own) const {
  if (asked_.empty()) return {own.starts, own.columns, own.values};
  return {reached_.starts.data(), reached_.columns.data(), reached_.values.data()};
}

void Galerkin::fetch(Mat interpolation) {
  const LocalRows P(interpolation);
  if (!asked_.empty()) fetch_rows(ranks_of(interpolation), P);
  find_multiples(reached(*P.own));
}

void Galerkin::fetch_rows(const Ranks& ranks, const LocalRows& P) {
  reached_.starts.assign(1, 0), reached_.columns.clear(), reached_.values.clear();
  for (int i = 0; i < P.count(); ++i) {
    P.for_each(i, [&](int column, double value) { reached_.columns.push_back(column), reached_.values.push_back(value); });
    reached_.starts.push_back(counted(reached_.columns.size()));
  }
  std::vector<std::vector<int>> columns(asked_.size());  // of each row their number, and they
  std::vector<std::vector<double>> values(asked_.size());
  for (std::size_t rank = 0; rank < asked_.size(); ++rank)
    for (const int node : asked_[rank])
      for (int i = node * fine_; i < (node + 1) * fine_; ++i) {
        const int begin = reached_.starts[i], end = reached_.starts[i + 1];
        columns[rank].push_back(end - begin);
        columns[rank].insert(columns[rank].end(), reached_.columns.begin() + begin, reached_.columns.begin() + end);
        values[rank].insert(values[rank].end(), reached_.values.begin() + begin, reached_.values.begin() + end);
      }
  for (const std::vector<int>& in : ranks.exchange(columns))
    for (auto at = in.begin(); at != in.end();) {
      const int count = *at++;
      reached_.columns.insert(reached_.columns.end(), at, at + count), at += count;
      reached_.starts.push_back(counted(reached_.columns.size()));
    }
  for (const std::vector<double>& in : ranks.exchange(values)) reached_.values.insert(reached_.values.end(), in.begin(), in.end());
}

HalfMatrix Galerkin::pattern(const HalfMatrix& fine, Mat interpolation) const {
  const LocalRows own_rows(interpolation);
  const ReachedRows P = reached(*own_rows.own);
  std::vector<int> row;
  Rows parents;  // of each fine node that is reached, as HalfMatrix counts them
  for (int node = 0; node < fine_nodes_; ++node) {
    const int begin = P.starts[node * fine_], end = P.starts[(node + 1) * fine_];
    for (int k = begin; k < end; ++k)
      if (k == begin || P.columns[k] / size_ != P.columns[k - 1] / size_) row.push_back(P.columns[k] / size_);
    parents.append_columns(row);
  }
  std::vector<std::vector<int>> out(firsts_.size()), own(static_cast<std::size_t>(own_blocks_));
  std::vector<int> met(static_cast<std::size_t>(support_.count()), -1);  // by coarse node: the last block that it was met from
  for (int block = 0; block < support_.count(); ++block) {
    row.clear();
    for (int before = -1; const int i : support_[block]) {
      const int node = i / fine_;
      if (std::exchange(before, node) == node) continue;
      fine.each_block(node, [&](int other, const double*, HalfMatrix::Read) {
        for (int k = parents.starts[other]; k < parents.starts[other + 1]; ++k)
          if (const int parent = parents.columns[k]; std::exchange(met[parent], block) != block) row.push_back(parent);
      });
    }
    if (mine(block)) {
      own[block - first_own_] = row;
    } else if (!row.empty()) {
      std::vector<int>& to = out[rank_with(firsts_, block)];
      to.push_back(counted(row.size())), to.push_back(block), to.insert(to.end(), row.begin(), row.end());
    }
  }
  if (!fine.ranks().alone())
    for (const std::vector<int>& in : fine.ranks().exchange(out))
      for (auto at = in.begin(); at != in.end();) {
        const int count = *at++;
        std::vector<int>& to = own[*at++ - first_own_];
        to.insert(to.end(), at, at + count), at += count;
      }
  Rows nodes;
  for (std::vector<int>& of : own) nodes.append_columns(of);
  HalfMatrix C(fine.ranks(), HalfRows(size_, first_own_, nodes));
  for (int i = 0; i < C.rows(); ++i) C.diagonal(i) = 1;
  return C;
}

void Galerkin::find_multiples(const ReachedRows& P) {
  multiples_.assign(static_cast<std::size_t>(fine_nodes_), 0);
  if (fine_ != size_) return;
  const auto equal = [&](int row, int r) {
    const int begin = P.starts[row], at = P.starts[row + r], count = P.starts[row + 1] - begin;
    if (P.starts[row + r + 1] - at != count) return false;
    for (int k = 0; k < count; ++k)
      if (P.columns[begin + k] % size_ != 0 || P.columns[at + k] != P.columns[begin + k] + r || P.values[at + k] != P.values[begin + k]) return false;
    return true;
  };
  for (std::size_t node = 0; node < multiples_.size(); ++node) {
    multiples_[node] = 1;
    for (int r = 1; r < fine_ && multiples_[node]; ++r) multiples_[node] = equal(static_cast<int>(node) * fine_, r);
  }
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

/// The same where P_iJ is a multiple of the identity.
template <int columns>
void Galerkin::add_scaled(int node, double factor, const HalfMatrix& A) {
  const int n = columns > 0 ? columns : size_;
  if (factor == 0) return;
  A.each_block(node, [&](int other, const double* block, HalfMatrix::Read read) {
    double* to = product_.at(other);
    if (read == HalfMatrix::Read::transposed)
      for (int k = 0; k < n * n; ++k) to[k] += factor * block[k];
    else
      for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c) to[c * n + r] += factor * block[r * n + c];
  });
}

/// Adds P_kᵀ (A P)_kJ to sum_, for all fine nodes k in product_. Then product_ is empty.
template <int columns>
void Galerkin::add_product(const ReachedRows& P) {
  const int m = columns > 0 ? columns : size_;
  for (std::size_t p = 0; p < product_.rows().size(); ++p) {
    const int node = product_.rows()[p], first = node * fine_;
    const double* from = product_.numbers(p);
    if (multiples_[node]) {
      for (int k = P.starts[first]; k < P.starts[first + 1]; ++k) {
        double* to = sum_.at(P.columns[k] / m);
        for (int r = 0; r < m * m; ++r) to[r] += P.values[k] * from[r];
      }
      continue;
    }
    for (int row = first; row < first + fine_; ++row, from += m)
      for (int k = P.starts[row]; k < P.starts[row + 1]; ++k) {
        double* to = sum_.at(P.columns[k] / m) + P.columns[k] % m * m;
        for (int r = 0; r < m; ++r) to[r] += P.values[k] * from[r];
      }
  }
  product_.clear();
}

template <int rows_of_node, int columns>
void Galerkin::compute_block(int block, const HalfMatrix& A, const ReachedRows& P) {
  const int n = rows_of_node > 0 ? rows_of_node : fine_, m = columns > 0 ? columns : size_;
  const auto rows = support_[block], first = first_[block];
  for (std::size_t s = 0; s < rows.size();) {
    const int node = rows[s] / n;
    if (multiples_[node]) {
      add_scaled<columns>(node, P.values[first[s]], A);
      s += static_cast<std::size_t>(n);
      continue;
    }
    std::fill(entries_.begin(), entries_.end(), 0.0);
    for (; s < rows.size() && rows[s] / n == node; ++s)
      for (int k = first[s]; k < P.starts[rows[s] + 1] && P.columns[k] / m == block; ++k) entries_[rows[s] % n * m + P.columns[k] - block * m] = P.values[k];
    add_node<rows_of_node, columns>(node, A);
  }
  add_product<columns>(P);
}

void Galerkin::put_block(int block, HalfMatrix& C) {
  C.each_own_block(block - C.first_row() / size_, [&](int other, double* numbers) {
    const double* computed = sum_.at(C.number(other));
    for (int c = 0; c < size_; ++c)
      for (int r = 0; r < size_; ++r) numbers[r * size_ + c] = computed[c * size_ + r];
  });
}

void Galerkin::append_block(int block, int rank, Outgoing& out) {
  const std::vector<int>& nodes = sum_.rows();
  out.nodes[rank].push_back(counted(nodes.size()));
  out.nodes[rank].push_back(block);
  out.nodes[rank].insert(out.nodes[rank].end(), nodes.begin(), nodes.end());
  for (std::size_t k = 0; k < nodes.size(); ++k) out.numbers[rank].insert(out.numbers[rank].end(), sum_.numbers(k), sum_.numbers(k) + size_ * size_);
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

std::vector<char> Galerkin::compute(const HalfMatrix& fine, Mat interpolation, HalfMatrix& coarse, const std::vector<char>& changed) {
  const Ranks& ranks = coarse.ranks();
  std::vector<char> due(static_cast<std::size_t>(support_.count()), 0), computed(static_cast<std::size_t>(coarse.rows()), 0);
  for (int b = 0; b < support_.count(); ++b) due[b] = std::ranges::any_of(support_[b], [&](int i) { return changed[i]; });
  if (!ranks.alone()) MPI_Allreduce(MPI_IN_PLACE, due.data(), counted(due.size()), MPI_BYTE, MPI_BOR, ranks.comm());
  Outgoing out{std::vector<std::vector<int>>(firsts_.size()), std::vector<std::vector<double>>(firsts_.size())};
  const LocalRows own_rows(interpolation);
  const ReachedRows P = reached(*own_rows.own);
  for (int b = 0; b < support_.count(); ++b) {
    if (!due[b] || (!mine(b) && support_[b].empty())) continue;
    if (fine_ == 3 && size_ == 3) compute_block<3, 3>(b, fine, P);
    else if (size_ == 6) compute_block<0, 6>(b, fine, P);
    else compute_block<0, 0>(b, fine, P);
    if (mine(b)) {
      put_block(b, coarse);
      std::fill_n(computed.begin() + b * size_ - coarse.first_row(), size_, char(1));
    } else {
      append_block(b, rank_with(firsts_, b), out);
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
