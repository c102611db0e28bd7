// What happens on the contact boundary: status and pressure.
#include <algorithm>
#include <array>
#include <cmath>

#include "figure/scene/stage.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour rim_colour{255, 255, 255}, pressure_fill{205, 214, 235};
constexpr std::array statuses{Status::open, Status::closed, Status::stick, Status::slip};

std::vector<Point> places(const Stage& stage, const ContactPicture& contact) {
  std::vector<Point> at;
  for (const ContactNode& node : contact.nodes) at.push_back(stage.view.flat(stage.place(node)));
  return at;
}

void draw_strip(Stage& stage, const ContactPicture& contact) {
  const std::vector<Point> at = places(stage, contact);
  std::vector<Point> tops;
  for (std::size_t i = 0; i < at.size(); ++i) tops.push_back(pressure_tip(stage, contact.nodes[i], at[i]));
  const double width = std::max(1.2, stage.em / 14);
  const auto loaded = [&](std::size_t i) { return contact.nodes[i].pressure > 0; };
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t f = 0; f + 1 < contact.facets.size(); f += 2) {
      const auto a = static_cast<std::size_t>(contact.facets[f]), b = static_cast<std::size_t>(contact.facets[f + 1]);
      if (!loaded(a) && !loaded(b)) continue;
      if (pass == 0) {
        stage.over.convex(std::array<Point, 4>{{at[a], at[b], tops[b], tops[a]}}, pressure_fill, 0.72);
      } else {
        stage.over.line(tops[a], tops[b], width, pressure_line);
        for (const std::size_t i : {a, b}) stage.over.disc(tops[i], width / 2, pressure_line);
      }
    }
  for (const std::size_t i : stage.spaced(at, 0.55 * stage.em))
    if (loaded(i)) stage.over.line(at[i], tops[i], std::max(0.8, stage.em / 30), pressure_line, 0.6);
}

void draw_arrows(Stage& stage, const ContactPicture& contact) {
  if (!(stage.greatest_pressure > 0)) return;
  const std::vector<Point> at = places(stage, contact);
  for (const std::size_t i : stage.spaced(at, 0.8 * stage.em)) {
    const ContactNode& node = contact.nodes[i];
    if (node.pressure < 0.02 * stage.greatest_pressure) continue;
    stage.over.arrow(pressure_tip(stage, node, at[i]), at[i], std::max(1.2, stage.em / 14), 0.42 * stage.em, pressure_line, std::max(0.8, stage.em / 30));
  }
}

// Too short for markers: a joint of one brick among hundreds.
bool is_short(const Stage& stage, const std::vector<Point>& at) {
  Point low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
  for (const Point& p : at) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return !at.empty() && std::hypot(high.x - low.x, high.y - low.y) < 4 * stage.em;
}

constexpr double wide = 0.26, thin = 0.15;  // lines with markers and without, in em

bool all_short(const Stage& stage) {
  const auto& contacts = stage.picture.contacts;
  return std::all_of(contacts.begin(), contacts.end(), [&](const ContactPicture& c) { return is_short(stage, places(stage, c)); });
}

// Each half of a facet in the colour of its node.
void draw_line(Stage& stage, const ContactPicture& contact) {
  const std::vector<Point> at = places(stage, contact);
  const bool markers = !is_short(stage, at);
  const double width = (markers ? wide : thin) * stage.em;
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t f = 0; f + 1 < contact.facets.size(); f += 2) {
      const auto a = static_cast<std::size_t>(contact.facets[f]), b = static_cast<std::size_t>(contact.facets[f + 1]);
      const Point middle{(at[a].x + at[b].x) / 2, (at[a].y + at[b].y) / 2};
      for (const std::size_t i : {a, b}) {
        const Colour colour = pass == 0 ? rim_colour : status_colour(contact.nodes[i].status);
        const double w = pass == 0 ? 1.5 * width : width;
        stage.over.line(at[i], middle, w, colour);
        stage.over.disc(at[i], w / 2, colour);
      }
    }
  if (!markers) return;
  for (const std::size_t i : stage.spaced(at, 0.95 * stage.em, 0.36 * stage.em)) {
    const Status status = contact.nodes[i].status;
    stage.over.marker(status_marker(status), at[i], 0.55 * stage.em, status_colour(status));
  }
}

// A magnification draws the sides of a closed contact of two bodies apart, or into each other, by m − 1 times their gap
// at rest: a band in the colour of the status joins what touches.
void draw_joint(Stage& stage, const ContactPicture& contact) {
  const auto across = [&](const ContactNode& node) {
    return stage.view.flat(plus(stage.place(node), node.normal, (1 - stage.picture.deformation) * node.rest_gap));
  };
  for (std::size_t f = 0; f + 1 < contact.facets.size(); f += 2) {
    const ContactNode &a = contact.nodes[static_cast<std::size_t>(contact.facets[f])], &b = contact.nodes[static_cast<std::size_t>(contact.facets[f + 1])];
    const auto middle = [](Point p, Point q) { return Point{(p.x + q.x) / 2, (p.y + q.y) / 2}; };
    const Point own = middle(stage.view.flat(stage.place(a)), stage.view.flat(stage.place(b))), other = middle(across(a), across(b));
    for (const ContactNode* node : {&a, &b})
      if (node->status != Status::open && node->rest_gap != 0)
        stage.over.convex(std::array<Point, 4>{{stage.view.flat(stage.place(*node)), own, other, across(*node)}}, status_colour(node->status), 0.45);
  }
}

}  // namespace

std::vector<LegendEntry> contact_legend(const Stage& stage) {
  std::array<bool, 4> present{};
  for (const ContactPicture& contact : stage.picture.contacts) {
    const std::vector<bool> seen = stage.shown(contact);
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (seen[i]) present[static_cast<std::size_t>(contact.nodes[i].status)] = true;
  }
  std::vector<LegendEntry> out;
  const double em = stage.em;
  const bool markers = !stage.plane || !all_short(stage);
  for (const Status status : statuses) {
    if (!present[static_cast<std::size_t>(status)]) continue;
    out.push_back({status_name(status), [status, em, markers, plane = stage.plane](Canvas& c, const Box& b) {
                     const double middle = (b.bottom + b.top) / 2;
                     if (!plane) {
                       const Box sample{b.left + 0.4 * em, middle - 0.35 * em, b.right - 0.4 * em, middle + 0.35 * em};
                       if (status != Status::open) return c.box(sample, status_colour(status));
                       return c.polyline(std::array<Point, 4>{{{sample.left, sample.bottom}, {sample.right, sample.bottom}, {sample.right, sample.top}, {sample.left, sample.top}}},
                                         0.16 * em, status_colour(status), {}, true);
                     }
                     c.line({b.left, middle}, {b.right, middle}, (markers ? wide : thin) * em, status_colour(status));
                     if (markers) c.marker(status_marker(status), {(b.left + b.right) / 2, middle}, 0.55 * em, status_colour(status));
                   }});
  }
  if (stage.greatest_pressure > 0 && stage.strips())
    out.push_back({"contact pressure", [em](Canvas& c, const Box& b) {
                     const double low = (b.bottom + b.top) / 2 - 0.3 * em, w = b.width();
                     std::array<Point, 9> hill;
                     for (std::size_t i = 0; i < hill.size(); ++i) {
                       const double t = static_cast<double>(i) / 8;
                       hill[i] = {b.left + w * t, low + 0.7 * em * std::sqrt(std::max(0.0, 4 * t * (1 - t)))};
                     }
                     c.convex(hill, pressure_fill, 0.9);
                     c.polyline(hill, std::max(1.2, em / 14), pressure_line);
                   }});
  if (stage.greatest_pressure > 0 && stage.arrows())
    out.push_back({"contact pressure", [em, dots = inset_width(stage) > 0](Canvas& c, const Box& b) {
                     const double x = (b.left + b.right) / 2 - (dots ? 0.4 * em : 0);
                     c.arrow({x, b.top - 0.1 * em}, {x, b.bottom + 0.1 * em}, std::max(1.2, em / 14), 0.42 * em, pressure_line);
                     if (dots) c.disc({x + 0.9 * em, (b.bottom + b.top) / 2}, 0.24 * em, pressure_line);
                   }});
  for (LegendEntry& entry : shear_legend(stage)) out.push_back(std::move(entry));
  return out;
}

void draw_contacts(Stage& stage, vtkRenderer* renderer) {
  for (const ContactPicture& contact : stage.picture.contacts) {
    if (stage.plane) {
      if (stage.strips()) draw_strip(stage, contact);
      if (contact.nodes_per_facet == 2) draw_joint(stage, contact);
      if (contact.nodes_per_facet == 2) draw_line(stage, contact);
      if (stage.arrows()) draw_arrows(stage, contact);
      draw_shear(stage, contact);
    } else {
      add_contact_surface(stage, contact, renderer);
    }
  }
  std::vector<Box> taken;
  // In space the plan beside the scene says it.
  if ((stage.strips() || stage.arrows()) && inset_width(stage) == 0)
    for (const ContactPicture& contact : stage.picture.contacts) {
      const std::optional<PeakLabel> label = peak_label(stage, contact);
      if (!label) continue;
      const Box& box = label->box;
      const bool free = std::none_of(taken.begin(), taken.end(), [&](const Box& other) {
        return box.left < other.right && other.left < box.right && box.bottom < other.top && other.bottom < box.top;
      });
      if (!free) continue;
      taken.push_back(box);
      TextStyle style;
      style.size = label->size;
      style.across = style.up = Align::middle;
      style.colour = pressure_line;
      style.halo = true;
      stage.over.text({(box.left + box.right) / 2, (box.bottom + box.top) / 2}, label->text, style);
    }
}

}  // namespace dotyk::figure
