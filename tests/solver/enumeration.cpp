#include "solver/pieces/enumeration.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "../support/friction.hpp"
#include "base/error.hpp"
#include "problem/residual.hpp"
#include "solver/rows/newton.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;
using solver::RowPiece;

namespace {

// F1 of ../shared/reference/failure_cases.json, which was computed in rational numbers: one node on a rigid floor,
// unknowns (u_t, u_n), K = [1 ½; ½ 1], u_n ≥ 0, K u = f + R, |R_t| ≤ μ R_n. With B = −(the rows of u_n, u_t),
// λ = (R_n, R_t). Several solutions exist only for μ > K_tt/|K_tn| = 2.
problem::Problem one_node(double mu, double ft, double fn) {
  auto p = test::program(DenseMatrix{{1, 0.5}, {0.5, 1}}, Vector{{ft, fn}}, DenseMatrix{{0, -1}, {-1, 0}}, Vector::Zero(2));
  p.groups = {test::group(problem::unilateral(), 0, 1)};
  p.friction = {{"friction", problem::coulomb({mu}), 1, 1, {0}}};
  return p;
}

struct Expected {
  const char* state;
  double ut, un, Rt, Rn;
};

/// Open, stick, and slip of u_t to its positive or negative side: λ_t = b where x_t = −u_t ≥ 0.
std::string state_of(const std::vector<RowPiece>& pieces) {
  switch (pieces[1]) {
    case RowPiece::open: return "open";
    case RowPiece::closed: return "stick";
    case RowPiece::forward: return "slip-1";
    default: return "slip+1";
  }
}

void compare(double mu, double ft, double fn, const std::vector<Expected>& expected) {
  CAPTURE(mu);
  CAPTURE(ft);
  CAPTURE(fn);
  Monitor quiet;
  const auto all = solver::enumerate(one_node(mu, ft, fn), quiet);
  std::map<std::string, problem::State> found;
  for (const auto& s : all.solutions)
    for (const auto& pieces : s.pieces) found[state_of(pieces)] = s.result.state;
  CHECK(found.size() == expected.size());
  for (const Expected& e : expected) {
    CAPTURE(e.state);
    REQUIRE(found.count(e.state) == 1);
    const Vector u = found[e.state].u, lambda = found[e.state].lambda;
    CHECK((u - Vector{{e.ut, e.un}}).norm() < 1e-14);
    CHECK((lambda - Vector{{e.Rn, e.Rt}}).norm() < 1e-14);
  }
  CHECK(all.tried == 4);
  CHECK(all.singular == 0);
  CHECK(all.families.empty());
}

}  // namespace

TEST_CASE("one node with Coulomb friction has the solutions of the reference, several of them for mu > 2") {
  compare(3, -2.5, -1, {{"open", -8. / 3, 1. / 3, 0, 0}, {"stick", 0, 0, 2.5, 1}, {"slip-1", -1, 0, 1.5, 0.5}});
  compare(1, -2.5, -1, {{"open", -8. / 3, 1. / 3, 0, 0}});
  compare(3, -2, -1, {{"open", -2, 0, 0, 0}, {"stick", 0, 0, 2, 1}, {"slip-1", -2, 0, 0, 0}});  // on an edge
  compare(3, -3, -1, {{"open", -10. / 3, 2. / 3, 0, 0}, {"stick", 0, 0, 3, 1}, {"slip-1", 0, 0, 3, 1}});  // on another
  compare(3, 1, -1, {{"stick", 0, 0, -1, 1}});
  compare(1, 2, -1, {{"slip+1", 2. / 3, 0, -4. / 3, 4. / 3}});
}

TEST_CASE("4000 loads on one node: one solution for mu < 2, one to three for mu > 2") {
  Monitor quiet;
  for (const double mu : {1.0, 1.9, 2.1, 3.0}) {
    std::size_t least = 9, most = 0;
    for (int k = 0; k < 4000; ++k) {
      const double angle = 2 * std::numbers::pi * (k + 0.37) / 4000;  // off the edges
      const auto all = solver::enumerate(one_node(mu, std::cos(angle), std::sin(angle)), quiet);
      least = std::min(least, all.solutions.size());
      most = std::max(most, all.solutions.size());
    }
    CAPTURE(mu);
    CHECK(least == 1);
    CHECK(most == (mu < 2 ? 1 : 3));
  }
}

TEST_CASE("where slip impends a load step has two solutions nearby or none: F2 of the reference") {
  // R = (3, 1), mu = 3: with d = df_t − mu df_n and K_tt − mu K_tn = −½, none for d < 0; for d > 0 stick, and slip
  // by du_t = d/(−½). The open state is far away.
  Monitor quiet;
  for (const double d : {-1e-3, 1e-3}) {
    const auto all = solver::enumerate(one_node(3, -3 + d, -1), quiet);
    std::vector<Vector> near;
    for (const auto& s : all.solutions)
      if (s.result.state.u.here().norm() < 0.1) near.push_back(s.result.state.u.here());
    REQUIRE(near.size() == (d > 0 ? 2 : 0));
    CHECK(all.solutions.size() == near.size() + 1);
    if (d < 0) continue;
    CHECK(near[0].norm() < 1e-15);
    CHECK((near[1] - Vector{{-2 * d, 0}}).norm() < 1e-14);
  }
}

TEST_CASE("given friction has one solution, the one that Newton's method finds; Coulomb's has it among all") {
  test::Random random(501);
  Monitor quiet;
  int several = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const int nodes = 1 + random.below(4);
    const bool given = random.coin();
    std::vector<double> values(nodes);
    for (double& v : values) v = random.between(0, given ? 1 : 4);
    const auto p = test::friction_program(random, nodes, 1, given ? problem::tresca(values) : problem::coulomb(values), 0.1);
    const auto all = solver::enumerate(p, quiet);
    REQUIRE(!all.solutions.empty());
    CHECK(all.tried == std::lround(std::pow(given ? 6 : 4, nodes)));
    if (given) CHECK(all.solutions.size() == 1);
    several += all.solutions.size() > 1;
    for (const auto& s : all.solutions) {
      const auto residual = problem::residual(p, s.result.state);
      CHECK(residual.equilibrium < 1e-12);
      CHECK(residual.law < 1e-9);
    }
    const auto newton = solver::solve(p, solver::Newton{}, quiet);
    REQUIRE_MESSAGE(newton.converged, newton.reason);
    double nearest = 1e300;
    for (const auto& s : all.solutions) nearest = std::min(nearest, (s.result.state.lambda - newton.state.lambda).norm());
    CHECK(nearest < 1e-7 * (1 + newton.state.lambda.norm()));
  }
  CHECK(several > 5);
}

TEST_CASE("what enumeration cannot treat it says before it starts") {
  test::Random random(502);
  Monitor quiet;
  CHECK_THROWS_WITH_AS(solver::enumerate(test::friction_program(random, 2, 2, problem::coulomb({1, 1})), quiet),
                       doctest::Contains("in space slip has not finitely many pieces"), InputError);
  const std::vector<double> mu(11, 1.0);
  CHECK_THROWS_WITH_AS(solver::enumerate(test::friction_program(random, 11, 1, problem::coulomb(mu)), quiet),
                       doctest::Contains("it takes up to 1048576"), InputError);
}

namespace {

/// Every convex combination of a family's ends solves; returns the ends' displacements.
std::vector<Vector> check_family(const problem::Problem& p, const solver::Enumeration::Family& family) {
  std::vector<Vector> ends;
  for (const auto& end : family.ends) ends.push_back(end.result.state.u.here());
  for (int k = 0; k <= 10; ++k) {
    problem::State state{Vector::Zero(p.unknowns()), Vector::Zero(p.rows())};
    for (std::size_t e = 0; e < family.ends.size(); ++e) {
      const double part = family.ends.size() == 1 ? 1 : (e == 0 ? 0.1 * k : (1 - 0.1 * k) / static_cast<double>(family.ends.size() - 1));
      state.u.change() += part * family.ends[e].result.state.u.here();
      state.lambda += part * family.ends[e].result.state.lambda;
    }
    CHECK(problem::residual(p, state).equilibrium < 1e-12);
    // Forces and displacements are of size 1, and vanish at ends: ‖λ − P(λ + x)‖ as it is.
    const double force = state.lambda.norm(), off = problem::natural_residual(p, p.B * state.u.here() - p.c, state.lambda, Vector::Ones(p.rows()));
    CHECK(off * (force > 0 ? force : 1) < 1e-12);
  }
  return ends;
}

}  // namespace

TEST_CASE("at the critical coefficient a continuum of solutions is found with its ends") {
  Monitor quiet;
  const auto p = one_node(2, -2, -1);  // slip by any amount from where it sticks to where it lifts off
  const auto all = solver::enumerate(p, quiet);
  CHECK(all.singular == 1);
  CHECK(all.solutions.empty());  // stick and open are its ends
  REQUIRE(all.families.size() == 1);
  CHECK(all.families[0].dimension == 1);
  CHECK(all.families[0].unbounded == 0);
  CHECK(!all.families[0].forces_only);
  CHECK(all.summary() == "no isolated solution and a continuum of solutions: a family of dimension 1 with 2 ends; all 4 combinations of pieces tried");
  const auto ends = check_family(p, all.families[0]);
  REQUIRE(ends.size() == 2);
  CHECK(std::abs(std::abs(ends[0][0] - ends[1][0]) - 2) < 1e-12);
}

TEST_CASE("a triangle on a floor, μ = 3, slips by any amount between sticking and lifting off") {
  // O (0,0), B (1,0), P (1/5, 4/15); ν = 1/10, E = 2.2: at B K = [3/8 −1/8; −1/8 29/96]. OP is displaced by (2x, −8x/27), BP loaded by
  // (40/(9√10), 0): f = (3/4, −1/4). With u_y = 0, u_x = a: R_n = (2 − a)/8, R_t = −3 (2 − a)/8 = −3 R_n for every a, so that all 0 ≤ a ≤ 2 solve.
  Monitor quiet;
  for (const double rounding : {0.0, 1e-16, -1e-16}) {
    auto p = test::program(DenseMatrix{{3.0 / 8, -1.0 / 8}, {-1.0 / 8, 29.0 / 96}}, Vector{{0.75 * (1 + 2 * rounding), -0.25}}, DenseMatrix{{0, -1}, {-1, 0}}, Vector::Zero(2));
    p.groups = {test::group(problem::unilateral(), 0, 1)};
    p.friction = {{"friction", problem::coulomb({3.0}), 1, 1, {0}}};
    const auto all = solver::enumerate(p, quiet);
    CHECK(all.solutions.empty());
    REQUIRE(all.families.size() == 1);
    const auto ends = check_family(p, all.families[0]);
    REQUIRE(ends.size() == 2);
    CHECK(std::abs(std::min(ends[0][0], ends[1][0])) < 1e-12);
    CHECK(std::abs(std::max(ends[0][0], ends[1][0]) - 2) < 1e-12);
  }
  for (const double unit : {1e-9, 1e6, 1e9, 1e12, 1e15}) {  // of force: the ends keep their digits
    CAPTURE(unit);
    const DenseMatrix K = unit * DenseMatrix{{3.0 / 8, -1.0 / 8}, {-1.0 / 8, 29.0 / 96}};
    auto p = test::program(K, unit * Vector{{0.75, -0.25}}, DenseMatrix{{0, -1}, {-1, 0}}, Vector::Zero(2));
    p.groups = {test::group(problem::unilateral(), 0, 1)};
    p.friction = {{"friction", problem::coulomb({3.0}), 1, 1, {0}}};
    const auto all = solver::enumerate(p, quiet);
    REQUIRE(all.families.size() == 1);
    REQUIRE(all.families[0].ends.size() == 2);
    for (const auto& end : all.families[0].ends) {
      CHECK(std::abs(std::abs(end.result.state.u.here()[0] - 1) - 1) < 1e-12);
      const double force = std::max(end.result.state.lambda.norm(), 1e-3 * unit);
      const double off = problem::natural_residual(p, p.B * end.result.state.u.here() - p.c, end.result.state.lambda, Vector::Constant(2, unit));
      CHECK(off * (end.result.state.lambda.norm() > 0 ? end.result.state.lambda.norm() : 1) < 1e-12 * force);
    }
  }
}

TEST_CASE("two such nodes: a square of solutions, all pieces of it in one continuum; beside them isolated nodes keep theirs") {
  Monitor quiet;
  for (const double second : {2.0, 1.0}) {
    DenseMatrix K = DenseMatrix::Zero(4, 4), B = DenseMatrix::Zero(4, 4);
    Vector f(4);
    for (int k : {0, 2}) {
      K.block(k, k, 2, 2) = DenseMatrix{{1, 0.5}, {0.5, 1}};
      f.segment(k, 2) = Vector{{-2, -1}};
      B(k / 2, k + 1) = B(2 + k / 2, k) = -1;
    }
    auto p = test::program(K, f, B, Vector::Zero(4));
    p.groups = {test::group(problem::unilateral(), 0, 2)};
    p.friction = {{"friction", problem::coulomb({2.0, second}), 2, 1, {0, 1}}};
    const auto all = solver::enumerate(p, quiet);
    CHECK(all.solutions.empty());
    REQUIRE(all.families.size() == 1);  // its sides and corners, where one of them sticks or lifts off, are parts of it
    CHECK(all.families[0].dimension == (second == 2 ? 2 : 1));
    CHECK(all.families[0].ends.size() == (second == 2 ? 4 : 2));
    check_family(p, all.families[0]);
  }
}

TEST_CASE("two rows that say the same leave their forces free and no displacement") {
  Monitor quiet;
  auto p = test::program(DenseMatrix{{2.0}}, Vector{{3.0}}, DenseMatrix{{1.0}, {1.0}}, Vector::Zero(2));
  p.groups = {test::group(problem::unilateral(), 0, 2)};
  const auto all = solver::enumerate(p, quiet);
  CHECK(all.solutions.empty());
  REQUIRE(all.families.size() == 1);
  CHECK(all.families[0].forces_only);
  CHECK(all.families[0].ends.size() == 2);
  for (const auto& end : all.families[0].ends) CHECK(end.result.state.lambda.sum() == doctest::Approx(3));
}

TEST_CASE("families without an end in some direction are said to be unbounded") {
  // A node between two walls that press it from both sides by any force: with u = 0 held by both rows.
  Monitor quiet;
  auto p = test::program(DenseMatrix{{2.0}}, Vector{{0.5}}, DenseMatrix{{1.0}, {-1.0}}, Vector::Zero(2));
  p.groups = {test::group(problem::unilateral(), 0, 2)};
  const auto all = solver::enumerate(p, quiet);
  REQUIRE(all.families.size() == 1);
  CHECK(all.families[0].unbounded == 1);
  CHECK(all.families[0].ends.size() == 1);
  CHECK(all.summary().find("unbounded, of forces alone") != std::string::npos);
}
