#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "contact/sides.hpp"
#include "contact/pairing.hpp"
#include "contact/second_facets.hpp"

namespace dotyk::contact {
namespace {

/// Where a facet of the first part and one of the second lie above each other.
struct Cut {
  int facet;  ///< of the second part
  Shadow shadow;
  std::vector<Flat> polygon;
};

/// What a first part's facet meets.
struct Met {
  double widest = 0;        ///< of the facets met, and its own
  double least = INFINITY;  ///< gap along its normal at the points of integration
  bool folded = false;      ///< more than a tenth of it by several sheets of the second part
};

/// A node of which less than this part of ∫φ is covered has no multiplier: a few such nodes beyond an edge of the second part, and the ones within, would
/// press on the same nodes of that edge, with pressures that grow without bound as the part goes to 0.
constexpr double kLeastCovered = 0.2;

/// Of a facet's corners, those without a multiplier.
using Without = std::array<bool, 4>;

/// What a corner of a first part's facet gets from it.
struct Corner {
  double weight = 0;               ///< ∫χ over what is covered
  std::map<int, double> own;       ///< of order 2, and where corners are without a multiplier: ∫ψ φ_l
  std::map<int, double> partners;  ///< ∫ψ φ_j∘P
};

class Mortar {
 public:
  Mortar(const Face& first, const Face& second)
      : first_(first), second_(second), all_(second), corners_(first.mesh.topology().facet_corners) {}

  /// One entry a corner. Each corner with a multiplier takes an equal part of the hats of those without; `means`: give own moments.
  std::array<Corner, 4> of(mesh::Facet facet, const Without& without, bool means, Met& met) const {
    const View view(first_.mesh.facet_centre(facet), mesh::unit(first_.mesh.facet_area_vector(facet)), first_.mesh.dimension());
    const Shadow own(first_.mesh, facet, view);
    std::vector<Cut> cuts = cut(view, own, met.widest);
    double covered = 0;
    for (const Cut& c : cuts) covered += size(c.polygon);
    if (covered > (1 + kSliver) * own.size()) {
      keep_nearest(cuts);
      double left = 0;
      for (const Cut& c : cuts) left += size(c.polygon);
      met.folded = covered - left > 0.1 * own.size();
    }
    if (covered < kSliver * own.size()) return {};
    return integrate(facet, without, means, view, own, cuts, met.least);
  }

 private:
  std::vector<Cut> cut(const View& view, const Shadow& own, double& widest) const {
    double radius = 0;
    for (int a = 0; a < corners_; ++a) radius = std::max(radius, own.at[a].norm());
    widest = std::max(widest, 2 * radius);
    std::vector<Cut> cuts;
    all_.for_each_near(view, radius, [&](int f, double width) {
      Cut c{f, Shadow(second_.mesh, second_.facets[f], view), {}};
      c.polygon = common(own, c.shadow);
      if (!(size(c.polygon) > 1e-3 * kSliver * own.size())) return;
      widest = std::max(widest, width);
      cuts.push_back(std::move(c));
    });
    return cuts;
  }

  /// Where the second part lies above itself the nearest sheet counts.
  static void keep_nearest(std::vector<Cut>& cuts) {
    std::vector<char> hidden(cuts.size(), 0);
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const Flat x = centre(cuts[k].polygon);
      const double distance = std::abs(cuts[k].shadow.height_at(x));
      for (std::size_t j = 0; j < cuts.size() && !hidden[k]; ++j)
        hidden[k] = j != k && cuts[j].shadow.holds(x, -kSliver) && std::abs(cuts[j].shadow.height_at(x)) < (1 - 1e-9) * distance;
    }
    std::size_t k = 0;
    std::erase_if(cuts, [&](const Cut&) { return hidden[k++]; });
  }

  /// Enough Gauss points for ψ_k φ_j: products of linear functions, of bilinear ones (degree 4), of order 2 (degree 6: bilinear
  /// times biquadratic), or of rational ones.
  const FlatQuadrature& rule(const Shadow& own, const Shadow& other) const {
    const bool quadratic = own.nodes > own.corners || other.nodes > other.corners;
    if (own.corners < 4 && other.corners < 4) return quadratic ? bilinear_ : linear_;
    if (!own.polynomial() || !other.polynomial()) return rational_;
    return quadratic ? biquadratic_ : bilinear_;
  }

  /// Of a facet's point, above the view's plane.
  template <class Shape>
  static double height(const Face& face, mesh::Facet facet, const View& view, const Shadow& shadow, const Shape& shape) {
    double sum = 0;
    for (int a = 0; a < shadow.nodes; ++a) sum += shape[a] * view.height(face.mesh.point(face.mesh.facet_node(facet, a)));
    return sum;
  }

  std::array<Corner, 4> integrate(mesh::Facet facet, const Without& without, bool means, const View& view, const Shadow& own, const std::vector<Cut>& cuts,
                                  double& least) const {
    std::vector<int> with;
    for (int k = 0; k < corners_; ++k)
      if (!without[k]) with.push_back(k);
    const auto count = static_cast<int>(with.size());
    if (count == 0) return {};
    DualHats first(count), second(count);
    for (const Cut& c : cuts)
      for (const FlatQuadrature::At& q : rule(own, c.shadow).points(c.polygon)) {
        const auto all = own.hats(q.x);
        double given = 0;
        for (int k = 0; k < corners_; ++k) given += without[k] ? all[k] : 0;
        std::array<double, 4> hats{};
        for (int k = 0; k < count; ++k) hats[k] = all[with[k]] + given / count;
        const auto other = c.shadow.shape(q.x);
        second.point(hats.data(), q.measure);
        for (int a = 0; a < c.shadow.nodes; ++a) second.value(second_.mesh.facet_node(second_.facets[c.facet], a), other[a]);
        const auto phi = own.shape(q.x);
        least = std::min(least, height(second_, second_.facets[c.facet], view, c.shadow, other) - height(first_, facet, view, own, phi));
        if (!means) continue;
        first.point(hats.data(), q.measure);
        for (int a = 0; a < own.nodes; ++a) first.value(first_.mesh.facet_node(facet, a), phi[a]);
      }
    std::array<Corner, 4> result;
    const Eigen::VectorXd weight = second.weights();
    for (int k = 0; k < count; ++k) result[with[k]].weight = weight[k];
    for (const auto& [node, moment] : second.moments())
      for (int k = 0; k < count; ++k) result[with[k]].partners[node] = moment[k];
    if (means)
      for (const auto& [node, moment] : first.moments())
        for (int k = 0; k < count; ++k) result[with[k]].own[node] = moment[k];
    return result;
  }

  const Face &first_, &second_;
  SecondFacets all_;
  int corners_;
  FlatQuadrature linear_{2}, bilinear_{3}, biquadratic_{4}, rational_{6};
};

/// Shares of which nothing but rounding is left are dropped; the rest is made 1 in sum.
std::vector<NodeWeight> mean_over(const std::map<int, double>& shares) {
  double sum = 0, rest = 0;
  for (const auto& [node, share] : shares) sum += share;
  std::vector<NodeWeight> partners;
  for (const auto& [node, share] : shares)
    if (std::abs(share) > 1e-13 * sum) partners.push_back({node, share}), rest += share;
  for (NodeWeight& p : partners) p.weight /= rest;
  return partners;
}

/// What facets give to their corners.
struct Given {
  std::array<Corner, 4> corner;
  Met met;
};

using SidesOf = std::vector<std::vector<std::pair<std::size_t, int>>>;  ///< facet → its node sides, and which corners they are

/// Facets that are covered and hang together by nodes that are: patch by patch their node sides.
std::vector<std::vector<std::size_t>> patches(const std::vector<double>& covered, const SidesOf& sides_of, const std::vector<Given>& given) {
  std::vector<std::size_t> root(covered.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t s) {
    while (root[s] != s) s = root[s] = root[root[s]];
    return s;
  };
  for (std::size_t f = 0; f < given.size(); ++f)
    for (const auto& [s, a] : sides_of[f])
      if (given[f].corner[a].weight > 0) root[find(s)] = find(sides_of[f].front().first);
  std::map<std::size_t, std::vector<std::size_t>> by_root;
  for (std::size_t s = 0; s < covered.size(); ++s)
    if (covered[s] > 0) by_root[find(s)].push_back(s);
  std::vector<std::vector<std::size_t>> all;
  for (auto& [_, patch] : by_root) all.push_back(std::move(patch));
  return all;
}

/// Do forces at these nodes balance every force along a normal and every moment that turns it: two nodes in the plane, three off a line in space?
bool hold(const mesh::Mesh& mesh, const std::vector<int>& nodes, double width) {
  constexpr double kOffLine = 0.2;  // of a facet's width
  if (nodes.size() < 2) return false;
  mesh::Point longest{};
  for (const int n : nodes)
    if (const mesh::Point way = mesh::minus(mesh.point(n), mesh.point(nodes.front())); mesh::length(way) > mesh::length(longest)) longest = way;
  if (mesh.dimension() == 2) return mesh::length(longest) > 0;
  return std::any_of(nodes.begin(), nodes.end(), [&](int n) {
    return mesh::off_line(mesh::minus(mesh.point(n), mesh.point(nodes.front())), mesh::unit(longest)) > kOffLine * width;
  });
}

/// Facet → its corners without a multiplier; none where all are well covered. A facet that is covered keeps one at least, and a patch as many as hold it.
std::vector<Without> poorly_covered(const Face& first, const std::vector<NodeSide>& sides, const SidesOf& sides_of, const std::vector<Given>& given) {
  std::vector<double> covered(sides.size(), 0);
  for (std::size_t f = 0; f < given.size(); ++f)
    for (const auto& [s, a] : sides_of[f]) covered[s] += given[f].corner[a].weight;
  std::vector<char> poor(sides.size(), 0);
  for (std::size_t s = 0; s < sides.size(); ++s) poor[s] = covered[s] > 0 && covered[s] < kLeastCovered * sides[s].weight;
  if (std::count(poor.begin(), poor.end(), 1) == 0) return {};
  const std::vector<char> found = poor;
  for (std::size_t f = 0; f < given.size(); ++f) {
    const bool is_covered = std::any_of(sides_of[f].begin(), sides_of[f].end(), [&](const auto& at) { return given[f].corner[at.second].weight > 0; });
    if (is_covered && std::all_of(sides_of[f].begin(), sides_of[f].end(), [&](const auto& at) { return found[at.first]; }))
      for (const auto& [s, a] : sides_of[f]) poor[s] = 0;
  }
  for (const std::vector<std::size_t>& patch : patches(covered, sides_of, given)) {
    std::vector<int> kept;
    double width = 0;
    for (const std::size_t s : patch) {
      width = std::max(width, given[static_cast<std::size_t>(sides[s].facets.front())].met.widest);
      if (!poor[s]) kept.push_back(sides[s].node);
    }
    if (!hold(first.mesh, kept, width))
      for (const std::size_t s : patch) poor[s] = 0;
  }
  std::vector<Without> without(first.facets.size(), Without{});
  for (std::size_t f = 0; f < given.size(); ++f)
    for (const auto& [s, a] : sides_of[f]) without[f][a] = poor[s];
  return without;
}

}  // namespace

std::vector<Across> mortar(const Face& first, const Face& second, const std::vector<NodeSide>& sides, Monitor* monitor) {
  const Mortar facets(first, second);
  SidesOf sides_of(first.facets.size());
  for (std::size_t s = 0; s < sides.size(); ++s)
    for (const int f : sides[s].facets)
      for (int a = 0; a < first.mesh.topology().facet_corners; ++a)
        if (first.mesh.facet_node(first.facets[f], a) == sides[s].node) sides_of[f].emplace_back(s, a);
  std::vector<Across> result(sides.size());
  for (Across& across : result) across.least = INFINITY;
  std::vector<std::map<int, double>> shares(sides.size()), own(sides.size());
  std::vector<Given> given(first.facets.size());
  bool means = first.mesh.topology().order == 2;
  const auto integrate = [&](const std::vector<Without>& without) {
    for (std::size_t f = 0; f < given.size(); ++f) {
      if (monitor && f % 100 == 0) monitor->check();
      given[f].met = {};
      given[f].corner = facets.of(first.facets[f], without.empty() ? Without{} : without[f], means, given[f].met);
    }
  };
  integrate({});
  if (const auto without = poorly_covered(first, sides, sides_of, given); !without.empty()) {
    means = true;
    integrate(without);
  }
  for (std::size_t f = 0; f < given.size(); ++f) {
    const auto& [corner, met] = given[f];
    for (const auto& [s, a] : sides_of[f]) {
      result[s].weight += corner[a].weight;
      result[s].widest = std::max(result[s].widest, met.widest);
      result[s].least = std::min(result[s].least, met.least);
      result[s].folded = result[s].folded || met.folded;
      for (const auto& [j, share] : corner[a].partners) shares[s][j] += share;
      for (const auto& [l, share] : corner[a].own) own[s][l] += share;
    }
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (!(result[s].weight > 0)) continue;
    result[s].partners = mean_over(shares[s]);
    if (own[s].empty()) continue;
    result[s].own = mean_over(own[s]);
    std::partition(result[s].own.begin(), result[s].own.end(), [&](const NodeWeight& n) { return n.node == sides[s].node; });
  }
  return result;
}

}  // namespace dotyk::contact
