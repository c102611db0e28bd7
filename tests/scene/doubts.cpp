#include "scene/solve/doubts.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../support/scenes.hpp"

using namespace dotyk;
using mesh::Family;
using mesh::Point;

namespace {

/// A quarter of a ring (in space of a pipe, a cell long), n cells around; "left" is its inside, "right" its outside.
std::shared_ptr<scene::Body> ring(const std::string& name, int dim, Family family, double from, double to, int n) {
  mesh::Mesh m = dim == 2 ? test::rectangle(family, 2, n) : test::box(family, 2, n, 1);
  mesh::transform(m, [&](const Point& x) {
    const double r = from + (to - from) * x[0], t = std::numbers::pi / 2 * x[1];
    return Point{r * std::cos(t), r * std::sin(t), x[2]};
  });
  return test::body(name, std::move(m));
}

std::vector<std::string> doubts_of_fit(int dim, Family family, int inside, int outside, double overlap) {
  const auto inner = ring("inner", dim, family, 0.5, 1 + overlap, inside), outer = ring("outer", dim, family, 1, 1.5, outside);
  const auto s = scene::make_scene({inner, outer});
  const auto contact = scene::add_contact(*s, test::part(inner, "right"), test::part(outer, "left"), {}, {}, overlap > 0);
  // Height of the greatest chord of radius 1.
  const int coarser = std::min(inside, outside);
  const bool chords = family == Family::p1 || family == Family::q1, face = inside == outside;
  double greatest = 0;
  for (const contact::ContactRow& row : contact->rows) greatest = std::max(greatest, row.chord);
  CHECK(greatest == doctest::Approx(chords && !face ? std::pow(std::numbers::pi / 2 / coarser, 2) / 8 : 0).epsilon(0.11));
  return scene::doubts(*s);
}

}  // namespace

TEST_CASE("chords of curved parts that do not match are doubtful beside the interference or the clearance") {
  for (const int dim : {2, 3})
    for (const Family family : test::kFamilies) {
      // 8 cells a quarter: height (π/16)²/8 = 0.0048.
      for (const double overlap : {1e-3, 0.0, -1e-3}) {
        const auto doubts = doubts_of_fit(dim, family, 8, 11, overlap);
        REQUIRE(doubts.size() == 1);
        CHECK(doubts[0].find("facets are chords up to 0.004") != std::string::npos);
        CHECK((doubts[0].find("the interference") != std::string::npos) == (overlap > 0));
      }
      CHECK(doubts_of_fit(dim, family, 8, 11, 0.1).size() == 1);  // 5 %
      CHECK(doubts_of_fit(dim, family, 32, 44, 0.1).empty());
      if (dim == 2) CHECK(doubts_of_fit(dim, family, 80, 110, 1e-3).size() == 1);
      for (const double overlap : {1e-3, 0.0, -1e-3}) CHECK(doubts_of_fit(dim, family, 8, 8, overlap).empty());
    }
  CHECK(doubts_of_fit(2, Family::p2, 8, 11, 1e-3).empty());
  CHECK(doubts_of_fit(2, Family::q2, 8, 11, 0).empty());
}

TEST_CASE("rings of all elements fit whatever their nodes, with a clearance as without") {
  for (const Family family : test::kAllFamilies)
    for (const auto& [inside, outside] : {std::pair{5, 7}, {7, 5}, {8, 11}})
      for (const double overlap : {0.0, -1e-3}) CHECK_NOTHROW(doubts_of_fit(2, family, inside, outside, overlap));
}

TEST_CASE("what presses decides: a hollow and a ball that differ little, lightly loaded, and pressed hard") {
  const auto cap = [](const std::string& name, int n, double k, bool up) {
    mesh::Mesh m = test::rectangle(Family::p1, n, 4, 0, up ? 0 : -4, 4, up ? 4 : 0);
    mesh::transform(m, [&](const Point& x) { return Point{x[0], x[1] + k * x[0] * x[0] * (1 - std::abs(x[1]) / 4), 0}; });
    auto body = test::body(name, std::move(m));
    test::slide(body, "left");
    return body;
  };
  std::size_t before = 9, light = 9, hard = 9;
  for (const double load : {0.01, 2.0}) {
    const auto socket = cap("socket", 28, 0.05, false), ball = cap("ball", 34, 0.06, true);
    test::fix(socket, "bottom");
    test::press(ball, "top", load);
    const auto s = scene::make_scene({socket, ball});
    scene::add_contact(*s, test::part(ball, "bottom"), test::part(socket, "top"), {}, {}, false);
    before = scene::doubts(*s).size();
    (load < 1 ? light : hard) = scene::doubts(*test::solve(s)).size();
  }
  CHECK(before == 0);
  CHECK(light == 1);
  CHECK(hard == 0);
}

TEST_CASE("pressed rings: what chords of nodes that do not match make of the pressure is said, and no less") {
  for (const auto& [inside, outside] : {std::pair{40, 27}, {60, 41}, {120, 83}, {120, 120}}) {
    const auto inner = ring("inner", 2, Family::q1, 0.5, 1.002, inside), outer = ring("outer", 2, Family::q1, 1, 1.5, outside);
    for (const auto& body : {inner, outer}) test::slide(body, "bottom"), test::slide(body, "top");
    const auto s = scene::make_scene({inner, outer});
    const auto contact = scene::add_contact(*s, test::part(inner, "right"), test::part(outer, "left"), {}, {}, true);
    const auto solution = test::solve(s);
    double least = INFINITY, most = 0;
    for (std::size_t i = 2; i + 2 < contact->rows.size(); ++i) {
      const double p = solution->result().state.lambda[solution->model().contact_row[0][i]] / solution->model().normal[0][i].measure;
      least = std::min(least, p), most = std::max(most, p);
    }
    const auto doubts = scene::doubts(*solution);
    CAPTURE(inside);
    REQUIRE(doubts.size() == (inside == outside ? 0 : 1));
    if (doubts.empty()) continue;
    const std::size_t at = doubts[0].find("uncertain by up to ");
    REQUIRE(at != std::string::npos);
    CHECK(most - least < std::stod(doubts[0].substr(at + 19)));
    CHECK(most - least > 0.1 * std::stod(doubts[0].substr(at + 19)));
  }
}

TEST_CASE("flat parts, and a curved one on a flat one, are not doubtful for their chords") {
  for (const int dim : {2, 3}) {
    const auto low = test::block("low", dim, Family::p1, 3), high = test::block("high", dim, Family::p1, 4, 1);
    const auto s = scene::make_scene({low, high});
    scene::add_contact(*s, test::part(high, "bottom"), test::part(low, "top"), {});
    CHECK(scene::doubts(*s).empty());
  }
  const auto wheel = ring("wheel", 2, Family::p1, 0.5, 1, 20);
  mesh::Mesh m = test::rectangle(Family::p1, 4, 7, 1, 0, 2, 1);
  const auto wall = test::body("wall", std::move(m));
  const auto s = scene::make_scene({wheel, wall});
  scene::add_contact(*s, test::part(wheel, "right"), test::part(wall, "left"), {});
  CHECK(scene::doubts(*s).empty());
}

TEST_CASE("the plan and a printed solution say what is doubtful") {
  const auto inner = ring("inner", 2, Family::p1, 0.5, 1.001, 8), outer = ring("outer", 2, Family::p1, 1, 1.5, 11);
  for (const auto& body : {inner, outer}) test::slide(body, "bottom"), test::slide(body, "top");
  const auto s = scene::make_scene({inner, outer});
  scene::add_contact(*s, test::part(inner, "right"), test::part(outer, "left"), {}, {}, true);
  CHECK(scene::plan(*s).find("\n  warning: contact of 'inner' right with 'outer' left: facets are chords") != std::string::npos);
  CHECK(scene::describe(*test::solve(s)).find("\n  warning: contact of 'inner' right") != std::string::npos);
}

namespace {

std::vector<std::string> doubts_of(const std::shared_ptr<scene::Body>& body) { return scene::doubts(*test::solve(scene::make_scene({body}))); }

bool says(const std::vector<std::string>& doubts, const std::string& what) {
  return std::ranges::any_of(doubts, [&](const std::string& one) { return one.find(what) != std::string::npos; });
}

}  // namespace

TEST_CASE("strains beyond small ones are doubtful, with body, per cent and place; rotations of bodies and of parts of them too") {
  for (const int dim : {2, 3})
    for (const Family family : test::kAllFamilies) {
      // A cord of 1, squeezed.
      for (const double by : {0.01, 0.9}) {
        const auto cord = test::block("cord", dim, family, 2);
        auto low = test::part(cord, "bottom"), high = test::part(cord, "top");
        scene::fix(low, {true, true, true});
        std::array<elasticity::ScalarField, 3> down;
        for (int i = 0; i < dim; ++i) down[i] = [=](const Point&) { return i == dim - 1 ? -by : 0.0; };
        scene::displace(high, down);
        const auto doubts = doubts_of(cord);
        CHECK(says(doubts, "'cord' is strained by") == (by > 0.5));
        if (by > 0.5) CHECK(says(doubts, "% and more (where half of its energy is), most at ("));
      }
    }
  // A strip that bends symmetrically turns at both ends, and as a whole not at all.
  for (const double load : {1e-4, 1e-3}) {
    const auto strip = test::body("strip", test::rectangle(Family::q2, 20, 1, 0, -0.05, 2, 0.05));
    test::slide(strip, "left");
    auto right = test::part(strip, "right");
    scene::fix(right, {false, true, false});
    test::press(strip, "top", load);
    CHECK(says(doubts_of(strip), "'strip' turns by") == (load > 5e-4));
  }
}

TEST_CASE("a strain that grows without bound at a corner, as cells get smaller, is no great strain of the body") {
  for (const int n : {4, 16, 64}) {
    const auto block = test::block("block", 2, Family::p1, n);
    test::fix(block, "bottom");
    auto top = test::part(block, "top");
    scene::displace(top, {[](const Point&) { return 0.01; }, [](const Point&) { return -0.01; }, {}});
    CHECK(doubts_of(block).empty());
  }
}
