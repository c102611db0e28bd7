#pragma once

#include <algorithm>
#include <array>
#include <climits>
#include <vector>

#include "mesh/mesh.hpp"

namespace dotyk::meshfile {

/// The facets of a mesh, found by their corners in any order.
class FacetTable {
 public:
  explicit FacetTable(const mesh::Mesh& mesh) {
    const mesh::ElementTopology& t = mesh.topology();
    entries_.reserve(static_cast<std::size_t>(mesh.cell_count()) * t.facets);
    for (int c = 0; c < mesh.cell_count(); ++c)
      for (int l = 0; l < t.facets; ++l) {
        int nodes[4];
        for (int k = 0; k < t.facet_corners; ++k) nodes[k] = mesh.facet_node({c, l}, k);
        entries_.push_back({key(nodes, t.facet_corners), {c, l}});
      }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.nodes < b.nodes; });
  }

  struct Entry {
    std::array<int, 4> nodes;  ///< ascending
    mesh::Facet facet;
  };

  /// Those with the same corners beside each other.
  const std::vector<Entry>& entries() const { return entries_; }

  /// Facets with these corners: one on the boundary, two within, none elsewhere.
  std::vector<mesh::Facet> find(const int* nodes, int count) const {
    const std::array<int, 4> wanted = key(nodes, count);
    const auto before = [](const Entry& e, const std::array<int, 4>& n) { return e.nodes < n; };
    std::vector<mesh::Facet> found;
    for (auto e = std::lower_bound(entries_.begin(), entries_.end(), wanted, before); e != entries_.end() && e->nodes == wanted; ++e)
      found.push_back(e->facet);
    return found;
  }

 private:
  static std::array<int, 4> key(const int* nodes, int count) {
    std::array<int, 4> result{INT_MAX, INT_MAX, INT_MAX, INT_MAX};
    std::copy(nodes, nodes + count, result.begin());
    std::sort(result.begin(), result.end());
    return result;
  }

  std::vector<Entry> entries_;
};

}  // namespace dotyk::meshfile
