#include "figure/canvas/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace dotyk::figure {

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec3 plus(const Vec3& a, const Vec3& b, double factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

Vec3 unit(const Vec3& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? Vec3{a[0] / length, a[1] / length, a[2] / length} : Vec3{0, 0, 0};
}

Point View::direction(const Vec3& d) const {
  const Point p{dot(d, right), dot(d, up)};
  const double length = std::hypot(p.x, p.y);
  return length > 1e-9 * std::sqrt(dot(d, d)) && length > 0 ? Point{p.x / length, p.y / length} : Point{0, 0};
}

Vec3 node(const BodyPicture& body, std::size_t i, double factor) {
  Vec3 p{body.points[3 * i], body.points[3 * i + 1], body.points[3 * i + 2]};
  if (!body.displacement.empty())
    for (std::size_t c = 0; c < 3; ++c) p[c] += factor * body.displacement[3 * i + c];
  return p;
}

namespace {

// The facets of a cell, by its corners; -1 pads.
struct CellFacets {
  std::size_t corners;
  int each;
  std::vector<std::array<int, 4>> facets;
};

const CellFacets& facets_of(CellShape shape) {
  static const CellFacets triangle{3, 2, {{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 0, -1, -1}}};
  static const CellFacets quad{4, 2, {{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 3, -1, -1}, {3, 0, -1, -1}}};
  static const CellFacets tetrahedron{4, 3, {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}}};
  static const CellFacets hexahedron{8, 4, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  switch (shape) {
    case CellShape::triangle: return triangle;
    case CellShape::quad: return quad;
    case CellShape::tetrahedron: return tetrahedron;
    case CellShape::hexahedron: return hexahedron;
  }
  return triangle;
}

}  // namespace

Facets boundary(const BodyPicture& body) {
  if (!body.facets.empty()) return {body.facets, body.nodes_per_facet};
  const CellFacets& cell = facets_of(body.shape);
  struct Seen {
    std::array<int, 4> sorted, nodes;
  };
  std::vector<Seen> all;
  all.reserve(body.cells.size() / cell.corners * cell.facets.size());
  for (std::size_t c = 0; c + cell.corners <= body.cells.size(); c += cell.corners)
    for (const std::array<int, 4>& facet : cell.facets) {
      Seen seen;
      for (std::size_t k = 0; k < 4; ++k) seen.nodes[k] = facet[k] < 0 ? -1 : body.cells[c + static_cast<std::size_t>(facet[k])];
      seen.sorted = seen.nodes;
      std::sort(seen.sorted.begin(), seen.sorted.end());
      all.push_back(seen);
    }
  std::stable_sort(all.begin(), all.end(), [](const Seen& a, const Seen& b) { return a.sorted < b.sorted; });
  Facets out{{}, cell.each};
  for (std::size_t i = 0; i < all.size();) {
    std::size_t j = i + 1;
    while (j < all.size() && all[j].sorted == all[i].sorted) ++j;
    if (j == i + 1) out.nodes.insert(out.nodes.end(), all[i].nodes.begin(), all[i].nodes.begin() + cell.each);
    i = j;
  }
  return out;
}

namespace {

// Every edge of every polygon as one number, least node first, sorted.
std::vector<std::uint64_t> edge_keys(const std::vector<int>& polygons, int each) {
  std::vector<std::uint64_t> keys;
  keys.reserve(polygons.size());
  const auto n = static_cast<std::size_t>(each);
  for (std::size_t p = 0; p + n <= polygons.size(); p += n)
    for (std::size_t k = 0; k < n; ++k) {
      const auto [a, b] = std::minmax(polygons[p + k], polygons[p + (k + 1) % n]);
      keys.push_back(static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint64_t>(b));
    }
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::vector<int> nodes_of(const std::vector<std::uint64_t>& keys) {
  std::vector<int> edges;
  edges.reserve(2 * keys.size());
  for (const std::uint64_t key : keys) {
    edges.push_back(static_cast<int>(key >> 32));
    edges.push_back(static_cast<int>(key & 0xffffffffu));
  }
  return edges;
}

}  // namespace

std::vector<int> unique_edges(const std::vector<int>& polygons, int each) {
  std::vector<std::uint64_t> keys = edge_keys(polygons, each);
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  return nodes_of(keys);
}

std::vector<int> rim(const std::vector<int>& polygons, int each) {
  const std::vector<std::uint64_t> keys = edge_keys(polygons, each);
  std::vector<std::uint64_t> single;
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t j = i + 1;
    while (j < keys.size() && keys[j] == keys[i]) ++j;
    if (j == i + 1) single.push_back(keys[i]);
    i = j;
  }
  return nodes_of(single);
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

void Bounds::add(Point p) {
  left = std::min(left, p.x), right = std::max(right, p.x);
  bottom = std::min(bottom, p.y), top = std::max(top, p.y);
}

void Bounds::merge(const Bounds& b) {
  if (!b.empty()) add(Point{b.left, b.bottom}), add(Point{b.right, b.top});
}

}  // namespace dotyk::figure
