// Exact derivatives by moving nodes, against central differences over steps from 1e-1 to 1e-10: the error falls as h² until
// rounding, 1e-16/h, takes over; at the bottom, about h = 1e-5, some 1e-11 to 1e-10 are left, so 1e-9 is asked for.
#include "elasticity/shape_derivative.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "elasticity/assembly.hpp"
#include "mesh/generators.hpp"

using namespace dotyk;
using mesh::Mesh;
using mesh::Point;

namespace {

Mesh sample(int dimension, mesh::Family family) {
  const double from[3] = {0, 0, 0}, to[3] = {1, 1.2, 0.8};
  const int cells[3] = {3, 2, 2};
  const mesh::Grading even[3];
  Mesh m = dimension == 2 ? mesh::rectangle(from, to, cells, family, even) : mesh::box(from, to, cells, family, even);
  mesh::transform(m, [&](const Point& x) {
    return Point{x[0] + 0.08 * std::sin(3 * x[1] + x[2]), x[1] + 0.05 * std::cos(2 * x[0]), dimension == 2 ? 0 : x[2] + 0.06 * x[0] * x[1]};
  });
  return m;
}

std::vector<double> random_field(const Mesh& m, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> number(-1, 1);
  std::vector<double> out(m.coordinates.size());
  for (double& v : out) v = number(engine);
  return out;
}

Mesh moved(Mesh m, const std::vector<double>& V, double t) {
  for (std::size_t k = 0; k < V.size(); ++k) m.coordinates[k] += t * V[k];
  return m;
}

double norm(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x * x;
  return std::sqrt(sum);
}

/// Of `of`(mesh) along V: the errors of central differences against `exact`, relative, for h = 0.1 … 1e-10 of V's scale.
template <class Of>
std::vector<double> errors(const Mesh& m, const std::vector<double>& V, const std::vector<double>& exact, const Of& of) {
  std::vector<double> out;
  for (int k = 1; k <= 10; ++k) {
    const double h = 0.1 * std::pow(10, -k);  // V is of size 1, cells of 0.3: more would invert them
    const auto above = of(moved(m, V, h)), below = of(moved(m, V, -h));
    std::vector<double> apart(exact.size());
    for (std::size_t i = 0; i < exact.size(); ++i) apart[i] = (above[i] - below[i]) / (2 * h) - exact[i];
    out.push_back(norm(apart) / norm(exact));
  }
  return out;
}

void check_v_shape(const std::vector<double>& e) {
  CHECK(e[1] / e[0] == doctest::Approx(0.01).epsilon(0.1));  // order 2
  CHECK(e[2] / e[1] == doctest::Approx(0.01).epsilon(0.1));
  CHECK(*std::min_element(e.begin(), e.end()) < 1e-9);
  CHECK(e.back() > 1e-8);  // rounding
}

const mesh::Family kFamilies[] = {mesh::Family::p1, mesh::Family::q1};

}  // namespace

TEST_CASE("the derivative of internal forces by the nodes' places is exact, all elements") {
  for (const int dimension : {2, 3})
    for (const auto family : kFamilies) {
      CAPTURE(dimension);
      const Mesh m = sample(dimension, family);
      const elasticity::MaterialField material(elasticity::isotropic(10, 0.3, dimension, elasticity::Plane::strain));
      const auto u = random_field(m, 1), V = random_field(m, 2);
      const auto exact = elasticity::internal_force_derivative(m, material, u, V);
      check_v_shape(errors(m, V, exact, [&](const Mesh& at) { return elasticity::internal_force(at, material, {}, u); }));
    }
}

TEST_CASE("so are those of body forces, tractions and the volume") {
  for (const int dimension : {2, 3})
    for (const auto family : kFamilies) {
      CAPTURE(dimension);
      const Mesh m = sample(dimension, family);
      const auto V = random_field(m, 3);
      const Point force{1, -2, 3};
      const auto facets = mesh::boundary(m);
      std::vector<double> volume(m.coordinates.size(), 0.0), surface = volume;
      elasticity::add_body_force_derivative(m, [&](const elasticity::CellPoint&) { return force; }, V, volume);
      elasticity::add_traction_derivative(m, facets, [&](const elasticity::FacetPoint&) { return force; }, V, surface);
      const auto at_rest = [&](auto add) {
        return [&m, add](const Mesh& at) {
          std::vector<double> nodal(m.coordinates.size(), 0.0);
          add(at, nodal);
          return nodal;
        };
      };
      const auto body = errors(m, V, volume, at_rest([&](const Mesh& at, auto& nodal) { elasticity::add_body_force(at, [&](const Point&) { return force; }, nodal); }));
      const auto traction = errors(m, V, surface, at_rest([&](const Mesh& at, auto& nodal) {
                                     elasticity::add_traction(at, facets, [&](const elasticity::FacetPoint&) { return force; }, nodal);
                                   }));
      CHECK(*std::min_element(body.begin(), body.end()) < 1e-9);  // in the plane a quadratic function of the step: no order to see
      check_v_shape(traction);
      double sum = 0;  // the volume is the sum of forces per unit force
      for (std::size_t k = 0; k < volume.size(); k += dimension) sum += volume[k];
      CHECK(elasticity::volume_derivative(m, V) == doctest::Approx(sum).epsilon(1e-12));
    }
}

TEST_CASE("a motion of the whole mesh changes nothing, a dilation what it must") {
  const Mesh m = sample(3, mesh::Family::q1);
  const elasticity::MaterialField material(elasticity::isotropic(10, 0.3, 3, elasticity::Plane::strain));
  const auto u = random_field(m, 4);
  std::vector<double> shift(m.coordinates.size(), 0.0);
  for (std::size_t k = 0; k < shift.size(); k += 3) shift[k] = 1;
  CHECK(norm(elasticity::internal_force_derivative(m, material, u, shift)) < 1e-12 * norm(u));
  // x → (1 + t) x: stiffness grows as length, so dK u = K u.
  const auto grown = elasticity::internal_force_derivative(m, material, u, m.coordinates), force = elasticity::internal_force(m, material, {}, u);
  for (std::size_t k = 0; k < force.size(); ++k) CHECK(grown[k] == doctest::Approx(force[k]).epsilon(1e-11));
}
