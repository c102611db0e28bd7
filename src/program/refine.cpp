#include "program/refine.hpp"

#include <algorithm>
#include <vector>

#include "algebra/dense/decompositions.hpp"
#include "program/program.hpp"

namespace dotyk::program {

using algebra::DenseMatrix;
using algebra::Vector;

namespace {

/// One cycle of GMRES with right preconditioning from z = 0: the correction to z.
Vector cycle(const Apply& K, const Apply& regularised, const Vector& residual, double target, int most, int& steps) {
  std::vector<Vector> v{residual.normalized()}, corrections;
  DenseMatrix h = DenseMatrix::Zero(most + 1, most);
  Vector best;
  const double size = residual.norm();
  for (int k = 0; k < most; ++k) {
    corrections.push_back(regularised(v[k]));
    ++steps;
    Vector w = K(corrections[k]);
    for (int round = 0; round < 2; ++round)
      for (int i = 0; i <= k; ++i) {
        const double c = v[i].dot(w);
        h(i, k) += c;
        w -= c * v[i];
      }
    h(k + 1, k) = w.norm();
    Vector b = Vector::Zero(k + 2);
    b[0] = size;
    const DenseMatrix H = h.topLeftCorner(k + 2, k + 1);
    best = algebra::least_squares(H, b);
    if ((H * best - b).norm() <= target || h(k + 1, k) <= 1e-14 * size) break;
    v.push_back(w / h(k + 1, k));
  }
  Vector z = Vector::Zero(residual.size());
  for (Eigen::Index i = 0; i < best.size(); ++i) z += best[i] * corrections[i];
  return z;
}

}  // namespace

Refined refine(const Apply& K, const Apply& regularised, const Vector& b, double target, int most_steps) {
  Refined out{regularised(b), {}, false, 1};
  out.residual = b - K(out.z);
  while (peak(out.residual) > target && out.steps < most_steps) {
    const Vector z = out.z + cycle(K, regularised, out.residual, 0.1 * target, std::min(8, most_steps - out.steps), out.steps);
    const Vector residual = b - K(z);
    if (!(residual.norm() < 0.9 * out.residual.norm())) {
      if (residual.norm() < out.residual.norm()) out.z = z, out.residual = residual;
      break;
    }
    out.z = z, out.residual = residual;
  }
  out.reached = peak(out.residual) <= target;
  return out;
}

}  // namespace dotyk::program
