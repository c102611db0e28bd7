#include "contact/pairing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "base/error.hpp"
#include "base/text.hpp"
#include "contact/corner_means.hpp"
#include "contact/frame.hpp"

namespace dotyk::contact {
namespace {

using mesh::Point;

/// What lies across; throws InputError where that is nothing.
std::vector<Across> across(const Face& first, const Face& second, Pairing pairing, const std::vector<NodeSide>& sides,
                           Monitor* monitor) {
  auto all = pairing == Pairing::mortar ? mortar(first, second, sides, monitor) : node_to_segment(first, second, sides);
  // A crack's tip that would be its own partner moves with itself.
  for (std::size_t k = 0; k < all.size(); ++k)
    if (&first.mesh == &second.mesh && all[k].partners.size() == 1 && all[k].partners.front().node == sides[k].node)
      all[k].partners.clear();
  if (std::all_of(all.begin(), all.end(), [](const Across& a) { return a.partners.empty(); }))
    throw InputError(text(first.name, " and ", second.name, " do not face each other: no facet of one has a facet of "
                          "the other across from it, normals opposed"));
  return all;
}

/// Curvature of a part at its nodes, by how its facets' normals turn: the greatest of their facets', those' the greatest at their corners,
/// so that the ends of a part know it from their neighbours.
std::unordered_map<int, double> curvature_of(const Face& face) {
  std::vector<double> of_facet(face.facets.size(), 0);
  const std::vector<NodeSide> all = sides(face.mesh, face.facets);
  for (const NodeSide& side : all)
    for (const int f : side.facets) {
      const Point n = face.mesh.facet_area_vector(face.facets[f]);
      const double size = mesh::length(n);
      const double turn = std::sqrt(std::max(0.0, 2 - 2 * mesh::dot(n, side.normal) / size));  // half the angle between neighbours
      of_facet[f] = std::max(of_facet[f], 2 * turn / (face.mesh.dimension() == 2 ? size : std::sqrt(size)));
    }
  std::unordered_map<int, double> curvature;
  for (const NodeSide& side : all)
    for (const int f : side.facets) curvature[side.node] = std::max(curvature[side.node], of_facet[f]);
  return curvature;
}

/// The greater curvature of two parts, where sides of the one have partners on the other.
class Curvature {
 public:
  Curvature(const Face& first, const Face& second) : here_(curvature_of(first)), across_(curvature_of(second)) {}
  double at(int node, const std::vector<NodeWeight>& partners) const {
    double most = here_.at(node);
    for (const NodeWeight& partner : partners) most = std::max(most, across_.at(partner.node));
    return most;
  }

 private:
  std::unordered_map<int, double> here_, across_;
};

/// How far chords that wide are from what they are chords of.
double height_of_chord(double curvature, double width) { return curvature * width * width / 8; }

/// Rows with partners found by `pairing`; of chords that overlap no more than they must the gap is 0.
std::vector<ContactRow> paired(const Face& first, const Face& second, Pairing pairing, const elasticity::ScalarField& added,
                               bool interference, Monitor* monitor) {
  const bool means = first.mesh.topology().order == 2;
  std::vector<NodeSide> list = means && pairing == Pairing::node_to_segment ? nodes(first.mesh, first.facets)
                                                                          : corner_sides(first.mesh, first.facets);
  std::vector<Across> all = across(first, second, pairing, list, monitor);
  std::unordered_map<int, double> widest;
  for (std::size_t k = 0; k < list.size(); ++k) {
    double& most = widest[list[k].node];  // a corner has two sides
    most = std::max(most, all[k].widest);
  }
  std::vector<ContactRow> rows;
  if (means && pairing == Pairing::node_to_segment) {
    std::unordered_map<int, std::vector<NodeWeight>> feet;
    for (std::size_t k = 0; k < list.size(); ++k)
      if (!all[k].partners.empty()) feet.emplace(list[k].node, std::move(all[k].partners));
    rows = mean_rows(first, second, std::move(feet), added);
  } else {
    const Frames frames(first, second);
    const double size = first.mesh.size();
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (all[k].partners.empty()) continue;
      list[k].weight = all[k].weight;
      if (means) list[k].own = std::move(all[k].own);
      rows.push_back(row_of(list[k], std::move(all[k].partners), added ? added(first.mesh.point(list[k].node)) : 0, frames));
      // Parts that nowhere overlap have no negative gap in the mean, either.
      if (all[k].least >= -touching(first, size, list[k].facets)) rows.back().gap = std::max(rows.back().gap, rows.back().added);
    }
  }
  if (interference) return rows;
  const Curvature curvature(first, second);
  for (ContactRow& row : rows) {
    const double own = row.gap - row.added;
    if (own < 0 && own >= -height_of_chord(curvature.at(row.node, row.partners), widest.at(row.node))) row.gap = row.added;
  }
  refuse_overlap(rows, first, second);
  return rows;
}

/// Length or area that rows stand for.
double measure(const std::vector<ContactRow>& rows) {
  return std::accumulate(rows.begin(), rows.end(), 0.0, [](double sum, const ContactRow& row) { return sum + row.weight; });
}

/// Are there fewer corners across than rows, by more than what an end more or less makes?
bool coarser_across(const std::vector<ContactRow>& rows, const Face& second) {
  std::unordered_set<int> corners, across;
  for (const mesh::Facet f : second.facets)
    for (int a = 0; a < second.mesh.topology().facet_corners; ++a) corners.insert(second.mesh.facet_node(f, a));
  for (const ContactRow& row : rows)
    for (const NodeWeight& partner : row.partners)
      if (corners.contains(partner.node)) across.insert(partner.node);
  return static_cast<double>(across.size()) < 0.95 * static_cast<double>(rows.size());
}

/// Where none is asked for nodes are tried first, but for triangles on quadrilaterals: those forces of a uniform pressure differ,
/// and no uniform stress passes.
Pairing tried_first(const Face& first, const Face& second, std::optional<Pairing> asked) {
  const bool alike = first.mesh.topology().nodes_per_facet == second.mesh.topology().nodes_per_facet;
  return asked.value_or(alike ? Pairing::matching : Pairing::mortar);
}

double width(const Face& face, const NodeSide& side) {
  double widest = 0;
  for (const int f : side.facets) {
    const double size = mesh::length(face.mesh.facet_area_vector(face.facets[f]));
    widest = std::max(widest, face.mesh.dimension() == 2 ? size : std::sqrt(size));
  }
  return widest;
}

/// Where glued sides lie apart, forces across the gap have a moment that nothing bears.
class Apart {
 public:
  Apart(const Face& first, const Face& second) : first_(first), second_(second) {}

  /// `widest`: of the facets met; `curvature`: of the parts there. Chords of curved parts lie apart by their height, and by four times
  /// that where a facet is covered at its end alone and the other side's line is drawn out; a tenth of a facet is a layer of glue.
  void see(const Tie& tie, double widest, double curvature) {
    Point d{0, 0, 0};
    for (const NodeWeight& own : tie.own)
      for (int i = 0; i < 3; ++i) d[i] -= own.weight * first_.mesh.point(own.node)[i];
    for (const NodeWeight& partner : tie.partners)
      for (int i = 0; i < 3; ++i) d[i] += partner.weight * second_.mesh.point(partner.node)[i];
    const double distance = mesh::length(d), allowed = 0.1 * widest + 4 * height_of_chord(curvature, widest);
    if (distance > allowed && distance > greatest_) greatest_ = distance, node_ = tie.node;
  }

  /// Throws InputError.
  void refuse() const {
    if (node_ < 0) return;
    const Point at = first_.mesh.point(node_);
    throw InputError(text(first_.name, " and ", second_.name, " lie ", greatest_, " apart at ", point_text(at.data(), first_.mesh.dimension()),
                          "; only parts that touch can be glued (forces across a gap have a moment that nothing bears): move one, or "
                          "put a body between them"));
  }

 private:
  const Face &first_, &second_;
  double greatest_ = 0;
  int node_ = -1;
};

/// Node → the height of the edges there as chords. With n the normals at an edge's ends, e·(n₂ − n₁)/8, of a circle |e|²/8R; edges along a
/// cylinder have none.
std::unordered_map<int, double> chords(const Face& face) {
  std::unordered_map<int, double> height;
  const int corners = face.mesh.topology().facet_corners;
  if (face.mesh.topology().order > 1) return height;
  std::vector<std::array<Point, 4>> normal(face.facets.size());
  for (const NodeSide& side : sides(face.mesh, face.facets))
    for (const int f : side.facets)
      for (int a = 0; a < corners; ++a)
        if (face.mesh.facet_node(face.facets[f], a) == side.node) normal[f][a] = side.normal;
  for (std::size_t f = 0; f < normal.size(); ++f)
    for (int a = 0; a < corners; ++a) {
      const int b = (a + 1) % corners, i = face.mesh.facet_node(face.facets[f], a), j = face.mesh.facet_node(face.facets[f], b);
      const Point edge = mesh::minus(face.mesh.point(j), face.mesh.point(i));
      const double here = std::abs(mesh::dot(edge, mesh::minus(normal[f][b], normal[f][a]))) / 8;
      for (const int node : {i, j}) height[node] = std::max(height[node], here);
    }
  return height;
}

/// Sets `chord`; `first` and `second` as the rows have them.
PairedRows chords_seen(PairedRows paired, const Face& first, const Face& second) {
  const auto here = chords(first), across = chords(second);
  const auto see = [&](const std::unordered_map<int, double>& heights, int node) {
    const auto found = heights.find(node);
    if (found != heights.end()) paired.chord = std::max(paired.chord, found->second);
  };
  for (const ContactRow& row : paired.rows) {
    see(here, row.node);
    for (const NodeWeight& partner : row.partners) see(across, partner.node);
  }
  return paired;
}

}  // namespace

PairedRows pair_rows(const Face& first, const Face& second, std::optional<Pairing> pairing,
                     const elasticity::ScalarField& added, bool interference, Monitor* monitor) {
  if (tried_first(first, second, pairing) == Pairing::matching) {
    const Matching found = find_matching(first, second);
    if (found.mismatch.empty()) return {Pairing::matching, matching_rows(found.pairs, first, second, added, interference)};
    if (pairing) throw InputError(found.mismatch);
  }
  const Pairing used = pairing.value_or(Pairing::mortar);
  std::vector<ContactRow> rows = paired(first, second, used, added, interference, monitor);
  if (used == Pairing::mortar && coarser_across(rows, second)) {
    std::vector<ContactRow> turned = paired(second, first, used, added, interference, monitor);
    // Parts that lie above themselves cover more seen from the other side.
    if (measure(turned) < 1.1 * measure(rows)) return chords_seen({used, std::move(turned), true}, second, first);
  }
  return chords_seen({used, std::move(rows)}, first, second);
}

PairedTies pair_ties(const Face& first, const Face& second, std::optional<Pairing> pairing, Monitor* monitor) {
  PairedTies result{pairing.value_or(Pairing::mortar), {}};
  Apart apart(first, second);
  if (tried_first(first, second, pairing) == Pairing::matching) {
    const Matching found = find_matching(first, second);
    if (found.mismatch.empty()) {
      std::unordered_map<int, double> widest;
      for (const NodeSide& side : nodes(first.mesh, first.facets)) widest[side.node] = width(first, side);
      for (const NodePair& pair : found.pairs) {
        result.ties.push_back({pair.first, {{pair.first, 1}}, {{pair.second, 1}}});
        apart.see(result.ties.back(), widest.at(pair.first), 0);
      }
      apart.refuse();
      result.pairing = Pairing::matching;
      return result;
    }
    if (pairing) throw InputError(found.mismatch);
  }
  const bool means = first.mesh.topology().order == 2 && result.pairing == Pairing::mortar;
  const std::vector<NodeSide> list = means ? corner_nodes(first.mesh, first.facets) : nodes(first.mesh, first.facets);
  std::vector<Across> all = across(first, second, result.pairing, list, monitor);
  const Curvature curvature(first, second);
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (all[k].partners.empty()) continue;
    result.ties.push_back({list[k].node, means ? std::move(all[k].own) : list[k].own, std::move(all[k].partners)});
    apart.see(result.ties.back(), all[k].widest, curvature.at(list[k].node, result.ties.back().partners));
  }
  apart.refuse();
  return result;
}

}  // namespace dotyk::contact
