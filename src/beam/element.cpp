#include "beam/element.hpp"

#include <Eigen/Eigenvalues>

namespace dotyk::beam {

namespace {

constexpr int kPoints = 8;

struct Rule {
  Eigen::VectorXd at, weight;  ///< on 0 ≤ s ≤ 1
};

/// Gauss–Legendre by the eigenvalues of Jacobi's matrix (Golub and Welsch 1969).
const Rule& gauss() {
  static const Rule rule = [] {
    Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(kPoints, kPoints);
    for (int i = 1; i < kPoints; ++i) jacobi(i, i - 1) = jacobi(i - 1, i) = i / std::sqrt(4.0 * i * i - 1);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobi);
    return Rule{(eigen.eigenvalues().array() + 1) / 2, eigen.eigenvectors().row(0).array().square()};
  }();
  return rule;
}

}  // namespace

Hermite::Hermite(double s, double h)
    : value(1 + s * s * (2 * s - 3), h * s * (1 - s) * (1 - s), s * s * (3 - 2 * s), h * s * s * (s - 1)),
      slope(6 * s * (s - 1) / h, (1 - s) * (1 - 3 * s), 6 * s * (1 - s) / h, s * (3 * s - 2)),
      curvature((12 * s - 6) / (h * h), (6 * s - 4) / h, (6 - 12 * s) / (h * h), (6 * s - 2) / h) {}

Eigen::Matrix4d stiffness(double EJ, double h) {
  Eigen::Matrix4d K;
  K << 12, 6 * h, -12, 6 * h,               //
      6 * h, 4 * h * h, -6 * h, 2 * h * h,  //
      -12, -6 * h, 12, -6 * h,              //
      6 * h, 2 * h * h, -6 * h, 4 * h * h;
  return EJ / (h * h * h) * K;
}

Eigen::Matrix4d stiffness(const std::function<double(double)>& EJ, double x0, double h) {
  Eigen::Matrix4d K = Eigen::Matrix4d::Zero();
  for (int i = 0; i < kPoints; ++i) {
    const double s = gauss().at[i];
    const Four N = Hermite(s, h).curvature;
    K += h * gauss().weight[i] * EJ(x0 + s * h) * N * N.transpose();
  }
  return K;
}

Four load(double q, double h) { return q * h / 12 * Four(6, h, 6, -h); }

Four load(const std::function<double(double)>& q, double x0, double h) {
  Four f = Four::Zero();
  for (int i = 0; i < kPoints; ++i) {
    const double s = gauss().at[i];
    f += h * gauss().weight[i] * q(x0 + s * h) * Hermite(s, h).value;
  }
  return f;
}

double integral(const std::function<double(double)>& f, double from, double to) {
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) sum += (to - from) * gauss().weight[i] * f(from + gauss().at[i] * (to - from));
  return sum;
}

}  // namespace dotyk::beam
