// What happens on the contact boundary: status and pressure.
#include <algorithm>
#include <array>
#include <cmath>

#include <vtkActor.h>
#include <vtkRenderer.h>

#include "stage.hpp"
#include "ticks.hpp"
#include "vtk_data.hpp"

namespace dotyk::figure {

namespace {

constexpr Colour white{255, 255, 255}, pressure_fill{205, 214, 235}, pressure_line{45, 50, 90};
constexpr std::array statuses{Status::open, Status::closed, Status::stick, Status::slip};

Marker status_marker(Status status) {
  switch (status) {
    case Status::open: return Marker::ring;
    case Status::closed: return Marker::disc;
    case Status::stick: return Marker::square;
    case Status::slip: return Marker::triangle;
  }
  return Marker::disc;
}

Vec3 place(const Stage& stage, const ContactNode& node) { return stage.deformed(node.position, node.displacement); }

std::vector<Point> places(const Stage& stage, const ContactPicture& contact) {
  std::vector<Point> at;
  for (const ContactNode& node : contact.nodes) at.push_back(stage.view.flat(place(stage, node)));
  return at;
}

// The top of the pressure ordinate over a node.
Point top(const Stage& stage, const ContactNode& node, Point at) {
  if (!(stage.greatest_pressure > 0)) return at;
  const Point n = stage.view.direction(node.normal);
  const double length = stage.strip_height() * std::max(0.0, node.pressure) / stage.greatest_pressure;
  return {at.x + length * n.x, at.y + length * n.y};
}

void draw_strip(Stage& stage, const ContactPicture& contact) {
  const std::vector<Point> at = places(stage, contact);
  std::vector<Point> tops;
  for (std::size_t i = 0; i < at.size(); ++i) tops.push_back(top(stage, contact.nodes[i], at[i]));
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
  for (const std::size_t i : Stage::spaced(at, 0.55 * stage.em))
    if (loaded(i)) stage.over.line(at[i], tops[i], std::max(0.8, stage.em / 30), pressure_line, 0.6);
}

void draw_arrows(Stage& stage, const ContactPicture& contact) {
  if (!(stage.greatest_pressure > 0)) return;
  const std::vector<Point> at = places(stage, contact);
  // Far arrows first.
  std::vector<std::size_t> order = Stage::spaced(at, 0.8 * stage.em);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return dot(place(stage, contact.nodes[a]), stage.view.towards) < dot(place(stage, contact.nodes[b]), stage.view.towards);
  });
  for (const std::size_t i : order) {
    const ContactNode& node = contact.nodes[i];
    if (node.pressure < 0.02 * stage.greatest_pressure) continue;
    stage.over.arrow(top(stage, node, at[i]), at[i], std::max(1.2, stage.em / 14), 0.42 * stage.em, pressure_line);
  }
}

// Each half of a facet in the colour of its node.
void draw_line(Stage& stage, const ContactPicture& contact) {
  const std::vector<Point> at = places(stage, contact);
  const double width = 0.26 * stage.em;
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t f = 0; f + 1 < contact.facets.size(); f += 2) {
      const auto a = static_cast<std::size_t>(contact.facets[f]), b = static_cast<std::size_t>(contact.facets[f + 1]);
      const Point middle{(at[a].x + at[b].x) / 2, (at[a].y + at[b].y) / 2};
      for (const std::size_t i : {a, b}) {
        const Colour colour = pass == 0 ? white : status_colour(contact.nodes[i].status);
        const double w = pass == 0 ? 1.5 * width : width;
        stage.over.line(at[i], middle, w, colour);
        stage.over.disc(at[i], w / 2, colour);
      }
    }
  for (const std::size_t i : Stage::spaced(at, 0.95 * stage.em)) {
    const Status status = contact.nodes[i].status;
    stage.over.marker(status_marker(status), at[i], 0.55 * stage.em, status_colour(status));
  }
}

// Each facet, quartered to its nodes, in their colours.
void add_surface(Stage& stage, const ContactPicture& contact, vtkRenderer* renderer) {
  const auto each = static_cast<std::size_t>(contact.nodes_per_facet);
  if (each < 3) return;
  const auto at = [&](const Vec3& p) {
    Vec3 q = stage.view.pixel(p);
    q[2] += 2;  // in front of the body's own surface
    for (double& c : q) c *= stage.factor;
    return q;
  };
  for (const Status status : statuses) {
    std::vector<Vec3> points;
    std::vector<int> quads, edges;
    for (std::size_t f = 0; f + each <= contact.facets.size(); f += each) {
      Vec3 centre{0, 0, 0};
      std::vector<Vec3> corner;
      for (std::size_t k = 0; k < each; ++k) {
        corner.push_back(place(stage, contact.nodes[static_cast<std::size_t>(contact.facets[f + k])]));
        centre = plus(centre, corner.back(), 1.0 / static_cast<double>(each));
      }
      for (std::size_t k = 0; k < each; ++k) {
        if (contact.nodes[static_cast<std::size_t>(contact.facets[f + k])].status != status) continue;
        const Vec3 next = plus(corner[k], plus(corner[(k + 1) % each], corner[k], -1), 0.5);
        const Vec3 last = plus(corner[k], plus(corner[(k + each - 1) % each], corner[k], -1), 0.5);
        for (const Vec3& p : {corner[k], next, centre, last}) {
          quads.push_back(static_cast<int>(points.size()));
          points.push_back(at(p));
        }
      }
    }
    if (!points.empty()) add_plain(renderer, poly_data(points, quads, 4), status_colour(status));
  }
}

void label_peak(Stage& stage, const ContactPicture& contact, std::vector<Box>& taken) {
  const ContactNode* peak = nullptr;
  for (const ContactNode& node : contact.nodes)
    if (node.pressure > 0 && (!peak || node.pressure > peak->pressure)) peak = &node;
  if (!peak || peak->pressure < 0.02 * stage.greatest_pressure) return;
  const Point at = stage.view.flat(place(stage, *peak)), tip = top(stage, *peak, at), n = stage.view.direction(peak->normal);
  const std::string text = "max " + number(peak->pressure) + (stage.picture.pressure_unit.empty() ? "" : " " + stage.picture.pressure_unit);
  TextStyle style;
  style.size = 0.85 * stage.em;
  style.across = style.up = Align::middle;
  style.colour = pressure_line;
  style.halo = true;
  const Point size = text_extent(text, style.size);
  const double away_x = std::abs(n.x) * size.x / 2 + 0.35 * stage.em, away_y = std::abs(n.y) * size.y / 2 + 0.3 * stage.em;
  Point centre{tip.x + n.x * away_x, tip.y + n.y * away_y};
  const double margin = 0.3 * stage.em;
  centre.x = std::clamp(centre.x, size.x / 2 + margin, stage.picture.width - size.x / 2 - margin);
  centre.y = std::clamp(centre.y, size.y / 2 + margin, stage.picture.height - size.y / 2 - margin);
  const Box box{centre.x - size.x / 2, centre.y - size.y / 2, centre.x + size.x / 2, centre.y + size.y / 2};
  for (const Box& other : taken)
    if (box.left < other.right && other.left < box.right && box.bottom < other.top && other.bottom < box.top) return;
  taken.push_back(box);
  stage.over.text(centre, text, style);
}

}  // namespace

std::vector<LegendEntry> contact_legend(const Stage& stage) {
  std::array<bool, 4> present{};
  for (const ContactPicture& contact : stage.picture.contacts)
    for (const ContactNode& node : contact.nodes) present[static_cast<std::size_t>(node.status)] = true;
  std::vector<LegendEntry> out;
  const double em = stage.em;
  for (const Status status : statuses) {
    if (!present[static_cast<std::size_t>(status)]) continue;
    out.push_back({status_name(status), [status, em, plane = stage.plane](Canvas& c, const Box& b) {
                     const double middle = (b.bottom + b.top) / 2;
                     if (!plane) {
                       c.box({b.left + 0.4 * em, middle - 0.35 * em, b.right - 0.4 * em, middle + 0.35 * em}, status_colour(status));
                       return;
                     }
                     c.line({b.left, middle}, {b.right, middle}, 0.26 * em, status_colour(status));
                     c.marker(status_marker(status), {(b.left + b.right) / 2, middle}, 0.55 * em, status_colour(status));
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
    out.push_back({"contact pressure", [em](Canvas& c, const Box& b) {
                     const double x = (b.left + b.right) / 2;
                     c.arrow({x, b.top - 0.1 * em}, {x, b.bottom + 0.1 * em}, std::max(1.2, em / 14), 0.42 * em, pressure_line);
                   }});
  return out;
}

void draw_contacts(Stage& stage, vtkRenderer* renderer) {
  for (const ContactPicture& contact : stage.picture.contacts) {
    if (stage.plane) {
      if (stage.strips()) draw_strip(stage, contact);
      if (contact.nodes_per_facet == 2) draw_line(stage, contact);
    } else {
      add_surface(stage, contact, renderer);
    }
    if (stage.arrows()) draw_arrows(stage, contact);
  }
  std::vector<Box> taken;
  if (stage.strips() || stage.arrows())
    for (const ContactPicture& contact : stage.picture.contacts) label_peak(stage, contact, taken);
}

}  // namespace dotyk::figure
