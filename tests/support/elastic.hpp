#pragma once

#include <algorithm>

#include "algebra/dense/decompositions.hpp"
#include "algebra/direct/cholesky.hpp"
#include "elasticity/assembly.hpp"
#include "elasticity/load.hpp"
#include "elasticity/rigid_modes.hpp"
#include "elasticity/stress.hpp"
#include "meshes.hpp"
#include "random.hpp"

namespace dotyk::test {

using elasticity::MaterialField;
using elasticity::Numbering;
using elasticity::VectorField;

inline MaterialField steel(int dimension, double E = 210, double nu = 0.3,
                           elasticity::Plane plane = elasticity::Plane::strain) {
  return MaterialField(elasticity::isotropic(E, nu, dimension, plane));
}

/// The same stiffness k along each axis, per area, at every point of a part.
inline std::vector<elasticity::FacetSpring> even_springs(const Mesh& m, const std::string& part, Point k) {
  std::vector<elasticity::FacetSpring> result;
  for (const auto f : m.parts.at(part)) {
    result.push_back({f, {}});
    result.back().stiffness.assign(elasticity::facet_points(m), k);
  }
  return result;
}

/// Adds a traction given as a function of position.
inline void add_traction(const Mesh& m, const std::vector<mesh::Facet>& facets, const VectorField& t,
                         std::vector<double>& force) {
  elasticity::add_traction(m, facets, [&](const elasticity::FacetPoint& p) { return t(p.x); }, force);
}

/// Adds a constant pressure on the facets.
inline void add_pressure(const Mesh& m, const std::vector<mesh::Facet>& facets, double pressure,
                         std::vector<double>& force) {
  elasticity::add_traction(m, facets, [&](const elasticity::FacetPoint& p) {
    return Point{-pressure * p.normal[0], -pressure * p.normal[1], -pressure * p.normal[2]};
  }, force);
}

/// Every component unknown but those where `given(x, i)` says so, which take `value(x)`.
inline Numbering prescribe(const Mesh& m, const std::function<bool(const Point&, int)>& given,
                           const VectorField& value) {
  const int dim = m.dimension();
  std::vector<char> fixed(m.coordinates.size(), 0);
  std::vector<double> prescribed(fixed.size(), 0);
  for (int n = 0; n < m.node_count(); ++n)
    for (int i = 0; i < dim; ++i)
      if (given(m.point(n), i)) {
        fixed[n * dim + i] = 1;
        prescribed[n * dim + i] = value(m.point(n))[i];
      }
  return elasticity::number(m, fixed, prescribed);
}

inline Numbering all_free(const Mesh& m) {
  return elasticity::number(m, std::vector<char>(m.coordinates.size(), 0),
                            std::vector<double>(m.coordinates.size(), 0));
}

/// ∫f by the cells' rule for loads.
inline double integral(const Mesh& m, const std::function<double(const elasticity::CellPoint&)>& f) {
  std::vector<double> nodal(m.coordinates.size(), 0);
  elasticity::add_body_force(m, elasticity::CellField([&](const elasticity::CellPoint& p) { return Point{f(p), 0, 0}; }), nodal);
  double sum = 0;
  for (std::size_t k = 0; k < nodal.size(); k += m.dimension()) sum += nodal[k];  // shape functions are 1 in sum
  return sum;
}

/// On the boundary of the unit square or cube.
inline bool on_boundary(const Point& x, int dimension) {
  for (int i = 0; i < dimension; ++i)
    if (x[i] < 1e-12 || x[i] > 1 - 1e-12) return true;
  return false;
}

inline std::vector<double> nodal(const Mesh& m, const VectorField& u) {
  std::vector<double> values;
  for (int n = 0; n < m.node_count(); ++n) {
    const Point p = u(m.point(n));
    values.insert(values.end(), p.begin(), p.begin() + m.dimension());
  }
  return values;
}

/// Stiffness and load of a body.
struct System {
  algebra::SparseMatrix K;
  algebra::Vector f;
  double offset = 0;
};
inline System system_of(const Mesh& m, const elasticity::MaterialField& material, const std::vector<elasticity::FacetSpring>& springs, const std::vector<double>& force,
                        const Numbering& numbering) {
  const elasticity::Load load = elasticity::load(m, material, springs, force, numbering);
  return {elasticity::assemble(m, material, springs, numbering), load.f, load.offset};
}

/// Nodal displacement (node × dimension) of the assembled system.
inline std::vector<double> solve(const System& s, const Numbering& numbering) {
  std::vector<double> u = numbering.values();
  if (numbering.count() == 0) return u;
  const algebra::Vector x = algebra::Ldlt(full(s.K)).solve(s.f);
  for (std::size_t k = 0; k < u.size(); ++k)
    if (numbering.unknown[k] >= 0) u[k] = x[numbering.unknown[k]];
  return u;
}

/// The same by a sparse factorisation, for finer meshes.
inline std::vector<double> solve_sparse(const System& s, const Numbering& numbering) {
  std::vector<double> u = numbering.values();
  algebra::Cholesky cholesky(s.K, numbering.node, {});
  if (!cholesky.factor(s.K)) return {};
  const algebra::Vector x = cholesky.solve(s.f);
  for (std::size_t k = 0; k < u.size(); ++k)
    if (numbering.unknown[k] >= 0) u[k] = x[numbering.unknown[k]];
  return u;
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double d = 0;
  for (std::size_t k = 0; k < a.size(); ++k) d = std::max(d, std::abs(a[k] - b[k]));
  return d;
}

}  // namespace dotyk::test
