#include <doctest/doctest.h>

#include "../support/plate_laws.hpp"
#include "base/error.hpp"
#include "beam/solve.hpp"

using namespace dotyk;
using plate::Plate;
namespace laws = dotyk::problem::laws;
using test::kD;
using test::LawChoice;

// With ν = 0 and nothing on its long sides a plate that is loaded and held alike across its width is a beam with EJ = D for each unit of it, with the same
// laws, but that a rotation is about the outward slope: −u' at the left end.

namespace {

constexpr double kLength = 2, kWidth = 0.8;

const std::vector<LawChoice> kLaws{{&laws::free},           {&laws::prescribed, 0.05},         {&laws::load, -0.3},
                                    {&laws::elastic, 4},     {&laws::one_sided_elastic, 4},     {&laws::signorini},
                                    {&laws::friction, 0.45}, {&laws::one_sided_friction, 0.45}, {&laws::capped_elastic, 4, 0.35},
                                    {&laws::unequal_elastic, 4, 1}};

struct Ends {
  LawChoice left_deflection, left_rotation, right_deflection, right_rotation;
};

/// A law about −v in place of v.
LawChoice turned(LawChoice law) {
  if (law.is(laws::prescribed) || law.is(laws::load)) law.numbers[0] = -law.numbers[0];
  return law;
}

Plate strip(plate::Element element, int cells, const Ends& ends) {
  test::Mesh m = test::rectangle(test::Family::p1, cells, cells / 2);
  test::distort(m, 0.05);
  mesh::transform(m, [](const test::Point& x) { return test::Point{kLength * x[0], kWidth * x[1], 0}; });
  Plate p = test::plate_on(std::move(m), element);
  p.D = kD, p.nu = 0;
  test::support(p, "left", ends.left_deflection, ends.left_rotation);
  test::support(p, "right", ends.right_deflection, ends.right_rotation);
  return p;
}

/// Where the law of the left end's rotation does not tell the sides apart: the beam's are about u' at either end.
beam::Beam beam_like(const Ends& e) {
  beam::Beam b;
  b.length = kLength;
  b.EJ = kD;
  b.cells = 2;  // exact at nodes with any number, and here everywhere: no load but at the ends
  b.supports = {{"left", 0, e.left_deflection, turned(e.left_rotation)}, {"right", kLength, e.right_deflection, e.right_rotation}};
  return b;
}

template <class Solve>
auto tried(const Solve& solve) -> decltype(solve()) {
  try {
    return solve();
  } catch (const InputError&) {
    return nullptr;
  }
}

struct Counted {
  int compared = 0, refused = 0, not_unique = 0;
};

void compare(plate::Element element, const Ends& ends, Counted& counted) {
  Monitor quiet;
  const auto b = tried([&] { return beam::solve(beam_like(ends), {}, quiet).front().solution; });
  const auto s = tried([&] { return test::solved(strip(element, 4, ends)); });
  CAPTURE(problem::describe(ends.left_deflection));
  CAPTURE(problem::describe(ends.left_rotation));
  CAPTURE(problem::describe(ends.right_deflection));
  CAPTURE(problem::describe(ends.right_rotation));
  REQUIRE((s == nullptr) == (b == nullptr));
  if (!s) {
    ++counted.refused;
    return;
  }
  CAPTURE(s->result().reason);
  CHECK(s->result().converged);
  CHECK(test::off_laws(*s) < 1e-8);
  if (b->result().reason.find("unique up to") != std::string::npos || s->result().reason.find("unique up to") != std::string::npos) {
    ++counted.not_unique;
    return;
  }
  ++counted.compared;
  for (const double x : {0.0, 0.3, 1.1, kLength})
    for (const double y : {0.0, 0.33, kWidth}) {
      CHECK(std::abs(s->deflection(x, y) - b->deflection(x)) < 1e-9);
      CHECK(std::abs(s->slope(x, y)[0] - b->rotation(x)) < 1e-9);
      CHECK(std::abs(s->slope(x, y)[1]) < 1e-9);
    }
  for (const int end : {0, 1}) {
    const auto bearing = b->reaction(end);
    const auto r = plate::reaction(*s, end);
    CHECK(std::abs(r.force / kWidth - bearing.force) < 1e-9);
    double moment = 0;
    for (const auto& point : r.pieces.front()) moment += point.moment;
    CHECK(std::abs(moment / kWidth - (end == 0 ? -1 : 1) * bearing.moment) < 1e-9);
  }
}

}  // namespace

TEST_CASE("strips with laws at both ends are beams: HCT has their cubics exactly") {
  Counted counted;
  for (const LawChoice& left_deflection : kLaws)
    for (const LawChoice& left_rotation : kLaws) {
      if (left_rotation->directed()) continue;  // turned about, below
      for (const LawChoice& right_deflection : {LawChoice{&laws::load, -0.4}, LawChoice{&laws::load, 0.4}, LawChoice{&laws::prescribed, 0.03}, LawChoice{&laws::elastic, 2}})
        for (const LawChoice& right_rotation : {LawChoice{&laws::free}, LawChoice{&laws::load, 0.5}, LawChoice{&laws::load, -0.5}})
          compare(plate::Element::hct, {left_deflection, left_rotation, right_deflection, right_rotation}, counted);
    }
  for (const LawChoice& right_rotation : kLaws)
    for (const LawChoice& left_deflection : kLaws)
      for (const double force : {-0.4, 0.4})
        for (const double moment : {-0.6, 0.6})
          compare(plate::Element::hct, {left_deflection, {&laws::load, moment}, {&laws::load, force}, right_rotation}, counted);
  CHECK(counted.compared > 450);
  CHECK(counted.refused > 100);
  CHECK(counted.not_unique < 50);
}

TEST_CASE("a strip turned end for end is the same") {
  for (const LawChoice& deflection : kLaws)
    for (const LawChoice& rotation : kLaws)
      for (const double force : {-0.4, 0.4})
        for (const double moment : {-0.6, 0.6}) {
          const LawChoice f{&laws::load, force}, m{&laws::load, moment};
          const auto a = tried([&] { return test::solved(strip(plate::Element::hct, 4, {deflection, rotation, f, m})); });
          const auto b = tried([&] { return test::solved(strip(plate::Element::hct, 4, {f, m, deflection, rotation})); });
          REQUIRE((a == nullptr) == (b == nullptr));
          if (!a || a->result().reason.find("unique up to") != std::string::npos) continue;
          for (const double x : {0.0, 0.3, 1.1, kLength}) CHECK(std::abs(a->deflection(x, 0.2) - b->deflection(kLength - x, 0.2)) < 1e-9);
        }
}

TEST_CASE("strips under a load along them tend to beams with h²") {
  // Clamped at the left end, every pair of laws at the right one.
  for (const plate::Element element : test::kElements)
    for (const LawChoice& deflection : kLaws)
      for (const LawChoice& rotation : kLaws) {
        const Ends ends{test::kHeld, test::kHeld, deflection, rotation};
        CAPTURE(std::string(plate::element_name(element)));
        CAPTURE(problem::describe(deflection));
        CAPTURE(problem::describe(rotation));
        Monitor quiet;
        beam::Beam exact = beam_like(ends);
        exact.q = -1;
        exact.cells = 40;  // nodes at all points below
        const auto b = beam::solve(exact, {}, quiet).front().solution;
        double last = 0, now = 0;
        for (const int cells : {8, 16}) {
          Plate p = strip(element, cells, ends);
          p.f = -1;
          const auto s = test::solved(p);
          REQUIRE(s->result().converged);
          CHECK(test::off_laws(*s) < 1e-8);
          last = now;
          now = 0;
          for (const double x : {0.5, 1.0, 1.5, kLength})
            for (const double y : {0.0, 0.33, kWidth}) now = std::max(now, std::abs(s->deflection(x, y) - b->deflection(x)));
        }
        CHECK(now < (element == plate::Element::hct ? 1e-4 : 5e-3));
        CHECK(now < 0.35 * last);
      }
}
