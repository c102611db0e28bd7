// Windows onto a scene of the plane: what is cut off, what grows, what is refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "figure/canvas/window.hpp"
#include "pixels.hpp"

using namespace dotyk::figure;

namespace {

constexpr Colour white{255, 255, 255}, tint{214, 222, 232}, pressure_line{45, 50, 90};

// The square [-10, 10] x [0, 20] in n x n squares, its lower side in contact
// with a plane: closed with an elliptic pressure where |x| < 1.
ScenePicture pressed(const std::string& file, int n = 40) {
  ScenePicture scene;
  scene.file = file;
  scene.width = 600, scene.height = 450, scene.printed = 120;
  scene.edges = MeshEdges::off;
  BodyPicture body;
  body.shape = CellShape::quad;
  ContactPicture contact;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) body.points.insert(body.points.end(), {20.0 * i / n - 10, 20.0 * j / n, 0});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      body.cells.insert(body.cells.end(), {a, a + 1, a + n + 2, a + n + 1});
    }
  for (int i = 0; i <= n; ++i) {
    ContactNode node;
    node.position = {20.0 * i / n - 10, 0, 0};
    node.normal = {0, -1, 0};
    node.pressure = std::sqrt(std::max(0.0, 1 - node.position[0] * node.position[0]));
    node.status = node.pressure > 0 ? Status::closed : Status::open;
    contact.nodes.push_back(node);
    if (i > 0) contact.facets.insert(contact.facets.end(), {i - 1, i});
  }
  scene.bodies = {body};
  scene.contacts = {contact};
  scene.obstacles = {RigidPicture{{-1e5, 0, 0, 1e5, 0, 0}, {}, {0, -1, 0}}};
  return scene;
}

struct Extent {
  int left = 1 << 20, top = 1 << 20, right = -1, bottom = -1;
  int width() const { return right - left + 1; }
  int height() const { return bottom - top + 1; }
};

Extent extent(const Pixels& p, Colour colour) {
  Extent e;
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      const Colour c = p.at(x, y);
      if (std::abs(c.r - colour.r) > 2 || std::abs(c.g - colour.g) > 2 || std::abs(c.b - colour.b) > 2) continue;
      e.left = std::min(e.left, x), e.right = std::max(e.right, x);
      e.top = std::min(e.top, y), e.bottom = std::max(e.bottom, y);
    }
  return e;
}

}  // namespace

TEST_CASE("a window cuts bodies and outlines off at its sides") {
  ScenePicture scene = pressed("window.png");
  scene.contacts.clear(), scene.obstacles.clear();
  scene.axes = false;
  scene.window = {-4, 5, 4, 9};  // all within the body
  draw(scene);
  const Pixels p = read_png("window.png");
  CHECK(white_rim(p));
  const Extent body = extent(p, tint);
  CHECK(body.width() > 500);
  CHECK(std::abs(body.width() - 2 * body.height()) <= 4);
  for (int x = 0; x < p.width; ++x) {
    CHECK(p.at(x, body.top - 4) == white);
    CHECK(p.at(x, body.bottom + 4) == white);
  }
  for (int y = 0; y < p.height; ++y) {
    CHECK(p.at(body.left - 4, y) == white);
    CHECK(p.at(body.right + 4, y) == white);
  }
}

TEST_CASE("contact, obstacle, supports and loads stay within the window") {
  ScenePicture scene = pressed("window_symbols.png", 200);
  scene.axes = false;
  scene.window = {-2, -1.5, 2, 1};
  for (int i = -10; i <= 10; ++i) {
    const double at = i;
    scene.supports.push_back({{0.2 * at, 0.9, 0}, {0, 0, 0}, {0, 1, 0}, {true, true, true}, SupportKind::fix});
    scene.loads.push_back({{0.2 * at, 0.5, 0}, {0, 0, 0}, {1, 0, 0}});
  }
  draw(scene);
  const Pixels p = read_png("window_symbols.png");
  const Extent body = extent(p, tint);
  // Nothing beside it, but for the thin rim.
  for (int y = 0; y < body.bottom; ++y) {
    CHECK(p.at(body.left - 4, y) == white);
    CHECK(p.at(body.right + 4, y) == white);
  }
  for (int x = 0; x < p.width; ++x) CHECK(p.at(x, body.top - 4) == white);
  // All of the contact is closed or open in the window, and both are shown.
  CHECK(p.count(status_colour(Status::open)) > 300);
  CHECK(p.count(status_colour(Status::closed)) > 300);
}

TEST_CASE("the pressure stands whole in its window, which grows for it") {
  ScenePicture scene = pressed("window_strip.png", 200);
  scene.axes = false;
  const auto heights = [&](const Window& window) {
    scene.window = window;
    draw(scene);
    const Pixels p = read_png("window_strip.png");
    const Extent body = extent(p, tint);
    const double unit = body.width() / (window[2] - window[0]);
    // From the body's lower side to the lowest of the strip's line and label,
    // the legend left out.
    int lowest = body.bottom;
    for (int y = body.bottom; y < std::min(p.height - 55, body.bottom + 150); ++y)
      for (int x = body.left + 20; x < body.right - 20; ++x) {
        const Colour c = p.at(x, y);
        if (std::abs(c.r - pressure_line.r) < 12 && std::abs(c.g - pressure_line.g) < 12 && std::abs(c.b - pressure_line.b) < 12) lowest = y;
      }
    return std::array<double, 2>{(lowest - body.bottom) / unit, body.height() / unit};
  };
  const auto roomy = heights({-4, -2, 4, 3});
  CHECK(roomy[0] > 0.9);  // a fifth of 5, and the label
  CHECK(roomy[0] < 2.0);
  CHECK(roomy[1] == doctest::Approx(3).epsilon(0.05));
  const auto none = heights({-4, 0, 4, 4});
  CHECK(none[0] > 0.5);
  CHECK(none[1] == doctest::Approx(4).epsilon(0.05));
}

TEST_CASE("colours are those of what is seen, also within one cell") {
  ScenePicture scene = pressed("seen.png", 4);
  for (std::size_t i = 0; i < scene.bodies[0].points.size(); i += 3) scene.bodies[0].values.push_back(scene.bodies[0].points[i]);
  Seen part = seen(scene, {1, 6, 2, 7});
  CHECK(part.body);
  CHECK(part.least == doctest::Approx(1));
  CHECK(part.greatest == doctest::Approx(2));
  part = seen(scene, {-20, -20, 20, 40});
  CHECK(part.least == doctest::Approx(-10));
  CHECK(part.greatest == doctest::Approx(10));
  CHECK_FALSE(seen(scene, {-4, -3, 4, 0}).body);  // beside it, though they touch
  // Displaced, factor and all.
  scene.deformation = 2;
  for (std::size_t i = 0; i < scene.bodies[0].points.size(); i += 3)
    scene.bodies[0].displacement.insert(scene.bodies[0].displacement.end(), {0, -1.5, 0});
  CHECK(seen(scene, {-4, -3, 4, 0}).body);

  scene.field_label = "ux";
  scene.window = {1, 6, 2, 7};
  draw(scene);
  const Pixels p = read_png("seen.png");
  CHECK(p.count({68, 1, 84}, 12) > 50);
  CHECK(p.count({253, 231, 37}, 12) > 50);
}

TEST_CASE("a deeper window shows more nodes of the contact") {
  const auto markers = [](const Window& window) {
    ScenePicture scene = pressed("deeper.png", 400);
    scene.pressure = PressureStyle::none;
    scene.window = window;
    draw(scene);
    return read_png("deeper.png").count(status_colour(Status::closed));
  };
  CHECK(markers({-1, -0.5, 1, 1}) > 4 * markers({-10, -5, 10, 10}));
}

TEST_CASE("windows that are refused, and odd ones that are drawn") {
  ScenePicture scene = pressed("refused_window.png", 4);
  scene.window = {2, 0, 1, 1};
  CHECK(message_of([&] { draw(scene); }) == "window {2, 0, 1, 1} is empty; it must be {x0, y0, x1, y1} with x0 < x1 and y0 < y1");
  scene.window = {30, 0, 31, 1};
  CHECK(message_of([&] { draw(scene); }) == "window {30, 0, 31, 1} shows no body; as drawn, they lie within {-10, 0, 10, 20}");
  scene.window = {0, 0, 1, std::nan("")};
  CHECK(contains(message_of([&] { draw(scene); }), "is empty"));
  BodyPicture solid;
  solid.dimension = 3;
  solid.shape = CellShape::tetrahedron;
  solid.nodes_per_facet = 3;
  solid.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  solid.cells = {0, 1, 2, 3};
  ScenePicture space;
  space.file = "refused_window.png";
  space.bodies = {solid};
  space.window = {0, 0, 1, 1};
  CHECK(contains(message_of([&] { draw(space); }), "needs a scene in the plane"));
  CHECK_FALSE(exists("refused_window.png"));

  scene.file = "odd_window.png";
  scene.width = scene.height = 160;
  for (const Window& w : {Window{-10, 1, 10, 1.001}, Window{0.2, -50, 0.2001, 60}, Window{0, 0, 1e-9, 1e-9}, Window{-1e6, -1e6, 1e6, 1e6}}) {
    scene.window = w;
    CHECK(message_of([&] { draw(scene); }) == "");
  }
}

TEST_CASE("an undisplaced factor is not worth an entry") {
  ScenePicture scene = pressed("factor.png", 4);
  scene.contacts.clear(), scene.obstacles.clear();
  scene.bodies[0].displacement.assign(scene.bodies[0].points.size(), 0.0);
  scene.axes = false;
  const auto lowest = [&](double factor) {
    scene.deformation = factor;
    draw(scene);
    const Pixels p = read_png("factor.png");
    int dark = 0;
    for (int y = p.height - 30; y < p.height; ++y) {
      int in_row = 0;
      for (int x = 0; x < p.width; ++x) in_row += p.at(x, y).r < 100 && p.at(x, y).b < 100;
      if (in_row < p.width / 2) dark += in_row;  // else the body's outline
    }
    return dark;
  };
  CHECK(lowest(2) > 100);  // "deformation × 2"
  CHECK(lowest(1) < lowest(2));
}
