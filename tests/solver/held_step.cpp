#include <doctest/doctest.h>

#include "../support/programs.hpp"
#include "problem/residual.hpp"
#include "solver/rows/newton.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

solver::Pdas held(std::vector<char> start = {}) {
  solver::Pdas settings = test::pdas(false, std::move(start));
  settings.interior = true;
  return settings;
}

constexpr int kUnknowns = 20, kRows = 18;

/// The first twelve rows act on one unknown each, the others on three; any of them are linearly independent but by accident.
DenseMatrix few_unknowns(test::Random& random) {
  DenseMatrix B = DenseMatrix::Zero(kRows, kUnknowns);
  for (int r = 0; r < kRows; ++r)
    for (int k = 0; k < (r < 12 ? 1 : 3); ++k) B(r, (r + 2 * k) % kUnknowns) = random.between(0.5, 1.5) * (random.between(-1, 1) < 0 ? -1 : 1);
  return B;
}

}  // namespace

TEST_CASE("pdas on the unknowns: every law, rows of one unknown and of several, as on the condensed problem") {
  test::Random random(401);
  Monitor quiet;
  for (int trial = 0; trial < 200; ++trial) {
    auto p = test::program(random.positive_definite(kUnknowns, 0.3), 3 * random.vector(kUnknowns), few_unknowns(random), 0.3 * random.vector(kRows));
    std::vector<problem::Limits> friction(5);
    for (auto& f : friction) f = {INFINITY, -random.between(0, 1), random.between(0, 1)};
    const double k = std::pow(10, random.between(-2, 3));
    p.groups = {test::group(problem::unilateral(), 0, 5), test::group(problem::limited("friction", friction), 5, 5), test::group(problem::elastic({k, 1}), 10, 2),
                test::group(problem::unilateral(), 12, 2), test::group(problem::limited("capped", {{k, -0.5, 0.5}, {1, 0, 0.4}}), 14, 2),
                test::group(problem::bilateral(), 16, 1), test::group(problem::unequal_elastic({{k, 2}}), 17, 1)};
    const auto reference = solver::solve(p, test::pdas(true), quiet);
    const auto r = solver::solve(p, held(), quiet);
    REQUIRE_MESSAGE(reference.converged, reference.reason);
    REQUIRE_MESSAGE(r.converged, r.reason);
    CHECK(r.iterations <= 3);
    CHECK((r.state.u.here() - reference.state.u.here()).norm() <= 1e-9 * reference.state.u.here().norm());
    CHECK((r.state.lambda - reference.state.lambda).norm() <= 1e-8 * reference.state.lambda.norm());
    const auto residual = problem::residual(p, r.state);
    CHECK(residual.equilibrium < 1e-11);
    CHECK(residual.law < 1e-9);
  }
}

TEST_CASE("from the same start, the same active sets as on the whole system") {
  test::Random random(402);
  Monitor quiet;
  for (int trial = 0; trial < 50; ++trial) {
    const auto p = test::program(random.positive_definite(kUnknowns, 0.3), 3 * random.vector(kUnknowns), few_unknowns(random), 0.3 * random.vector(kRows));
    const std::vector<char> start(kRows, 0);
    const auto full = solver::solve(p, test::pdas(false, start), quiet), r = solver::solve(p, held(start), quiet);
    REQUIRE_MESSAGE(full.converged, full.reason);
    REQUIRE_MESSAGE(r.converged, r.reason);
    CHECK(r.active_sets == full.active_sets);
  }
}

TEST_CASE("two rows on one unknown: agreeing ones are closed together, contradicting ones told") {
  Monitor quiet;
  DenseMatrix B = DenseMatrix::Zero(3, 2);
  B(0, 0) = 1, B(1, 0) = 2, B(2, 0) = 1, B(2, 1) = 1;
  for (const double second : {0.4, 0.6}) {
    auto p = test::program(DenseMatrix::Identity(2, 2), Vector{{3, 1}}, B, Vector{{0.2, second, 0.5}});
    p.groups = {test::group(problem::bilateral(), 0, 3)};
    const auto r = solver::solve(p, held(), quiet);
    CAPTURE(r.reason);
    CHECK(r.converged == (second == 0.4));
    if (!r.converged) {
      CHECK(r.reason.find("contradict") != std::string::npos);
      continue;
    }
    CHECK((r.state.u.here() - Vector{{0.2, 0.3}}).norm() < 1e-12);
    CHECK(problem::residual(p, r.state).equilibrium < 1e-12);
  }
}

TEST_CASE("a body that only rows hold, and one that no load or gap moves") {
  Monitor quiet;
  // Three masses in a line on springs between them, pressed onto stops; nothing else holds them.
  const DenseMatrix K{{1, -1, 0}, {-1, 2, -1}, {0, -1, 1}};
  auto p = test::program(K, Vector{{1, 0.5, 0.25}}, DenseMatrix::Identity(3, 3), Vector{{0.5, 3, 0.2}});
  p.blocks.front().kernel = DenseMatrix::Ones(3, 1);
  const auto r = solver::solve(p, held(), quiet);
  REQUIRE_MESSAGE(r.converged, r.reason);
  // Both ends at their stops: 2u₂ = u₁ + u₃ + f₂.
  CHECK((r.state.u.here() - Vector{{0.5, 0.6, 0.2}}).norm() < 1e-12);
  CHECK((r.state.lambda - Vector{{1.1, 0, 0.65}}).norm() < 1e-12);

  const auto still = solver::solve(test::program(DenseMatrix::Identity(3, 3), Vector::Zero(3), DenseMatrix::Identity(3, 3), Vector::Zero(3)), held(), quiet);
  REQUIRE(still.converged);
  CHECK(still.state.u.here().norm() == 0);
}

TEST_CASE("an incomplete factor in place of the factor: the same sets, the same state") {
  test::Random random(403);
  Monitor quiet;
  for (int trial = 0; trial < 50; ++trial) {
    const auto p = test::program(random.positive_definite(kUnknowns, 0.3), 3 * random.vector(kUnknowns), few_unknowns(random), 0.3 * random.vector(kRows));
    solver::Pdas direct = held(std::vector<char>(kRows, 0)), iterative = direct;
    iterative.linear = solver::incomplete_factor();
    const auto a = solver::solve(p, direct, quiet), b = solver::solve(p, iterative, quiet);
    REQUIRE_MESSAGE(a.converged, a.reason);
    REQUIRE_MESSAGE(b.converged, b.reason);
    CHECK(b.ordering == "conjugate gradients, incomplete Cholesky factor");
    CHECK(a.active_sets == b.active_sets);
    CHECK((a.state.u.here() - b.state.u.here()).norm() <= 1e-10 * a.state.u.here().norm());
    CHECK((a.state.lambda - b.state.lambda).norm() <= 1e-9 * a.state.lambda.norm());
  }
}

TEST_CASE("friction on all unknowns: the state of newton on the condensed rows, pressures that bounds follow and given bounds") {
  test::Random random(404);
  Monitor quiet;
  constexpr int kPoints = 5;  // rows: normal ones, then two tangential ones a point
  int slipping = 0, sticking = 0;
  for (int trial = 0; trial < 40; ++trial) {
    DenseMatrix B = DenseMatrix::Zero(3 * kPoints, kUnknowns);
    for (int r = 0; r < 3 * kPoints; ++r) B(r, r) = 1, B(r, (r + 7) % kUnknowns) += random.between(-0.4, 0.4);
    Vector f = random.vector(kUnknowns), c = Vector::Zero(3 * kPoints);
    f.head(kPoints) = Vector::Constant(kPoints, 2) + random.vector(kPoints);  // onto the obstacle
    c.head(kPoints) = 0.3 * random.vector(kPoints);
    auto p = test::program(random.positive_definite(kUnknowns, 0.3), f, B, c);
    p.groups = {test::group(problem::unilateral(), 0, kPoints)};
    const bool given = trial % 2;
    const std::vector<double> value(kPoints, given ? random.between(0.1, 1) : random.between(0.1, 0.5));
    std::vector<int> normal(kPoints, -1);
    for (int k = 0; k < kPoints && !given; ++k) normal[k] = k;
    p.friction = {{"friction", given ? problem::tresca(value) : problem::coulomb(value), kPoints, 2, normal}};
    const auto reference = solver::solve(p, solver::Newton{}, quiet);
    REQUIRE_MESSAGE(reference.converged, reference.reason);
    for (const bool iterative : {false, true}) {
      solver::Pdas settings = held();
      if (iterative) settings.linear = solver::incomplete_factor();
      const auto r = solver::solve(p, settings, quiet);
      REQUIRE_MESSAGE(r.converged, r.reason);
      // Both are solved to 1e-10 of their forces.
      CHECK((r.state.u.here() - reference.state.u.here()).norm() <= 1e-8 * reference.state.u.here().norm());
      CHECK((r.state.lambda - reference.state.lambda).norm() <= 1e-8 * reference.state.lambda.norm());
      CHECK(r.slipping == reference.slipping);
      CHECK(problem::residual(p, r.state).equilibrium < 1e-11);
      slipping += r.history.back().slip, sticking += r.history.back().stick;
    }
  }
  CHECK(slipping > 40);
  CHECK(sticking > 40);
}
