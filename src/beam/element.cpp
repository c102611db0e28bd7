#include "beam/element.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::beam {

const algebra::Quadrature& rule() {
  static const algebra::Quadrature eight = algebra::gauss(8);
  return eight;
}

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
  for (int i = 0; i < rule().points.size(); ++i) {
    const double s = rule().points[i];
    const Four N = Hermite(s, h).curvature;
    K += h * rule().weights[i] * EJ(x0 + s * h) * N * N.transpose();
  }
  return K;
}

Four load(double q, double h) { return q * h / 12 * Four(6, h, 6, -h); }

Four load(const std::function<double(double)>& q, double x0, double h) {
  Four f = Four::Zero();
  for (int i = 0; i < rule().points.size(); ++i) {
    const double s = rule().points[i];
    f += h * rule().weights[i] * q(x0 + s * h) * Hermite(s, h).value;
  }
  return f;
}

double integral(const std::function<double(double)>& f, double from, double to) {
  double sum = 0;
  for (int i = 0; i < rule().points.size(); ++i) sum += (to - from) * rule().weights[i] * f(from + rule().points[i] * (to - from));
  return sum;
}

namespace {

constexpr int kPoints = 8;

/// Chebyshev points of the first kind on 0 ≤ s ≤ 1, and their barycentric weights (Berrut and Trefethen 2004, §5).
struct Points {
  Points() {
    for (int i = 0; i < kPoints; ++i) {
      const double angle = M_PI * (2 * i + 1) / (2 * kPoints);
      at[i] = (1 - std::cos(angle)) / 2;
      weight[i] = (i % 2 == 0 ? 1 : -1) * std::sin(angle);
    }
  }
  std::array<double, kPoints> at, weight;
};

const Points& points() {
  static const Points all;
  return all;
}

double interpolate(const double* values, double s) {
  double above = 0, below = 0;
  for (int i = 0; i < kPoints; ++i) {
    if (s == points().at[i]) return values[i];
    const double w = points().weight[i] / (s - points().at[i]);
    above += w * values[i];
    below += w;
  }
  return above / below;
}

}  // namespace

std::function<double(double)> sampled(const std::function<double(double)>& f, std::vector<double> nodes) {
  std::vector<double> values;
  for (std::size_t cell = 0; cell + 1 < nodes.size(); ++cell)
    for (const double s : points().at) values.push_back(f(nodes[cell] + s * (nodes[cell + 1] - nodes[cell])));
  return [nodes = std::move(nodes), values = std::move(values)](double x) {
    const auto above = std::upper_bound(nodes.begin(), nodes.end(), x);
    const auto cell = std::clamp<std::ptrdiff_t>(above - nodes.begin() - 1, 0, static_cast<std::ptrdiff_t>(nodes.size()) - 2);
    return interpolate(&values[cell * kPoints], (x - nodes[cell]) / (nodes[cell + 1] - nodes[cell]));
  };
}

}  // namespace dotyk::beam
