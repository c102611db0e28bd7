#include <doctest/doctest.h>

#include <set>

#include "../support/programs.hpp"
#include "problem/residual.hpp"
#include "solver/active/linearisation.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// Symmetric positive definite programs u ≤ 0 on which plain PDAS cycles from the closed start, found
/// by search over small integers; two or three sets in turn.
struct Cycle {
  DenseMatrix K;
  Vector f;
};

std::vector<Cycle> cycles() {
  std::vector<Cycle> all(5);
  all[0] = {DenseMatrix{{6, -5, -7}, {-5, 17, 19}, {-7, 19, 22}}, Vector{{-3, 1, 3}}};
  all[1] = {DenseMatrix{{14, 15, -7}, {15, 17, -6}, {-7, -6, 6}}, Vector{{-4, -2, 4}}};
  all[2] = {DenseMatrix{{9, -9, -10}, {-9, 14, 13}, {-10, 13, 13}}, Vector{{-3, 2, 3}}};
  all[3] = {DenseMatrix{{27, -15, 15}, {-15, 11, -5}, {15, -5, 13}}, Vector{{-4, 3, -1}}};
  all[4] = {DenseMatrix{{10, -8, -9}, {-8, 9, 11}, {-9, 11, 14}}, Vector{{-4, 3, 2}}};
  return all;
}

}  // namespace

TEST_CASE("active sets that cycle are noticed, named and left with the right solution") {
  Monitor quiet;
  for (const auto& [K, f] : cycles())
    for (const bool reduced : {true, false}) {
      auto p = test::program(K, f, DenseMatrix::Identity(3, 3), Vector::Zero(3));
      p.row_name = [](int r) { return "place " + std::to_string(r); };
      const auto r = solver::solve(p, test::pdas(reduced), quiet);
      REQUIRE(r.converged);
      CHECK(r.iterations < 20);
      CHECK(r.reason.find("active set confirmed; before, active sets repeated at place ") == 0);
      CHECK(r.reason.find("left by sweeps that decrease the dual energy") != std::string::npos);
      const auto exact = test::by_enumeration(p);
      REQUIRE(exact);
      CHECK((r.state.u.here() - exact->u.here()).norm() <= 1e-12 * (1 + exact->u.here().norm()));
      CHECK((r.state.lambda - exact->lambda).norm() <= 1e-12 * (1 + exact->lambda.norm()));
      CHECK(r.active_sets.back() == [&] {
        std::vector<char> active(3);
        for (int i = 0; i < 3; ++i) active[i] = exact->lambda[i] > 1e-9;
        return active;
      }());
    }
}

TEST_CASE("a cycle is noticed with a solver that iterates, too, whose first states are rough") {
  Monitor quiet;
  for (const auto& [K, f] : cycles()) {
    const auto p = test::program(K, f, DenseMatrix::Identity(3, 3), Vector::Zero(3));
    auto settings = test::pdas(false);
    settings.linear = solver::incomplete_factor();
    const auto r = solver::solve(p, settings, quiet);
    REQUIRE(r.converged);
    CHECK(r.reason.find("active set confirmed; before, active sets repeated at row ") == 0);
    CHECK(r.iterations < 20);
    CHECK((r.state.u.here() - test::by_enumeration(p)->u.here()).norm() <= 1e-10 * (1 + r.state.u.here().norm()));  // conjugate gradients aim at 1e-12 of the forces
  }
}

TEST_CASE("a row without a name is named by its number") {
  Monitor quiet;
  const auto [K, f] = cycles()[0];
  const auto r =
      solver::solve(test::program(K, f, DenseMatrix::Identity(3, 3), Vector::Zero(3)), test::pdas(true), quiet);
  CHECK(r.reason.find("active set confirmed; before, active sets repeated at row ") == 0);
}

TEST_CASE("a cycle that iterations do not suffice to leave is not called a solution, and its state is in equilibrium") {
  Monitor quiet;
  for (const auto& [K, f] : cycles())
    for (const bool reduced : {true, false})
      for (int most = 1; most < 5; ++most) {
        const auto p = test::program(K, f, DenseMatrix::Identity(3, 3), Vector::Zero(3));
        auto settings = test::pdas(reduced);
        settings.max_iterations = most;
        const auto r = solver::solve(p, settings, quiet);
        CHECK_FALSE(r.reason.empty());
        CHECK(problem::residual(p, r.state).equilibrium < 1e-12);
        if (most < 3) CHECK_FALSE(r.converged);
      }
}

TEST_CASE("many small cycles at once, weakly coupled, are left together") {
  test::Random random(71);
  Monitor quiet;
  const auto all = cycles();
  for (int trial = 0; trial < 20; ++trial) {
    const int copies = 12, n = 3 * copies;
    DenseMatrix K = 0.01 * random.positive_definite(n, 0) / n;
    Vector f(n);
    for (int k = 0; k < copies; ++k) {
      const auto& [Kk, fk] = all[random.below(5)];
      K.block(3 * k, 3 * k, 3, 3) += Kk;
      f.segment(3 * k, 3) = fk;
    }
    const auto p = test::program(K, f, DenseMatrix::Identity(n, n), Vector::Zero(n));
    for (const bool reduced : {true, false}) {
      const auto r = solver::solve(p, test::pdas(reduced), quiet);
      REQUIRE_MESSAGE(r.converged, r.reason);
      CHECK(r.reason.find("active set confirmed; before, active sets repeated at ") == 0);
      CHECK(problem::residual(p, r.state).equilibrium < 1e-11);
      CHECK(problem::residual(p, r.state).law < 1e-10);
    }
  }
}

TEST_CASE("active sets of rigid rows are told apart, however many there are") {
  constexpr int kRows = 200;
  const auto p = test::program(DenseMatrix::Identity(kRows, kRows), Vector::Zero(kRows), DenseMatrix::Identity(kRows, kRows), Vector::Zero(kRows));
  std::set<std::size_t> told;
  int sets = 0;
  for (int first = 0; first < kRows; ++first)
    for (int end = first + 1; end <= kRows; ++end, ++sets) {
      std::vector<char> active(kRows, 0);
      std::fill(active.begin() + first, active.begin() + end, char(1));
      told.insert(solver::from_flags(p, active, Vector::Ones(kRows)).fingerprint());
    }
  CHECK(static_cast<int>(told.size()) == sets);
}
