#include "solver/feti/piece_stiffness.hpp"

#include "algebra/dense/decompositions.hpp"
#include "base/memory.hpp"
#include "base/text.hpp"
#include "solver/feti/equal_pieces.hpp"
#include "solver/feti/factor_pieces.hpp"
#include "solver/feti/submatrix.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

namespace {

/// A motion of norm one that moves the touched unknowns by no more vanishes there.
constexpr double kVanishes = 1e-7;

std::vector<int> others(const Piece& piece) {
  std::vector<char> is_touched(piece.size(), 0);
  for (int i : piece.touched) is_touched[i] = 1;
  std::vector<int> result;
  for (int i = 0; i < piece.size(); ++i)
    if (!is_touched[i]) result.push_back(i);
  return result;
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
    insides_.push_back({coupling(*piece.K, inside, piece.touched),
                        {principal(*piece.K, inside), node, kernel_inside(dual.basis(same.front()), piece.touched, inside), ordering}});
  }
  factor(monitor);
}

void PieceStiffness::factor(Monitor& monitor) {
  require_memory(factor_bytes(), text("the factors of the insides of ", insides_.size(), " pieces"));
  std::vector<double> flops;
  for (const Inside& inside : insides_) flops.push_back(inside.inverse.cholesky().flops());
  factor_in_threads(flops, "factoring the inside of piece", monitor, [&](int k) {
    const Piece& piece = dual_.torn().pieces[alike_[k].front()];
    const std::vector<int> inside = others(piece);
    if (insides_[k].inverse.factor(principal(*piece.K, inside))) return;
    const int failed = insides_[k].inverse.failed_unknown();
    refuse_singular(piece, failed < 0 ? -1 : inside[failed]);
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
