#pragma once

#include <algorithm>
#include <array>
#include <climits>
#include <vector>

#include "base/parallel.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::mesh {

/// The facets of a mesh's cells, facet l of cell c as number c · facets + l, found by their corners in any order.
class FacetTable {
 public:
  using Corners = std::array<int, 4>;  ///< ascending; INT_MAX behind them
  static constexpr int kFewCells = 50'000;  ///< not worth a thread

  explicit FacetTable(const Mesh& mesh) {
    const ElementTopology& t = mesh.topology();
    corners_.resize(static_cast<std::size_t>(mesh.cell_count()) * t.facets);
    parallel_ranges(mesh.cell_count(), threads_for(mesh.cell_count(), kFewCells), [&](int, int first, int end) {
      for (int c = first; c < end; ++c)
        for (int l = 0; l < t.facets; ++l) {
          int nodes[4];
          for (int k = 0; k < t.facet_corners; ++k) nodes[k] = mesh.facet_node({c, l}, k);
          corners_[static_cast<std::size_t>(c) * t.facets + l] = sorted(nodes, t.facet_corners);
        }
    });
    by_least_ = Buckets(mesh.node_count(), [&](auto&& put) {
      for (int f = 0; f < count(); ++f) put(corners_[f][0], f);
    });
  }

  static Corners sorted(const int* nodes, int count) {
    Corners result{INT_MAX, INT_MAX, INT_MAX, INT_MAX};
    std::copy(nodes, nodes + count, result.begin());
    std::sort(result.begin(), result.end());
    return result;
  }

  int count() const { return static_cast<int>(corners_.size()); }
  const Corners& corners(int facet) const { return corners_[facet]; }

  /// Calls visit(facet) for each with these corners, ascending: one on the boundary, two within the mesh.
  template <class Visit>
  void with(const Corners& corners, const Visit& visit) const {
    for (const int f : by_least_[corners[0]]) {
      const Corners& own = corners_[f];
      if (own[1] == corners[1] && own[2] == corners[2] && own[3] == corners[3]) visit(f);
    }
  }

 private:
  std::vector<Corners> corners_;
  Buckets by_least_;
};

}  // namespace dotyk::mesh
