#include "solver/feti/piece_kinds.hpp"

#include "algebra/dense/dense.hpp"
#include "algebra/direct/blas_threads.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

namespace {

constexpr double kSameEntry = 1e-12;
constexpr double kSameSpan = 1e-10;
/// Pieces that are treated together.
constexpr int kColumns = 8;

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

/// A on columns that are segments of a vector: `size` long, piece p's from first(p) on.
Vector on_segments(const std::vector<Batch>& batches, const Vector& f, const std::function<int(int)>& first,
                   const std::function<std::size_t(int)>& size, const OnColumns& A) {
  Vector result(f.size());
  const auto treat = [&](const Batch& batch) {
    const auto rows = static_cast<Eigen::Index>(size(batch.pieces[0]));
    DenseMatrix columns(rows, batch.pieces.size());
    for (std::size_t k = 0; k < batch.pieces.size(); ++k) columns.col(k) = f.segment(first(batch.pieces[k]), rows);
    A(batch, columns);
    for (std::size_t k = 0; k < batch.pieces.size(); ++k) result.segment(first(batch.pieces[k]), rows) = columns.col(k);
  };
  const algebra::OneBlasThread one;
  parallel_for(static_cast<int>(batches.size()), [&](int b) { treat(batches[b]); }, one.workers());
  return result;
}

}  // namespace

std::vector<std::vector<int>> equal_pieces(const std::vector<Piece>& pieces) {
  std::vector<std::vector<int>> kinds;
  for (int p = 0; p < static_cast<int>(pieces.size()); ++p) {
    const auto same = std::find_if(kinds.begin(), kinds.end(), [&](const std::vector<int>& kind) {
      const Piece& first = pieces[kind.front()];
      return same_pattern(first, pieces[p]) && same_values(*first.K, *pieces[p].K) && same_span(*first.kernel, *pieces[p].kernel);
    });
    if (same != kinds.end()) same->push_back(p);
    else kinds.push_back({p});
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

std::vector<Batch> batches(const std::vector<std::vector<int>>& kinds, const std::vector<Piece>& pieces) {
  std::vector<Batch> result;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    const std::size_t members = kinds[kind].size(), parts = (members + kColumns - 1) / kColumns;
    for (std::size_t k = 0; k < parts; ++k)
      result.push_back({static_cast<int>(kind),
                        {kinds[kind].begin() + k * members / parts, kinds[kind].begin() + (k + 1) * members / parts}});
  }
  const auto work = [&](const Batch& b) { return static_cast<double>(b.pieces.size()) * pieces[b.pieces[0]].size(); };
  std::stable_sort(result.begin(), result.end(), [&](const Batch& a, const Batch& b) { return work(a) > work(b); });
  return result;
}

Vector through_touched(const TornProblem& torn, const std::vector<Batch>& batches, const Vector& lambda,
                       const OnColumns& A) {
  const Vector& W = torn.touched_weight;
  const Vector moved = W.cwiseProduct(torn.Bt * lambda);
  return torn.B * W.cwiseProduct(on_segments(batches, moved, [&](int p) { return torn.pieces[p].first_touched; },
                                             [&](int p) { return torn.pieces[p].touched.size(); }, A));
}

Vector on_pieces(const TornProblem& torn, const std::vector<Batch>& batches, const Vector& f, const OnColumns& A) {
  return on_segments(batches, f, [&](int p) { return torn.pieces[p].first; },
                     [&](int p) { return torn.pieces[p].f->size(); }, A);
}

void refuse_singular(const Piece& piece, int unknown) {
  problem::refuse_singular(piece.name, piece.kernel->cols(), unknown >= 0 ? (*piece.node)[unknown] : -1);
}

}  // namespace dotyk::solver
