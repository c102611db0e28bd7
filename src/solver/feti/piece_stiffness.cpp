#include "solver/feti/piece_stiffness.hpp"

#include "algebra/dense/decompositions.hpp"
#include "algebra/direct/blas_threads.hpp"
#include "base/memory.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

namespace {

/// A motion of norm one that moves the touched unknowns by no more vanishes there.
constexpr double kVanishes = 1e-7;

std::vector<int> others(const Piece& piece) {
  std::vector<int> all(piece.size()), result;
  std::iota(all.begin(), all.end(), 0);
  std::set_difference(all.begin(), all.end(), piece.touched.begin(), piece.touched.end(), std::back_inserter(result));
  return result;
}

/// The unit vectors of the unknowns picked, as columns.
SparseMatrix unit_vectors(int size, const std::vector<int>& picked) {
  SparseMatrix S(size, static_cast<Eigen::Index>(picked.size()));
  S.reserve(S.cols());
  for (int k = 0; k < S.cols(); ++k) S.insert(picked[k], k) = 1;
  S.makeCompressed();
  return S;
}

/// The rows and columns `picked` (ascending) of a symmetric matrix, lower triangles both.
SparseMatrix principal(const SparseMatrix& lower, const std::vector<int>& picked) {
  const SparseMatrix S = unit_vectors(static_cast<int>(lower.rows()), picked);
  return S.transpose() * SparseMatrix(lower * S);
}

/// The motions that vanish on the touched unknowns, on the others: the kernel of K_ii.
DenseMatrix kernel_inside(const DenseMatrix& basis, const std::vector<int>& touched, const std::vector<int>& inside) {
  if (basis.cols() == 0) return DenseMatrix(inside.size(), 0);
  const DenseMatrix on_touched = basis(touched, Eigen::all);
  const algebra::Eigenpairs e = algebra::eigenpairs(on_touched.transpose() * on_touched);
  const auto count = (e.values.array() <= kVanishes * kVanishes).count();
  return basis(inside, Eigen::all) * e.vectors.leftCols(count);
}

}  // namespace

PieceStiffness::PieceStiffness(const DualProblem& dual)
    : dual_(dual), alike_(alike_pieces(dual.kinds(), dual.torn().pieces)), batches_(batches(alike_, dual.torn().pieces)) {
  for (const auto& same : alike_) {
    const Piece& piece = dual.torn().pieces[same.front()];
    stiffness_.push_back(principal(*piece.K, piece.touched));
  }
}

PieceStiffness::PieceStiffness(const DualProblem& dual, algebra::Ordering ordering, Monitor& monitor) : PieceStiffness(dual) {
  monitor.phase("ordering the insides of pieces");
  for (const auto& same : alike_) {
    monitor.check();
    const Piece& piece = dual.torn().pieces[same.front()];
    const std::vector<int> inside = others(piece);
    std::vector<int> node;
    for (int i : inside) node.push_back((*piece.node)[i]);
    const SparseMatrix K = piece.K->selfadjointView<Eigen::Lower>();
    const SparseMatrix K_b = K * unit_vectors(piece.size(), piece.touched);
    insides_.push_back({inside, unit_vectors(piece.size(), inside).transpose() * K_b,
                        {principal(*piece.K, inside), node, kernel_inside(dual.basis(piece), piece.touched, inside), ordering}});
  }
  require_memory(factor_bytes(), text("the factors of the insides of ", insides_.size(), " pieces"));
  std::vector<double> flops;
  for (const Inside& inside : insides_) flops.push_back(inside.inverse.cholesky().flops());
  const auto phase = [&](int, int n) { return text("factoring the inside of piece ", n, " of ", flops.size()); };
  algebra::factor_in_threads(flops, phase, monitor, [&](int k) {
    const Piece& piece = dual.torn().pieces[alike_[k].front()];
    Inside& inside = insides_[k];
    if (inside.inverse.factor(principal(*piece.K, inside.unknowns))) return;
    const int failed = inside.inverse.failed_unknown();
    refuse_singular(piece, failed < 0 ? -1 : inside.unknowns[failed]);
  });
}

Vector PieceStiffness::apply(const Vector& lambda) const {
  return through_touched(dual_.torn(), batches_, lambda, [this](const Batch& batch, DenseMatrix& columns) {
    DenseMatrix forces = stiffness_[batch.kind].selfadjointView<Eigen::Lower>() * columns;
    if (!insides_.empty()) {
      const Inside& inside = insides_[batch.kind];
      forces -= inside.coupling.transpose() * inside.inverse.apply(inside.coupling * columns);
    }
    columns = std::move(forces);
  });
}

double PieceStiffness::factor_bytes() const {
  double bytes = 0;
  for (const Inside& inside : insides_) bytes += inside.inverse.cholesky().bytes();
  return bytes;
}

}  // namespace dotyk::solver
