#include <doctest/doctest.h>

#include "../support/plate_laws.hpp"

using namespace dotyk;
using plate::Plate;
using plate::Solution;
namespace laws = dotyk::problem::laws;
using test::kElements;
using test::kFree;
using test::kHeld;
using test::LawChoice;

namespace {

/// All u + t·motion with from ≤ t ≤ to obey the laws, and no others do.
void check_family(const Solution& s, double from, double to) {
  REQUIRE(s.result().converged);
  REQUIRE(s.family());
  const auto& all = *s.family();
  CHECK(all.motion.lpNorm<Eigen::Infinity>() == doctest::Approx(1));
  if (std::isinf(from)) CHECK(all.from == from);
  if (std::isinf(to)) CHECK(all.to == to);
  REQUIRE(all.from <= all.to);
  const double low = std::isinf(all.from) ? (std::isinf(all.to) ? -100 : all.to - 100) : all.from, high = std::isinf(all.to) ? (std::isinf(all.from) ? 100 : all.from + 100) : all.to;
  for (const double t : {low, (2 * low + high) / 3, high}) CHECK(test::off_laws(s, t) < 1e-8);
  const double beyond = 1e-3 * std::max(s.freedoms().lpNorm<Eigen::Infinity>(), high - low > 99 ? 0.0 : high - low);
  if (std::isfinite(all.from)) CHECK(test::off_laws(s, low - beyond) > 1e-5);
  if (std::isfinite(all.to)) CHECK(test::off_laws(s, high + beyond) > 1e-5);
  CHECK(s.residual().equilibrium < 1e-9);
  CHECK(s.result().reason.find("unique up to") != std::string::npos);
}

/// What the auxiliary problem of P5, lemma 10 gives, with the force per length κ on the edge: up to a constant.
std::shared_ptr<const Solution> auxiliary(Plate p, double per_length) {
  p.edges.clear();
  p.obstacle = {};
  test::support(p, "", {&laws::load, per_length}, kHeld);
  p.supports = {{0.5, 0.5, {&laws::prescribed}}};
  return test::solved(p);
}

std::vector<plate::EdgePoint> of_edge(const Solution& s) { return plate::reaction(s, 0).pieces.front(); }

void check_same_but_for_motion(const Solution& a, const Solution& b) {
  algebra::Vector off(a.plate().mesh->node_count());
  for (int n = 0; n < off.size(); ++n) off[n] = a.vertex_deflection(n) - b.vertex_deflection(n);
  CHECK(off.maxCoeff() - off.minCoeff() < 1e-9 * std::max(a.freedoms().lpNorm<Eigen::Infinity>(), b.freedoms().lpNorm<Eigen::Infinity>()));
}

}  // namespace

TEST_CASE("lemma 10: a load without resultant on a one-sided edge that cannot rotate, w + c with c upwards without end") {
  for (const plate::Element element : kElements)
    for (const LawChoice law : {LawChoice{&laws::signorini}, LawChoice{&laws::one_sided_elastic, 5}, LawChoice{&laws::one_sided_friction, 2}})
      for (const bool function : {true, false}) {
        CAPTURE(problem::describe(law));
        Plate p = test::plate_on(test::rough(8), element);
        test::support(p, "", law, kHeld);
        if (function) p.f_of = [](double x, double y) { return x * x + y - 5. / 6; };
        else p.point_loads = {{0.3, 0.4, -1}, {0.71, 0.6, 1}};
        const auto s = test::solved(p);
        check_family(*s, 0, INFINITY);
        CHECK(s->family()->from == 0);  // given where it just touches
        check_same_but_for_motion(*s, *auxiliary(p, 0));
        double lowest = INFINITY;
        for (const auto& point : of_edge(*s)) {
          lowest = std::min(lowest, point.deflection);
          CHECK(std::abs(point.force) < 1e-9);
        }
        CHECK(std::abs(lowest) < (element == plate::Element::morley ? 1e-12 : 1e-3));  // HCT: the laws are about means near the vertices
      }
}

TEST_CASE("(64): a resultant that is all that friction can bear, w + c until the edge would have to rub the other way") {
  for (const plate::Element element : kElements)
    for (const double sign : {-1.0, 1.0}) {
      Plate p = test::plate_on(test::rough(8), element, sign * 4 * 0.3);
      test::support(p, "", {&laws::friction, 0.3}, kHeld);
      const auto s = test::solved(p);
      check_family(*s, 0, INFINITY);
      CHECK(s->motion(0.5, 0.5) == doctest::Approx(sign));  // on in the load's direction
      check_same_but_for_motion(*s, *auxiliary(p, -sign * 0.3));
      for (const auto& point : of_edge(*s)) CHECK(point.force == doctest::Approx(-sign * 0.3 * point.length).epsilon(1e-9));
    }
}

TEST_CASE("capped springs at their cap everywhere: the plate goes on from where the last one yields") {
  for (const plate::Element element : kElements) {
    Plate p = test::plate_on(test::rough(8), element, -4 * 0.3);
    test::support(p, "", {&laws::capped_elastic, 10, 0.3}, kHeld);
    const auto s = test::solved(p);
    check_family(*s, 0, INFINITY);
    CHECK(s->motion(0.5, 0.5) == doctest::Approx(-1));
    for (const auto& point : of_edge(*s)) CHECK(point.deflection <= -0.03 + (element == plate::Element::morley ? 1e-12 : 1e-3));
  }
}

TEST_CASE("limit cases by point supports: a force over one support, and on the line between two") {
  for (const plate::Element element : kElements) {
    Plate p = test::plate_on(test::rough(8), element);
    for (const auto& [x, y] : {std::pair(0.1, 0.1), {0.9, 0.1}, {0.1, 0.9}}) p.supports.push_back({x, y, {&laws::signorini}});
    p.point_loads = {{0.3, 0.1, -1}};
    const auto s = test::solved(p);
    check_family(*s, 0, INFINITY);
    CHECK(plate::point_reaction(*s, 0) == doctest::Approx(0.75));
    CHECK(plate::point_reaction(*s, 1) == doctest::Approx(0.25));
    CHECK(std::abs(plate::point_reaction(*s, 2)) < 1e-9);
    CHECK(std::abs(s->motion(0.5, 0.1)) < 1e-9);  // it turns about the line of the two
    CHECK(s->motion(0.5, 0.9) > 0.5);
  }
}

TEST_CASE("a motion that no support notices, all supports on one line: without end both ways") {
  for (const plate::Element element : kElements)
    for (const problem::LawSpec* kind : {&laws::prescribed, &laws::signorini}) {
      Plate p = test::plate_on(test::rectangle(test::Family::p1, 8, 8), element, -1);
      for (const double y : {0.0, 1.0}) p.supports.push_back({y, y, {kind}});
      const auto s = test::solved(p);
      check_family(*s, -INFINITY, INFINITY);
      for (int k = 0; k < 2; ++k) CHECK(plate::point_reaction(*s, k) == doctest::Approx(0.5));
      CHECK(std::abs(s->motion(0.5, 0.5)) < 1e-9);
      CHECK(std::abs(s->motion(0, 1)) > 0.5);
    }
}

TEST_CASE("three one-sided corners, the resultant on the line of two: the third leaves without end") {
  for (const plate::Element element : kElements) {
    Plate p = test::plate_on(test::rectangle(test::Family::p1, 8, 8), element, -1);
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {1.0, 0.0}, {0.0, 1.0}}) p.supports.push_back({x, y, {&laws::signorini}});
    const auto s = test::solved(p);
    check_family(*s, 0, INFINITY);
    CHECK(std::abs(plate::point_reaction(*s, 0)) < 1e-9);
    CHECK(plate::point_reaction(*s, 1) == doctest::Approx(0.5));
    CHECK(plate::point_reaction(*s, 2) == doctest::Approx(0.5));
  }
}

TEST_CASE("an obstacle, a load without resultant and an edge that cannot rotate: upwards without end") {
  for (const plate::Element element : kElements) {
    Plate p = test::plate_on(test::rough(8), element);
    test::support(p, "", kFree, kHeld);
    p.point_loads = {{0.3, 0.4, -1}, {0.71, 0.6, 1}};
    p.obstacle = [](double x, double) { return 0.01 * x; };
    const auto s = test::solved(p);
    REQUIRE(s->family());
    CHECK(s->family()->from == 0);
    CHECK(s->family()->to == INFINITY);
    CHECK(s->motion(0.2, 0.3) == doctest::Approx(1));
    double gap = INFINITY;
    for (int n = 0; n < s->plate().mesh->node_count(); ++n) gap = std::min(gap, s->vertex_deflection(n) - 0.01 * s->plate().mesh->node(n)[0]);
    CHECK(std::abs(gap) < 1e-12);
    check_same_but_for_motion(*s, *auxiliary(p, 0));
  }
}
