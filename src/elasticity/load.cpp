#include "elasticity/load.hpp"

#include "elasticity/kernel.hpp"

namespace dotyk::elasticity {
namespace {

using mesh::Facet;
using mesh::Mesh;
using mesh::Point;
using mesh::cross;
using mesh::length;

/// Shape functions and their two reference derivatives on a facet at point q; the weight is returned.
double facet_rule(int dimension, int nodes, int q, double n[4], double du[4], double dv[4]) {
  if (dimension == 2) {
    const double s = q == 0 ? -kGauss : kGauss;
    n[0] = 0.5 * (1 - s), n[1] = 0.5 * (1 + s);
    du[0] = -0.5, du[1] = 0.5;
    dv[0] = dv[1] = 0;
    return 1;
  }
  if (nodes == 3) {
    const auto x = TriangleP1::load_point(q);
    const auto shape = TriangleP1::shape(x);
    double g[3][2];
    TriangleP1::gradient(x, g);
    for (int a = 0; a < 3; ++a) n[a] = shape[a], du[a] = g[a][0], dv[a] = g[a][1];
    return TriangleP1::load_weight(q);
  }
  const auto x = QuadrilateralQ1::load_point(q);
  const auto shape = QuadrilateralQ1::shape(x);
  double g[4][2];
  QuadrilateralQ1::gradient(x, g);
  for (int a = 0; a < 4; ++a) n[a] = shape[a], du[a] = g[a][0], dv[a] = g[a][1];
  return 1;
}

}  // namespace

int facet_points(const Mesh& mesh) {
  return mesh.dimension() == 2 ? 2 : mesh.topology().nodes_per_facet == 3 ? 3 : 4;
}

void for_each_facet_point(const Mesh& mesh, Facet facet,
                          const std::function<void(const FacetPoint&)>& visit) {
  FacetPoint p;
  p.nodes = mesh.topology().nodes_per_facet;
  for (p.index = 0; p.index < facet_points(mesh); ++p.index) {
    double du[4], dv[4];
    const double weight = facet_rule(mesh.dimension(), p.nodes, p.index, p.shape, du, dv);
    Point tu{0, 0, 0}, tv{0, 0, 0};
    p.x = {0, 0, 0};
    const Point first = mesh.point(mesh.facet_node(facet, 0));
    for (int a = 0; a < p.nodes; ++a) {
      const Point x = mesh.point(mesh.facet_node(facet, a));
      for (int i = 0; i < 3; ++i) {
        p.x[i] += p.shape[a] * x[i];
        tu[i] += du[a] * (x[i] - first[i]);
        tv[i] += dv[a] * (x[i] - first[i]);
      }
    }
    p.normal = mesh.dimension() == 2 ? Point{tu[1], -tu[0], 0} : cross(tu, tv);
    const double area = length(p.normal);
    for (double& n : p.normal) n /= area;
    p.measure = weight * area;
    visit(p);
  }
}

int cell_points(const Mesh& mesh) {
  return dispatch(mesh.element, []<class E>() { return E::load_points; });
}

void add_body_force(const Mesh& mesh, const CellField& f, std::vector<double>& nodal) {
  dispatch(mesh.element, [&]<class E>() {
    for_each_load_point<E>(mesh, [&](const CellPoint& p, double w, const auto& shape, const auto&) {
      const Point value = f(p);
      for (int a = 0; a < E::nodes; ++a)
        for (int i = 0; i < E::dim; ++i) nodal[static_cast<std::size_t>(mesh.cell(p.cell)[a]) * E::dim + i] += w * shape[a] * value[i];
    });
  });
}

void add_body_force(const Mesh& mesh, const VectorField& f, std::vector<double>& nodal) {
  add_body_force(mesh, CellField([&](const CellPoint& p) { return f(p.x); }), nodal);
}

void add_traction(const Mesh& mesh, const std::vector<Facet>& facets,
                  const std::function<Point(const FacetPoint&)>& t, std::vector<double>& nodal) {
  const int dim = mesh.dimension();
  for (const Facet facet : facets)
    for_each_facet_point(mesh, facet, [&](const FacetPoint& p) {
      const Point value = t(p);
      for (int a = 0; a < p.nodes; ++a)
        for (int i = 0; i < dim; ++i)
          nodal[static_cast<std::size_t>(mesh.facet_node(facet, a)) * dim + i] +=
              p.measure * p.shape[a] * value[i];
    });
}

}  // namespace dotyk::elasticity
