#include "elasticity/shape_derivative.hpp"

#include "elasticity/kernel.hpp"

namespace dotyk::elasticity {
namespace {

using mesh::Facet;
using mesh::Mesh;
using mesh::Point;
using mesh::cross;
using mesh::dot;
using mesh::times;

/// Values at the nodes of a cell.
template <class E>
void gather(const Mesh& mesh, int cell, const std::vector<double>& nodal, double at[][E::dim]) {
  for (int a = 0; a < E::nodes; ++a)
    for (int i = 0; i < E::dim; ++i) at[a][i] = nodal[static_cast<std::size_t>(mesh.cell(cell)[a]) * E::dim + i];
}

/// out[i][j] = ∂_j w_i.
template <class E>
void gradient_of(const double w[][E::dim], const double g[][E::dim], double out[E::dim][E::dim]) {
  for (int i = 0; i < E::dim; ++i)
    for (int j = 0; j < E::dim; ++j) {
      out[i][j] = 0;
      for (int a = 0; a < E::nodes; ++a) out[i][j] += w[a][i] * g[a][j];
    }
}

template <int d>
double trace(const double m[d][d]) {
  double sum = 0;
  for (int i = 0; i < d; ++i) sum += m[i][i];
  return sum;
}

/// σ_im = c_imkl e_kl.
template <int d>
void stress_of(const Hooke& h, const double e[d][d], double out[d][d]) {
  for (int i = 0; i < d; ++i)
    for (int m = 0; m < d; ++m) {
      out[i][m] = 0;
      for (int k = 0; k < d; ++k)
        for (int l = 0; l < d; ++l) out[i][m] += h.c[i][m][k][l] * e[k][l];
    }
}

/// ∫ ∂φ:σ changes by ∫ ∂φ:(σ div V − σ(∇V)ᵀ + c:(−∇u ∇V)).
template <class E>
void add_cell(const Hooke& h, const double x[][E::dim], const double u[][E::dim], const double v[][E::dim], double force[][E::dim]) {
  constexpr int d = E::dim;
  for (int q = 0; q < E::points; ++q) {
    double g[E::nodes][d], grad_u[d][d], grad_v[d][d], changed[d][d], sigma[d][d], change[d][d];
    const double w = physical_gradient<E>(x, E::point(q), g) * E::weight(q);
    gradient_of<E>(u, g, grad_u);
    gradient_of<E>(v, g, grad_v);
    for (int i = 0; i < d; ++i)
      for (int j = 0; j < d; ++j) {
        changed[i][j] = 0;
        for (int k = 0; k < d; ++k) changed[i][j] -= grad_u[i][k] * grad_v[k][j];
      }
    stress_of<d>(h, grad_u, sigma);
    stress_of<d>(h, changed, change);
    const double div = trace<d>(grad_v);
    for (int i = 0; i < d; ++i)
      for (int m = 0; m < d; ++m) {
        change[i][m] += sigma[i][m] * div;
        for (int k = 0; k < d; ++k) change[i][m] -= sigma[i][k] * grad_v[m][k];
      }
    for (int a = 0; a < E::nodes; ++a)
      for (int i = 0; i < d; ++i)
        for (int m = 0; m < d; ++m) force[a][i] += w * change[i][m] * g[a][m];
  }
}

/// Derivatives of a facet's shape functions (in space) by its two coordinates where they have these values.
void facet_gradients(int nodes, const double shape[4], double du[4], double dv[4]) {
  if (nodes == 3) {
    const double u[3] = {-1, 1, 0}, v[3] = {-1, 0, 1};
    for (int a = 0; a < 3; ++a) du[a] = u[a], dv[a] = v[a];
    return;
  }
  const double s = 2 * (shape[1] + shape[2]) - 1, t = 2 * (shape[2] + shape[3]) - 1;
  const double u[4] = {-(1 - t), 1 - t, 1 + t, -(1 + t)}, v[4] = {-(1 - s), -(1 + s), 1 + s, 1 - s};
  for (int a = 0; a < 4; ++a) du[a] = u[a] / 4, dv[a] = v[a] / 4;
}

/// How the area vector n ds at a facet's points changes as its nodes move.
class FacetGrowth {
 public:
  FacetGrowth(const Mesh& mesh, Facet facet, const std::vector<double>& V) : plane_(mesh.dimension() == 2) {
    for (int k = 0; k < mesh.topology().nodes_per_facet; ++k) {
      x_.push_back(mesh.point(mesh.facet_node(facet, k)));
      v_.push_back(mesh::at_node(V, mesh.facet_node(facet, k), mesh.dimension()));
    }
  }

  /// d(n ds) / ds at a point; with tangents t_u, t_v there (ṫ_u × t_v + t_u × ṫ_v) / |t_u × t_v|; in the plane t_v = e_z.
  Point vector(const FacetPoint& p) const {
    const auto [u, v, du, dv] = tangents(p);
    const Point area = cross(u, v), first = cross(du, v), second = cross(u, dv);
    const double size = dot(p.normal, area);
    return {(first[0] + second[0]) / size, (first[1] + second[1]) / size, (first[2] + second[2]) / size};
  }

  /// d(ds) / ds = div_Γ V, along the normal of vector().
  double at(const FacetPoint& p) const {
    return dot(p.normal, vector(p));
  }

 private:
  struct Tangents {
    Point u, v, du, dv;
  };
  Tangents tangents(const FacetPoint& p) const {
    Tangents t{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    if (plane_) {
      for (int i = 0; i < 2; ++i) t.u[i] = x_[1][i] - x_[0][i], t.du[i] = v_[1][i] - v_[0][i];
      t.v[2] = 1;
      return t;
    }
    double su[4], sv[4];
    facet_gradients(p.nodes, p.shape, su, sv);
    for (int a = 0; a < p.nodes; ++a)
      for (int i = 0; i < 3; ++i)
        t.u[i] += su[a] * x_[a][i], t.v[i] += sv[a] * x_[a][i], t.du[i] += su[a] * v_[a][i], t.dv[i] += sv[a] * v_[a][i];
    return t;
  }

  bool plane_;
  std::vector<Point> x_, v_;
};

/// Adds ∫ φ t of one facet to `nodal`.
void add_at(const Mesh& mesh, Facet facet, const FacetPoint& p, const Point& t, std::vector<double>& nodal) {
  const int dim = mesh.dimension();
  for (int a = 0; a < p.nodes; ++a)
    for (int i = 0; i < dim; ++i) nodal[static_cast<std::size_t>(mesh.facet_node(facet, a)) * dim + i] += p.measure * p.shape[a] * t[i];
}

}  // namespace

std::vector<double> internal_force_derivative(const Mesh& mesh, const MaterialField& material, const std::vector<double>& u,
                                              const std::vector<double>& V) {
  std::vector<double> out(u.size(), 0.0);
  dispatch(mesh.element, [&]<class E>() {
    double x[E::nodes][E::dim], at_u[E::nodes][E::dim], at_v[E::nodes][E::dim];
    for (int c = 0; c < mesh.cell_count(); ++c) {
      cell_coordinates<E>(mesh, c, x);
      gather<E>(mesh, c, u, at_u);
      gather<E>(mesh, c, V, at_v);
      double force[E::nodes][E::dim] = {};
      add_cell<E>(material.at(c), x, at_u, at_v, force);
      for (int a = 0; a < E::nodes; ++a)
        for (int i = 0; i < E::dim; ++i) out[static_cast<std::size_t>(mesh.cell(c)[a]) * E::dim + i] += force[a][i];
    }
  });
  return out;
}

void add_body_force_derivative(const Mesh& mesh, const CellField& f, const std::vector<double>& V, std::vector<double>& nodal) {
  dispatch(mesh.element, [&]<class E>() {
    for_each_load_point<E>(mesh, [&](const CellPoint& p, double w, const auto& shape, const auto& g) {
      double v[E::nodes][E::dim], grad_v[E::dim][E::dim];
      gather<E>(mesh, p.cell, V, v);
      gradient_of<E>(v, g, grad_v);
      const Point value = f(p);
      for (int a = 0; a < E::nodes; ++a)
        for (int i = 0; i < E::dim; ++i)
          nodal[static_cast<std::size_t>(mesh.cell(p.cell)[a]) * E::dim + i] += w * trace<E::dim>(grad_v) * shape[a] * value[i];
    });
  });
}

void add_traction_derivative(const Mesh& mesh, const std::vector<Facet>& facets, const std::function<Point(const FacetPoint&)>& t,
                             const std::vector<double>& V, std::vector<double>& nodal) {
  for (const Facet facet : facets) {
    const FacetGrowth growth(mesh, facet, V);
    for_each_facet_point(mesh, facet, [&](const FacetPoint& p) { add_at(mesh, facet, p, times(growth.at(p), t(p)), nodal); });
  }
}

void add_pressure_derivative(const Mesh& mesh, const std::vector<Facet>& facets, const std::function<double(const FacetPoint&)>& pressure,
                             const std::vector<double>& V, std::vector<double>& nodal) {
  for (const Facet facet : facets) {
    const FacetGrowth growth(mesh, facet, V);
    for_each_facet_point(mesh, facet, [&](const FacetPoint& p) { add_at(mesh, facet, p, times(-pressure(p), growth.vector(p)), nodal); });
  }
}

void add_spring_force_derivative(const Mesh& mesh, const std::vector<FacetSpring>& springs, const std::vector<double>& u,
                                 const std::vector<double>& V, std::vector<double>& nodal) {
  const int dim = mesh.dimension();
  for (const FacetSpring& spring : springs) {
    const FacetGrowth growth(mesh, spring.facet, V);
    for_each_facet_point(mesh, spring.facet, [&](const FacetPoint& p) {
      Point force{0, 0, 0};
      for (int a = 0; a < p.nodes; ++a)
        for (int i = 0; i < dim; ++i)
          force[i] += spring.stiffness[p.index][i] * p.shape[a] * u[static_cast<std::size_t>(mesh.facet_node(spring.facet, a)) * dim + i];
      add_at(mesh, spring.facet, p, times(growth.at(p), force), nodal);
    });
  }
}

std::array<double, 4> facet_weights_derivative(const Mesh& mesh, Facet facet, const std::vector<double>& V) {
  std::array<double, 4> weights{};
  const FacetGrowth growth(mesh, facet, V);
  for_each_facet_point(mesh, facet, [&](const FacetPoint& p) {
    const double change = p.measure * growth.at(p);
    for (int a = 0; a < p.nodes; ++a) weights[a] += change * p.shape[a];
  });
  return weights;
}

double volume_derivative(const Mesh& mesh, const std::vector<double>& V) {
  double sum = 0;
  dispatch(mesh.element, [&]<class E>() {
    double x[E::nodes][E::dim], v[E::nodes][E::dim], g[E::nodes][E::dim], grad_v[E::dim][E::dim];
    for (int c = 0; c < mesh.cell_count(); ++c) {
      cell_coordinates<E>(mesh, c, x);
      gather<E>(mesh, c, V, v);
      for (int q = 0; q < E::points; ++q) {
        const double w = physical_gradient<E>(x, E::point(q), g) * E::weight(q);
        gradient_of<E>(v, g, grad_v);
        sum += w * trace<E::dim>(grad_v);
      }
    }
  });
  return sum;
}

}  // namespace dotyk::elasticity
