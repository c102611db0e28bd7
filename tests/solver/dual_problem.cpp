#include "solver/feti/dual_problem.hpp"

#include <doctest/doctest.h>

#include "../support/dual.hpp"
#include "../support/programs.hpp"
#include "algebra/dense/decompositions.hpp"
#include "base/error.hpp"
#include "solver/feti/piece_stiffness.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using mesh::Point;
using solver::DualProblem;
using test::CutBody;

namespace {

/// K†.
DenseMatrix pseudo_inverse(const solver::Piece& piece) {
  const algebra::Eigenpairs e = algebra::eigenpairs(test::full(*piece.K));
  const auto n = piece.size() - piece.kernel->cols();
  return e.vectors.rightCols(n) * e.values.tail(n).cwiseInverse().asDiagonal() *
         e.vectors.rightCols(n).transpose();
}

}  // namespace

TEST_CASE("F is symmetric, positive semidefinite, and B K† Bᵀ where rigid motions are balanced; lumped B W K W Bᵀ") {
  for (const bool support_rows : {true, false}) {
    const auto p = test::cut_box(support_rows, 2, 3);  // 12 pieces: two batches where they are equal
    const auto dual = test::dual_of(p);
    const int n = dual.rows();
    const DenseMatrix F = test::as_matrix(n, [&](const Vector& v) { return dual.apply(v); });
    CHECK((F - F.transpose()).norm() < 1e-13 * F.norm());
    const Vector eigenvalues = algebra::eigenvalues(F);
    CHECK(eigenvalues.minCoeff() > -1e-13 * eigenvalues.maxCoeff());
    const DenseMatrix exact = test::dense(dual.torn(), pseudo_inverse);
    const DenseMatrix P = test::projector({dual.G(), dual.e()}, n);
    CHECK(test::relative(P * F * P, P * exact * P) < 1e-12);
    if (!support_rows) CHECK(dual.e().size() == 8 * 6);  // the left pieces are held by what stays in their K
    const solver::PieceStiffness preconditioner(dual);
    const DenseMatrix lumped = test::as_matrix(n, [&](const Vector& v) { return preconditioner.apply(v); });
    CHECK(test::relative(lumped, test::dense_weighted(dual.torn(), [](const auto& piece) { return test::full(*piece.K); })) < 1e-13);
  }
}

TEST_CASE("the direct solution's multipliers balance, are optimal, and give its displacements back") {
  Monitor quiet;
  for (const bool support_rows : {true, false}) {
    const auto p = test::cut_box(support_rows, 4);
    const auto direct = solver::solve(p, test::pdas(true), quiet);
    REQUIRE(direct.converged);
    REQUIRE(direct.state.lambda.maxCoeff() > 0);
    const auto dual = test::dual_of(p);
    const solver::CoarseSpace coarse(dual.G(), dual.e());
    // All rows' multipliers: those of the problem known, the others by least squares of the copies' equilibrium.
    const auto& torn = dual.torn();
    Vector v(torn.copies());
    for (int k = 0; k < torn.copies(); ++k)
      v[k] = torn.unknown[k] < 0 ? torn.value[k] : direct.state.u.here()[torn.unknown[k]];
    Vector force(torn.B.cols());  // f − Kv where rows act
    double elsewhere = 0;
    for (const auto& piece : torn.pieces) {
      const Vector own = *piece.f - piece.K->selfadjointView<Eigen::Lower>() * Vector(v.segment(piece.first, piece.size()));
      elsewhere += own.squaredNorm();
      for (std::size_t i = 0; i < piece.touched.size(); ++i) {
        force[piece.first_touched + i] = own[piece.touched[i]];
        elsewhere -= std::pow(own[piece.touched[i]], 2);
      }
    }
    CHECK(std::sqrt(std::abs(elsewhere)) < 1e-7 * force.norm());
    const Vector lambda = torn.B * torn.touched_weight.cwiseProduct(force);  // B̂WB̂ᵀ = I
    CHECK(test::relative(torn.Bt * lambda, force) < 1e-9);
    CHECK(test::relative(lambda.head(p.rows()), direct.state.lambda.cwiseQuotient(torn.scale)) < 1e-9);
    CHECK((dual.G() * lambda - dual.e()).norm() < 1e-9 * dual.e().norm());

    // Optimality: (B̂v − ĉ) = −(Fλ − d̃) + G̃ᵀα, zero but for contact that is open, where λ is zero.
    Vector jump = Vector::Zero(dual.rows());
    jump.head(p.rows()) = torn.scale.cwiseProduct(p.B * direct.state.u.here() - p.c);
    const Vector residual = dual.apply(lambda) - dual.d();
    CHECK(coarse.P(residual + jump).norm() < 1e-10 * residual.norm());
    CHECK(coarse.P(jump).norm() > 1e-3 * jump.norm());  // some contact is open
    const Vector own = dual.elastic(lambda);
    CHECK(test::relative(dual.jump(own), -residual) < 1e-9);  // λ is balanced
    const Vector u = dual.moved(own, coarse.amounts(jump - dual.jump(own)));
    CHECK(test::relative(solver::average(torn, u), direct.state.u.here()) < 1e-10);
    CHECK(test::disagreement(torn, u) < 1e-10 * direct.state.u.here().lpNorm<Eigen::Infinity>());
  }
}

TEST_CASE("equal pieces share a factor") {
  CHECK(test::dual_of(test::cut_box(true, 4)).kinds().size() == 1);
  // Supports in the matrices: two kinds of held pieces (below and above y = 0.6), and the right ones.
  CHECK(test::dual_of(test::cut_box(false, 4)).kinds().size() == 3);
  auto p = test::cut_box(true, 4);
  const double bytes = test::dual_of(p).factor_bytes();
  auto other = std::make_shared<problem::Stiffness>(*p.subdomains[3].stiffness);
  algebra::SparseMatrix lower = other->K;
  lower.coeffRef(0, 0) *= 1 + 1e-11;
  other->K = lower;
  p.subdomains[3].stiffness = other;
  const auto dual = test::dual_of(p);
  CHECK(dual.kinds() == std::vector<std::vector<int>>{{0, 1, 2, 4, 5, 6, 7}, {3}});
  CHECK(dual.factor_bytes() == doctest::Approx(2 * bytes));
}

TEST_CASE("without a kernel K⁺ is the inverse; without subdomains each block is a piece") {
  test::Random random(521);
  problem::Problem p;
  for (const char* name : {"a", "b"})
    problem::add(p, test::block(name, test::spring_grid(random, 4, 3, 2, 0.2), random.vector(24), 2, false));
  DenseMatrix B = random.matrix(5, 48);
  p.B = test::rows(B);
  p.c = random.vector(5);
  p.groups = {test::group(problem::unilateral(), 0, 5)};
  const auto dual = test::dual_of(p);
  CHECK(dual.e().size() == 0);
  const DenseMatrix K = test::stiffness(p), scaled = dual.scale().asDiagonal() * B;
  const algebra::Ldlt inverse(K);
  const DenseMatrix F = test::as_matrix(5, [&](const Vector& v) { return dual.apply(v); });
  CHECK(test::relative(F, scaled * inverse.solve(DenseMatrix(scaled.transpose()))) < 1e-12);
  CHECK(test::relative(dual.d(), scaled * inverse.solve(p.load()) - dual.scale().cwiseProduct(p.c)) < 1e-12);
  const Vector lambda = random.vector(5);
  CHECK(test::relative(dual.elastic(lambda), inverse.solve(Vector(p.load() - scaled.transpose() * lambda))) < 1e-12);
}

TEST_CASE("a floating body whose rows leave motions unnoticed still has its projectors") {
  // A free box on rows below: the coarse space has the three motions along the rows.
  problem::Problem p;
  CutBody body{test::box(test::Family::q1, 4, 2, 2, {0, 0, 0}, {2, 1, 1})};
  body.load = [](const Point&) { return Point{0, 0, -1}; };
  body.piece = test::boxes({2, 1, 1}, {2, 1, 1});
  const auto numbering = test::add(p, body);
  test::add_rows(p, body, numbering, 2, -1.0, [](const Point& x) { return x[2] == 0; }, 0);
  const auto dual = test::dual_of(p);
  const solver::CoarseSpace coarse(dual.G(), dual.e());
  CHECK(coarse.modes() == 12);
  CHECK(coarse.held().size() == 3);
  CHECK(coarse.imbalance() < 1e-12);
  const DenseMatrix P = test::projector(coarse, dual.rows());
  CHECK((P * P - P).norm() < 1e-12 * P.norm());
  CHECK(P.trace() == doctest::Approx(dual.rows() - 9));
  CHECK((dual.G() * P).norm() < 1e-12 * P.norm());
}

TEST_CASE("blocks that no row touches, held, free or without unknowns") {
  test::Random random(522);
  problem::Problem p;
  problem::add(p, test::block("held", test::spring_grid(random, 3, 3, 2, 0.2), random.vector(18), 2, false));
  problem::add(p, test::block("empty", {test::lower(DenseMatrix(0, 0)), {}, 0}, Vector(0), 2, false));
  Vector f = random.vector(18);
  for (int i = 0; i < 2; ++i)
    for (int k = i; k < 16; k += 2) f[16 + i] = k == i ? -f[k] : f[16 + i] - f[k];  // balanced
  problem::add(p, test::block("free", test::spring_grid(random, 3, 3, 2, 0), f, 2, true));
  p.B.resize(0, p.unknowns());
  p.c.resize(0);
  const auto dual = test::dual_of(p);
  const solver::CoarseSpace coarse(dual.G(), dual.e());
  CHECK(coarse.held().size() == 2);
  const Vector u = solver::average(dual.torn(), dual.elastic(Vector(0)));
  CHECK((problem::stiffness_times(p, u) - p.load()).norm() < 1e-12 * p.load().norm());
  Monitor quiet;
  CHECK(dual.apply(Vector(0)).size() == 0);
  CHECK(solver::PieceStiffness(dual).apply(Vector(0)).size() == 0);
  CHECK(solver::PieceStiffness(dual, algebra::Ordering::automatic, quiet).apply(Vector(0)).size() == 0);
}

TEST_CASE("a piece whose kernel is larger than said is refused, naming it and where") {
  auto p = test::cut_box(true, 4);
  p.subdomains[5].stiffness = std::make_shared<const problem::Stiffness>(
      problem::Stiffness{p.subdomains[5].K(), DenseMatrix(p.subdomains[5].size(), 0)});
  CHECK_THROWS_WITH_AS(test::dual_of(p), doctest::Contains("the stiffness of piece 6 of 'body 1' is singular at node "), InputError);
}

TEST_CASE("a request to stop is seen between the pieces") {
  struct Stops : Monitor {
    bool stop() override { return true; }
  } stops;
  problem::Clock clock;
  const auto p = test::cut_box(true, 2);
  CHECK_THROWS_AS(DualProblem(p, algebra::Ordering::automatic, clock, stops), Interrupted);
}
