#include "elasticity/load.hpp"

#include <algorithm>
#include <numeric>

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

int numbers_of_cell(int dimension) { return dimension * (2 + dimension); }

/// Fits a linear force to forces f at the points x of one cell, and appends its numbers.
template <int d>
void append_fit(const std::vector<mesh::Point>& x, const std::vector<mesh::Point>& f, std::vector<double>& numbers) {
  using Vector = Eigen::Matrix<double, d, 1>;
  using Matrix = Eigen::Matrix<double, d, d>;
  const auto mean = [](const std::vector<mesh::Point>& all) {
    Vector sum = Vector::Zero();
    for (const mesh::Point& p : all) sum += Eigen::Map<const Vector>(p.data());
    return Vector(sum / static_cast<double>(all.size()));
  };
  const bool alike = std::ranges::all_of(f, [&](const mesh::Point& at) { return std::equal(at.begin(), at.begin() + d, f[0].begin()); });
  const Vector middle = mean(x), force = alike ? Vector(Eigen::Map<const Vector>(f[0].data())) : mean(f);
  Matrix moments = Matrix::Zero(), products = Matrix::Zero();
  for (std::size_t q = 0; q < x.size() && !alike; ++q) {
    const Vector from = Eigen::Map<const Vector>(x[q].data()) - middle;
    moments += from * from.transpose(), products += (Eigen::Map<const Vector>(f[q].data()) - force) * from.transpose();
  }
  const Matrix gradient = alike ? Matrix(Matrix::Zero()) : Matrix(products * moments.inverse());
  numbers.insert(numbers.end(), middle.begin(), middle.end());
  numbers.insert(numbers.end(), force.begin(), force.end());
  for (int i = 0; i < d; ++i)
    for (int j = 0; j < d; ++j) numbers.push_back(gradient(i, j));
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

LinearForce::LinearForce(const mesh::Mesh& mesh, const VectorField& force) : dimension_(mesh.dimension()) {
  std::vector<double> numbers;
  bool uniform = true;
  mesh::Point first{0, 0, 0};
  std::vector<mesh::Point> x, f;
  for_each_cell_point(mesh, [&, points = cell_points(mesh)](const CellPoint& p) {
    x.push_back(p.x), f.push_back(force(p.x));
    if (p.cell == 0 && p.index == 0) first = f[0];
    uniform = uniform && std::equal(first.begin(), first.begin() + dimension_, f.back().begin());
    if (p.index + 1 < points) return;
    dimension_ == 2 ? append_fit<2>(x, f, numbers) : append_fit<3>(x, f, numbers);
    x.clear(), f.clear();
  });
  if (uniform) numbers.resize(static_cast<std::size_t>(numbers_of_cell(dimension_)));
  else place_.resize(static_cast<std::size_t>(mesh.cell_count()));
  std::iota(place_.begin(), place_.end(), 0);
  numbers_ = std::make_shared<const std::vector<double>>(std::move(numbers));
}

mesh::Point LinearForce::at(int cell, const mesh::Point& x) const {
  const int d = dimension_;
  const double* middle = numbers_->data() + (varies() ? static_cast<std::size_t>(place_[cell]) * numbers_of_cell(d) : 0);
  const double *force = middle + d, *gradient = force + d;
  mesh::Point f{0, 0, 0};
  for (int i = 0; i < d; ++i) {
    f[i] = force[i];
    for (int j = 0; j < d; ++j) f[i] += gradient[i * d + j] * (x[j] - middle[j]);
  }
  return f;
}

LinearForce LinearForce::of(const std::vector<int>& cells) const {
  LinearForce out = *this;
  if (!varies()) return out;
  out.place_.clear();
  for (const int c : cells) out.place_.push_back(place_[c]);
  return out;
}

Lists LinearForce::lists() const {
  std::vector<double> numbers;
  if (any() && !varies()) numbers = *numbers_;
  const auto size = static_cast<std::ptrdiff_t>(numbers_of_cell(dimension_));
  for (const int p : place_) numbers.insert(numbers.end(), numbers_->begin() + p * size, numbers_->begin() + (p + 1) * size);
  return {{{dimension_, varies()}}, {std::move(numbers)}};
}

LinearForce::LinearForce(const std::vector<int>& whole, std::vector<double> real) : dimension_(whole[0]) {
  if (dimension_ == 0) return;
  if (whole[1]) place_.resize(real.size() / static_cast<std::size_t>(numbers_of_cell(dimension_)));
  std::iota(place_.begin(), place_.end(), 0);
  numbers_ = std::make_shared<const std::vector<double>>(std::move(real));
}

}  // namespace dotyk::elasticity
