#pragma once

// Design problems with known minima.

#include <cmath>
#include <numeric>

#include "base/monitor.hpp"
#include "shape/optimise/optimiser.hpp"

namespace dotyk::test {

using algebra::DenseMatrix;
using algebra::Vector;
using shape::DesignProblem;
using shape::Evaluation;

inline double largest_difference(const Vector& a, const Vector& b) { return (a - b).lpNorm<Eigen::Infinity>(); }

struct KnownDesign {
  DesignProblem problem;
  Vector start, solution, multipliers;
  double minimum = 0;
};

inline Vector vec(std::initializer_list<double> v) { return Eigen::Map<const Vector>(v.begin(), static_cast<Eigen::Index>(v.size())); }

/// min −x − y under x² + y ≤ 2, x + y² ≤ 2: the vertex (1, 1), multipliers ⅓ and ⅓.
inline KnownDesign vertex() {
  KnownDesign k{{vec({0, 0}), vec({2, 2}), {}}, vec({0.2, 0.3}), vec({1, 1}), vec({1. / 3, 1. / 3}), -2};
  k.problem.evaluate = [](const Vector& a) -> std::optional<Evaluation> {
    Evaluation e{-a[0] - a[1], vec({-1, -1}), vec({a[0] * a[0] + a[1] - 2, a[0] + a[1] * a[1] - 2}), DenseMatrix(2, 2)};
    e.jacobian << 2 * a[0], 1, 1, 2 * a[1];
    return e;
  };
  return k;
}

/// Rosen and Suzuki's problem (43 of Hock and Schittkowski): four variables, two of three constraints active.
inline KnownDesign rosen_suzuki() {
  KnownDesign k{{Vector::Constant(4, -4), Vector::Constant(4, 4), {}}, Vector::Zero(4), vec({0, 1, 2, -1}), vec({1, 0, 2}), -44};
  k.problem.evaluate = [](const Vector& x) -> std::optional<Evaluation> {
    const double a = x[0], b = x[1], c = x[2], d = x[3];
    Evaluation e{a * a + b * b + 2 * c * c + d * d - 5 * a - 5 * b - 21 * c + 7 * d,
                 vec({2 * a - 5, 2 * b - 5, 4 * c - 21, 2 * d + 7}),
                 vec({a * a + b * b + c * c + d * d + a - b + c - d - 8, a * a + 2 * b * b + c * c + 2 * d * d - a - d - 10,
                      2 * a * a + b * b + c * c + 2 * a - b - d - 5}),
                 DenseMatrix(3, 4)};
    e.jacobian << 2 * a + 1, 2 * b - 1, 2 * c + 1, 2 * d - 1, 2 * a - 1, 4 * b, 2 * c, 4 * d - 1, 4 * a + 2, 2 * b - 1, 2 * c, -1;
    return e;
  };
  return k;
}

/// Svanberg's cantilever (1987): the lightest of five hollow boxes of heights x, deflection bounded,
///   min Σ x_i,   Σ a_i / x_i³ ≤ 1:   x_i = a_i^¼ (Σ a_j^¼)^⅓,   multiplier (Σ a_j^¼)^(4/3) / 3.
inline KnownDesign cantilever() {
  const Vector a = vec({61, 37, 19, 7, 1});
  const double s = a.array().pow(0.25).sum();
  KnownDesign k{{Vector::Ones(5), Vector::Constant(5, 10), {}}, Vector::Constant(5, 5), a.array().pow(0.25) * std::cbrt(s),
                vec({std::pow(s, 4. / 3) / 3}), std::pow(s, 4. / 3)};
  k.problem.evaluate = [a](const Vector& x) -> std::optional<Evaluation> {
    return Evaluation{x.sum(), Vector::Ones(5), vec({(a.array() / x.array().pow(3)).sum() - 1}), -3 * (a.array() / x.array().pow(4)).matrix().transpose()};
  };
  return k;
}

/// Rosenbrock's valley in a box that cuts it off at x = ½: (½, ¼), value ¼.
inline KnownDesign rosenbrock() {
  KnownDesign k{{vec({-1.5, -0.5}), vec({0.5, 2}), {}}, vec({-1.2, 1}), vec({0.5, 0.25}), Vector(), 0.25};
  k.problem.evaluate = [](const Vector& a) -> std::optional<Evaluation> {
    const double v = a[1] - a[0] * a[0], w = 1 - a[0];
    return Evaluation{100 * v * v + w * w, vec({-400 * a[0] * v - 2 * w, 200 * v}), Vector(), DenseMatrix(0, 2)};
  };
  return k;
}

/// The same problem in other units: variables × a, objective × b, constraints × c.
inline KnownDesign in_units(KnownDesign k, double a, double b, double c) {
  k.problem.lower *= a, k.problem.upper *= a, k.start *= a, k.solution *= a;
  k.multipliers *= b / c, k.minimum *= b;
  k.problem.evaluate = [inner = k.problem.evaluate, a, b, c](const Vector& x) {
    auto e = inner(x / a);
    e->objective *= b, e->gradient *= b / a, e->constraints *= c, e->jacobian *= c / a;
    return e;
  };
  return k;
}

/// Asks to stop after some designs.
class StopAfter final : public Monitor {
 public:
  explicit StopAfter(int designs) : left_(designs) {}
  bool stop() override { return left_-- <= 0; }

 private:
  int left_;
};

}  // namespace dotyk::test
