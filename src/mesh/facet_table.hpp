#pragma once

#include <algorithm>
#include <array>
#include <climits>
#include <span>
#include <vector>

#include "base/buckets.hpp"
#include "base/parallel.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::mesh {

/// The facets of a mesh's cells, facet l of cell c as number c · facets + l, found by their corners in any order. The mesh must outlive it.
class FacetTable {
 public:
  using Corners = std::array<int, 4>;  ///< ascending; INT_MAX behind them
  static constexpr int kFewCells = 50'000;  ///< not worth a thread

  explicit FacetTable(const Mesh& mesh)
      : mesh_(mesh), by_least_(mesh.node_count(), [&](auto&& put) {
          for (int f = 0; f < count(); ++f) put(least_corner(f), f);
        }) {
    others_.resize(static_cast<std::size_t>(count()));
    parallel_ranges(mesh.node_count(), threads_for(mesh.cell_count(), kFewCells), [&](int, int first, int end) {
      for (int node = first; node < end; ++node) {
        auto others = others_.begin() + by_least_.before(node);
        for (const int f : by_least_[node]) *others++ = behind(corners(f));
      }
    });
  }

  explicit FacetTable(const Mesh&&) = delete;

  static Corners sorted(const int* nodes, int count) {
    Corners result{INT_MAX, INT_MAX, INT_MAX, INT_MAX};
    std::copy(nodes, nodes + count, result.begin());
    std::sort(result.begin(), result.begin() + count);
    return result;
  }

  int count() const { return mesh_.cell_count() * mesh_.topology().facets; }
  Corners corners(int facet) const {
    const int facets = mesh_.topology().facets, corners = mesh_.topology().facet_corners;
    int nodes[4];
    for (int k = 0; k < corners; ++k) nodes[k] = mesh_.facet_node({facet / facets, facet % facets}, k);
    return sorted(nodes, corners);
  }

  /// Calls visit(f, g) for all two facets f < g with the same corners, of which this node is the least.
  template <class Visit>
  void pairs(int node, const Visit& visit) const {
    const std::span<const int> here = by_least_[node];
    const auto others = others_.begin() + by_least_.before(node);
    for (std::size_t a = 0; a < here.size(); ++a)
      for (std::size_t b = a + 1; b < here.size(); ++b)
        if (others[a] == others[b]) visit(here[a], here[b]);
  }

  /// Calls visit(facet) for each with these corners, ascending: one on the boundary, two within the mesh.
  template <class Visit>
  void with(const Corners& corners, const Visit& visit) const {
    const std::span<const int> here = by_least_[corners[0]];
    const auto others = others_.begin() + by_least_.before(corners[0]);
    for (std::size_t k = 0; k < here.size(); ++k)
      if (others[k] == behind(corners)) visit(here[k]);
  }

 private:
  int least_corner(int facet) const {
    const int facets = mesh_.topology().facets;
    const Facet f{facet / facets, facet % facets};
    int least = mesh_.facet_node(f, 0);
    for (int k = 1; k < mesh_.topology().facet_corners; ++k) least = std::min(least, mesh_.facet_node(f, k));
    return least;
  }

  /// The corners but the least.
  struct Others {
    int first, second, third;
    bool operator==(const Others&) const = default;
  };
  static Others behind(const Corners& corners) { return {corners[1], corners[2], corners[3]}; }

  const Mesh& mesh_;
  Buckets by_least_;
  std::vector<Others> others_;  ///< of the facets of by_least_, one bucket after another: searched without a jump in memory
};

}  // namespace dotyk::mesh
