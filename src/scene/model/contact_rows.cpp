#include "scene/model/row_builder.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "contact/multipliers.hpp"
#include "contact/contact_row.hpp"

namespace dotyk::scene {

using contact::tangents;
using mesh::Point;
using problem::LawChoice;

namespace {

bool nodal(const Contact& contact) { return contact.discretisation.multipliers == contact::Multipliers::nodal; }

/// One contact's rows, as they are made.
class ContactRowMaker {
 public:
  ContactRowMaker(const Scene& scene, const Contact& contact, const FreeJumps& jumps, RowBuilder& builder, Model& model)
      : contact_(contact), jumps_(jumps), builder_(builder), model_(model), dim_(scene.dimension()),
        first_(scene.index_of(contact.first.body.get())), second_(scene.index_of(contact.second.body.get())) {
    for (const contact::ContactRow& row : contact.rows) free_.push_back(jumps.at(row));
  }

  void operator()() {
    normal();
    if (!contact_.tangential->acts()) return;
    const std::vector<Candidate> points = nodal(contact_) ? nodal_points() : cell_points();
    for (int components = 1; components < dim_; ++components)
      for (const bool slips : {true, false}) add(points, components, slips);
  }

 private:
  void normal() {
    const bool law = contact_.normal.law.spec->rows;
    if (law) builder_.rows.open_group(contact_.name, contact_.normal.law);
    std::vector<char> moves, held;
    for (std::size_t k = 0; k < contact_.rows.size(); ++k) {
      moves.push_back(this->moves(k, contact_.rows[k].normal));
      held.push_back(!moves.back());
      if (held.back()) require_apart(k);
    }
    if (!contact_.discretisation.share_fixed) moves.assign(moves.size(), 1);
    model_.normal.back() = nodal(contact_) || dim_ == 2
                               ? contact::nodal_normal_rows(contact_.rows)
                               : contact::gram_normal_rows(surface_of(contact_), contact_.rows, moves);
    for (std::size_t k = 0; k < model_.normal.back().size(); ++k) {
      const contact::NormalRow& row = model_.normal.back()[k];
      std::vector<Pull> pulls;
      double gap = 0;
      for (const contact::Term& jump : row.jumps) {
        pulls.push_back(pull(jump, contact_.rows[jump.row].normal));
        gap += jump.weight * (contact_.rows[jump.row].gap - contact_.normal[jump.row].displacement());
      }
      const bool none = pulls.empty() || (held[k] && nodal(contact_)) || !law;
      const LawChoice own = contact_.normal[k];
      const int r = none ? -1 : builder_.add(first_, second_, pulls, gap, row.measure, &own);
      model_.contact_row.back().push_back(r);
      std::vector<double>& measure = model_.problem.measure;
      if (r >= 0) measure.resize(static_cast<std::size_t>(r) + 1, 0), measure.back() = row.measure;
    }
  }

  /// A friction point before it has rows.
  struct Candidate {
    contact::FrictionCell cell;
    bool slips;  ///< friction with a finite bound; else a row of its own for each tangent: no slip, or a spring
    int normal;  ///< row of B
    std::vector<Point> tangents;  ///< along which some unknown moves
  };

  Pull pull(const contact::Term& term, const Point& direction) const {
    const contact::ContactRow& row = contact_.rows[term.row];
    return {row.own, row.partners, mesh::times(term.weight, direction)};
  }
  /// Is the jump at a contact row free along the direction?
  bool moves(std::size_t row, const Point& direction) const {
    return (free_[row] * Eigen::Map<const Eigen::Vector3d>(direction.data())).norm() > kHeld;
  }

  void require_apart(std::size_t k) {
    const contact::ContactRow& row = contact_.rows[k];
    const double prescribed = contact_.normal[k].displacement();
    if (!contact_.normal->stop() && !contact_.normal->prescribes) return;
    const std::optional<double> jump = jumps_.given(row);
    if (!jump) return;  // a partner further away moves
    const double gap = row.gap + mesh::dot(row.normal, model_.move.back()) - *jump;
    // Rounding of coordinates may leave a fixed node this far inside.
    const double rounding = 1e-9 * contact_.first.body->mesh->size();
    if (contact_.normal->prescribes && std::abs(gap - prescribed) > rounding)
      throw InputError(text(contact_.name, ": the node at ", point_text(contact_.first.body->mesh->node(row.node), dim_),
                            " is fixed in the normal direction, ", gap, " off the other side; no displacement can make that the prescribed ", prescribed));
    if (contact_.normal->stop() && gap < -rounding)
      throw InputError(text(contact_.name, ": the node at ",
                            point_text(contact_.first.body->mesh->node(row.node), dim_),
                            " is fixed in the normal direction and lies ", -gap,
                            " inside the other side; no displacement can part them"));
  }

  /// Each row's surroundings for given friction. At corners of the part they are its neighbours', so that B keeps its rank.
  std::vector<std::vector<contact::Term>> surroundings(std::vector<char> aside) const {
    if (!contact_.discretisation.share_fixed) aside.assign(aside.size(), 0);
    std::vector<char> slides;
    for (std::size_t k = 0; k < contact_.rows.size(); ++k) slides.push_back(!scene::free_tangents(free_[k], contact_.rows[k].normal, dim_).empty());
    return contact::friction_shares(contact_.rows, aside, slides);
  }

  std::vector<Candidate> nodal_points() const {
    std::vector<Candidate> points;
    const bool given = contact_.tangential->tresca(), springs = !contact_.tangential->rubs();
    std::vector<char> aside = contact::at_corners(contact_.rows);
    if (!given) aside.assign(aside.size(), 0);  // the bound goes with the node's own pressure: a neighbour's may be none
    const std::vector<std::vector<contact::Term>> nodes = surroundings(aside);
    for (std::size_t k = 0; k < contact_.rows.size(); ++k) {
      if (nodes[k].empty()) continue;
      const contact::ContactRow& row = contact_.rows[k];
      double bound = 0, measure = 0;
      for (const contact::Term& node : nodes[k]) {
        const double weight = node.weight * contact_.rows[node.row].weight;
        bound += contact_.tangential[node.row].numbers[0] * (given || springs ? weight : 1);
        measure += weight;
      }
      const int n = model_.contact_row.back()[k];
      if (bound == 0 || (n < 0 && !given && !springs)) continue;  // a product below all numbers is no friction, either
      Candidate point{{{{static_cast<int>(k), 1}}, nodes[k], bound, measure, {}}, !springs && std::isfinite(bound), n, {}};
      point.tangents = scene::free_tangents(free_[k], row.normal, dim_);
      points.push_back(std::move(point));
    }
    return points;
  }

  /// Friction cells in the plane: the rows whose half cells belong to their neighbours', and those whose have no friction.
  void set_ends(std::vector<char>& moving, std::vector<char>& bare) const {
    if (dim_ != 2) return;
    std::vector<char> aside = contact::at_corners(contact_.rows);
    const CellEnds ends = contact_.discretisation.ends;
    if (ends != CellEnds::own) aside = contact::at_ends(contact_.rows);
    const std::vector<std::vector<contact::Term>> nodes = surroundings(aside);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (nodes[k].empty()) moving[k] = 0;
    if (ends == CellEnds::bare) bare = std::move(aside);
  }

  std::vector<Candidate> cell_points() const {
    std::vector<double> g;
    for (std::size_t k = 0; k < contact_.rows.size(); ++k) g.push_back(contact_.tangential[k].numbers[0]);
    const bool slips = std::none_of(g.begin(), g.end(), [](double v) { return std::isinf(v); });
    if (!slips) g.assign(g.size(), 1);
    std::vector<char> moving;
    for (std::size_t k = 0; k < contact_.rows.size(); ++k) {
      const std::vector<Point> t = tangents(contact_.rows[k].normal, dim_);
      moving.push_back(std::any_of(t.begin(), t.end(), [&](const Point& d) { return moves(k, d); }));
    }
    if (!contact_.discretisation.share_fixed) moving.assign(moving.size(), 1);
    std::vector<char> bare;
    set_ends(moving, bare);
    std::vector<Candidate> points;
    for (contact::FrictionCell& cell :
         contact::friction_cells(surface_of(contact_), g, moving, contact_.discretisation.friction_size, bare)) {
      Candidate point{std::move(cell), slips, -1, {}};
      Point mean{0, 0, 0};
      double most = 0;
      for (const contact::Term& jump : point.cell.jumps) {
        mean = mesh::plus(mean, mesh::times(jump.weight, contact_.rows[jump.row].normal));
        const int n = model_.contact_row.back()[jump.row];
        if (n >= 0 && jump.weight > most) most = jump.weight, point.normal = n;
      }
      point.tangents = free_tangents(point.cell, mesh::unit(mean));
      if (point.cell.bound > 0) points.push_back(std::move(point));
    }
    return points;
  }

  std::vector<Point> free_tangents(const contact::FrictionCell& cell, const Point& normal) const {
    std::vector<Point> free;
    for (const Point& t : tangents(normal, dim_)) {
      const FrictionRows frame{cell, 1, {-1, -1}, {t, {}}};
      if (std::any_of(cell.jumps.begin(), cell.jumps.end(), [&](const contact::Term& jump) {
            return moves(static_cast<std::size_t>(jump.row), frame.at(0, contact_.rows[static_cast<std::size_t>(jump.row)], dim_));
          }))
        free.push_back(t);
    }
    return free;
  }

  /// The points of one kind, with this many free tangents each.
  void add(const std::vector<Candidate>& points, int components, bool slips) {
    std::vector<int> normal;
    std::vector<double> bounds;
    int first_row = -1;
    for (const Candidate& point : points) {
      if (point.slips != slips || static_cast<int>(point.tangents.size()) != components) continue;
      if (first_row < 0) first_row = slips ? builder_.rows.open_friction() : open_group();
      FrictionRows rows{point.cell, 0, {-1, -1}, {}};
      for (const Point& t : point.tangents) {
        const int i = rows.count++;
        rows.direction[i] = t;
        std::vector<Pull> pulls;
        for (const contact::Term& jump : point.cell.jumps)
          pulls.push_back(pull(jump, rows.at(i, contact_.rows[jump.row], dim_)));
        double jump = 0;
        const LawChoice own = contact_.tangential[point.cell.jumps.front().row];
        rows.row[i] = builder_.add(first_, second_, pulls, jump, point.cell.measure, &own);
      }
      model_.friction.back().push_back(std::move(rows));
      normal.push_back(point.normal);
      bounds.push_back(point.cell.bound);
    }
    if (!slips || normal.empty()) return;
    auto law = contact_.tangential->tresca() ? problem::tresca(std::move(bounds))
                                                           : problem::coulomb(std::move(bounds));
    model_.problem.friction.push_back({contact_.name, std::move(law), first_row, components, std::move(normal)});
  }

  int open_group() {
    if (!contact_.tangential->rubs()) builder_.rows.open_group(contact_.name + " (tangential)", contact_.tangential.law);
    else builder_.rows.open_group(contact_.name + " (no slip)", problem::bilateral());
    return 0;
  }

  const Contact& contact_;
  const FreeJumps& jumps_;
  RowBuilder& builder_;
  Model& model_;
  int dim_, first_, second_;
  std::vector<Eigen::Matrix3d> free_;  ///< of the jump at each contact row
};

}  // namespace

Point FrictionRows::at(int i, const contact::ContactRow& row, int dimension) const {
  const Point& n = row.normal;
  if (dimension == 2) return {-n[1], n[0], 0};
  const Point& t = direction[i];
  const double along = mesh::dot(t, n);
  return std::abs(along) < 1e-15 ? t : mesh::minus(t, mesh::times(along, n));
}

std::vector<Point> Model::contact_force(int index, const algebra::Vector& lambda) const {
  const Contact& contact = *contacts[index];
  std::vector<Point> force(contact.rows.size(), Point{0, 0, 0});
  const auto push = [&](int k, const Point& direction, double amount) { force[k] = mesh::minus(force[k], mesh::times(amount, direction)); };
  for (std::size_t j = 0; j < normal[index].size(); ++j) {
    const int r = contact_row[index][j];
    if (r < 0) continue;
    for (const contact::Term& jump : normal[index][j].jumps)
      push(jump.row, contact.rows[jump.row].normal, jump.weight * lambda[r]);
  }
  const int dim = contact.first.body->dimension();
  for (const FrictionRows& rows : friction[index])
    for (int i = 0; i < rows.count; ++i)
      for (const contact::Term& jump : rows.cell.jumps)
        push(jump.row, rows.at(i, contact.rows[jump.row], dim), jump.weight * lambda[rows.row[i]]);
  return force;
}

void add_contact_rows(const Scene& scene, const Contact& contact, const FreeJumps& jumps, RowBuilder& builder, Model& model) {
  ContactRowMaker(scene, contact, jumps, builder, model)();
}

}  // namespace dotyk::scene
