// A plate as a scene: a body in the plane or in space, with what plates add.
#include <algorithm>
#include <array>
#include <cmath>

#include "figure/door/figures.hpp"
#include "figure/plate/plate_stage.hpp"

namespace dotyk::figure {

Plate::Plate(const PlatePicture& p) : picture(p), runs(edge_runs(p)) {
  for (const EdgeRun& run : runs)
    for (const EdgePoint& point : run.points) greatest_reaction = std::max(greatest_reaction, std::abs(point.reaction));
  for (const PlateForce& f : p.forces) greatest_force = std::max(greatest_force, std::abs(f.force));
}

bool Plate::any(bool (*of)(const EdgeRun&)) const { return std::any_of(runs.begin(), runs.end(), of); }

Colour support_colour(PlateSupport support, const std::optional<Status>& status) {
  if (status) return status_colour(*status);
  return support == PlateSupport::elastic ? elastic_colour : support_ink;
}

namespace {

LegendEntry line_entry(const std::string& name, Colour colour, double width) {
  return {name, [colour, width](Canvas& c, const Box& b) {
            const double middle = (b.bottom + b.top) / 2;
            c.line({b.left, middle}, {b.right, middle}, width, colour);
          }};
}

// Statuses and supports without one, of edges.
struct Occurring {
  std::array<bool, 4> status{};
  std::array<bool, 5> support{};
};

Occurring occurring(const Plate& plate) {
  Occurring seen;
  for (const EdgeRun& run : plate.runs)
    for (const EdgePoint& p : run.points) {
      if (p.status)
        seen.status[static_cast<std::size_t>(*p.status)] = true;
      else
        seen.support[static_cast<std::size_t>(run.support)] = true;
    }
  return seen;
}

LegendEntry bearing_entry(double em) {
  return {"bears on the obstacle", [em](Canvas& c, const Box& b) {
            const double middle = (b.bottom + b.top) / 2, half = 0.38 * em;
            const Colour colour = status_colour(Status::closed);
            const std::array<Point, 4> corners{{{b.left, middle - half}, {b.right, middle - half}, {b.right, middle + half}, {b.left, middle + half}}};
            for (double x = b.left; x + 2 * half <= b.right + 1; x += 0.45 * em) c.line({x, middle - half}, {x + 2 * half, middle + half}, std::max(1.0, em / 18), colour);
            c.polyline(corners, std::max(1.4, em / 12), colour, {}, true);
          }};
}

// The plate, flat or with its deflection upwards.
BodyPicture body_of(const PlatePicture& p, bool space) {
  BodyPicture body;
  body.dimension = space ? 3 : 2;
  body.shape = space ? CellShape::tetrahedron : CellShape::triangle;
  for (std::size_t i = 0; 2 * i + 1 < p.points.size(); ++i) {
    body.points.insert(body.points.end(), {p.points[2 * i], p.points[2 * i + 1], 0});
    if (space) body.displacement.insert(body.displacement.end(), {0, 0, p.deflection[i]});
  }
  // In space the triangles are the skin of a body without an inside.
  (space ? body.facets : body.cells) = p.triangles;
  if (space) body.nodes_per_facet = 3;
  body.values = p.values;
  return body;
}

// A little below where it is, so that what lies on it is not cut by it.
RigidPicture obstacle_of(const PlatePicture& p) {
  RigidPicture out;
  double size = 0;
  for (const double x : p.points) size = std::max(size, std::abs(x - p.points[0]));
  const auto there = [&](int i) { return std::isfinite(p.obstacle[static_cast<std::size_t>(i)]); };
  for (std::size_t i = 0; i < p.obstacle.size(); ++i)
    out.points.insert(out.points.end(), {p.points[2 * i], p.points[2 * i + 1], there(static_cast<int>(i)) ? p.deformation * p.obstacle[i] - 0.004 * size : 0});
  const std::vector<int>& t = p.triangles;
  for (std::size_t k = 0; k + 2 < t.size(); k += 3)
    if (there(t[k]) && there(t[k + 1]) && there(t[k + 2])) out.triangles.insert(out.triangles.end(), &t[k], &t[k] + 3);
  return out;
}

// The line of a run with its statuses; what its points carry is drawn as strips.
ContactPicture contact_of(const EdgeRun& run) {
  ContactPicture out;
  for (const EdgePoint& p : run.points) {
    if (!p.status) continue;
    ContactNode node;
    node.position = p.position, node.normal = p.normal, node.status = *p.status;
    const int i = static_cast<int>(out.nodes.size());
    if (i > 0) out.facets.insert(out.facets.end(), {i - 1, i});
    out.nodes.push_back(node);
  }
  return out;
}

ScenePicture scene_of(const Plate& plate) {
  const PlatePicture& p = plate.picture;
  const bool space = p.view == PlateView::surface;
  ScenePicture scene;
  scene.file = p.file, scene.width = p.width, scene.height = p.height;
  scene.title = p.title, scene.caption = p.caption;
  scene.field_label = p.field_label, scene.field_unit = p.field_unit, scene.field_range = p.field_range, scene.map = p.map;
  scene.edges = !space && p.edges == MeshEdges::automatic ? MeshEdges::off : p.edges;
  scene.bodies = {body_of(p, space)};
  if (!space) {
    for (const EdgeRun& run : plate.runs)
      if (ContactPicture contact = contact_of(run); !contact.nodes.empty()) scene.contacts.push_back(std::move(contact));
    return scene;
  }
  scene.deformation = p.deformation;
  scene.view_from = p.view_from.value_or(Vec3{1, -1.7, 0.8});
  if (!p.obstacle.empty()) scene.obstacles = {obstacle_of(p)};
  return scene;
}

}  // namespace

std::vector<LegendEntry> plate_legend(const Plate& plate, double em, double width) {
  std::vector<LegendEntry> out;
  const Occurring seen = occurring(plate);
  if (plate.picture.view == PlateView::surface)
    for (const Status status : {Status::open, Status::closed, Status::stick, Status::slip})
      if (seen.status[static_cast<std::size_t>(status)]) out.push_back(line_entry(status_name(status), status_colour(status), width));
  for (const PlateSupport support : {PlateSupport::held, PlateSupport::one_sided, PlateSupport::elastic, PlateSupport::friction})
    if (seen.support[static_cast<std::size_t>(support)])
      out.push_back(line_entry(std::string("edge ") + support_name(support), support_colour(support, std::nullopt), width));
  if (!plate.picture.supports.empty())
    out.push_back({"point support", [em](Canvas& c, const Box& b) { c.marker(Marker::triangle, {(b.left + b.right) / 2, (b.bottom + b.top) / 2}, 0.6 * em, support_ink); }});
  if (!plate.picture.bearing.empty()) out.push_back(bearing_entry(em));
  return out;
}

void draw_label(Stage& stage, const PlateLabel& label) {
  const double pad = 0.15 * stage.em;
  const Box& b = label.box;
  if (label.ground) stage.over.box({b.left - pad, b.bottom - pad, b.right + pad, b.top + pad}, {255, 255, 255}, 0.8);
  TextStyle style;
  style.size = 0.85 * stage.em;
  style.across = style.up = Align::middle;
  style.colour = label.colour;
  style.halo = !label.ground;
  stage.over.text({(label.box.left + label.box.right) / 2, (label.box.bottom + label.box.top) / 2}, label.text, style);
}

void draw_plate(const PlatePicture& picture) {
  const Plate plate(picture);
  const ScenePicture scene = scene_of(plate);
  Stage stage(scene, oversampling(scene.width, scene.height));
  stage.added = stage.plane ? plan_additions(plate) : surface_additions(plate);
  draw_stage(stage);
}

}  // namespace dotyk::figure
