// Plates: what carries, lifts and slides is seen where it does.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "figure/plate/plate_picture.hpp"
#include "pixels.hpp"

using namespace dotyk::figure;

namespace {

constexpr double pi = std::numbers::pi;

// n x n squares of the unit square, each cut in two.
PlatePicture square_plate(int n, const std::string& file) {
  PlatePicture p;
  p.file = file, p.width = 720, p.height = 540;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) p.points.insert(p.points.end(), {static_cast<double>(i) / n, static_cast<double>(j) / n});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      p.triangles.insert(p.triangles.end(), {a, a + 1, a + n + 2, a, a + n + 2, a + n + 1});
    }
  p.deflection.assign(p.points.size() / 2, 0);
  return p;
}

// What a load presses down in the middle lifts at the corners.
double lifted_corners(double x, double y) {
  const double s = 2 * x - 1, t = 2 * y - 1;
  return -0.01 * std::sin(pi * x) * std::sin(pi * y) + 0.004 * std::pow(s * t, 4) * (1 - 0.2 * (s * s + t * t));
}

using Along = std::function<EdgeSample(double x, double y)>;

// The sides of the square as n pieces each, anticlockwise.
void add_boundary(PlatePicture& p, int n, PlateSupport support, const Along& sample) {
  const double corner[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < n; ++k) {
      const auto at = [&](double t) {
        return std::array<double, 2>{corner[side][0] + t * (corner[side + 1][0] - corner[side][0]), corner[side][1] + t * (corner[side + 1][1] - corner[side][1])};
      };
      PlateEdge e{at(static_cast<double>(k) / n), at((k + 1.0) / n), support, false, {}};
      for (const double share : {0.0, 1.0}) {
        const auto q = at((k + share) / n);
        EdgeSample s = sample(q[0], q[1]);
        s.share = share;
        e.samples.push_back(s);
      }
      p.boundary.push_back(e);
    }
}

// Lifted over a fifth of each side at its ends, bearing between.
PlatePicture one_sided(int n, const std::string& file) {
  PlatePicture p = square_plate(n, file);
  for (std::size_t i = 0; i < p.deflection.size(); ++i) p.deflection[i] = lifted_corners(p.points[2 * i], p.points[2 * i + 1]);
  p.values = p.deflection;
  for (double& v : p.values) v *= 1000;
  p.field_label = "deflection", p.field_unit = "mm";
  p.deformation = 20;
  p.reaction_unit = "kN/m", p.force_unit = "kN";
  add_boundary(p, n, PlateSupport::one_sided, [](double x, double y) {
    const double s = std::abs(2 * x - 1) > std::abs(2 * y - 1) ? std::abs(2 * y - 1) : std::abs(2 * x - 1);
    EdgeSample out;
    out.deflection = lifted_corners(x, y);
    out.reaction = s < 0.6 ? 3.2 * (1 - s * s / 0.36) + 0.8 * s * s : 0;
    out.status = s < 0.6 ? Status::closed : Status::open;
    return out;
  });
  return p;
}

constexpr Colour push{45, 50, 90}, pull{0, 105, 78}, push_area{213, 220, 238}, pull_area{205, 234, 222};

Pixels drawn(const PlatePicture& p) {
  draw(p);
  return read_png(p.file);
}

// Reactions of this size along the whole boundary.
PlatePicture loaded(const Along& sample) {
  PlatePicture p = square_plate(4, "reactions.png");
  p.view = PlateView::plan;
  for (std::size_t i = 0; i < p.deflection.size(); ++i) p.values.push_back(p.points[2 * i]);  // colours unlike those of reactions
  add_boundary(p, 4, PlateSupport::held, sample);
  return p;
}

int distance(Colour a, Colour b) { return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b); }

}  // namespace

TEST_CASE("statuses along the edges are seen in both views") {
  PlatePicture p = one_sided(20, "plate.png");
  p.values.clear();
  for (const PlateView view : {PlateView::surface, PlateView::plan}) {
    p.view = view;
    const Pixels seen = drawn(p);
    CHECK(white_rim(seen));
    CHECK(seen.count(status_colour(Status::open)) > 200);
    CHECK(seen.count(status_colour(Status::closed)) > 200);
    CHECK(seen.count(status_colour(Status::stick)) == 0);
    CHECK(seen.count(status_colour(Status::slip)) == 0);
  }
}

TEST_CASE("an edge that has lifted shows the gap under it") {
  PlatePicture p = one_sided(20, "gap.png");
  p.values.clear();
  const Colour curtain{204, 232, 248};  // the colour of what is open, pale
  CHECK(drawn(p).count(curtain, 3) > 100);
  for (PlateEdge& e : p.boundary)
    for (EdgeSample& s : e.samples) s.deflection = 0, s.status = Status::closed;
  for (double& u : p.deflection) u = 0;
  CHECK(drawn(p).count(curtain, 3) == 0);
}

TEST_CASE("areas of reactions are as their integrals") {
  const auto along = [](double x, double y) { return x > 0 && x < 1 ? x : y; };
  const Pixels whole = drawn(loaded([](double, double) { return EdgeSample{0, 0, 2, {}}; }));
  const Pixels ramp = drawn(loaded([&](double x, double y) { return EdgeSample{0, 0, 2 * along(x, y), {}}; }));
  REQUIRE(whole.count(push_area, 8) > 5000);
  CHECK(whole.count(pull, 3) == 0);
  CHECK(white_rim(whole));
  // Legend and lines take some pixels of either.
  const double ratio = static_cast<double>(ramp.count(push_area, 8)) / whole.count(push_area, 8);
  CHECK(ratio == doctest::Approx(0.5).epsilon(0.12));
}

TEST_CASE("what pulls down is told from what pushes up, at points too") {
  const Pixels down = drawn(loaded([](double, double) { return EdgeSample{0, 0, -1, {}}; }));
  CHECK(down.count(pull_area, 8) > 5000);
  CHECK(down.count(push, 3) == 0);
  PlatePicture p = loaded([](double, double) { return EdgeSample{}; });
  const Pixels none = drawn(p);
  CHECK(none.count(pull, 3) == 0);
  p.forces = {{0, 0, -1}, {1, 1, -1}};
  const Pixels corners = drawn(p);
  CHECK(white_rim(corners));
  CHECK(corners.count(pull, 3) > 150);
  CHECK(corners.count(push, 3) == 0);
}

TEST_CASE("contour lines of a linear field stand at equal distances") {
  PlatePicture p = square_plate(7, "contours.png");
  p.view = PlateView::plan;
  for (std::size_t i = 0; i < p.deflection.size(); ++i) p.values.push_back(p.points[2 * i]);
  const Pixels seen = drawn(p);
  // Low in the plate, off the labels: centres of what stands out of its neighbourhood.
  const int y = 2 * p.height / 3;
  const auto stands_out = [&](int x) { return distance(seen.at(x, y), seen.at(x - 4, y)) > 60 && distance(seen.at(x, y), seen.at(x + 4, y)) > 60; };
  std::vector<double> lines;
  int left = 0;
  while (distance(seen.at(left, y), {255, 255, 255}) < 200 || distance(seen.at(left + 5, y), {255, 255, 255}) < 200) ++left;
  for (int x = left + 6; x < p.width - 4; ++x) {
    if (!stands_out(x)) continue;
    int end = x;
    while (stands_out(end)) ++end;
    lines.push_back((x + end - 1) / 2.0);
    x = end;
  }
  // Every twentieth; the last is the outline, the one before it pale on yellow or not.
  REQUIRE(lines.size() >= 18);
  const double step = (lines[18 - 1] - lines[0]) / 17;
  for (std::size_t i = 1; i < 18; ++i) CHECK(std::abs(lines[i] - lines[i - 1] - step) <= 1);
}

TEST_CASE("what bears on an obstacle is hatched") {
  PlatePicture p = square_plate(8, "bearing.png");
  for (const PlateView view : {PlateView::surface, PlateView::plan}) {
    p.view = view;
    p.bearing.clear();
    CHECK(drawn(p).count(status_colour(Status::closed)) == 0);
    for (int i = 0; i < 81; ++i)
      if (p.points[2 * static_cast<std::size_t>(i)] <= 0.5) p.bearing.push_back(i);
    CHECK(drawn(p).count(status_colour(Status::closed)) > 400);
    p.bearing = {40};  // alone: a point
    CHECK(drawn(p).count(status_colour(Status::closed)) > 30);
  }
}

TEST_CASE("plates of any size are drawn, flat ones and small pictures too") {
  for (const double size : {1e-3, 1.0, 1e4})
    for (const PlateView view : {PlateView::surface, PlateView::plan}) {
      PlatePicture p = one_sided(6, "sizes.png");
      p.view = view, p.width = 240, p.height = 200;
      for (double& x : p.points) x *= size;
      for (double& u : p.deflection) u *= size;
      for (PlateEdge& e : p.boundary) {
        for (double* x : {&e.from[0], &e.from[1], &e.to[0], &e.to[1]}) *x *= size;
        for (EdgeSample& s : e.samples) s.deflection *= size;
      }
      p.forces = {{0, 0, -1}, {0.5 * size, 0.5 * size, 0.2}};
      p.supports = {{0.5 * size, 0.5 * size, 0.01 * size, PlateSupport::one_sided, Status::open}};
      CHECK(message_of([&] { draw(p); }) == "");
      CHECK(white_rim(read_png("sizes.png")));
      std::fill(p.deflection.begin(), p.deflection.end(), 0.0);
      p.values = p.deflection;
      p.boundary.clear(), p.forces.clear(), p.supports.clear();
      CHECK(message_of([&] { draw(p); }) == "");
    }
}

TEST_CASE("plates that cannot be drawn are refused") {
  const auto refused = [](auto change, const char* why) {
    PlatePicture p = one_sided(4, "refused.png");
    change(p);
    CHECK(message_of([&] { draw(p); }).find(why) != std::string::npos);
  };
  refused([](PlatePicture& p) { p.file = "refused.jpg"; }, "must end in .png");
  refused([](PlatePicture& p) { p.deflection.pop_back(); }, "24 deflections for 25 nodes");
  refused([](PlatePicture& p) { p.triangles[0] = 25; }, "node 25 does not exist");
  refused([](PlatePicture& p) { p.values[3] = 1, p.values.pop_back(); }, "24 field values");
  refused([](PlatePicture& p) { p.bearing = {-1}; }, "nodes that bear");
  refused([](PlatePicture& p) { p.deflection[0] = NAN; }, "not finite");
  refused([](PlatePicture& p) { p.boundary[0].samples[0].share = 2; }, "ascend from 0 to 1");
  refused([](PlatePicture& p) { p.triangles.clear(); }, "no triangle");
}
