// The contact in space: statuses on the facets, pressure as arrows that bodies in
// front of them hide; or a field on the facets. As it mostly hides between the bodies, a map
// of it stands beside the scene.
#include <iterator>

#include "figure/canvas/sheet.hpp"
#include "figure/scene/contact_map.hpp"
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

// How many pixels before the body the contact is drawn. Where bodies are drawn apart, a magnified deformation may put facets of the contact below the other body's
// surface; as only facets that face the eye are drawn then, they can be lifted by more than that.
double lift(const Stage& stage, const ContactPicture& contact) { return contact.apart ? stage.em : 1.5; }

// The facets that are drawn: all, or those that face the eye where the bodies are drawn apart.
Facets seen_facets(const Stage& stage, const ContactPicture& contact) {
  Facets all{contact.facets, contact.nodes_per_facet};
  if (!contact.apart) return all;
  Facets out{{}, all.each};
  each_polygon(all, [&](std::span<const int> facet) {
    Vec3 mean{0, 0, 0};
    for (const int i : facet) mean = plus(mean, contact.nodes[i].normal);
    if (dot(mean, stage.view.towards) > 0) out.nodes.insert(out.nodes.end(), facet.begin(), facet.end());
  });
  return out;
}

std::vector<Vec3> corners(const Stage& stage, const ContactPicture& contact, std::span<const int> facet) {
  std::vector<Vec3> out;
  for (const int i : facet) out.push_back(stage.place(contact.nodes[i]));
  return out;
}

// The rim of the contact part where it is open, up to the middles of the edges beside.
void add_open_rim(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  Shapes lines(stage, 2);
  for (const auto& [a, b] : pairs(rim(seen_facets(stage, contact))))
    for (const auto& [own, other] : {std::pair{a, b}, std::pair{b, a}}) {
      if (contact.nodes[own].status != Status::open) continue;
      const Vec3 p = stage.place(contact.nodes[own]);
      for (const Vec3& q : {p, part_way(p, stage.place(contact.nodes[other]), 0.5)}) lines.add(q, lift(stage, contact) + 2.5);
    }
  lines.show(renderer, status_colour(Status::open), 0.16 * stage.em);
}

// Each facet, quartered to its nodes, in their colours.
void add_statuses(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  for (const Status status : {Status::closed, Status::stick, Status::slip}) {  // open leaves the field to be seen
    Shapes quads(stage, 4), hatching(stage, 2);
    each_polygon(seen_facets(stage, contact), [&](std::span<const int> facet) {
      const auto parts = quarters(corners(stage, contact, facet));
      for (std::size_t k = 0; k < parts.size(); ++k) {
        if (contact.nodes[facet[k]].status != status) continue;
        std::vector<Vec3> quad;
        for (const Vec3& p : parts[k]) quads.add(p, lift(stage, contact)), quad.push_back(stage.view.pixel(p));
        if (status != Status::slip) continue;
        for (const auto& [p, q] : hatched(std::span<const Vec3>(quad), slip_spacing * stage.em)) hatching.add_pixel(p, lift(stage, contact) + 1), hatching.add_pixel(q, lift(stage, contact) + 1);
      }
    });
    quads.show(renderer, status_colour(status));
    hatching.show(renderer, slip_hatch, slip_line * stage.em);
  }
  add_open_rim(stage, contact, renderer);
}

// A field on the surface; lines between nodes of different statuses.
void add_field(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  std::vector<Vec3> at;
  for (const ContactNode& node : contact.nodes) at.push_back(stage.rendered(stage.view.pixel(stage.place(node)), lift(stage, contact)));
  const Facets facets = seen_facets(stage, contact);
  add_coloured(stage, renderer, poly_data(at, facets), contact.values);
  Shapes borders(stage, 2);
  each_polygon(facets, [&](std::span<const int> facet) {
    const auto parts = quarters(corners(stage, contact, facet));
    for (std::size_t k = 0; k < parts.size(); ++k)
      if (contact.nodes[facet[k]].status != contact.nodes[facet[(k + 1) % parts.size()]].status) borders.add(parts[k][1], lift(stage, contact) + 1.5), borders.add(parts[k][2], lift(stage, contact) + 1.5);
  });
  borders.show(renderer, {255, 255, 255}, 0.16 * stage.em);
}

void add_arrows(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  if (!(stage.greatest_pressure > 0)) return;
  const Plan plan = plan_of(contact);
  std::vector<Point> in_plan;
  for (const ContactNode& node : contact.nodes) in_plan.push_back(plan(node.position));
  const double em = stage.em;
  const View& view = stage.view;
  Arrows arrows(stage, std::max(1.3, em / 13), 0.42 * em);
  for (const std::size_t i : spread(stage.at(contact.nodes), in_plan, 0.8 * em)) {
    const ContactNode& node = contact.nodes[i];
    const double share = node.pressure / stage.greatest_pressure;
    if (share < 0.02) continue;
    // As long on the picture as in the plane, whatever the view shortens.
    const Vec3 n = unit(node.normal), head = view.pixel(stage.place(node)), seen{dot(n, view.right), dot(n, view.up), dot(n, view.towards)};
    const double across = std::hypot(seen[0], seen[1]);
    if (across < 0.05) continue;
    arrows.add(plus(head, seen, stage.strip_height() * share / across), head);
  }
  arrows.show(renderer, pressure_line);
}

constexpr double inset_height = 12, least_inset = 20;  // em; mm of width

// The contact that carries most, of those that have a map; of equals (but for rounding) the first.
const ContactPicture* inset_contact(const ScenePicture& picture) {
  const ContactPicture* best = nullptr;
  double most = 0;
  for (const ContactPicture& contact : picture.contacts) {
    if (!has_map(contact)) continue;
    double peak = 0;
    for (const ContactNode& node : contact.nodes) peak = std::max(peak, node.pressure);
    if (!best || peak > (1 + 1e-6) * most) most = peak, best = &contact;
  }
  return best;
}

}  // namespace

void add_contact_surface(const Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  if (contact.nodes_per_facet > 2) contact.values.empty() ? add_statuses(stage, contact, renderer) : add_field(stage, contact, renderer);
  if (stage.pressures() && contact.values.empty()) add_arrows(stage, contact, renderer);
}

std::optional<ScenePicture> inset_of(const ScenePicture& picture, const ColourScale& scale) {
  const ContactPicture* contact = picture.inset && picture.bodies.front().dimension == 3 ? inset_contact(picture) : nullptr;
  if (!contact) return std::nullopt;
  ScenePicture map = contact_map(*contact);
  const double em = letters(picture);
  map.file = picture.file, map.title = "contact " + contact->name;
  // A field of contacts is hidden between the bodies, so its inset is larger.
  const auto [most, share] = contact->values.empty() ? std::tuple{14.0, 0.36} : std::tuple{20.0, 0.45};
  map.width = static_cast<int>(std::min(most * em, share * picture.width));
  map.printed = printed_width(picture) * map.width / picture.width;
  if (*map.printed < least_inset) return std::nullopt;
  map.length_unit = picture.length_unit;
  map.pressure = picture.pressure, map.shear = picture.shear;
  if (!contact->values.empty()) map.field_signed = picture.field_signed, map.field_range = {scale.low, scale.high};
  map.height = static_cast<int>(inset_height * em);
  // As high as it needs: what it leaves free, or lacks, is known once it is laid out.
  for (int round = 0; round < 2; ++round) {
    Stage tried(map);
    tried.own_legend = tried.own_bar = false;
    map.height = std::clamp(map.height + static_cast<int>(std::ceil(lay_out(tried))), least_side, static_cast<int>(inset_height * em));
  }
  return map;
}

void draw_inset(Stage& stage, Point corner) {
  Stage map(*stage.inset, stage.corner + corner);
  map.own_legend = map.own_bar = false;
  lay_out(map);
  std::vector<Painted> parts = painted(map);
  std::move(parts.begin(), parts.end(), std::back_inserter(stage.insets));
}

}  // namespace dotyk::figure
