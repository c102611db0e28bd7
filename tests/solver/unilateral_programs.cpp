#include <doctest/doctest.h>

#include "../support/programs.hpp"
#include "problem/residual.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using test::Random;

namespace {

std::vector<char> flags(unsigned set, int n) {
  std::vector<char> result(n);
  for (int i = 0; i < n; ++i) result[i] = set >> i & 1;
  return result;
}

/// Relative to the condition of the matrices below (at most 1e5).
constexpr double kClose = 1e-8;

}  // namespace

TEST_CASE("PDAS finds the solution that enumeration finds, from any start") {
  Random random(61);
  Monitor quiet;
  for (int trial = 0; trial < 400; ++trial) {
    const int n = 1 + trial % 8;
    const DenseMatrix K = random.positive_definite(n, trial % 2 ? 0.5 : 1e-3);
    const DenseMatrix B = DenseMatrix::Identity(n, n);
    const auto p = test::program(K, random.vector(n), B, trial % 3 ? Vector(random.vector(n) * 0.3) : Vector::Zero(n));
    const auto exact = test::by_enumeration(p);
    REQUIRE(exact);
    for (const bool reduced : {true, false}) {
      const auto start = trial % 5 ? std::vector<char>{} : flags(random.below(1 << n), n);
      const auto r = solver::solve(p, test::pdas(reduced, start), quiet);
      REQUIRE_MESSAGE(r.converged, r.reason);
      CHECK((r.state.u.here() - exact->u.here()).norm() <= kClose * (exact->u.here().norm() + p.blocks[0].f.norm() / K.norm()));
      CHECK((r.state.lambda - exact->lambda).norm() <= kClose * (exact->lambda.norm() + p.blocks[0].f.norm()));
    }
  }
}

TEST_CASE("rows that couple several unknowns: as many, fewer and more rows than unknowns") {
  Random random(62);
  Monitor quiet;
  for (int trial = 0; trial < 150; ++trial) {
    const int n = 3 + trial % 4, m = 1 + trial % 7;
    const Vector inside = random.vector(n);
    const DenseMatrix B = random.matrix(m, n);
    // Gaps about an interior point keep the set of admissible u from being empty.
    const Vector c = B * inside + random.vector(m).cwiseAbs() * 0.3;
    const auto p = test::program(random.positive_definite(n, 0.3), 3 * random.vector(n), B, c);
    const auto exact = test::by_enumeration(p);
    REQUIRE(exact);
    const auto r = solver::solve(p, test::pdas(true), quiet);
    if (!r.converged) {
      CHECK_FALSE(r.reason.empty());  // more active rows than unknowns: refused, not called a solution
      CHECK(m > n);
      continue;
    }
    CHECK((r.state.u.here() - exact->u.here()).norm() <= kClose * (1 + exact->u.here().norm()));
    CHECK(problem::residual(p, r.state).law < kClose);
  }
}

TEST_CASE("an M-matrix: monotone, at most n + 1 solves from every start") {
  Monitor quiet;
  DenseMatrix K(3, 3);
  K << 2, -1, 0, -1, 2, -1, 0, -1, 2;
  const Vector q{{-1, 3, -1}};  // LCP 0 ≤ z ⟂ Kz + q ≥ 0, solution (½, 0, ½)
  const auto p = test::program(K, -q, -DenseMatrix::Identity(3, 3), Vector::Zero(3));
  for (unsigned set = 0; set < 8; ++set)
    for (const bool reduced : {true, false}) {
      const auto r = solver::solve(p, test::pdas(reduced, flags(set, 3)), quiet);
      REQUIRE(r.converged);
      CHECK(r.iterations <= 4);
      CHECK((r.state.u.here() - Vector{{0.5, 0, 0.5}}).norm() < 1e-14);
      CHECK(r.reason == "active set confirmed");
    }
}

TEST_CASE("Fathi's matrix, exponential for pivoting methods, takes seven solves from the closed start") {
  Monitor quiet;
  DenseMatrix U = DenseMatrix::Constant(6, 6, 2).triangularView<Eigen::StrictlyLower>();
  U.diagonal().setOnes();
  const auto p = test::program(U * U.transpose(), Vector::Ones(6), -DenseMatrix::Identity(6, 6), Vector::Zero(6));
  const auto exact = test::by_enumeration(p);
  REQUIRE(exact);
  for (unsigned set = 0; set < 64; ++set) {
    const auto r = solver::solve(p, test::pdas(true, flags(set, 6)), quiet);
    REQUIRE(r.converged);
    CHECK((r.state.u.here() - exact->u.here()).norm() < 1e-9);
    CHECK(r.reason == "active set confirmed");
    if (set == 63) CHECK(r.iterations == 7);
  }
}

TEST_CASE("the multiplier ρ does not change the path of a contact problem") {
  Random random(63);
  Monitor quiet;
  for (int trial = 0; trial < 30; ++trial) {
    const auto p = test::program(random.positive_definite(6, 2), random.vector(6), DenseMatrix::Identity(6, 6),
                                 random.vector(6) * 0.1);
    auto settings = test::pdas(true);
    const auto one = solver::solve(p, settings, quiet);
    for (double rho : {1e-3, 1e3}) {
      settings.rho = rho;
      CHECK(solver::solve(p, settings, quiet).active_sets == one.active_sets);
    }
  }
}

TEST_CASE("a history has one entry an iteration, the last without changes") {
  Random random(64);
  Monitor quiet;
  const auto p =
      test::program(random.positive_definite(8, 1), random.vector(8), DenseMatrix::Identity(8, 8), Vector::Zero(8));
  const auto r = solver::solve(p, test::pdas(true), quiet);
  REQUIRE(r.converged);
  REQUIRE(static_cast<int>(r.history.size()) == r.iterations);
  CHECK(r.active_sets.size() == r.history.size());
  CHECK(r.history.back().changed == 0);
  CHECK(r.history.back().residual < 1e-12);
}

TEST_CASE("rho may be anything: what rounding leaves of a zero is not measured by it") {
  test::Random random(77);
  Monitor quiet;
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 6;
    const auto p = test::program(random.positive_definite(n, 0.5), 2 * random.vector(n), DenseMatrix::Identity(n, n),
                                 0.3 * random.vector(n));
    const auto exact = test::by_enumeration(p);
    REQUIRE(exact);
    for (const double rho : {1e-16, 1e-12, 1e-6, 1e6, 1e12, 1e16})
      for (const bool reduced : {true, false}) {
        auto method = test::pdas(reduced);
        method.rho = rho;
        const auto r = solver::solve(p, method, quiet);
        REQUIRE_MESSAGE(r.converged, r.reason);
        CHECK((r.state.u.here() - exact->u.here()).norm() <= 1e-10 * exact->u.here().norm());
      }
  }
}
