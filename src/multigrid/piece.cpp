#include "multigrid/piece.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace dotyk::multigrid {

namespace {

/// Rows first … last − 1 of one level.
struct Range {
  int first, last;
  bool has(int row) const { return row >= first && row < last; }
  int count() const { return last - first; }
};

Range range_of(int rank, const Numbering& numbering, int level) { return {numbering.first(level)[rank], numbering.first(level)[rank + 1]}; }

void sort_rows(Rows& rows) {
  std::vector<std::pair<int, double>> row;
  for (std::size_t i = 0; i + 1 < rows.starts.size(); ++i) {
    const int begin = rows.starts[i], end = rows.starts[i + 1];
    if (std::is_sorted(rows.columns.begin() + begin, rows.columns.begin() + end)) continue;
    row.clear();
    for (int k = begin; k < end; ++k) row.emplace_back(rows.columns[k], rows.values[k]);
    std::sort(row.begin(), row.end());
    for (int k = begin; k < end; ++k) std::tie(rows.columns[k], rows.values[k]) = row[k - begin];
  }
}

/// Mean of the diagonal. Throws where that is not positive, or no lower triangle's.
double mean_diagonal(const algebra::SparseMatrix& lower) {
  const int* begin = lower.outerIndexPtr();
  double sum = 0;
  for (int j = 0; j < lower.cols(); ++j) {
    const bool has = begin[j] < begin[j + 1] && lower.innerIndexPtr()[begin[j]] == j;
    if (!has || !(lower.valuePtr()[begin[j]] > 0)) throw std::runtime_error("multigrid: the matrix is no lower triangle, or its diagonal is not positive");
    sum += lower.valuePtr()[begin[j]];
  }
  return sum / static_cast<double>(lower.cols());
}

/// The rows of `from` whose new numbers are in the range, with new numbers of columns.
Rows some_rows(const algebra::SparseRows& from, const std::vector<int>& row_number, const std::vector<int>& column_number, const Range& range,
               const std::vector<int>& idle = {}) {
  std::vector<int> origin(static_cast<std::size_t>(range.count()), -1);  // row of `from`
  for (int i = 0; i < from.rows(); ++i)
    if (const int row = row_number[i]; range.has(row)) origin[row - range.first] = i;
  std::vector<char> is_idle(origin.size(), 0);
  for (const int i : idle)
    if (range.has(i)) is_idle[i - range.first] = 1;
  Rows rows;
  for (int r = 0; r < range.count(); ++r) {
    if (origin[r] >= 0)
      for (algebra::SparseRows::InnerIterator it(from, origin[r]); it; ++it) {
        rows.columns.push_back(column_number[it.col()]);
        rows.values.push_back(it.value());
      }
    if (is_idle[r]) rows.columns.push_back(range.first + r), rows.values.push_back(1.0);
    rows.starts.push_back(static_cast<int>(rows.columns.size()));
  }
  sort_rows(rows);
  return rows;
}

std::vector<double> some_modes(const algebra::DenseMatrix& modes, const std::vector<int>& number, const Range& range) {
  std::vector<double> some(static_cast<std::size_t>(range.count() * modes.cols()), 0.0);
  for (Eigen::Index i = 0; i < modes.rows(); ++i)
    if (range.has(number[i]))
      for (Eigen::Index k = 0; k < modes.cols(); ++k) some[k * range.count() + number[i] - range.first] = modes(i, k);
  return some;
}

template <class Visit>
void visit_rows(Rows& rows, Visit&& visit) {
  visit(rows.starts), visit(rows.columns), visit(rows.values);
}

/// Calls visit(list) for each list of numbers of a piece; a second function does so for a change.
template <class Visit>
void visit_all(Piece& p, Visit&& visit) {
  std::vector<int> sizes{p.block, p.dimension, p.motions, static_cast<int>(p.functions.size())};
  visit(sizes);
  p.block = sizes[0], p.dimension = sizes[1], p.motions = sizes[2];
  p.functions.resize(static_cast<std::size_t>(sizes[3]));
  visit(p.own);
  for (HalfRows* rows : {&p.matrix, &p.coarser, &p.displaced}) {
    std::vector<int> numbers{rows->block, rows->first};
    visit(numbers);
    rows->block = numbers[0], rows->first = numbers[1];
    visit(rows->starts), visit(rows->columns), visit(rows->below), visit(rows->diagonal), visit(rows->other_starts), visit(rows->others), visit(rows->other);
  }
  for (Rows& functions : p.functions) visit_rows(functions, visit);
  visit_rows(p.unknowns, visit);
  visit(p.modes);
}

template <class Visit>
void visit_all(Change& c, Visit&& visit) {
  visit(c.rows), visit(c.columns), visit(c.values), visit(c.empty), visit(c.shared);
}

template <class Whole>
Whole receive_whole(const Ranks& ranks, int from) {
  Whole whole;
  visit_all(whole, [&](auto& numbers) { ranks.receive(from, numbers); });
  return whole;
}

}  // namespace

bool aggregates_follow(double coarsest_unknowns, double finest_unknowns) { return coarsest_unknowns > std::clamp(std::sqrt(500 * finest_unknowns), 2e3, 25e3); }

Pieces::Pieces(const Matrix& matrix, const Numbering& numbering) : matrix_(matrix), numbering_(numbering) {
  if (!matrix.lower.isCompressed() || static_cast<std::size_t>(matrix.lower.rows()) != matrix.node.size())
    throw std::runtime_error("multigrid: the matrix is not compressed, or nodes are not given for each unknown");
  finest_ = source(matrix.lower, numbering.slot(), numbering.idle());
  if (matrix.coarser) coarser_ = coarser();
  const int meshes = matrix.coarse ? static_cast<int>(matrix.coarse->size()) : 0;
  if (meshes == 0 || aggregates_follow(numbering.first(meshes).back(), numbering.first(0).back())) near_kernel_ = matrix.near_kernel();
  if (!matrix.displaced) return;
  if (matrix.coarse) mean_diagonal(*matrix.displaced);
  else displaced_ = source(*matrix.displaced, numbering.slot(), numbering.idle());
}

Pieces::Source Pieces::source(const algebra::SparseMatrix& lower, std::vector<int> slot, std::vector<int> idle) {
  return {&lower, std::move(slot), std::move(idle), mean_diagonal(lower)};
}

Pieces::Source Pieces::coarser() const {
  const algebra::SparseRows& functions = matrix_.coarse->front();
  std::vector<char> used(static_cast<std::size_t>(functions.cols()), 0);
  for (int i = 0; i < functions.rows(); ++i)
    for (algebra::SparseRows::InnerIterator it(functions, i); it; ++it) used[it.col()] = 1;
  std::vector<int> slot, idle;
  for (std::size_t k = 0; k < used.size(); ++k) (used[k] ? slot : idle).push_back(numbering_.functions(1)[k]);
  if (static_cast<std::size_t>(matrix_.coarser->rows()) != slot.size()) throw std::runtime_error("multigrid: the coarser matrix is not one of these functions");
  return source(*matrix_.coarser, std::move(slot), std::move(idle));
}

HalfRows Pieces::rows_of(int rank, const Source& source, int level, int block) const {
  if (!source.lower) return {};
  const algebra::SparseMatrix& lower = *source.lower;
  const std::vector<int>& slot = source.slot;
  const Range range = range_of(rank, numbering_, level);
  return half_rows(block, range.first / block, range.count() / block, [&](auto&& visit) {
    for (int j = 0; j < lower.cols(); ++j) {
      const int column = slot[j];
      for (int k = lower.outerIndexPtr()[j]; k < lower.outerIndexPtr()[j + 1]; ++k)
        if (const int row = slot[lower.innerIndexPtr()[k]]; range.has(row) || range.has(column)) visit(row, column, lower.valuePtr()[k]);
    }
    for (const int i : source.idle)
      if (range.has(i)) visit(i, i, source.mean);
  });
}

Piece Pieces::of(int rank) const {
  const int meshes = matrix_.coarse ? static_cast<int>(matrix_.coarse->size()) : 0;
  Piece p;
  p.block = numbering_.block(), p.dimension = matrix_.dimension, p.motions = static_cast<int>(near_kernel_.cols());
  for (int l = 0; l <= meshes; ++l) p.own.push_back(range_of(rank, numbering_, l).count());
  for (int l = 0; l < meshes; ++l)
    p.functions.push_back(some_rows((*matrix_.coarse)[l], l == 0 ? numbering_.slot() : numbering_.functions(l), numbering_.functions(l + 1),
                                    range_of(rank, numbering_, l)));
  if (matrix_.unknowns) p.unknowns = some_rows(*matrix_.unknowns, numbering_.slot(), numbering_.slot(), range_of(rank, numbering_, 0), numbering_.idle());
  p.modes = some_modes(near_kernel_, meshes > 0 ? numbering_.functions(meshes) : numbering_.slot(), range_of(rank, numbering_, meshes));
  p.matrix = rows_of(rank, finest_, 0, p.block), p.coarser = rows_of(rank, coarser_, 1, p.dimension), p.displaced = rows_of(rank, displaced_, 0, p.block);
  return p;
}

void send(const Ranks& ranks, int to, Piece& piece) {
  visit_all(piece, [&](const auto& numbers) { ranks.send(to, numbers); });
}
Piece receive_piece(const Ranks& ranks, int from) { return receive_whole<Piece>(ranks, from); }
void send(const Ranks& ranks, int to, Change& change) {
  visit_all(change, [&](const auto& numbers) { ranks.send(to, numbers); });
}
Change receive_change(const Ranks& ranks, int from) { return receive_whole<Change>(ranks, from); }

}  // namespace dotyk::multigrid
