#include "figure/canvas/window.hpp"

#include <algorithm>
#include <cmath>

#include "figure/door/grid_file.hpp"

namespace dotyk::figure {

namespace {

struct Corner {
  double x = 0, y = 0, value = 0;
};
using Polygon = std::vector<Corner>;

Corner corner(const BodyPicture& body, int node, double factor) {
  const auto i = static_cast<std::size_t>(node);
  Corner c{body.points[3 * i], body.points[3 * i + 1], body.values.empty() ? 0 : body.values[i]};
  if (!body.displacement.empty()) c.x += factor * body.displacement[3 * i], c.y += factor * body.displacement[3 * i + 1];
  return c;
}

// The part of a convex polygon where sign (coordinate - bound) <= 0.
Polygon cut(const Polygon& in, double Corner::*coordinate, double bound, double sign) {
  Polygon out;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Corner p = in[i], q = in[(i + 1) % in.size()];
    const double a = sign * (p.*coordinate - bound), b = sign * (q.*coordinate - bound);
    if (a <= 0) out.push_back(p);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
      const double t = a / (a - b);
      out.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.value + t * (q.value - p.value)});
    }
  }
  return out;
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

std::vector<int> cells_near(const BodyPicture& body, double factor, const Window& w) {
  const auto each = static_cast<std::size_t>(nodes_per_cell(body.shape, 1));
  std::vector<int> near;
  for (std::size_t c = 0; c + each <= body.cells.size(); c += each) {
    double left = 1e300, bottom = 1e300, right = -1e300, top = -1e300;
    for (std::size_t k = 0; k < each; ++k) {
      const Corner p = corner(body, body.cells[c + k], factor);
      left = std::min(left, p.x), right = std::max(right, p.x);
      bottom = std::min(bottom, p.y), top = std::max(top, p.y);
    }
    if (left > w[2] || right < w[0] || bottom > w[3] || top < w[1]) continue;
    const auto first = body.cells.begin() + static_cast<std::ptrdiff_t>(c);
    near.insert(near.end(), first, first + static_cast<std::ptrdiff_t>(each));
  }
  return near;
}

Seen seen(const ScenePicture& picture, const Window& w) {
  Seen out;
  for (const BodyPicture& body : picture.bodies) {
    const auto each = static_cast<std::size_t>(nodes_per_cell(body.shape, 1));
    const std::vector<int> cells = cells_near(body, picture.deformation, w);
    for (std::size_t c = 0; c < cells.size(); c += each) {
      Polygon rest;
      for (std::size_t k = 0; k < each; ++k) rest.push_back(corner(body, cells[c + k], picture.deformation));
      rest = cut(rest, &Corner::x, w[0], -1);
      rest = cut(rest, &Corner::x, w[2], 1);
      rest = cut(rest, &Corner::y, w[1], -1);
      rest = cut(rest, &Corner::y, w[3], 1);
      if (!(area(rest) > 0)) continue;
      out.body = true;
      if (body.values.empty()) continue;
      for (const Corner& p : rest)
        if (std::isfinite(p.value)) out.least = std::min(out.least, p.value), out.greatest = std::max(out.greatest, p.value);
    }
  }
  return out;
}

}  // namespace dotyk::figure
