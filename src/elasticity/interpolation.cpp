#include "elasticity/interpolation.hpp"

#include <Eigen/LU>

#include "elasticity/kernel.hpp"

namespace dotyk::elasticity {
namespace {

/// Reference coordinates of x, by Newton's method (one step for straight simplices).
template <class E>
bool reference_point(const double nodes[][E::dim], const mesh::Point& x,
                     std::array<double, E::dim>& xi) {
  constexpr int steps = E::nodes == E::dim + 1 ? 1 : 20;
  xi = E::centre();
  for (int step = 0; step < steps; ++step) {
    double g[E::nodes][E::dim];
    E::gradient(xi, g);
    const auto n = E::shape(xi);
    Eigen::Matrix<double, E::dim, E::dim> J;
    Eigen::Matrix<double, E::dim, 1> r;
    J.setZero();
    for (int i = 0; i < E::dim; ++i) {
      r[i] = x[i];
      for (int a = 0; a < E::nodes; ++a) {
        r[i] -= n[a] * nodes[a][i];
        for (int k = 0; k < E::dim; ++k) J(i, k) += nodes[a][i] * g[a][k];
      }
    }
    const Eigen::Matrix<double, E::dim, 1> d = J.inverse() * r;
    for (int k = 0; k < E::dim; ++k) xi[k] += d[k];
    if (!(d.norm() < 10)) return false;
    if (d.norm() < 1e-13) break;
  }
  return true;
}

template <class E>
bool inside(const std::array<double, E::dim>& xi, double slack) {
  double sum = 0;
  for (double v : xi) {
    sum += v;
    if (E::simplex ? v < -slack : std::abs(v) > 1 + slack) return false;
  }
  return !E::simplex || sum <= 1 + slack;
}

}  // namespace

bool shape_at(const mesh::Mesh& mesh, int cell, const mesh::Point& x, double slack,
              std::array<double, mesh::kMostNodes>& shape) {
  return dispatch(mesh.element, [&]<class E>() {
    double nodes[E::nodes][E::dim];
    cell_coordinates<E>(mesh, cell, nodes);
    std::array<double, E::dim> xi;
    if (!reference_point<E>(nodes, x, xi) || !inside<E>(xi, slack)) return false;
    const auto n = E::shape(xi);
    shape.fill(0);
    std::copy(n.begin(), n.end(), shape.begin());
    return true;
  });
}

}  // namespace dotyk::elasticity
