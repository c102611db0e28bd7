// In space the contact mostly hides between the bodies: a plan of it, seen
// along its normal, stands beside the scene.
#include <algorithm>
#include <cmath>

#include "figure/scene/spread.hpp"
#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

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
  const auto paint = [&](std::span<const Point> corners, Status status) {
    stage.over.convex(corners, status_colour(status), status == Status::open ? 0.22 : 1.0);
  };
  for (std::size_t f = 0; f + each <= contact.facets.size(); f += each) {
    std::vector<Point> corner;
    std::vector<Status> status;
    Point centre;
    for (int k = 0; k < each; ++k) {
      corner.push_back(at[contact.facets[f + k]]), status.push_back(contact.nodes[contact.facets[f + k]].status);
      centre = {centre.x + corner[k].x / each, centre.y + corner[k].y / each};
    }
    if (std::count(status.begin(), status.end(), status[0]) == each) {
      paint(corner, status[0]);
      continue;
    }
    for (int k = 0; k < each; ++k)
      paint(std::array{corner[k], 0.5 * (corner[k] + corner[(k + 1) % each]), centre, 0.5 * (corner[k] + corner[(k + each - 1) % each])}, status[k]);
  }
}

}  // namespace

Plan plan_of(const ContactPicture& contact) {
  Vec3 mean{0, 0, 0};
  for (const ContactNode& node : contact.nodes) mean = plus(mean, node.normal);
  const std::size_t axis = std::abs(mean[2]) >= std::max(std::abs(mean[0]), std::abs(mean[1])) ? 2 : std::abs(mean[1]) >= std::abs(mean[0]) ? 1 : 0;
  if (axis == 2) return {0, 1};
  return axis == 1 ? Plan{0, 2} : Plan{1, 2};
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
  if (stage.greatest_pressure > 0 && stage.picture.pressure != PressureStyle::none)
    for (const std::size_t i : spread(at, at, spacing)) {
      const double share = contact->nodes[i].pressure / stage.greatest_pressure;
      if (share > 0.002) stage.over.disc(at[i], 0.45 * spacing * std::sqrt(share), pressure_line);
    }
  draw_shear(stage, *contact, at, plan);
  for (const auto& [a, b] : pairs(rim({contact->facets, contact->nodes_per_facet}))) stage.over.line(at[a], at[b], std::max(1.2, em / 18), outline_ink);

  const double half_w = scale * bounds.width() / 2, half_h = scale * bounds.height() / 2;
  TextStyle style{.size = 0.85 * em, .across = Align::middle, .colour = outline_ink};
  stage.over.text({centre.x, centre.y + half_h + 0.25 * em}, contact->name.empty() ? "contact" : "contact " + contact->name, style);
  style.up = Align::high;
  stage.over.text({centre.x, centre.y - half_h - 0.2 * em}, std::string(1, "xyz"[plan.across]), style);
  if (const std::optional<Label> peak = peak_label(stage, *contact); peak && stage.picture.pressure != PressureStyle::none)
    stage.over.text({centre.x, centre.y - half_h - 1.2 * em}, "pressure " + peak->text, style);
  style.up = Align::middle, style.across = Align::high;
  stage.over.text({centre.x - half_w - 0.35 * em, centre.y}, std::string(1, "xyz"[plan.up]), style);
}

}  // namespace dotyk::figure
