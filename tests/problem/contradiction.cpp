#include "problem/contradiction.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// One node in the plane. A one-sided row along x asks u_x ≤ c; the rows of equality hold u along two inclined directions at 0, or one of them.
problem::Problem node(double c, bool both) {
  const double cos = std::cos(0.3), sin = std::sin(0.3);
  problem::Problem p;
  p.B = DenseMatrix{{1, 0}, {cos, sin}, {both ? -sin : sin, both ? cos : -cos}}.sparseView();
  p.c = Vector{{c, 0, 0}};
  p.groups = {{"floor", problem::unilateral(), 0, 1}, {"first", problem::bilateral(), 1, 1},
              {"second", both ? problem::bilateral() : problem::unilateral(), 2, 1}};
  return p;
}

}  // namespace

TEST_CASE("a one-sided row that equalities violate is found, with how much") {
  const auto found = problem::contradiction(node(-0.25, true), 1e-9);
  REQUIRE(found);
  CHECK(found->row == 0);
  CHECK(found->by == doctest::Approx(0.25).epsilon(1e-14));
}

TEST_CASE("rows that can move, or need not, contradict nothing") {
  CHECK_FALSE(problem::contradiction(node(-0.25, false), 1e-9));
  CHECK_FALSE(problem::contradiction(node(0.25, true), 1e-9));
  CHECK_FALSE(problem::contradiction(node(-1e-10, true), 1e-9));
}

TEST_CASE("walls that push a node into each other are found through rows that others lead to, and not where there is a way out") {
  // Nodes 0, 1, 2 on a line, each glued to the next in the mean of both; walls keep the first at 0 at most, the last at `least` or more.
  const auto chain = [](double stretch, double least) {
    problem::Problem p;
    p.B = DenseMatrix{{1, 0, 0}, {-0.5, -0.5, 1}, {1, -1, stretch}, {0, 0, -1}}.sparseView();
    p.c = Vector{{0, 0, 0, -least}};
    p.groups = {{"wall", problem::unilateral(), 0, 1}, {"glue", problem::bilateral(), 1, 2}, {"other wall", problem::unilateral(), 3, 1}};
    return p;
  };
  const auto found = problem::contradiction(chain(0, 0.5), 1e-9);
  REQUIRE(found);
  CHECK(found->by == doctest::Approx(0.5).epsilon(1e-12));
  CHECK(found->others.size() == 3);
  CHECK_FALSE(problem::contradiction(chain(0, -0.5), 1e-9));
  CHECK_FALSE(problem::contradiction(chain(3, 0.5), 1e-9));  // the first may go below 0
}

TEST_CASE("many rows in a chain, each with the next, are satisfiable for any gaps but contradictory as a ring that must grow") {
  for (const int n : {4, 20, 60}) {
    algebra::Triplets entries;
    for (int r = 0; r < n; ++r) entries.emplace_back(r, r, 1.0), entries.emplace_back(r, (r + 1) % n, -1.0);  // u_r − u_{r+1} ≤ c_r
    problem::Problem p;
    p.B = algebra::from_triplets<algebra::SparseRows>(n, n, entries);
    p.groups = {{"ring", problem::unilateral(), 0, n}};
    p.c = Vector::Constant(n, 0.01);
    p.c[n / 2] = -0.01 * (n - 1) + 1e-3;  // in sum 1e-3
    CHECK_FALSE(problem::contradiction(p, 1e-9));
    p.c[n / 2] -= 2e-3;
    const auto found = problem::contradiction(p, 1e-9);
    CAPTURE(n);
    REQUIRE(found);
    CHECK(found->by == doctest::Approx(1e-3).epsilon(1e-6));
    CHECK(found->others.size() == static_cast<std::size_t>(n - 1));
  }
}
