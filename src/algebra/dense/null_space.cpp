#include "algebra/dense/null_space.hpp"

#include <SuiteSparseQR.hpp>
#include <algorithm>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>

#include "algebra/dense/decompositions.hpp"
#include "algebra/direct/blas_threads.hpp"
#include "algebra/dense/dense.hpp"
#include "algebra/direct/stop_factoring.hpp"

namespace dotyk::algebra {
namespace {

constexpr Eigen::Index kDense = 40;  ///< columns up to which singular values cost nothing

/// Of a piece: how its columns combine.
struct Split {
  Eigen::Index rank;
  SparseMatrix seen;
  DenseMatrix unseen;
};

/// Singular values of the whole are those of all pieces: one scale, not less than the greatest norm of a column.
double scale_of(const SparseMatrix& A) {
  double scale = 1;
  for (int j = 0; A.rows() > 0 && j < A.cols(); ++j) scale = std::max(scale, A.col(j).norm());
  return scale;
}

SparseMatrix identity(Eigen::Index n) {
  SparseMatrix I(n, n);
  I.setIdentity();
  return I;
}

Split by_singular_values(const DenseMatrix& own, double scale, double tolerance) {
  const Eigen::Index count = own.cols();
  const SingularFactors svd = singular_factors(own);
  const Eigen::Index rank = svd.rank(tolerance * std::max(scale, svd.values[0]));
  if (rank == count) return {rank, identity(count), DenseMatrix(count, 0)};
  return {rank, svd.V.leftCols(rank).sparseView(0, 0), svd.V.rightCols(count - rank)};
}

/// What SuiteSparseQR works with, and what it gives.
class SparseQr {
 public:
  using Index = SuiteSparse_long;
  /// Factors A's part in the piece; `place`: room for a number of every row of A.
  SparseQr(const SparseMatrix& A, const Piece& piece, std::vector<int>& place, double least, bool wanted) : columns_(piece.columns.size()) {
    cholmod_l_start(&common_);
    common_.error_handler = nullptr;
    common_.print = 0;
    for (std::size_t k = 0; k < piece.rows.size(); ++k) place[piece.rows[k]] = static_cast<int>(k);
    std::size_t count = 0;
    for (const int j : piece.columns) count += static_cast<std::size_t>(A.col(j).nonZeros());
    cholmod_sparse* own = cholmod_l_allocate_sparse(std::max(piece.rows.size(), columns_), columns_, count, true, true, 0, CHOLMOD_REAL, &common_);
    if (!own) throw std::bad_alloc();
    auto *start = static_cast<Index*>(own->p), *row = static_cast<Index*>(own->i);
    auto* value = static_cast<double*>(own->x);
    Index k = 0;
    for (std::size_t j = 0; j < columns_; ++j) {
      for (SparseMatrix::InnerIterator it(A, piece.columns[j]); it; ++it)
        if (it.value() != 0) row[k] = place[it.row()], value[k++] = it.value();
      start[j + 1] = k;
    }
    const BlasThreads threads(0);
    rank_ = wanted ? SuiteSparseQR<double>(SPQR_ORDERING_DEFAULT, least, 0, own, &R_, &order_, &common_)
                   : SuiteSparseQR<double>(SPQR_ORDERING_DEFAULT, least, 0, own, nullptr, &order_, &common_);
    cholmod_l_free_sparse(&own, &common_);
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common_.status < CHOLMOD_OK) throw std::runtime_error("QR factorisation failed inside SuiteSparseQR (status " + std::to_string(common_.status) + ")");
  }
  ~SparseQr() {
    cholmod_l_free_sparse(&R_, &common_);
    cholmod_l_free(columns_, sizeof(Index), order_, &common_);
    cholmod_l_finish(&common_);
  }
  SparseQr(const SparseQr&) = delete;
  SparseQr& operator=(const SparseQr&) = delete;

  Eigen::Index rank() const { return rank_; }
  /// Column of the piece that is R's k-th: those set aside come last.
  int column(Eigen::Index k) const { return static_cast<int>(order_ ? order_[k] : k); }
  /// R's first rows: R₁ upper triangular and regular, then the columns set aside.
  Eigen::Map<const Eigen::SparseMatrix<double, Eigen::ColMajor, Index>> R() const {
    return {rank_, static_cast<Index>(columns_), static_cast<Index*>(R_->p)[columns_], static_cast<const Index*>(R_->p),
            static_cast<const Index*>(R_->i), static_cast<const double*>(R_->x)};
  }

 private:
  std::size_t columns_;
  cholmod_common common_;
  cholmod_sparse* R_ = nullptr;
  Index *order_ = nullptr, rank_ = 0;
};

Split by_factor(const SparseMatrix& A, const Piece& piece, std::vector<int>& place, double least, bool bases) {
  const SparseQr qr(A, piece, place, least, bases);
  const auto n = static_cast<Eigen::Index>(piece.columns.size());
  const Eigen::Index rank = qr.rank();
  if (!bases || rank == n) return {rank, identity(n), DenseMatrix(n, 0)};
  // R₁ z = R₂, and the unit vectors of the columns set aside: −z above them makes R x = 0.
  const auto R = qr.R();
  DenseMatrix z = R.rightCols(n - rank);
  for (Eigen::Index k = rank; k-- > 0;) {
    const double* value = R.valuePtr();
    const auto *row = R.innerIndexPtr(), *start = R.outerIndexPtr();
    const auto last = start[k + 1] - 1;  // the diagonal comes last in its column
    z.row(k) /= value[last];
    for (auto i = start[k]; i < last; ++i) z.row(row[i]) -= value[i] * z.row(k);
  }
  DenseMatrix basis = DenseMatrix::Zero(n, n - rank);
  Split split{rank, SparseMatrix(n, rank), {}};
  for (Eigen::Index k = 0; k < n; ++k)
    if (k < rank) basis.row(qr.column(k)) = -z.row(k), split.seen.insert(qr.column(k), k) = 1;
    else basis(qr.column(k), k - rank) = 1;
  split.unseen = orthonormal(basis);
  return split;
}

/// Calls take(piece, split) for every piece.
template <class Take>
void split(const SparseMatrix& A, double tolerance, bool bases, Take&& take) {
  const double scale = scale_of(A);
  std::vector<int> place(A.rows());
  for (const Piece& piece : pieces(A)) {
    ask_to_stop();
    if (piece.rows.empty()) take(piece, Split{0, SparseMatrix(1, 0), DenseMatrix::Ones(1, 1)});
    else if (static_cast<Eigen::Index>(piece.columns.size()) <= kDense) take(piece, by_singular_values(dense(A, piece), scale, tolerance));
    else take(piece, by_factor(A, piece, place, tolerance * scale, bases));
  }
}

}  // namespace

std::vector<Piece> pieces(const SparseMatrix& A) {
  std::vector<int> leader(A.cols()), first(A.rows(), -1);
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int j) {
    while (leader[j] != j) j = leader[j] = leader[leader[j]];
    return j;
  };
  for (int j = 0; j < A.cols(); ++j)
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
      if (it.value() == 0) continue;
      if (first[it.row()] < 0) first[it.row()] = j;
      else leader[find(j)] = find(first[it.row()]);
    }
  std::vector<int> number(A.cols(), -1);
  std::vector<Piece> all;
  for (int j = 0; j < A.cols(); ++j) {
    int& k = number[find(j)];
    if (k < 0) k = static_cast<int>(all.size()), all.emplace_back();
    all[k].columns.push_back(j);
  }
  for (int r = 0; r < A.rows(); ++r)
    if (first[r] >= 0) all[number[find(first[r])]].rows.push_back(r);
  return all;
}

DenseMatrix dense(const SparseMatrix& A, const Piece& piece) {
  DenseMatrix own = DenseMatrix::Zero(static_cast<Eigen::Index>(piece.rows.size()), static_cast<Eigen::Index>(piece.columns.size()));
  for (std::size_t j = 0; j < piece.columns.size(); ++j)
    for (SparseMatrix::InnerIterator it(A, piece.columns[j]); it; ++it)
      if (it.value() != 0)
        own(std::lower_bound(piece.rows.begin(), piece.rows.end(), static_cast<int>(it.row())) - piece.rows.begin(), static_cast<Eigen::Index>(j)) = it.value();
  return own;
}

RangeAndNull range_and_null(const SparseMatrix& A, double tolerance) {
  Triplets seen, unseen;
  int rank = 0, rest = 0;
  split(A, tolerance, true, [&](const Piece& piece, const Split& own) {
    for (int j = 0; j < own.seen.cols(); ++j)
      for (SparseMatrix::InnerIterator it(own.seen, j); it; ++it) seen.emplace_back(piece.columns[it.row()], rank + j, it.value());
    for (int j = 0; j < own.unseen.cols(); ++j)
      for (int i = 0; i < own.unseen.rows(); ++i)
        if (own.unseen(i, j) != 0) unseen.emplace_back(piece.columns[i], rest + j, own.unseen(i, j));
    rank += static_cast<int>(own.seen.cols()), rest += static_cast<int>(own.unseen.cols());
  });
  return {from_triplets(A.cols(), rank, seen), from_triplets(A.cols(), rest, unseen)};
}

int rank(const SparseMatrix& A, double tolerance) {
  Eigen::Index sum = 0;
  split(A, tolerance, false, [&](const Piece&, const Split& own) { sum += own.rank; });
  return static_cast<int>(sum);
}

SparseMatrix orthonormal(const SparseMatrix& columns) {
  Triplets entries;
  for (const Piece& piece : pieces(columns)) {
    const DenseMatrix own = orthonormal(dense(columns, piece));
    for (int j = 0; j < own.cols(); ++j)
      for (int i = 0; i < own.rows(); ++i)
        if (own(i, j) != 0) entries.emplace_back(piece.rows[i], piece.columns[j], own(i, j));
  }
  return from_triplets(columns.rows(), columns.cols(), entries);
}

}  // namespace dotyk::algebra
