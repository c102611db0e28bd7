#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "elasticity/kernel.hpp"
#include "elasticity/stress.hpp"

namespace dotyk::elasticity {
namespace {

constexpr int kPair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};

/// σ at the reference point xi of a cell.
template <class E>
Stress stress_at(const mesh::Mesh& mesh, const Hooke& hooke, const std::vector<double>& u, int cell,
                 const double x[][E::dim], const std::array<double, E::dim>& xi, double* measure) {
  double g[E::nodes][E::dim], strain[3][3] = {};
  *measure = physical_gradient<E>(x, xi, g);
  for (int a = 0; a < E::nodes; ++a)
    for (int i = 0; i < E::dim; ++i) {
      const double ui = u[static_cast<std::size_t>(mesh.cell(cell)[a]) * E::dim + i];
      for (int j = 0; j < E::dim; ++j) {
        strain[i][j] += 0.5 * g[a][j] * ui;
        strain[j][i] += 0.5 * g[a][j] * ui;
      }
    }
  Stress s{};
  for (int v = 0; v < 6; ++v) {
    const int i = kPair[v][0], j = kPair[v][1];
    if (i >= E::dim || j >= E::dim) continue;
    for (int k = 0; k < E::dim; ++k)
      for (int l = 0; l < E::dim; ++l) s[v] += hooke.c[i][j][k][l] * strain[k][l];
  }
  if (E::dim == 2) s[2] = hooke.zz_factor * (s[0] + s[1]);
  return s;
}

/// The inverse of Hooke's law in Voigt form (engineering shear), over the components of the dimension.
Eigen::MatrixXd compliance(const Hooke& h) {
  static const int plane[3] = {0, 1, 5}, space[6] = {0, 1, 2, 3, 4, 5};
  const int* index = h.dimension == 2 ? plane : space;
  const int n = h.dimension == 2 ? 3 : 6;
  Eigen::MatrixXd c(n, n);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      c(a, b) = h.c[kPair[index[a]][0]][kPair[index[a]][1]][kPair[index[b]][0]][kPair[index[b]][1]];
  return c.inverse();
}

Eigen::VectorXd voigt(const Stress& s, int dimension) {
  Eigen::VectorXd v(dimension == 2 ? 3 : 6);
  if (dimension == 2)
    v << s[0], s[1], s[5];
  else
    v << s[0], s[1], s[2], s[3], s[4], s[5];
  return v;
}

}  // namespace

double von_mises(const Stress& s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  const double q = 0.5 * (a * a + b * b + c * c) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
  if (q > 1e-280 && q < 1e280) return std::sqrt(q);
  // Far from 1 the squares leave the range of numbers: once more relative to the greatest component.
  double largest = 0;
  for (const double v : s) largest = std::max(largest, std::abs(v));
  if (!(largest > 0) || !std::isfinite(largest) || (largest > 1e-130 && largest < 1e130)) return std::sqrt(q);
  Stress scaled = s;
  for (double& v : scaled) v /= largest;
  return largest * von_mises(scaled);
}

std::array<double, 3> principal(const Stress& s) {
  Eigen::Matrix3d m;
  m << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2];
  const Eigen::Vector3d e = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m, Eigen::EigenvaluesOnly).eigenvalues();
  return {e[2], e[1], e[0]};
}

std::vector<Stress> cell_stress(const mesh::Mesh& mesh, const MaterialField& material,
                                const std::vector<double>& u) {
  std::vector<Stress> result(mesh.cell_count());
  dispatch(mesh.element, [&]<class E>() {
    double x[E::nodes][E::dim], measure;
    std::array<double, E::dim> centre{};
    if constexpr (E::points == 1) centre = E::point(0);
    Hooke hooke = material.at(0);
    for (int c = 0; c < mesh.cell_count(); ++c) {
      if (material.varies()) hooke = material.at(c);
      cell_coordinates<E>(mesh, c, x);
      result[c] = stress_at<E>(mesh, hooke, u, c, x, centre, &measure);
    }
  });
  return result;
}

EnergyEstimate estimate_error(const mesh::Mesh& mesh, const MaterialField& material,
                              const std::vector<double>& u, const std::vector<Stress>& recovered) {
  EnergyEstimate total;
  const int dim = mesh.dimension();
  dispatch(mesh.element, [&]<class E>() {
    double x[E::nodes][E::dim], measure;
    Hooke hooke = material.at(0);
    Eigen::MatrixXd inverse = compliance(hooke);
    for (int c = 0; c < mesh.cell_count(); ++c) {
      if (material.varies()) inverse = compliance(hooke = material.at(c));
      cell_coordinates<E>(mesh, c, x);
      for (int q = 0; q < E::load_points; ++q) {
        const auto xi = E::load_point(q);
        const Eigen::VectorXd raw = voigt(stress_at<E>(mesh, hooke, u, c, x, xi, &measure), dim);
        Stress smooth{};
        const auto shape = E::shape(xi);
        for (int a = 0; a < E::nodes; ++a)
          for (int v = 0; v < 6; ++v) smooth[v] += shape[a] * recovered[mesh.cell(c)[a]][v];
        const Eigen::VectorXd error = voigt(smooth, dim) - raw;
        const double w = measure * E::load_weight(q);
        total.error_squared += w * error.dot(inverse * error);
        total.solution_squared += w * raw.dot(inverse * raw);
      }
    }
  });
  return total;
}

}  // namespace dotyk::elasticity
