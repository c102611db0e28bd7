#include "figure/canvas/geometry.hpp"

#include <map>

namespace dotyk::figure {

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec3 plus(const Vec3& a, const Vec3& b, double factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

Vec3 part_way(const Vec3& p, const Vec3& q, double t) { return plus(p, plus(q, p, -1), t); }

double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

Vec3 unit(const Vec3& a) {
  const double most = greatest(a);
  if (!(most > 0)) return {0, 0, 0};
  const Vec3 b{a[0] / most, a[1] / most, a[2] / most};  // its square neither overflows nor vanishes
  const double size = length(b);
  return {b[0] / size, b[1] / size, b[2] / size};
}

Point View::direction(const Vec3& d) const {
  const Point p{dot(d, right), dot(d, up)};
  const double size = length(p);
  return size > 1e-9 * std::sqrt(dot(d, d)) && size > 0 ? Point{p.x / size, p.y / size} : Point{0, 0};
}

namespace {

// Edges of polygons, sorted; `single`: those that belong to one polygon only.
std::vector<int> edges_of(const Facets& polygons, bool single) {
  const auto& [nodes, each] = polygons;
  std::vector<std::pair<int, int>> all;
  all.reserve(nodes.size());
  for (std::size_t p = 0; p + each <= nodes.size(); p += each)
    for (int k = 0; k < each; ++k) all.push_back(std::minmax(nodes[p + k], nodes[p + (k + 1) % each]));
  std::sort(all.begin(), all.end());
  std::vector<int> out;
  for (auto first = all.begin(), next = first; first != all.end(); first = next) {
    next = std::find_if(first, all.end(), [&](const auto& edge) { return edge != *first; });
    if (!single || next - first == 1) out.insert(out.end(), {first->first, first->second});
  }
  return out;
}

}  // namespace

double distance(const Segment& segment, Point p) {
  const Point along = segment[1] - segment[0], to = p - segment[0];
  const double square = along.x * along.x + along.y * along.y;
  const double share = square > 0 ? (to.x * along.x + to.y * along.y) / square : 0;
  return length(to - std::clamp(share, 0.0, 1.0) * along);
}

double distance(const Segment& a, const Segment& b) { return std::min({distance(a, b[0]), distance(a, b[1]), distance(b, a[0]), distance(b, a[1])}); }

std::vector<int> unique_edges(const Facets& polygons) { return edges_of(polygons, false); }

std::vector<int> rim(const Facets& polygons) { return edges_of(polygons, true); }

std::vector<std::array<int, 2>> pairs(const std::vector<int>& edges) {
  std::vector<std::array<int, 2>> out;
  for (std::size_t e = 0; e + 1 < edges.size(); e += 2) out.push_back({edges[e], edges[e + 1]});
  return out;
}

std::vector<std::vector<int>> chains(const std::vector<int>& edges) {
  std::map<int, std::vector<std::size_t>> at;  // edges at each node
  for (std::size_t e = 0; 2 * e + 1 < edges.size(); ++e) {
    at[edges[2 * e]].push_back(e);
    at[edges[2 * e + 1]].push_back(e);
  }
  std::vector<bool> used(edges.size() / 2, false);
  std::vector<std::vector<int>> out;
  const auto follow = [&](int start) {
    std::vector<int> chain{start};
    for (bool more = true; more;) {
      more = false;
      for (const std::size_t e : at[chain.back()]) {
        if (used[e]) continue;
        used[e] = more = true;
        chain.push_back(edges[2 * e] == chain.back() ? edges[2 * e + 1] : edges[2 * e]);
        break;
      }
    }
    if (chain.size() > 1) out.push_back(std::move(chain));
  };
  for (const auto& [start, its] : at)
    if (its.size() != 2) follow(start);  // open ends first
  for (const auto& [start, its] : at) follow(start);
  return out;
}

}  // namespace dotyk::figure
