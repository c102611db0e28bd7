#include "beam/sampled.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dotyk::beam {

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
