#include "solver/dirichlet.hpp"

#include <doctest/doctest.h>

#include "../support/dual.hpp"
#include "solver/lumped.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using mesh::Point;

namespace {

/// K_bb − K_bi K_ii† K_ib on the touched unknowns b, zero elsewhere.
DenseMatrix schur(const solver::Piece& piece) {
  std::vector<int> inside;
  for (int i = 0; i < piece.size(); ++i)
    if (std::find(piece.touched.begin(), piece.touched.end(), i) == piece.touched.end()) inside.push_back(i);
  const DenseMatrix K = test::full(*piece.K);
  DenseMatrix S = DenseMatrix::Zero(piece.size(), piece.size());
  S(piece.touched, piece.touched) = K(piece.touched, piece.touched);
  if (inside.empty()) return S;
  const Eigen::CompleteOrthogonalDecomposition<DenseMatrix> ii(DenseMatrix(K(inside, inside)));
  S(piece.touched, piece.touched) -= K(piece.touched, inside) * ii.solve(DenseMatrix(K(inside, piece.touched)));
  return S;
}

solver::Dirichlet dirichlet_of(const solver::DualProblem& dual) {
  Monitor quiet;
  return {dual, algebra::Ordering::automatic, quiet};
}

void check_against_dense(const problem::Problem& p) {
  const auto dual = test::dual_of(p);
  const auto dirichlet = dirichlet_of(dual);
  const DenseMatrix M = test::as_matrix(dual.rows(), [&](const Vector& v) { return dirichlet.apply(v); });
  CHECK(test::relative(M, test::dense(dual.torn(), schur)) < 1e-11);
  CHECK((M - M.transpose()).norm() < 1e-12 * M.norm());
}

/// Greatest over least of the eigenvalues of M F on im P that are not zero; M symmetric positive semidefinite.
double condition(const DenseMatrix& P, const DenseMatrix& M, const DenseMatrix& F) {
  const Eigen::SelfAdjointEigenSolver<DenseMatrix> m(P * M * P);
  const DenseMatrix root =
      m.eigenvectors() * m.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() * m.eigenvectors().transpose();
  const Vector e = Eigen::SelfAdjointEigenSolver<DenseMatrix>(root * P * F * P * root).eigenvalues();
  const double greatest = e.maxCoeff();
  double least = greatest;
  int count = 0;
  for (double x : e)
    if (x > 1e-10 * greatest) least = std::min(least, x), ++count;
  CHECK(count == doctest::Approx(P.trace()));  // M has no kernel in im P
  return greatest / least;
}

}  // namespace

TEST_CASE("the Dirichlet preconditioner is B S Bᵀ with each piece's Schur complement") {
  check_against_dense(test::cut_box(true, 4));
  check_against_dense(test::cut_box(false, 4, 3));
  check_against_dense(test::cut_box(true, 2));  // pieces of two cells
}

TEST_CASE("insides that a motion leaves free: rows on the normal components of a free body alone") {
  problem::Problem p;
  test::CutBody body{test::box(test::Family::q1, 3, 3, 3)};
  const auto numbering = test::add(p, body);
  test::add_rows(p, body, numbering, 2, -1.0, [](const Point& x) { return x[2] == 0; }, 0);
  check_against_dense(p);
}

TEST_CASE("equal pieces that rows touch alike share the inside's factor") {
  // 2 × 2 columns of four pieces. The two in the middle of each are touched alike, and as the left one where that is
  // held altogether, in two of the columns (y < 0.6); the right ones have rows on the normal components alone.
  const auto p = test::cut_box(true, 4, 4);
  const auto dual = test::dual_of(p);
  CHECK(dual.kinds().size() == 1);
  CHECK(dirichlet_of(dual).factors() == 2 * 2 + 2 * 3);
}

TEST_CASE("with the Dirichlet preconditioner the condition is less than with the lumped one, and that less than without") {
  const auto p = test::cut_box(true, 6);
  const auto dual = test::dual_of(p);
  const auto dirichlet = dirichlet_of(dual);
  const solver::Lumped simple(dual);
  const int n = dual.rows();
  const DenseMatrix P = test::projector({dual.G(), dual.e()}, n);
  const DenseMatrix F = test::as_matrix(n, [&](const Vector& v) { return dual.apply(v); });
  const double none = condition(P, P, F);
  const double lumped = condition(P, test::as_matrix(n, [&](const Vector& v) { return simple.apply(v); }), F);
  const double best = condition(P, test::as_matrix(n, [&](const Vector& v) { return dirichlet.apply(v); }), F);
  CHECK(best < 0.8 * lumped);
  CHECK(lumped < 0.8 * none);
}
