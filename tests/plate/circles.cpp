#include <doctest/doctest.h>

#include "../support/plates.hpp"

using namespace dotyk;
using namespace dotyk::plate;
namespace laws = dotyk::problem::laws;
using test::kD;
using test::kElements;
using test::kFree;
using test::kHeld;
using test::kNu;

namespace {

constexpr double kR = 2, kQ = -1.5, kPi = std::numbers::pi;

Plate disc(Element element, int cells, test::LawChoice rotation, double load) {
  Plate p = test::plate_on(test::disc(test::Family::p1, cells, 0.4, -0.7, kR), element, load);
  p.D = kD, p.nu = kNu;
  test::support(p, "boundary", kHeld, rotation);
  return p;
}
double centre(const Solution& s) { return s.deflection(0.4, -0.7); }

/// Relative errors on meshes of 6, 12, 24 and 48 rings: the last one, and the order between the last two.
struct Seen {
  double error, order;
};
Seen observed(const std::function<Plate(int)>& plate, double exact) {
  double last = 0, now = 0;
  for (const int cells : {6, 12, 24, 48}) {
    last = now;
    now = std::abs(centre(*test::solved(plate(cells))) / exact - 1);
  }
  return {now, std::log2(last / now)};
}

}  // namespace

TEST_CASE("round plates under a constant load, clamped and simply supported: no paradox of Babuška") {
  const double clamped = kQ * std::pow(kR, 4) / (64 * kD), supported = clamped * (5 + kNu) / (1 + kNu);
  for (const Element element : kElements) {
    CAPTURE(std::string(element_name(element)));
    for (const bool clamp : {true, false}) {
      CAPTURE(clamp);
      const auto seen = observed([&](int cells) { return disc(element, cells, clamp ? kHeld : kFree, kQ); }, clamp ? clamped : supported);
      CAPTURE(seen.error);
      CHECK(seen.error < 2e-3);
      CHECK(seen.order > 1.9);  // the polygon's own limit, a simply supported plate that is too stiff, would be off by tens of per cent
    }
  }
}

TEST_CASE("HCT: the reaction per length along a clamped round edge is the load's share, with the couples that hold the slope along it") {
  for (const int cells : {24, 48}) {
    CAPTURE(cells);
    const auto s = test::solved(disc(Element::hct, cells, kHeld, kQ));
    const auto edge = reaction(*s, 0);
    std::vector<double> off;
    double force = 0;
    for (std::size_t i = 0; i + 1 < edge.pieces.front().size(); ++i) {
      const EdgePoint& p = edge.pieces.front()[i];
      off.push_back(std::abs(p.per_length() / (-kQ * kR / 2) - 1));
      force += p.force;
    }
    CHECK(force == doctest::Approx(edge.force).epsilon(1e-12));
    std::ranges::sort(off);
    // 4 % at the six nodes of the edge where only two cells meet, on every mesh: the sides of a polygon shear otherwise than a circle.
    CHECK(off[off.size() - 19] < 0.005);
    CHECK(off[off.size() / 2] < 0.2 / (cells * cells));
    CHECK(off.back() < 0.05);
  }
}

TEST_CASE("a force at the centre of a clamped round plate") {
  const double exact = kQ * kR * kR / (16 * kPi * kD);
  for (const Element element : kElements) {
    CAPTURE(std::string(element_name(element)));
    const auto seen = observed(
        [&](int cells) {
          Plate p = disc(element, cells, kHeld, 0);
          p.point_loads = {{0.4, -0.7, kQ}};
          return p;
        },
        exact);
    CAPTURE(seen.error);
    CHECK(seen.error < (element == Element::morley ? 5e-3 : 2e-4));
    CHECK(seen.order > 1.75);  // h² log h: Morley's is 1.70, 1.75, 1.79 from 6 rings on
  }
}

TEST_CASE("a round plate that turns about its edge against springs: between supported and clamped") {
  // Radial symmetry: u = c (r² − R²) + q (r⁴ − R⁴)/64D, −Mᵣ = k u': spring k per length of the slope.
  const double k = 1.7;
  const double slope = kQ * kR * kR * kR / (16 * kD), moment = kQ * kR * kR * (3 + kNu) / 16;  // of the quartic part: u' and D(u'' + ν u'/r)
  const double c = -(moment + k * slope) / (2 * kD * (1 + kNu) + 2 * k * kR);
  const double exact = -c * kR * kR - kQ * std::pow(kR, 4) / (64 * kD);
  for (const Element element : kElements) {
    const auto seen = observed([&](int cells) { return disc(element, cells, {&laws::elastic, k}, kQ); }, exact);
    CAPTURE(seen.error);
    CHECK(seen.error < 2e-3);
    CHECK(seen.order > 1.8);
  }
}
