#include <doctest/doctest.h>

#include "../support/plate_laws.hpp"
#include "base/error.hpp"

using namespace dotyk;
using plate::Plate;
using plate::Solution;
namespace laws = dotyk::problem::laws;
using test::kElements;
using test::kFree;
using test::kHeld;
using test::LawChoice;

namespace {

const std::vector<LawChoice> kSideLaws{{&laws::prescribed},         {&laws::prescribed, 0.02}, {&laws::elastic, 4},          {&laws::one_sided_elastic, 4},   {&laws::signorini},
                                    {&laws::friction, 0.45},     {&laws::one_sided_friction, 0.45}, {&laws::capped_elastic, 4, 0.35}, {&laws::unequal_elastic, 4, 1}};

/// What supports do to the plate: upwards, and about the lines y = 0 and x = 0 as work on x and y.
Eigen::Vector3d supported(const Solution& s) {
  const std::map<std::string, Eigen::Vector2d> normals{{"left", {-1, 0}}, {"right", {1, 0}}, {"bottom", {0, -1}}, {"top", {0, 1}}};
  Eigen::Vector3d sum(0, 0, 0);
  for (std::size_t e = 0; e < s.plate().edges.size(); ++e)
    for (const auto& piece : plate::reaction(s, static_cast<int>(e)).pieces)
      for (std::size_t i = 0; i < piece.size(); ++i) {
        if (i > 0 && piece[i].vertex == piece[0].vertex) continue;
        const auto& p = piece[i];
        const auto n = normals.find(s.plate().edges[e].part);
        sum += p.force * Eigen::Vector3d(1, p.x, p.y);
        if (n != normals.end()) sum.tail<2>() += p.moment * n->second;
      }
  for (std::size_t k = 0; k < s.plate().supports.size(); ++k) {
    const auto& at = s.plate().supports[k];
    sum += plate::point_reaction(s, static_cast<int>(k)) * Eigen::Vector3d(1, at.x, at.y);
  }
  for (std::size_t n = 0; n < s.model().obstacle_row.size(); ++n)
    if (s.model().obstacle_row[n] >= 0)
      sum += s.result().state.lambda[s.model().obstacle_row[n]] * Eigen::Vector3d(1, s.plate().mesh->node(static_cast<int>(n))[0], s.plate().mesh->node(static_cast<int>(n))[1]);
  return sum;
}

/// Rounding beside the load's 1.
constexpr double kTight = 1e-9;

/// A different law on each side, chosen by numbers; −∫f = 1.
Plate mixed(plate::Element element, int n) {
  Plate p = test::plate_on(test::rough(6), element);
  p.f_of = [](double x, double y) { return -0.5 - x * y * 2; };
  const char* parts[] = {"left", "right", "bottom", "top"};
  for (int side = 0; side < 4; ++side) {
    const LawChoice& deflection = kSideLaws[(n + 2 * side) % kSideLaws.size()];
    const LawChoice& rotation = kSideLaws[(n / 3 + 4 * side) % kSideLaws.size()];
    test::support(p, parts[side], deflection, n % 2 == 0 || rotation.is(laws::prescribed) ? kFree : rotation);
  }
  p.supports = {{0.52, 0.47, {&laws::one_sided_elastic, 3}}, {0.2, 0.9, {&laws::friction, 0.05}}};
  return p;
}

}  // namespace

TEST_CASE("forces of all supports bear the load, with Morley's element moments, too; laws hold everywhere, residuals are rounding") {
  // With HCT an edge's forces are means about the vertices, told at these: their moments are right to the order h alone.
  int solved = 0;
  for (const plate::Element element : kElements)
    for (int n = 0; n < 54; ++n) {
      CAPTURE(std::string(plate::element_name(element)));
      CAPTURE(n);
      std::shared_ptr<const Solution> s;
      try {
        s = test::solved(mixed(element, n));
      } catch (const InputError& error) {
        CHECK(std::string(error.what()).find("contradictory") != std::string::npos);  // two values prescribed at a corner
        continue;
      }
      ++solved;
      REQUIRE(s->result().converged);
      const Eigen::Vector3d sum = supported(*s);
      CHECK(std::abs(sum[0] - 1) < kTight);
      if (element == plate::Element::morley) {
        CHECK(std::abs(sum[1] - (0.25 + 1. / 3)) < kTight);
        CHECK(std::abs(sum[2] - (0.25 + 1. / 3)) < kTight);
      }
      CHECK(s->residual().equilibrium < 1e-10);
      CHECK(s->residual().penetration < kTight);
      CHECK(s->residual().complementarity < kTight);
      CHECK(s->residual().law < kTight);
    }
  CHECK(solved > 60);
}

TEST_CASE("Signorini's edge: λ ≥ 0 ≥ x, and one of them 0, in every row") {
  for (const plate::Element element : kElements)
    for (const bool round : {true, false}) {
      Plate p = test::plate_on(round ? test::disc(test::Family::p1, 10) : test::rough(12), element);
      p.f_of = [round](double x, double y) { return -1 + (round ? 6 : 2) * x * y; };
      test::support(p, "", {&laws::signorini}, kFree);
      const auto s = test::solved(p);
      REQUIRE(s->result().converged);
      const algebra::Vector& lambda = s->result().state.lambda;
      const algebra::Vector x = s->model().problem.B * s->result().state.u.here() - s->model().problem.c;
      CHECK(lambda.minCoeff() >= 0);
      CHECK(x.maxCoeff() < 1e-12);
      for (int r = 0; r < x.size(); ++r) CHECK(std::min(lambda[r], -x[r]) < 1e-12);
      CHECK((lambda.array() == 0).any());  // it lifts somewhere
      CHECK((lambda.array() > 0).any());
      const auto whole = plate::reaction(*s, 0);
      CHECK(whole.open > 0);
      CHECK(whole.open < whole.length);
    }
}

TEST_CASE("moments of held edges: half of the load's moment at each clamped end, whatever the other sides do") {
  // ν = 0 and a strip clamped at both ends: qL²/12 per width, taken up at the ends' vertices and middles.
  for (const plate::Element element : kElements) {
    Plate p = test::plate_on(test::rough(16), element, -1);
    p.nu = 0;
    test::support(p, "left", kHeld, kHeld);
    test::support(p, "right", kHeld, kHeld);
    const auto s = test::solved(p);
    for (const int end : {0, 1}) {
      const auto r = plate::reaction(*s, end);
      double moment = 0;
      for (const auto& point : r.pieces.front()) moment += point.moment;
      CHECK(r.force == doctest::Approx(0.5).epsilon(1e-3));
      CHECK(moment == doctest::Approx(-1. / 12).epsilon(0.02));  // a plate that sags would rise outwards
    }
  }
}

TEST_CASE("corners where two parts meet") {
  for (const plate::Element element : kElements) {
    const auto corner = [&](LawChoice bottom, LawChoice right) {
      Plate p = test::plate_on(test::rough(6), element, -1);
      test::support(p, "left", kHeld, kHeld);
      test::support(p, "bottom", bottom, kFree);
      test::support(p, "right", right, kFree);
      return test::solved(p);
    };
    // Prescribed outweighs all others.
    for (const LawChoice& law : kSideLaws) {
      if (law.is(laws::prescribed) && law.numbers[0] != 0) continue;
      const auto a = corner(kHeld, law), b = corner(law, kHeld);
      CHECK(std::abs(a->deflection(1, 0)) < 1e-15);
      CHECK(std::abs(b->deflection(1, 0)) < 1e-15);
      CHECK(a->result().converged);
    }
    // Signorini's outweighs friction: an upward load lifts the corner.
    Plate p = test::plate_on(test::rough(6), element, 3);
    test::support(p, "left", kHeld, kHeld);
    test::support(p, "bottom", {&laws::signorini}, kFree);
    test::support(p, "right", {&laws::friction, 1e-3}, kFree);
    CHECK(test::solved(p)->deflection(1, 0) > 0.01);
    p.f = -3;
    CHECK(std::abs(test::solved(p)->deflection(1, 0)) < (element == plate::Element::morley ? 1e-12 : 1e-3));
  }
  // Morley: springs of two parts act together at their corner, as those of one.
  for (const LawChoice& law : kSideLaws) {
    Plate one = test::plate_on(test::rough(6), plate::Element::morley, -1), four = one;
    test::support(one, "", law, kFree);
    for (const char* part : {"left", "right", "bottom", "top"}) test::support(four, part, law, kFree);
    std::shared_ptr<const Solution> a, b;
    try {
      a = test::solved(one);
    } catch (const InputError&) {
      CHECK_THROWS_AS(test::solved(four), InputError);
      continue;
    }
    b = test::solved(four);
    CHECK((a->freedoms() - b->freedoms()).norm() < 1e-9 * a->freedoms().norm());
  }
}

TEST_CASE("loads that vary along an edge are told as they act: with what holds the plate they balance") {
  for (const plate::Element element : kElements)
    for (const int n : {4, 8}) {
      Plate p = test::plate_on(test::rough(n), element);
      test::support(p, "bottom", {&laws::prescribed}, {&laws::prescribed});
      test::support(p, "top", kFree, kFree);
      p.edges.back().deflection = [](double x, double) { return LawChoice{&laws::load, -std::pow(x, 4)}; };
      const auto s = test::solved(p);
      double top = 0;
      for (const auto& piece : plate::reaction(*s, 1).pieces)
        for (const auto& at : piece) top += at.force;
      CHECK(top == doctest::Approx(-0.2).epsilon(n == 4 ? 1e-6 : 1e-8));  // ∫x⁴; Gauss's rule of three points is exact to x⁵
      CHECK(std::abs(supported(*s)[0]) < kTight);
    }
}
