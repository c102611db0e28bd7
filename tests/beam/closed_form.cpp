#include <doctest/doctest.h>

#include <cmath>

#include "../support/exact_beam.hpp"

using namespace dotyk;
using beam::Beam;
using problem::LawChoice;
namespace laws = dotyk::problem::laws;
using test::kFree;
using test::kHeld;

TEST_CASE("textbook beams") {
  const double L = 3, EJ = 7, q = -2;
  SUBCASE("cantilever") {
    const auto s = test::only(test::beam_between(L, EJ, q, kHeld, kHeld, kFree, kFree));
    CHECK(s->deflection(L) == doctest::Approx(q * std::pow(L, 4) / (8 * EJ)).epsilon(1e-10));
    CHECK(s->rotation(L) == doctest::Approx(q * std::pow(L, 3) / (6 * EJ)).epsilon(1e-10));
    CHECK(s->reaction(0).force == doctest::Approx(-q * L).epsilon(1e-10));
    CHECK(s->reaction(0).moment == doctest::Approx(-q * L * L / 2).epsilon(1e-10));
    CHECK(s->moment(0) == doctest::Approx(-q * L * L / 2).epsilon(1e-10));
    CHECK(s->shear(0) == doctest::Approx(q * L).epsilon(1e-10));
    CHECK(std::abs(s->moment(L)) < 1e-10);
    CHECK(std::abs(s->shear(L)) < 1e-10);
  }
  SUBCASE("on two supports") {
    const auto s = test::only(test::beam_between(L, EJ, q, kHeld, kFree, kHeld, kFree));
    CHECK(s->deflection(L / 2) == doctest::Approx(5 * q * std::pow(L, 4) / (384 * EJ)).epsilon(1e-10));
    CHECK(s->moment(L / 2) == doctest::Approx(q * L * L / 8).epsilon(1e-10));
    CHECK(s->reaction(1).force == doctest::Approx(-q * L / 2).epsilon(1e-10));
  }
  SUBCASE("clamped at both ends") {
    const auto s = test::only(test::beam_between(L, EJ, q, kHeld, kHeld, kHeld, kHeld));
    CHECK(s->deflection(L / 2) == doctest::Approx(q * std::pow(L, 4) / (384 * EJ)).epsilon(1e-10));
    CHECK(s->reaction(0).moment == doctest::Approx(-q * L * L / 12).epsilon(1e-10));
    CHECK(s->reaction(1).moment == doctest::Approx(q * L * L / 12).epsilon(1e-10));
  }
  SUBCASE("continuous over a middle support, which is no node of equal cells") {
    Beam b = test::beam_between(L, EJ, q, kHeld, kFree, kHeld, kFree);
    b.cells = 7;
    b.supports.insert(b.supports.begin() + 1, {"middle", L / 2, kHeld, kFree});
    const auto s = test::only(b);
    CHECK(s->reaction(1).force == doctest::Approx(-5 * q * L / 8).epsilon(1e-10));
    CHECK(s->moment(L / 2) == doctest::Approx(-q * L * L / 32).epsilon(1e-10));
  }
}

TEST_CASE("point loads within a cell: exact at nodes") {
  const double L = 2, EJ = 3, F = -1.5, m = 0.4, a = 0.77;
  for (const int cells : {1, 2, 9}) {
    CAPTURE(cells);
    Beam b = test::beam_between(L, EJ, 0, kHeld, kHeld, kFree, kFree);
    b.cells = cells;
    b.loads = {{a, F, m}};
    const auto s = test::only(b);
    CHECK(s->deflection(L) == doctest::Approx(F * a * a * (3 * L - a) / (6 * EJ) + m * a * (2 * L - a) / (2 * EJ)).epsilon(1e-10));
    CHECK(s->rotation(L) == doctest::Approx(F * a * a / (2 * EJ) + m * a / EJ).epsilon(1e-10));
    CHECK(s->moment(0.2) == doctest::Approx(-F * (a - 0.2) - m).epsilon(1e-10));
    CHECK(std::abs(s->moment(1)) < 1e-12);
    CHECK(s->shear(0.2) == doctest::Approx(F).epsilon(1e-10));
  }
}

TEST_CASE("polynomial loads: exact at nodes") {
  // u = x²(L − x)²(1 + x + x³) clamped at both ends: q = EJ u⁗ of degree 3.
  const double L = 1.5, EJ = 2;
  const auto p = [L](double x) { return std::array<double, 8>{0, 0, L * L, L * L - 2 * L, 1 - 2 * L, 1 + L * L, -2 * L, 1}[static_cast<int>(x)]; };
  Beam b = test::beam_between(L, EJ, 0, kHeld, kHeld, kHeld, kHeld);
  b.q_of = [&](double x) {
    double sum = 0;
    for (int n = 4; n < 8; ++n) sum += p(n) * n * (n - 1) * (n - 2) * (n - 3) * std::pow(x, n - 4);
    return EJ * sum;
  };
  b.cells = 6;
  const auto s = test::only(b);
  for (int i = 1; i < 6; ++i) {
    const double x = i * L / 6, u = x * x * (L - x) * (L - x) * (1 + x + x * x * x);
    CHECK(s->deflection(x) == doctest::Approx(u).epsilon(1e-10));
    double slope = 0, curvature = 0;
    for (int n = 2; n < 8; ++n) slope += n * p(n) * std::pow(x, n - 1), curvature += n * (n - 1) * p(n) * std::pow(x, n - 2);
    CHECK(s->rotation(x) == doctest::Approx(slope).epsilon(1e-9));
    CHECK(s->moment(x + 0.1) == doctest::Approx([&] {
      double at = 0;
      for (int n = 2; n < 8; ++n) at -= EJ * n * (n - 1) * p(n) * std::pow(x + 0.1, n - 2);
      return at;
    }()).epsilon(1e-9));
  }
}

TEST_CASE("a stiffness that varies: a cantilever thinning to its tip") {
  // EJ = 1 + L − x, force F at the tip: u″ = F(L − x)/EJ.
  const double L = 2, F = 0.3;
  const auto exact = [&](double x) {  // ∫∫ F (1 − 1/(1 + L − x))
    const double y = 1 + L - x, y0 = 1 + L;
    return F * (x * x / 2 - ((y * std::log(y) - y) - (y0 * std::log(y0) - y0) + x * std::log(y0)));
  };
  double last = 0;
  for (const int cells : {4, 8, 16, 32}) {
    Beam b = test::beam_between(L, 1, 0, kHeld, kHeld, {&laws::load, F, 0}, kFree);
    b.EJ_of = [&](double x) { return 1 + L - x; };
    b.cells = cells;
    const double error = std::abs(test::only(b)->deflection(L) - exact(L));
    if (last > 0) CHECK(std::log2(last / error) > 3.8);
    last = error;
  }
  CHECK(last < 1e-6);
}

TEST_CASE("order 4 in deflection, 3 in rotation, for a general load") {
  // u = sin x on two supports at 0 and π.
  double last_u = 0, last_slope = 0;
  for (const int cells : {4, 8, 16, 32}) {
    Beam b = test::beam_between(M_PI, 1, 0, kHeld, kFree, kHeld, kFree);
    b.q_of = [](double x) { return std::sin(x); };
    b.cells = cells;
    const auto s = test::only(b);
    double u = 0, slope = 0;
    for (int i = 0; i <= 1000; ++i) {
      const double x = M_PI * i / 1000;
      u = std::max(u, std::abs(s->deflection(x) - std::sin(x)));
      slope = std::max(slope, std::abs(s->rotation(x) - std::cos(x)));
      CHECK(std::abs(s->moment(x) - std::sin(x)) < 1e-9);  // by equilibrium: no error but that of the rule
    }
    if (last_u > 0) {
      CHECK(std::log2(last_u / u) == doctest::Approx(4).epsilon(0.03));
      CHECK(std::log2(last_slope / slope) == doctest::Approx(3).epsilon(0.03));
    }
    last_u = u;
    last_slope = slope;
  }
}

TEST_CASE("rounding grows as the fourth power of the number of cells, to 1e-6 at the most allowed") {
  for (const int cells : {10, 100, 1000}) {
    Beam b = test::beam_between(1, 1, -1, kHeld, kFree, kHeld, kFree);
    b.cells = cells;
    const double error = std::abs(test::only(b)->deflection(0.5) * 384 / -5 - 1);
    CHECK(error < 1e-5 * std::pow(cells / 1000.0, 4) + 1e-12);
  }
}

TEST_CASE("beams that are none are refused") {
  const Beam good = test::beam_between(1, 1, -1, kHeld, kFree, kHeld, kFree);
  const auto refused = [&](const std::function<void(Beam&)>& change, const char* message) {
    Beam b = good;
    change(b);
    CHECK_THROWS_WITH_AS(test::only(b), message, InputError);
  };
  refused([](Beam& b) { b.length = 0; }, "its length is 0; it must be positive");
  refused([](Beam& b) { b.EJ = -1; }, "EJ is -1; it must be positive");
  refused([](Beam& b) { b.cells = 0; }, "it has 0 cells; at least one is needed");
  refused([](Beam& b) { b.EJ_of = [](double x) { return x - 0.5; }; }, "EJ is -0.49938 at x = 0.000620471; it must be positive");
  refused([](Beam& b) { b.loads = {{2, 1, 0}}; }, "a load is at x = 2; the beam goes from 0 to 1");
  refused([](Beam& b) { b.supports[1].x = 0; }, "the supports left and right are at one point");
  refused([](Beam& b) { b.supports[1].deflection = {&laws::elastic, -3, 0}; }, "elastic law: k is -3; it must be zero or positive, and finite");
  refused([](Beam& b) { b.q = NAN; }, "its load is nan");
  refused([](Beam& b) { b.cells = 1001; }, "it has 1001 cells; rounding grows as the fourth power of their number, and 1000 leave it 1e-6");
  refused([](Beam& b) { b.q = 0, b.supports.clear(); }, "nothing holds it, and nothing loads it");
}
