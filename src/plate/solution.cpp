#include "plate/solution.hpp"

#include <cmath>
#include <set>
#include <span>

#include <Eigen/LU>

#include "base/error.hpp"
#include "base/text.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::plate {

using algebra::Vector;
using Eigen::Vector2d;

Solution::Solution(std::shared_ptr<const Model> model, solver::Result result, std::optional<Family> family)
    : model_(std::move(model)), result_(std::move(result)), residual_(solver::judge(model_->problem, result_)),
      u_(model_->freedoms(result_.state.u)), family_(std::move(family)), finder_(model_->space) {
}

Eigen::Matrix<double, 6, 1> Solution::values(const Place& place, const Vector& freedoms) const {
  const Space& space = model_->space;
  const Triangle t = triangle(*space.mesh, space.edges, place.cell);
  const Shape shape = basis(space.element, t)->at(place.at);
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 12> rows(6, space.local_size());
  rows << shape.value, shape.gradient, shape.curvature;
  space.to_freedoms(place.cell, rows);
  const auto freedom = space.freedoms(place.cell);
  Eigen::Matrix<double, 6, 1> out = Eigen::Matrix<double, 6, 1>::Zero();
  for (int i = 0; i < space.local_size(); ++i) out += rows.col(i) * freedoms[freedom[i]];
  return out;
}

double Solution::stiffness(int cell) const {
  const Rule& rule = stiffness_rule(model_->plate.element);
  const std::size_t first = model_->D.size() > rule.points.size() ? cell * rule.points.size() : 0;
  double D = 0;
  for (std::size_t i = 0; i < rule.points.size(); ++i) D += rule.weights[i] * model_->D[first + i];
  return D;
}

double Solution::deflection(double x, double y) const { return values(finder_.find({x, y}, "the point"), u_)[0]; }

Vector2d Solution::slope(double x, double y) const { return values(finder_.find({x, y}, "the point"), u_).segment<2>(1); }

double Solution::motion(double x, double y) const {
  return family_ ? values(finder_.find({x, y}, "the point"), family_->motion)[0] : 0;
}

Moment Solution::moment(double x, double y) const {
  const Place place = finder_.find({x, y}, "the point");
  Moment out;
  for (int k = 0; k < 3; ++k) {
    const Moment& at = vertex_moments()[plate().mesh->cell(place.cell)[k]];
    out.xx += place.at[k] * at.xx;
    out.yy += place.at[k] * at.yy;
    out.xy += place.at[k] * at.xy;
  }
  return out;
}

const std::vector<Moment>& Solution::vertex_moments() const {
  if (!moments_.empty()) return moments_;
  const mesh::Mesh& mesh = *plate().mesh;
  const Space& space = model_->space;
  const bool morley = plate().element == Element::morley;
  const Eigen::Matrix3d C = bending(plate().nu);
  std::vector<std::vector<int>> star(mesh.node_count());
  for (int c = 0; c < mesh.cell_count(); ++c)
    for (const int n : std::span(mesh.cell(c), 3)) star[n].push_back(c);
  moments_.resize(mesh.node_count());
  for (int n = 0; n < mesh.node_count(); ++n) {
    std::set<int> cells(star[n].begin(), star[n].end());
    if (morley && !space.boundary[n].edges.empty())  // too few for a linear function
      for (const int c : star[n])
        for (const int other : std::span(mesh.cell(c), 3)) cells.insert(star[other].begin(), star[other].end());
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero(), right = normal;  // of 1, x and y about the vertex
    const double size = std::sqrt(triangle(mesh, space.edges, star[n].front()).area);
    const auto add = [&](const Triangle& t, int c, const Barycentric& b) {
      Eigen::Vector3d basis;
      basis << 1, (t.point(b) - node_position(mesh, n)) / size;
      normal += t.area * basis * basis.transpose();
      right -= t.area * stiffness(c) * basis * (C * values({c, b}, u_).tail<3>()).transpose();
    };
    for (const int c : cells) {
      const Triangle t = triangle(mesh, space.edges, c);
      constexpr double kInside = 1e-9;  // to one of the thirds of HCT's that meet at a vertex
      if (morley) add(t, c, Barycentric::Constant(1.0 / 3));
      for (int k = 0; k < 3 && !morley; ++k)
        for (int side = 1; side < 3 && mesh.cell(c)[k] == n; ++side) {
          Barycentric b = Barycentric::Zero();
          b[k] = 1 - kInside, b[(k + side) % 3] = kInside;
          add(t, c, b);
        }
    }
    Eigen::RowVector3d m = right.row(0) / normal(0, 0);
    if (const Eigen::FullPivLU<Eigen::Matrix3d> lu(normal); lu.rcond() > 1e-6) m = lu.solve(right).row(0);
    moments_[n] = {m[0], m[1], m[2]};
  }
  return moments_;
}

}  // namespace dotyk::plate
