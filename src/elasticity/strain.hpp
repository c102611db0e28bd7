#pragma once

// Stresses inside a cell. Used inside this room only.

#include <Eigen/Core>

#include "elasticity/kernel.hpp"
#include "elasticity/stress.hpp"

namespace dotyk::elasticity {

inline constexpr int kPair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};

/// The inverse of Hooke's law in Voigt form (engineering shear), over the components of the dimension.
Eigen::MatrixXd compliance(const Hooke& h);
/// xx yy xy or xx yy zz yz xz xy.
Eigen::VectorXd voigt(const Stress& s, int dimension);

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

}  // namespace dotyk::elasticity
