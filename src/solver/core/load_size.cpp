#include "solver/core/load_size.hpp"

#include <cmath>

namespace dotyk::solver {

using algebra::Vector;

double force_unit(const DualProblem& dual, const Vector& balanced) {
  const TornProblem& torn = dual.torn();
  const double carried = (torn.Bt * balanced).stableNorm();
  if (carried > 0) return balanced.stableNorm() / carried;
  double plain = 0, weighted = 0;
  for (const Piece& piece : torn.pieces) {
    if (piece.size() == 0) continue;
    plain = std::hypot(plain, piece.f->stableNorm());
    weighted = std::hypot(
        weighted, piece.f->cwiseQuotient(torn.stiffness.segment(piece.first, piece.size()).cwiseSqrt()).stableNorm());
  }
  return plain > 0 ? weighted / plain : 1;
}

double gross_load(const DualProblem& dual, const Vector& balanced) {
  Vector gross = Vector::Zero(dual.e().size());
  for (int r = 0; r < dual.G().cols(); ++r)
    for (algebra::SparseMatrix::InnerIterator it(dual.G(), r); it; ++it)
      gross[it.row()] += std::abs(it.value() * balanced[r]);
  const std::vector<Piece>& pieces = dual.torn().pieces;
  Eigen::Index first = 0;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const algebra::DenseMatrix& R = dual.basis(static_cast<int>(p));
    gross.segment(first, R.cols()) += R.cwiseAbs().transpose() * pieces[p].f->cwiseAbs();
    first += R.cols();
  }
  return gross.size() > 0 ? gross.maxCoeff() : 0;
}

}  // namespace dotyk::solver
