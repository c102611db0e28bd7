// Pictures of beams and of laws: what is drawn is what was solved, and nothing is cut off or written over.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../support/plain_laws.hpp"
#include "base/monitor.hpp"
#include "beam/solve.hpp"
#include "figure/compose/compose_beam.hpp"
#include "pixels.hpp"

using namespace dotyk;
using namespace dotyk::figure;
using problem::LawChoice;
namespace laws = dotyk::problem::laws;
using test::kFree;
using test::kHeld;

namespace {

const std::vector<LawChoice> kLaws{{&laws::free, 0, 0}, {&laws::prescribed, -0.02, 0}, {&laws::load, 0.1, 0}, {&laws::elastic, 5, 0},
                                   {&laws::one_sided_elastic, 5, 0}, {&laws::signorini, 0, 0}, {&laws::friction, 0.2, 0},
                                   {&laws::one_sided_friction, 0.2, 0}, {&laws::capped_elastic, 5, 0.1}, {&laws::breaking, 5, 0.2},
                                   {&laws::unequal_elastic, 5, 2}};

beam::Beam beam_of(const LawChoice& deflection, const LawChoice& rotation) {
  beam::Beam b;
  b.cells = 8;
  const bool pinned = !rotation.is(laws::free);
  b.supports = {{"left", 0, kHeld, pinned ? kFree : kHeld}, {"right", 1, pinned ? kHeld : deflection, rotation}};
  return b;
}

std::vector<beam::Branch> solutions(const beam::Beam& b) {
  Monitor quiet;
  return beam::solve(b, {}, quiet);
}

double distance(const std::array<double, 2>& p, const PageCurve& c, double x_scale, double y_scale) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < c.x.size(); ++i) {
    const double ax = c.x[i] / x_scale, ay = c.y[i] / y_scale, dx = c.x[i + 1] / x_scale - ax, dy = c.y[i + 1] / y_scale - ay;
    const double px = p[0] / x_scale - ax, py = p[1] / y_scale - ay, square = dx * dx + dy * dy;
    const double t = square > 0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0;
    least = std::min(least, std::hypot(px - t * dx, py - t * dy));
  }
  return least;
}

void check_working_point(const PagePicture& page) {
  const auto& reaction = std::get<CurveDrawing>(page.rows[0][0].drawing);
  REQUIRE(reaction.point);
  const auto [x_low, x_high] = *reaction.x_range;
  const auto [y_low, y_high] = *reaction.y_range;
  double least = std::numeric_limits<double>::infinity();
  for (const PageCurve& c : reaction.curves)
    if (!c.dashed) least = std::min(least, distance(*reaction.point, c, x_high - x_low, y_high - y_low));
  CHECK(least <= 1e-9);
  CHECK(((*reaction.point)[0] >= x_low && (*reaction.point)[0] <= x_high));
  CHECK(((*reaction.point)[1] >= y_low && (*reaction.point)[1] <= y_high));
}

const PageCurve& diagram(const PagePicture& page, std::size_t row) { return std::get<CurveDrawing>(page.rows[row][0].drawing).curves[0]; }

constexpr Colour frame_ink{30, 30, 30};

}  // namespace

TEST_CASE("the working point of every law lies on its graph") {
  for (const LawChoice& law : kLaws)
    for (const double q : {-1.0, 1.0, -0.2})
      for (const LawSide of : {LawSide::deflection, LawSide::rotation}) {
        beam::Beam b = of == LawSide::deflection ? beam_of(law, kFree) : beam_of(kFree, law);
        b.q = q;
        CAPTURE(law.spec->words);
        CAPTURE(q);
        for (const beam::Branch& branch : solutions(b)) check_working_point(compose(view(*branch.solution), 1, of, {}));
      }
}

TEST_CASE("diagrams begin and end at zero, and jump by what acts at a point") {
  beam::Beam b;
  b.length = 4, b.q = -0.3;
  b.supports = {{"left", 0, kHeld, kHeld}, {"x = 2", 2, kHeld, {&laws::elastic, 3, 0}}, {"right", 4, {&laws::elastic, 5, 0}, kFree}};
  b.loads = {{1.234, -2, 0}, {3.1, 0, 0.7}};
  const auto s = solutions(b)[0].solution;
  const PagePicture page = compose(view(*s), {BeamPanel::moment, BeamPanel::shear}, {});
  REQUIRE(page.rows.size() == 2);
  const beam::Reaction middle = s->reaction(1);
  const std::vector<std::array<double, 3>> points{{1.234, 0, 2}, {3.1, 0.7, 0}, {2, middle.moment, -middle.force}};  // x, jumps of M and T
  for (const std::size_t row : {0u, 1u}) {
    const PageCurve& c = diagram(page, row);
    CHECK(c.x.front() == 0);
    CHECK(c.y.front() == 0);
    CHECK(c.x.back() == 4);
    CHECK(c.y.back() == 0);
    for (std::size_t i = 1; i + 2 < c.x.size(); ++i) {
      if (c.x[i] == 0 || c.x[i] == 4) continue;
      const double step = c.x[i + 1] == c.x[i] ? c.y[i + 1] - c.y[i] : 0;
      double jump = 0;
      for (const auto& p : points)
        if (p[0] == c.x[i] && c.x[i + 1] == c.x[i]) jump = p[row + 1];
      CHECK(step == doctest::Approx(jump).epsilon(1e-9).scale(1));
      const bool last = c.x[i + 1] != c.x[i];
      if (last) CHECK(c.y[i] == (row == 0 ? s->moment(c.x[i]) : s->shear(c.x[i])));
    }
  }
  for (const auto& p : points)
    if (p[2] != 0) CHECK(std::count(diagram(page, 1).x.begin(), diagram(page, 1).x.end(), p[0]) == 2);
}

TEST_CASE("what rounding leaves of a diagram that vanishes is not drawn") {
  beam::Beam b;
  b.supports = {{"left", 0, kHeld, kFree}, {"right", 1, {&laws::prescribed, 0.3, 0}, kFree}};
  const PagePicture page = compose(view(*solutions(b)[0].solution), {BeamPanel::moment, BeamPanel::shear}, {});
  for (const std::size_t row : {0u, 1u})
    for (const double y : diagram(page, row).y) CHECK(y == 0);
}

TEST_CASE("states of supports") {
  const auto state = [](const LawChoice& law, double q) {
    beam::Beam b = beam_of(law, kFree);
    b.q = q;
    return std::get<BeamDrawing>(compose(view(*solutions(b)[0].solution), {BeamPanel::deflection}, {}).rows[0][0].drawing).supports[1].below.state;
  };
  CHECK(state({&laws::signorini, 0, 0}, -1) == SupportState::pushing);
  CHECK(state({&laws::signorini, 0, 0}, 1) == SupportState::open);
  CHECK(state({&laws::one_sided_elastic, 5, 0}, -1) == SupportState::pushing);
  CHECK(state({&laws::one_sided_elastic, 5, 0}, 1) == SupportState::open);
  CHECK(state({&laws::friction, 1, 0}, -1) == SupportState::stick);  // 3qL/8 < 1
  CHECK(state({&laws::friction, 0.2, 0}, 1) == SupportState::slip);
  CHECK(state({&laws::one_sided_friction, 1, 0}, -1) == SupportState::stick);
  CHECK(state({&laws::one_sided_friction, 0.2, 0}, -1) == SupportState::slip);
  CHECK(state({&laws::one_sided_friction, 0.2, 0}, 1) == SupportState::open);
  CHECK(state({&laws::capped_elastic, 5, 0.1}, -1) == SupportState::slip);
  CHECK(state({&laws::capped_elastic, 5, 1}, -1) == SupportState::acting);
  CHECK(state({&laws::unequal_elastic, 5, 2}, -1) == SupportState::pushing);
  CHECK(state({&laws::unequal_elastic, 5, 2}, 1) == SupportState::pulling);
  CHECK(state({&laws::unequal_elastic, 5, 0}, 1) == SupportState::open);
  CHECK(state({&laws::unequal_elastic, 5, 2}, 0) == SupportState::acting);
  CHECK(state({&laws::breaking, 50, 0.01}, -1) == SupportState::broken);
  CHECK(state({&laws::breaking, 5, 1}, -1) == SupportState::pushing);
}

TEST_CASE("symbols of every law stand whole within the frame") {
  for (const LawChoice& law : kLaws)
    for (const bool rotation : {false, true})
      for (const double q : {-1.0, 0.8}) {
        beam::Beam b = rotation ? beam_of(kFree, law) : beam_of(law, kFree);
        std::swap(b.supports[0].deflection, b.supports[1].deflection);
        std::swap(b.supports[0].rotation, b.supports[1].rotation);
        for (const bool turned : {false, true}) {
          if (turned) std::swap(b.supports[0].deflection, b.supports[1].deflection), std::swap(b.supports[0].rotation, b.supports[1].rotation);
          b.q = q;
          const auto s = solutions(b)[0].solution;
          PagePicture page = compose(view(*s), {BeamPanel::deflection}, {});
          page.file = "symbol.png", page.width = 640, page.height = 300, page.printed = 145;
          draw(page);
          const Pixels p = read_png("symbol.png");
          CHECK(white_rim(p));
          // The frame: the longest dark row from below, and its columns.
          int bottom = p.height - 1, left = 0, right = p.width - 1;
          const auto dark = [&](int y) {
            int n = 0;
            for (int x = 0; x < p.width; ++x) n += near(p.at(x, y), frame_ink, 12);
            return n;
          };
          while (bottom > 0 && dark(bottom) < p.width / 2) --bottom;
          while (left < p.width && !near(p.at(left, bottom), frame_ink, 12)) ++left;
          while (right > 0 && !near(p.at(right, bottom), frame_ink, 12)) --right;
          REQUIRE(bottom > p.height / 2);
          const SupportElement& e = [&]() -> const SupportElement& {
            const auto& supports = std::get<BeamDrawing>(page.rows[0][0].drawing).supports;
            const BeamSupport& at = supports[turned ? 1 : 0];
            return rotation ? at.arc : at.below;
          }();
          if (e.kind == ElementKind::none) continue;
          const Colour colour = state_colour(e.state);
          CAPTURE(law.spec->words);
          CAPTURE(rotation);
          CAPTURE(turned);
          int seen = 0, at_rim = 0;
          for (int y = 0; y <= bottom; ++y)
            for (int x = left; x <= right; ++x) {
              if (!near(p.at(x, y), colour, 12)) continue;
              ++seen;
              at_rim += x < left + 4 || x > right - 4 || y > bottom - 4;
            }
          CHECK(seen > 30);
          if (e.state != SupportState::acting) CHECK(at_rim == 0);  // grey is also that of ticks
        }
      }
}

TEST_CASE("values of loads side by side are not written over each other") {
  const Colour ink{0, 70, 110};
  const auto count = [&](const std::vector<BeamLoad>& loads) {
    BeamDrawing beam;
    for (int i = 0; i <= 100; ++i) beam.x.push_back(0.01 * i), beam.deflection.push_back(i % 100 ? -0.01 : 0);
    beam.loads = loads;
    beam.loads.push_back({0.1, -1, 0});  // the same scale of arrows
    PagePicture page;
    page.file = "loads.png", page.width = 900, page.height = 400;
    PageCell cell;
    cell.drawing = beam;
    page.rows = {{cell}};
    page.column_weights = page.row_weights = {1};
    draw(page);
    return read_png("loads.png").count(ink, 30);
  };
  const int none = count({}), a = count({{0.5, -0.25, 0}}) - none, b = count({{0.53, -0.75, 0}}) - none, both = count({{0.5, -0.25, 0}, {0.53, -0.75, 0}}) - none;
  CHECK(a > 100);
  CHECK(both >= 0.97 * (a + b));  // arrows stand at other fractions of a pixel
}

TEST_CASE("beams of any size, without load, and at small sizes of the picture are drawn") {
  for (const double length : {1e-3, 1.0, 1e3})
    for (const double EJ : {1e-6, 1.0, 1e6})
      for (const double q : {0.0, -1e-3, 5e6}) {
        beam::Beam b = beam_of({&laws::elastic, 1, 0}, kFree);
        b.length = b.supports[1].x = length, b.EJ = EJ, b.q = q;
        PagePicture page = compose(view(*solutions(b)[0].solution), {BeamPanel::deflection, BeamPanel::moment, BeamPanel::shear}, {"m", "N"});
        page.file = "sizes.png", page.width = 400, page.height = 360;
        CHECK(message_of([&] { draw(page); }) == "");
        CHECK(white_rim(read_png("sizes.png")));
      }
  for (const LawChoice& law : kLaws)
    for (const LawSide of : {LawSide::deflection, LawSide::rotation}) {
      PagePicture page = compose(law, of, {});
      page.file = "law.png";
      page.width = 400, page.height = 200;
      CHECK(message_of([&] { draw(page); }) == "");
      CHECK(white_rim(read_png("law.png")));
    }
}

TEST_CASE("pages that cannot be drawn are refused") {
  PagePicture page = compose({&laws::elastic, 1, 0}, LawSide::deflection, {});
  page.file = "page.png";
  page.rows.push_back({});
  CHECK(message_of([&] { draw(page); }).find("a weight of each") != std::string::npos);
  page.rows.pop_back();
  std::get<CurveDrawing>(page.rows[0][0].drawing).curves[0].y[0] = NAN;
  CHECK(message_of([&] { draw(page); }).find("finite") != std::string::npos);
}

TEST_CASE("without a load the beam is straight") {
  beam::Beam b = beam_of(kHeld, kFree);
  b.q = 0;
  PagePicture page = compose(view(*solutions(b)[0].solution), {BeamPanel::deflection, BeamPanel::moment}, {});
  page.file = "straight.png";
  page.width = 800, page.height = 600;
  draw(page);
  const Pixels p = read_png("straight.png");
  int rows = 0;
  for (int y = 60; y < p.height / 2; ++y) {  // below the frame's upper line
    int n = 0;
    for (int x = 0; x < p.width; ++x) n += near(p.at(x, y), frame_ink, 12);
    rows += n > p.width / 2;
  }
  CHECK(rows >= 2);
}
