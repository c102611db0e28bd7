#include "program/certificate.hpp"

#include <doctest/doctest.h>

#include "programs.hpp"

using namespace dotyk;
using test::Random;
using test::Vector;

TEST_CASE("primal and dual bracket the optimum, with nothing between them at a solution") {
  Random random(341);
  Monitor quiet;
  for (int trial = 0; trial < 150; ++trial) {
    const int n = 1 + trial % 3;
    const auto p = test::boxed(random, n, trial % 4, trial % (n + 1));
    const auto exact = test::by_enumeration(p);
    REQUIRE(exact);
    const auto r = program::solve(p, test::one(), quiet);
    const auto b = program::bracket(p, r.x, r.y);
    const double size = 1 + std::abs(*exact);
    CHECK(b.gap < 1e-10);
    CHECK(b.slack < 1e-10);
    CHECK(b.dual <= *exact + 1e-10 * size);  // enumeration's own rounding
    CHECK(b.primal + b.slack * size >= *exact - 1e-10 * size);
    CHECK(b.primal == doctest::Approx(r.objective).epsilon(1e-12));
  }
}

TEST_CASE("wrong multipliers still bound the optimum from below, far from it") {
  Random random(342);
  Monitor quiet;
  int far = 0;
  for (int trial = 0; trial < 150; ++trial) {
    const int n = 1 + trial % 3;
    const auto p = test::boxed(random, n, trial % 4, trial % (n + 1));
    const auto exact = test::by_enumeration(p);
    REQUIRE(exact);
    const auto r = program::solve(p, test::one(), quiet);
    const auto b = program::bracket(p, r.x, r.y + 0.3 * random.vector(p.rows()));
    CHECK(b.dual <= *exact + 1e-10 * (1 + std::abs(*exact)));
    far += b.gap > 1e-3;
  }
  CHECK(far > 100);
}
