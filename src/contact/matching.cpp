#include "contact/matching.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>

#include "base/error.hpp"
#include "base/text.hpp"
#include "contact/corner_means.hpp"
#include "contact/frame.hpp"

namespace dotyk::contact {
namespace {

using mesh::Mesh;
using mesh::Point;
using mesh::dot;
using mesh::length;
using mesh::minus;

double extent(const Mesh& mesh, const std::vector<NodeSide>& list) {
  double size = 0;
  const Point origin = mesh.point(list.front().node);
  for (const NodeSide& n : list) size = std::max(size, length(minus(mesh.point(n.node), origin)));
  return size;
}

/// Do the two sides look at each other? At corners and edges the mean normals may be far from parallel;
/// perpendicular ones belong to sides that only meet.
bool opposed(const Point& a, const Point& b) { return dot(a, b) < -0.1; }

/// Nodes of the second part in cells of the tolerance's size, to find coinciding ones.
class CoincidentSearch {
 public:
  CoincidentSearch(const Mesh& mesh, const std::vector<NodeSide>& list, double tolerance)
      : mesh_(mesh), tolerance_(tolerance) {
    for (const NodeSide& n : list) bins_[key(mesh.point(n.node), 0)].push_back(n);
  }
  /// Empty where none is there whose normal is opposed.
  const NodeSide* find(const Point& x, const Point& normal) const {
    for (int shift = 0; shift < 27; ++shift) {
      const auto bin = bins_.find(key(x, shift));
      if (bin == bins_.end()) continue;
      for (const NodeSide& n : bin->second)
        if (length(minus(mesh_.point(n.node), x)) <= tolerance_ && opposed(normal, n.normal)) return &n;
    }
    return nullptr;
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
  std::unordered_map<std::size_t, std::vector<NodeSide>> bins_;
};

/// How far d leads off the line along `normal`.
double off_line(const Point& d, const Point& normal) {
  const double along = dot(d, normal);
  return length(minus(d, mesh::times(along, normal)));
}

/// The nearest node of the second part across the gap from x: on the line through x along x's normal,
/// or with x on the line along its own normal; -1 if none.
int across(const Mesh& mesh, const std::vector<NodeSide>& list, const Point& x, const Point& normal,
           double tolerance) {
  int best = -1;
  double nearest = INFINITY;
  for (const NodeSide& n : list) {
    const Point d = minus(mesh.point(n.node), x);
    if (length(d) >= nearest || !opposed(normal, n.normal)) continue;
    if (std::min(off_line(d, normal), off_line(d, n.normal)) <= tolerance) {
      nearest = length(d);
      best = n.node;
    }
  }
  return best;
}

/// Does a node at x project into the facet, no further away than the facet is wide, normals opposed?
bool faces(const Mesh& mesh, mesh::Facet f, const Point& x, const Point& x_normal, double tolerance) {
  Point normal = mesh.facet_area_vector(f);
  const double area = length(normal);
  for (double& v : normal) v /= area;
  if (dot(normal, x_normal) > -0.8) return false;
  const int corners = mesh.topology().facet_corners;
  const double width = mesh.dimension() == 2 ? area : std::sqrt(area);
  for (int k = 0; k < corners; ++k) {
    const Point a = mesh.point(mesh.facet_node(f, k)), b = mesh.point(mesh.facet_node(f, (k + 1) % corners));
    const Point edge = minus(b, a), d = minus(x, a);
    if (std::abs(dot(d, normal)) > width || off_line(d, normal) <= tolerance) return false;
    if (mesh.dimension() == 2) {
      if (dot(edge, d) < 0) return false;  // both ends are seen as a: the foot lies between them
    } else {
      if (dot(mesh::cross(normal, edge), d) < -tolerance * length(edge)) return false;
    }
  }
  return true;
}

/// Says which node without partner nevertheless faces the other part; empty: none.
std::string mismatch(const Face& face, const std::vector<NodeSide>& lonely, const Face& other) {
  if (lonely.empty()) return "";
  const auto list = nodes(other.mesh, other.facets);
  const double tolerance = 1e-6 * extent(other.mesh, list);
  Point low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
  double width = 0;
  for (const mesh::Facet f : other.facets) {
    const double area = length(other.mesh.facet_area_vector(f));
    width = std::max(width, other.mesh.dimension() == 2 ? area : std::sqrt(area));
  }
  for (const NodeSide& n : list) {
    const Point p = other.mesh.point(n.node);
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i] - width), high[i] = std::max(high[i], p[i] + width);
  }
  for (const NodeSide& n : lonely) {
    const Point x = face.mesh.point(n.node);
    bool near = true;
    for (int i = 0; i < 3; ++i) near = near && x[i] >= low[i] && x[i] <= high[i];
    if (!near) continue;
    for (const mesh::Facet f : other.facets)
      if (faces(other.mesh, f, x, n.normal, tolerance))
        return text("the nodes of ", face.name, " and ", other.name, " do not match: the node at ",
                    point_text(x.data(), face.mesh.dimension()), " of ", face.name, " has no partner on the other side; use "
                    "meshes with matching nodes on the contact, or pairing = \"mortar\"");
  }
  return "";
}

}  // namespace

namespace {

/// Of order 2 the facets' functions must be the same, too: of triangles and quadrilaterals, or of order 1 and 2, with common
/// nodes, they are not, and forces that one side has from a uniform pressure are not the other's.
std::string unlike(const Face& first, const Face& second) {
  const mesh::ElementTopology &a = first.mesh.topology(), &b = second.mesh.topology();
  if ((a.order == 1 && b.order == 1) || a.nodes_per_facet == b.nodes_per_facet) return "";
  return text(first.name, " is of ", a.name, " and ", second.name, " of ", b.name, ": functions on their facets do not match");
}

}  // namespace

Matching find_matching(const Face& first, const Face& second) {
  if (const std::string why = unlike(first, second); !why.empty()) return {{}, why};
  const auto from = nodes(first.mesh, first.facets), to = nodes(second.mesh, second.facets);
  const double size = std::max(extent(first.mesh, from), extent(second.mesh, to));
  const double tolerance = 1e-6 * size;
  const CoincidentSearch coincident(second.mesh, to, tolerance);
  Matching result;
  std::vector<NodeSide> lonely;
  std::unordered_set<int> taken;
  for (const NodeSide& n : from) {
    const Point x = first.mesh.point(n.node);
    const NodeSide* same = coincident.find(x, n.normal);
    const int partner = same ? same->node : across(second.mesh, to, x, n.normal, tolerance);
    if (partner < 0) {
      lonely.push_back(n);
      continue;
    }
    taken.insert(partner);
    if (&first.mesh == &second.mesh && partner == n.node) continue;  // the tip of a crack moves with itself
    result.pairs.push_back({n.node, partner});
  }
  if (result.pairs.empty()) {
    result.mismatch = text(first.name, " and ", second.name, " do not face each other: no node of one has a node of "
                           "the other across from it, normals opposed");
    return result;
  }
  // Parts may overhang each other, but where they face each other every node must have its partner.
  result.mismatch = mismatch(first, lonely, second);
  if (!result.mismatch.empty()) return result;
  lonely.clear();
  for (const NodeSide& n : to)
    if (!taken.count(n.node)) lonely.push_back(n);
  result.mismatch = mismatch(second, lonely, first);
  return result;
}

std::vector<NodePair> match(const Face& first, const Face& second) {
  Matching found = find_matching(first, second);
  if (!found.mismatch.empty()) throw InputError(found.mismatch);
  return std::move(found.pairs);
}

ContactRow row_of(const NodeSide& side, std::vector<NodeWeight> partners, double added, const Frames& frames) {
  const Frame frame = frames.of(side, partners);
  return row_of(side, std::move(partners), added, frames.first, frames.second, frame);
}

ContactRow row_of(const NodeSide& side, std::vector<NodeWeight> partners, double added, const Face& first, const Face& second, const Frame& frame) {
  const Point x = first.mesh.point(side.node);
  Point own{0, 0, 0}, across{0, 0, 0};
  for (const NodeWeight& p : side.own)
    for (int i = 0; i < 3; ++i) own[i] += p.weight * first.mesh.point(p.node)[i];
  for (const NodeWeight& p : partners)
    for (int i = 0; i < 3; ++i) across[i] += p.weight * second.mesh.point(p.node)[i];
  const double gap = dot(minus(across, own), frame.normal) + added;
  if (!std::isfinite(gap))
    throw InputError(text("the gap is ", gap, " at ", point_text(x.data(), first.mesh.dimension()),
                          "; it must be a finite number"));
  return {side.node, side.own, std::move(partners), frame.normal, gap, side.weight, side.facets, added, frame.mix, frame.turn};
}

std::vector<ContactRow> mean_rows(const Face& first, const Face& second, std::unordered_map<int, std::vector<NodeWeight>> partner,
                                  const elasticity::ScalarField& added) {
  if (&first.mesh == &second.mesh)  // a crack's tip is its own partner: no jump there
    for (const NodeSide& n : nodes(second.mesh, second.facets)) partner.emplace(n.node, std::vector<NodeWeight>{{n.node, 1}});
  std::vector<char> used;
  for (const mesh::Facet f : first.facets) {
    bool all = true;
    for (int k = 0; k < first.mesh.topology().nodes_per_facet; ++k) all = all && partner.count(first.mesh.facet_node(f, k)) > 0;
    used.push_back(all);
  }
  const Frames frames(first, second);
  std::vector<ContactRow> rows;
  for (const NodeSide& side : corner_sides(first.mesh, first.facets, used)) {
    double more = 0, least = INFINITY;
    std::map<int, double> across;
    for (const NodeWeight& own : side.own) {
      if (added) more += own.weight * added(first.mesh.point(own.node));
      for (const NodeWeight& p : partner.at(own.node)) across[p.node] += own.weight * p.weight;
    }
    std::vector<NodeWeight> partners;
    for (const auto& [node, weight] : across) partners.push_back({node, weight});
    rows.push_back(row_of(side, std::move(partners), more, frames));
    ContactRow& row = rows.back();
    for (const NodeWeight& own : side.own) {
      double gap = -dot(first.mesh.point(own.node), row.normal);
      for (const NodeWeight& p : partner.at(own.node)) gap += p.weight * dot(second.mesh.point(p.node), row.normal);
      least = std::min(least, gap);
    }
    if (least >= -kTouching * first.mesh.size()) row.gap = std::max(row.gap, row.added);  // a dual hat is negative in places: a mean of gaps may be
  }
  return rows;
}

void refuse_overlap(const std::vector<ContactRow>& rows, const Face& first, const Face& second) {
  double deepest = 0;
  int node = -1;
  for (const ContactRow& row : rows) {
    const double overlap = std::max(row.gap, row.gap - row.added);  // a negative `added` is meant
    if (overlap < deepest) deepest = overlap, node = row.node;
  }
  if (deepest < -kTouching * first.mesh.size())
    throw InputError(text(first.name, " and ", second.name, " overlap by ", -deepest, " at ",
                          point_text(first.mesh.node(node), first.mesh.dimension()),
                          " before any load; move one, or say interference = true if the overlap is meant"));
}

std::vector<ContactRow> matching_rows(const std::vector<NodePair>& pairs, const Face& first, const Face& second,
                                      const elasticity::ScalarField& added, bool interference) {
  std::unordered_map<int, std::vector<NodeWeight>> partner;
  for (const NodePair& p : pairs) partner.emplace(p.first, std::vector<NodeWeight>{{p.second, 1}});
  std::vector<ContactRow> rows;
  if (first.mesh.topology().order == 2) {
    rows = mean_rows(first, second, std::move(partner), added);
  } else {
    const Frames frames(first, second);
    for (const NodeSide& side : sides(first.mesh, first.facets)) {
      const auto found = partner.find(side.node);
      if (found == partner.end()) continue;
      rows.push_back(row_of(side, found->second, added ? added(first.mesh.point(side.node)) : 0, frames));
    }
  }
  if (!interference) refuse_overlap(rows, first, second);
  return rows;
}

std::vector<ContactRow> between(const Face& first, const Face& second,
                                const elasticity::ScalarField& added, bool interference) {
  return matching_rows(match(first, second), first, second, added, interference);
}

namespace {

/// Throws InputError where a pair of nodes is no longer one: neither lies across from the other, by more than half of what the
/// first stands for.
void refuse_slid(const std::vector<ContactRow>& rows, const Face& first, const Face& second) {
  std::unordered_map<int, Point> normal;
  for (const NodeSide& n : nodes(second.mesh, second.facets)) normal.emplace(n.node, n.normal);
  for (const ContactRow& row : rows) {
    if (row.partners.size() != 1) continue;
    const int partner = row.partners.front().node;
    const Point d = minus(second.mesh.point(partner), first.mesh.point(row.node));
    const double slid = std::min(off_line(d, row.normal), off_line(d, normal.at(partner)));
    const double width = first.mesh.dimension() == 2 ? row.weight : std::sqrt(row.weight);
    if (slid > width / 2)
      throw InputError(text(first.name, " has moved along ", second.name, " by ", slid, " at ", point_text(first.mesh.node(row.node), first.mesh.dimension()),
                            ": pairs of nodes no longer lie across from each other; move parts towards or away from their partners"));
  }
}

}  // namespace

std::vector<ContactRow> moved_rows(const Mesh& before, const std::vector<ContactRow>& rows, const Face& first, const Face& second,
                                   bool interference) {
  const auto across = smooth_sides(second);
  std::vector<ContactRow> result;
  for (const NodeSide& side : moved_sides(before, first.mesh, first.facets, first.name)) {
    if (result.size() == rows.size()) break;
    const ContactRow& row = rows[result.size()];  // rows are sides, those without partner left out
    if (row.node != side.node || row.facets != side.facets) continue;
    const Point normal = mixed_normal(side.normal, inward_across(side.normal, row.partners, across), row.mix);
    result.push_back(row_of(side, row.partners, row.added, first, second, {normal, row.mix, row.turn}));
  }
  if (result.size() != rows.size()) throw std::logic_error("contact rows are not of this part");
  refuse_slid(result, first, second);
  if (!interference) refuse_overlap(result, first, second);
  return result;
}

}  // namespace dotyk::contact
