// Uzawa's steps in closed form: K = [2 −1; −1 2], f = (1, 1), u ≤ 0. λ* = (1, 1), W = K⁻¹ has the greatest
// eigenvalue 1, so that steps of a length below 2 contract, on both components alike: λ_{k+1} = (λ_k + ρ(1 − λ_k))⁺.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/programs.hpp"
#include "solver/rows/uzawa.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

solver::Result uzawa(double part_of_bound, int iterations) {
  Monitor quiet;
  solver::Uzawa method;
  method.rho = part_of_bound;
  method.max_iterations = iterations;
  const auto p = test::program(DenseMatrix{{2, -1}, {-1, 2}}, Vector{{1, 1}}, DenseMatrix::Identity(2, 2), Vector::Zero(2));
  return solver::solve(p, method, quiet);
}

}  // namespace

TEST_CASE("Uzawa's iterates are the closed form's, and the bound is 2 / λ_max") {
  for (const double part : {0.1, 0.4, 0.95}) {
    // After k steps |λ − 1| = |1 − 2 part|ᵏ, and the residual of the natural map (1/W_rr = 3/2) is
    // ‖λ − (λ + 3/2 (1 − λ))⁺‖ / ‖λ‖.
    const auto r = uzawa(part, 12);
    REQUIRE(r.history.size() == 12);
    double lambda = 0;
    for (const auto& info : r.history) {
      lambda = std::max(0.0, lambda + 2 * part * (1 - lambda));
      CHECK(info.residual == doctest::Approx(std::abs(lambda - std::max(0.0, lambda + 1.5 * (1 - lambda))) / lambda).epsilon(1e-9));
    }
    CHECK(r.reason.find("bound 2/λ_max of 1.33333") != std::string::npos);  // 2, in units of 1/W_rr = 3/2
    CHECK(uzawa(part, 2000).converged);
  }
}

TEST_CASE("beyond the bound Uzawa's steps go to and fro; that is noticed, and the best state given") {
  for (const double part : {1.0, 1.25}) {  // (2, 0, 2, 0, …) and (2.5, 0, 2.5, 0, …)
    const auto r = uzawa(part, 100000);
    CHECK_FALSE(r.converged);
    CHECK(r.iterations < 100000);
    CHECK(r.reason.find("beyond which steps need not converge") != std::string::npos);
    CHECK(r.state.lambda[0] == doctest::Approx(2 * part));  // of relative residual less than at 0
  }
}
