#include "scene/result/energy_norm.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "elasticity/assembly.hpp"
#include "solver/active/held_stiffness.hpp"

namespace dotyk::scene {
namespace {

using algebra::Vector;
using mesh::Point;
using problem::LawChoice;

double squared_of_laws(const Solution& at, int index, const std::vector<double>& v) {
  const Body& body = at.body(index);
  const int dim = body.dimension();
  double sum = 0;
  for (std::size_t s = 0; s < body.laws.size(); ++s) {
    const LawSupport& support = body.laws[s];
    for (std::size_t k = 0; k < support.nodes.size(); ++k) {
      const contact::NodeSide& side = support.nodes[k];
      const auto add = [&](const LawChoice& law, int row, const Point& direction) {
        if (row < 0 || !law->elastic() || !at.active(row)) return;
        const double moved = mesh::dot(contact::mean(side.own, v, dim), direction);
        const double x = mesh::dot(contact::mean(side.own, at.displacement(index), dim), direction);
        sum += side.weight * problem::row_law(law)->respond(0, x).slope * moved * moved;
      };
      const SupportRows& rows = at.model().support_row[index][s][k];
      if (!support.breaks(k)) add(support.normal[k], rows.normal, side.normal);
      for (int i = 0; i < rows.count; ++i) add(support.tangential[k], rows.row[i], rows.direction[i]);
    }
  }
  return sum;
}

/// Of rows that hold, in units of the stiffness that they see; and of others, so that a body that slips or rocks freely has a matrix with an inverse.
constexpr double kRigid = 1e4, kLoose = 1e-10;

bool elastic(const LawChoice& law) { return law->elastic() && problem::bears(law); }

/// What a facet's points say less than its nodes do, of one row.
struct Share {
  int body, cell, row;
  double defect;
};

class Lumping {
 public:
  explicit Lumping(const Solution& solution) : s_(solution), problem_(with_stiffness(solution)), spring_(Vector::Zero(solution.rows())) {
    hold();
    for (std::size_t b = 0; b < s_.scene().bodies.size(); ++b)
      for (std::size_t k = 0; k < s_.body(static_cast<int>(b)).laws.size(); ++k) add_support(static_cast<int>(b), k);
  }

  std::vector<std::vector<double>> operator()() const {
    std::vector<std::vector<double>> cells;
    Vector defect = Vector::Zero(s_.rows());
    for (const Share& share : shares_) defect[share.row] += share.defect;
    if (defect.isZero(0)) return cells;
    const Vector moved = response(defect);
    const double square = defect.dot(moved);
    double sum = 0;
    for (const Share& share : shares_) sum += std::abs(share.defect * moved[share.row]);
    for (std::size_t b = 0; b < s_.scene().bodies.size(); ++b) cells.emplace_back(s_.body(static_cast<int>(b)).mesh->cell_count(), 0.0);
    if (!(square > 0)) return cells;
    for (const Share& share : shares_) cells[share.body][share.cell] += square * std::abs(share.defect * moved[share.row]) / sum;
    return cells;
  }

 private:
  /// A step before the last has no stiffness matrices any more.
  static problem::Problem with_stiffness(const Solution& solution) {
    problem::Problem problem = solution.model().problem;
    for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
      if (problem.blocks[b].K.rows() > 0) continue;
      if (problem.hides())
        throw InputError("what elastic laws lose by acting at nodes is known of the last step alone where ranks have refined the bodies: ask its error estimate");
      const Body& body = solution.body(static_cast<int>(b));
      problem.blocks[b].K = elasticity::assemble(*body.mesh, body.material, solution.model().springs_in_stiffness(b), solution.model().numbering[b]);
    }
    return problem;
  }

  /// Springs of rows that hold: of closed contacts, of friction that sticks there.
  void hold() {
    const Vector& stiffness = s_.measure().stiffness();
    const auto& slipping = s_.result().slipping;
    const auto at = [&](int r, bool holds) { spring_[r] = (holds ? kRigid : kLoose) * stiffness[r]; };
    for (int r = 0; r < s_.rows(); ++r) at(r, s_.active(r));
    for (const auto& [law, k, r] : problem_.scalar_rows())
      if (const auto own = law.linear_stiffness(k); own && std::isfinite(*own)) spring_[r] = *own;
    for (const problem::FrictionGroup& group : problem_.friction)
      for (int k = 0; k < group.points(); ++k)
        for (int i = 0; i < group.components; ++i) {
          const int r = group.row(k) + i;
          at(r, (slipping.empty() || !slipping[r]) && (group.normal[k] < 0 || s_.active(group.normal[k])));
        }
  }

  void add_support(int b, std::size_t k) {
    const Body& body = s_.body(b);
    const LawSupport& support = body.laws[k];
    const auto& rows = s_.model().support_row[b][k];
    std::map<std::pair<int, int>, std::size_t> side_at;  // facet, node → side
    for (std::size_t side = 0; side < support.nodes.size(); ++side)
      for (const int f : support.nodes[side].facets) side_at[{f, support.nodes[side].node}] = side;
    for (std::size_t f = 0; f < support.facets.size(); ++f) {
      std::vector<std::size_t> sides;
      for (int a = 0; a < body.mesh->topology().nodes_per_facet; ++a) sides.push_back(side_at.at({static_cast<int>(f), body.mesh->facet_node(support.facets[f], a)}));
      for (const std::size_t side : sides) {
        if (support.breaks(side)) continue;
        add_row(b, support, f, sides, side, support.normal[side], rows[side].normal, nullptr);
        for (int i = 0; i < rows[side].count; ++i) add_row(b, support, f, sides, side, support.tangential[side], rows[side].row[i], &rows[side].direction[i]);
      }
    }
  }

  /// `direction`: of tangents; null: each node's normal.
  void add_row(int b, const LawSupport& support, std::size_t f, const std::vector<std::size_t>& sides, std::size_t side, const LawChoice& law, int row,
               const Point* direction) {
    if (row < 0 || !elastic(law)) return;
    const Body& body = s_.body(b);
    const auto at_node = [&](std::size_t k) {
      return mesh::dot(mesh::at_node(s_.displacement(b), support.nodes[k].node, body.dimension()), direction ? *direction : support.nodes[k].normal);
    };
    const double own = at_node(side);
    const auto of_point = problem::row_law(law);  // per length or area
    spring_[row] = support.nodes[side].weight * of_point->respond(0, own).slope;
    Share share{b, support.facets[f].cell, row, 0};
    elasticity::for_each_facet_point(*body.mesh, support.facets[f], [&](const elasticity::FacetPoint& p) {
      double x = 0, shape = 0;
      for (int a = 0; a < p.nodes; ++a) {
        x += p.shape[a] * at_node(sides[a]);
        if (sides[a] == side) shape = p.shape[a];
      }
      share.defect += p.measure * shape * (of_point->respond(0, x).force - of_point->respond(0, own).force);
    });
    shares_.push_back(share);
  }

  /// Bw.
  Vector response(const Vector& defect) const {
    Monitor quiet;
    const auto make = problem_.hides() ? solver::multigrid(solver::Levels::meshes) : solver::factor({});
    solver::HeldStiffness stiffness(problem_, problem::rigid_motions(problem_), make, quiet);
    if (!stiffness.factor(spring_, std::vector<char>(problem_.unknowns(), 0))) return Vector::Zero(s_.rows());
    return problem_.B * stiffness.solve(problem_.B.transpose() * defect);
  }

  const Solution& s_;
  const problem::Problem problem_;
  Vector spring_;  ///< rows
  std::vector<Share> shares_;
};

}  // namespace

double squared_energy_norm(const Solution& at, int index, const std::vector<double>& v) {
  const Body& body = at.body(index);
  const std::vector<double> force = elasticity::internal_force(*body.mesh, body.material, body.facet_springs(), v);
  double sum = 0;
  for (std::size_t k = 0; k < v.size(); ++k) sum += v[k] * force[k];
  return sum + squared_of_laws(at, index, v);
}

std::vector<std::vector<double>> lumping_of_laws(const Solution& solution) {
  for (const Body& body : solution.model().bodies)
    for (const LawSupport& support : body.laws)
      if (support.normal->elastic() || support.tangential->elastic()) return Lumping(solution)();
  return {};
}

}  // namespace dotyk::scene
