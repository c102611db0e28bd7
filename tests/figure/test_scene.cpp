// Scenes: what must be seen is seen, in the place where it belongs.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "pixels.hpp"

using namespace dotyk::figure;

namespace {

// The unit square in n x n squares; values f(x, y).
template <class F>
BodyPicture square_body(int n, F f) {
  BodyPicture body;
  body.name = "square";
  body.shape = CellShape::quad;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      body.points.insert(body.points.end(), {x, y, 0});
      body.values.push_back(f(x, y));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      body.cells.insert(body.cells.end(), {a, a + 1, a + n + 2, a + n + 1});
    }
  return body;
}

// The top side in contact: status by node, pressure where closed.
ContactPicture top_contact(int n, const std::vector<Status>& statuses) {
  ContactPicture contact;
  for (int i = 0; i <= n; ++i) {
    ContactNode node;
    node.position = {static_cast<double>(i) / n, 1, 0};
    node.status = statuses[static_cast<std::size_t>(i) % statuses.size()];
    node.pressure = node.status == Status::open ? 0 : 1;
    contact.nodes.push_back(node);
    if (i > 0) contact.facets.insert(contact.facets.end(), {i - 1, i});
  }
  return contact;
}

ScenePicture scene_of(const BodyPicture& body, const std::string& file) {
  ScenePicture scene;
  scene.file = file;
  scene.width = 600, scene.height = 450;
  scene.bodies = {body};
  scene.edges = MeshEdges::off;
  return scene;
}

// One hexahedron, so deep along y.
BodyPicture brick(double depth) {
  BodyPicture body;
  body.dimension = 3;
  body.shape = CellShape::hexahedron;
  body.nodes_per_facet = 4;
  body.points = {0, 0, 0, 1, 0, 0, 1, depth, 0, 0, depth, 0, 0, 0, 1, 1, 0, 1, 1, depth, 1, 0, depth, 1};
  body.facets = {0, 3, 2, 1, 0, 1, 5, 4, 3, 0, 4, 7, 1, 2, 6, 5, 2, 3, 7, 6, 4, 5, 6, 7};
  return body;
}

}  // namespace

TEST_CASE("statuses present are drawn in their colours, others are not") {
  ScenePicture scene = scene_of(square_body(6, [](double, double) { return 0.0; }), "statuses.png");
  scene.bodies[0].values.clear();
  scene.contacts = {top_contact(6, {Status::open, Status::closed})};
  draw(scene);
  Pixels p = read_png("statuses.png");
  CHECK(white_rim(p));
  CHECK(p.count(status_colour(Status::open)) > 100);
  CHECK(p.count(status_colour(Status::closed)) > 100);
  CHECK(p.count(status_colour(Status::stick)) == 0);
  CHECK(p.count(status_colour(Status::slip)) == 0);

  scene.contacts = {top_contact(6, {Status::stick, Status::slip})};
  draw(scene);
  p = read_png("statuses.png");
  CHECK(p.count(status_colour(Status::open)) == 0);
  CHECK(p.count(status_colour(Status::stick)) > 100);
  CHECK(p.count(status_colour(Status::slip)) > 100);
}

TEST_CASE("shear is drawn where there is some, unless it is not wanted") {
  const Colour line{150, 15, 40};
  ScenePicture scene = scene_of(square_body(6, [](double, double) { return 0.0; }), "shear.png");
  scene.bodies[0].values.clear();
  scene.contacts = {top_contact(6, {Status::slip})};
  draw(scene);
  CHECK(read_png("shear.png").count(line) == 0);
  for (ContactNode& node : scene.contacts[0].nodes) node.shear = {0.3, 0, 0};
  draw(scene);
  Pixels p = read_png("shear.png");
  CHECK(white_rim(p));
  const auto whole = p.count(line);
  CHECK(whole > 100);
  // Arrows are relative to the greatest: half of them a tenth as long are less to see.
  for (std::size_t i = 0; i < scene.contacts[0].nodes.size(); i += 2) scene.contacts[0].nodes[i].shear = {0.03, 0, 0};
  draw(scene);
  const auto half = read_png("shear.png").count(line);
  CHECK(half > 50);
  CHECK(half < whole);
  scene.shear = false;
  draw(scene);
  CHECK(read_png("shear.png").count(line) == 0);
}

TEST_CASE("a field runs over the colours of its map, from end to end") {
  ScenePicture scene = scene_of(square_body(8, [](double x, double) { return x; }), "field.png");
  scene.field_label = "displacement";
  scene.field_unit = "mm";
  draw(scene);
  const Pixels p = read_png("field.png");
  CHECK(white_rim(p));
  // Dark violet on the left, yellow on the right, green-blue between.
  CHECK(p.count({68, 1, 84}, 12) > 50);
  CHECK(p.count({253, 231, 37}, 12) > 50);
  CHECK(p.count({33, 145, 140}, 12) > 50);
}

TEST_CASE("a signed field is white at zero, and equal sizes are equally strong") {
  ScenePicture scene = scene_of(square_body(8, [](double x, double) { return 3 * x - 1; }), "signed.png");
  scene.field_label = "stress";
  scene.axes = false;
  draw(scene);
  const Pixels p = read_png("signed.png");
  // The greatest, 2, is as strong as can be; the least, -1, half as strong.
  CHECK(p.count({103, 0, 31}, 12) > 50);
  CHECK(p.count({5, 48, 97}, 12) == 0);
  CHECK(p.count({247, 247, 247}, 1) > 50);
}

TEST_CASE("an end of the colour bar beyond which the field goes on is a triangle") {
  ScenePicture scene = scene_of(square_body(8, [](double x, double) { return x; }), "beyond.png");
  scene.field_label = "field";
  // Rows of the bar's colours from its end on that get narrower.
  const auto widths = [&](double low, double high, bool above) {
    scene.field_range = {low, high};
    draw(scene);
    const Pixels p = read_png("beyond.png");
    const Colour end = above ? Colour{253, 231, 37} : Colour{68, 1, 84};
    std::vector<int> out;
    for (int y = 0; y < p.height; ++y) {
      int n = 0;
      for (int x = 4 * p.width / 5; x < p.width; ++x) {
        const Colour c = p.at(x, y);
        n += std::abs(c.r - end.r) + std::abs(c.g - end.g) + std::abs(c.b - end.b) < 25;
      }
      if (n > 0) out.push_back(n);
    }
    if (!above) std::reverse(out.begin(), out.end());
    return out;
  };
  const auto pointed = [](const std::vector<int>& w) { return w.size() > 8 && w[1] < w[4] && w[4] < w[7] && w[7] < w.back(); };
  CHECK_FALSE(pointed(widths(0, 1, true)));
  CHECK_FALSE(pointed(widths(0, 1, false)));
  CHECK(pointed(widths(0, 0.7, true)));
  CHECK_FALSE(pointed(widths(0, 0.7, false)));
  CHECK(pointed(widths(0.3, 1, false)));
  CHECK_FALSE(pointed(widths(0.3, 1, true)));
}

TEST_CASE("a closed contact that magnification draws apart is joined by a band") {
  const auto band = [](double rest_gap, double deformation) {
    ScenePicture scene = scene_of(square_body(6, [](double, double) { return 0.0; }), "joined.png");
    scene.bodies[0].values.clear();
    scene.deformation = deformation;
    scene.pressure = PressureStyle::none;
    scene.contacts = {top_contact(6, {Status::closed})};
    for (ContactNode& node : scene.contacts[0].nodes) node.rest_gap = rest_gap;
    draw(scene);
    const Pixels p = read_png("joined.png");
    const Colour full = status_colour(Status::closed);
    const auto tint = [](int c) { return static_cast<unsigned char>(255 - 0.45 * (255 - c)); };
    return p.count({tint(full.r), tint(full.g), tint(full.b)}, 4);
  };
  CHECK(band(-0.02, 1) < 50);
  CHECK(band(0, 5) < 50);
  CHECK(band(-0.02, 5) > 1000);
}

TEST_CASE("axes are equal: a square is a square") {
  ScenePicture scene = scene_of(square_body(1, [](double, double) { return 0.0; }), "equal.png");
  scene.bodies[0].values.clear();
  scene.axes = false;
  draw(scene);
  const Pixels p = read_png("equal.png");
  int left = p.width, right = -1, top = p.height, bottom = -1;
  const Colour white{255, 255, 255};
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x)
      if (p.at(x, y) != white) {
        left = std::min(left, x), right = std::max(right, x);
        top = std::min(top, y), bottom = std::max(bottom, y);
      }
  CHECK(right - left > 200);
  CHECK(std::abs((right - left) - (bottom - top)) <= 1);
}

TEST_CASE("displacements are scaled by the factor") {
  ScenePicture scene = scene_of(square_body(1, [](double, double) { return 0.0; }), "deformed.png");
  scene.bodies[0].values.clear();
  for (int i = 0; i < 4; ++i) scene.bodies[0].displacement.insert(scene.bodies[0].displacement.end(), {0.1, 0, 0});
  scene.deformation = 10;  // the square moves by its own width
  draw(scene);
  const Pixels p = read_png("deformed.png");
  const Colour body = p.at(p.width / 2 + 90, p.height / 2 - 20), empty = p.at(p.width / 2 - 60, p.height / 2 - 20);
  CHECK(body != Colour{255, 255, 255});
  CHECK(empty == Colour{255, 255, 255});
}

TEST_CASE("a solid shows its statuses through the obstacle and in the plan beside it") {
  ScenePicture scene;
  scene.file = "solid.png";
  scene.width = 600, scene.height = 450;
  BodyPicture body = brick(1);
  body.values = {0, 0, 0, 0, 1, 1, 1, 1};
  scene.bodies = {body};
  scene.field_label = "uz";
  ContactPicture contact;
  contact.nodes_per_facet = 4;
  contact.facets = {0, 1, 2, 3};
  for (const Vec3& at : {Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{1, 1, 1}, Vec3{0, 1, 1}}) {
    ContactNode node;
    node.position = at;
    node.normal = {0, 0, 1};
    node.pressure = 1;
    node.status = Status::slip;
    contact.nodes.push_back(node);
  }
  scene.contacts = {contact};
  draw(scene);
  const Pixels p = read_png("solid.png");
  CHECK(white_rim(p));
  CHECK(p.count(status_colour(Status::slip)) > 2000);
  CHECK(p.count(status_colour(Status::open)) == 0);
}

TEST_CASE("odd scenes are drawn all the same") {
  ScenePicture scene = scene_of(square_body(2, [](double, double) { return 5.0; }), "odd.png");
  scene.field_label = "constant";
  CHECK(message_of([&] { draw(scene); }) == "");
  scene.bodies[0].values[0] = std::nan("");
  CHECK(message_of([&] { draw(scene); }) == "");
  scene.width = scene.height = 160;
  scene.title = "A title much longer than the picture is wide, which shall not do harm";
  scene.contacts = {ContactPicture{}, top_contact(2, {Status::open})};
  scene.contacts[1].facets.clear();
  scene.obstacles = {RigidPicture{}, RigidPicture{{-1e6, 1, 0, 1e6, 1, 0}, {}, {0, 1, 0}}};
  scene.loads = {LoadArrow{}};
  scene.supports = {SupportSymbol{}, SupportSymbol{}};
  CHECK(message_of([&] { draw(scene); }) == "");
  BodyPicture empty;
  scene.bodies = {empty};
  CHECK(message_of([&] { draw(scene); }) == "");
}

TEST_CASE("the least and the greatest value are read as the ticks are, in the bar's power of ten") {
  const auto drawn = [](double factor, const std::string& file) {
    ScenePicture scene = scene_of(square_body(8, [factor](double x, double) { return factor * (0.125 + 149.25 * x); }), file);
    scene.field_label = "stress";
    draw(scene);
    return read_png(file);
  };
  const Pixels plain = drawn(1, "ones.png"), thousands = drawn(1000, "thousands.png");
  // The same numbers, and "[× 10³]" more in the upright label.
  int left = plain.width, right = -1;
  for (int y = 0; y < plain.height; ++y)
    for (int x = 0; x < plain.width; ++x)
      if (plain.at(x, y) != thousands.at(x, y)) left = std::min(left, x), right = std::max(right, x);
  CHECK(left <= right);
  CHECK(right - left < 20);
}

namespace {

// The middles of the spots of a colour right of `from`.
std::vector<std::array<double, 2>> spots(const Pixels& p, Colour colour, int from) {
  std::vector<bool> seen(static_cast<std::size_t>(p.width * p.height), false);
  std::vector<std::array<double, 2>> out;
  for (int y0 = 0; y0 < p.height; ++y0)
    for (int x0 = from; x0 < p.width; ++x0) {
      std::vector<std::array<int, 2>> todo{{x0, y0}};
      double x_sum = 0, y_sum = 0, n = 0;
      while (!todo.empty()) {
        const auto [x, y] = todo.back();
        todo.pop_back();
        if (x < from || x >= p.width || y < 0 || y >= p.height || p.at(x, y) != colour) continue;
        const auto at = static_cast<std::size_t>(y * p.width + x);
        if (seen[at]) continue;
        seen[at] = true;
        x_sum += x, y_sum += y, n += 1;
        for (const auto& [dx, dy] : {std::array{1, 0}, std::array{-1, 0}, std::array{0, 1}, std::array{0, -1}}) todo.push_back({x + dx, y + dy});
      }
      if (n > 2) out.push_back({x_sum / n, y_sum / n});
    }
  return out;
}

// The different ones of places, a pixel being none.
std::vector<double> different(std::vector<double> places) {
  std::sort(places.begin(), places.end());
  std::vector<double> out;
  for (const double v : places)
    if (out.empty() || v - out.back() > 1.5) out.push_back(v);
  return out;
}

bool even(const std::vector<double>& places) {
  for (std::size_t i = 2; i < places.size(); ++i)
    if (std::abs(places[i] - 2 * places[i - 1] + places[i - 2]) > 2.5) return false;
  return true;
}

}  // namespace

TEST_CASE("the arrows of a uniform load are equally far apart, whatever their number") {
  for (const int n : {50, 53, 61}) {
    CAPTURE(n);
    ScenePicture scene = scene_of(square_body(4, [](double, double) { return 0.0; }), "uniform.png");
    scene.printed = 120;
    scene.bodies[0].values.clear();
    for (int i = 0; i < n; ++i) {
      LoadArrow load;
      load.position = {(i + 0.5) / n, 1, 0};
      load.vector = {0, -1, 0};
      scene.loads.push_back(load);
    }
    draw(scene);
    const Pixels p = read_png("uniform.png");
    std::vector<double> x;
    for (const auto& spot : spots(p, {0, 70, 110}, 0))
      if (spot[1] < 0.75 * p.height && spot[0] < 0.6 * p.width) x.push_back(spot[0]);  // not the legend's
    CHECK(x.size() > 8);
    CHECK(different(x).size() == x.size());
    CHECK(even(different(x)));
  }
}

TEST_CASE("dots of the pressure on the plan of a grid stand in its rows and columns") {
  ScenePicture scene;
  scene.file = "dots.png";
  scene.width = 700, scene.height = 500, scene.printed = 127;
  scene.bodies = {brick(2)};
  ContactPicture contact;
  contact.nodes_per_facet = 4;
  const int nx = 23, ny = 38;  // neither leaves dots on the rim, whose line would cut them
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      ContactNode node;
      node.position = {static_cast<double>(i) / nx, 2.0 * j / ny, 0};
      node.normal = {0, 0, -1};
      node.pressure = 1;
      node.status = Status::closed;
      contact.nodes.push_back(node);
      if (i > 0 && j > 0) contact.facets.insert(contact.facets.end(), {(j - 1) * (nx + 1) + i - 1, (j - 1) * (nx + 1) + i, j * (nx + 1) + i, j * (nx + 1) + i - 1});
    }
  scene.contacts = {contact};
  draw(scene);
  const Pixels p = read_png("dots.png");
  std::vector<double> x, y;
  for (const auto& spot : spots(p, {45, 50, 90}, static_cast<int>(0.72 * p.width)))
    if (spot[1] < 0.85 * p.height) x.push_back(spot[0]), y.push_back(spot[1]);
  CHECK(x.size() > 30);
  CHECK(x.size() == different(x).size() * different(y).size());
  CHECK(even(different(x)));
  CHECK(even(different(y)));
}
