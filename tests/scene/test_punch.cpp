#include <doctest/doctest.h>

#include <string>

#include "punch.hpp"
#include "reference.hpp"

using namespace dotyk;

namespace {

using reference::compare;

// Eleven digits, and half a unit of the last digit that the table prints.
constexpr double kElevenDigits = 5e-12;

}  // namespace

TEST_CASE("rigid parabola on a block in the plane has the values of other codes") {
  Monitor quiet;
  for (int n : {64, 128}) {
    const auto p = punch::plane(n);
    const auto s = scene::solve(p.scene, {}, {}, quiet);
    REQUIRE(s->result().converged);
    CHECK(s->result().iterations <= 9);
    const std::string size = "n=" + std::to_string(n);
    compare(s->energy(), "S2", size, "elastic energy", kElevenDigits);
    if (n != 64) continue;
    const auto c = s->contact(*p.contact);
    compare(-c.force[1], "S2", size, "normal force", kElevenDigits);
    compare(c.closed, "S2", size, "closed nodes", 0);
    double extent = 0;
    for (const auto& node : c.nodes)
      if (node.status == problem::Status::closed) extent = std::max(extent, std::abs(node.x[0]));
    compare(extent, "S2", size, "largest |x| of a closed node", 1e-14);
    // Action and reaction: the support carries what the contact presses.
    const auto reaction = s->reaction(p.bottom);
    CHECK(std::abs(reaction[1] + c.force[1]) < 1e-11 * std::abs(c.force[1]));
  }
  const auto q1 = punch::plane(64, mesh::Family::q1);
  compare(scene::solve(q1.scene, {}, {}, quiet)->energy(), "S2 with Q1", "n=64", "elastic energy", kElevenDigits);
}

TEST_CASE("rigid paraboloid on a cube has the values of other codes") {
  Monitor quiet;
  for (int n : {8, 16}) {
    const auto p = punch::space(n);
    const auto s = scene::solve(p.scene, {}, {}, quiet);
    REQUIRE(s->result().converged);
    const std::string size = "n=" + std::to_string(n);
    compare(s->energy(), "S3", size, "elastic energy", kElevenDigits);
    if (n == 8) compare(-s->contact(*p.contact).force[2], "S3", size, "normal force", kElevenDigits);
  }
}

TEST_CASE("reduced and full PDAS take the same path to the same solution") {
  Monitor quiet;
  const auto check = [&](const punch::Punch& p) {
    solver::Pdas reduced, full;
    full.reduced = false;
    const auto a = scene::solve(p.scene, reduced, {}, quiet), b = scene::solve(p.scene, full, {}, quiet);
    REQUIRE(a->result().converged);
    REQUIRE(b->result().converged);
    CHECK(a->result().active_sets == b->result().active_sets);
    const auto &u = a->result().state.u.here(), &v = b->result().state.u.here();
    CHECK((u - v).norm() < 1e-9 * u.norm());
    const auto &l = a->result().state.lambda, &m = b->result().state.lambda;
    CHECK((l - m).norm() < 1e-9 * l.norm());
  };
  check(punch::plane(32));
  check(punch::plane(32, mesh::Family::q1));
  check(punch::space(6));
  check(punch::space(6, mesh::Family::q1));
}

TEST_CASE("a coarse solution starts the fine one within four iterations") {
  Monitor quiet;
  auto coarse = scene::solve(punch::plane(32).scene, {}, {}, quiet);
  for (int n : {64, 128, 256}) {
    auto fine = scene::solve(punch::plane(n).scene, {}, {coarse, {}}, quiet);
    CHECK(fine->result().converged);
    CHECK(fine->result().iterations <= 4);
    coarse = fine;
  }
}

TEST_CASE("optimality residuals of the punch are at rounding") {
  Monitor quiet;
  const auto s = scene::solve(punch::plane(64).scene, {}, {}, quiet);
  CHECK(s->residual().equilibrium < 1e-12);
  CHECK(s->residual().penetration < 1e-12);
  CHECK(s->residual().complementarity < 1e-12);
  CHECK(s->residual().law < 1e-11);
  for (double l : s->result().state.lambda) CHECK(l >= -1e-12 * s->result().state.lambda.maxCoeff());
}
