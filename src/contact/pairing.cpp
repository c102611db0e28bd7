#include "contact/pairing.hpp"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "base/error.hpp"
#include "contact/frame.hpp"
#include "contact/second_facets.hpp"

namespace dotyk::contact {

std::vector<Across> node_to_segment(const Face& first, const Face& second, const std::vector<NodeSide>& sides) {
  constexpr double kRim = 1e-6;  // of a facet's width: a node on the rim is inside
  const SecondFacets all(second);
  const int dim = first.mesh.dimension();
  std::vector<Across> result(sides.size());
  for (std::size_t k = 0; k < sides.size(); ++k) {
    const View view(first.mesh.point(sides[k].node), sides[k].normal, dim);
    double nearest = INFINITY, furthest = 0, widest = 0;
    all.for_each_near(view, 0, [&](int f, double width) {
      const Shadow shadow(second.mesh, second.facets[f], view);
      if (!shadow.holds({0, 0}, kRim)) return;
      const double distance = std::abs(shadow.height_at({0, 0}));
      furthest = std::max(furthest, distance), widest = std::max(widest, width);
      if (distance >= nearest) return;
      nearest = distance;
      const auto shape = shadow.shape({0, 0});
      result[k] = {{}, sides[k].weight, width};
      for (int a = 0; a < shadow.nodes; ++a)
        if (std::abs(shape[a]) > 1e-14) result[k].partners.push_back({second.mesh.facet_node(second.facets[f], a), shape[a]});
    });
    result[k].folded = furthest > nearest + 0.1 * widest;
  }
  return result;
}

namespace {

using mesh::Point;

constexpr double kAlike = 1.05;  ///< widths of facets that count as equal

/// What lies across.
std::vector<Across> across(const Face& first, const Face& second, Pairing pairing, const std::vector<NodeSide>& sides,
                           Monitor* monitor) {
  auto all = pairing == Pairing::mortar ? mortar(first, second, sides, monitor) : node_to_segment(first, second, sides);
  // A crack's tip that would be its own partner moves with itself.
  for (std::size_t k = 0; k < all.size(); ++k)
    if (&first.mesh == &second.mesh && all[k].partners.size() == 1 && all[k].partners.front().node == sides[k].node)
      all[k].partners.clear();
  return all;
}

/// How far chords of the parts' curves may be from them at a row's foot, `width` that of the widest facet there.
double height_of_chords(const Curvatures& here, const Curvatures& across, int node, const std::vector<NodeWeight>& partners, double width) {
  double most = here.greatest(node);
  for (const NodeWeight& partner : partners) most = std::max(most, across.greatest(partner.node));
  return most * width * width / 8;
}

InputError nothing_across(const Face& first, const Face& second, Pairing pairing) {
  const bool feet = pairing == Pairing::node_to_segment && first.mesh.topology().order == 2;
  return InputError(text(first.name, " and ", second.name, " do not face each other: no facet of one has ",
                         feet ? "feet of all its nodes on the other, as node_to_segment asks of order 2: take smaller cells, or mortar"
                              : "a facet of the other across from it, normals opposed"));
}

struct Rows {
  std::vector<ContactRow> rows;
  bool folded = false;  ///< see Across
};

/// Rows with partners found by `pairing`; of chords that overlap no more than they must the gap is 0.
Rows paired(const Face& first, const Face& second, Pairing pairing, const elasticity::ScalarField& added,
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
  const Frames frames(first, second);
  const bool folded = std::any_of(all.begin(), all.end(), [](const Across& a) { return a.folded; });
  std::vector<ContactRow> rows;
  if (means && pairing == Pairing::node_to_segment) {
    std::unordered_map<int, std::vector<NodeWeight>> feet;
    for (std::size_t k = 0; k < list.size(); ++k)
      if (!all[k].partners.empty()) feet.emplace(list[k].node, std::move(all[k].partners));
    rows = node_rows(first, second, std::move(feet), added);
  } else {
    const double size = first.mesh.size();
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (all[k].partners.empty()) continue;
      list[k].weight = all[k].weight;
      if (!all[k].own.empty()) list[k].own = std::move(all[k].own);
      rows.push_back(row_of(list[k], std::move(all[k].partners), added ? added(first.mesh.point(list[k].node)) : 0, frames));
      // Parts that nowhere overlap have no negative gap in the mean, either.
      if (all[k].least >= -touching(first, size, list[k].facets)) rows.back().gap = std::max(rows.back().gap, rows.back().added);
    }
  }
  if (interference) return {std::move(rows), folded};
  for (ContactRow& row : rows) {
    const double own = row.gap - row.added;
    if (own < 0 && own >= -height_of_chords(frames.here, frames.across, row.node, row.partners, widest.at(row.node))) row.gap = row.added;
  }
  refuse_overlap(rows, first, second);
  return {std::move(rows), folded};
}

/// Node → length or area of a facet there, the mean; of triangles, which are halves of cells, twice that.
std::unordered_map<int, double> facet_sizes(const Face& face) {
  std::unordered_map<int, double> sum, count;
  const mesh::ElementTopology& t = face.mesh.topology();
  for (const mesh::Facet f : face.facets)
    for (int a = 0; a < t.nodes_per_facet; ++a) {
      const int node = face.mesh.facet_node(f, a);
      sum[node] += mesh::length(face.mesh.facet_area_vector(f)) * (t.facet_corners == 3 ? 2 : 1);
      ++count[node];
    }
  for (auto& [node, size] : sum) size /= count.at(node);
  return sum;
}

double mean_size(const std::vector<NodeWeight>& nodes, const std::unordered_map<int, double>& sizes) {
  double sum = 0, mean = 0;
  for (const NodeWeight& n : nodes) sum += std::abs(n.weight), mean += std::abs(n.weight) * sizes.at(n.node);
  return mean / sum;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// How much wider facets are across than here: the median over the rows whose gaps are less than the median one, or like it, since where
/// parts curve away from each other, and at their ends, meshes are mostly coarser, and cover each other in part.
double wider_across(const std::vector<ContactRow>& rows, const Face& first, const Face& second) {
  const auto here = facet_sizes(first), across = facet_sizes(second);
  std::vector<double> gaps, ratios;
  for (const ContactRow& row : rows) gaps.push_back(row.gap);
  const double near = median(gaps) + 1e-3 * first.mesh.size();
  for (const ContactRow& row : rows)
    if (row.gap <= near) ratios.push_back(mean_size(row.partners, across) / mean_size(row.own, here));
  return std::pow(median(ratios), 1.0 / (first.mesh.dimension() - 1));
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

  /// `widest`: of the facets met; `chords`: their height. Chords of curved parts lie apart by their height, and by four times
  /// that where a facet is covered at its end alone and the other side's line is drawn out; a tenth of a facet is a layer of glue.
  void see(const Tie& tie, double widest, double chords) {
    const double distance = mesh::length(mesh::minus(mean_place(tie.partners, second_.mesh), mean_place(tie.own, first_.mesh)));
    const double allowed = 0.1 * widest + 4 * chords;
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

constexpr double kAcross = 0.9;  ///< share of a partner that is the only one, but for what is covered askew

/// Sets the rows' chords; `first` and `second` as the rows have them.
PairedRows chords_seen(PairedRows paired, const Face& first, const Face& second) {
  const auto here = chords(first), across = chords(second);
  const auto see = [](ContactRow& row, const std::unordered_map<int, double>& heights, int node) {
    if (const auto found = heights.find(node); found != heights.end()) row.chord = std::max(row.chord, found->second);
  };
  for (ContactRow& row : paired.rows) {
    if (std::any_of(row.partners.begin(), row.partners.end(), [](const NodeWeight& p) { return p.weight > kAcross; })) continue;
    see(row, here, row.node);
    for (const NodeWeight& partner : row.partners) see(row, across, partner.node);
  }
  return paired;
}

double area(const std::vector<ContactRow>& rows) {
  double sum = 0;
  for (const ContactRow& row : rows) sum += row.weight;
  return sum;
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
  Rows here = paired(first, second, used, added, interference, monitor);
  const auto other_way = [&] {
    if (here.rows.empty() || here.folded) return here.rows.empty();  // a part that lies above itself would have rows on all its sheets
    const double wider = wider_across(here.rows, first, second);
    return used == Pairing::mortar ? wider > kAlike : wider < 1 / kAlike;
  };
  // In order 2 the mean over a cell is not the same on both sides: if their cells are alike, it is taken on the side of greater area.
  const bool by_area = used == Pairing::mortar && first.mesh.topology().order == 2 && second.mesh.topology().order == 2 && !here.rows.empty() && !here.folded;
  const auto greater = [&](const Rows& there) {
    return !there.folded && wider_across(there.rows, second, first) <= kAlike && area(there.rows) > 1.000001 * area(here.rows);
  };
  if (const bool other = other_way(); other || by_area)
    if (Rows there = paired(second, first, used, added, interference, monitor); !there.rows.empty() && (other || greater(there)))
      return chords_seen({used, std::move(there.rows), true}, second, first);
  if (here.rows.empty()) throw nothing_across(first, second, used);
  return chords_seen({used, std::move(here.rows)}, first, second);
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
  const Curvatures here(first), there(second);
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (all[k].partners.empty()) continue;
    result.ties.push_back({list[k].node, all[k].own.empty() ? list[k].own : std::move(all[k].own), std::move(all[k].partners)});
    const Tie& tie = result.ties.back();
    apart.see(tie, all[k].widest, height_of_chords(here, there, tie.node, tie.partners, all[k].widest));
  }
  if (result.ties.empty()) throw nothing_across(first, second, result.pairing);
  apart.refuse();
  return result;
}

}  // namespace dotyk::contact
