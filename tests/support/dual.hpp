#pragma once

#include "pieces.hpp"
#include "solver/feti/coarse_space.hpp"
#include "solver/feti/dual_problem.hpp"

namespace dotyk::test {

/// A box held on the left under load, pressed against rows on its right face, cut into `along` × 2 × 2 boxes of
/// n × n/2 × n/2 cells.
inline problem::Problem cut_box(bool support_rows, int n, int along = 2) {
  problem::Problem p;
  CutBody body{box(Family::q1, along * n, n, n, {0, 0, 0}, {1.0 * along, 1, 1})};
  body.held = [](const Point& x, int i) { return x[0] == 0 && (i != 2 || x[1] < 0.6); };
  body.value = [](const Point& x) { return Point{0.01 * x[1], -0.02, 0.03 * x[2]}; };
  body.load = [](const Point& x) { return Point{4 + x[0], x[1], -1}; };
  body.piece = boxes({along, 2, 2}, {1.0 * along, 1, 1});
  body.support_rows = support_rows;
  const auto numbering = add(p, body);
  add_rows(p, body, numbering, 0, 3.0, [=](const Point& x) { return x[0] == along; }, 0.02);
  return p;
}

inline solver::DualProblem dual_of(const problem::Problem& p) {
  Monitor quiet;
  problem::Clock clock;
  return {p, algebra::Ordering::automatic, clock, quiet};
}

/// The greatest distance of a copy from the mean of its unknown's copies, of a held one from its value: a length.
inline double disagreement(const solver::TornProblem& torn, const algebra::Vector& v) {
  const algebra::Vector mean = solver::average(torn, v);
  double most = 0;
  for (int k = 0; k < torn.copies(); ++k)
    most = std::max(most, std::abs(v[k] - (torn.unknown[k] >= 0 ? mean[torn.unknown[k]] : torn.value[k])));
  return most;
}

inline algebra::DenseMatrix as_matrix(int n, const std::function<algebra::Vector(const algebra::Vector&)>& A) {
  algebra::DenseMatrix M(n, n);
  for (int j = 0; j < n; ++j) M.col(j) = A(algebra::Vector::Unit(n, j));
  return M;
}

/// B̂ diag(A(piece)) B̂ᵀ, each A of the own unknowns of a piece.
inline algebra::DenseMatrix dense(const solver::TornProblem& torn,
                                  const std::function<algebra::DenseMatrix(const solver::Piece&)>& A) {
  algebra::DenseMatrix sum = algebra::DenseMatrix::Zero(torn.rows(), torn.rows());
  const algebra::DenseMatrix B = torn.B;
  for (const auto& piece : torn.pieces) {
    const algebra::DenseMatrix own = B.middleCols(piece.first_touched, piece.touched.size());
    sum += own * A(piece)(piece.touched, piece.touched) * own.transpose();
  }
  return sum;
}

/// B̂W diag(A(piece)) WB̂ᵀ, W = k⁻¹.
inline algebra::DenseMatrix dense_weighted(const solver::TornProblem& torn,
                                           const std::function<algebra::DenseMatrix(const solver::Piece&)>& A) {
  return dense(torn, [&](const solver::Piece& piece) -> algebra::DenseMatrix {
    const auto W = torn.stiffness.segment(piece.first, piece.size()).cwiseInverse().eval();
    return W.asDiagonal() * A(piece) * W.asDiagonal();
  });
}

inline algebra::DenseMatrix projector(const solver::CoarseSpace& coarse, int n) {
  return as_matrix(n, [&](const algebra::Vector& v) { return coarse.P(v); });
}

}  // namespace dotyk::test
