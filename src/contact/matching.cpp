#include "contact/matching.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/error.hpp"
#include "base/text.hpp"
#include "contact/sides.hpp"

namespace dotyk::contact {
namespace {

using mesh::Mesh;
using mesh::Point;

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double length(const Point& a) { return std::sqrt(dot(a, a)); }

double extent(const Mesh& mesh, const std::vector<NodeSide>& list) {
  double size = 0;
  const Point origin = mesh.point(list.front().node);
  for (const NodeSide& n : list) size = std::max(size, length(minus(mesh.point(n.node), origin)));
  return size;
}

/// Nodes of the second part in cells of the tolerance's size, to find coinciding ones.
class CoincidentSearch {
 public:
  CoincidentSearch(const Mesh& mesh, const std::vector<NodeSide>& list, double tolerance)
      : mesh_(mesh), tolerance_(tolerance) {
    for (const NodeSide& n : list) bins_[key(mesh.point(n.node), 0)].push_back(n.node);
  }
  int find(const Point& x) const {
    for (int shift = 0; shift < 27; ++shift) {
      const auto bin = bins_.find(key(x, shift));
      if (bin == bins_.end()) continue;
      for (int n : bin->second)
        if (length(minus(mesh_.point(n), x)) <= tolerance_) return n;
    }
    return -1;
  }

 private:
  /// `shift` 0 is the bin of x itself; 1 … 26 its neighbours.
  std::size_t key(const Point& x, int shift) const {
    static const int step[3] = {0, -1, 1};
    std::size_t h = 0;
    for (int i = 0; i < 3; ++i, shift /= 3) {
      const auto k = static_cast<long long>(std::floor(x[i] / (2 * tolerance_))) + step[shift % 3];
      h = h * 1000003u + static_cast<std::size_t>(k);
    }
    return h;
  }
  const Mesh& mesh_;
  double tolerance_;
  std::unordered_map<std::size_t, std::vector<int>> bins_;
};

/// How far d leads off the line along `normal`.
double off_line(const Point& d, const Point& normal) {
  const double along = dot(d, normal);
  return length({d[0] - along * normal[0], d[1] - along * normal[1], d[2] - along * normal[2]});
}

/// The nearest node of the second part across the gap from x: on the line through x along x's normal,
/// or with x on the line along its own normal; -1 if none.
int across(const Mesh& mesh, const std::vector<NodeSide>& list, const Point& x, const Point& normal,
           double tolerance) {
  int best = -1;
  double nearest = INFINITY;
  for (const NodeSide& n : list) {
    const Point d = minus(mesh.point(n.node), x);
    if (length(d) < nearest && std::min(off_line(d, normal), off_line(d, n.normal)) <= tolerance) {
      nearest = length(d);
      best = n.node;
    }
  }
  return best;
}

}  // namespace

std::vector<NodePair> match(const Face& first, const Face& second) {
  const auto from = nodes(first.mesh, first.facets), to = nodes(second.mesh, second.facets);
  const double size = std::max(extent(first.mesh, from), extent(second.mesh, to));
  const double tolerance = 1e-6 * size;
  const CoincidentSearch coincident(second.mesh, to, tolerance);
  std::vector<NodePair> pairs;
  int lonely = -1;
  for (const NodeSide& n : from) {
    const Point x = first.mesh.point(n.node);
    int partner = coincident.find(x);
    if (partner < 0) partner = across(second.mesh, to, x, n.normal, tolerance);
    if (partner < 0) {
      if (lonely < 0) lonely = n.node;
      continue;
    }
    pairs.push_back({n.node, partner, dot(minus(second.mesh.point(partner), x), n.normal)});
  }
  // Parts may overhang each other, but where they face each other every node must have its partner.
  if (pairs.empty() || (lonely >= 0 && 2 * pairs.size() < std::min(from.size(), to.size())))
    throw InputError(text("the nodes of ", first.name, " and ", second.name, " do not match: the node at ",
                          point_text(first.mesh.point(lonely).data(), first.mesh.dimension()),
                          " has no partner on its normal; use meshes with matching nodes on the contact"));
  return pairs;
}

std::vector<ContactRow> between(const Face& first, const Face& second,
                                const elasticity::ScalarField& added) {
  std::unordered_map<int, NodePair> partner;
  for (const NodePair& p : match(first, second)) partner.emplace(p.first, p);
  std::vector<ContactRow> rows;
  for (const NodeSide& side : sides(first.mesh, first.facets)) {
    const auto found = partner.find(side.node);
    if (found == partner.end()) continue;
    const Point x = first.mesh.point(side.node);
    double gap = dot(minus(second.mesh.point(found->second.second), x), side.normal);
    if (added) gap += added(x);
    if (!std::isfinite(gap))
      throw InputError(text("the gap is ", gap, " at ", point_text(x.data(), first.mesh.dimension()),
                            "; it must be a finite number"));
    rows.push_back({side.node, found->second.second, side.normal, gap, side.weight});
  }
  return rows;
}

}  // namespace dotyk::contact
