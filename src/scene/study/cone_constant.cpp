#include "scene/study/cone_constant.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "algebra/dense/decompositions.hpp"

namespace dotyk::scene {

using algebra::DenseMatrix;
using algebra::Vector;

namespace {

constexpr int kSteps = 300, kRandomStarts = 10;

/// Goes down from here; the quotient at the end.
double descend(const DenseMatrix& W, const DenseMatrix& N, const algebra::Ldlt& factor, Eigen::Index unilateral, Vector mu) {
  const auto quotient = [&](const Vector& v) {
    const double size = v.dot(N * v);
    return size > 0 ? v.dot(W * v) / size : INFINITY;
  };
  double least = quotient(mu), step = 1;
  for (int k = 0; k < kSteps && step > 1e-10; ++k) {
    mu /= std::sqrt(mu.dot(N * mu));
    const Vector down = factor.solve(Vector(W * mu - least * (N * mu))) / std::max(least, 1e-300);
    for (step *= 4; step > 1e-10; step /= 2) {
      Vector next = mu - step * down;
      next.head(unilateral) = next.head(unilateral).cwiseMax(0);
      const double there = quotient(next);
      if (!(there < least)) continue;
      mu = std::move(next), least = there;
      break;
    }
  }
  return least;
}

}  // namespace

double cone_constant(const DenseMatrix& W, const DenseMatrix& N, Eigen::Index unilateral, Monitor& monitor) {
  const algebra::Ldlt factor(N);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> entry(0, 1);
  double least = INFINITY;
  for (Eigen::Index start = 0; start < N.cols() + kRandomStarts; ++start) {
    monitor.check();
    Vector mu = Vector::Zero(N.cols());
    if (start < N.cols()) mu[start] = 1;
    else
      for (double& m : mu) m = entry(random);
    least = std::min(least, descend(W, N, factor, unilateral, std::move(mu)));
  }
  return std::sqrt(std::max(least, 0.0));
}

}  // namespace dotyk::scene
