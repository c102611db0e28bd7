#include "solver/feti/equal_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>

#include "algebra/dense/dense.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::SparseMatrix;

namespace {

constexpr double kSameEntry = 1e-12;
constexpr double kSameSpan = 1e-10;

/// FNV-1a over the sizes, the pattern and where one node's unknowns end.
std::uint64_t fingerprint(const Piece& piece) {
  std::uint64_t hash = 14695981039346656037u;
  const auto mix = [&](std::uint64_t word) { hash = (hash ^ word) * 1099511628211u; };
  const SparseMatrix& K = *piece.K;
  mix(static_cast<std::uint64_t>(K.rows()));
  mix(static_cast<std::uint64_t>(piece.kernel->cols()));
  for (int j = 0; j < K.cols(); ++j) {
    mix(static_cast<std::uint64_t>(K.outerIndexPtr()[j + 1]));
    mix(j > 0 && (*piece.node)[j] == (*piece.node)[j - 1]);
  }
  for (int k = 0; k < K.nonZeros(); ++k) mix(static_cast<std::uint64_t>(K.innerIndexPtr()[k]));
  return hash;
}

bool same_pattern(const Piece& a, const Piece& b) {
  const SparseMatrix &A = *a.K, &B = *b.K;
  if (A.rows() != B.rows() || A.nonZeros() != B.nonZeros() || a.kernel->cols() != b.kernel->cols()) return false;
  for (int i = 1; i < A.rows(); ++i)
    if (((*a.node)[i] == (*a.node)[i - 1]) != ((*b.node)[i] == (*b.node)[i - 1])) return false;
  return std::equal(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1, B.outerIndexPtr()) &&
         std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), B.innerIndexPtr());
}

bool same_values(const SparseMatrix& A, const SparseMatrix& B) {
  if (&A == &B) return true;
  const auto diagonal = [&](Eigen::Index j) {  // the first entry of a lower column
    return std::abs(A.valuePtr()[A.outerIndexPtr()[j]]);
  };
  for (int j = 0; j < A.cols(); ++j)
    for (int k = A.outerIndexPtr()[j]; k < A.outerIndexPtr()[j + 1]; ++k) {
      const double allowed = kSameEntry * std::min(diagonal(j), diagonal(A.innerIndexPtr()[k]));
      if (!(std::abs(A.valuePtr()[k] - B.valuePtr()[k]) <= allowed)) return false;
    }
  return true;
}

bool same_span(const DenseMatrix& a, const DenseMatrix& b) {
  if (a.size() == 0 || &a == &b) return true;
  const DenseMatrix basis = algebra::orthonormal(a);
  for (Eigen::Index k = 0; k < b.cols(); ++k)
    if ((b.col(k) - basis * (basis.transpose() * b.col(k))).norm() > kSameSpan * b.col(k).norm()) return false;
  return true;
}

}  // namespace

std::vector<std::vector<int>> equal_pieces(const std::vector<Piece>& pieces) {
  std::vector<std::vector<int>> kinds;
  std::unordered_map<std::uint64_t, std::vector<int>> of_fingerprint;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    std::vector<int>& candidates = of_fingerprint[fingerprint(pieces[p])];
    const auto same = std::find_if(candidates.begin(), candidates.end(), [&](int kind) {
      const Piece& first = pieces[kinds[kind].front()];
      return same_pattern(first, pieces[p]) && same_values(*first.K, *pieces[p].K) &&
             same_span(*first.kernel, *pieces[p].kernel);
    });
    if (same != candidates.end()) {
      kinds[*same].push_back(static_cast<int>(p));
    } else {
      candidates.push_back(static_cast<int>(kinds.size()));
      kinds.push_back({static_cast<int>(p)});
    }
  }
  return kinds;
}

std::vector<std::vector<int>> alike_pieces(const std::vector<std::vector<int>>& kinds, const std::vector<Piece>& pieces) {
  std::vector<std::vector<int>> alike;
  for (const auto& kind : kinds) {
    std::map<std::vector<int>, std::vector<int>> by_touched;
    for (int p : kind) by_touched[pieces[p].touched].push_back(p);
    for (auto& [touched, members] : by_touched) alike.push_back(std::move(members));
  }
  return alike;
}

}  // namespace dotyk::solver
