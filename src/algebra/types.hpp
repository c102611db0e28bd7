#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace dotyk::algebra {

using Vector = Eigen::VectorXd;
using DenseMatrix = Eigen::MatrixXd;

/// Column-major sparse matrix. A symmetric one is stored as its lower triangle
/// wherever a function says "lower".
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// Row-major sparse matrix: interface rows (B).
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

/// A sparse matrix that is moved without a copy. Eigen 3.4's sparse matrices have no move constructor or move assignment: they copy.
class StoredMatrix : public SparseMatrix {
 public:
  StoredMatrix() = default;
  StoredMatrix(const StoredMatrix&) = default;
  StoredMatrix& operator=(const StoredMatrix&) = default;
  StoredMatrix(StoredMatrix&& other) noexcept { swap(other); }
  StoredMatrix& operator=(StoredMatrix&& other) noexcept {
    swap(other);
    return *this;
  }
  StoredMatrix& operator=(const SparseMatrix& other) {
    SparseMatrix::operator=(other);
    return *this;
  }
  StoredMatrix& operator=(SparseMatrix&& other) noexcept {
    swap(other);
    return *this;
  }
};

/// Entries of a sparse matrix; those at one place add up.
using Triplets = std::vector<Eigen::Triplet<double>>;

/// Entries at one place are added in their order.
template <class Matrix = SparseMatrix>
Matrix from_triplets(Eigen::Index rows, Eigen::Index columns, const Triplets& entries) {
  constexpr Eigen::Index kFew = 10;  // Eigen's way goes several times over all inner indices
  Matrix matrix(rows, columns);
  if (matrix.innerSize() < kFew * std::ssize(entries)) {
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }
  const auto place = [](const auto& e) { return Matrix::IsRowMajor ? std::pair(e.row(), e.col()) : std::pair(e.col(), e.row()); };
  Triplets sorted = entries;
  std::ranges::stable_sort(sorted, {}, place);
  matrix.reserve(std::ssize(sorted));
  double* last = nullptr;
  for (auto [outer, at] = std::pair(Eigen::Index{0}, sorted.begin()); outer < matrix.outerSize(); ++outer) {
    matrix.startVec(outer);
    for (; at != sorted.end() && place(*at).first == outer; ++at) {
      if (last && place(at[-1]) == place(*at)) *last += at->value();
      else last = &(matrix.insertBackByOuterInner(outer, place(*at).second) = at->value());
    }
  }
  matrix.finalize();
  return matrix;
}

/// The rows `picked` of a matrix, in this order.
inline SparseRows pick_rows(const SparseRows& rows, const std::vector<int>& picked) {
  SparseRows result(static_cast<Eigen::Index>(picked.size()), rows.cols());
  for (std::size_t k = 0; k < picked.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    result.startVec(row);
    for (SparseRows::InnerIterator it(rows, picked[k]); it; ++it) result.insertBack(row, it.col()) = it.value();
  }
  result.finalize();
  return result;
}

}  // namespace dotyk::algebra
