#include <doctest/doctest.h>

#include <cmath>

#include "../support/exact_beam.hpp"
#include "base/error.hpp"
#include "solver/rows/newton.hpp"
#include "solver/rows/proximal.hpp"

using namespace dotyk;
using problem::LawChoice;
namespace laws = dotyk::problem::laws;
using test::EndCondition;
using test::kEJ;
using test::kLength;

namespace {

const std::vector<LawChoice> kLaws{{&laws::free, 0, 0},          {&laws::prescribed, 0.05, 0},     {&laws::load, -0.3, 0},
                                    {&laws::elastic, 4, 0},       {&laws::one_sided_elastic, 4, 0}, {&laws::signorini, 0, 0},
                                    {&laws::friction, 0.7, 0},    {&laws::one_sided_friction, 0.7, 0},
                                    {&laws::capped_elastic, 4, 0.5}, {&laws::unequal_elastic, 4, 1}};

/// The branch that a law is on at displacement v and reaction r, both in the law's own direction; checks that the pair is
/// one of the law's.
EndCondition branch(const LawChoice& law, double v, double r) {
  constexpr double tight = 1e-10;  // of loads and displacements of about 1
  const double g = law.numbers[0];
  const double second = law.numbers[1];
  if (law.is(laws::prescribed)) {
    CHECK(std::abs(v - g) < tight);
    return {true, g, 0, 0};
  }
  if (law.is(laws::load)) {
    CHECK(std::abs(r - g) < tight);
    return {false, 0, g, 0};
  }
  if (law.is(laws::elastic)) {
    CHECK(std::abs(r + g * v) < tight);
    return {false, 0, 0, g};
  }
  if (law.is(laws::one_sided_elastic)) {
    CHECK(std::abs(r - g * std::max(-v, 0.0)) < tight);
    return v < 0 ? EndCondition{false, 0, 0, g} : EndCondition{};
  }
  if (law.is(laws::unequal_elastic)) {
    CHECK(std::abs(r + (v < 0 ? g : second) * v) < tight);
    return {false, 0, 0, v < 0 ? g : second};
  }
  if (law.is(laws::signorini)) {
    CHECK(v > -tight);
    CHECK(r > -tight);
    CHECK(std::abs(r * v) < tight);
    return r > tight ? EndCondition{true, 0, 0, 0} : EndCondition{};
  }
  if (law.is(laws::friction)) {
    CHECK(std::abs(r) < g + tight);
    if (std::abs(v) < tight) return {true, 0, 0, 0};
    CHECK(r == doctest::Approx(v > 0 ? -g : g));
    return {false, 0, v > 0 ? -g : g, 0};
  }
  if (law.is(laws::one_sided_friction)) {
    CHECK(r > -tight);
    CHECK(r < g + tight);
    if (std::abs(v) < tight) return {true, 0, 0, 0};
    CHECK(std::abs(r - (v > 0 ? 0 : g)) < tight);
    return {false, 0, v > 0 ? 0 : g, 0};
  }
  if (law.is(laws::capped_elastic)) {
    CHECK(std::abs(r - std::clamp(-g * v, -second, second)) < tight);
    if (std::abs(g * v) < second) return {false, 0, 0, g};
    return {false, 0, v > 0 ? -second : second, 0};
  }
  CHECK(law.is(laws::free));
  CHECK(std::abs(r) < tight);
  return {};
}

/// The branch of a rotation: of directed laws about −u'.
EndCondition turning_branch(const LawChoice& law, double rotation, double moment) {
  if (!law->directed()) return branch(law, rotation, moment);
  EndCondition c = branch(law, -rotation, -moment);
  c.value = -c.value;
  c.force = -c.force;
  return c;
}

/// Solves; nothing where there is no solution.
std::shared_ptr<const beam::Solution> solve(const beam::Beam& b, const solver::Method& method) {
  try {
    return test::only(b, method);
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).find("no solution") != std::string::npos);
    return nullptr;
  }
}

/// u, u', M and T at nodes, each to 1e-10 of its greatest value.
void check_near(const beam::Solution& s, const test::ExactBeam& exact) {
  Eigen::Vector4d off = Eigen::Vector4d::Zero(), size = off;
  for (const double x : {0.0, kLength / 4, kLength / 2, kLength}) {
    const Eigen::Vector4d value(s.deflection(x), s.rotation(x), s.moment(x), s.shear(x));
    const Eigen::Vector4d expected(exact.u(x), exact.u(x, 1), exact.moment(x), exact.shear(x));
    off = off.cwiseMax((value - expected).cwiseAbs());
    size = size.cwiseMax(expected.cwiseAbs());
  }
  for (int i = 0; i < 4; ++i) {
    CAPTURE(i);
    CHECK(off[i] <= 1e-10 * size[i]);
  }
}

bool near(const beam::Solution& a, const beam::Solution& b) {
  const auto& u = a.result().state.u.here();
  const auto& v = b.result().state.u.here();
  return (u - v).norm() <= 1e-10 * u.norm();
}

}  // namespace

TEST_CASE("every pair of laws at two ends: in closed form, by several methods, or refused" * doctest::test_suite("large")) {
  int solved = 0, refused = 0, not_unique = 0;
  for (const LawChoice& ld : kLaws)
    for (const LawChoice& lr : kLaws)
      for (const LawChoice& rd : kLaws)
        for (const LawChoice& rr : kLaws)
          for (const double q : {-1.0, 0.3}) {
            auto b = test::beam_between(kLength, kEJ, q, ld, lr, rd, rr);
            b.cells = 8;  // nodes are exact with any number; rounding grows as its fourth power
            CAPTURE(std::string(ld.spec->words));
            CAPTURE(std::string(lr.spec->words));
            CAPTURE(std::string(rd.spec->words));
            CAPTURE(std::string(rr.spec->words));
            CAPTURE(q);
            const auto s = solve(b, {});
            const auto t = solve(b, solver::Newton{});
            REQUIRE((s == nullptr) == (t == nullptr));
            if (!s) {
              ++refused;
              continue;
            }
            ++solved;
            CHECK(s->result().converged);
            const beam::Reaction left = s->reaction(0), right = s->reaction(1);
            const std::array<EndCondition, 4> conditions{
                branch(ld, left.deflection, left.force), turning_branch(lr, left.rotation, left.moment),
                branch(rd, right.deflection, right.force), turning_branch(rr, right.rotation, right.moment)};
            if (s->result().reason.find("unique up to") != std::string::npos) {
              ++not_unique;
              continue;
            }
            CHECK(t->result().converged);
            CHECK(near(*s, *t));
            const test::ExactBeam exact(kLength, kEJ, q, conditions);
            check_near(*s, exact);
          }
  CHECK(solved == 12079);  // as many as with an elastic law in place of the unequal one
  CHECK(refused == 7921);
  CHECK(not_unique == 307);  // the load -0.3 at one end balances 0.3 along the beam, or about the other end
}

TEST_CASE("compliance: a cantilever on asperities bends as the root of one equation") {
  constexpr double c = 40, power = 2.5, q = -1;
  const auto b = test::beam_between(kLength, kEJ, q, {&laws::prescribed}, {&laws::prescribed}, {&laws::compliance, c, power}, {&laws::free});
  // v = (q L⁴/8 + r L³/3)/EJ, r = c (−v)^m: v by bisection.
  double low = q * std::pow(kLength, 4) / (8 * kEJ), high = 0;
  for (int i = 0; i < 200; ++i) {
    const double v = (low + high) / 2;
    (v * kEJ < q * std::pow(kLength, 4) / 8 + c * std::pow(-v, power) * std::pow(kLength, 3) / 3 ? low : high) = v;
  }
  for (const solver::Method& method : {solver::Method{}, solver::Method{solver::Newton{}}, solver::Method{solver::Proximal{}}}) {
    const auto s = test::only(b, method);
    CHECK(s->result().converged);
    CHECK(s->reaction(1).deflection == doctest::Approx(low).epsilon(1e-9));
    CHECK(s->reaction(1).force == doctest::Approx(c * std::pow(-low, power)).epsilon(1e-9));
  }
}
