#include "contact/projection.hpp"

#include <algorithm>
#include <cmath>

#include "contact/contact_row.hpp"

namespace dotyk::contact {
namespace {

using mesh::Point;
using mesh::dot;
using mesh::minus;

double cross(const Flat& a, const Flat& b) { return a[0] * b[1] - a[1] * b[0]; }

/// (ξ, η) in [0, 1]² of the bilinear map of four corners at x, by Newton's method; one step for a parallelogram.
Flat bilinear_inverse(const std::array<Flat, 4>& at, const Flat& x) {
  Flat r{0.5, 0.5};
  for (int step = 0; step < 30; ++step) {
    const Flat bottom = at[1] - at[0], top = at[2] - at[3], left = at[3] - at[0], right = at[2] - at[1];
    const Flat value = at[0] + r[0] * bottom + r[1] * left + r[0] * r[1] * (top - bottom) - x;
    const Flat along = bottom + r[1] * (top - bottom), up = left + r[0] * (right - left);
    const double determinant = cross(along, up);
    if (determinant == 0) break;
    const double d0 = cross(value, up) / determinant, d1 = cross(along, value) / determinant;
    r[0] -= d0, r[1] -= d1;
    if (std::abs(d0) + std::abs(d1) < 1e-15) break;
  }
  return r;
}

std::vector<Flat> common_segment(const Shadow& a, const Shadow& b) {
  const auto low = [](const Shadow& s) { return std::min(s.at[0][0], s.at[1][0]); };
  const auto high = [](const Shadow& s) { return std::max(s.at[0][0], s.at[1][0]); };
  const double from = std::max(low(a), low(b)), to = std::min(high(a), high(b));
  if (!(from < to)) return {};
  return {{from, 0}, {to, 0}};
}

}  // namespace

View::View(const Point& o, const Point& n, int dimension) : origin(o), normal(n) {
  const std::vector<Point> t = tangents(n, dimension);
  std::copy(t.begin(), t.end(), axis.begin());
}

Flat View::flat(const Point& x) const {
  const Point d = minus(x, origin);
  return {dot(d, axis[0]), dot(d, axis[1])};
}

double View::height(const Point& x) const {
  return dot(minus(x, origin), normal);
}

Shadow::Shadow(const mesh::Mesh& mesh, mesh::Facet facet, const View& view)
    : corners(mesh.topology().facet_corners), nodes(mesh.topology().nodes_per_facet) {
  for (int a = 0; a < corners; ++a) {
    const Point x = mesh.point(mesh.facet_node(facet, a));
    at[a] = view.flat(x);
    height[a] = view.height(x);
  }
  double area = 0;
  for (int a = 0; a < corners; ++a) area += cross(at[a], at[(a + 1) % corners]);
  reversed = corners > 2 && area < 0;
  if (!reversed) return;
  std::reverse(at.begin(), at.begin() + corners);
  std::reverse(height.begin(), height.begin() + corners);
}

std::array<double, 4> Shadow::hats(const Flat& x) const {
  std::array<double, 4> s{};
  if (corners == 2) {
    s[1] = (x[0] - at[0][0]) / (at[1][0] - at[0][0]);
    s[0] = 1 - s[1];
    return s;
  }
  if (corners == 3) {
    const double whole = cross(at[1] - at[0], at[2] - at[0]);
    s[1] = cross(x - at[0], at[2] - at[0]) / whole;
    s[2] = cross(at[1] - at[0], x - at[0]) / whole;
    s[0] = 1 - s[1] - s[2];
  } else {
    const Flat r = bilinear_inverse(at, x);
    s = {(1 - r[0]) * (1 - r[1]), r[0] * (1 - r[1]), r[0] * r[1], (1 - r[0]) * r[1]};
  }
  if (reversed) std::reverse(s.begin(), s.begin() + corners);
  return s;
}

std::array<double, mesh::kMostFacetNodes> Shadow::shape(const Flat& x) const {
  std::array<double, mesh::kMostFacetNodes> s{};
  const std::array<double, 4> l = hats(x);
  if (nodes == corners) {
    std::copy(l.begin(), l.end(), s.begin());
  } else if (corners == 4) {
    // Products of quadratic functions of r, t in [0, 1], values at 0, 1 and 1/2; the corners are (0,0) (1,0) (1,1) (0,1).
    const double r = l[1] + l[2], t = l[2] + l[3];
    const double u[3] = {(1 - r) * (1 - 2 * r), r * (2 * r - 1), 4 * r * (1 - r)}, v[3] = {(1 - t) * (1 - 2 * t), t * (2 * t - 1), 4 * t * (1 - t)};
    s = {u[0] * v[0], u[1] * v[0], u[1] * v[1], u[0] * v[1], u[2] * v[0], u[1] * v[2], u[2] * v[1], u[0] * v[2], u[2] * v[2]};
  } else {
    for (int a = 0; a < corners; ++a) s[a] = l[a] * (2 * l[a] - 1);
    for (int k = corners; k < nodes; ++k) s[k] = 4 * l[k - corners] * l[(k - corners + 1) % corners];
  }
  return s;
}

bool Shadow::holds(const Flat& x, double tolerance) const {
  if (corners == 2) {
    const auto [low, high] = std::minmax(at[0][0], at[1][0]);
    const double rim = tolerance * (high - low);
    return x[0] >= low - rim && x[0] <= high + rim;
  }
  const double width = std::sqrt(size());
  for (int a = 0; a < corners; ++a) {
    const Flat edge = at[(a + 1) % corners] - at[a];
    if (cross(edge, x - at[a]) < -tolerance * width * edge.norm()) return false;
  }
  return true;
}

double Shadow::height_at(const Flat& x) const {
  const std::array<double, 4> s = hats(x);
  double sum = 0;
  for (int a = 0; a < corners; ++a) sum += s[a] * height[reversed ? corners - 1 - a : a];
  return sum;
}

double Shadow::size() const { return contact::size({at.begin(), at.begin() + corners}); }

bool Shadow::polynomial() const {
  if (corners != 4) return true;
  return (at[0] - at[1] + at[2] - at[3]).norm() < 1e-12 * std::sqrt(size());
}

std::vector<Flat> common(const Shadow& a, const Shadow& b) {
  if (a.corners == 2) return common_segment(a, b);
  std::vector<Flat> polygon(a.at.begin(), a.at.begin() + a.corners);
  for (int k = 0; k < b.corners && !polygon.empty(); ++k) {
    const Flat from = b.at[k], edge = b.at[(k + 1) % b.corners] - from;
    std::vector<Flat> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Flat p = polygon[i], q = polygon[(i + 1) % polygon.size()];
      const double inside_p = cross(edge, p - from), inside_q = cross(edge, q - from);
      if (inside_p >= 0) kept.push_back(p);
      if ((inside_p >= 0) == (inside_q >= 0)) continue;
      const double t = inside_p / (inside_p - inside_q);
      kept.push_back(p + t * (q - p));
    }
    polygon = std::move(kept);
  }
  return polygon.size() > 2 ? polygon : std::vector<Flat>{};
}

double size(const std::vector<Flat>& polygon) {
  if (polygon.size() == 2) return (polygon[1] - polygon[0]).norm();
  double twice = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return twice / 2;
}

Flat centre(const std::vector<Flat>& polygon) {
  Flat sum{0, 0};
  for (const Flat& p : polygon) sum += p / static_cast<double>(polygon.size());
  return sum;
}

FlatQuadrature::FlatQuadrature(int count) : rule_(algebra::gauss(count)), collapsed_(algebra::gauss(count, 1)) {}

std::vector<FlatQuadrature::At> FlatQuadrature::points(const std::vector<Flat>& polygon) const {
  std::vector<At> points;
  const auto at = [](const Flat& p, const Flat& q, double t) -> Flat { return p + t * (q - p); };
  if (polygon.size() == 2) {
    for (Eigen::Index i = 0; i < rule_.points.size(); ++i)
      points.push_back({at(polygon[0], polygon[1], rule_.points[i]), size(polygon) * rule_.weights[i]});
    return points;
  }
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const double twice = cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
    for (Eigen::Index i = 0; i < rule_.points.size(); ++i)
      for (Eigen::Index j = 0; j < rule_.points.size(); ++j)
        points.push_back({at(polygon[0], at(polygon[k], polygon[k + 1], rule_.points[j]), collapsed_.points[i]),
                          twice * collapsed_.weights[i] * rule_.weights[j]});
  }
  return points;
}

}  // namespace dotyk::contact
