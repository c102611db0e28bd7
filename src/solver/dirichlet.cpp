#include "solver/dirichlet.hpp"

#include <Eigen/Eigenvalues>
#include <map>

#include "base/memory.hpp"
#include "base/text.hpp"
#include "solver/factor_pieces.hpp"

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

/// The rows and columns `picked` (ascending) of a lower triangle.
SparseMatrix principal(const SparseMatrix& lower, const std::vector<int>& picked) {
  std::vector<int> place(lower.rows(), -1);
  for (std::size_t k = 0; k < picked.size(); ++k) place[picked[k]] = static_cast<int>(k);
  const auto size = static_cast<Eigen::Index>(picked.size());
  SparseMatrix result(size, size);
  for (std::size_t k = 0; k < picked.size(); ++k) {
    result.startVec(static_cast<Eigen::Index>(k));
    for (SparseMatrix::InnerIterator it(lower, picked[k]); it; ++it)
      if (place[it.row()] >= 0) result.insertBack(place[it.row()], static_cast<Eigen::Index>(k)) = it.value();
  }
  result.finalize();
  return result;
}

/// The motions that vanish on the touched unknowns, on the others: the kernel of K_ii.
DenseMatrix kernel_inside(const DenseMatrix& basis, const std::vector<int>& touched, const std::vector<int>& inside) {
  if (basis.cols() == 0) return DenseMatrix(inside.size(), 0);
  const DenseMatrix on_touched = basis(touched, Eigen::all);
  const Eigen::SelfAdjointEigenSolver<DenseMatrix> e(DenseMatrix(on_touched.transpose() * on_touched));
  const auto count = (e.eigenvalues().array() <= kVanishes * kVanishes).count();
  return basis(inside, Eigen::all) * e.eigenvectors().leftCols(count);
}

}  // namespace

Dirichlet::Inside Dirichlet::inside(int kind, const Piece& piece, algebra::Ordering ordering) const {
  const std::vector<int> unknowns = others(piece);
  const SparseMatrix& K = *dual_.torn().pieces[dual_.kinds()[kind].front()].K;
  std::vector<int> node;
  for (int i : unknowns) node.push_back((*piece.node)[i]);
  return {unknowns, &K,
          {principal(K, unknowns), node, kernel_inside(dual_.basis(kind), piece.touched, unknowns), ordering}};
}

Dirichlet::Dirichlet(const DualProblem& dual, algebra::Ordering ordering, Monitor& monitor) : dual_(dual) {
  const std::vector<Piece>& pieces = dual.torn().pieces;
  monitor.phase("ordering the insides of pieces");
  for (std::size_t kind = 0; kind < dual.kinds().size(); ++kind) {
    std::map<std::vector<int>, std::vector<int>> by_touched;
    for (int p : dual.kinds()[kind]) by_touched[pieces[p].touched].push_back(p);
    for (const auto& [touched, alike] : by_touched) {
      monitor.check();
      alike_.push_back(alike);
      insides_.push_back(inside(static_cast<int>(kind), pieces[alike.front()], ordering));
    }
  }
  batches_ = batches(alike_, pieces);
  require_memory(factor_bytes(), text("the factors of the insides of ", insides_.size(), " pieces"));
  std::vector<double> flops;
  for (const Inside& inside : insides_) flops.push_back(inside.inverse.cholesky().flops());
  factor_in_threads(flops, "factoring the inside of piece", monitor, [&](int k) {
    Inside& in = insides_[k];
    if (in.inverse.factor(principal(*in.K, in.unknowns))) return;
    const int failed = in.inverse.failed_unknown();
    refuse_singular(pieces[alike_[k].front()], failed < 0 ? -1 : in.unknowns[failed]);
  });
}

Vector Dirichlet::apply(const Vector& lambda) const {
  return through_pieces(dual_.torn(), batches_, lambda, [this](const Batch& batch, DenseMatrix& columns) {
    const Inside& in = insides_[batch.kind];
    const auto K = in.K->selfadjointView<Eigen::Lower>();
    const DenseMatrix force = K * columns;
    columns(in.unknowns, Eigen::all) = -in.inverse.apply(force(in.unknowns, Eigen::all));
    columns = DenseMatrix(K * columns);
  });
}

double Dirichlet::factor_bytes() const {
  double bytes = 0;
  for (const Inside& inside : insides_) bytes += inside.inverse.cholesky().bytes();
  return bytes;
}

}  // namespace dotyk::solver
