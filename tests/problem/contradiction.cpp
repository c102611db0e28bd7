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
  p.B = DenseMatrix{{1, 0}, {cos, sin}, {-sin, cos}}.sparseView();
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
