#include "solver/rows/newton_stepper.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/dense/dense.hpp"
#include "algebra/dense/lu.hpp"
#include "base/text.hpp"

namespace dotyk::solver {

using algebra::Lu;
using algebra::Vector;

namespace {

constexpr double kSingularDerivative = 1e-12;  // least singular value of a derivative that is solved with
constexpr double kHoldingSpring = 3e-3;  // δ, against compliances of size 1
constexpr int kFreeSteps = 5;  // damped little
constexpr std::size_t kMemory = 5;  // merits that those are compared with
constexpr int kStepHalvings = 15;
constexpr int kFixedPointSteps = 20;  // the first time; twice as many each further time
constexpr int kDoublings = 6;

}  // namespace

double NewtonStepper::merit() const {
  const NaturalMap::Value& v = it_.value();
  if (!held()) return std::hypot(v.scaled_norm, v.unbalanced.norm());
  return std::hypot(v.scaled_norm, (v.unbalanced - kHoldingSpring * (it_.map.scaled_alpha(it_.alpha()) - anchor_)).norm());
}

bool NewtonStepper::linear_solve(const NaturalMap::Value& v, Place& solution) {
  NaturalMap::System system = it_.map.linearise(v);
  singular_value_ = 1;
  Vector solved(0);
  if (system.matrix.size() > 0) {
    Lu lu(system.matrix);
    double least = singular_value_ = lu.inverse_norm_reciprocal();
    if (watch_) singular_value_ = algebra::smallest_singular_value(system.matrix);
    const Eigen::Index k = it_.alpha().size();
    if (!(least > kSingularDerivative) && !held() && k > 0) {
      anchor_ = it_.map.scaled_alpha(it_.alpha());
      merits_.clear();
    }
    if (held()) {
      ++held_;
      system.matrix.diagonal().tail(k).array() += kHoldingSpring;
      system.right_side.tail(k) += kHoldingSpring * anchor_;
      lu = Lu(system.matrix);
      least = lu.inverse_norm_reciprocal();
    }
    if (!(least > kSingularDerivative)) return false;
    solved = lu.solve(system.right_side);
  }
  it_.map.take(system, solved, solution.lambda, solution.alpha);
  return solution.lambda.allFinite() && solution.alpha.allFinite();
}

void NewtonStepper::start(const NaturalMap::Value& v) {
  Place solution;
  if (linear_solve(v, solution)) it_.move_to(std::move(solution.lambda), std::move(solution.alpha));
  anchor_.resize(0);
  held_ = 0;
}

void NewtonStepper::step() {
  if (held() && merit() < 0.1 * it_.value().unbalanced.norm()) {
    anchor_.resize(0);
    merits_.clear();
  }
  Place solution;
  if (!linear_solve(it_.value(), solution)) {
    ++singular_;
    fixed_point_steps();
  } else if (!damped_step_to(solution)) {
    ++stuck_;
    fixed_point_steps();
  }
}

bool NewtonStepper::damped_step_to(const Place& solution) {
  const bool free = it_.iterations() <= kFreeSteps;
  merits_.push_back(merit());
  if (const std::size_t kept = free ? kMemory : 1; merits_.size() > kept)
    merits_.erase(merits_.begin(), merits_.end() - static_cast<std::ptrdiff_t>(kept));
  const double allowed = (free ? 2 : 1) * *std::max_element(merits_.begin(), merits_.end());
  const Place from{it_.lambda(), it_.alpha()};
  const Vector lambda_step = solution.lambda - from.lambda, alpha_step = solution.alpha - from.alpha;
  double length = 1;
  for (int halving = 0; halving <= kStepHalvings; ++halving, length /= 2) {
    it_.move_to(from.lambda + length * lambda_step, from.alpha + length * alpha_step);
    if (merit() <= (1 - 1e-4 * length) * allowed) return true;
  }
  return merit() == 0;
}

void NewtonStepper::fixed_point_steps() {
  const int steps = kFixedPointSteps << std::min(singular_ + stuck_ - 1, kDoublings);
  const double theta = 1 / std::max(1.0, it_.map.greatest_compliance());
  const Vector a = it_.map.scaled_alpha(it_.alpha());
  Vector lambda = it_.lambda();
  for (int k = 0; k < steps; ++k)
    lambda += theta * (it_.map.at(lambda, it_.map.alpha(a + it_.map.unbalanced(lambda))).projected - lambda);
  if (!lambda.allFinite()) return;
  it_.move_to(lambda, it_.map.alpha(a + it_.map.unbalanced(lambda)));
  anchor_.resize(0);
  merits_.clear();
}

std::vector<std::string> NewtonStepper::remarks() const {
  std::vector<std::string> all;
  const auto say = [&](int count, const char* what) {
    if (count > 0) all.push_back(text(count, count == 1 ? " step " : " steps ", what));
  };
  say(held_, "held the bodies by springs, where slip or gaps left them free and the derivative singular");
  say(singular_, "of the fixed point iteration instead of a singular derivative");
  say(stuck_, "of the fixed point iteration where no Newton step came nearer");
  return all;
}

}  // namespace dotyk::solver
