// The contact in space: statuses on the facets, pressure as arrows that
// bodies in front of them hide.
#include <algorithm>
#include <array>
#include <cmath>

#include <vtkActor.h>
#include <vtkRenderer.h>

#include "figure/scene/spread.hpp"
#include "figure/scene/stage.hpp"
#include "figure/canvas/vtk_data.hpp"

namespace dotyk::figure {

namespace {

// Pixels as rendered, `lift` pixels nearer to the eye than they are.
Vec3 rendered(const Stage& stage, Vec3 pixel, double lift) {
  pixel[2] += lift;
  for (double& c : pixel) c *= stage.factor;
  return pixel;
}

// The rim of the contact part where it is open, up to the middles of the edges beside.
void add_open_rim(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  std::vector<Vec3> points;
  std::vector<int> lines;
  const std::vector<int> edges = rim(contact.facets, contact.nodes_per_facet);
  for (std::size_t e = 0; e + 1 < edges.size(); e += 2)
    for (const std::size_t end : {e, e + 1}) {
      const ContactNode &own = contact.nodes[static_cast<std::size_t>(edges[end])], &other = contact.nodes[static_cast<std::size_t>(edges[end == e ? e + 1 : e])];
      if (own.status != Status::open) continue;
      const Vec3 p = stage.place(own);
      for (const Vec3& q : {p, plus(p, plus(stage.place(other), p, -1), 0.5)}) {
        lines.push_back(static_cast<int>(points.size()));
        points.push_back(rendered(stage, stage.view.pixel(q), 4));
      }
    }
  if (!points.empty()) add_plain(renderer, poly_data(points, lines, 2), status_colour(Status::open), 0.16 * stage.em * stage.factor);
}

// Each facet, quartered to its nodes, in their colours.
void add_facets(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  const auto each = static_cast<std::size_t>(contact.nodes_per_facet);
  if (each < 3) return;
  for (const Status status : {Status::closed, Status::stick, Status::slip}) {  // open leaves the field to be seen
    std::vector<Vec3> points;
    std::vector<int> quads;
    for (std::size_t f = 0; f + each <= contact.facets.size(); f += each) {
      Vec3 centre{0, 0, 0};
      std::vector<Vec3> corner;
      for (std::size_t k = 0; k < each; ++k) {
        corner.push_back(stage.place(contact.nodes[static_cast<std::size_t>(contact.facets[f + k])]));
        centre = plus(centre, corner.back(), 1.0 / static_cast<double>(each));
      }
      for (std::size_t k = 0; k < each; ++k) {
        if (contact.nodes[static_cast<std::size_t>(contact.facets[f + k])].status != status) continue;
        const Vec3 next = plus(corner[k], plus(corner[(k + 1) % each], corner[k], -1), 0.5);
        const Vec3 last = plus(corner[k], plus(corner[(k + each - 1) % each], corner[k], -1), 0.5);
        for (const Vec3& p : {corner[k], next, centre, last}) {
          quads.push_back(static_cast<int>(points.size()));
          points.push_back(rendered(stage, stage.view.pixel(p), 1.5));
        }
      }
    }
    if (!points.empty()) add_plain(renderer, poly_data(points, quads, 4), status_colour(status));
  }
  add_open_rim(stage, contact, renderer);
}

// Flat arrows that face the eye: a shaft of four corners, a head of four of
// which two coincide.
struct Arrows {
  std::vector<Vec3> points;
  std::vector<int> quads;

  void add(const Stage& stage, const Vec3& tail, const Vec3& head, double width, double tip, double half, double lift) {
    const double length = std::hypot(head[0] - tail[0], head[1] - tail[1]);
    if (!(length > 0.5)) return;
    tip = std::min(tip, 0.7 * length);
    const Vec3 side{-(head[1] - tail[1]) / length, (head[0] - tail[0]) / length, 0};
    const Vec3 neck = plus(head, plus(tail, head, -1), tip / length);
    for (const Vec3& p : {plus(tail, side, width / 2), plus(tail, side, -width / 2), plus(neck, side, -width / 2), plus(neck, side, width / 2),
                          plus(neck, side, half), plus(neck, side, -half), head, head}) {
      quads.push_back(static_cast<int>(points.size()));
      points.push_back(rendered(stage, p, lift));
    }
  }
};

void add_arrows(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  if (!(stage.greatest_pressure > 0)) return;
  const Plan plan = plan_of(contact);
  std::vector<Point> at, in_plan;
  for (const ContactNode& node : contact.nodes) {
    at.push_back(stage.view.flat(stage.place(node)));
    in_plan.push_back(plan(node.position));
  }
  const double em = stage.em, width = std::max(1.3, em / 13), rim = std::max(0.8, em / 28);
  Arrows dark, white;
  for (const std::size_t i : spread(at, in_plan, 0.8 * em)) {
    const ContactNode& node = contact.nodes[i];
    const double share = node.pressure / stage.greatest_pressure;
    if (share < 0.02) continue;
    // As long on the picture as in the plane, whatever the view shortens.
    const Vec3 n = unit(node.normal), head = stage.view.pixel(stage.place(node));
    const double across = std::hypot(dot(n, stage.view.right), dot(n, stage.view.up));
    if (across < 0.05) continue;
    const double length = stage.strip_height() * share / across;
    const Vec3 tail = plus(head, {dot(n, stage.view.right), dot(n, stage.view.up), dot(n, stage.view.towards)}, length);
    const Vec3 back = unit(plus(tail, head, -1));
    dark.add(stage, tail, head, width, 0.42 * em, 0.16 * em, 6);
    white.add(stage, plus(tail, back, rim), plus(head, back, -2 * rim), width + 2 * rim, 0.42 * em + 3 * rim, 0.16 * em + 1.8 * rim, 5);
  }
  if (dark.points.empty()) return;
  add_plain(renderer, poly_data(white.points, white.quads, 4), {255, 255, 255});
  add_plain(renderer, poly_data(dark.points, dark.quads, 4), pressure_line);
}

}  // namespace

void add_contact_surface(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  add_facets(stage, contact, renderer);
  if (stage.arrows()) add_arrows(stage, contact, renderer);
}

}  // namespace dotyk::figure
