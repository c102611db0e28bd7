#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "problem/law.hpp"

using namespace dotyk;
using namespace dotyk::problem;

namespace {

const std::vector<double> kStiffness{0, 1e-3, 1, 40, 1e3};

/// Six decades either side of zero, and zero.
std::vector<double> grid() {
  std::vector<double> values{0};
  for (double decade = 1e-3; decade < 2e3; decade *= 10)
    for (double m : {1.0, 2.5, 7.0})
      for (double sign : {1.0, -1.0}) values.push_back(sign * m * decade);
  return values;
}

std::vector<double> rhos() { return {1e-3, 1e-2, 0.1, 1, 10, 100, 1e3}; }

/// λ = P(λ + ρx), to rounding of the larger part.
bool satisfied(const Law& law, int row, double x, double lambda, double rho) {
  const double p = law.project(row, lambda + rho * x, rho).lambda;
  return std::abs(p - lambda) <= 1e-12 * std::max(std::abs(lambda), rho * std::abs(x));
}

/// Checks λ = P(λ + ρx) ⟺ `member`(x, λ) over the grids.
template <class Member>
void check_equivalence(const Law& law, int row, Member&& member) {
  for (double rho : rhos())
    for (double x : grid())
      for (double lambda : grid()) {
        const bool in_subdifferential = member(x, lambda);
        CHECK_MESSAGE(satisfied(law, row, x, lambda, rho) == in_subdifferential,
                      law.name() << " x=" << x << " lambda=" << lambda << " rho=" << rho);
      }
}

void check_slope(const Law& law, int row) {
  for (double rho : rhos())
    for (double y : grid()) {
      if (y == 0) continue;  // the kink of the unilateral law
      const double h = 1e-4 * std::abs(y);
      const double difference = (law.project(row, y + h, rho).lambda - law.project(row, y - h, rho).lambda) / (2 * h);
      const double slope = law.project(row, y, rho).slope;
      CHECK(std::abs(slope - difference) < 1e-10);  // P is linear on either side: rounding / h
      CHECK(slope >= 0);
      CHECK(slope <= 1);
    }
}

}  // namespace

TEST_CASE("unilateral: λ = P(λ + ρx) says x ≤ 0, λ ≥ 0, λx = 0") {
  const auto law = unilateral();
  check_equivalence(*law, 0, [](double x, double l) { return x <= 0 && l >= 0 && x * l == 0; });
  check_slope(*law, 0);
  CHECK(law->unilateral());
  CHECK(law->project(0, 0, 1).lambda == 0);
}

TEST_CASE("bilateral: λ = P(λ + ρx) says x = 0") {
  const auto law = bilateral();
  check_equivalence(*law, 0, [](double x, double) { return x == 0; });
  check_slope(*law, 0);
  CHECK_FALSE(law->unilateral());
}

TEST_CASE("elastic: λ = P(λ + ρx) says λ = kx") {
  const auto law = elastic(kStiffness);
  for (int row = 0; row < static_cast<int>(kStiffness.size()); ++row) {
    const double k = kStiffness[row];
    check_slope(*law, row);
    for (double rho : rhos())
      for (double x : grid()) {
        CHECK(satisfied(*law, row, x, k * x, rho));
        // Away from λ = kx the projection moves λ by (λ − kx) ρ/(k + ρ).
        for (double lambda : grid()) {
          const double moved = lambda - law->project(row, lambda + rho * x, rho).lambda;
          const double size = std::abs(lambda) + (rho + k) * std::abs(x);
          CHECK(std::abs(moved - (lambda - k * x) * rho / (k + rho)) <= 1e-13 * size);
        }
      }
  }
}

TEST_CASE("Fenchel and Young: φ(x) + φ*(λ) = λx where λ ∈ ∂φ(x), and never less") {
  const auto law = elastic(kStiffness);
  for (int row = 1; row < static_cast<int>(kStiffness.size()); ++row)
    for (double x : grid()) {
      const double k = kStiffness[row], at = law->energy(row, x) + law->conjugate(row, k * x);
      CHECK(std::abs(at - k * x * x) <= 1e-14 * k * x * x);
      for (double lambda : grid()) {
        const double both = law->energy(row, x) + law->conjugate(row, lambda);
        CHECK(both - lambda * x >= -1e-14 * both);
      }
    }
  // Indicators: both energies vanish at pairs, and so does λx.
  CHECK(unilateral()->energy(0, -1) + unilateral()->conjugate(0, 0) == 0);
  CHECK(unilateral()->energy(0, 0) + unilateral()->conjugate(0, 5) == 0);
  CHECK(bilateral()->energy(0, 0) + bilateral()->conjugate(0, -5) == 0);
}

TEST_CASE("at ρ = 0 the projection is the nearest admissible multiplier") {
  CHECK(unilateral()->project(0, -2, 0).lambda == 0);
  CHECK(unilateral()->project(0, 2, 0).lambda == 2);
  CHECK(bilateral()->project(0, -2, 0).lambda == -2);
  const auto law = elastic({0, 3});
  CHECK(law->project(0, 5, 0).lambda == 0);  // no stiffness carries no force
  CHECK(law->project(1, 5, 0).lambda == 5);
}

TEST_CASE("the elastic law refuses stiffness that is negative or no number") {
  CHECK_THROWS_WITH_AS(elastic({1, -2}), "elastic law: stiffness is -2; it must be zero or positive", InputError);
  CHECK_THROWS_AS(elastic({NAN}), InputError);
  CHECK_THROWS_AS(elastic({INFINITY}), InputError);
  CHECK_NOTHROW(elastic({0}));
}

namespace {

constexpr double kInf = Law::kUnbounded;
/// One-sided elastic, rigid friction, one-sided rigid friction, capped elastic, and the limits of each.
const std::vector<Limits> kLimits{{2, 0, kInf},  {kInf, -2.5, 2.5}, {kInf, 0, 2.5},  {40, -10, 10}, {40, -1, 7},
                                  {kInf, 0, 0},  {0, -1, 1},        {kInf, 0, kInf}, {40, 0, 0},    {kInf, -kInf, kInf}};

/// λ ∈ ∂φ(x).
bool member(const Limits& l, double x, double lambda) {
  if (l.stiffness == 0) return lambda == 0;
  if (std::isfinite(l.stiffness)) return std::abs(lambda - std::clamp(l.stiffness * x, l.low, l.high)) <= 1e-14 * std::abs(lambda);
  if (lambda < l.low || lambda > l.high) return false;
  return x == 0 || (x > 0 ? lambda == l.high : lambda == l.low);
}

}  // namespace

TEST_CASE("limited: λ = P(λ + ρx) says that λ is the spring's force, cut off") {
  const auto law = limited("limited", kLimits);
  for (int row = 0; row < static_cast<int>(kLimits.size()); ++row) {
    const Limits& l = kLimits[row];
    CAPTURE(row);
    for (double rho : rhos())
      for (double x : grid()) {
        for (double lambda : grid())
          if (member(l, x, lambda)) CHECK(satisfied(*law, row, x, lambda, rho));
        // And of every y, P(y) and x = (y − P(y))/ρ are such a pair.
        const double lambda = law->project(row, x, rho).lambda, jump = (x - lambda) / rho;
        if (std::isfinite(l.stiffness)) CHECK(std::abs(lambda - (l.stiffness > 0 ? std::clamp(l.stiffness * jump, l.low, l.high) : 0)) <= 1e-10 * (std::abs(lambda) + l.stiffness * std::abs(x) / rho));
        else CHECK(member(l, std::abs(jump) < 1e-14 * std::abs(x) / rho ? 0 : jump, lambda));
      }
    for (double y : grid()) {
      const double slope = law->project(row, y, 1).slope;
      CHECK(slope >= 0);
      CHECK(slope <= 1);
    }
  }
}

TEST_CASE("limited: Fenchel and Young") {
  const auto law = limited("limited", kLimits);
  for (int row = 0; row < static_cast<int>(kLimits.size()); ++row)
    for (double x : grid())
      for (double lambda : grid()) {
        const Interval range = law->multipliers(row);
        if (lambda < range.low || lambda > range.high) continue;
        const bool indicator = !std::isfinite(kLimits[row].stiffness) &&
                               ((x > 0 && kLimits[row].high == kInf) || (x < 0 && kLimits[row].low == -kInf));
        if (indicator) continue;  // φ is infinite there
        const double both = law->energy(row, x) + law->conjugate(row, lambda);
        CHECK(both - lambda * x >= -1e-13 * both);
        if (member(kLimits[row], x, lambda)) CHECK(std::abs(both - lambda * x) <= 1e-13 * std::abs(both));
      }
}

TEST_CASE("limited refuses what is no spring") {
  CHECK_THROWS_WITH_AS(limited("capped elastic", {{-1, -1, 1}}), "capped elastic law: stiffness is -1; it must be zero or positive", InputError);
  CHECK_THROWS_AS(limited("a", {{1, 1, 2}}), InputError);
  CHECK_THROWS_AS(limited("a", {{1, -2, -1}}), InputError);
  CHECK_THROWS_AS(limited("a", {{NAN, -2, 1}}), InputError);
  CHECK_THROWS_AS(limited("a", {{1, NAN, 1}}), InputError);
}

namespace {

const std::vector<Springs> kSprings{{2, 40}, {40, 2}, {0, 3}, {3, 0}, {0, 0}, {7, 7}, {1e-3, 1e3}};

}  // namespace

TEST_CASE("unequal elastic: λ = P(λ + ρx) says λ = kx, k by the side of x") {
  const auto law = unequal_elastic(kSprings);
  for (int row = 0; row < static_cast<int>(kSprings.size()); ++row) {
    CAPTURE(row);
    check_slope(*law, row);
    for (double x : grid()) {
      const double lambda = (x < 0 ? kSprings[row].below : kSprings[row].above) * x;
      for (double rho : rhos()) {
        CHECK(satisfied(*law, row, x, lambda, rho));
        // The pair of every y: P(y) = k (y − P(y))/ρ.
        const double of_y = law->project(row, x, rho).lambda, k = x < 0 ? kSprings[row].below : kSprings[row].above;
        CHECK(std::abs(of_y * rho - k * (x - of_y)) <= 1e-14 * (k + rho) * std::abs(x));
      }
      const double both = law->energy(row, x) + law->conjugate(row, lambda);
      CHECK(std::abs(both - lambda * x) <= 1e-14 * both);
      const Interval range = law->multipliers(row);
      for (double other : grid())
        if (other >= range.low && other <= range.high)
          CHECK(law->energy(row, x) + law->conjugate(row, other) - other * x >= -1e-14 * law->energy(row, x) - 1e-14 * std::abs(other * x));
    }
  }
}

TEST_CASE("unequal elastic with one stiffness is elastic, with one of 0 one-sided") {
  const auto same = unequal_elastic({{7, 7}}), up = unequal_elastic({{0, 3}}), down = unequal_elastic({{3, 0}});
  const auto equal = elastic({7}), pushes = limited("one-sided", {{3, 0, kInf}}), pulls = limited("one-sided", {{3, -kInf, 0}});
  CHECK(*same->linear_stiffness(0) == 7);
  CHECK_FALSE(up->linear_stiffness(0));
  CHECK_FALSE(unequal_elastic({{0, 0}, {1, 2}})->linear_stiffness(0));  // of all rows
  for (const auto& [a, b] : {std::pair{same, equal}, {up, pushes}, {down, pulls}}) {
    CHECK(a->multipliers(0).low == b->multipliers(0).low);
    CHECK(a->multipliers(0).high == b->multipliers(0).high);
    CHECK(following(*a, 0).low == following(*b, 0).low);
    CHECK(following(*a, 0).high == following(*b, 0).high);
    for (double y : grid()) {
      for (double rho : rhos()) {
        CHECK(a->project(0, y, rho).lambda == b->project(0, y, rho).lambda);
        CHECK(a->project(0, y, rho).slope == b->project(0, y, rho).slope);
      }
      CHECK(a->energy(0, y) == doctest::Approx(b->energy(0, y)).epsilon(1e-14));
    }
  }
  CHECK_THROWS_WITH_AS(unequal_elastic({{1, -2}}), "unequal elastic law: a stiffness is -2; it must be zero or positive, and finite", InputError);
  CHECK_THROWS_AS(unequal_elastic({{kInf, 1}}), InputError);
  CHECK_THROWS_AS(unequal_elastic({{1, NAN}}), InputError);
}
