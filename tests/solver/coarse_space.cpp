#include "solver/feti/coarse_space.hpp"

#include <doctest/doctest.h>

#include "../support/dual.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

namespace {

/// Some hundred rows of modes, each mode in a few rows, lengths from 1e-3 to 1e3; a chain of them.
DenseMatrix chain_of_modes(test::Random& random, int modes, int rows) {
  DenseMatrix G = DenseMatrix::Zero(modes, rows);
  for (int r = 0; r < rows; ++r)
    for (int k : {0, 1, 2, 3}) G((r * modes / rows + k) % modes, r) = random.between(-1, 1);
  for (int k = 0; k < modes; ++k) G.row(k) *= std::pow(10, random.between(-3, 3));
  return G;
}

void check_projectors(const solver::CoarseSpace& coarse, const DenseMatrix& G) {
  const int n = static_cast<int>(G.cols());
  const DenseMatrix Q = test::as_matrix(n, [&](const Vector& v) { return coarse.Q(v); });
  const DenseMatrix P = test::as_matrix(n, [&](const Vector& v) { return coarse.P(v); });
  CHECK((Q * Q - Q).norm() < 1e-12 * std::sqrt(n));
  CHECK((P * P - P).norm() < 1e-12 * std::sqrt(n));
  CHECK((P * Q).norm() < 1e-12 * std::sqrt(n));
  CHECK((Q - Q.transpose()).norm() < 1e-12 * std::sqrt(n));
  CHECK((P + Q - DenseMatrix::Identity(n, n)).norm() < 1e-12 * std::sqrt(n));
  const Vector size = G.rowwise().norm().cwiseMax(1e-300);
  CHECK((size.cwiseInverse().asDiagonal() * G * P).norm() < 1e-12 * std::sqrt(n));
  CHECK(Q.trace() == doctest::Approx(static_cast<double>(G.rows() - coarse.held().size())));
}

}  // namespace

TEST_CASE("P and Q are the projectors on and along the balanced multipliers, whatever the modes' lengths") {
  test::Random random(511);
  for (const int modes : {1, 6, 30}) {
    const DenseMatrix G = chain_of_modes(random, modes, 90);
    const Vector e = G * random.vector(90);
    const solver::CoarseSpace coarse(SparseMatrix(G.sparseView()), e);
    CHECK(coarse.held().empty());
    check_projectors(coarse, G);
    CHECK(coarse.imbalance() < 1e-13);
    CHECK((G * coarse.particular() - e).cwiseQuotient(G.rowwise().norm()).norm() < 1e-12 * coarse.particular().norm());
    CHECK(coarse.P(coarse.particular()).norm() < 1e-12 * coarse.particular().norm());
    const Vector alpha = random.vector(modes);
    CHECK(test::relative(coarse.amounts(G.transpose() * alpha), alpha) < 1e-10);
  }
}

TEST_CASE("motions that no row notices are held, as many as there are, the others not") {
  test::Random random(512);
  for (const int modes : {3, 12, 40})
    for (const int dependent : {1, 2, 3}) {
      DenseMatrix G = chain_of_modes(random, modes, 90);
      if (dependent == modes) G.setZero();
      // Combinations of all other modes take the place of some, so that as many motions jump by nothing.
      for (int k = 0; k < dependent && dependent < modes; ++k) {
        const int at = modes / 2 + k - 1;
        Vector a = random.vector(modes).cwiseQuotient(G.rowwise().norm().cwiseMax(1e-300));
        for (int j = modes / 2 - 1; j < modes / 2 - 1 + dependent; ++j) a[j] = 0;
        G.row(at) = a.transpose() * G;
      }
      const Vector e = G * random.vector(90);
      const solver::CoarseSpace coarse(SparseMatrix(G.sparseView(1, 0)), e);
      CHECK(static_cast<int>(coarse.held().size()) == dependent);
      check_projectors(coarse, G);
      CHECK(coarse.imbalance() < 1e-12);
    }
}

TEST_CASE("a coarse space that is ill-conditioned, but regular, holds nothing") {
  // Pieces of a rod in a row, one motion each, held at one end: C is the chain's matrix, condition 1.6e6.
  const int n = 1000;
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < n; ++k) {
    entries.emplace_back(k, k, 1.0);
    if (k + 1 < n) entries.emplace_back(k, k + 1, -1.0);
  }
  SparseMatrix G(n, n);
  G.setFromTriplets(entries.begin(), entries.end());
  const solver::CoarseSpace coarse(G, Vector::Ones(n));
  CHECK(coarse.held().empty());
  CHECK(coarse.imbalance() < 1e-10);
  // Held at neither end: one motion of all together.
  const SparseMatrix loose = G.rightCols(n - 1);
  Vector e = Vector::Zero(n);
  e[0] = 1, e[n - 1] = -1;
  const solver::CoarseSpace free(loose, e);
  CHECK(free.held().size() == 1);
  CHECK(free.imbalance() < 1e-10);
  CHECK(test::relative(free.particular(), Vector::Constant(n - 1, -1)) < 1e-10);
}

TEST_CASE("a load on a motion that no row notices is told; without modes or rows nothing is projected") {
  SparseMatrix G(2, 3);
  G.insert(0, 1) = 2;
  const solver::CoarseSpace coarse(G, Vector{{4, 3}});
  CHECK(coarse.held() == std::vector<int>{1});
  CHECK(coarse.imbalance() == doctest::Approx(0.6));
  CHECK(test::relative(coarse.particular(), Vector{{0, 2, 0}}) < 1e-15);

  const solver::CoarseSpace none(SparseMatrix(0, 3), Vector(0));
  CHECK(none.P(Vector{{1, 2, 3}}) == Vector{{1, 2, 3}});
  CHECK(none.amounts(Vector{{1, 2, 3}}).size() == 0);
  const solver::CoarseSpace rowless(SparseMatrix(2, 0), Vector::Zero(2));
  CHECK(rowless.held().size() == 2);
  CHECK(rowless.P(Vector(0)).size() == 0);
}
