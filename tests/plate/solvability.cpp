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

constexpr double kOffs[] = {1e-8, 1e-6, 1e-3, 0.5};

/// P5's plates: an edge of length 4 that cannot rotate, this law for its deflection; two forces of about `size` with this resultant.
Plate guided(plate::Element element, LawChoice deflection, double resultant, double size) {
  Plate p = test::plate_on(test::rough(8), element);
  test::support(p, "", deflection, kHeld);
  p.point_loads = {{0.3, 0.4, -size}, {0.71, 0.6, size + resultant}};
  return p;
}

/// Empty where it is solved, else why not.
std::string refused(const Plate& p) {
  try {
    const auto s = test::solved(p);
    CHECK_MESSAGE(s->result().converged, s->result().reason);
    CHECK(test::off_laws(*s) < 1e-6);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

#define CHECK_SAYS(text, part) CHECK_MESSAGE((text).find(part) != std::string::npos, text)

}  // namespace

TEST_CASE("P5 (44), (45): one-sided edges that cannot rotate bear loads that press; and (73), (74) elastic ones") {
  for (const plate::Element element : kElements)
    for (const LawChoice law : {LawChoice{&laws::signorini}, LawChoice{&laws::one_sided_elastic, 5}, LawChoice{&laws::unequal_elastic, 5, 0}, LawChoice{&laws::one_sided_friction, 10}})
      for (const double size : {1e-3, 1.0, 1e4})
        for (const double off : kOffs) {
          CAPTURE(problem::describe(law));
          CAPTURE(size);
          CAPTURE(off);
          if (law.is(laws::one_sided_friction) && size > 1) continue;  // beyond its bound
          CHECK(refused(guided(element, law, -off * size, size)) == "");
          const std::string why = refused(guided(element, law, off * size, size));
          CHECK_SAYS(why, "no solution: nothing stops the motion of the whole plate upwards");
          CHECK_SAYS(why, law.is(laws::signorini) ? "P5 (45)" : law.is(laws::one_sided_friction) ? "P5 (63)" : "P5 (74)");
        }
}

TEST_CASE("P5 (62), (63): an edge with friction that cannot rotate bears resultants up to its whole bound, either way") {
  for (const plate::Element element : kElements)
    for (const double sign : {-1.0, 1.0})
      for (const double bound : {1e-3, 1.0, 1e4})
        for (const problem::LawSpec* kind : {&laws::friction, &laws::capped_elastic})
          for (const double off : kOffs) {
            const LawChoice law = kind == &laws::friction ? LawChoice{kind, bound} : LawChoice{kind, 20, bound};
            Plate p = test::plate_on(test::rough(8), element, sign * 4 * bound * (1 - off));
            test::support(p, "", law, kHeld);
            CHECK(refused(p) == "");
            p.f = sign * 4 * bound * (1 + off);
            const std::string why = refused(p);
            CHECK_SAYS(why, sign > 0 ? "the whole plate upwards" : "the whole plate downwards");
            CHECK_SAYS(why, "P5 (63)");
          }
}

TEST_CASE("P5 (33): a free plate wants a load without resultant and without moments") {
  for (const plate::Element element : kElements)
    for (const double off : {0.0, 1e-8, 1e-3}) {
      Plate p = test::plate_on(test::rough(8), element);
      p.point_loads = {{0.2, 0.2, 1}, {0.8, 0.2, -1}, {0.8, 0.8, 1}, {0.2, 0.8, -1}};
      if (off == 0) {
        CHECK(refused(p) == "");
        continue;
      }
      p.point_loads[0].force += off;
      CHECK_SAYS(refused(p), "P5 (33)");
      p.point_loads[0].force -= off;
      p.point_loads[1].x += off;  // a moment about y
      CHECK_SAYS(refused(p), "P5 (33)");
    }
}

TEST_CASE("three point supports bear forces within their triangle, not outside of it") {
  for (const plate::Element element : kElements)
    for (const double off : kOffs) {
      if (off > 0.1) continue;
      Plate p = test::plate_on(test::rough(8), element);
      for (const auto& [x, y] : {std::pair(0.1, 0.1), {0.9, 0.1}, {0.1, 0.9}}) p.supports.push_back({x, y, {&laws::signorini}});
      p.point_loads = {{0.5 - off, 0.5, -1}};  // the far side is x + y = 1
      CHECK(refused(p) == "");
      p.point_loads = {{0.5 + off, 0.5, -1}};
      CHECK_SAYS(refused(p), "no solution");
      p.point_loads = {{0.3, 0.1 + off, -1}};
      CHECK(refused(p) == "");
      p.point_loads = {{0.3, 0.1 - off, -1}};
      CHECK_SAYS(refused(p), "no solution");
    }
}

TEST_CASE("an edge held in its deflection that turns with friction: the moment about it against the bound") {
  for (const plate::Element element : kElements)
    for (const double off : kOffs) {
      Plate p = test::plate_on(test::rough(8), element, -1);
      test::support(p, "left", kHeld, {&laws::friction, 0.5 * (1 + off)});
      CHECK(refused(p) == "");
      p.edges.clear();
      test::support(p, "left", kHeld, {&laws::friction, 0.5 * (1 - off)});
      CHECK_SAYS(refused(p), "no solution");
    }
}
