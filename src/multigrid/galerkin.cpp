#include "multigrid/galerkin.hpp"

#include <algorithm>
#include <array>
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

/// Whether the rows first … first + count − 1 have the same columns.
bool are_alike(const LocalRows& A, int first, int count) {
  const auto alike = [&](const RowsView& part) {
    const auto columns = [&](int row) { return std::span(part.columns + part.starts[row], part.columns + part.starts[row + 1]); };
    for (int row = first + 1; row < first + count; ++row)
      if (!std::ranges::equal(columns(first), columns(row))) return false;
    return true;
  };
  return alike(*A.own) && (!A.other || alike(*A.other));
}

/// 1 for each pair of a node of the rows and one of the columns that have entries.
OwnedMat of_nodes(Mat matrix) {
  const BlockSize size(matrix);
  const LocalRows view(matrix);
  Rows nodes;
  std::vector<int> met;
  for (int first = 0; first < view.count(); first += size.rows) {
    met.clear();
    for (int row = first, end = first + (are_alike(view, first, size.rows) ? 1 : size.rows); row < end; ++row)
      view.for_each(row, [&](int column, double) {
        if (met.empty() || met.back() != column / size.columns) met.push_back(column / size.columns);
      });
    std::sort(met.begin(), met.end());
    nodes.columns.insert(nodes.columns.end(), met.begin(), std::unique(met.begin(), met.end()));
    nodes.starts.push_back(static_cast<int>(nodes.columns.size()));
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
  PetscInt columns = 0;
  check(MatGetSize(coarse, nullptr, &columns));
  size_ = BlockSize(coarse).rows, fine_ = BlockSize(fine).rows;
  const bool alone = ranks_of(fine).alone();
  if (!alone) check(MatGetBrowsOfAcols(fine, interpolation, MAT_INITIAL_MATRIX, rows_.put(), columns_.put(), reached_.put()));
  const LocalRows A(fine);
  const RowsView P(alone ? interpolation : Mat(reached_));
  own_ = A.count() / fine_;
  below_ = alone ? 0 : static_cast<int>(std::lower_bound(A.others, A.others + A.others_count, A.first_column) - A.others);
  for (int o = 0; o < A.others_count; ++o) {
    if (o == 0 || A.others[o] / fine_ != A.others[o - 1] / fine_) other_first_.push_back(o);
    other_node_.push_back(own_ + static_cast<int>(other_first_.size()) - 1);
  }
  other_first_.push_back(A.others_count);
  for (int node = 0; node < own_; ++node) alike_.push_back(are_alike(A, node * fine_, fine_));
  const auto for_each = [&](auto&& work) {  // block of each own row, with the place of its first entry
    for (int i = below_; i < below_ + A.count(); ++i)
      for (int k = P.starts[i]; k < P.starts[i + 1]; ++k)
        if (k == P.starts[i] || P.columns[k] / size_ != P.columns[k - 1] / size_) work(P.columns[k] / size_, i, k);
  };
  const int blocks = columns / size_;
  support_ = Buckets(blocks, [&](auto&& put) { for_each([&](int block, int row, int) { put(block, row); }); });
  first_ = Buckets(blocks, [&](auto&& put) { for_each([&](int block, int, int place) { put(block, place); }); });
  entries_.assign(static_cast<std::size_t>(fine_ * size_), 0.0);
  product_.place.assign(static_cast<std::size_t>(own_) + other_first_.size() - 1, -1);
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

/// Adds A_ki P_iJ to product_ for rows of one fine node i that have the same columns; P_iJ is in entries_. Most often each row of P_iJ has one entry.
template <int rows_of_node, int columns>
void Galerkin::add_rows(std::span<const int> rows, const LocalRows& A) {
  const int n = rows_of_node > 0 ? rows_of_node : fine_, m = columns > 0 ? columns : size_;
  struct Factor {
    const double* of_row;
    int member;
    double number;
  };
  const auto add_part = [&](const RowsView& part, auto&& node_of) {
    std::array<Factor, 3> factors;
    std::size_t count = 0;
    for (const int row : rows)
      for (int r = 0; r < m; ++r)
        if (const double number = entries_[row % n * m + r]; number != 0 && count++ < factors.size()) factors[count - 1] = {part.values + part.starts[row], r, number};
    if (count == 0) return;  // as truncated rows are
    const int begin = part.starts[rows[0]], length = part.starts[rows[0] + 1] - begin;
    double* of_node = nullptr;
    for (int at = 0, last = -1; at < length; ++at) {
      const auto [node, member] = node_of(part.columns[begin + at]);
      if (node != last) of_node = product_.at(last = node, n * m);
      double* to = of_node + member * m;
      if (count == 3) {  // the usual number, a constant for the compiler
        for (int e = 0; e < 3; ++e) to[factors[e].member] += factors[e].of_row[at] * factors[e].number;
      } else if (count < 3) {
        for (std::size_t e = 0; e < count; ++e) to[factors[e].member] += factors[e].of_row[at] * factors[e].number;
      } else {
        for (const int row : rows) {
          const double factor = part.values[part.starts[row] + at], *numbers = entries_.data() + row % n * m;
          for (int r = 0; r < m; ++r) to[r] += factor * numbers[r];
        }
      }
    }
  };
  add_part(*A.own, [&](int column) { return std::pair(column / n, column % n); });
  if (A.other) add_part(*A.other, [&](int column) { return std::pair(other_node_[column], A.others[column] % n); });
}

/// Adds P_kᵀ (A P)_kJ to sum_, for all fine nodes k in product_. Then product_ is empty.
template <int columns>
void Galerkin::add_product(const LocalRows& A, const RowsView& P) {
  const int m = columns > 0 ? columns : size_;
  const auto add = [&](int row, const double* from) {
    for (int k = P.starts[row]; k < P.starts[row + 1]; ++k) {
      double* to = sum_.at(P.columns[k], m);
      for (int r = 0; r < m; ++r) to[r] += P.values[k] * from[r];
    }
  };
  for (std::size_t p = 0; p < product_.rows.size(); ++p) {
    const double* from = product_.numbers.data() + p * static_cast<std::size_t>(fine_ * m);
    const int node = product_.rows[p];
    if (node < own_) {
      for (int member = 0; member < fine_; ++member) add(below_ + node * fine_ + member, from + member * m);
    } else {
      for (int o = other_first_[node - own_]; o < other_first_[node - own_ + 1]; ++o) add(o < below_ ? o : o + A.own_columns, from + A.others[o] % fine_ * m);
    }
  }
  product_.clear();
}

template <int rows_of_node, int columns>
void Galerkin::compute_block(int block, const LocalRows& A, const RowsView& P) {
  const int n = rows_of_node > 0 ? rows_of_node : fine_, m = columns > 0 ? columns : size_;
  const auto rows = support_[block], first = first_[block];
  std::vector<int> of_node;
  for (std::size_t s = 0; s < rows.size();) {
    const int node = (rows[s] - below_) / n;
    std::fill(entries_.begin(), entries_.end(), 0.0);
    of_node.clear();
    for (; s < rows.size() && (rows[s] - below_) / n == node; ++s) {
      const int row = rows[s] - below_;
      of_node.push_back(row);
      for (int k = first[s]; k < P.starts[rows[s] + 1] && P.columns[k] / m == block; ++k) entries_[row % n * m + P.columns[k] - block * m] = P.values[k];
    }
    if (alike_[node]) add_rows<rows_of_node, columns>(of_node, A);
    else
      for (const int row : of_node) add_rows<rows_of_node, columns>(std::span(&row, 1), A);
  }
  add_product<columns>(A, P);
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
      if (fine_ == 3 && size_ == 3) compute_block<3, 3>(b, A, P);
      else if (size_ == 6) compute_block<0, 6>(b, A, P);
      else compute_block<0, 0>(b, A, P);
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
  return static_cast<double>(support_.bytes() + first_.bytes() + alike_.size()) +
         4.0 * static_cast<double>(product_.place.size() + sum_.place.size() + other_node_.size() + other_first_.size());
}

}  // namespace dotyk::multigrid
