// Scenes: what must be seen is seen, in the place where it belongs.
#include <doctest/doctest.h>

#include <cmath>

#include "pixels.hpp"

using namespace dotyk::figure;

namespace {

// The unit square in n x n squares; values f(x, y).
template <class F>
BodyPicture square(int n, F f) {
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

}  // namespace

TEST_CASE("statuses present are drawn in their colours, others are not") {
  ScenePicture scene = scene_of(square(6, [](double, double) { return 0.0; }), "statuses.png");
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
  ScenePicture scene = scene_of(square(6, [](double, double) { return 0.0; }), "shear.png");
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
  ScenePicture scene = scene_of(square(8, [](double x, double) { return x; }), "field.png");
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
  ScenePicture scene = scene_of(square(8, [](double x, double) { return 3 * x - 1; }), "signed.png");
  scene.field_label = "stress";
  scene.axes = false;
  draw(scene);
  const Pixels p = read_png("signed.png");
  // The greatest, 2, is as strong as can be; the least, -1, half as strong.
  CHECK(p.count({103, 0, 31}, 12) > 50);
  CHECK(p.count({5, 48, 97}, 12) == 0);
  CHECK(p.count({247, 247, 247}, 1) > 50);
}

TEST_CASE("axes are equal: a square is a square") {
  ScenePicture scene = scene_of(square(1, [](double, double) { return 0.0; }), "equal.png");
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
  ScenePicture scene = scene_of(square(1, [](double, double) { return 0.0; }), "deformed.png");
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
  BodyPicture body;
  body.dimension = 3;
  body.shape = CellShape::hexahedron;
  body.nodes_per_facet = 4;
  body.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
  body.cells = {0, 1, 2, 3, 4, 5, 6, 7};
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
  ScenePicture scene = scene_of(square(2, [](double, double) { return 5.0; }), "odd.png");
  scene.field_label = "constant";
  CHECK(message_of([&] { draw(scene); }) == "");
  scene.bodies[0].values[0] = std::nan("");
  CHECK(message_of([&] { draw(scene); }) == "");
  scene.width = scene.height = 160;
  scene.title = "A title much longer than the picture is wide, which shall not do harm";
  scene.contacts = {ContactPicture{}, top_contact(2, {Status::open})};
  scene.contacts[1].facets.clear();
  scene.obstacles = {RigidPicture{}, RigidPicture{{-1e6, 1, 0, 1e6, 1, 0}, {}, false, {0, 1, 0}}};
  scene.loads = {LoadArrow{}};
  scene.supports = {SupportSymbol{}, SupportSymbol{}};
  CHECK(message_of([&] { draw(scene); }) == "");
  BodyPicture empty;
  scene.bodies = {empty};
  CHECK(message_of([&] { draw(scene); }) == "");
}
