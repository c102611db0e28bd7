#include "multigrid/shares/piece.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "algebra/symmetric_matrix.hpp"
#include "multigrid/shares/messages.hpp"

namespace dotyk::multigrid {

namespace {

/// Rows first … last − 1 of one level.
struct Range {
  int first, last;
  bool has(int row) const { return row >= first && row < last; }
  int count() const { return last - first; }
};

Range range_of(int rank, const Numbering& numbering, int level) { return {numbering.first(level)[rank], numbering.first(level)[rank + 1]}; }

constexpr const char* kNotPositive = "multigrid: the matrix is no lower triangle, or its diagonal is not positive";

/// Mean of the diagonal. Throws where that is not positive, or no lower triangle's.
double mean_diagonal(const algebra::SparseMatrix& lower) {
  double sum = 0;
  for (int j = 0; j < lower.cols(); ++j) {
    const double* entry = algebra::diagonal_entry(lower, j);
    if (!entry || !(*entry > 0)) throw std::runtime_error(kNotPositive);
    sum += *entry;
  }
  return sum / static_cast<double>(lower.cols());
}

/// The rows of `from` that the new numbering puts into the range. Their columns get new numbers, too. Rows of the range that `from` lacks are those of the identity.
Rows some_rows(const algebra::SparseRows& from, const std::vector<int>& number, const Range& range) {
  std::vector<int> origin(static_cast<std::size_t>(range.count()), -1);  // row of `from`
  for (int i = 0; i < from.rows(); ++i)
    if (const int row = number[i]; range.has(row)) origin[row - range.first] = i;
  Rows rows;
  for (int r = 0; r < range.count(); ++r) {
    if (origin[r] >= 0)
      for (algebra::SparseRows::InnerIterator it(from, origin[r]); it; ++it) {
        rows.columns.push_back(number[it.col()]);
        rows.values.push_back(it.value());
      }
    else rows.columns.push_back(range.first + r), rows.values.push_back(1.0);
    rows.starts.push_back(counted(rows.columns.size()));
  }
  sort_entries(rows.starts.data(), 0, range.count(), rows.columns.data(), rows.values.data());
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

/// Calls visit(list) for each list that the rows consist of; the overloads below do the same for a piece and for a change.
template <class Visit>
void visit_all(HalfRows& rows, Visit&& visit) {
  std::vector<int> numbers{rows.block, rows.first};
  visit(numbers);
  rows.block = numbers[0], rows.first = numbers[1];
  visit(rows.starts), visit(rows.columns), visit(rows.below), visit(rows.diagonal), visit(rows.other_starts), visit(rows.others), visit(rows.other);
}

template <class Visit>
void visit_all(Change& c, Visit&& visit) {
  visit(c.rows), visit(c.columns), visit(c.values), visit(c.empty), visit(c.shared);
}

template <class Visit>
void visit_all(Piece& p, Visit&& visit) {
  std::vector<int> sizes{p.block, p.dimension, p.motions, p.coarser, p.slices};
  visit(sizes);
  p.block = sizes[0], p.dimension = sizes[1], p.motions = sizes[2], p.coarser = sizes[3], p.slices = sizes[4];
  visit(p.own);
  visit_all(p.matrix, visit), visit_all(p.displaced, visit), visit_all(p.beside, visit), visit_all(p.first, visit);
  visit_rows(p.unknowns, visit);
  visit(p.modes);
}

template <class Whole>
Whole receive_whole(const Ranks& ranks, int from) {
  Whole whole;
  visit_all(whole, [&](auto& numbers) { ranks.receive(from, numbers); });
  return whole;
}

}  // namespace

bool aggregates_follow(double coarsest_unknowns, double finest_unknowns) { return coarsest_unknowns > std::clamp(std::sqrt(500 * finest_unknowns), 2e3, 25e3); }

Pieces::Pieces(const Matrix& matrix, const Numbering& numbering, int ranks) : matrix_(matrix), numbering_(numbering), beside_(static_cast<std::size_t>(ranks)), first_(beside_) {
  if (!matrix.lower.isCompressed() || static_cast<std::size_t>(matrix.lower.rows()) != matrix.node.size())
    throw std::runtime_error("multigrid: the matrix is not compressed, or nodes are not given for each unknown");
  if (!matrix.slices) finest_ = source(matrix.lower);
  else if (!(matrix.slices->diagonal().minCoeff() > 0)) throw std::runtime_error(kNotPositive);
  if (matrix.beside_slices) beside_ = changes(*matrix.beside_slices, {}, {}, numbering, ranks);
  if (matrix.changed) first_ = changes(*matrix.changed, {}, {}, numbering, ranks);
  const int meshes = matrix.coarse ? static_cast<int>(matrix.coarse->size()) : 0;
  if (meshes == 0 || aggregates_follow(numbering.first(meshes).back(), numbering.first(0).back())) near_kernel_ = matrix.near_kernel();
  if (!matrix.displaced) return;
  if (matrix.coarse) mean_diagonal(*matrix.displaced);
  else displaced_ = source(*matrix.displaced);
}

Pieces::Source Pieces::source(const algebra::SparseMatrix& lower) const { return {&lower, mean_diagonal(lower)}; }

HalfRows Pieces::rows_of(int rank, const Source& source) const {
  if (!source.lower) return {};
  const int block = numbering_.block(), first = numbering_.first(0)[rank] / block, count = numbering_.first(0)[rank + 1] / block - first;
  HalfRows rows = own_rows(*source.lower, numbering_.slot(), block, first, count);
  fill_idle(rows, numbering_.idle(), source.mean);
  return rows;
}

Piece Pieces::of(int rank) {
  const int meshes = matrix_.coarse ? static_cast<int>(matrix_.coarse->size()) : 0;
  Piece p;
  p.beside = std::move(beside_[rank]), p.first = std::move(first_[rank]);
  if (meshes > 0) p.dimension = matrix_.coarse->front().dimension;
  p.block = numbering_.block(), p.motions = static_cast<int>(near_kernel_.cols());
  for (int l = 0; l <= meshes; ++l) p.own.push_back(range_of(rank, numbering_, l).count());
  if (!matrix_.slices) p.functions = own_functions(meshes > 0 ? *matrix_.coarse : std::vector<algebra::CoarseFunctions>(), numbering_, rank);
  if (matrix_.unknowns) p.unknowns = some_rows(*matrix_.unknowns, numbering_.slot(), range_of(rank, numbering_, 0));
  p.modes = some_modes(near_kernel_, meshes > 0 ? numbering_.functions(meshes) : numbering_.slot(), range_of(rank, numbering_, meshes));
  p.matrix = rows_of(rank, finest_), p.displaced = rows_of(rank, displaced_);
  return p;
}

void send(const Ranks& ranks, int to, Piece& piece) {
  visit_all(piece, [&](const auto& numbers) { ranks.send(to, numbers); });
  if (!piece.slices) send(ranks, to, piece.functions);
}
Piece receive_piece(const Ranks& ranks, int from) {
  auto piece = receive_whole<Piece>(ranks, from);
  if (!piece.slices) piece.functions = receive_own_functions(ranks, from);
  return piece;
}
void take_matrix(Piece& piece, const Slice& slice) {
  piece.functions = slice.functions(), piece.load = slice.load();
  if (piece.functions->size() + 1 < piece.own.size()) throw std::logic_error("multigrid: slices of fewer coarser meshes than the solver is to have");
  piece.lent = slice.lend();
  if (!piece.lent) piece.matrix = slice.rows();
}
void send(const Ranks& ranks, int to, Change& change) {
  visit_all(change, [&](const auto& numbers) { ranks.send(to, numbers); });
}
Change receive_change(const Ranks& ranks, int from) { return receive_whole<Change>(ranks, from); }

}  // namespace dotyk::multigrid
