#include "elasticity/shape_derivative.hpp"

#include "elasticity/kernel.hpp"

namespace dotyk::elasticity {
namespace {

using mesh::Facet;
using mesh::Mesh;
using mesh::Point;
using mesh::dot;
using mesh::minus;
using mesh::times;

/// d(n ds) / ds at a facet's point; with tangents t_u, t_v there (ṫ_u × t_v + t_u × ṫ_v) / |t_u × t_v|; in the plane t_v = e_z.
Point area_growth(const Mesh& mesh, Facet facet, const FacetPoint& p, const std::vector<double>& V) {
  const Point first = mesh.point(mesh.facet_node(facet, 0));
  Point u{0, 0, 0}, v{0, 0, mesh.dimension() == 2 ? 1.0 : 0.0}, du{0, 0, 0}, dv{0, 0, 0};
  for (int a = 0; a < p.nodes; ++a) {
    const int node = mesh.facet_node(facet, a);
    const Point x = minus(mesh.point(node), first), moved = mesh::at_node(V, node, mesh.dimension());
    for (int i = 0; i < 3; ++i)
      u[i] += p.du[a] * x[i], v[i] += p.dv[a] * x[i], du[i] += p.du[a] * moved[i], dv[i] += p.dv[a] * moved[i];
  }
  return times(1 / dot(p.normal, mesh::cross(u, v)), mesh::plus(mesh::cross(du, v), mesh::cross(u, dv)));
}

/// d(ds) / ds = div_Γ V.
double growth(const Mesh& mesh, Facet facet, const FacetPoint& p, const std::vector<double>& V) {
  return dot(p.normal, area_growth(mesh, facet, p, V));
}

/// σ div V − σ(∇V)ᵀ + c:(−∇u ∇V) in a cell, where the gradients of its shape functions are g.
template <int d>
Eigen::Matrix<double, d, d> stress_derivative(const Mesh& mesh, const Hooke& hooke, int cell, const std::vector<double>& u,
                                              const std::vector<double>& V, const double g[][d]) {
  const auto grad_u = gradient_of<d>(mesh, cell, u, g), grad_v = gradient_of<d>(mesh, cell, V, g);
  const auto sigma = stress_of<d>(hooke, grad_u), changed = stress_of<d>(hooke, -grad_u * grad_v);
  return changed + sigma * grad_v.trace() - sigma * grad_v.transpose();
}

}  // namespace

/// ∫ ∂φ:σ changes by ∫ ∂φ:(σ div V − σ(∇V)ᵀ + c:(−∇u ∇V)).
std::vector<double> internal_force_derivative(const Mesh& mesh, const MaterialField& material, const std::vector<double>& u,
                                              const std::vector<double>& V) {
  std::vector<double> out(u.size(), 0.0);
  dispatch(mesh.element, [&]<class E>() {
    for_each_cell<E>(mesh, material, [&](int c, const auto& x, const Hooke& hooke) {
      constexpr bool curved = true;  // or about to be
      for_each_stiffness_point<E>(curved, [&](const auto& xi, double weight) {
        double g[E::nodes][E::dim];
        const double w = physical_gradient<E>(x, xi, g) * weight;
        const auto s = stress_derivative<E::dim>(mesh, hooke, c, u, V, g);
        for (int a = 0; a < E::nodes; ++a)
          for (int i = 0; i < E::dim; ++i) {
            double& force = out[static_cast<std::size_t>(mesh.cell(c)[a]) * E::dim + i];
            for (int j = 0; j < E::dim; ++j) force += w * s(i, j) * g[a][j];
          }
      });
    });
  });
  return out;
}

void add_body_force_derivative(const Mesh& mesh, const CellField& f, const std::vector<double>& V, std::vector<double>& nodal) {
  dispatch(mesh.element, [&]<class E>() {
    for_each_load_point<E>(mesh, [&](const CellPoint& p, double w, const auto& shape, const auto& g) {
      const double change = w * gradient_of<E::dim>(mesh, p.cell, V, g).trace();
      const Point value = f(p);
      for (int a = 0; a < E::nodes; ++a)
        for (int i = 0; i < E::dim; ++i)
          nodal[static_cast<std::size_t>(mesh.cell(p.cell)[a]) * E::dim + i] += change * shape[a] * value[i];
    });
  });
}

void add_traction_derivative(const Mesh& mesh, const std::vector<Facet>& facets, const std::function<Point(const FacetPoint&)>& t,
                             const std::vector<double>& V, std::vector<double>& nodal) {
  for (const Facet facet : facets)
    for_each_facet_point(mesh, facet, [&](const FacetPoint& p) { add_at(mesh, facet, p, times(growth(mesh, facet, p, V), t(p)), nodal); });
}

void add_pressure_derivative(const Mesh& mesh, const std::vector<Facet>& facets, const std::function<double(const FacetPoint&)>& pressure,
                             const std::vector<double>& V, std::vector<double>& nodal) {
  for (const Facet facet : facets)
    for_each_facet_point(mesh, facet, [&](const FacetPoint& p) {
      add_at(mesh, facet, p, times(-pressure(p), area_growth(mesh, facet, p, V)), nodal);
    });
}

void add_spring_force_derivative(const Mesh& mesh, const std::vector<FacetSpring>& springs, const std::vector<double>& u,
                                 const std::vector<double>& V, std::vector<double>& nodal) {
  for (const FacetSpring& spring : springs)
    for_each_facet_point(mesh, spring.facet, [&](const FacetPoint& p) {
      add_at(mesh, spring.facet, p, times(growth(mesh, spring.facet, p, V), spring_force(mesh, spring, p, u)), nodal);
    });
}

std::array<double, 4> facet_weights_derivative(const Mesh& mesh, Facet facet, const std::vector<double>& V) {
  std::array<double, 4> weights{};
  for_each_facet_point(mesh, facet, [&](const FacetPoint& p) {
    const double change = p.measure * growth(mesh, facet, p, V);
    for (int a = 0; a < p.nodes; ++a) weights[a] += change * p.shape[a];
  });
  return weights;
}

double volume_derivative(const Mesh& mesh, const std::vector<double>& V) {
  double sum = 0;
  dispatch(mesh.element, [&]<class E>() {
    for_each_load_point<E>(mesh, [&](const CellPoint& p, double w, const auto&, const auto& g) { sum += w * gradient_of<E::dim>(mesh, p.cell, V, g).trace(); });
  });
  return sum;
}

}  // namespace dotyk::elasticity
