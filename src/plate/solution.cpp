#include "plate/solution.hpp"

#include <cmath>

#include "base/error.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::plate {
namespace {

using algebra::Vector;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// At a point.
struct Sampled {
  double u;
  Vector3d curvature;  ///< ∂xx u, ∂yy u, 2∂xy u of its cell
  double D;            ///< mean of its cell
};

/// A solution at points of which most lie in the cell of the one before, whose basis is kept.
class Sampler {
 public:
  explicit Sampler(const Solution& solution) : solution_(solution) {}

  /// Nothing where x is not on the plate.
  std::optional<Sampled> at(const Vector2d& x) {
    if (cell_ < 0 || !inside(barycentric(triangle_, x))) {
      const std::optional<Place> place = solution_.find(x);
      if (!place) return std::nullopt;
      if (place->cell != cell_) enter(place->cell);
    }
    const Barycentric b = barycentric(triangle_, x);
    const Vector3d curvature = basis_->curvature(b) * coefficients_;
    return Sampled{basis_->value(b).dot(coefficients_), curvature, D_};
  }

 private:
  static bool inside(const Barycentric& b) { return b.minCoeff() > 1e-6; }  // else it may be the neighbour's as well: the finder decides

  void enter(int cell) {
    const Space& space = solution_.model().space;
    cell_ = cell;
    triangle_ = triangle(*space.mesh, space.edges, cell);
    basis_ = basis(space.element, triangle_);
    D_ = solution_.stiffness(cell);
    LocalMatrix to_basis = LocalMatrix::Identity(space.local_size(), space.local_size());
    space.to_freedoms(cell, to_basis);
    coefficients_ = to_basis * space.of_cell(cell, solution_.freedoms());
  }

  const Solution& solution_;
  int cell_ = -1;
  Triangle triangle_;
  std::unique_ptr<const Basis> basis_;
  LocalVector coefficients_;
  double D_ = 0;
};

}  // namespace

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
  std::vector<Eigen::Vector3d> sum(mesh.node_count(), Eigen::Vector3d::Zero());
  std::vector<double> area(mesh.node_count(), 0);
  constexpr double kInside = 1e-9;  // to one of the thirds that meet at a vertex
  for (int c = 0; c < mesh.cell_count(); ++c) {
    const double weight = triangle(mesh, model_->space.edges, c).area / 2, D = stiffness(c);
    for (int k = 0; k < 3; ++k)
      for (int side = 1; side < 3; ++side) {
        Barycentric b = Barycentric::Zero();
        b[k] = 1 - kInside;
        b[(k + side) % 3] = kInside;
        sum[mesh.cell(c)[k]] -= weight * D * values({c, b}, u_).tail<3>();
        area[mesh.cell(c)[k]] += weight;
      }
  }
  const Eigen::Matrix3d C = bending(plate().nu);
  moments_.resize(mesh.node_count());
  for (int n = 0; n < mesh.node_count(); ++n) {
    const Eigen::Vector3d m = C * sum[n] / area[n];
    moments_[n] = {m[0], m[1], m[2]};
  }
  return moments_;
}

Distance distance(const Solution& solution, const Solution& other) {
  const bool on_other = other.plate().mesh->cell_count() >= solution.plate().mesh->cell_count();
  const Solution& fine = on_other ? other : solution;
  const Rule& rule = load_rule(fine.plate().element);
  const Eigen::Matrix3d C = bending(other.plate().nu);
  Sampler ours(solution), theirs(other);
  double apart_u = 0, whole_u = 0, apart_e = 0, whole_e = 0;
  for (int c = 0; c < fine.plate().mesh->cell_count(); ++c) {
    const Triangle t = triangle(*fine.plate().mesh, fine.model().space.edges, c);
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const Vector2d x = t.point(rule.points[i]);
      const std::optional<Sampled> a = ours.at(x), b = theirs.at(x);
      if (!a || !b) continue;
      const double weight = rule.weights[i] * t.area;
      const Vector3d k = a->curvature - b->curvature;
      apart_u += weight * (a->u - b->u) * (a->u - b->u);
      whole_u += weight * b->u * b->u;
      apart_e += weight * b->D * k.dot(C * k);
      whole_e += weight * b->D * b->curvature.dot(C * b->curvature);
    }
  }
  if (!(whole_u > 0) || !(whole_e > 0)) throw InputError("the other solution does not bend where both plates are, so nothing is relative to it");
  return {std::sqrt(apart_e / whole_e), std::sqrt(apart_u / whole_u)};
}

}  // namespace dotyk::plate
