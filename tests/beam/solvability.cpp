#include <doctest/doctest.h>

#include <cmath>

#include "../support/exact_beam.hpp"
#include "base/error.hpp"

using namespace dotyk;
using beam::Beam;
using problem::LawChoice;
namespace laws = dotyk::problem::laws;
using test::beam_between;
using test::kFree;
using test::kHeld;

namespace {

bool solvable(const Beam& b) {
  try {
    const auto s = test::only(b);
    CHECK(s->result().converged);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// A beam of length 2 under resultants at its ends: ⟨q, 1 − x/L⟩ and ⟨q, x/L⟩, by two forces.
Beam loaded(double at_left, double at_right, LawChoice left, LawChoice left_rotation, LawChoice right) {
  Beam b = test::beam_between(2, 3, 0, left, left_rotation, right, kFree);
  const double near = at_left - at_right / 3, far = at_right - at_left / 3;  // at L/4 and 3L/4: ¾ and ¼ of each
  b.loads = {{0.5, 9.0 / 8 * near, 0}, {1.5, 9.0 / 8 * far, 0}};
  for (auto& load : b.loads) load.force *= 4.0 / 3;
  return b;
}

}  // namespace

TEST_CASE("the verdict turns at the limit of each theorem, to 1e-9") {
  for (const double size : {1e-3, 1.0, 1e4})
    for (const double off : {1e-9, 1e-6, 1e-2}) {
      CAPTURE(size);
      CAPTURE(off);
      // Theorems 2 and 3: both resultants press.
      for (const LawChoice law : {LawChoice{&laws::signorini, 0, 0}, LawChoice{&laws::one_sided_elastic, 5, 0}}) {
        CHECK(solvable(loaded(-size, -off * size, law, kFree, law)));
        CHECK_FALSE(solvable(loaded(-size, off * size, law, kFree, law)));
        CHECK_FALSE(solvable(loaded(off * size, -size, law, kFree, law)));
      }
      // Theorem 4: held at the left end, its rotation by friction.
      CHECK(solvable(loaded(0.3 * size, size, kHeld, {&laws::friction, 2 * size * (1 + off), 0}, kFree)));
      CHECK_FALSE(solvable(loaded(0.3 * size, size, kHeld, {&laws::friction, 2 * size * (1 - off), 0}, kFree)));
      // Theorem 5: friction at both ends.
      const LawChoice enough{&laws::friction, 3 * size, 0};
      CHECK(solvable(loaded(size, -0.4 * size, {&laws::friction, size * (1 + off), 0}, kFree, enough)));
      CHECK_FALSE(solvable(loaded(size, -0.4 * size, {&laws::friction, size * (1 - off), 0}, kFree, enough)));
    }
}

TEST_CASE("what is refused is told: the motion, the resultants, the theorem") {
  constexpr LawChoice signorini{&laws::signorini, 0, 0};
  CHECK_THROWS_WITH_AS(test::only(test::beam_between(2, 1, 0.5, signorini, kFree, signorini, kFree)),
                       doctest::Contains("theorem 3"), InputError);
  CHECK_THROWS_WITH_AS(test::only(loaded(-1, 0.5, signorini, kFree, signorini)),
                       doctest::Contains("u = 0 at the left end and 1 at the right one"), InputError);
  CHECK_THROWS_WITH_AS(test::only(test::beam_between(2, 1, -1, kFree, kFree, kFree, kFree)), doctest::Contains("the resultants are -1 at the left end and -1 at the right one"), InputError);
}

TEST_CASE("limits: a stiff one-sided support tends to Signorini's by 1/k, a soft one to none by k; friction to a prescribed deflection") {
  constexpr LawChoice signorini{&laws::signorini, 0, 0};
  const auto with = [&](LawChoice law) { return test::only(test::beam_between(2, 3, -1, kHeld, kHeld, law, kFree)); };
  const double rigid = with(signorini)->deflection(1), none = with(kFree)->deflection(1);
  double last = 0;
  for (double k = 1e2; k < 1e7; k *= 10) {
    const double error = std::abs(with({&laws::one_sided_elastic, k, 0})->deflection(1) - rigid);
    if (last > 0) CHECK(last / error == doctest::Approx(10).epsilon(0.1));
    last = error;
  }
  last = 0;
  for (double k = 1e-2; k > 1e-7; k /= 10) {
    const double error = std::abs(with({&laws::elastic, k, 0})->deflection(1) - none);
    if (last > 0) CHECK(last / error == doctest::Approx(10).epsilon(0.1));
    last = error;
  }
  // From the bound at which it does not slip on, friction is a prescribed deflection.
  const double needed = with(kHeld)->reaction(1).force;
  CHECK(with({&laws::friction, 1.0001 * needed, 0})->deflection(1) == doctest::Approx(with(kHeld)->deflection(1)).epsilon(1e-9));
  for (double bound = 1; bound < 1e13; bound *= 10)
    CHECK(with({&laws::friction, bound, 0})->deflection(1) == doctest::Approx(with(kHeld)->deflection(1)).epsilon(1e-12));
  const auto turning = [](LawChoice law) { return test::only(test::beam_between(2, 3, -1, kHeld, kFree, kHeld, law)); };
  for (double bound = 1; bound < 1e13; bound *= 10) {
    const auto held = turning({&laws::friction, bound, 0});
    CHECK(held->result().reason.find("limit") == std::string::npos);
    CHECK(held->deflection(1) == doctest::Approx(turning(kHeld)->deflection(1)).epsilon(1e-12));
  }
  CHECK(std::abs(with({&laws::friction, 0.9999 * needed, 0})->deflection(2)) > 1e-6);
}

namespace {

Monitor monitor;

}  // namespace

TEST_CASE("verdicts do not depend on the unit of length") {
  for (const double L : {1e-12, 1e-6, 1.0, 1e6, 1e12}) {
    CAPTURE(L);
    for (const double part : {1 - 1e-9, 1 + 1e-9}) {  // theorem 4: the bound against the load's moment L²/2
      const beam::Beam b = beam_between(L, 1, -1, kHeld, {&laws::friction, part * L * L / 2, 0}, kFree, kFree);
      if (part < 1) CHECK_THROWS_AS(beam::solve(b, {}, monitor), InputError);
      else CHECK(beam::solve(b, {}, monitor).front().solution->reaction(0).moment == doctest::Approx(L * L / 2));
    }
    const beam::Beam pinned = beam_between(L, 1, -1, kHeld, kFree, {&laws::signorini, 0, 0}, kFree);
    const auto s = beam::solve(pinned, {}, monitor).front().solution;
    CHECK(s->result().converged);
    CHECK(s->reaction(1).force == doctest::Approx(L / 2));
    CHECK(s->deflection(L / 2) == doctest::Approx(-5 * L * L * L * L / 384));
  }
}

TEST_CASE("a support anywhere in a cell costs no digits; two too near to each other are refused") {
  for (const double x : {0.25, 0.250003, 0.2501, 0.26, 0.265625, 0.0311}) {
    beam::Beam b = beam_between(1, 1, -1, kHeld, kFree, kHeld, kFree);
    beam::Beam coarse = b;
    b.supports.insert(b.supports.begin() + 1, {"x", x, kHeld, kFree});
    coarse.supports = b.supports;
    coarse.cells = 1;
    CHECK(beam::solve(b, {}, monitor).front().solution->reaction(1).force ==
          doctest::Approx(beam::solve(coarse, {}, monitor).front().solution->reaction(1).force).epsilon(1e-10));
  }
  beam::Beam b = beam_between(1, 1, -1, kHeld, kFree, kHeld, kFree);
  b.supports.insert(b.supports.begin() + 1, {"x", 1e-5, kHeld, kFree});
  CHECK_THROWS_AS(require_valid(b), InputError);
}

TEST_CASE("a spring too weak for the numbers is not called a solution") {
  const beam::Beam b = beam_between(1, 1, -1, kHeld, kFree, {&laws::elastic, 1e-300, 0}, kFree);
  CHECK(!beam::solve(b, {}, monitor).front().solution->result().converged);
}
