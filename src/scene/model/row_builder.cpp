#include "scene/model/row_builder.hpp"

#include <cmath>

#include "base/text.hpp"

namespace dotyk::scene {

using mesh::Point;
using mesh::dot;

int RowBuilder::add(int body, const std::vector<contact::NodeWeight>& mean, const Point& direction, double& gap, double share) {
  return add(body, -1, {{mean, {}, direction}}, gap, share);
}

int RowBuilder::add(int body, int other_body, const std::vector<Pull>& pulls, double& gap, double share) {
  const Pull* main = &pulls.front();
  const std::size_t held = model_.held.size();
  for (const Pull& pull : pulls) {
    for (const contact::NodeWeight& own : pull.own) collect(body, own.node, pull.direction, own.weight, gap);
    if (other_body >= 0)
      for (const contact::NodeWeight& partner : pull.partners) collect(other_body, partner.node, pull.direction, -partner.weight, gap);
    else
      gap += dot(pull.direction, move_);
    if (dot(pull.direction, pull.direction) > dot(main->direction, main->direction)) main = &pull;
  }
  if (!rows.any()) {
    model_.held.resize(held);
    return -1;
  }
  places_.push_back({body, main->own.front().node});
  return rows.add(gap, share);
}

void RowBuilder::add(int body, const elasticity::SpringRows& springs) {
  const problem::Block& block = model_.problem.blocks[body];
  rows.open_group("springs of '" + block.name + "'", problem::elastic({springs.stiffness.begin(), springs.stiffness.end()}));
  for (int r = 0; r < springs.S.rows(); ++r) {
    std::vector<std::pair<int, double>> entries;
    for (algebra::SparseRows::InnerIterator it(springs.S, r); it; ++it) entries.emplace_back(block.first + static_cast<int>(it.col()), it.value());
    places_.push_back({body, block.node[static_cast<std::size_t>(entries.front().first - block.first)]});
    rows.add(entries, springs.c[r]);
  }
}

void RowBuilder::finish() {
  std::vector<std::string> names;
  std::vector<std::shared_ptr<const mesh::Mesh>> meshes;
  for (const auto& body : scene_.bodies) {
    names.push_back(body->name);
    meshes.push_back(body->mesh);
  }
  rows.finish([names, meshes, places = places_](int row) {
    const Place p = places[row];
    return text("node ", p.node + 1, " of '", names[p.body], "' at ",
                point_text(meshes[p.body]->node(p.node), meshes[p.body]->dimension()));
  });
}

void RowBuilder::collect(int body, int node, const Point& direction, double sign, double& gap) {
  const int dim = scene_.dimension();
  const elasticity::Numbering& numbering = model_.numbering[body];
  const double rounding = 1e-14 * std::sqrt(dot(direction, direction));  // of normals; a row must not be met by a displacement of 1/ε of its gap
  for (int i = 0; i < dim; ++i) {
    if (std::abs(direction[i]) <= rounding) continue;
    const std::size_t at = static_cast<std::size_t>(node) * dim + i;
    if (numbering.unknown[at] >= 0) {
      rows.entry(model_.problem.blocks[body].first + numbering.unknown[at], sign * direction[i]);
      continue;
    }
    model_.held.push_back({rows.count(), body, at, sign * direction[i]});
    gap -= sign * direction[i] * numbering.value(at);
  }
}

}  // namespace dotyk::scene
