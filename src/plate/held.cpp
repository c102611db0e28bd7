#include "plate/held.hpp"

#include <cmath>

#include <Eigen/LU>

#include "base/error.hpp"

namespace dotyk::plate {

using Eigen::Vector2d;

namespace {

/// The gradient of a vertex along a direction.
struct HeldSlope {
  Vector2d direction;
  double value;
};

constexpr double kSame = 1e-9;  // of directions, and of values beside the greatest

class Holder {
 public:
  Holder(const Plate& plate, Space& space) : plate_(plate), space_(space) {
    held_.is.assign(space.count(), 0);
    held_.value = algebra::Vector::Zero(space.count());
  }

  Held operator()(std::vector<Sample>& deflections, std::vector<Sample>& rotations) {
    const bool hct = space_.element == Element::hct;
    for (Sample& s : deflections) {
      if (!s.law->prescribes) continue;
      s.held = true;
      set(space_.of_vertex(s.place), s.law.displacement(), s.x);
      if (hct) hold_tangents(s);
    }
    for (Sample& s : rotations) {
      if (!s.law->prescribes) continue;
      s.held = true;
      if (!s.at_vertex) set(space_.of_edge(s.place), s.law.displacement() * space_.unit, s.x);
      else slopes_[s.place].push_back({slope_direction(space_, s), s.law.displacement()});
    }
    for (const auto& [vertex, slopes] : slopes_) hold_slopes(vertex, slopes);
    return std::move(held_);
  }

 private:
  void set(int freedom, double value, const Vector2d& x) {
    if (held_.is[freedom] && std::abs(held_.value[freedom] - value) > kSame * (std::abs(value) + std::abs(held_.value[freedom])))
      contradict(x, held_.value[freedom], value);
    held_.is[freedom] = 1;
    held_.value[freedom] = value;
  }

  [[noreturn]] static void contradict(const Vector2d& x, double a, double b) {
    throw InputError(text("contradictory supports: at (", x[0], ", ", x[1], ") two parts of the edge prescribe ", a, " and ", b));
  }

  void hold_tangents(const Sample& s) {
    const BoundaryNode& node = space_.boundary[s.place];
    const auto along = [&](const Vector2d& normal) {
      const Vector2d t(-normal[1], normal[0]);
      slopes_[s.place].push_back({t, derivative(plate_.edges[s.support].deflection, s, t)});
    };
    if (node.smooth) return along(node.normal);
    for (const int e : node.edges)
      if (e == s.edges[0] || e == s.edges[1] || (node.edges.size() > 2 && of_support(e, s.support))) along(space_.edges.edges[e].normal);
  }

  /// Four edges of one part meet where holes touch at a corner.
  bool of_support(int edge, int support) const {
    for (const mesh::Facet f : plate_.edges[support].facets)
      if (space_.edges.of_cell[f.cell][f.local] == edge) return true;
    return false;
  }

  /// Of the prescribed deflection along t: five points, exact for polynomials of degree 4; on one side of the end of what is
  /// prescribed three.
  double derivative(const LawField& law, const Sample& s, const Vector2d& t) const {
    const double h = 1e-3 * space_.unit;
    std::array<double, 5> v{};
    std::array<bool, 5> there{};
    for (int i = 0; i < 5; ++i) {
      const Vector2d x = s.x + (i - 2) * h * t;
      const problem::LawChoice at = law(x[0], x[1]);
      v[i] = at.displacement();
      there[i] = at->prescribes && std::isfinite(at.displacement());
    }
    if (there[0] && there[1] && there[3] && there[4]) return (v[0] - v[4] + 8 * (v[3] - v[1])) / (12 * h);
    if (there[3] && there[4]) return (4 * v[3] - v[4] - 3 * v[2]) / (2 * h);
    if (there[0] && there[1]) return (3 * v[2] - 4 * v[1] + v[0]) / (2 * h);
    return 0;
  }

  /// One direction: it becomes the frame's first; two: the gradient is known.
  void hold_slopes(int vertex, const std::vector<HeldSlope>& slopes) {
    const Vector2d x = node_position(*space_.mesh, vertex);
    const Vector2d first = slopes.front().direction;
    const HeldSlope* other = nullptr;
    Eigen::Matrix2d& directions = held_.directions.emplace(vertex, Eigen::Matrix2d::Zero()).first->second;
    for (const HeldSlope& s : slopes) {
      directions += s.direction * s.direction.transpose();
      if (std::abs(first[0] * s.direction[1] - first[1] * s.direction[0]) > kSame && !other) other = &s;
    }
    space_.frame[vertex] = first;
    const int freedom = space_.of_vertex(vertex) + 1;
    held_.is[freedom] = 1;
    held_.value[freedom] = slopes.front().value * space_.unit;
    Vector2d gradient = slopes.front().value * first;
    if (other) {
      Eigen::Matrix2d A;
      A << first.transpose(), other->direction.transpose();
      gradient = A.inverse() * Vector2d(slopes.front().value, other->value);
      held_.is[freedom + 1] = 1;
      held_.value[freedom + 1] = (first[0] * gradient[1] - first[1] * gradient[0]) * space_.unit;
    }
    for (const HeldSlope& s : slopes)
      if (std::abs(gradient.dot(s.direction) - s.value) > 1e-6 * (gradient.norm() + std::abs(s.value))) contradict(x, gradient.dot(s.direction), s.value);
  }

  const Plate& plate_;
  Space& space_;
  Held held_;
  std::map<int, std::vector<HeldSlope>> slopes_;
};

}  // namespace

Held hold(const Plate& plate, Space& space, std::vector<Sample>& deflections, std::vector<Sample>& rotations) {
  return Holder(plate, space)(deflections, rotations);
}

Reduced reduce(const Functional& functional, const Held& held) {
  Reduced out;
  for (const Term& term : functional)
    if (held.is[term.freedom]) out.held += term.factor * held.value[term.freedom];
    else out.on_free.push_back(term);
  return out;
}

}  // namespace dotyk::plate
