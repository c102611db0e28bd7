#include "solver/feti/piece_batches.hpp"

#include <algorithm>

#include "algebra/direct/blas_threads.hpp"
#include "base/parallel.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;

namespace {

constexpr int kColumns = 8;

}  // namespace

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

namespace {

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

}  // namespace dotyk::solver
