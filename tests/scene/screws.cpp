#include <doctest/doctest.h>

#include <cmath>

#include "../support/random.hpp"
#include "../support/semicoercive.hpp"
#include "base/error.hpp"
#include "problem/rigid_motions.hpp"

using namespace dotyk;
using test::Case;
using test::semicoercive_cases;

namespace {

std::shared_ptr<scene::Solution> solve(const Case& c, const solver::Pdas& method) {
  Monitor quiet;
  return scene::solve(c.scene, method, {}, quiet);
}

void agree(const scene::Solution& a, const scene::Solution& b) {
  CHECK((a.result().state.u.here() - b.result().state.u.here()).norm() < 1e-8 * b.result().state.u.here().norm());
  CHECK((a.result().state.lambda - b.result().state.lambda).norm() < 1e-8 * b.result().state.lambda.norm());
}

}  // namespace

TEST_CASE("screws chosen by themselves give the solution of the exact kernel") {
  for (const Case& c : semicoercive_cases()) {
    CAPTURE(c.name);
    const auto exact = solve(c, {});
    REQUIRE(exact->result().converged);
    solver::Pdas screws;
    screws.kernel = solver::Pdas::Kernel::screws;
    const auto s = solve(c, screws);
    REQUIRE_MESSAGE(s->result().converged, s->result().reason);
    CHECK(s->result().method == "pdas with screws");
    agree(*s, *exact);
    for (double l : s->result().state.lambda) CHECK(l >= -1e-9 * s->result().state.lambda.maxCoeff());
  }
}

TEST_CASE("screws placed wrong on purpose are moved, and end right") {
  test::Random random(301);
  int moved = 0, tried = 0;
  for (const Case& c : semicoercive_cases()) {
    CAPTURE(c.name);
    const auto exact = solve(c, {});
    const int rows = exact->rows();
    for (int trial = 0; trial < 12; ++trial) {
      solver::Pdas screws;
      screws.kernel = solver::Pdas::Kernel::screws;
      while (screws.screws.size() < c.screws) {
        const int r = static_cast<int>(random.between(0, rows - 1e-9));
        if (std::find(screws.screws.begin(), screws.screws.end(), r) == screws.screws.end()) screws.screws.push_back(r);
      }
      std::shared_ptr<scene::Solution> s;
      try {
        s = solve(c, screws);
      } catch (const InputError& error) {  // e.g. two screws on one line: refused as such
        CHECK(std::string(error.what()).find("do not hold every rigid motion") != std::string::npos);
        continue;
      }
      ++tried;
      REQUIRE_MESSAGE(s->result().converged, s->result().reason);
      CHECK(s->result().screw_moves <= screws.max_moves);
      // Every placement is on record, and each move changes one row.
      const auto& placed = s->result().screws;
      REQUIRE(placed.size() == static_cast<std::size_t>(s->result().screw_moves) + 1);
      CHECK(placed[0].rows == screws.screws);
      for (std::size_t k = 0; k < placed.size(); ++k) {
        CHECK(placed[k].regularity > 1e-8);
        CHECK(placed[k].determinant > 0);
        int changed = 0;
        for (std::size_t m = 0; k > 0 && m < placed[k].rows.size(); ++m) changed += placed[k].rows[m] != placed[k - 1].rows[m];
        CHECK(changed == (k > 0));
      }
      moved += s->result().screw_moves > 0;
      agree(*s, *exact);
    }
  }
  CHECK(tried > 30);
  CHECK(moved > 3);  // otherwise the placements were no test
}

TEST_CASE("screws: too many, repeated, and the full form are refused") {
  const Case c = semicoercive_cases()[1];
  solver::Pdas screws;
  screws.kernel = solver::Pdas::Kernel::screws;
  screws.screws = {0, 1};
  CHECK_THROWS_WITH_AS(solve(c, screws), doctest::Contains("2 are given; this problem needs 1"), InputError);
  screws.screws = {3, 3};
  CHECK_THROWS_WITH_AS(solve(c, screws), doctest::Contains("row 4 is named twice"), InputError);
  screws.screws = {};
  screws.reduced = false;
  CHECK_THROWS_WITH_AS(solve(c, screws), doctest::Contains("needs reduced = true"), InputError);
}
