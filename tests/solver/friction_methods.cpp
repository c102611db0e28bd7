#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "../support/friction.hpp"
#include "base/error.hpp"
#include "problem/residual.hpp"
#include "solver/rows/coulomb_loop.hpp"
#include "solver/core/method.hpp"
#include "solver/rows/newton.hpp"
#include "solver/rows/projected_cg.hpp"
#include "solver/rows/proximal.hpp"
#include "solver/rows/psor.hpp"
#include "solver/rows/uzawa.hpp"
#include "solver/rows/uzawa_pdas.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

struct Named {
  std::string name;
  solver::Method method;
};

template <class Chosen>
Named named(Chosen method, double tol = 1e-11) {
  method.tol = tol;
  method.max_iterations = 200000;
  return {method.name(), method};
}

/// Every method on the condensed rows but Newton's.
std::vector<Named> methods(std::shared_ptr<const solver::RowMethod> inner = std::make_shared<solver::Newton>()) {
  solver::CoulombLoop loop;
  loop.inner = std::move(inner);
  return {named(solver::Uzawa{}), named(solver::UzawaPdas{}), named(solver::Psor{}), named(solver::ProjectedCg{}),
          named(solver::Proximal{}), named(loop)};
}

solver::Result solve(const Named& m, const problem::Problem& p) {
  Monitor quiet;
  return m.method.run(p, {}, quiet);
}

std::vector<double> several(test::Random& random, int count, double most) {
  std::vector<double> values(count);
  for (double& v : values) v = random.between(0, most);
  return values;
}

/// λ in its set, complementarity and the law of friction, to `slack` of force and of length.
void check_laws(const problem::Problem& p, const problem::State& s, double slack) {
  const Vector x = p.B * s.u.here() - p.c;
  CHECK(problem::residual(p, s).equilibrium < 1e-10);
  for (const auto& group : p.groups) {
    if (!group.law->unilateral()) continue;
    for (int r = group.first; r < group.first + group.count; ++r) {
      CHECK(s.lambda[r] >= 0);
      CHECK(x[r] < slack);
      CHECK(std::abs(s.lambda[r] * x[r]) < slack);
    }
  }
  for (const auto& group : p.friction)
    for (int k = 0; k < group.points(); ++k) {
      const Vector force = s.lambda.segment(group.row(k), group.components), slip = x.segment(group.row(k), group.components);
      const double bound = group.law->bound(k, s.lambda[group.normal[k]]);
      CHECK(force.norm() <= bound + slack);
      CHECK(std::abs(bound * slip.norm() - force.dot(slip)) < slack);  // slips along the friction force, and at the bound
    }
}

/// Newton's method converges, and every other to the same solution, which fulfils the laws.
void check_every_method(const problem::Problem& p) {
  const auto exact = solve(named(solver::Newton{}), p);
  REQUIRE_MESSAGE(exact.converged, exact.reason);
  for (const Named& m : methods()) {
    CAPTURE(m.name);
    const auto r = solve(m, p);
    REQUIRE_MESSAGE(r.converged, r.reason);
    CHECK(r.method == m.name);
    check_laws(p, r.state, 1e-8);
    CHECK((r.state.u.here() - exact.state.u.here()).norm() < 1e-8 * exact.state.u.here().norm());
    CHECK((r.state.lambda - exact.state.lambda).norm() < 1e-8 * (1 + exact.state.lambda.norm()));
  }
}

}  // namespace

TEST_CASE("every method finds the one solution with given friction, in the plane and in space") {
  test::Random random(301);
  for (int trial = 0; trial < 40; ++trial) {
    const int nodes = 1 + trial % 6, d = 1 + trial % 2;
    check_every_method(test::friction_program(random, nodes, d, problem::tresca(several(random, nodes, trial % 4 ? 1 : 0))));
  }
}

TEST_CASE("every method finds the solution with a small coefficient of Coulomb friction") {
  test::Random random(302);
  for (int trial = 0; trial < 40; ++trial) {
    const int nodes = 1 + trial % 6, d = 1 + trial % 2;
    check_every_method(test::friction_program(random, nodes, d, problem::coulomb(several(random, nodes, 0.3))));
  }
}

TEST_CASE("friction with bound zero is no friction") {
  test::Random random(303);
  for (int trial = 0; trial < 10; ++trial) {
    const auto p = test::friction_program(random, 4, 1 + trial % 2, problem::tresca(std::vector<double>(4, 0)));
    const int n = p.unknowns();
    const auto plain = test::program(test::stiffness(p), p.load(), DenseMatrix(p.B).topRows(4), p.c.head(4));
    const auto exact = test::by_enumeration(plain);
    REQUIRE(exact);
    for (const Named& m : methods()) {
      CAPTURE(m.name);
      for (const auto* q : {&p, &plain}) {
        const auto r = solve(m, *q);
        REQUIRE_MESSAGE(r.converged, r.reason);
        CHECK((r.state.u.here() - exact->u.here()).norm() < 1e-8 * exact->u.here().norm());
        CHECK(r.state.lambda.tail(q->rows() - 4).norm() == 0);
      }
    }
    CHECK(n == p.rows());
  }
}

TEST_CASE("every method takes unilateral, bilateral and elastic rows together") {
  test::Random random(304);
  for (int trial = 0; trial < 30; ++trial) {
    const int n = 9;
    auto p = test::program(random.positive_definite(n, 0.5), 2 * random.vector(n), random.matrix(7, n), 0.3 * random.vector(7));
    std::vector<double> k = {std::pow(10, random.between(-1, 2)), 0, std::pow(10, random.between(-1, 2))};
    p.groups = {test::group(problem::unilateral(), 0, 3), test::group(problem::bilateral(), 3, 1),
                test::group(problem::elastic(k), 4, 3)};
    const auto exact = solve(named(solver::Newton{}), p);
    REQUIRE_MESSAGE(exact.converged, exact.reason);
    for (const Named& m : methods()) {
      CAPTURE(m.name);
      const auto r = solve(m, p);
      REQUIRE_MESSAGE(r.converged, r.reason);
      CHECK((r.state.u.here() - exact.state.u.here()).norm() <= 1e-7 * exact.state.u.here().norm());
      CHECK((r.state.lambda - exact.state.lambda).norm() <= 1e-6 * exact.state.lambda.norm());
    }
  }
}

TEST_CASE("a free body on rows with friction: the same solution, in equilibrium") {
  test::Random random(305);
  for (int trial = 0; trial < 20; ++trial) {
    // Two unknowns a node; pressed along the second, pulled along the first less than friction carries.
    const double bound = 0.4;
    Vector f = 0.3 * random.vector(32);
    for (int i = 0; i < 16; ++i) f[2 * i + 1] += 1;
    problem::Problem p;
    problem::add(p, test::block("lid", test::spring_grid(random, 4, 4, 2, 0), f, 2, true));
    DenseMatrix B = DenseMatrix::Zero(12, 32);
    std::vector<int> normal(6);
    for (int k = 0; k < 6; ++k) {
      const int node = (5 * k) % 16;
      B(k, 2 * node + 1) = B(6 + k, 2 * node) = 1;
      normal[k] = k;
    }
    p.B = test::rows(B);
    p.c = Vector::Zero(12);
    p.groups = {test::group(problem::unilateral(), 0, 6)};
    const auto law = trial % 2 ? problem::tresca(std::vector<double>(6, bound)) : problem::coulomb(std::vector<double>(6, bound));
    p.friction = {{"friction", law, 6, 1, normal}};
    Monitor quiet;
    const auto exact = named(solver::Newton{}).method.run(p, {}, quiet);
    REQUIRE_MESSAGE(exact.converged, exact.reason);
    for (const Named& m : methods()) {
      CAPTURE(m.name);
      const auto r = solve(m, p);
      REQUIRE_MESSAGE(r.converged, r.reason);
      check_laws(p, r.state, 1e-8);
      CHECK(std::abs(r.state.lambda.head(6).sum() - (p.blocks[0].kernel.transpose() * f)[1]) < 1e-8);
      CHECK((r.state.lambda - exact.state.lambda).norm() < 1e-7 * exact.state.lambda.norm());
    }
    for (int i = 0; i < 16; ++i) p.blocks[0].f[2 * i + 1] -= 3;
    for (const Named& m : methods())
      CHECK_THROWS_WITH_AS(solve(m, p), doctest::Contains("nothing stops 'lid'"), InputError);
  }
}

TEST_CASE("rows given twice: the jump is the one of the rows given once") {
  test::Random random(306);
  for (int trial = 0; trial < 20; ++trial) {
    const auto once = test::friction_program(random, 3, 1 + trial % 2, problem::tresca({0.3, 0.2, 0.4}));
    auto twice = test::friction_program(random, 6, 1 + trial % 2, problem::tresca({0.15, 0.1, 0.2, 0.15, 0.1, 0.2}));
    const int t = once.rows() - 3;
    DenseMatrix B(2 * once.rows(), once.unknowns());
    B << DenseMatrix(once.B).topRows(3), DenseMatrix(once.B).topRows(3), DenseMatrix(once.B).bottomRows(t),
        DenseMatrix(once.B).bottomRows(t);
    twice.blocks = once.blocks;
    twice.B = test::rows(B);
    twice.c << once.c.head(3), once.c.head(3), once.c.tail(t), once.c.tail(t);
    const auto exact = solve(named(solver::Newton{}), once);
    REQUIRE(exact.converged);
    // Newton's derivative is singular there.
    for (const Named& m : methods(std::make_shared<solver::ProjectedCg>())) {
      CAPTURE(m.name);
      const auto r = solve(m, twice);
      REQUIRE_MESSAGE(r.converged, r.reason);
      CHECK((r.state.u.here() - exact.state.u.here()).norm() < 1e-7 * exact.state.u.here().norm());
    }
  }
}

TEST_CASE("no rows that press, and rows that nothing moves") {
  for (const Named& m : methods()) {
    CAPTURE(m.name);
    const auto open = solve(m, test::program(DenseMatrix::Identity(2, 2), Vector{{-1, -2}}, DenseMatrix::Identity(2, 2), Vector::Zero(2)));
    CHECK(open.converged);
    CHECK(open.state.lambda.norm() == 0);
    DenseMatrix B = DenseMatrix::Zero(2, 2);
    B(0, 0) = 1;
    const auto r = solve(m, test::program(DenseMatrix::Identity(2, 2), Vector{{3, 1}}, B, Vector{{1, 0.5}}));
    REQUIRE_MESSAGE(r.converged, r.reason);
    CHECK((r.state.u.here() - Vector{{1, 1}}).norm() < 1e-9);
  }
}
