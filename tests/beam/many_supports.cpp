#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../support/random.hpp"
#include "base/error.hpp"
#include "beam/solve.hpp"
#include "solver/rows/proximal.hpp"

using namespace dotyk;
using problem::LawChoice;
namespace laws = dotyk::problem::laws;

namespace {

/// Laws of random stiffness and bound, of one family: Signorini's alone, one-sided springs alone, or mixed with others.
LawChoice random_law(test::Random& random, int family) {
  const double stiffness = std::pow(10, random.between(2, 8)), bound = std::pow(10, random.between(-3, 0));
  const int kind = family == 0 ? 0 : family == 1 ? 1 : random.below(family == 2 ? 2 : 6);
  switch (kind) {
    case 1: return {&laws::one_sided_elastic, stiffness};
    case 2: return {&laws::elastic, stiffness / 100};
    case 3: return {&laws::friction, bound};
    case 4: return {&laws::capped_elastic, stiffness, bound};
    case 5: return {&laws::one_sided_friction, bound};
    default: return {&laws::signorini};
  }
}

/// A beam on so many supports, near together at random, under a wavy load and forces that lift stretches of it.
beam::Beam random_beam(test::Random& random, int supports) {
  beam::Beam b;
  b.cells = 20 + random.below(80);
  const int family = random.below(4);
  const bool clamped = random.coin();
  b.supports.push_back({"left", 0, {clamped ? &laws::prescribed : &laws::signorini}, {clamped ? &laws::prescribed : &laws::free}});
  for (int i = 0; i < supports; ++i) b.supports.push_back({"inner", (i + 0.5 + random.between(-0.2, 0.2)) / supports, random_law(random, family), {}});
  b.supports.push_back({"right", 1, {&laws::signorini}, {}});
  const double mean = random.between(0.2, 1), wave = random.between(0, 2), number = random.between(1, 60), phase = random.between(0, 6);
  b.q_of = [=](double x) { return -mean + wave * std::sin(number * x + phase); };
  for (int k = random.below(7); k > 0; --k) b.loads.push_back({random.between(0, 1), random.between(-0.6, 0.4)});
  return b;
}

/// Optimality is enough: the energy is convex.
void check_optimal(const beam::Solution& s) {
  REQUIRE_MESSAGE(s.result().converged, s.result().reason);
  CHECK(s.residual().equilibrium < 1e-6);  // rounding of stretches that are lifted: see Beam::cells
  CHECK(s.residual().law < 1e-6);
}

}  // namespace

TEST_CASE("beams that lift off some of many supports: all are solved, in few steps") {
  test::Random random(184);
  Monitor quiet;
  int solved = 0;
  for (int trial = 0; trial < 150; ++trial) {
    CAPTURE(trial);
    const beam::Beam b = random_beam(random, 60 + random.below(270));
    try {
      const auto s = beam::solve(b, {}, quiet).front().solution;
      check_optimal(*s);
      CHECK(s->result().iterations <= 8);
      ++solved;
    } catch (const InputError& refused) {  // lifted as a whole
      CHECK(std::string(refused.what()).find("no solution") == 0);
    }
  }
  CHECK(solved > 100);
}

TEST_CASE("thousands of supports take as many steps as hundreds") {
  test::Random random(5000);
  Monitor quiet;
  for (const int supports : {800, 5000}) {
    beam::Beam b = random_beam(random, supports);
    b.supports.clear();
    for (int i = 0; i < supports; ++i) b.supports.push_back({"", i / (supports - 1.0), {i % 7 == 0 ? &laws::one_sided_elastic : &laws::signorini, 1e5}, {}});
    b.loads = {{0.3, 0.05}, {0.7, -0.2}};
    const auto s = beam::solve(b, {}, quiet).front().solution;
    check_optimal(*s);
    CHECK(s->result().iterations <= 8);
  }
}

TEST_CASE("lifted off all of many supports, a beam deflects as one on its ends, and these balance the load") {
  Monitor quiet;
  for (const int supports : {100, 800, 5000, 9000}) {
    beam::Beam b;
    b.q = -1;
    b.supports.push_back({"left", 0, {&laws::prescribed}, {&laws::load, 1}});
    for (int i = 1; i <= supports; ++i) b.supports.push_back({"", i / (supports + 1.0), {&laws::signorini}, {}});
    b.supports.push_back({"right", 1, {&laws::prescribed}, {}});
    for (const double moment : {1.0, 100.0}) {
      b.supports.front().rotation.numbers[0] = moment;
      INFO(supports, " supports, moment ", moment);
      const auto s = beam::solve(b, {}, quiet).front().solution;
      REQUIRE_MESSAGE(s->result().converged, s->result().reason);
      for (double x = 0.1; x < 1; x += 0.2) {
        const double exact = moment * x * (1 - x) * (2 - x) / 6 - x * (1 - x) * (1 + x - x * x) / 24;
        CHECK(s->deflection(x) == doctest::Approx(exact).epsilon(1e-6));
      }
      CHECK(s->reaction(0).force == doctest::Approx(0.5 + moment).epsilon(1e-6));
      CHECK(s->reaction(supports + 1).force == doctest::Approx(0.5 - moment).epsilon(1e-6));
    }
  }
}

TEST_CASE("a force that lifts a beam off many supports is balanced by those it still rests on") {
  Monitor quiet;
  double coarse = 0;
  for (const int supports : {800, 5000}) {
    beam::Beam b;
    b.q = -1;
    b.loads = {{0.3333, 5}};
    b.supports.push_back({"left", 0, {&laws::prescribed}, {}});
    for (int i = 1; i <= supports; ++i) b.supports.push_back({"", i / (supports + 1.0), {&laws::signorini}, {}});
    b.supports.push_back({"right", 1, {&laws::prescribed}, {}});
    INFO(supports, " supports");
    const auto s = beam::solve(b, {}, quiet).front().solution;
    REQUIRE_MESSAGE(s->result().converged, s->result().reason);
    double sum = 0, moment = 0;
    for (std::size_t i = 0; i < b.supports.size(); ++i) {
      const double reaction = s->reaction(static_cast<int>(i)).force;
      sum += reaction, moment += reaction * b.supports[i].x;
    }
    CHECK(sum == doctest::Approx(1 - 5).epsilon(1e-7));
    CHECK(moment == doctest::Approx(0.5 - 5 * 0.3333).epsilon(1e-7));
    if (coarse != 0) CHECK(s->deflection(0.3) == doctest::Approx(coarse).epsilon(1e-6));
    coarse = s->deflection(0.3);
  }
}

TEST_CASE("the deflections are those of another method") {
  test::Random random(9);
  Monitor quiet;
  for (int trial = 0; trial < 5; ++trial) {
    beam::Beam b = random_beam(random, 40);
    b.q_of = [](double x) { return -1 + 1.5 * std::sin(20 * x); };
    b.loads = {{0.4, 0.1}};
    const auto s = beam::solve(b, {}, quiet).front().solution;
    const auto other = beam::solve(b, solver::Method(solver::Proximal{}), quiet).front().solution;
    REQUIRE_MESSAGE(other->result().converged, other->result().reason);
    check_optimal(*s);
    CHECK(std::abs(s->energy() - other->energy()) < 1e-6 * std::abs(s->energy()));
    for (double x = 0.05; x < 1; x += 0.1) CHECK(std::abs(s->deflection(x) - other->deflection(x)) < 1e-4 * std::abs(s->energy()));
  }
}
