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

/// div V where the gradients of a cell's shape functions are g.
template <class E>
double divergence(const Mesh& mesh, int cell, const std::vector<double>& V, const double g[][E::dim]) {
  return (values_of<E>(mesh, cell, V).transpose() * matrix<E>(g)).trace();
}

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

}  // namespace

/// ∫ ∂φ:σ changes by ∫ ∂φ:(σ div V − σ(∇V)ᵀ + c:(−∇u ∇V)).
std::vector<double> internal_force_derivative(const Mesh& mesh, const MaterialField& material, const std::vector<double>& u,
                                              const std::vector<double>& V) {
  std::vector<double> out(u.size(), 0.0);
  dispatch(mesh.element, [&]<class E>() {
    using Square = Eigen::Matrix<double, E::dim, E::dim>;
    for_each_cell<E>(mesh, material, [&](int c, const auto& x, const Hooke& hooke) {
      const auto at_u = values_of<E>(mesh, c, u), at_v = values_of<E>(mesh, c, V);
      Eigen::Matrix<double, E::nodes, E::dim> force = Eigen::Matrix<double, E::nodes, E::dim>::Zero();
      for (int q = 0; q < E::points; ++q) {
        double g[E::nodes][E::dim];
        const double w = physical_gradient<E>(x, E::point(q), g) * E::weight(q);
        const Square grad_u = at_u.transpose() * matrix<E>(g), grad_v = at_v.transpose() * matrix<E>(g);  // (i, j): ∂_j of component i
        const Square sigma = stress_of<E::dim>(hooke, grad_u), changed = stress_of<E::dim>(hooke, -grad_u * grad_v);
        force += w * matrix<E>(g) * (changed + sigma * grad_v.trace() - sigma * grad_v.transpose()).transpose();
      }
      for (int a = 0; a < E::nodes; ++a)
        for (int i = 0; i < E::dim; ++i) out[static_cast<std::size_t>(mesh.cell(c)[a]) * E::dim + i] += force(a, i);
    });
  });
  return out;
}

void add_body_force_derivative(const Mesh& mesh, const CellField& f, const std::vector<double>& V, std::vector<double>& nodal) {
  dispatch(mesh.element, [&]<class E>() {
    for_each_load_point<E>(mesh, [&](const CellPoint& p, double w, const auto& shape, const auto& g) {
      const double change = w * divergence<E>(mesh, p.cell, V, g);
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
    for_each_load_point<E>(mesh, [&](const CellPoint& p, double w, const auto&, const auto& g) { sum += w * divergence<E>(mesh, p.cell, V, g); });
  });
  return sum;
}

}  // namespace dotyk::elasticity
