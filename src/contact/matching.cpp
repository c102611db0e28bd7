#include "contact/matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include "base/error.hpp"
#include "contact/frame.hpp"
#include "contact/second_facets.hpp"

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

double rounding_of(const Mesh& mesh) {
  double greatest = 0;
  for (const double x : mesh.coordinates) greatest = std::max(greatest, std::abs(x));
  return 64 * std::numeric_limits<double>::epsilon() * greatest;
}

/// How far apart two places may be that are meant to be one. In `size` coordinates, of files too, are rounded; but beside the way to
/// the next node it is little, however small that is.
struct Tolerance {
  double size, rounding;
  double operator()(double way) const { return std::max(std::min(kTouching * size, 1e-3 * way), rounding); }
};

/// Do the two sides look at each other? At corners and edges the mean normals may be far from parallel;
/// perpendicular ones belong to sides that only meet.
bool opposed(const Point& a, const Point& b) { return dot(a, b) < -0.1; }

/// A part's nodes, to be found near lines.
class Nodes {
 public:
  explicit Nodes(const Face& face) : mesh(face.mesh), list(nodes(face.mesh, face.facets)), way_(face.mesh.node_count(), INFINITY), tree_(points()) {
    const int count = mesh.topology().nodes_per_facet;
    for (const mesh::Facet f : face.facets)
      for (int a = 0; a < count; ++a)
        for (int b = 0; b < a; ++b) {
          const int i = mesh.facet_node(f, a), j = mesh.facet_node(f, b);
          const double way = length(minus(mesh.point(i), mesh.point(j)));
          way_[i] = std::min(way_[i], way), way_[j] = std::min(way_[j], way);
        }
  }
  Point at(std::size_t k) const { return mesh.point(list[k].node); }
  /// To the nearest node of the same facet.
  double way(int node) const { return way_[node]; }
  /// Those whose distance from the line through x along `normal` may be `radius`.
  std::vector<int> near(const Point& x, const Point& normal, double radius) const {
    const Tube tube(x, View(x, normal, mesh.dimension()).axis, radius);
    return tree_.find([&](const Box& box) { return tube.meets(box); });
  }

  const Mesh& mesh;
  const std::vector<NodeSide> list;

 private:
  std::vector<Box> points() const {
    std::vector<Box> all(list.size());
    for (std::size_t k = 0; k < list.size(); ++k) all[k].add(at(k));
    return all;
  }
  std::vector<double> way_;
  BoxTree tree_;
};

/// A node of the first part and one of the second on the line along either's normal.
struct Candidate {
  double distance;
  int first, second;  ///< in their lists
  auto operator<=>(const Candidate&) const = default;
};

std::vector<Candidate> candidates(const Nodes& from, const Nodes& to, const Tolerance& tolerance) {
  std::vector<Candidate> all;
  const auto look = [&](const Nodes& here, const Nodes& there, bool turned) {
    for (std::size_t k = 0; k < here.list.size(); ++k) {
      const NodeSide& n = here.list[k];
      for (const int j : there.near(here.at(k), n.normal, tolerance(here.way(n.node)))) {
        const NodeSide& other = there.list[j];
        const Point d = minus(there.at(j), here.at(k));
        if (!opposed(n.normal, other.normal)) continue;
        if (mesh::off_line(d, n.normal) > tolerance(std::min(here.way(n.node), there.way(other.node)))) continue;
        const int i = static_cast<int>(k);
        all.push_back({length(d), turned ? j : i, turned ? i : j});
      }
    }
  };
  look(from, to, false);
  look(to, from, true);
  std::sort(all.begin(), all.end());
  return all;
}

/// Partner of each node of the first part in the second's list, -1 for none: the nearest candidate that no nearer node
/// has, but for nodes at one place (the lips of a crack), which may share it.
std::vector<int> partners(const Nodes& from, const Nodes& to, const Tolerance& tolerance) {
  std::vector<int> partner(from.list.size(), -1), owner(to.list.size(), -1);
  for (const Candidate& c : candidates(from, to, tolerance)) {
    if (partner[c.first] >= 0) continue;
    int& holds = owner[c.second];
    const auto apart = [&] { return length(minus(from.at(c.first), from.at(holds))) > tolerance(from.way(from.list[c.first].node)); };
    if (holds >= 0 && apart()) continue;
    if (holds < 0) holds = c.first;
    partner[c.first] = c.second;
  }
  return partner;
}

/// Does a node at x project into the facet, no further away than the facet is wide, normals opposed?
bool faces(const Mesh& mesh, mesh::Facet f, const Point& x, const Point& x_normal, double tolerance) {
  const Point area = mesh.facet_area_vector(f), normal = mesh::unit(area);
  if (dot(normal, x_normal) > -0.8) return false;
  const double width = mesh.dimension() == 2 ? length(area) : std::sqrt(length(area));
  const Shadow shadow(mesh, f, View(x, normal, mesh.dimension()));
  for (int k = 0; k < shadow.corners; ++k)
    if (std::abs(shadow.height[k]) > width || shadow.at[k].norm() <= tolerance) return false;
  return shadow.holds({0, 0}, tolerance / width);
}

/// Says which node without partner nevertheless faces the other part; empty: none.
std::string mismatch(const Face& face, const std::vector<NodeSide>& lonely, const Face& other, const Nodes& others, const Tolerance& tolerance) {
  if (lonely.empty()) return "";
  const BoxTree tree(boxes(other, 1.01));
  for (const NodeSide& n : lonely) {
    const Point x = face.mesh.point(n.node);
    for (const int k : tree.find([&](const Box& box) { return box.holds(x); })) {
      const mesh::Facet f = other.facets[k];
      double way = INFINITY;
      for (int a = 0; a < other.mesh.topology().facet_corners; ++a) way = std::min(way, others.way(other.mesh.facet_node(f, a)));
      if (faces(other.mesh, f, x, n.normal, tolerance(way)))
        return text("the nodes of ", face.name, " and ", other.name, " do not match: the node at ",
                    point_text(x.data(), face.mesh.dimension()), " of ", face.name, " has no partner on the other side; use "
                    "meshes with matching nodes on the contact, or pairing = \"mortar\"");
    }
  }
  return "";
}

/// Of order 2 the facets' functions must be the same, too: of triangles and quadrilaterals, or of order 1 and 2, with common
/// nodes, they are not, and forces that one side has from a uniform pressure are not the other's.
std::string unlike(const Face& first, const Face& second) {
  const mesh::ElementTopology &a = first.mesh.topology(), &b = second.mesh.topology();
  if ((a.order == 1 && b.order == 1) || a.nodes_per_facet == b.nodes_per_facet) return "";
  return text(first.name, " is of ", a.name, " and ", second.name, " of ", b.name, ": functions on their facets do not match");
}

/// Throws InputError where a pair of nodes is no longer one: neither lies across from the other, by more than half of what the
/// first stands for.
void refuse_slid(const std::vector<ContactRow>& rows, const Face& first, const Face& second) {
  std::unordered_map<int, Point> normal;
  for (const NodeSide& n : nodes(second.mesh, second.facets)) normal.emplace(n.node, n.normal);
  for (const ContactRow& row : rows) {
    if (row.partners.size() != 1) continue;
    const int partner = row.partners.front().node;
    const Point d = minus(second.mesh.point(partner), first.mesh.point(row.node));
    const double slid = std::min(mesh::off_line(d, row.normal), mesh::off_line(d, normal.at(partner)));
    const double width = first.mesh.dimension() == 2 ? row.weight : std::sqrt(row.weight);
    if (slid > width / 2)
      throw InputError(text(first.name, " has moved along ", second.name, " by ", slid, " at ", point_text(first.mesh.node(row.node), first.mesh.dimension()),
                            ": pairs of nodes no longer lie across from each other; move parts towards or away from their partners"));
  }
}

}  // namespace

Matching find_matching(const Face& first, const Face& second) {
  if (const std::string why = unlike(first, second); !why.empty()) return {{}, why};
  const Nodes from(first), to(second);
  const Tolerance tolerance{std::max(extent(first.mesh, from.list), extent(second.mesh, to.list)),
                            std::max(rounding_of(first.mesh), rounding_of(second.mesh))};
  const std::vector<int> partner = partners(from, to, tolerance);
  Matching result;
  std::vector<NodeSide> lonely;
  std::vector<char> taken(to.list.size(), 0);
  for (std::size_t k = 0; k < partner.size(); ++k) {
    const NodeSide& n = from.list[k];
    if (partner[k] < 0) {
      lonely.push_back(n);
      continue;
    }
    taken[partner[k]] = 1;
    const int across = to.list[partner[k]].node;
    if (&first.mesh == &second.mesh && across == n.node) continue;  // the tip of a crack moves with itself
    result.pairs.push_back({n.node, across});
  }
  if (result.pairs.empty()) {
    result.mismatch = text(first.name, " and ", second.name, " do not face each other: no node of one has a node of "
                           "the other across from it, normals opposed");
    return result;
  }
  // Parts may overhang each other, but where they face each other every node must have its partner.
  result.mismatch = mismatch(first, lonely, second, to, tolerance);
  if (!result.mismatch.empty()) return result;
  lonely.clear();
  for (std::size_t j = 0; j < taken.size(); ++j)
    if (!taken[j]) lonely.push_back(to.list[j]);
  result.mismatch = mismatch(second, lonely, first, from, tolerance);
  return result;
}

double touching(const Face& face, double size, const std::vector<int>& facets) {
  double way = INFINITY, greatest = 0;
  const int count = face.mesh.topology().facet_corners;
  for (const int f : facets)
    for (int a = 0; a < count; ++a) {
      const Point x = face.mesh.point(face.mesh.facet_node(face.facets[f], a)), y = face.mesh.point(face.mesh.facet_node(face.facets[f], (a + 1) % count));
      way = std::min(way, length(minus(x, y)));
      greatest = std::max(greatest, length(x));
    }
  return Tolerance{size, 64 * std::numeric_limits<double>::epsilon() * greatest}(way);
}

void refuse_overlap(const std::vector<ContactRow>& rows, const Face& first, const Face& second) {
  const double size = first.mesh.size();
  double deepest = 0;
  int node = -1;
  for (const ContactRow& row : rows) {
    const double overlap = std::max(row.gap, row.gap - row.added);  // a negative `added` is meant
    if (overlap < deepest && overlap < -touching(first, size, row.facets)) deepest = overlap, node = row.node;
  }
  if (node >= 0)
    throw InputError(text(first.name, " and ", second.name, " overlap by ", -deepest, " at ",
                          point_text(first.mesh.node(node), first.mesh.dimension()),
                          " before any load; move one, or say interference = true if the overlap is meant"));
}

ContactRow row_of(const NodeSide& side, std::vector<NodeWeight> partners, double added, const Frames& frames) {
  const Frame frame = frames.of(side, partners);
  return row_of(side, std::move(partners), added, frames.first, frames.second, frame);
}

ContactRow row_of(const NodeSide& side, std::vector<NodeWeight> partners, double added, const Face& first, const Face& second, const Frame& frame) {
  const Point x = first.mesh.point(side.node);
  const double gap = dot(minus(mean_place(partners, second.mesh), mean_place(side.own, first.mesh)), frame.normal) + added;
  if (!std::isfinite(gap))
    throw InputError(text("the gap is ", gap, " at ", point_text(x.data(), first.mesh.dimension()),
                          "; it must be a finite number"));
  return {.node = side.node, .own = side.own, .partners = std::move(partners), .normal = frame.normal, .gap = gap, .weight = side.weight,
          .facets = side.facets, .added = added, .mix = frame.mix, .turn = frame.turn};
}

std::vector<ContactRow> node_rows(const Face& first, const Face& second, std::unordered_map<int, std::vector<NodeWeight>> partner,
                                  const elasticity::ScalarField& added) {
  const bool means = first.mesh.topology().order == 2;
  if (means && &first.mesh == &second.mesh)  // a crack's tip is its own partner: no jump there
    for (const NodeSide& n : nodes(second.mesh, second.facets)) partner.emplace(n.node, std::vector<NodeWeight>{{n.node, 1}});
  std::vector<char> used;
  for (const mesh::Facet f : first.facets) {
    bool all = true;
    for (int k = 0; k < first.mesh.topology().nodes_per_facet; ++k) all = all && partner.count(first.mesh.facet_node(f, k)) > 0;
    used.push_back(all);
  }
  const Frames frames(first, second);
  std::vector<ContactRow> rows;
  const double size = first.mesh.size();
  for (const NodeSide& side : corner_sides(first.mesh, first.facets, used)) {
    if (!means && !partner.contains(side.node)) continue;
    double more = 0, least = INFINITY;
    std::map<int, double> across;
    for (const NodeWeight& own : side.own) {
      if (added) more += own.weight * added(first.mesh.point(own.node));
      for (const NodeWeight& p : partner.at(own.node)) across[p.node] += own.weight * p.weight;
    }
    std::vector<NodeWeight> partners;
    for (const auto& [node, weight] : across) partners.push_back({node, weight});
    rows.push_back(row_of(side, std::move(partners), more, frames));
    if (!means) continue;
    ContactRow& row = rows.back();
    for (const NodeWeight& own : side.own) {
      double gap = -dot(first.mesh.point(own.node), row.normal);
      for (const NodeWeight& p : partner.at(own.node)) gap += p.weight * dot(second.mesh.point(p.node), row.normal);
      least = std::min(least, gap);
    }
    if (least >= -touching(first, size, side.facets)) row.gap = std::max(row.gap, row.added);  // a dual hat is negative in places: a mean of gaps may be
  }
  return rows;
}

std::vector<ContactRow> matching_rows(const std::vector<NodePair>& pairs, const Face& first, const Face& second,
                                      const elasticity::ScalarField& added, bool interference) {
  std::unordered_map<int, std::vector<NodeWeight>> partner;
  for (const NodePair& p : pairs) partner.emplace(p.first, std::vector<NodeWeight>{{p.second, 1}});
  std::vector<ContactRow> rows = node_rows(first, second, std::move(partner), added);
  if (!interference) refuse_overlap(rows, first, second);
  return rows;
}

std::vector<ContactRow> moved_rows(const Mesh& before, const Mesh& second_before, const std::vector<ContactRow>& rows, const Face& first, const Face& second,
                                   bool interference) {
  const auto across = smooth_sides(second);
  const Frames frames(first, second);
  std::vector<ContactRow> result;
  for (const NodeSide& side : moved_sides(before, first.mesh, first.facets, first.name)) {
    if (result.size() == rows.size()) break;
    const ContactRow& row = rows[result.size()];  // rows are sides, those without partner left out
    if (row.node != side.node || row.facets != side.facets) continue;
    const auto mix = mix_of_moving(row, &first.mesh == &before, &second.mesh == &second_before);
    const Point normal = mixed_normal(side.normal, inward_across(side.normal, row.partners, across), mix);
    result.push_back(row_of(side, row.partners, row.added, first, second, {normal, mix, frames.of(side, row.partners).turn}));
  }
  if (result.size() != rows.size()) throw std::logic_error("contact rows are not of this part");
  refuse_slid(result, first, second);
  if (!interference) refuse_overlap(result, first, second);
  return result;
}

}  // namespace dotyk::contact
