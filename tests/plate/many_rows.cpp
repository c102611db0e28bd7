#include <doctest/doctest.h>

#include "../support/plates.hpp"
#include "solver/active/pdas.hpp"

using namespace dotyk;
using algebra::Vector;
using plate::Plate;
namespace laws = dotyk::problem::laws;
using test::kElements;
using test::kFree;
using test::kHeld;
using test::LawChoice;

// Over an obstacle every vertex has a row. PDAS on the unknowns, begun by an interior point method, against PDAS begun at rest.

namespace {

struct Case {
  const char* name;
  LawChoice deflection, rotation;
  double load = -100, point = 0;  // at (0.3, 0.4)
  plate::Field obstacle = [](double, double) { return -0.1; };
};

const std::vector<Case> kCases{
    {"simply supported", kHeld, kFree},
    {"clamped over a dome", kHeld, kHeld, -100, 0, [](double x, double y) { return -0.01 - std::pow(x - 0.4, 2) - std::pow(y - 0.55, 2); }},
    {"Signorini's edge", {&laws::signorini}, kFree},
    {"elastic edge", {&laws::elastic, 50}, kFree},
    {"one-sided elastic edge, a turning one that slips", {&laws::one_sided_elastic, 500}, {&laws::friction, 1}},
    {"edge with friction", {&laws::friction, 20}, kFree},
    {"edge with two stiffnesses", {&laws::unequal_elastic, 100, 20}, kFree},
    {"lying on it, lifted by a force", kFree, kFree, -1, -10, [](double, double) { return 0.0; }},
    {"lying in a bowl", kFree, kFree, -100, 0, [](double x, double y) { return 0.3 * (std::pow(x - 0.5, 2) + std::pow(y - 0.5, 2)); }},
    {"pressed up by it, without a load", kHeld, kFree, 0, 0, [](double x, double y) { return 0.05 - std::pow(x - 0.5, 2) - std::pow(y - 0.5, 2); }},
    {"over half of it", kHeld, kFree, -100, 0, [](double x, double) { return x < 0.5 ? -0.05 : -1e30; }},
};

Plate plate_over(const Case& c, plate::Element element, int cells, double length = 1, double D = 1) {
  test::Mesh m = test::rectangle(test::Family::p1, cells, cells);
  mesh::transform(m, [&](const test::Point& x) { return test::Point{length * x[0], length * x[1], 0}; });
  Plate p = test::plate_on(std::move(m), element, D / std::pow(length, 3) * c.load);  // deflections that grow as the length
  p.D = D;
  if (c.point != 0) p.point_loads = {{0.3 * length, 0.4 * length, D / length * c.point}};
  p.obstacle = [&c, length](double x, double y) { return length * c.obstacle(x / length, y / length); };
  test::support(p, "", c.deflection, c.rotation);
  return p;
}

solver::Pdas held() {
  solver::Pdas settings;
  settings.reduced = false;
  settings.interior = true;
  return settings;
}

solver::Pdas full() {
  solver::Pdas settings;
  settings.reduced = false;
  settings.max_iterations = 300;
  return settings;
}

/// Of the interior point method.
int steps(const plate::Solution& s) {
  const std::string& reason = s.result().reason;
  const auto at = reason.find("begun with ");
  REQUIRE(at != std::string::npos);
  return std::stoi(reason.substr(at + 11));
}

}  // namespace

TEST_CASE("rows at every vertex: the solution of the whole system by LU, for every law of the edge" * doctest::test_suite("large")) {
  for (const auto element : kElements)
    for (const Case& c : kCases) {
      CAPTURE(c.name);
      CAPTURE(plate::element_name(element));
      const Plate p = plate_over(c, element, 12);
      const auto a = test::solved(p, full()), b = test::solved(p, held());
      REQUIRE(a->result().converged);
      REQUIRE_MESSAGE(b->result().converged, b->result().reason);
      CHECK(b->energy() == doctest::Approx(a->energy()).epsilon(1e-9));
      CHECK((a->freedoms() - b->freedoms()).lpNorm<Eigen::Infinity>() < 1e-9 * a->freedoms().lpNorm<Eigen::Infinity>());
      // Forces: LU of the system has as much rounding, stiffness times what rounding leaves of deflections.
      const Vector &x = a->result().state.lambda, &y = b->result().state.lambda;
      CHECK((x - y).lpNorm<Eigen::Infinity>() < 1e-9 * x.lpNorm<Eigen::Infinity>());
      CHECK(b->residual().equilibrium < 1e-9);
    }
}

TEST_CASE("units of length and force do not matter to the number of steps") {
  for (const Case& c : {kCases[0], kCases[2], kCases[7]}) {
    const int here = steps(*test::solved(plate_over(c, plate::Element::morley, 12), held()));
    for (const auto& [length, D] : {std::pair{1000.0, 1.0}, {1e-3, 1.0}, {1.0, 1e9}, {1000.0, 2e8}}) {
      const auto s = test::solved(plate_over(c, plate::Element::morley, 12, length, D), held());
      REQUIRE(s->result().converged);
      CHECK(std::abs(steps(*s) - here) <= 1);  // rounding is another
      CHECK(s->result().iterations <= 2);
    }
  }
}

TEST_CASE("iterations hardly grow with the mesh; small plates are condensed, large ones not" * doctest::test_suite("large")) {
  for (const auto element : kElements) {
    CHECK(test::solved(plate_over(kCases[0], element, 8))->result().method == "pdas");
    for (const int cells : {32, 64}) {
      const auto s = test::solved(plate_over(kCases[0], element, cells));
      REQUIRE(s->result().converged);
      CHECK(s->result().method == "pdas (held)");
      CHECK(s->result().iterations + steps(*s) <= 16);
    }
  }
}
