// A plate as a scene: a body in the plane or in space, with what plates add.
#include <map>
#include <ranges>

#include "figure/door/drawing.hpp"
#include "figure/plate/plate_stage.hpp"

namespace dotyk::figure {

Plate::Plate(const PlatePicture& p) : picture(p), runs(edge_runs(p)) {
  for (const EdgeRun& run : runs) {
    clamped = clamped || run.clamped;
    for (const EdgePoint& point : run.points) greatest_reaction = std::max(greatest_reaction, std::abs(point.reaction));
  }
  for (const PlateForce& f : p.forces) greatest_force = std::max(greatest_force, std::abs(f.force));
  if (p.bearing.empty()) return;
  std::vector<double> bears = p.bears;
  if (bears.empty()) bears.resize(p.deflection.size(), 0);
  if (p.bears.empty()) for (const int i : p.bearing) bears[i] = 1;
  std::map<std::pair<int, int>, int> sides;  // of triangles: how many
  for (std::size_t k = 0; k + 2 < p.triangles.size(); k += 3)
    for (std::size_t c = 0; c < 3; ++c) ++sides[std::minmax(p.triangles[k + c], p.triangles[k + (c + 1) % 3])];
  for (std::size_t k = 0; k + 2 < p.triangles.size(); k += 3) {
    PlateLine polygon, ends;
    for (std::size_t c = 0; c < 3; ++c) {
      const int i = p.triangles[k + c], j = p.triangles[k + (c + 1) % 3];
      const double a = bears[i] - 0.5, b = bears[j] - 0.5;
      const auto crossing = [&] { return part_way(node(i, 1), node(j, 1), a / (a - b)); };
      if (a > 0) polygon.push_back(node(i, 1));
      if ((a > 0) != (b > 0)) polygon.push_back(crossing()), ends.push_back(crossing());
      if ((a > 0 || b > 0) && sides[std::minmax(i, j)] == 1) rim.push_back({a > 0 ? node(i, 1) : crossing(), b > 0 ? node(j, 1) : crossing()});
    }
    if (!polygon.empty()) zone.push_back(std::move(polygon));
    if (!ends.empty()) rim.push_back(std::move(ends));
  }
  std::ranges::copy_if(p.bearing, std::back_inserter(lone), [&](int i) { return !(bears[i] > 0.5); });
}

bool Plate::any(const std::function<bool(const EdgeRun&, const EdgePoint&)>& of) const {
  return std::any_of(runs.begin(), runs.end(), [&](const EdgeRun& run) {
    return std::any_of(run.points.begin(), run.points.end(), [&](const EdgePoint& p) { return of(run, p); });
  });
}

Colour support_colour(PlateSupport support, const std::optional<Status>& status) {
  if (status) return status_colour(*status);
  return support == PlateSupport::elastic ? Colour{120, 85, 55} : support_ink;
}

namespace {

LegendEntry line_entry(const std::string& name, Colour colour, double width) {
  return {name, [colour, width](Canvas& c, const Box& b) { c.line(b.midline()[0], b.midline()[1], width, colour); }};
}

LegendEntry bearing_entry(double em, bool zone, bool lone) {
  return {"bears on the obstacle", [=](Canvas& c, const Box& sample) {
            Box b = sample;
            const double middle = b.centre().y, half = 0.38 * em;
            const Colour colour = status_colour(Status::closed);
            if (lone) c.marker(Marker::disc, {zone ? b.right - 0.25 * em : b.centre().x, middle}, 0.5 * em, colour), b.right -= 0.7 * em;
            if (!zone) return;
            for (double x = b.left; x + 2 * half <= b.right + 1; x += 0.45 * em) c.line({x, middle - half}, {x + 2 * half, middle + half}, std::max(1.0, em / 18), colour);
            c.outline({b.left, middle - half, b.right, middle + half}, std::max(1.4, em / 12), colour);
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
  body.edges = p.mesh_edges;
  body.values = p.values;
  return body;
}

// A solid block, its top a little below where it is, so that what lies on it is not cut by it.
RigidPicture obstacle_of(const PlatePicture& p) {
  RigidPicture out;
  double size = 0;
  for (const double x : p.points) size = std::max(size, std::abs(x - p.points[0]));
  const auto there = [&](std::size_t i) { return std::isfinite(p.obstacle[i]); };
  for (std::size_t i = 0; i < p.obstacle.size(); ++i)
    out.points.insert(out.points.end(), {p.points[2 * i], p.points[2 * i + 1], there(i) ? p.deformation * p.obstacle[i] - 0.004 * size : 0});
  const std::vector<int>& t = p.triangles;
  double lowest = 0;
  for (std::size_t k = 0; k + 2 < t.size(); k += 3)
    if (there(t[k]) && there(t[k + 1]) && there(t[k + 2])) {
      out.triangles.insert(out.triangles.end(), &t[k], &t[k] + 3);
      for (std::size_t c = 0; c < 3; ++c) lowest = std::min(lowest, out.points[3 * t[k + c] + 2]);
    }
  std::map<int, int> feet;
  const auto foot = [&](int i) {
    const auto [found, fresh] = feet.try_emplace(i, static_cast<int>(out.points.size() / 3));
    if (fresh) out.points.insert(out.points.end(), {out.points[3 * i], out.points[3 * i + 1], lowest - 0.04 * size});
    return found->second;
  };
  for (const std::vector<int>& chain : chains(rim({out.triangles, 3})))
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
      const int a = chain[k], b = chain[k + 1], under_a = foot(a), under_b = foot(b);
      out.triangles.insert(out.triangles.end(), {a, b, under_a, b, under_b, under_a});
    }
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
  static_cast<Sheet&>(scene) = p;
  scene.caption = p.caption;
  scene.field_label = p.field_label, scene.field_unit = p.field_unit, scene.field_range = p.field_range, scene.field_signed = p.field_signed, scene.length_unit = p.length_unit;
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

void add_layers(Stage& stage, const Plate& plate) {
  const std::vector<Layer> layers = stage.plane ? plan_layers(plate) : surface_layers(plate);
  stage.layers.insert(stage.layers.end() - 1, layers.begin(), layers.end());  // in the legend before what is said of bodies
  stage.axes_of_bodies = stage.plane;
}

}  // namespace

void plate_legend(const Plate& plate, double em, double width, std::vector<LegendEntry>& out) {
  if (plate.picture.view == PlateView::surface)
    for (const Status status : {Status::open, Status::closed, Status::stick, Status::slip})
      if (plate.any([&](const EdgeRun&, const EdgePoint& p) { return p.status == status; })) out.push_back(line_entry(status_name(status), status_colour(status), width));
  for (const auto& [support, name] : {std::pair{PlateSupport::held, "edge held"}, std::pair{PlateSupport::one_sided, "edge one-sided"},
                                      std::pair{PlateSupport::elastic, "edge elastic"}, std::pair{PlateSupport::friction, "edge with friction"}})
    if (plate.any([&, support = support](const EdgeRun& run, const EdgePoint& p) { return !p.status && run.support == support; }))
      out.push_back(line_entry(name, support_colour(support, std::nullopt), width));
  // A triangle in each of the colours that occur.
  std::vector<Colour> colours;
  for (const PlatePointSupport& p : plate.picture.supports)
    if (const Colour c = support_colour(p.support, p.status); std::ranges::find(colours, c) == colours.end()) colours.push_back(c);
  if (!colours.empty())
    out.push_back({"point support", [em, colours](Canvas& c, const Box& b) {
                     for (std::size_t k = 0; k < colours.size(); ++k)
                       c.marker(Marker::triangle, part_way(b.midline()[0], b.midline()[1], (static_cast<double>(k) + 0.5) / static_cast<double>(colours.size())), 0.6 * em, colours[k]);
                   }});
  if (!plate.picture.bearing.empty()) out.push_back(bearing_entry(em, !plate.zone.empty(), !plate.lone.empty()));
}

std::vector<std::array<Vec3, 2>> hatch(const Plate& plate, double spacing) {
  std::vector<std::array<Vec3, 2>> out;
  for (const PlateLine& corner : plate.zone) std::ranges::copy(hatched(std::span(corner), spacing), std::back_inserter(out));
  return out;
}

void draw_bearing_points(Stage& stage, const Plate& plate, double factor, double size) {
  for (const int i : plate.lone) stage.over.marker(Marker::disc, stage.view.flat(plate.node(i, factor)), size, status_colour(Status::closed));
}

void draw_apex(Stage& stage, Point at, Point size, double rim, Colour colour) {
  for (const auto& [grow, paint] : {std::pair{rim, Colour{255, 255, 255}}, std::pair{0.0, colour}}) {
    const double low = at.y - size.y - 0.7 * grow;
    stage.over.convex(std::array{Point{at.x, at.y + grow}, Point{at.x - size.x - grow, low}, Point{at.x + size.x + grow, low}}, paint);
  }
}

void render(const PlatePicture& picture) {
  const Plate plate(picture);
  draw_scene(scene_of(plate), [&](Stage& stage) { add_layers(stage, plate); });
}

std::vector<DataMark> read(const PlatePicture& picture) {
  const Plate plate(picture);
  return read_scene(scene_of(plate), [&](Stage& stage) { add_layers(stage, plate); });
}

}  // namespace dotyk::figure
