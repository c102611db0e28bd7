#include "contact/sides.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/error.hpp"

namespace dotyk::contact {

using mesh::Facet;
using mesh::Mesh;
using mesh::Point;
using mesh::dot;

double linear_hat(const mesh::ElementTopology& t, const elasticity::FacetPoint& p, int corner) {
  double value = p.shape[corner];
  for (int k = t.facet_corners; k < p.nodes; ++k) value += mesh::corner_hat(t, corner, k) * p.shape[k];
  return value;
}

namespace {

/// What one facet gives to one of its nodes.
struct NodeShare {
  Point normal;   ///< unit; of order 2 the mean at the node
  double weight;  ///< ∫ φ, of corners of order 2 ∫ of the linear hat
  int facet;
  int side = -1;
};

std::map<int, std::vector<NodeShare>> shares(const Mesh& mesh, const std::vector<Facet>& facets) {
  const mesh::ElementTopology& t = mesh.topology();
  std::map<int, std::vector<NodeShare>> by_node;
  for (std::size_t k = 0; k < facets.size(); ++k) {
    const Facet f = facets[k];
    NodeShare share{mesh.facet_area_vector(f), 0, static_cast<int>(k)};
    const double area = std::sqrt(dot(share.normal, share.normal));
    for (double& n : share.normal) n /= area;
    double weight[mesh::kMostFacetNodes] = {};
    Point normal[mesh::kMostFacetNodes] = {};
    elasticity::for_each_facet_point(mesh, f, [&](const elasticity::FacetPoint& p) {
      for (int a = 0; a < p.nodes; ++a) {
        const double part = p.measure * (a < t.facet_corners ? linear_hat(t, p, a) : p.shape[a]);
        weight[a] += part;
        for (int i = 0; i < 3; ++i) normal[a][i] += part * p.normal[i];
      }
    });
    for (int a = 0; a < t.nodes_per_facet; ++a) {
      share.weight = weight[a];
      const double length = std::sqrt(dot(normal[a], normal[a]));
      for (int i = 0; t.order == 2 && i < 3; ++i) share.normal[i] = normal[a][i] / length;
      by_node[mesh.facet_node(f, a)].push_back(share);
    }
  }
  return by_node;
}

NodeSide sum(int node, const std::vector<NodeShare>& shares, int side) {
  NodeSide result{node, {0, 0, 0}, 0, {}, {{node, 1}}};
  for (const NodeShare& s : shares)
    if (s.side == side) {
      result.weight += s.weight;
      result.facets.push_back(s.facet);
      for (int i = 0; i < 3; ++i) result.normal[i] += s.weight * s.normal[i];
    }
  const double length = std::sqrt(dot(result.normal, result.normal));
  for (double& n : result.normal) n /= length;
  return result;
}

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

std::vector<NodeSide> sides(const Mesh& mesh, const std::vector<Facet>& facets) {
  const double smooth = std::cos(kCornerAngle * std::numbers::pi / 180);
  std::vector<NodeSide> result;
  for (auto& [node, list] : shares(mesh, facets)) {
    std::vector<NodeShare> around = list;
    int count = 0;
    for (std::size_t k = 0; k < around.size(); ++k) {
      if (around[k].side >= 0) continue;
      // Facets reachable through small angles form one side.
      std::vector<std::size_t> reached{k};
      around[k].side = count;
      while (!reached.empty()) {
        const Point normal = around[reached.back()].normal;
        reached.pop_back();
        for (std::size_t j = 0; j < around.size(); ++j)
          if (around[j].side < 0 && dot(normal, around[j].normal) > smooth) {
            around[j].side = count;
            reached.push_back(j);
          }
      }
      ++count;
    }
    for (int side = 0; side < count; ++side) result.push_back(sum(node, around, side));
  }
  return result;
}

std::vector<NodeSide> nodes(const Mesh& mesh, const std::vector<Facet>& facets) {
  std::vector<NodeSide> result;
  for (const auto& [node, list] : shares(mesh, facets)) result.push_back(sum(node, list, -1));
  return result;
}

std::vector<NodeSide> moved_sides(const Mesh& before, const Mesh& after, const std::vector<Facet>& facets, const std::string& part) {
  const std::vector<NodeSide> old = sides(before, facets);
  std::vector<NodeSide> now = sides(after, facets);
  for (std::size_t k = 0; k < std::min(old.size(), now.size()); ++k) {
    if (old[k].node == now[k].node && old[k].facets == now[k].facets) continue;
    const int node = std::min(old[k].node, now[k].node);
    const auto count = [&](const std::vector<NodeSide>& list) {
      return std::count_if(list.begin(), list.end(), [&](const NodeSide& side) { return side.node == node; });
    };
    throw InputError(text(part, ": where its nodes have moved to, the part has ", count(now), count(now) == 1 ? " side" : " sides", " at ",
                          point_text(after.node(node), after.dimension()), ", where it had ", count(old), " at ",
                          point_text(before.node(node), before.dimension()), ": facets meet in a corner from ", kCornerAngle,
                          " degrees on; move the nodes less, or make parts of both sides of the corner"));
  }
  return now;
}

std::vector<NodeSide> corner_sides(const Mesh& mesh, const std::vector<Facet>& facets, const std::vector<char>& used) {
  return at_corners(mesh, facets, sides(mesh, facets), used);
}

std::vector<NodeSide> corner_nodes(const Mesh& mesh, const std::vector<Facet>& facets) {
  return at_corners(mesh, facets, nodes(mesh, facets), {});
}

}  // namespace dotyk::contact
