#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "../support/scenes.hpp"
#include "scene/model/moved.hpp"
#include "shape/derivative/sensitivity.hpp"

// Derivatives of solutions against differences of scenes solved again at moved nodes.

namespace dotyk::test {

using algebra::Vector;
using shape::Velocities;
using ScenePtr = std::shared_ptr<scene::Scene>;
using SolutionPtr = std::shared_ptr<const scene::Solution>;

/// V(x) of a body, by its index.
using Motion = std::function<Point(int body, const Point& x)>;

inline Velocities velocities(const scene::Scene& scene, const Motion& motion) {
  Velocities V;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Mesh& m = *scene.bodies[b]->mesh;
    std::vector<double>& of_body = V.emplace_back(m.coordinates.size());
    for (int n = 0; n < m.node_count(); ++n) {
      const Point v = motion(static_cast<int>(b), m.point(n));
      for (int i = 0; i < m.dimension(); ++i) of_body[static_cast<std::size_t>(n) * m.dimension() + i] = v[i];
    }
  }
  return V;
}

/// Every node at random, up to `size` along each axis for which `free` is set.
inline Motion random_motion(double size, std::array<bool, 3> free = {true, true, true}, unsigned seed = 1) {
  auto engine = std::make_shared<std::mt19937>(seed);
  return [=](int, const Point&) {
    Point v{0, 0, 0};
    for (int i = 0; i < 3; ++i)
      if (free[i]) v[i] = std::uniform_real_distribution<double>(-size, size)(*engine);
    return v;
  };
}

/// A smooth motion that is different on each body.
inline Motion waves(double size) {
  return [=](int body, const Point& x) {
    const double b = 1 + 0.7 * body;
    return Point{size * std::sin(b + 1.3 * x[0] + 2.1 * x[1] - x[2]), size * std::cos(2 * b + 1.9 * x[0] - x[1] + 1.4 * x[2]),
                 size * std::sin(3 * b + x[0] + 1.2 * x[1] + x[2])};
  };
}

inline SolutionPtr solved(const ScenePtr& scene, const std::shared_ptr<problem::Condenser>& condenser = nullptr) {
  Monitor quiet;
  solver::Newton newton;
  newton.tol = 1e-14;  // differences blow up what is left
  const bool friction = std::any_of(scene->contacts.begin(), scene->contacts.end(), [](const auto& c) { return c->tangential->rubs(); });
  const SolutionPtr s = scene::solve(scene, friction ? solver::Method(newton) : solver::Method(solver::Pdas{}), {.coarse = nullptr, .closed = std::nullopt, .after = nullptr, .condenser = condenser}, quiet);
  REQUIRE_MESSAGE(s->result().converged, s->result().reason);
  return s;
}

inline SolutionPtr solved_at(const scene::Scene& scene, const Velocities& V, double t) {
  std::vector<std::vector<double>> points;
  for (std::size_t b = 0; b < V.size(); ++b) {
    points.emplace_back();
    if (V[b].empty()) continue;
    points.back() = scene.bodies[b]->mesh->coordinates;
    for (std::size_t k = 0; k < V[b].size(); ++k) points.back()[k] += t * V[b][k];
  }
  return solved(scene::moved(scene, points));
}

inline shape::Sensitivity sensitivity(const SolutionPtr& s, const std::shared_ptr<problem::Condenser>& condenser = nullptr) {
  static Monitor quiet;
  return {s, condenser, {}, quiet};
}

/// Relative errors of differences against a derivative.
struct Errors {
  double u, lambda;
};

inline double apart(const Vector& difference, const Vector& exact) {
  return exact.norm() > 0 ? (difference - exact).norm() / exact.norm() : difference.norm();
}

/// Of central differences for h = 1e-1 … 1e-10.
inline std::vector<Errors> central_errors(const scene::Scene& scene, const Velocities& V, const shape::Derivative& exact) {
  std::vector<Errors> out;
  for (int k = 1; k <= 10; ++k) {
    const double h = std::pow(10, -k);
    const auto above = solved_at(scene, V, h), below = solved_at(scene, V, -h);
    const auto slope = [&](const Vector& a, const Vector& b) -> Vector { return (a - b) / (2 * h); };
    out.push_back({apart(slope(above->result().state.u.here(), below->result().state.u.here()), exact.u),
                   apart(slope(above->result().state.lambda, below->result().state.lambda), exact.lambda)});
  }
  return out;
}

/// Of one-sided differences (−3 u(0) + 4 u(h) − u(2h))/2h for h = 1e-2 … 1e-9.
inline std::vector<Errors> one_sided_errors(const scene::Scene& scene, const Velocities& V, const shape::Derivative& exact) {
  std::vector<Errors> out;
  const auto at = solved_at(scene, V, 0);
  for (int k = 2; k <= 9; ++k) {
    const double h = std::pow(10, -k);
    const auto one = solved_at(scene, V, h), two = solved_at(scene, V, 2 * h);
    const auto slope = [&](const Vector& a, const Vector& b, const Vector& c) -> Vector { return (4 * b - 3 * a - c) / (2 * h); };
    out.push_back({apart(slope(at->result().state.u.here(), one->result().state.u.here(), two->result().state.u.here()), exact.u),
                   apart(slope(at->result().state.lambda, one->result().state.lambda, two->result().state.lambda), exact.lambda)});
  }
  return out;
}

inline Errors least(const std::vector<Errors>& errors) {
  Errors best = errors.front();
  for (const Errors& e : errors) best = {std::min(best.u, e.u), std::min(best.lambda, e.lambda)};
  return best;
}

/// The errors are a V: they fall, are at most `bottom` somewhere, and rise again by rounding, some 1e-15/h and more.
inline void check_bottom(const std::vector<Errors>& errors, double bottom = 1e-8) {
  const Errors best = least(errors);
  CHECK(best.u < bottom);
  CHECK(best.lambda < bottom);
  CHECK(errors.front().u > best.u);
  CHECK(errors.back().u > best.u);
}

/// An adjoint of random objectives is what forward derivatives give.
inline void check_adjoint(const shape::Sensitivity& s, const Velocities& V) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> number(-1, 1);
  const shape::Change change = s.change(V);
  const shape::Derivative d = s.along(change);
  for (int round = 0; round < 3; ++round) {
    Vector du(d.u.size()), dlambda(d.lambda.size());
    for (double& v : du) v = number(engine);
    for (double& v : dlambda) v = number(engine);
    const double forward = du.dot(d.u) + dlambda.dot(d.lambda);
    const double size = du.cwiseAbs().dot(d.u.cwiseAbs()) + dlambda.cwiseAbs().dot(d.lambda.cwiseAbs());
    CHECK(std::abs(s.adjoint(du, dlambda).along(change) - forward) < 1e-10 * size);
  }
}

}  // namespace dotyk::test
