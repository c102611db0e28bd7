#include <doctest/doctest.h>

#include "../support/programs.hpp"
#include "problem/residual.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// A string of length 1 on a floor under the load −1 per length, held at x = 1 and lifted by `lift` at x = 0: there it is off the floor up to
/// x = lift, and u = ½(lift − x)². The last closed node moves by one a step where the active set is iterated alone.
problem::Problem lifted_string(int cells, double lift) {
  const double h = 1.0 / cells;
  DenseMatrix K = DenseMatrix::Zero(cells, cells);
  Vector f = Vector::Constant(cells, -h);
  for (int i = 0; i < cells; ++i) {
    K(i, i) = 2 / h;
    if (i > 0) K(i, i - 1) = K(i - 1, i) = -1 / h;
  }
  K(0, 0) = 1 / h;
  f[0] = lift - h / 2;
  return test::program(K, f, -DenseMatrix::Identity(cells, cells), Vector::Zero(cells));
}

void check_solution(const problem::Problem& p, const solver::Result& r, double lift) {
  REQUIRE_MESSAGE(r.converged, r.reason);
  const auto residual = problem::residual(p, r.state);
  CHECK(residual.equilibrium < 1e-10);
  CHECK(residual.law < 1e-10);
  const double h = 1.0 / p.rows();
  for (int i = 0; i < p.rows(); ++i) {
    const double free = std::max(lift - i * h, 0.0);
    CHECK(std::abs(r.state.u.here()[i] - 0.5 * free * free) < h * h);
  }
}

solver::Pdas form(bool reduced, bool interior) {
  solver::Pdas settings = test::pdas(reduced);
  settings.interior = interior;
  return settings;
}

}  // namespace

TEST_CASE("rows that open one after the other: steps do not grow with their number") {
  Monitor quiet;
  for (const auto& settings : {form(true, false), form(false, false), form(false, true)})
    for (const int cells : {50, 100, 200, 400}) {
      const auto p = lifted_string(cells, 0.6);
      const auto r = solver::solve(p, settings, quiet);
      CAPTURE(cells);
      check_solution(p, r, 0.6);
      CHECK(r.iterations <= 20);
    }
}

TEST_CASE("the same from a start of one's own") {
  Monitor quiet;
  for (auto settings : {form(true, false), form(false, false), form(false, true)}) {
    const auto p = lifted_string(200, 0.6);
    settings.start.assign(p.rows(), 1);
    check_solution(p, solver::solve(p, settings, quiet), 0.6);
  }
}

TEST_CASE("what a rescue has found is kept, and confirmed though no steps are left") {
  Monitor quiet;
  for (const auto& given : {form(true, false), form(false, false)})
    for (int most = 15; most < 30; ++most) {
      auto settings = given;
      settings.max_iterations = most;
      const auto p = lifted_string(200, 0.6);
      const auto r = solver::solve(p, settings, quiet);
      check_solution(p, r, 0.6);
      CHECK(r.reason.find("left by ") != std::string::npos);
    }
}

TEST_CASE("too few steps for a rescue to begin: not converged, and said") {
  Monitor quiet;
  auto settings = form(true, false);
  settings.max_iterations = 5;
  const auto r = solver::solve(lifted_string(200, 0.6), settings, quiet);
  CHECK_FALSE(r.converged);
  CHECK(r.iterations == 5);
  CHECK(r.reason.find("no confirmed active set within 5 iterations") == 0);
}
