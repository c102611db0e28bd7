
#include <doctest/doctest.h>

#include "../support/dual.hpp"
#include "algebra/dense/decompositions.hpp"
#include "solver/feti/feti.hpp"
#include "solver/feti/piece_stiffness.hpp"

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
  const algebra::MinimumNorm ii(K(inside, inside));
  const DenseMatrix across = K(inside, piece.touched);
  S(piece.touched, piece.touched) -= DenseMatrix(across.transpose() * ii.solve(across));
  return S;
}

solver::PieceStiffness dirichlet_of(const solver::DualProblem& dual) {
  Monitor quiet;
  return {dual, algebra::Ordering::automatic, quiet};
}

void check_against_dense(const problem::Problem& p) {
  const auto dual = test::dual_of(p);
  const auto dirichlet = dirichlet_of(dual);
  const DenseMatrix M = test::as_matrix(dual.rows(), [&](const Vector& v) { return dirichlet.apply(v); });
  CHECK(test::relative(M, test::dense_weighted(dual.torn(), schur)) < 1e-11);
  CHECK((M - M.transpose()).norm() < 1e-12 * M.norm());
}

struct ExtremeEigenvalues {
  double least, greatest;
  double condition() const { return greatest / least; }
};

/// Of the eigenvalues of M F on im P that are not zero; M symmetric positive semidefinite.
ExtremeEigenvalues ends(const DenseMatrix& P, const DenseMatrix& M, const DenseMatrix& F) {
  const algebra::Eigenpairs m = algebra::eigenpairs(P * M * P);
  const DenseMatrix root =
      m.vectors * m.values.cwiseMax(0).cwiseSqrt().asDiagonal() * m.vectors.transpose();
  const Vector e = algebra::eigenvalues(root * P * F * P * root);
  ExtremeEigenvalues result{e.maxCoeff(), e.maxCoeff()};
  int count = 0;
  for (double x : e)
    if (x > 1e-10 * result.greatest) result.least = std::min(result.least, x), ++count;
  CHECK(count == doctest::Approx(P.trace()));  // M has no kernel in im P
  return result;
}

int steps(const problem::Problem& p, solver::Feti::Preconditioner preconditioner) {
  solver::Feti method;
  method.preconditioner = preconditioner;
  method.tol = 1e-6;
  Monitor quiet;
  const auto result = solve(p, method, quiet);
  CHECK(result.converged);
  return result.feti->inner;
}

}  // namespace

TEST_CASE("the Dirichlet preconditioner is B W S W Bᵀ with each piece's Schur complement") {
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

TEST_CASE("spectra on im P: from 1 on with either preconditioner, to H/h with the lumped one, to log² with the Dirichlet one" * doctest::test_suite("large")) {
  // With orthonormal rows <λ, F λ> ≥ <λ, B Bᵀμ>²/|Bᵀμ|²_S = <λ, μ>²/<M μ, μ> for all μ: F ≥ M⁻¹ on im P, for S and for K ≥ S.
  double last = 0;
  for (const int n : {4, 6}) {  // n × n/2 × n/2 cells a piece, all rows equations
    const auto p = test::cut_box(true, n);
    const auto dual = test::dual_of(p);
    const auto dirichlet = dirichlet_of(dual);
    const solver::PieceStiffness simple(dual);
    const int m = dual.rows();
    const DenseMatrix P = test::projector({dual.G(), dual.e()}, m);
    const DenseMatrix F = test::as_matrix(m, [&](const Vector& v) { return dual.apply(v); });
    const ExtremeEigenvalues none = ends(P, P, F);
    const ExtremeEigenvalues lumped = ends(P, test::as_matrix(m, [&](const Vector& v) { return simple.apply(v); }), F);
    const ExtremeEigenvalues best = ends(P, test::as_matrix(m, [&](const Vector& v) { return dirichlet.apply(v); }), F);
    CHECK(lumped.least == doctest::Approx(1).epsilon(1e-8));
    CHECK(best.least == doctest::Approx(1).epsilon(1e-8));
    CHECK(best.condition() < 0.8 * lumped.condition());
    CHECK(lumped.condition() < 0.8 * none.condition());
    const double logarithm = 1 + std::log(n);
    CHECK(best.condition() < 0.55 * logarithm * logarithm);  // 2.94, 4.01; with n = 8 4.91
    CHECK(lumped.condition() < 1.3 * n);                     // 4.18, 6.31; with n = 8 8.55
    CHECK(lumped.condition() > 1.3 * last);
    last = lumped.condition();
  }
}

TEST_CASE("bounds reached on the way do not cost the preconditioners their worth") {
  // Each multiplier that reaches its bound ends conjugate gradients, and a preconditioned direction cut off at a bound may raise
  // the energy: nevertheless many get there together.
  using Preconditioner = solver::Feti::Preconditioner;
  problem::Problem p;
  test::CutBody body{test::box(test::Family::q1, 16, 16, 16)};
  body.held = [](const Point& x, int) { return x[0] == 0; };
  body.load = [](const Point&) { return Point{0, 0, -3}; };
  body.piece = test::boxes({2, 2, 2}, {1, 1, 1});
  const auto numbering = test::add(p, body);
  test::add_rows(p, body, numbering, 2, -1.0, [](const Point& x) { return x[2] == 0; }, 0.01);
  const int none = steps(p, Preconditioner::none);
  const int lumped = steps(p, Preconditioner::lumped);
  const int dirichlet = steps(p, Preconditioner::dirichlet);
  CHECK(lumped < 0.9 * none);      // 33 to 39
  CHECK(dirichlet < 0.85 * none);  // 32
}
