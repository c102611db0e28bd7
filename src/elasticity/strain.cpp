#include "elasticity/strain.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "algebra/dense/decompositions.hpp"

namespace dotyk::elasticity {

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
  const Eigen::Vector3d e = algebra::eigenvalues3(m);
  return {e[2], e[1], e[0]};
}

std::vector<Stress> cell_stress(const mesh::Mesh& mesh, const MaterialField& material,
                                const std::vector<double>& u) {
  std::vector<Stress> result(mesh.cell_count());
  dispatch(mesh.element, [&]<class E>() {
    double x[E::nodes][E::dim], measure;
    const auto centre = E::centre();
    Hooke hooke = material.at(0);
    for (int c = 0; c < mesh.cell_count(); ++c) {
      if (material.varies()) hooke = material.at(c);
      cell_coordinates<E>(mesh, c, x);
      result[c] = stress_at<E>(mesh, hooke, u, c, x, centre, &measure);
    }
  });
  return result;
}

}  // namespace dotyk::elasticity
