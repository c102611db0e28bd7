#include <doctest/doctest.h>

#include "../support/programs.hpp"
#include "algebra/dense/decompositions.hpp"
#include "base/error.hpp"

using namespace dotyk;
using algebra::DenseMatrix;
using algebra::Vector;

TEST_CASE("the linear solve of several blocks is the dense one") {
  test::Random random(111);
  Monitor quiet;
  problem::Problem p;
  for (const char* name : {"a", "b"})
    problem::add(p, test::block(name, test::spring_grid(random, 5, 4, 2, 0.2), random.vector(40), 2, false));
  p.B.resize(0, 80);
  for (const auto ordering : {algebra::Ordering::automatic, algebra::Ordering::nested_dissection}) {
    const auto r = solver::solve_linear(p, ordering, quiet);
    CHECK(r.converged);
    CHECK(test::relative(r.state.u.here(), algebra::Ldlt(test::stiffness(p)).solve(p.load())) < 1e-11);
    CHECK(r.factor_bytes > 0);
  }
}

TEST_CASE("the linear solve refuses a free body by name and motion") {
  test::Random random(112);
  Monitor quiet;
  problem::Problem p;
  problem::add(p, test::block("lid", test::spring_grid(random, 3, 3, 2, 0), random.vector(18), 2, true));
  CHECK_THROWS_WITH_AS(
      solver::solve_linear(p, algebra::Ordering::automatic, quiet),
      "'lid' is not held: nothing stops its translation along x and translation along y; fix a part of it or put it in "
      "contact",
      InputError);
}
