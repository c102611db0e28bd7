#pragma once

#include <algorithm>
#include <array>
#include <climits>
#include <cstdint>
#include <span>
#include <vector>

#include "base/buckets.hpp"
#include "base/parallel.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::mesh {

/// One number for an edge, whichever end comes first.
inline std::uint64_t edge_key(int a, int b) {
  const auto low = static_cast<std::uint64_t>(std::min(a, b)), high = static_cast<std::uint64_t>(std::max(a, b));
  return low << 32 | high;
}

/// The facets of a mesh's cells, found by their corners in any order. The mesh must outlive the table.
class FacetTable {
 public:
  using Corners = std::array<int, 4>;  ///< ascending; INT_MAX behind them
  static constexpr int kFewCells = 50'000;  ///< not worth a thread

  explicit FacetTable(const Mesh& mesh)
      : mesh_(mesh), topology_(mesh.topology()), by_least_(mesh.node_count(), [&](auto&& put) {
          for (int f = 0; f < mesh.cell_count() * topology_.facets; ++f) put(least_corner(f), f);
        }) {
    others_.resize(static_cast<std::size_t>(mesh.cell_count()) * topology_.facets);
    parallel_ranges(mesh.node_count(), threads_for(mesh.cell_count(), kFewCells), [&](int, int first, int end) {
      for (int node = first; node < end; ++node) {
        auto others = others_.begin() + by_least_.before(node);
        for (const int f : by_least_[node]) *others++ = behind(corners_of(f));
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

  /// Calls visit(f, g) for each two facets f < g that have the same corners, of which this node is the least.
  template <class Visit>
  void pairs(int node, const Visit& visit) const {
    const std::span<const int> here = by_least_[node];
    const auto others = others_.begin() + by_least_.before(node);
    for (std::size_t a = 0; a < here.size(); ++a)
      for (std::size_t b = a + 1; b < here.size(); ++b)
        if (others[a] == others[b]) visit(facet(here[a]), facet(here[b]));
  }

  /// Calls visit(facet) for each facet with these corners, ascending: one on the boundary, two within the mesh.
  template <class Visit>
  void with(const Corners& corners, const Visit& visit) const {
    const std::span<const int> here = by_least_[corners[0]];
    const auto others = others_.begin() + by_least_.before(corners[0]);
    for (std::size_t k = 0; k < here.size(); ++k)
      if (others[k] == behind(corners)) visit(facet(here[k]));
  }

 private:
  /// The facet of a number: facet l of cell c has the number c · facets + l.
  Facet facet(int number) const { return {number / topology_.facets, number % topology_.facets}; }
  int least_corner(int number) const {
    const Facet f = facet(number);
    int least = mesh_.facet_node(f, 0);
    for (int k = 1; k < topology_.facet_corners; ++k) least = std::min(least, mesh_.facet_node(f, k));
    return least;
  }
  Corners corners_of(int number) const {
    const Facet f = facet(number);
    int nodes[4];
    for (int k = 0; k < topology_.facet_corners; ++k) nodes[k] = mesh_.facet_node(f, k);
    return sorted(nodes, topology_.facet_corners);
  }

  /// All corners of a facet except the least one, ascending.
  struct Others {
    int first, second, third;
    bool operator==(const Others&) const = default;
  };
  static Others behind(const Corners& corners) { return {corners[1], corners[2], corners[3]}; }

  const Mesh& mesh_;
  const ElementTopology& topology_;
  Buckets by_least_;  ///< numbers of facets, by their least corner
  std::vector<Others> others_;  ///< in the order of by_least_, so that a bucket is searched without a jump in memory
};

}  // namespace dotyk::mesh
