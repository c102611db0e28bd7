#pragma once

#include <numbers>

#include "meshes.hpp"
#include "plain_laws.hpp"
#include "plate/reaction.hpp"
#include "plate/solution.hpp"

namespace dotyk::test {

using plate::Element;
using plate::Plate;
using problem::LawChoice;
namespace laws = problem::laws;

inline constexpr Element kElements[] = {Element::morley, Element::hct};
/// Bending stiffness and Poisson's ratio where exact solutions are compared with.
inline constexpr double kD = 3, kNu = 0.3;

inline plate::LawField always(LawChoice law) {
  return [law](double, double) { return law; };
}

/// v = value(x, y).
inline plate::LawField prescribed(plate::Field value) {
  return [value](double x, double y) { return LawChoice{&laws::prescribed, value(x, y)}; };
}

/// n × n squares halved, their inner nodes moved.
inline Mesh rough(int n) {
  Mesh m = rectangle(Family::p1, n, n);
  distort(m, 0.05);
  return m;
}

inline Plate plate_on(Mesh mesh, Element element, double load = 0) {
  Plate p;
  p.mesh = std::make_shared<const Mesh>(std::move(mesh));
  p.element = element;
  p.f = load;
  return p;
}

/// Laws of a part of the mesh, "" for all of its boundary.
inline void support(Plate& p, const std::string& part, plate::LawField deflection, plate::LawField rotation) {
  p.edges.push_back({part.empty() ? "edge" : part, part.empty() ? mesh::boundary(*p.mesh) : p.mesh->parts.at(part), std::move(deflection), std::move(rotation)});
}
inline void support(Plate& p, const std::string& part, LawChoice deflection, LawChoice rotation) { support(p, part, always(deflection), always(rotation)); }

inline std::shared_ptr<const plate::Solution> solved(const Plate& p, const solver::Method& method = {}) {
  Monitor quiet;
  return plate::solve(std::make_shared<const plate::Model>(plate::build(p)), method, quiet);
}

/// ∫ over the plate of a function of x and the solution's u, ∂x u, ∂y u, ∂xx u, ∂yy u, 2∂xy u there: by Radon's rule on thirds of cells.
template <class Integrand>
double integrate(const plate::Solution& s, const Integrand& integrand) {
  const plate::Space& space = s.model().space;
  const plate::Rule& rule = plate::load_rule(Element::hct);
  double sum = 0;
  for (int c = 0; c < space.mesh->cell_count(); ++c) {
    const plate::Triangle t = plate::triangle(*space.mesh, space.edges, c);
    const auto functions = plate::basis(space.element, t);
    const auto freedom = space.freedoms(c);
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const plate::Shape shape = functions->at(rule.points[i]);
      Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 12> rows(6, space.local_size());
      rows << shape.value, shape.gradient, shape.curvature;
      space.to_freedoms(c, rows);
      Eigen::Matrix<double, 6, 1> u = Eigen::Matrix<double, 6, 1>::Zero();
      for (int k = 0; k < space.local_size(); ++k) u += rows.col(k) * s.freedoms()[freedom[k]];
      sum += rule.weights[i] * t.area * integrand(t.point(rule.points[i]), u);
    }
  }
  return sum;
}

/// A deflection: u, ∂x u, ∂y u, ∂xx u, ∂yy u, 2∂xy u at a point.
using Exact = std::function<Eigen::Matrix<double, 6, 1>(double x, double y)>;

/// Norms of what the solution is off by: of u in L², of its gradients and of its curvatures (∂xy u counted twice), cell by cell.
struct PlateError {
  double deflection = 0, slope = 0, curvature = 0;
};
inline PlateError error(const plate::Solution& s, const Exact& exact) {
  const auto norm = [&](const Eigen::Matrix<double, 6, 1>& weights) {
    return std::sqrt(integrate(s, [&](const Eigen::Vector2d& x, const Eigen::Matrix<double, 6, 1>& u) { return (u - exact(x[0], x[1])).cwiseAbs2().dot(weights); }));
  };
  return {norm({1, 0, 0, 0, 0, 0}), norm({0, 1, 1, 0, 0, 0}), norm({0, 0, 0, 1, 1, 0.5})};
}

}  // namespace dotyk::test
