#include "scene/row_builder.hpp"

#include <cmath>

#include "base/text.hpp"

namespace dotyk::scene {

using mesh::Point;

void RowBuilder::open_group(const std::string& name, std::shared_ptr<const problem::Law> law) {
  scalar_ = true;
  model_.problem.groups.push_back({name, std::move(law), count_, 0});
}

int RowBuilder::open_friction() {
  scalar_ = false;
  return count_;
}

int RowBuilder::add(int body, int node, int other_body, int other_node, const Point& direction, double& gap) {
  const std::size_t before = entries_.size();
  collect(body, node, direction, 1, gap);
  if (other_body >= 0) collect(other_body, other_node, direction, -1, gap);
  if (entries_.size() == before) return -1;
  gaps_.push_back(gap);
  places_.push_back({body, node});
  if (scalar_) ++model_.problem.groups.back().count;
  return count_++;
}

void RowBuilder::finish() {
  model_.problem.B.resize(count_, model_.problem.unknowns());
  model_.problem.B.setFromTriplets(entries_.begin(), entries_.end());
  model_.problem.c = Eigen::Map<const algebra::Vector>(gaps_.data(), count_);
  std::vector<std::string> names;
  std::vector<std::shared_ptr<const mesh::Mesh>> meshes;
  for (const auto& body : scene_.bodies) {
    names.push_back(body->name);
    meshes.push_back(body->mesh);
  }
  model_.problem.row_name = [names, meshes, places = places_](int row) {
    const Place p = places[row];
    return text("node ", p.node + 1, " of '", names[p.body], "' at ",
                point_text(meshes[p.body]->node(p.node), meshes[p.body]->dimension()));
  };
}

void RowBuilder::collect(int body, int node, const Point& direction, double sign, double& gap) {
  const int dim = scene_.dimension();
  const elasticity::Numbering& numbering = model_.numbering[body];
  for (int i = 0; i < dim; ++i) {
    if (direction[i] == 0) continue;
    const std::size_t at = static_cast<std::size_t>(node) * dim + i;
    if (numbering.unknown[at] >= 0)
      entries_.emplace_back(count_, model_.problem.blocks[body].first + numbering.unknown[at],
                            sign * direction[i]);
    else
      gap -= sign * direction[i] * numbering.prescribed[at];
  }
}

namespace {

/// Unit tangents: one in the plane, two in space.
std::vector<Point> tangents(const Point& n, int dim) {
  if (dim == 2) return {{-n[1], n[0], 0}};
  // Along the axis that the normal is least along, made perpendicular; axes stay axes where they can.
  int least = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(n[i]) < std::abs(n[least]) - 1e-12) least = i;
  Point t{0, 0, 0};
  t[least] = 1;
  for (int i = 0; i < 3; ++i) t[i] -= n[least] * n[i];
  const double length = std::hypot(t[0], t[1], t[2]);
  for (double& v : t) v = std::abs(v) < 1e-15 ? 0 : v / length;
  return {t, {n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]}};
}

/// Which tangential rows a contact row gets: bounded, or none that slips.
enum class Slip { bounded, never };

/// Adds the tangential rows of the contact's rows of one kind with `count` free tangents each.
class Sweep {
 public:
  Sweep(const Scene& scene, const Contact& contact, RowBuilder& builder, Model& model)
      : contact_(contact), builder_(builder), model_(model), dim_(scene.dimension()),
        first_(scene.index_of(contact.first.body.get())), second_(scene.index_of(contact.second.body.get())) {}

  void run(Slip slip, int components) {
    std::vector<int> normal;
    std::vector<double> bounds;
    int first_row = -1;
    for (std::size_t k = 0; k < contact_.rows.size(); ++k) {
      const double value = contact_.friction_value[k];
      const int n = model_.contact_row.back()[k];
      if (n < 0 || value == 0 || std::isinf(value) != (slip == Slip::never)) continue;
      const std::vector<Point> free = free_tangents(contact_.rows[k]);
      if (static_cast<int>(free.size()) != components) continue;
      if (first_row < 0) first_row = slip == Slip::bounded ? builder_.open_friction() : open_bilateral();
      TangentRows& rows = model_.tangent_row.back()[k];
      for (const Point& t : free) {
        double jump = 0;
        rows.direction[rows.count] = t;
        rows.row[rows.count++] = builder_.add(first_, contact_.rows[k].node, second_, contact_.rows[k].partner, t, jump);
      }
      normal.push_back(n);
      bounds.push_back(contact_.friction == Friction::Kind::tresca ? value * contact_.rows[k].weight : value);
    }
    if (slip == Slip::never || normal.empty()) return;
    auto law = contact_.friction == Friction::Kind::tresca ? problem::tresca(std::move(bounds))
                                                           : problem::coulomb(std::move(bounds));
    model_.problem.friction.push_back({contact_.name, std::move(law), first_row, components, std::move(normal)});
  }

 private:
  int open_bilateral() {
    builder_.open_group(contact_.name + " (no slip)", problem::bilateral());
    return 0;
  }

  /// The tangents along which some unknown moves.
  std::vector<Point> free_tangents(const contact::ContactRow& row) const {
    std::vector<Point> free;
    for (const Point& t : tangents(row.normal, dim_))
      if (moves(first_, row.node, t) || (second_ >= 0 && moves(second_, row.partner, t))) free.push_back(t);
    return free;
  }
  bool moves(int body, int node, const Point& t) const {
    for (int i = 0; i < dim_; ++i)
      if (t[i] != 0 && model_.numbering[body].unknown[static_cast<std::size_t>(node) * dim_ + i] >= 0) return true;
    return false;
  }

  const Contact& contact_;
  RowBuilder& builder_;
  Model& model_;
  int dim_, first_, second_;
};

}  // namespace

void add_friction_rows(const Scene& scene, const Contact& contact, RowBuilder& builder, Model& model) {
  model.tangent_row.back().resize(contact.rows.size());
  if (contact.friction == Friction::Kind::none) return;
  Sweep sweep(scene, contact, builder, model);
  for (int components = 1; components < scene.dimension(); ++components) {
    sweep.run(Slip::bounded, components);
    sweep.run(Slip::never, components);
  }
}

}  // namespace dotyk::scene
