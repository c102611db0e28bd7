#include "elasticity/load.hpp"

#include <algorithm>

#include "elasticity/kernel.hpp"

namespace dotyk::elasticity {
namespace {

using mesh::Facet;
using mesh::Mesh;
using mesh::Point;
using mesh::cross;
using mesh::length;

/// Shape functions at point q of a facet, which is a line or a cell of the plane; its weight returned.
template <class E>
double rule(int q, FacetPoint& p) {
  const auto x = E::load_point(q);
  const auto shape = E::shape(x);
  double g[E::nodes][E::dim];
  E::gradient(x, g);
  for (int a = 0; a < E::nodes; ++a) p.shape[a] = shape[a], p.du[a] = g[a][0], p.dv[a] = E::dim == 2 ? g[a][E::dim - 1] : 0;
  return E::load_weight(q);
}

double facet_rule(const mesh::ElementTopology& t, int q, FacetPoint& p) {
  switch (t.nodes_per_facet) {
    case 3: return t.dimension == 2 ? rule<Tensor<1, 2>>(q, p) : rule<TriangleP1>(q, p);
    case 4: return rule<QuadrilateralQ1>(q, p);
    case 6: return rule<TriangleP2>(q, p);
    case 9: return rule<QuadrilateralQ2>(q, p);
    default: return rule<Tensor<1, 1>>(q, p);
  }
}

}  // namespace

int facet_points(const Mesh& mesh) {
  const mesh::ElementTopology& t = mesh.topology();
  return t.dimension == 2 ? t.order + 1 : t.nodes_per_facet;
}

void for_each_facet_point(const Mesh& mesh, Facet facet,
                          const std::function<void(const FacetPoint&)>& visit) {
  FacetPoint p;
  p.nodes = mesh.topology().nodes_per_facet;
  for (p.index = 0; p.index < facet_points(mesh); ++p.index) {
    const double weight = facet_rule(mesh.topology(), p.index, p);
    Point tu{0, 0, 0}, tv{0, 0, 0};
    p.x = {0, 0, 0};
    const Point first = mesh.point(mesh.facet_node(facet, 0));
    for (int a = 0; a < p.nodes; ++a) {
      const Point x = mesh.point(mesh.facet_node(facet, a));
      for (int i = 0; i < 3; ++i) {
        p.x[i] += p.shape[a] * x[i];
        tu[i] += p.du[a] * (x[i] - first[i]);
        tv[i] += p.dv[a] * (x[i] - first[i]);
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

void for_each_cell_point(const Mesh& mesh, const std::function<void(const CellPoint&)>& visit) {
  dispatch(mesh.element, [&]<class E>() { for_each_load_point<E>(mesh, [&](const CellPoint& p, double, const auto&, const auto&) { visit(p); }); });
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

void add_at(const Mesh& mesh, Facet facet, const FacetPoint& p, const Point& t, std::vector<double>& nodal) {
  const int dim = mesh.dimension();
  for (int a = 0; a < p.nodes; ++a)
    for (int i = 0; i < dim; ++i) nodal[static_cast<std::size_t>(mesh.facet_node(facet, a)) * dim + i] += p.measure * p.shape[a] * t[i];
}

void add_traction(const Mesh& mesh, const std::vector<Facet>& facets,
                  const std::function<Point(const FacetPoint&)>& t, std::vector<double>& nodal) {
  for (const Facet facet : facets)
    for_each_facet_point(mesh, facet, [&](const FacetPoint& p) { add_at(mesh, facet, p, t(p), nodal); });
}

}  // namespace dotyk::elasticity
