#include "solver/feti/dirichlet.hpp"

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

Dirichlet::Dirichlet(const DualProblem& dual, algebra::Ordering ordering, Monitor& monitor) : dual_(dual) {
  const std::vector<Piece>& pieces = dual.torn().pieces;
  monitor.phase("ordering the insides of pieces");
  const auto alike = alike_pieces(dual.kinds(), pieces);
  batches_ = batches(alike, pieces);
  for (const auto& same : alike) {
    monitor.check();
    add(pieces[same.front()], dual.basis(same.front()), ordering);
  }
  factor(monitor, [&](int k) -> const Piece& { return pieces[alike[k].front()]; });
}

void Dirichlet::add(const Piece& piece, const DenseMatrix& basis, algebra::Ordering ordering) {
  const std::vector<int> inside = others(piece);
  std::vector<int> node;
  for (int i : inside) node.push_back((*piece.node)[i]);
  parts_.push_back({principal(*piece.K, piece.touched), coupling(*piece.K, inside, piece.touched),
                    {principal(*piece.K, inside), node, kernel_inside(basis, piece.touched, inside), ordering}});
}

void Dirichlet::factor(Monitor& monitor, const std::function<const Piece&(int)>& piece_of) {
  require_memory(factor_bytes(), text("the factors of the insides of ", parts_.size(), " pieces"));
  std::vector<double> flops;
  for (const Part& part : parts_) flops.push_back(part.inside.cholesky().flops());
  factor_in_threads(flops, "factoring the inside of piece", monitor, [&](int k) {
    const Piece& piece = piece_of(k);
    const std::vector<int> inside = others(piece);
    if (parts_[k].inside.factor(principal(*piece.K, inside))) return;
    const int failed = parts_[k].inside.failed_unknown();
    refuse_singular(piece, failed < 0 ? -1 : inside[failed]);
  });
}

Vector Dirichlet::apply(const Vector& lambda) const {
  return through_touched(dual_.torn(), batches_, lambda, [this](const Batch& batch, DenseMatrix& columns) {
    const Part& part = parts_[batch.kind];
    const DenseMatrix inside = part.inside.apply(part.coupling * columns);
    const DenseMatrix direct = part.stiffness.selfadjointView<Eigen::Lower>() * columns;
    columns = direct - part.coupling.transpose() * inside;
  });
}

double Dirichlet::factor_bytes() const {
  double bytes = 0;
  for (const Part& part : parts_) bytes += part.inside.cholesky().bytes();
  return bytes;
}

}  // namespace dotyk::solver
