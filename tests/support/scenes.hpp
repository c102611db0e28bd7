#pragma once

#include "facets.hpp"
#include "scene/result/solution.hpp"
#include "solver/rows/newton.hpp"
#include "solver/active/pdas.hpp"

namespace dotyk::test {

inline std::shared_ptr<scene::Body> body(const std::string& name, Mesh m, double E = 210, double nu = 0.3) {
  const int dim = m.dimension();
  return scene::make_body(name, std::make_shared<const Mesh>(std::move(m)),
                          elasticity::MaterialField(elasticity::isotropic(E, nu, dim, elasticity::Plane::strain)), {});
}

/// A block of n cells along each edge of [0,1]ᵈ, moved up by `lift` along the last axis.
inline std::shared_ptr<scene::Body> block(const std::string& name, int dimension, Family family, int n, double lift = 0,
                                          double E = 210, double nu = 0.3) {
  Mesh m = unit(dimension, family, n);
  mesh::transform(m, [&](Point x) { return x[dimension - 1] += lift, x; });
  return body(name, std::move(m), E, nu);
}

inline scene::GivenLaw friction(const problem::LawSpec* kind, double value) {
  return problem::LawChoice{kind, {value}};
}
inline scene::GivenLaw coulomb(double mu) { return friction(&problem::laws::coulomb, mu); }
inline scene::GivenLaw given(double g) { return friction(&problem::laws::friction, g); }

inline constexpr double kPressure = 3;  ///< of patch tests

inline Monitor quiet;  ///< never stops

inline scene::Part part(const std::shared_ptr<scene::Body>& b, const std::string& name) {
  return scene::named_part(b, name);
}

inline void fix(const std::shared_ptr<scene::Body>& b, const std::string& name,
                std::array<bool, 3> components = {true, true, true}) {
  auto p = part(b, name);
  scene::fix(p, components);
}

/// Holds some nodes of a body and no others.
inline void hold(scene::Body& body, const std::function<bool(const Point&)>& at) {
  scene::Support support{scene::SupportKind::fix, {"nodes", 0}, {}, {}, {}, {}};
  for (int n = 0; n < body.mesh->node_count(); ++n)
    if (at(body.mesh->point(n))) {
      support.nodes.push_back(n);
      support.components.push_back({true, true, true});
      support.values.push_back({0, 0, 0});
      support.normals.push_back({0, 0, 1});
    }
  body.supports.push_back(support);
}

inline void slide(const std::shared_ptr<scene::Body>& b, const std::string& name) {
  auto p = part(b, name);
  scene::slide(p);
}

inline void press(const std::shared_ptr<scene::Body>& b, const std::string& name, double pressure) {
  auto p = part(b, name);
  scene::pressure(p, [=](const Point&) { return pressure; });
}

inline void pull(const std::shared_ptr<scene::Body>& b, const std::string& name, elasticity::VectorField traction) {
  auto p = part(b, name);
  scene::load(p, traction);
}

inline void springs(const std::shared_ptr<scene::Body>& b, const std::string& name, Point k) {
  auto p = part(b, name);
  std::array<elasticity::ScalarField, 3> fields;
  for (int i = 0; i < 3; ++i)
    if (k[i] > 0) fields[i] = [=](const Point&) { return k[i]; };
  scene::spring(p, fields);
}

/// The outer sides of a block that lie at 0 of the axes but the last: symmetry planes.
inline void symmetric(const std::shared_ptr<scene::Body>& b) {
  slide(b, "left");
  if (b->dimension() == 3) slide(b, "front");
}

inline std::shared_ptr<scene::Solution> solve(const std::shared_ptr<scene::Scene>& s, bool reduced = true) {
  Monitor quiet;
  solver::Pdas pdas;
  pdas.reduced = reduced;
  auto solution = scene::solve(s, pdas, {}, quiet);
  return solution;
}

/// Resultant of a body's nodal loads.
inline Point resultant(const scene::Body& b) {
  Point sum{0, 0, 0};
  for (std::size_t k = 0; k < b.force.size(); ++k) sum[k % b.dimension()] += b.force[k];
  return sum;
}

}  // namespace dotyk::test
