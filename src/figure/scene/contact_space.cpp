// The contact in space: statuses on the facets, pressure as arrows that bodies in
// front of them hide. As it mostly hides between the bodies, a plan of it, seen along
// its normal, stands beside the scene.
#include "figure/scene/shapes.hpp"

namespace dotyk::figure {

namespace {

// The coordinates that span the plan of a contact: those across the normal, never mirrored.
struct Plan {
  std::size_t across, up;
  Point operator()(const Vec3& p) const { return {p[across], p[up]}; }
};

Plan plan_of(const ContactPicture& contact) {
  Vec3 mean{0, 0, 0};
  for (const ContactNode& node : contact.nodes) mean = plus(mean, node.normal);
  const std::size_t axis = std::abs(mean[2]) >= std::max(std::abs(mean[0]), std::abs(mean[1])) ? 2 : std::abs(mean[1]) >= std::abs(mean[0]) ? 1 : 0;
  if (axis == 2) return {0, 1};
  return axis == 1 ? Plan{0, 2} : Plan{1, 2};
}

// The part of a facet that is next to its corner k.
template <class P>
std::array<P, 4> quarter(const std::vector<P>& corner, const P& centre, std::size_t k) {
  const std::size_t n = corner.size();
  return {corner[k], part_way(corner[k], corner[(k + 1) % n], 0.5), centre, part_way(corner[k], corner[(k + n - 1) % n], 0.5)};
}

// The rim of the contact part where it is open, up to the middles of the edges beside.
void add_open_rim(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  Shapes lines(stage, 2);
  for (const auto& [a, b] : pairs(rim({contact.facets, contact.nodes_per_facet})))
    for (const auto& [own, other] : {std::pair{a, b}, std::pair{b, a}}) {
      if (contact.nodes[own].status != Status::open) continue;
      const Vec3 p = stage.place(contact.nodes[own]);
      for (const Vec3& q : {p, part_way(p, stage.place(contact.nodes[other]), 0.5)}) lines.add(q, 4);
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
        for (const Vec3& p : quarter(corner, centre, k)) quads.add(p, 1.5);
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
  const Vec3 neck = part_way(head, tail, tip / size);
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

constexpr Colour outline_ink{30, 30, 30};

// The contact that carries most, of those that have facets; of equals (but for rounding) the first.
const ContactPicture* inset_contact(const ScenePicture& picture) {
  const ContactPicture* best = nullptr;
  double most = 0;
  for (const ContactPicture& contact : picture.contacts) {
    if (contact.nodes_per_facet < 3 || contact.facets.empty()) continue;
    double peak = 0;
    for (const ContactNode& node : contact.nodes) peak = std::max(peak, node.pressure);
    if (!best || peak > (1 + 1e-6) * most) most = peak, best = &contact;
  }
  return best;
}

void fill(Stage& stage, const ContactPicture& contact, const std::vector<Point>& at) {
  const int each = contact.nodes_per_facet;
  for (std::size_t f = 0; f + each <= contact.facets.size(); f += each) {
    std::vector<Point> corner;
    Point centre;
    for (int k = 0; k < each; ++k) {
      corner.push_back(at[contact.facets[f + k]]);
      centre = centre + 1.0 / each * corner.back();
    }
    for (int k = 0; k < each; ++k) {
      const Status status = contact.nodes[contact.facets[f + k]].status;
      stage.over.convex(quarter(corner, centre, k), status_colour(status), status == Status::open ? 0.22 : 1.0);
    }
  }
}

}  // namespace

void add_contact_surface(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  add_facets(stage, contact, renderer);
  if (stage.pressures()) add_arrows(stage, contact, renderer);
}

double inset_width(const Stage& stage) {
  if (stage.plane || !inset_contact(stage.picture)) return 0;
  return std::min(10.5 * stage.em, 0.3 * stage.picture.width);
}

void draw_inset(Stage& stage, const Box& room) {
  const ContactPicture* contact = inset_contact(stage.picture);
  if (stage.plane || !contact) return;
  const double em = stage.em;
  const Plan plan = plan_of(*contact);
  Bounds bounds;
  for (const ContactNode& node : contact->nodes) bounds.add(plan(node.position));
  // Title above, names of the axes to the left and below.
  const Box plot{room.left + 0.9 * em, room.bottom + 2.2 * em, room.right - 0.2 * em, room.top - 1.5 * em};
  const double scale = std::min(plot.width() / std::max(bounds.width(), 1e-300), plot.height() / std::max(bounds.height(), 1e-300));
  const Point centre{plot.centre().x, plot.top - scale * bounds.height() / 2};
  std::vector<Point> at;
  for (const ContactNode& node : contact->nodes) at.push_back(centre + scale * (plan(node.position) - bounds.centre()));
  fill(stage, *contact, at);

  // Dots whose area is the pressure.
  const double spacing = 0.55 * em;
  if (stage.greatest_pressure > 0 && stage.pressures())
    for (const std::size_t i : spread(at, at, spacing)) {
      const double share = contact->nodes[i].pressure / stage.greatest_pressure;
      if (share > 0.002) stage.over.disc(at[i], 0.45 * spacing * std::sqrt(share), pressure_line);
    }
  draw_shear(stage, *contact, at, [&](const std::vector<Point>& places) { return spread(places, places, 0.85 * em); }, [&](std::size_t i) {
    const Point half = 0.5 * em / stage.greatest_shear * plan(contact->nodes[i].shear);
    return std::array{at[i] - half, at[i] + half};
  });
  for (const auto& [a, b] : pairs(rim({contact->facets, contact->nodes_per_facet}))) stage.over.line(at[a], at[b], std::max(1.2, em / 18), outline_ink);

  const double half_w = scale * bounds.width() / 2, half_h = scale * bounds.height() / 2;
  TextStyle style{.size = 0.85 * em, .across = Align::middle, .colour = outline_ink};
  stage.over.text({centre.x, centre.y + half_h + 0.25 * em}, contact->name.empty() ? "contact" : "contact " + contact->name, style);
  style.up = Align::high;
  stage.over.text({centre.x, centre.y - half_h - 0.2 * em}, std::string(1, "xyz"[plan.across]), style);
  if (const std::optional<Label> peak = peak_label(stage, *contact); peak && stage.pressures())
    stage.over.text({centre.x, centre.y - half_h - 1.2 * em}, "pressure " + peak->text, style);
  style.up = Align::middle, style.across = Align::high;
  stage.over.text({centre.x - half_w - 0.35 * em, centre.y}, std::string(1, "xyz"[plan.up]), style);
}

}  // namespace dotyk::figure
