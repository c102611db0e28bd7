#include "plate/distance.hpp"

#include <cmath>

#include "base/error.hpp"

namespace dotyk::plate {

using Eigen::Vector3d;

Distance distance(const Solution& solution, const Solution& other) {
  const bool on_other = other.plate().mesh->cell_count() >= solution.plate().mesh->cell_count();
  const Solution& fine = on_other ? other : solution;
  const Rule& rule = load_rule(fine.plate().element);
  const Eigen::Matrix3d C = bending(other.plate().nu);
  double apart_u = 0, whole_u = 0, apart_e = 0, whole_e = 0;
  for (int c = 0; c < fine.plate().mesh->cell_count(); ++c) {
    const Triangle t = triangle(*fine.plate().mesh, fine.model().space.edges, c);
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const Eigen::Vector2d x = t.point(rule.points[i]);
      const std::optional<Values> a = solution.at(x), b = other.at(x);
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
