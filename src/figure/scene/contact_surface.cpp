// The contact in space: statuses on the facets, pressure as arrows that
// bodies in front of them hide.
#include <algorithm>
#include <cmath>

#include "figure/scene/shapes.hpp"
#include "figure/scene/spread.hpp"

namespace dotyk::figure {

namespace {

Vec3 middle(const Vec3& p, const Vec3& q) { return plus(p, plus(q, p, -1), 0.5); }

// The rim of the contact part where it is open, up to the middles of the edges beside.
void add_open_rim(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  Shapes lines(stage, 2);
  for (const auto& [a, b] : pairs(rim({contact.facets, contact.nodes_per_facet})))
    for (const auto& [own, other] : {std::pair{a, b}, std::pair{b, a}}) {
      if (contact.nodes[own].status != Status::open) continue;
      const Vec3 p = stage.place(contact.nodes[own]);
      for (const Vec3& q : {p, middle(p, stage.place(contact.nodes[other]))}) lines.add(q, 4);
    }
  lines.show(renderer, status_colour(Status::open), 0.16 * stage.em);
}

// Each facet, quartered to its nodes, in their colours.
void add_facets(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  const int each = contact.nodes_per_facet;
  if (each < 3) return;
  for (const Status status : {Status::closed, Status::stick, Status::slip}) {  // open leaves the field to be seen
    Shapes quads(stage, 4);
    for (std::size_t f = 0; f + each <= contact.facets.size(); f += each) {
      Vec3 centre{0, 0, 0};
      std::vector<Vec3> corner;
      for (int k = 0; k < each; ++k) {
        corner.push_back(stage.place(contact.nodes[contact.facets[f + k]]));
        centre = plus(centre, corner.back(), 1.0 / each);
      }
      for (int k = 0; k < each; ++k) {
        if (contact.nodes[contact.facets[f + k]].status != status) continue;
        const Vec3 next = middle(corner[k], corner[(k + 1) % each]), last = middle(corner[k], corner[(k + each - 1) % each]);
        for (const Vec3& p : {corner[k], next, centre, last}) quads.add(p, 1.5);
      }
    }
    quads.show(renderer, status_colour(status));
  }
  add_open_rim(stage, contact, renderer);
}

// Flat arrows that face the eye: a shaft of four corners, a head of four of
// which two coincide. `half`: of the head's width.
void add_arrow(Shapes& quads, const Vec3& tail, const Vec3& head, double width, double tip, double half, double lift) {
  const double size = std::hypot(head[0] - tail[0], head[1] - tail[1]);
  if (!(size > 0.5)) return;
  tip = std::min(tip, 0.7 * size);
  const Vec3 side{-(head[1] - tail[1]) / size, (head[0] - tail[0]) / size, 0};
  const Vec3 neck = plus(head, plus(tail, head, -1), tip / size);
  for (const Vec3& p : {plus(tail, side, width / 2), plus(tail, side, -width / 2), plus(neck, side, -width / 2), plus(neck, side, width / 2),
                        plus(neck, side, half), plus(neck, side, -half), head, head})
    quads.add_pixel(p, lift);
}

void add_arrows(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  if (!(stage.greatest_pressure > 0)) return;
  const Plan plan = plan_of(contact);
  std::vector<Point> in_plan;
  for (const ContactNode& node : contact.nodes) in_plan.push_back(plan(node.position));
  const double em = stage.em, width = std::max(1.3, em / 13), rim = std::max(0.8, em / 28);
  const View& view = stage.view;
  Shapes dark(stage, 4), white(stage, 4);
  for (const std::size_t i : spread(stage.at(contact.nodes), in_plan, 0.8 * em)) {
    const ContactNode& node = contact.nodes[i];
    const double share = node.pressure / stage.greatest_pressure;
    if (share < 0.02) continue;
    // As long on the picture as in the plane, whatever the view shortens.
    const Vec3 n = unit(node.normal), head = view.pixel(stage.place(node)), seen{dot(n, view.right), dot(n, view.up), dot(n, view.towards)};
    const double across = std::hypot(seen[0], seen[1]);
    if (across < 0.05) continue;
    const Vec3 tail = plus(head, seen, stage.strip_height() * share / across), back = unit(plus(tail, head, -1));
    add_arrow(dark, tail, head, width, 0.42 * em, 0.16 * em, 6);
    add_arrow(white, plus(tail, back, rim), plus(head, back, -2 * rim), width + 2 * rim, 0.42 * em + 3 * rim, 0.16 * em + 1.8 * rim, 5);
  }
  if (dark.empty()) return;
  white.show(renderer, {255, 255, 255});
  dark.show(renderer, pressure_line);
}

}  // namespace

void add_contact_surface(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  add_facets(stage, contact, renderer);
  if (stage.arrows()) add_arrows(stage, contact, renderer);
}

}  // namespace dotyk::figure
