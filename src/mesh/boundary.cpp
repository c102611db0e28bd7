#include <algorithm>
#include <climits>

#include "mesh/mesh.hpp"

namespace dotyk::mesh {
namespace {

/// A facet with its sorted corners, so that the two sides of an inner facet compare equal.
struct Key {
  std::array<int, 4> nodes;
  Facet facet;
};

}  // namespace

std::vector<int> facet_neighbours(const Mesh& mesh) {
  // The two sides of an inner facet have one least node: bucket by least node,
  // then compare within the few of a bucket.
  const ElementTopology& t = mesh.topology();
  const std::size_t facet_count = static_cast<std::size_t>(mesh.cell_count()) * t.facets;
  std::vector<int> start(mesh.node_count() + 1, 0);
  auto least = [&](Facet f) {
    int n = mesh.facet_node(f, 0);
    for (int k = 1; k < t.facet_corners; ++k) n = std::min(n, mesh.facet_node(f, k));
    return n;
  };
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int l = 0; l < t.facets; ++l) ++start[least({c, l}) + 1];
  for (int i = 0; i < mesh.node_count(); ++i) start[i + 1] += start[i];
  std::vector<Key> keys(facet_count);
  std::vector<int> fill(start.begin(), start.end() - 1);
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (int l = 0; l < t.facets; ++l) {
      Key key{{INT_MAX, INT_MAX, INT_MAX, INT_MAX}, {c, l}};
      for (int k = 0; k < t.facet_corners; ++k) key.nodes[k] = mesh.facet_node({c, l}, k);
      std::sort(key.nodes.begin(), key.nodes.end());
      keys[fill[key.nodes[0]]++] = key;
    }
  std::vector<int> neighbour(facet_count, -1);
  for (int n = 0; n < mesh.node_count(); ++n)
    for (int i = start[n]; i < start[n + 1]; ++i) {
      int& other = neighbour[static_cast<std::size_t>(keys[i].facet.cell) * t.facets + keys[i].facet.local];
      for (int j = start[n]; j < start[n + 1] && other < 0; ++j)
        if (j != i && keys[j].nodes == keys[i].nodes) other = keys[j].facet.cell;
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
