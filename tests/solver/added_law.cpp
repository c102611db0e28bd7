// How a law is added: its projection, its energies, what it can carry. Methods that see no more of a law take it as it is.
#include <doctest/doctest.h>

#include <cmath>

#include "../support/programs.hpp"
#include "problem/residual.hpp"
#include "solver/programs/program_methods.hpp"
#include "solver/core/default_method.hpp"
#include "solver/feti/feti.hpp"
#include "solver/rows/newton.hpp"
#include "solver/active/pdas.hpp"
#include "solver/rows/projected_cg.hpp"
#include "solver/rows/proximal.hpp"
#include "solver/rows/psor.hpp"
#include "solver/rows/uzawa.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// A pad that hardens: φ = kx³/3 where x > 0, λ = kx²; y = λ + ρx there is a quadratic equation for x.
class Pad final : public problem::Law {
 public:
  explicit Pad(double k) : k_(k) {}
  std::string name() const override { return "pad"; }
  problem::Projection project(int, double y, double rho) const override {
    if (!(y > 0)) return {0, 0};
    const double x = 2 * y / (rho + std::sqrt(rho * rho + 4 * k_ * y));
    return {k_ * x * x, 2 * k_ * x / (2 * k_ * x + rho)};
  }
  double energy(int, double x) const override { return x > 0 ? k_ * x * x * x / 3 : 0; }
  double conjugate(int, double lambda) const override { return 2 * lambda * std::sqrt(lambda / k_) / 3; }
  problem::Interval multipliers(int) const override { return {0, kUnbounded}; }

 private:
  double k_;
};

/// A string of n springs pressed on pads.
problem::Problem pressed(int n) {
  DenseMatrix K = DenseMatrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    K(i, i) = 2;
    if (i) K(i, i - 1) = K(i - 1, i) = -1;
  }
  problem::Problem p = test::program(K, Vector::LinSpaced(n, -1, 2), DenseMatrix::Identity(n, n), Vector::LinSpaced(n, 0, 0.5));
  p.groups = {{"pads", std::make_shared<Pad>(3.0), 0, n}};
  return p;
}

}  // namespace

TEST_CASE_TEMPLATE("an added law is solved", Chosen, solver::Newton, solver::Proximal, solver::Psor, solver::Uzawa) {
  Monitor quiet;
  const problem::Problem p = pressed(12);
  Chosen method;
  method.tol = 1e-12;
  method.max_iterations = 20000;
  const auto r = solver::solve(p, method, quiet);
  REQUIRE_MESSAGE(r.converged, r.reason);
  const Vector x = p.B * r.state.u.here() - p.c;
  int pressed = 0;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    CHECK(std::abs(r.state.lambda[k] - 3 * std::max(0.0, x[k]) * std::max(0.0, x[k])) < 1e-9);
    pressed += x[k] > 0;
  }
  CHECK(pressed > 3);
  CHECK(pressed < 12);
  CHECK(problem::residual(p, r.state).equilibrium < 1e-10);
}

TEST_CASE("methods that ask for more than a law's projection say that they cannot treat it") {
  Monitor quiet;
  const auto refused = [&](const auto& method) {
    CHECK_THROWS_WITH_AS(solver::solve(pressed(4), method, quiet), doctest::Contains("pad"), InputError);
  };
  refused(solver::ActiveSet{});
  refused(solver::Pdas{});
  refused(solver::Feti{});
  refused(solver::ProjectedCg{});
}

TEST_CASE("a law that does not tell its springs is not taken for a rigid one: the default method is one that needs none") {
  Monitor quiet;
  CHECK(solver::choose(pressed(4), INFINITY).by == solver::Choice::By::newton);
  const auto by_default = solver::solve(pressed(12), solver::Method(), {}, quiet), by_psor = solver::solve(pressed(12), solver::Psor{}, quiet);
  REQUIRE(by_default.converged);
  CHECK((by_default.state.u.here() - by_psor.state.u.here()).norm() < 1e-8 * by_psor.state.u.here().norm());
}
