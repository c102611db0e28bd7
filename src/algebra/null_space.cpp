#include "algebra/null_space.hpp"

#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <numeric>
#include <vector>

namespace dotyk::algebra {
namespace {

/// Columns, and the rows that act on them.
struct Piece {
  std::vector<int> columns, rows;
};

/// Columns in one piece are joined by rows, directly or through others.
std::vector<Piece> pieces(const DenseMatrix& A) {
  std::vector<int> leader(A.cols()), first(A.rows(), -1);
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int j) {
    while (leader[j] != j) j = leader[j] = leader[leader[j]];
    return j;
  };
  for (int j = 0; j < A.cols(); ++j)
    for (int r = 0; r < A.rows(); ++r) {
      if (A(r, j) == 0) continue;
      if (first[r] < 0) first[r] = j;
      else leader[find(j)] = find(first[r]);
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

constexpr Eigen::Index kDense = 40;  ///< columns up to which singular values cost nothing

/// Is the least singular value certainly above 1e-5 of `scale`, a bound of the greatest? By inverse iteration with AᵀA, whose rounding lies
/// far below 1e-10. A false no costs time only.
bool full_rank(const DenseMatrix& A, double scale) {
  if (A.rows() < A.cols()) return false;
  const SparseMatrix sparse = A.sparseView(), square = SparseMatrix(sparse.transpose()) * sparse;
  const Eigen::SimplicialLDLT<SparseMatrix> factor(square);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 1e-10 * scale * scale)) return false;
  Vector v = Vector::LinSpaced(A.cols(), 1, 2).normalized();
  for (int step = 0; step < 12; ++step) {
    const Vector w = factor.solve(v);
    const double inverse = w.norm();
    if (!(inverse * 1e-10 * scale * scale < 1)) return false;
    v = w / inverse;
  }
  return true;
}

}  // namespace

RangeAndNull range_and_null(const DenseMatrix& A, double tolerance) {
  struct Part {
    const Piece* piece;
    DenseMatrix seen, unseen;
  };
  const std::vector<Piece> all = pieces(A);
  std::vector<Part> parts;
  // Singular values of the whole are those of all pieces: one scale, not less than the greatest of a column.
  double scale = 1;
  for (int j = 0; j < A.cols(); ++j) scale = std::max(scale, A.col(j).norm());
  Eigen::Index seen = 0;
  for (const Piece& piece : all) {
    const DenseMatrix own = A(piece.rows, piece.columns);
    const Eigen::Index count = own.cols();
    Part part{&piece, DenseMatrix::Identity(count, count), DenseMatrix(count, 0)};
    if (count <= kDense || !full_rank(own, scale)) {
      DenseMatrix square = DenseMatrix::Zero(std::max(own.rows(), count), count);
      square.topRows(own.rows()) = own;
      Eigen::Index rank = 0;
      const Eigen::JacobiSVD<DenseMatrix> svd(square, Eigen::ComputeFullV);
      while (rank < count && svd.singularValues()[rank] > tolerance * std::max(scale, svd.singularValues()[0])) ++rank;
      if (rank < count) part.seen = svd.matrixV().leftCols(rank), part.unseen = svd.matrixV().rightCols(count - rank);
    }
    seen += part.seen.cols();
    parts.push_back(std::move(part));
  }
  RangeAndNull result{DenseMatrix::Zero(A.cols(), seen), DenseMatrix::Zero(A.cols(), A.cols() - seen)};
  Eigen::Index s = 0, u = 0;
  for (const Part& part : parts) {
    result.seen(part.piece->columns, Eigen::seqN(s, part.seen.cols())) = part.seen;
    result.unseen(part.piece->columns, Eigen::seqN(u, part.unseen.cols())) = part.unseen;
    s += part.seen.cols(), u += part.unseen.cols();
  }
  return result;
}

}  // namespace dotyk::algebra
