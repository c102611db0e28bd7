#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../support/exact_beam.hpp"
#include "base/error.hpp"
#include "solver/programs/program_methods.hpp"

using namespace dotyk;
using beam::Beam;
using problem::LawChoice;
namespace laws = dotyk::problem::laws;
using test::kEJ;
using test::kFree;
using test::kHeld;
using test::kLength;

namespace {

constexpr double kSpring = 10, kLimit = 0.2;

/// A cantilever whose tip rests on a support that breaks.
Beam cantilever(double force) {
  Beam b = test::beam_between(kLength, kEJ, 0, kHeld, kHeld, {&laws::breaking, kSpring, kLimit}, kFree);
  b.loads = {{kLength, -force, 0}};
  return b;
}

/// A cantilever clamped at 0 with breaking springs at some points, under a force at its end.
Beam on_springs(const std::vector<double>& at, double force) {
  Beam b = test::beam_between(kLength, kEJ, 0, kHeld, kHeld, {&laws::breaking, kSpring, kLimit}, kFree);
  for (std::size_t i = 0; i + 1 < at.size(); ++i)
    b.supports.insert(b.supports.end() - 1, {"spring", at[i], {&laws::breaking, kSpring, kLimit}, kFree});
  b.loads = {{kLength, -force, 0}};
  return b;
}

/// A set of whole springs and the forces under which it is a branch: a unit force at b moves the point a by C(a, b), so the
/// springs' points go down by F s, s + C_W k s = C(., L), and F k s is less than the limit for whole ones, more for broken ones.
struct Range {
  std::vector<bool> whole;
  double from = 0, to = INFINITY;
};
std::vector<Range> ranges(const std::vector<double>& at) {
  const auto flexibility = [](double a, double b) { return std::pow(std::min(a, b), 2) * (3 * std::max(a, b) - std::min(a, b)) / (6 * kEJ); };
  const auto n = static_cast<Eigen::Index>(at.size());
  std::vector<Range> out;
  for (int choice = 0; choice < 1 << n; ++choice) {
    Range range;
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n);
    Eigen::VectorXd b(n);
    for (int j = 0; j < n; ++j) range.whole.push_back(choice >> j & 1);
    for (int i = 0; i < n; ++i) {
      b[i] = flexibility(at[i], kLength);
      for (int j = 0; j < n; ++j) A(i, j) += range.whole[j] ? kSpring * flexibility(at[i], at[j]) : 0;
    }
    const Eigen::VectorXd s = A.partialPivLu().solve(b);
    REQUIRE(s.minCoeff() > 0);
    for (int i = 0; i < n; ++i) {
      double& end = range.whole[i] ? range.to : range.from;
      end = range.whole[i] ? std::min(end, kLimit / (kSpring * s[i])) : std::max(end, kLimit / (kSpring * s[i]));
    }
    if (range.from < range.to) out.push_back(range);
  }
  return out;
}

}  // namespace

TEST_CASE("a support that breaks: every local minimum, each with its branch") {
  // The cantilever's own stiffness is c = 3EJ/L³: whole, the tip's force F is shared as k : c, and the support bears
  // kF/(k + c) ≤ g; broken, the tip goes down F/c ≥ g/k.
  Monitor monitor;
  const double c = 3 * kEJ / std::pow(kLength, 3), up_to = kLimit * (kSpring + c) / kSpring, from = kLimit * c / kSpring;
  for (const double force : {0.5 * from, 0.99 * from, 1.01 * from, 0.5 * (from + up_to), 0.99 * up_to, 1.01 * up_to, 2 * up_to}) {
    CAPTURE(force);
    const auto minima = beam::solve(cantilever(force), {}, monitor);
    const bool whole = force < up_to, broken = force > from;
    REQUIRE(minima.size() == std::size_t(whole) + std::size_t(broken));
    double last = -INFINITY;
    for (const auto& [choice, s] : minima) {
      const bool is_broken = choice[0] == beam::Broken::yes;
      CHECK((is_broken ? broken : whole));
      const double tip = is_broken ? -force / c : -force / (kSpring + c);
      CHECK(s->deflection(kLength) == doctest::Approx(tip).epsilon(1e-10));
      // ½cu² + Fu + φ(u): the least first.
      const double energy = 0.5 * c * tip * tip + force * tip + (is_broken ? 0.5 * kLimit * kLimit / kSpring : 0.5 * kSpring * tip * tip);
      CHECK(s->energy() == doctest::Approx(energy).epsilon(1e-9));
      CHECK(s->energy() > last);
      last = s->energy();
      CHECK(s->reaction(1).force == doctest::Approx(is_broken ? 0 : -kSpring * tip).epsilon(1e-9));
    }
  }
}

TEST_CASE("several supports that break: as many branches as in closed form, to 1e-8 of the forces at which one comes or goes") {
  Monitor monitor;
  for (const std::vector<double>& at : {std::vector<double>{1, 2}, {1.2, 2}, {0.8, 1.4, 2}, {1, 1.6, 2}, {1.8, 1.9, 2}}) {
    const auto all = ranges(at);
    CHECK(all.size() >= at.size());
    for (const Range& turn : all)
      for (const double end : {turn.from, turn.to})
        for (const double factor : {0.8, 1 - 1e-8, 1 + 1e-8, 1.2}) {
          const double force = factor * end;
          if (end == 0 || std::isinf(end)) continue;
          CAPTURE(force);
          const auto minima = beam::solve(on_springs(at, force), {}, monitor);
          std::size_t expected = 0;
          for (const Range& range : all) {
            if (!(range.from < force && force < range.to)) continue;
            ++expected;
            CHECK(std::any_of(minima.begin(), minima.end(), [&](const beam::Branch& branch) {
              for (std::size_t i = 0; i < at.size(); ++i)
                if ((branch.broken[i] == beam::Broken::no) != range.whole[i]) return false;
              return true;
            }));
          }
          CHECK(minima.size() == expected);
        }
  }
}

TEST_CASE("beams in bays that clamps part: branches multiply") {
  // Springs at 0 and L on overhangs a, and in the middle of a span of length s between clamps: c = 3EJ/a³ and 192EJ/s³.
  constexpr double a = 1, s = 2, c = 3 * kEJ / (a * a * a), middle = 192 * kEJ / (s * s * s);
  const LawChoice breaks{&laws::breaking, kSpring, kLimit};
  Monitor monitor;
  for (const double left : {0.5, 0.9, 1.5})  // forces, of what the spring of the overhang breaks at
    for (const double inner : {0.5, 0.999, 1.5})
      for (const double right : {0.5, 0.9, 1.5}) {
        Beam b = test::beam_between(2 * a + s, kEJ, 0, breaks, kFree, breaks, kFree);
        b.supports.insert(b.supports.begin() + 1, {{"clamp", a, kHeld, kHeld}, {"middle", a + s / 2, breaks, kFree}, {"clamp", a + s, kHeld, kHeld}});
        const auto up_to = [](double own) { return kLimit * (kSpring + own) / kSpring; };
        const auto count = [&](double own, double factor) { return (factor < 1 ? 1u : 0u) + (factor * up_to(own) > kLimit * own / kSpring ? 1u : 0u); };
        b.loads = {{0, -left * up_to(c), 0}, {a + s / 2, -inner * up_to(middle), 0}, {2 * a + s, -right * up_to(c), 0}};
        CHECK(beam::solve(b, {}, monitor).size() == count(c, left) * count(middle, inner) * count(c, right));
      }
}

TEST_CASE("a method that cannot treat supports that are whole says so; where all would break there is no solution") {
  CHECK_THROWS_WITH_AS(test::only(cantilever(0.3), solver::InteriorPoint{}), doctest::Contains("cannot treat"), InputError);
  const auto hinged = test::beam_between(2, 1, -1, kHeld, kFree, {&laws::breaking, 4, 0.9}, kFree);
  CHECK_THROWS_WITH_AS(test::only(hinged), doctest::Contains("one of them would break"), InputError);
}

TEST_CASE("several supports that break, in deflection and rotation") {
  Beam b = test::beam_between(4, 1, -1, {&laws::prescribed, 0, 0}, {&laws::breaking, 50, 1.2}, {&laws::breaking, 30, 2.1}, kFree);
  b.supports.insert(b.supports.begin() + 1, {"middle", 2, {&laws::breaking, 20, 3}, kFree});
  Monitor monitor;
  const auto minima = beam::solve(b, {}, monitor);
  // The slope at the left end is below zero, so its spring bears nothing. About that end 2 r + 4 r' = 8: both whole, near the
  // r = 2.5 and r' = 0.75 of rigid supports; the middle one broken, r' = 2; the right one broken, r = 4, which breaks the other.
  CHECK(minima.size() == 2);
  for (const auto& [choice, s] : minima)
    for (int i = 0; i < 3; ++i) {
      const beam::Reaction r = s->reaction(i);
      const auto& law = b.supports[i].deflection;
      if (!law.is(laws::breaking)) continue;
      const double down = -r.deflection;
      const double expected = down <= 0 ? 0 : law.numbers[0] * down > law.numbers[1] ? 0 : law.numbers[0] * down;
      CHECK(std::abs(r.force - expected) < 1e-10);
    }
}
