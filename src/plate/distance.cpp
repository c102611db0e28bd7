#include <cmath>

#include "base/error.hpp"
#include "plate/solution.hpp"

namespace dotyk::plate {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

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
