#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/mesh.hpp"

namespace dotyk::mesh {
namespace {

double determinant(const Point& u, const Point& v, const Point& w) {
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
         u[2] * (v[0] * w[1] - v[1] * w[0]);
}

constexpr Point kUp{0, 0, 1};

/// The two neighbours along edges of each corner, right-handed.
constexpr int kQuadCorner[4][2] = {{1, 3}, {2, 0}, {3, 1}, {0, 2}};

/// Of a trilinear map the derivative along `axis`, at 0, 1/2 and 1 of the next axis and, slower, of the one after. `x`: corners
/// by bits, bit k set at the upper end of axis k.
std::array<Point, 9> hex_derivatives(const std::array<Point, 8>& x, int axis) {
  const int along = 1 << axis, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
  const auto edge = [&](int from) { return minus(x[from + along], x[from]); };
  const auto middle = [](const Point& a, const Point& b) { return times(0.5, plus(a, b)); };
  std::array<Point, 9> d{edge(0), {}, edge(u), {}, {}, {}, edge(v), {}, edge(u + v)};
  for (const int row : {0, 6}) d[row + 1] = middle(d[row], d[row + 2]);
  for (const int column : {0, 1, 2}) d[3 + column] = middle(d[column], d[6 + column]);
  return d;
}

/// The least at the 27 places of nodes of order 2: of degree 2 along each axis, it can be negative between sound corners.
double hex_jacobian(const Mesh& mesh, const int* n) {
  constexpr int node[8] = {0, 1, 3, 2, 4, 5, 7, 6};
  std::array<Point, 8> x;
  for (int corner = 0; corner < 8; ++corner) x[corner] = mesh.point(n[node[corner]]);
  const auto dx = hex_derivatives(x, 0), dy = hex_derivatives(x, 1), dz = hex_derivatives(x, 2);
  double least = INFINITY;
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) least = std::min(least, determinant(dx[j + 3 * k], dy[k + 3 * i], dz[i + 3 * j]));
  return least;
}

double quad_jacobian(const Mesh& mesh, const int* n) {
  const auto edge = [&](int a, int b) { return minus(mesh.point(n[b]), mesh.point(n[a])); };
  double least = INFINITY;
  for (int k = 0; k < 4; ++k)
    least = std::min(least, determinant(edge(k, kQuadCorner[k][0]), edge(k, kQuadCorner[k][1]), kUp));
  return least;
}

void add(Point& sum, double weight, const Point& x) {
  for (int i = 0; i < 3; ++i) sum[i] += weight * x[i];
}

/// How much of each corner there is in a node of a straight cell.
std::array<double, 8> shares(const ElementTopology& t, int node) {
  std::array<double, 8> share{};
  if (node < t.corners) {
    share[node] = 1;
  } else {
    const std::vector<int>& corners = t.between[node - t.corners];
    for (const int k : corners) share[k] = 1.0 / static_cast<double>(corners.size());
  }
  return share;
}

/// ∂x/∂λ_i in a simplex of order 2, where x = Σ λ_i(2λ_i − 1) x_i + Σ 4λ_iλ_j x_ij.
Point simplex_derivative(const Mesh& mesh, const ElementTopology& t, const int* n, const std::array<double, 8>& lambda, int i) {
  Point d{0, 0, 0};
  add(d, 4 * lambda[i] - 1, mesh.point(n[i]));
  for (std::size_t k = 0; k < t.between.size(); ++k) {
    const int a = t.between[k][0], b = t.between[k][1];
    if (a == i || b == i) add(d, 4 * lambda[a == i ? b : a], mesh.point(n[t.corners + k]));
  }
  return d;
}

/// The Jacobian of a simplex at a point where `derivative(i)` gives ∂x/∂λ_i.
template <class Derivative>
double simplex_jacobian_at(int dimension, const Derivative& derivative) {
  const Point first = derivative(0);
  Point d[3] = {{}, {}, kUp};
  for (int i = 1; i <= dimension; ++i) d[i - 1] = minus(derivative(i), first);
  return determinant(d[0], d[1], d[2]);
}

double simplex_jacobian(const Mesh& mesh, const ElementTopology& t, const int* n) {
  if (t.order == 1) return simplex_jacobian_at(t.dimension, [&](int i) { return mesh.point(n[i]); });
  double least = INFINITY;
  for (int node = 0; node < t.nodes; ++node) {
    const auto lambda = shares(t, node);
    least = std::min(least, simplex_jacobian_at(t.dimension, [&](int i) { return simplex_derivative(mesh, t, n, lambda, i); }));
  }
  return least;
}

/// Of a tensor cell of order 2: node at x + 3y + 9z of its 3 × 3 (× 3) lattice.
std::array<int, 27> lattice(const ElementTopology& t) {
  constexpr int corner[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}};
  std::array<int, 27> node{};
  for (int a = 0; a < t.nodes; ++a) {
    const auto share = shares(t, a);
    double at[3] = {0, 0, 0};
    for (int k = 0; k < t.corners; ++k)
      for (int i = 0; i < 3; ++i) at[i] += share[k] * corner[k][i];
    node[static_cast<int>(at[0] + 3 * at[1] + 9 * at[2])] = a;
  }
  return node;
}

double tensor_jacobian(const Mesh& mesh, const ElementTopology& t, const int* n) {
  // Derivatives at the three nodes of a line of unit length.
  constexpr double weight[3][3] = {{-3, 4, -1}, {-1, 0, 1}, {1, -4, 3}};
  constexpr int stride[3] = {1, 3, 9};
  const auto node = lattice(t);
  double least = INFINITY;
  for (int a = 0; a < t.nodes; ++a) {
    Point d[3] = {{0, 0, 0}, {0, 0, 0}, kUp};
    for (int i = 0; i < t.dimension; ++i) {
      const int along = a / stride[i] % 3;
      d[i] = {0, 0, 0};
      for (int k = 0; k < 3; ++k) add(d[i], weight[along][k], mesh.point(n[node[a + (k - along) * stride[i]]]));
    }
    least = std::min(least, determinant(d[0], d[1], d[2]));
  }
  return least;
}

}  // namespace

double least_jacobian(const Mesh& mesh, int c) {
  const ElementTopology& t = mesh.topology();
  const int* nodes = mesh.cell(c);
  if (t.simplex()) return simplex_jacobian(mesh, t, nodes);
  if (t.order == 2) return tensor_jacobian(mesh, t, nodes);
  return t.dimension == 2 ? quad_jacobian(mesh, nodes) : hex_jacobian(mesh, nodes);
}

}  // namespace dotyk::mesh
