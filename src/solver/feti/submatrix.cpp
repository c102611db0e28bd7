#include "solver/feti/submatrix.hpp"

namespace dotyk::solver {

using algebra::SparseMatrix;

namespace {

/// Where each index stands among the picked ones, or -1.
std::vector<int> places(Eigen::Index size, const std::vector<int>& picked) {
  std::vector<int> place(size, -1);
  for (std::size_t k = 0; k < picked.size(); ++k) place[picked[k]] = static_cast<int>(k);
  return place;
}

}  // namespace

SparseMatrix principal(const SparseMatrix& lower, const std::vector<int>& picked) {
  const std::vector<int> place = places(lower.rows(), picked);
  const auto size = static_cast<Eigen::Index>(picked.size());
  SparseMatrix result(size, size);
  for (Eigen::Index k = 0; k < size; ++k) {
    result.startVec(k);
    for (SparseMatrix::InnerIterator it(lower, picked[k]); it; ++it)
      if (place[it.row()] >= 0) result.insertBack(place[it.row()], k) = it.value();
  }
  result.finalize();
  return result;
}

SparseMatrix coupling(const SparseMatrix& lower, const std::vector<int>& rows, const std::vector<int>& columns) {
  const std::vector<int> row = places(lower.rows(), rows), column = places(lower.rows(), columns);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < lower.cols(); ++j)
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      if (row[it.row()] >= 0 && column[j] >= 0) entries.emplace_back(row[it.row()], column[j], it.value());
      if (row[j] >= 0 && column[it.row()] >= 0) entries.emplace_back(row[j], column[it.row()], it.value());
    }
  SparseMatrix result(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(columns.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

}  // namespace dotyk::solver
