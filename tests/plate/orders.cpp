#include <doctest/doctest.h>

#include "../support/plates.hpp"

using namespace dotyk;
using namespace dotyk::plate;
using test::kElements;
using test::kFree;
using test::kHeld;

namespace {

using Jet = Eigen::Matrix<double, 6, 1>;

/// A function of one variable with its derivatives.
struct Along {
  double f, d, dd, ddd, dddd;
};
Along clamped(double t) { return {t * t * (1 - t) * (1 - t), 2 * t * (1 - t) * (1 - 2 * t), 2 - 12 * t + 12 * t * t, -12 + 24 * t, 24}; }
Along sine(double t) {
  const double p = std::numbers::pi, s = std::sin(p * t), c = std::cos(p * t);
  return {s, p * c, -p * p * s, -p * p * p * c, p * p * p * p * s};
}

/// u = X(x) Y(y) on the unit square, X = Y.
struct Product {
  Along (*along)(double);
  Jet values(double x, double y) const {
    const Along X = along(x), Y = along(y);
    return {X.f * Y.f, X.d * Y.f, X.f * Y.d, X.dd * Y.f, X.f * Y.dd, 2 * X.d * Y.d};
  }
  double bilaplacian(double x, double y) const {
    const Along X = along(x), Y = along(y);
    return X.dddd * Y.f + 2 * X.dd * Y.dd + X.f * Y.dddd;
  }
};

constexpr double kPoisson = 0.25;

/// D = 1 + x + y/2 and what it makes of a deflection: ∂ij (D [(1 − ν) ∂ij u + ν Δu δij]); D is linear, so
/// D Δ²u + 2 ∇D · ∇Δu: what the second derivatives of a linear D would add is 0.
double stiffness_at(double x, double y) { return 1 + x + y / 2; }
double load_of_varying(const Product& u, double x, double y) {
  const Along X = u.along(x), Y = u.along(y);
  const double laplacian_x = X.ddd * Y.f + X.d * Y.dd, laplacian_y = X.dd * Y.d + X.f * Y.ddd;
  return stiffness_at(x, y) * u.bilaplacian(x, y) + 2 * (laplacian_x + laplacian_y / 2);
}

/// Errors on n × n, 2n × 2n, … cells; the observed orders are between the last two.
struct Orders {
  double energy, slope, deflection;
};
Orders observed(const std::function<Plate(const test::Mesh&)>& plate, const test::Exact& exact, bool distorted, int n, int times) {
  test::PlateError last{}, now{};
  for (int k = 0; k < times; ++k, n *= 2) {
    test::Mesh m = test::rectangle(test::Family::p1, n, n);
    if (distorted) test::distort(m, 0.06);
    const auto s = test::solved(plate(m));
    REQUIRE(s->result().converged);
    last = now;
    now = test::error(*s, exact);
  }
  return {std::log2(last.curvature / now.curvature), std::log2(last.slope / now.slope), std::log2(last.deflection / now.deflection)};
}

/// Morley 1, 2 and 2, HCT 2, 3 and 4, which is reached slowly: HCT's 4 is 3.3, 3.65, 3.86, 3.94 on even meshes from 4 cells on, later on bent ones.
void check_orders(Element element, const Orders& o) {
  const bool morley = element == Element::morley;
  CAPTURE(o.energy);
  CAPTURE(o.slope);
  CAPTURE(o.deflection);
  CHECK(std::abs(o.energy - (morley ? 1 : 2)) < 0.1);
  CHECK(std::abs(o.slope - (morley ? 2 : 3)) < 0.2);
  CHECK(std::abs(o.deflection - (morley ? 2 : 4)) < (morley ? 0.15 : 0.25));
}

}  // namespace

TEST_CASE("orders of the clamped square, of the simply supported one, and with a stiffness that varies" * doctest::test_suite("large")) {
  for (const Element element : kElements)
    for (const bool distorted : {false, true})
      for (const bool is_clamped : {true, false})
        for (const bool varying : {false, true}) {
          if (varying && !is_clamped) continue;
          CAPTURE(std::string(element_name(element)));
          CAPTURE(distorted);
          CAPTURE(is_clamped);
          CAPTURE(varying);
          const Product u{is_clamped ? clamped : sine};
          const auto plate = [&](const test::Mesh& m) {
            Plate p = test::plate_on(m, element);
            p.nu = kPoisson;
            if (varying) p.D_of = stiffness_at;
            p.f_of = [&](double x, double y) { return varying ? load_of_varying(u, x, y) : u.bilaplacian(x, y); };
            test::support(p, "", kHeld, is_clamped ? kHeld : kFree);
            return p;
          };
          check_orders(element, observed(plate, [&](double x, double y) { return u.values(x, y); }, distorted, 16, 3));
        }
}

TEST_CASE("orders with deflections and rotations prescribed by functions that are no polynomials" * doctest::test_suite("large")) {
  // u = exp(x) sin(2y): Δ²u = (1 − 4)² u.
  const auto exact = [](double x, double y) {
    const double e = std::exp(x), s = std::sin(2 * y), c = std::cos(2 * y);
    return Jet{e * s, e * s, 2 * e * c, e * s, -4 * e * s, 4 * e * c};
  };
  for (const Element element : kElements)
    for (const bool held : {true, false}) {  // the rotation, or the moment
      CAPTURE(held);
      const auto plate = [&](const test::Mesh& m) {
        Plate p = test::plate_on(m, element);
        p.nu = kPoisson;
        p.f_of = [&](double x, double y) { return 9 * exact(x, y)[0]; };
        const struct {
          const char* part;
          double nx, ny;
        } sides[] = {{"left", -1, 0}, {"right", 1, 0}, {"bottom", 0, -1}, {"top", 0, 1}};
        for (const auto& side : sides) {
          const auto rotation = [exact, side, held](double x, double y) {
            const Jet v = exact(x, y);
            const double along = side.nx * v[1] + side.ny * v[2], bent = side.nx != 0 ? v[3] : v[4];
            return held ? test::LawChoice{&laws::prescribed, along} : test::LawChoice{&laws::load, kPoisson * (v[3] + v[4]) + (1 - kPoisson) * bent};
          };
          test::support(p, side.part, test::prescribed([exact](double x, double y) { return exact(x, y)[0]; }), rotation);
        }
        return p;
      };
      check_orders(element, observed(plate, exact, true, 16, 3));
    }
}
