#include <algorithm>
#include <climits>

#include "mesh/mesh.hpp"

namespace dotyk::mesh {

std::vector<int> facet_neighbours(const Mesh& mesh) {
  // The two sides of an inner facet have the same corners: put into buckets by the least, then compared within the few of a bucket.
  const ElementTopology& t = mesh.topology();
  std::vector<std::array<int, 4>> corners(static_cast<std::size_t>(mesh.cell_count()) * t.facets, {INT_MAX, INT_MAX, INT_MAX, INT_MAX});
  const int count = static_cast<int>(corners.size());
  for (int f = 0; f < count; ++f) {
    for (int k = 0; k < t.facet_corners; ++k) corners[f][k] = mesh.facet_node({f / t.facets, f % t.facets}, k);
    std::sort(corners[f].begin(), corners[f].end());
  }
  const Buckets by_least(mesh.node_count(), [&](auto&& put) {
    for (int f = 0; f < count; ++f) put(corners[f][0], f);
  });
  std::vector<int> neighbour(corners.size(), -1);
  for (int f = 0; f < count; ++f)
    for (const int g : by_least[corners[f][0]])
      if (g != f && corners[g] == corners[f]) {
        neighbour[f] = g / t.facets;
        break;
      }
  return neighbour;
}

std::vector<Facet> boundary(const Mesh& mesh) {
  const std::vector<int> neighbour = facet_neighbours(mesh);
  const int facets = mesh.topology().facets;
  std::vector<Facet> result;
  for (std::size_t k = 0; k < neighbour.size(); ++k)
    if (neighbour[k] < 0) result.push_back({static_cast<int>(k) / facets, static_cast<int>(k) % facets});
  return result;
}

std::vector<Facet> select(const Mesh& mesh,
                          const std::function<bool(const Point&, const Point&)>& chosen) {
  std::vector<Facet> result;
  for (const Facet f : boundary(mesh))
    if (chosen(mesh.facet_centre(f), unit(mesh.facet_area_vector(f)))) result.push_back(f);
  return result;
}

}  // namespace dotyk::mesh
