#include "scene/model/row_builder.hpp"

#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "contact/contact_row.hpp"

namespace dotyk::scene {
namespace {

using mesh::Point;
using mesh::dot;
using problem::LawChoice;

/// Rows of one LawSupport, as they are made.
class SupportRowMaker {
 public:
  SupportRowMaker(int body, const LawSupport& support, RowBuilder& builder, Model& model)
      : body_(body), on_(model.bodies[body]), support_(support), builder_(builder), model_(model),
        rows_(support.nodes.size()) {}

  std::vector<SupportRows> operator()() {
    if (support_.normal.law.spec->rows) normal();
    if (support_.tangential->rubs())
      friction();
    else if (support_.tangential.law.spec->rows)
      tangential();
    return std::move(rows_);
  }

 private:
  std::string name(const char* direction) const {
    return text(direction, " support of '", on_.name, "' ", support_.part.name);
  }

  void normal() {
    builder_.rows.open_group(name("normal"), support_.normal.law);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const contact::NodeSide& side = support_.nodes[k];
      const LawChoice law = support_.normal[k];
      rows_[k].normal = add(side, side.normal, law, -law.displacement(), support_.breaks(k) ? 0 : side.weight);
    }
  }

  void tangential() {
    builder_.rows.open_group(name("tangential"), support_.tangential.law);
    for (std::size_t k = 0; k < rows_.size(); ++k)
      for (const Point& t : contact::tangents(support_.nodes[k].normal, on_.dimension())) {
        const LawChoice law = support_.tangential[k];
        const int row = add(support_.nodes[k], t, law, law.displacement(), support_.nodes[k].weight);
        if (row >= 0) rows_[k].add(row, t);
      }
  }

  /// Points with one free tangent and points with two make two groups, because all points of a group have the same number of rows. Points of an
  /// infinite bound do not slip.
  void friction() {
    const bool coulomb = support_.tangential->follows && !support_.normal->load;
    for (int components = 1; components < on_.dimension(); ++components) {
      const int first = builder_.rows.open_friction();
      std::vector<double> bounds;
      std::vector<int> normal;
      for_each_rubbing(components, true, [&](std::size_t k, const std::vector<Point>& free) {
        if (coulomb && rows_[k].normal < 0) return;
        add_tangents(k, free);
        bounds.push_back(coulomb ? bound(k) : bound(k) * support_.nodes[k].weight);
        normal.push_back(coulomb ? rows_[k].normal : -1);
      });
      if (bounds.empty()) continue;
      auto law = coulomb ? problem::coulomb(std::move(bounds)) : problem::tresca(std::move(bounds));
      model_.problem.friction.push_back({name("tangential"), std::move(law), first, components, std::move(normal)});
    }
    builder_.rows.open_group(name("tangential") + " (no slip)", problem::bilateral());
    for (int components = 1; components < on_.dimension(); ++components)
      for_each_rubbing(components, false, [&](std::size_t k, const std::vector<Point>& free) { add_tangents(k, free); });
  }

  /// Calls act(node, its free tangents) at nodes of a bound that is not 0, and finite where it `slips`.
  template <class Act>
  void for_each_rubbing(int components, bool slips, Act&& act) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const std::vector<Point> free = free_tangents(support_.nodes[k]);
      if (static_cast<int>(free.size()) == components && bound(k) != 0 && std::isfinite(bound(k)) == slips) act(k, free);
    }
  }

  void add_tangents(std::size_t k, const std::vector<Point>& free) {
    for (const Point& t : free) rows_[k].add(add(support_.nodes[k], t, support_.tangential[k], 0, support_.nodes[k].weight), t);
  }

  /// The bound per length or area, or the coefficient; under a given pressure the bound is given.
  double bound(std::size_t k) const {
    const double value = support_.tangential[k].numbers[0];
    return support_.tangential->follows && support_.normal->load ? value * std::max(0.0, support_.normal[k].force()) : value;
  }

  std::vector<Point> free_tangents(const contact::NodeSide& side) const {
    std::vector<Point> free = contact::tangents(side.normal, on_.dimension());
    std::erase_if(free, [&](const Point& t) { return !moves(side, t); });
    return free;
  }

  /// The row direction·u = gap, or -1 where nothing moves.
  int add(const contact::NodeSide& side, const Point& direction, const LawChoice& law, double gap, double share) {
    if (moves(side, direction)) return builder_.add(body_, side.own, direction, gap, share, &law);
    if (!unknown_along(model_.numbering[body_], side.own, direction, on_.dimension())) builder_.add(body_, side.own, direction, gap);  // no row; gap changes
    const double rounding = 1e-12 * on_.mesh->size();
    if (law->prescribes ? std::abs(gap) > rounding : law->stop() && gap < -rounding)
      throw InputError(text("contradictory supports on '", on_.name, "': at the node ",
                            point_text(on_.mesh->node(side.node), on_.dimension()), " the ", law.spec->words, " law of part '", support_.part.name,
                            "' and the displacement that other supports hold differ by ", std::abs(gap)));
    return -1;
  }

  bool moves(const contact::NodeSide& side, const Point& direction) const {
    return scene::moves(on_, model_.numbering[body_], side, direction);
  }

  int body_;
  const Body& on_;
  const LawSupport& support_;
  RowBuilder& builder_;
  Model& model_;
  std::vector<SupportRows> rows_;
};

}  // namespace

int RowBuilder::add(int body, const std::vector<contact::NodeWeight>& mean, const Point& direction, double& gap, double share, const LawChoice* own) {
  return add(body, -1, {{mean, {}, direction}}, gap, share, own);
}

int RowBuilder::add(int body, int other_body, const std::vector<Pull>& pulls, double& gap, double share, const LawChoice* own_law) {
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
  return rows.add(gap, share, own_law);
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

void add_support_rows(int body, RowBuilder& builder, Model& model) {
  model.support_row.emplace_back();
  for (const LawSupport& support : model.bodies[body].laws)
    model.support_row.back().push_back(SupportRowMaker(body, support, builder, model)());
}

Point law_load(const LawSupport& support, std::size_t k, int dimension) {
  const contact::NodeSide& side = support.nodes[k];
  Point force{0, 0, 0};
  const Point t = contact::tangents(side.normal, dimension).front();
  for (int i = 0; i < dimension; ++i) {
    force[i] -= support.normal[k].force() * side.weight * side.normal[i];
    force[i] += support.tangential[k].force() * side.weight * t[i];
  }
  return force;
}

void add_law_loads(Body& body) {
  const int dim = body.dimension();
  for (const LawSupport& support : body.laws)
    for (std::size_t k = 0; k < support.nodes.size(); ++k) {
      const Point force = law_load(support, k, dim);
      if (force == Point{0, 0, 0}) continue;
      for (const contact::NodeWeight& own : support.nodes[k].own)
        for (int i = 0; i < dim; ++i) nodal_loads(body)[static_cast<std::size_t>(own.node) * dim + i] += own.weight * force[i];
    }
}

double broken_energy(const Body& body) {
  double energy = 0;
  for (const LawSupport& s : body.laws)
    for (std::size_t k = 0; k < s.nodes.size(); ++k)
      if (s.breaks(k)) energy += problem::breaking_energy(s.normal[k]) * s.nodes[k].weight;
  return energy;
}

}  // namespace dotyk::scene
