// The order of supports and loads along the boundary of a body.
#pragma once

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "figure/canvas/geometry.hpp"
#include "mesh/mesh.hpp"

namespace dotyk::figure {

/// Numbers along facets in the plane, for SupportSymbol::place: nodes and facets by turns, separate pieces apart, from `last` on, which becomes
/// the last one. In space all are 0.
class Outline {
 public:
  Outline(const mesh::Mesh& mesh, const std::vector<mesh::Facet>& facets, int& last) : mesh_(mesh) {
    if (mesh.dimension() != 2) return;
    std::vector<int> edges;
    std::map<std::pair<int, int>, int> middles;
    for (const mesh::Facet f : facets) {
      const int a = mesh.facet_node(f, 0), b = mesh.facet_node(f, 1);
      edges.insert(edges.end(), {a, b});
      if (mesh.topology().order == 2) middles[sides(a, b)] = mesh.facet_node(f, 2);
    }
    for (const std::vector<int>& chain : chains(edges)) {
      last += 3;
      for (std::size_t k = 0; k < chain.size(); ++k) {
        nodes_.emplace(chain[k], ++last);
        if (k + 1 == chain.size()) break;
        facets_[sides(chain[k], chain[k + 1])] = ++last;
        if (const auto middle = middles.find(sides(chain[k], chain[k + 1])); middle != middles.end()) nodes_[middle->second] = last;
      }
    }
  }
  int of(int node) const { return found(nodes_, node); }
  int of(mesh::Facet f) const { return found(facets_, sides(mesh_.facet_node(f, 0), mesh_.facet_node(f, 1))); }

 private:
  static std::pair<int, int> sides(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
  template <class Key>
  static int found(const std::map<Key, int>& numbers, const Key& key) {
    const auto at = numbers.find(key);
    return at == numbers.end() ? 0 : at->second;
  }

  const mesh::Mesh& mesh_;
  std::map<int, int> nodes_;
  std::map<std::pair<int, int>, int> facets_;
};

}  // namespace dotyk::figure
