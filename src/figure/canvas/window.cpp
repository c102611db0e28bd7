#include "figure/canvas/window.hpp"

namespace dotyk::figure {

namespace {

struct Corner : Point {
  double value = 0;
  friend Corner part_way(const Corner& p, const Corner& q, double t) { return {part_way(Point{p}, Point{q}, t), p.value + t * (q.value - p.value)}; }
};
using Polygon = std::vector<Corner>;

Corner corner(const BodyPicture& body, int i, double factor) {
  const Vec3 p = body.node(i, factor);
  return {{p[0], p[1]}, body.values.empty() ? 0 : body.values[i]};
}

double area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner p = polygon[i], q = polygon[(i + 1) % polygon.size()], o = polygon.front();
    twice += (p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x);
  }
  return std::abs(twice) / 2;
}

}  // namespace

std::vector<int> cells_near(const BodyPicture& body, double factor, const Box& w) {
  const int each = nodes_per_cell(body.shape, 1), count = static_cast<int>(body.cells.size()) / each;
  std::vector<int> near;
  for (int c = 0; c < count; ++c) {
    Bounds bounds;
    for (int k = 0; k < each; ++k) bounds.add(corner(body, body.cells[static_cast<std::size_t>(c) * each + k], factor));
    if (bounds.left <= w.right && bounds.right >= w.left && bounds.bottom <= w.top && bounds.top >= w.bottom) near.push_back(c);
  }
  return near;
}

Seen seen(const ScenePicture& picture, const Box& window) {
  Seen out;
  for (const BodyPicture& body : picture.bodies) {
    const std::size_t each = nodes_per_cell(body.shape, 1);
    for (const int c : cells_near(body, picture.deformation, window)) {
      Polygon polygon;
      for (std::size_t k = 0; k < each; ++k) polygon.push_back(corner(body, body.cells[c * each + k], picture.deformation));
      const Polygon part = cropped(std::move(polygon), window);
      if (!(area(part) > 0)) continue;
      out.body = true;
      if (!body.cell_values.empty()) out.add(body.cell_values[c]);
      if (body.values.empty()) continue;
      for (const Corner& p : part) out.add(p.value);
    }
  }
  // The surface of a contact on its map.
  for (const ContactPicture& contact : picture.contacts)
    for (std::size_t f = 0; contact.nodes_per_facet > 2 && !out.body && f < contact.facets.size(); f += contact.nodes_per_facet) {
      Polygon polygon;
      for (int k = 0; k < contact.nodes_per_facet; ++k) polygon.push_back({{contact.nodes[contact.facets[f + k]].position[0], contact.nodes[contact.facets[f + k]].position[1]}});
      out.body = area(cropped(std::move(polygon), window)) > 0;
    }
  return out;
}

}  // namespace dotyk::figure
