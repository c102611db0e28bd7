// The alternating algorithm and the loop over given friction on one node, K = [1 ½; ½ 1] (tangential, normal;
// "F1" of ../shared/reference/failure_cases.json), W = K⁻¹ = 4/3 [1 −½; −½ 1], in closed form.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/friction.hpp"
#include "solver/rows/coulomb_loop.hpp"
#include "solver/rows/newton.hpp"
#include "solver/rows/projected_cg.hpp"
#include "solver/rows/uzawa_pdas.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// u = (u_t, u_n), u_n ≥ 0 opens: the normal row is −u_n, the forces on the node are −Bᵀλ.
problem::Problem one_node(const Vector& f, std::shared_ptr<const problem::Friction> law) {
  auto p = test::program(DenseMatrix{{1, 0.5}, {0.5, 1}}, f, DenseMatrix{{0, -1}, {1, 0}}, Vector::Zero(2));
  p.groups = {test::group(problem::unilateral(), 0, 1)};
  p.friction = {{"friction", std::move(law), 1, 1, {0}}};
  return p;
}

solver::Result loop(const problem::Problem& p, std::shared_ptr<const solver::RowMethod> inner) {
  Monitor quiet;
  solver::CoulombLoop method;
  method.inner = std::move(inner);
  method.max_iterations = 2000;
  return solver::solve(p, method, quiet);
}

}  // namespace

TEST_CASE("a sliding node: the loop over given friction contracts by mu |W_nt| / W_nn = mu / 2") {
  for (const double mu : {0.1, 1.0, 1.9})
    for (const auto& inner : {std::shared_ptr<const solver::RowMethod>(std::make_shared<solver::Newton>()),
                              std::shared_ptr<const solver::RowMethod>(std::make_shared<solver::ProjectedCg>())}) {
      const auto r = loop(one_node(Vector{{2 * mu, -1}}, problem::coulomb({mu})), inner);
      REQUIRE_MESSAGE(r.converged, r.reason);
      // u_n = 0: u_t = 2μ − μR_n and R_n = 1 + u_t/2.
      const double u_t = mu / (1 + mu / 2), R_n = 1 + u_t / 2;
      CHECK(r.state.u.here()[0] == doctest::Approx(u_t).epsilon(1e-8));
      CHECK(r.state.lambda[0] == doctest::Approx(R_n).epsilon(1e-8));
      CHECK(r.state.lambda[1] == doctest::Approx(mu * R_n).epsilon(1e-8));
      int told = 0;
      for (std::size_t k = 3; k < r.history.size(); ++k) {
        if (r.history[k].contraction == 0) continue;
        CHECK(r.history[k].contraction == doctest::Approx(mu / 2).epsilon(1e-3));  // the inner tolerance
        ++told;
      }
      CHECK(told >= 2);
      CHECK(r.reason.find("iterations of " + std::string(inner->name()) + " in all") != std::string::npos);
    }
}

TEST_CASE("beyond mu = 2 the loop leaves the sliding state, which Newton's method finds") {
  // Slip to the right at μ = 3 exists for f = (6, −1): u_t = 3/(1 + 3/2).
  const auto p = one_node(Vector{{6, -1}}, problem::coulomb({3}));
  const auto r = loop(p, std::make_shared<solver::Newton>());
  CHECK_FALSE(r.converged);
  CHECK(r.iterations < 100);
  CHECK_FALSE(r.reason.empty());
  Monitor quiet;
  const auto newton = solver::solve(p, solver::Newton{}, quiet);
  REQUIRE_MESSAGE(newton.converged, newton.reason);
  CHECK(newton.state.u.here()[0] == doctest::Approx(1.2));
}

TEST_CASE("a node that sticks: the alternation contracts by W_nt² / (W_nn W_tt) = 1/4, whatever rho is") {
  Monitor quiet;
  const auto p = one_node(Vector{{0.5, -1}}, problem::tresca({100}));
  for (const double rho : {0.01, 0.5, 0.9}) {
    solver::UzawaPdas method;
    method.rho = rho;
    const auto r = solver::solve(p, method, quiet);
    REQUIRE_MESSAGE(r.converged, r.reason);
    CHECK(r.state.u.here().norm() < 1e-9);
    CHECK((r.state.lambda - Vector{{1, 0.5}}).norm() < 1e-9);
    for (std::size_t k = 2; k < r.history.size(); ++k)
      CHECK(r.history[k].residual == doctest::Approx(r.history[k - 1].residual / 4).epsilon(1e-3));
  }
}

TEST_CASE("steps beyond the bound: what the alternation calls converged is a solution, and it says why it is not") {
  test::Random random(311);
  Monitor quiet;
  int stuck = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto p = test::friction_program(random, 6, 1 + trial % 2, problem::tresca(std::vector<double>(6, 0.2)), 0.1);
    const auto exact = solver::solve(p, solver::Newton{}, quiet);
    solver::UzawaPdas method;
    method.rho = 50;
    method.max_iterations = 1000;
    const auto r = solver::solve(p, method, quiet);
    CHECK(r.reason.find("beyond which sets need not settle") != std::string::npos);
    if (r.converged) {
      CHECK((r.state.lambda - exact.state.lambda).norm() < 1e-7 * exact.state.lambda.norm());
      continue;
    }
    CHECK(r.state.lambda.allFinite());
    stuck += r.reason.find("repeats itself") != std::string::npos || r.reason.find("return every") != std::string::npos;
  }
  CHECK(stuck > 0);
}
