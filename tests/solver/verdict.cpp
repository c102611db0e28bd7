// The one check of results: what is off its laws, out of equilibrium or not finite is not called converged.
#include "solver/core/verdict.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "../support/programs.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// Springs of stiffness 2 under f, each on a row of the law, without gaps.
problem::Problem rows_under(const std::shared_ptr<const problem::Law>& law, const Vector& f) {
  const auto n = f.size();
  problem::Problem p = test::program(2 * DenseMatrix::Identity(n, n), f, DenseMatrix::Identity(n, n), Vector::Zero(n));
  p.groups = {{"rows", law, 0, static_cast<int>(n)}};
  return p;
}

/// A result in equilibrium, with these multipliers, that its method calls converged.
solver::Result claimed(const problem::Problem& p, const Vector& lambda) {
  solver::Result r;
  r.converged = true;
  r.method = "some method";
  r.reason = "it says so";
  r.state = {(p.blocks[0].f - lambda) / 2, lambda};
  return r;
}

}  // namespace

TEST_CASE("a result that is off any law is not converged, whatever the method says") {
  const Vector f{{1, 10}};
  const struct { std::shared_ptr<const problem::Law> law; Vector right, wrong; } cases[] = {
      {problem::unilateral(), Vector{{1, 10}}, Vector{{1, 9.99}}},
      {problem::bilateral(), Vector{{1, 10}}, Vector{{1.01, 10}}},
      {problem::elastic({2, 2}), Vector{{0.5, 5}}, Vector{{0.5, 5.001}}},
      {problem::limited("capped", {{2, -1, 1}, {2, -1, 1}}), Vector{{0.5, 1}}, Vector{{0.5, 1.01}}}};
  for (const auto& [law, right, wrong] : cases) {
    const problem::Problem p = rows_under(law, f);
    solver::Result good = claimed(p, right), bad = claimed(p, wrong);
    CHECK(solver::judge(p, good).law < 1e-12);
    CHECK(good.converged);
    CHECK(good.reason == "it says so");
    CHECK(solver::judge(p, bad).law > 1e-5);
    CHECK_FALSE(bad.converged);
    CHECK(bad.reason.find("off the laws") != std::string::npos);
    CHECK(bad.reason.find("; the method's own test was met: it says so") != std::string::npos);  // not as if it were so
    bad.converged = true;
    bad.asked = 10;  // a rough tol was asked for: 1 is as wrong as can be, where nothing but the wrong row moves
    solver::judge(p, bad);
    CHECK(bad.converged);
  }
}

TEST_CASE("a penalised result may be off its laws by what it says, not by more") {
  const problem::Problem p = rows_under(problem::unilateral(), Vector{{1, 10}});
  solver::Result r = claimed(p, Vector{{1, 10}} * 0.99);  // rows of stiffness 198
  r.penalty = solver::PenaltyError{100, 0.05, 0};
  solver::judge(p, r);
  CHECK(r.converged);
  r.penalty->penetration = 0.04;
  solver::judge(p, r);
  CHECK_FALSE(r.converged);
}

TEST_CASE("numbers that are not finite are no result") {
  const problem::Problem p = rows_under(problem::unilateral(), Vector{{1, 10}});
  for (const double bad : {NAN, INFINITY, -INFINITY}) {
    solver::Result r = claimed(p, Vector{{1, bad}});
    CHECK_THROWS_WITH(solver::judge(p, r), doctest::Contains("beyond the range of numbers"));
  }
}
