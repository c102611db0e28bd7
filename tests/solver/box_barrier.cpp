#include <doctest/doctest.h>

#include <Eigen/LU>

#include "../support/programs.hpp"
#include "../support/random.hpp"
#include "solver/active/box_barrier.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using solver::BoxProgram;

namespace {

constexpr double kTol = 1e-10;  // as pdas asks for; products of λ and what presses are about this, and each of them its root where both are small

/// A program with a solution that is known: λ, α and what the bounds press with are chosen, g and e follow.
struct Known {
  BoxProgram program;
  Vector lambda, alpha;
};

struct Sort {
  int rows, rank, motions;
  bool degenerate = false;  ///< some bounds touch without pressing
  bool pinned = false;
};

Known known(test::Random& random, const Sort& sort) {
  const int n = sort.rows;
  const DenseMatrix A = random.matrix(n, sort.rank);
  Known k{{A * A.transpose(), Vector::Zero(n), Vector(n), Vector(n), random.matrix(n, sort.motions), Vector(), Vector::Ones(n), 1}, Vector(n), random.vector(sort.motions)};
  BoxProgram& p = k.program;
  Vector pressed = Vector::Zero(n);
  for (int i = 0; i < n; ++i) {
    k.lambda[i] = random.between(-1, 1);
    const double press = sort.degenerate && random.coin() ? 0 : random.between(0.1, 1), far = random.coin() ? INFINITY : random.between(0.1, 3);
    p.low[i] = -INFINITY, p.high[i] = INFINITY;
    switch (random.below(sort.pinned ? 5 : 4)) {
      case 0: p.low[i] = k.lambda[i], p.high[i] = k.lambda[i] + far, pressed[i] = press; break;
      case 1: p.high[i] = k.lambda[i], p.low[i] = k.lambda[i] - far, pressed[i] = -press; break;
      case 2: p.low[i] = k.lambda[i] - random.between(0.1, 2), p.high[i] = k.lambda[i] + far; break;
      case 3: break;  // no bounds
      default: p.low[i] = p.high[i] = k.lambda[i], pressed[i] = random.between(-1, 1);
    }
  }
  p.g = p.H * k.lambda - p.N * k.alpha - pressed;
  p.e = p.N.transpose() * k.lambda;
  return k;
}

double objective(const BoxProgram& p, const Vector& x) { return 0.5 * x.dot(p.H * x) - p.g.dot(x); }

/// Optimality: Hλ − g − Nα is what bounds press with, of the sign of the side, and nothing between.
void check_optimal(const BoxProgram& p, const solver::BoxSolution& s, double tolerance) {
  const double scale = std::max({1.0, p.g.lpNorm<Eigen::Infinity>(), p.e.size() ? p.e.lpNorm<Eigen::Infinity>() : 0.0});
  const Vector pressed = p.H * s.lambda - p.g - p.N * s.alpha;
  if (p.e.size()) CHECK((p.N.transpose() * s.lambda - p.e).lpNorm<Eigen::Infinity>() < tolerance * scale);
  for (int i = 0; i < s.lambda.size(); ++i) {
    CHECK(s.lambda[i] >= p.low[i]);
    CHECK(s.lambda[i] <= p.high[i]);
    if (p.low[i] == p.high[i]) continue;
    const double to_low = std::isfinite(p.low[i]) ? s.lambda[i] - p.low[i] : INFINITY, to_high = std::isfinite(p.high[i]) ? p.high[i] - s.lambda[i] : INFINITY;
    CHECK(std::min(std::max(pressed[i], 0.0), to_low) < std::sqrt(tolerance) * scale);
    CHECK(std::min(std::max(-pressed[i], 0.0), to_high) < std::sqrt(tolerance) * scale);
    if (s.side[i] == 0) CHECK(std::abs(pressed[i]) < std::sqrt(tolerance) * scale);
    if (s.side[i] < 0) CHECK(to_low < std::sqrt(tolerance) * scale);
    if (s.side[i] > 0) CHECK(to_high < std::sqrt(tolerance) * scale);
  }
}

}  // namespace

TEST_CASE("programs with a known solution: bounds of every kind, motions, rows with one multiplier only, singular H") {
  test::Random random(23);
  int most = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 3 + random.below(30), motions = random.below(std::min(4, n));
    const bool singular = random.coin(), degenerate = random.coin(), pinned = random.coin();
    CAPTURE(trial);
    const Known k = known(random, {n, singular ? std::max(1, n / 2) : n + 3, motions, degenerate, pinned});
    const auto s = solver::solve_by_barrier(k.program, kTol);
    REQUIRE(s.converged);
    most = std::max(most, s.iterations);
    check_optimal(k.program, s, 1e-8);
    // All solutions have one objective; without singularity there is one only.
    const double best = objective(k.program, k.lambda);
    CHECK(std::abs(objective(k.program, s.lambda) - best) < 1e-7 * (1 + std::abs(best)));
    if (!singular && !degenerate) {
      CHECK((s.lambda - k.lambda).lpNorm<Eigen::Infinity>() < 1e-6);
      for (int i = 0; i < n; ++i)
        if (k.program.low[i] < k.program.high[i]) CHECK(s.side[i] == (k.lambda[i] == k.program.low[i] ? -1 : k.lambda[i] == k.program.high[i] ? 1 : 0));
    }
  }
  CHECK(most < 40);
}

TEST_CASE("units of forces and of rows do not matter") {
  test::Random random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const Known k = known(random, {12, 15, 2});
    const auto s = solver::solve_by_barrier(k.program, kTol);
    for (const double force : {1e-9, 1e9}) {
      Vector unit(12);  // λ = force · unit · λ'
      for (double& u : unit) u = std::pow(10.0, random.between(-3, 3));
      BoxProgram scaled = k.program;
      scaled.H = unit.asDiagonal() * k.program.H * unit.asDiagonal();
      scaled.g = force * unit.cwiseProduct(k.program.g);
      scaled.low = force * k.program.low.cwiseQuotient(unit), scaled.high = force * k.program.high.cwiseQuotient(unit);
      scaled.N = unit.asDiagonal() * k.program.N;
      scaled.e = force * k.program.e;
      scaled.unit = force * unit.cwiseInverse(), scaled.energy = force * force;
      const auto t = solver::solve_by_barrier(scaled, kTol);
      REQUIRE(t.converged);
      CHECK((t.lambda.cwiseProduct(unit) / force - s.lambda).lpNorm<Eigen::Infinity>() < 1e-6);
      CHECK(t.side == s.side);
    }
  }
}

TEST_CASE("bounds far beyond what is borne do not slow it down") {
  test::Random random(9);
  for (const double bound : {1e3, 1e8, 1e13}) {
    const DenseMatrix A = random.matrix(20, 24);
    BoxProgram p{A * A.transpose(), random.vector(20), Vector::Zero(20), Vector::Constant(20, bound), DenseMatrix(20, 0), Vector(0), Vector::Ones(20), 1}, open = p;
    open.high.setConstant(INFINITY);
    const auto s = solver::solve_by_barrier(p, kTol), t = solver::solve_by_barrier(open, kTol);
    REQUIRE(s.converged);
    CHECK(s.side == t.side);
    CHECK((s.lambda - t.lambda).lpNorm<Eigen::Infinity>() < 1e-7);
  }
}

TEST_CASE("no rows, rows without freedom, and programs that have no solution") {
  const BoxProgram none{DenseMatrix(0, 0), Vector(0), Vector(0), Vector(0), DenseMatrix(0, 0), Vector(0), Vector(0), 1};
  CHECK(solver::solve_by_barrier(none, kTol).lambda.size() == 0);
  const BoxProgram pinned{DenseMatrix::Identity(2, 2), Vector{{1, 2}}, Vector{{3, 4}}, Vector{{3, 4}}, DenseMatrix(2, 0), Vector(0), Vector::Ones(2), 1};
  CHECK(solver::solve_by_barrier(pinned, kTol).lambda == Vector{{3, 4}});
  // λ ≥ 0 with sum −1.
  const BoxProgram contradictory{DenseMatrix::Identity(2, 2), Vector{{1, 2}}, Vector::Zero(2), Vector::Constant(2, INFINITY), DenseMatrix::Ones(2, 1), Vector{{-1.0}}, Vector::Ones(2), 1};
  CHECK_FALSE(solver::solve_by_barrier(contradictory, kTol).converged);
  // −λ has no least value.
  const BoxProgram unbounded{DenseMatrix::Zero(2, 2), Vector{{1, 1}}, Vector::Zero(2), Vector::Constant(2, INFINITY), DenseMatrix(2, 0), Vector(0), Vector::Ones(2), 1};
  CHECK_FALSE(solver::solve_by_barrier(unbounded, kTol).converged);
}

TEST_CASE("the dual of a problem with contact, springs and friction: what enumeration of all active sets finds") {
  test::Random random(31);
  Monitor quiet;
  for (int trial = 0; trial < 40; ++trial) {
    const int n = 6 + random.below(4), rows = 3 + random.below(5);
    const auto p = test::program(random.positive_definite(n, 0.5), random.vector(n), random.matrix(rows, n), 0.3 * random.vector(rows));
    const auto exact = test::by_enumeration(p);
    if (!exact) continue;  // rows that contradict each other
    problem::Clock clock;
    const problem::CondensedProblem condensed(p, problem::rigid_motions(p), algebra::Ordering::automatic, clock, quiet);
    std::vector<int> all(rows);
    std::iota(all.begin(), all.end(), 0);
    const auto s = solver::solve_by_barrier(solver::box_program(p, condensed, problem::Measure(p, condensed), all, std::vector<double>(rows, 1)), 1e-11);
    REQUIRE(s.converged);
    CHECK((s.lambda - exact->lambda).lpNorm<Eigen::Infinity>() < 1e-6 * (1 + exact->lambda.lpNorm<Eigen::Infinity>()));
  }
}

TEST_CASE("pdas leaves cycles by the barrier method, too, where laws have limits") {
  // The cycles of cycles.cpp, with friction of a great bound in place of contact, are those of bilateral rows: none. With limits that contact's
  // multipliers do not reach, [0, 1e6], they are the same ones.
  Monitor quiet;
  const DenseMatrix K{{6, -5, -7}, {-5, 17, 19}, {-7, 19, 22}};
  const Vector f{{-3, 1, 3}};
  auto p = test::program(K, f, DenseMatrix::Identity(3, 3), Vector::Zero(3));
  const auto exact = test::by_enumeration(p);
  p.groups.front().law = problem::limited("limited", std::vector<problem::Limits>(3, {problem::Law::kUnbounded, 0, 1e6}));
  const auto r = solver::solve(p, test::pdas(true), quiet);
  REQUIRE(exact);
  REQUIRE(r.converged);
  CHECK((r.state.lambda - exact->lambda).norm() < 1e-9);
}
