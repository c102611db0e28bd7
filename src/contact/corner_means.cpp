#include "contact/corner_means.hpp"

#include <cmath>
#include <map>

#include "contact/dual_hats.hpp"

namespace dotyk::contact {

using mesh::Facet;
using mesh::Mesh;

double linear_hat(const mesh::ElementTopology& t, const elasticity::FacetPoint& p, int corner) {
  double value = p.shape[corner];
  for (int k = t.facet_corners; k < p.nodes; ++k) value += mesh::corner_hat(t, corner, k) * p.shape[k];
  return value;
}

namespace {

/// Makes a corner's side of order 2 the mean over those of its facets that are used; weight 0 where none is.
void take_mean(const Mesh& mesh, const std::vector<Facet>& facets, const std::vector<char>& used, NodeSide& side) {
  const mesh::ElementTopology& t = mesh.topology();
  std::map<int, double> moments;
  side.weight = 0;
  for (const int k : side.facets) {
    if (!used[k]) continue;
    int corner = 0;
    while (mesh.facet_node(facets[k], corner) != side.node) ++corner;
    DualHats dual(t.facet_corners);
    elasticity::for_each_facet_point(mesh, facets[k], [&](const elasticity::FacetPoint& p) {
      double hats[4];
      for (int a = 0; a < t.facet_corners; ++a) hats[a] = linear_hat(t, p, a);
      dual.point(hats, p.measure);
      for (int a = 0; a < p.nodes; ++a) dual.value(mesh.facet_node(facets[k], a), p.shape[a]);
    });
    side.weight += dual.weights()[corner];
    for (const auto& [node, moment] : dual.moments()) moments[node] += moment[corner];
  }
  if (!(side.weight > 0)) return;
  side.own.assign(1, {side.node, moments[side.node] / side.weight});
  for (const auto& [node, moment] : moments)
    if (node != side.node && std::abs(moment) > 1e-13 * side.weight) side.own.push_back({node, moment / side.weight});
}

/// `used`: one flag a facet; empty: all.
std::vector<NodeSide> at_corners(const Mesh& mesh, const std::vector<Facet>& facets, std::vector<NodeSide> all, std::vector<char> used) {
  if (mesh.topology().order == 1) return all;
  std::vector<char> corner(mesh.node_count(), 0);
  for (const Facet f : facets)
    for (int k = 0; k < mesh.topology().facet_corners; ++k) corner[mesh.facet_node(f, k)] = 1;
  std::erase_if(all, [&](const NodeSide& side) { return !corner[side.node]; });
  if (used.empty()) used.assign(facets.size(), 1);
  for (NodeSide& side : all) take_mean(mesh, facets, used, side);
  std::erase_if(all, [](const NodeSide& side) { return !(side.weight > 0); });
  return all;
}

}  // namespace

std::vector<NodeSide> corner_sides(const Mesh& mesh, const std::vector<Facet>& facets, const std::vector<char>& used) {
  return at_corners(mesh, facets, sides(mesh, facets), used);
}

std::vector<NodeSide> corner_nodes(const Mesh& mesh, const std::vector<Facet>& facets) {
  return at_corners(mesh, facets, nodes(mesh, facets), {});
}

}  // namespace dotyk::contact
