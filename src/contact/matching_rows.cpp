#include <cmath>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include "base/error.hpp"
#include "base/text.hpp"
#include "contact/frame.hpp"
#include "contact/matching.hpp"

namespace dotyk::contact {

using mesh::Mesh;
using mesh::Point;
using mesh::dot;
using mesh::minus;

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
    const double slid = std::min(mesh::off_line(d, row.normal), mesh::off_line(d, normal.at(partner)));
    const double width = first.mesh.dimension() == 2 ? row.weight : std::sqrt(row.weight);
    if (slid > width / 2)
      throw InputError(text(first.name, " has moved along ", second.name, " by ", slid, " at ", point_text(first.mesh.node(row.node), first.mesh.dimension()),
                            ": pairs of nodes no longer lie across from each other; move parts towards or away from their partners"));
  }
}

}  // namespace

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
