#include "solver/rows/proximal.hpp"

#include "problem/uniqueness.hpp"
#include "solver/rows/projection.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::CondensedProblem;

constexpr int kNewtonSteps = 12;  // of one iteration
constexpr int kInnerHalvings = 10;  // of one step
constexpr double kEndPrecision = 0.1;  // ‖F‖ against ‖λ − λ_k‖ where an iteration ends
constexpr double kSofter = 100, kHarder = 10;
constexpr double kLeastSigma = 1e-10, kGreatestSigma = 1e6;  // of σ; beyond the latter nothing moves
constexpr double kLeastConvex = 1e-8;  // where ρ = 1/σC: less, and rounding of x counts
constexpr double kNoisyStep = 100;  // noise against what is left: beyond, springs are not made stiffer
constexpr double kSlow = 0.5;  // fall of the residual in an iteration
constexpr int kConvexSteps = 40;  // of one iteration, where they cannot go astray
constexpr int kSections = 30;  // of one such step
constexpr double kFlat = 1e-3;  // a slope against the first one
/// Springs that hold free bodies, against C: at first such a part of σ at this σ, and proportional to σ below it. They become softer from iteration to
/// iteration whatever rounding leaves of x, which is nothing to them: a motion that next to nothing resists would take steps without end.
constexpr double kSigma = 0.1, kHolding = 3e-3, kLeastHolding = 1e-16;

/// What each row yields to its own force; all rows of a friction point the mean of theirs.
Vector compliance_of_rows(const RowIteration& on) {
  Vector compliance = on.map.rho().cwiseInverse();
  const auto points = on.problem.friction_points();
  for (const auto& [group, k, first, n] : points) {
    double sum = n < 0 ? 0 : compliance[n];
    for (int i = first; i < first + group.components; ++i) sum += on.condensed.W()(i, i);
    const double mean = sum / ((n >= 0) + group.components);
    if (n >= 0) compliance[n] = mean;
    compliance.segment(first, group.components).setConstant(mean);
  }
  for (const auto& [group, k, first, n] : points)  // cells of friction may share a normal row
    compliance.segment(first, group.components).setConstant(compliance[group.scale_row(k)]);
  return compliance;
}

/// Of the forces that count: the rounding of x at a place, of which springs make the more the stiffer they are.
double noise(const RowIteration& on, const Iterate& place, const Vector& springs) {
  return on.rounding(place).cwiseQuotient(springs).cwiseQuotient(on.forces()).norm();
}

/// Newton's method on the problem with springs, from (λ_k, α_k) on.
class SpringProblem {
 public:
  /// `convex`: the bounds of friction are given.
  SpringProblem(const RowIteration& on, const Vector& springs, double holding, double tol, bool convex)
      : on_(on), convex_(convex), centre_(on.lambda()), W_(on.condensed.W()), softened_(on.rows().softened(springs, centre_)),
        map_(on.problem, softened_, convex ? Vector(springs.cwiseInverse()) : Vector((on.map.rho().cwiseInverse() + springs).cwiseInverse())),
        anchor_(map_.scaled_alpha(on.alpha())), holding_(holding),
        forces_(on.forces()), place_(on.at()), value_(map_.at(place_)), enough_(tol) {}

  /// False where it did not come near a solution. One step is always made: the first error may be rounding, and λ yet to move.
  bool solve() {
    double before = INFINITY;
    for (const int most = convex_ ? kConvexSteps : kNewtonSteps; steps_ < most;) {
      if (!step()) return false;
      ++steps_;
      const double left = error();
      rounded_ = left > 0.5 * before && left <= noise(on_, place_, map_.rho().cwiseInverse());
      if (rounded_ || left <= std::max(kEndPrecision * moved(), enough_)) return true;
      before = left;
    }
    return false;
  }

  /// Did the rounding of x end it?
  bool rounded() const { return rounded_; }
  const Iterate& place() const { return place_; }
  int steps() const { return steps_; }

 private:
  bool step() {
    NaturalMap::System system = map_.linearise(value_);
    system.hold(holding_, anchor_);
    const Iterate to = map_.solve(system), from = place_, way = to - from;
    if (!to.finite()) return false;
    if (convex_) descend(from, way);
    else damp(from, way);
    return true;  // a short step that increases ‖F‖ a little may lead out of a corner
  }

  /// a − a_k.
  Vector motion() const { return map_.scaled_alpha(place_.alpha) - anchor_; }

  /// Of the problem with springs, against the forces that count: F, and of the equation Qᵀv + δ(a − a_k) = ê the forces that would make it
  /// hold.
  double error() const { return sum(place_.lambda - value_.projected, value_.unbalanced - holding_ * motion()); }
  /// How far from (λ_k, α_k), against the forces that count.
  double moved() const { return sum(place_.lambda - centre_, holding_ * motion()); }
  double sum(const Vector& force, const Vector& unbalanced) const {
    return std::hypot(force.cwiseQuotient(forces_).norm(), map_.balancing(unbalanced).cwiseQuotient(forces_).norm());
  }

  void move(const Iterate& from, const Iterate& way, double length) {
    place_ = from + length * way;
    value_ = map_.at(place_);
  }

  void damp(const Iterate& from, const Iterate& way) {
    const double norm = error();
    double length = 1;
    for (int halving = 0; halving <= kInnerHalvings; ++halving, length /= 2) {
      move(from, way, length);
      if (error() <= (1 - 1e-4 * length) * norm) break;
    }
  }

  /// The derivative of the energy along the way, at the place where we are.
  double slope(const Iterate& way) const {
    const double along = way.lambda.dot(W_ * (place_.lambda - value_.projected));
    if (anchor_.size() == 0) return along;
    return along + map_.scaled_alpha(way.alpha).dot(holding_ * motion() - map_.unbalanced(value_.projected));
  }

  /// To where the energy, convex along the way, still falls, but by less than half as steeply as at first; the whole way where it falls all along.
  void descend(const Iterate& from, const Iterate& way) {
    const double steepest = slope(way);
    const double norm = error();
    double low = 0, high = 1, at_low = steepest;
    move(from, way, 1);
    double at_high = slope(way);
    if (!(steepest < 0) || at_high <= -kFlat * steepest || error() <= std::max(kFlat * norm, enough_)) return;
    for (int k = 0; k < kSections && at_low < 0.5 * steepest; ++k) {
      const double secant = low - at_low * (high - low) / (at_high - at_low), margin = 0.05 * (high - low);
      const double length = std::clamp(secant, low + margin, high - margin);
      move(from, way, length);
      if (const double here = slope(way); here <= 0) low = length, at_low = here;
      else high = length, at_high = here;
    }
    move(from, way, low > 0 ? low : high);
  }

  const RowIteration& on_;
  const bool convex_;
  const Vector centre_;
  const DenseMatrix& W_;
  const CondensedProblem softened_;
  const NaturalMap map_;
  const Vector anchor_;
  const double holding_;  ///< δ
  const Vector forces_;   ///< that count, by row
  Iterate place_;
  NaturalMap::Value value_;
  const double enough_;   ///< of tol
  int steps_ = 0;
  bool rounded_ = false;
};

/// One Newton step without springs, kept only if the residual falls, and rounding is not as much: a free body may be anywhere. Springs make slow progress along a motion that almost nothing resists;
/// once the pieces of the laws are right, this step is exact.
void let_go(RowIteration& iteration) {
  const Iterate from = iteration.at();
  const double before = iteration.residual();
  const NaturalMap::System system = iteration.map.linearise(iteration.value());
  if (system.matrix.size() == 0) return;
  Iterate to = iteration.map.solve(system);
  if (!to.finite()) return;
  iteration.move_to(std::move(to));
  if (!(iteration.residual() + noise(iteration, iteration.at(), iteration.map.rho().cwiseInverse()) < before)) iteration.move_to(from);
}

}  // namespace

void Proximal::iterate(RowIteration& iteration) const {
  const Vector compliance = compliance_of_rows(iteration);
  const bool convex = !problem::has_coulomb(iteration.problem);
  double softness = sigma, holding = std::min(kHolding, kHolding * sigma / kSigma), before = INFINITY;
  int steps = 0;
  while (iteration.next()) {
    SpringProblem springs(iteration, softness * compliance, std::max(softness * holding, kLeastHolding), 0.1 * tol, convex);
    const bool solved = springs.solve();
    steps += springs.steps();
    if (solved) {
      iteration.move_to(springs.place());
      if (iteration.residual() > kSlow * before) let_go(iteration);
      before = iteration.residual();
      const double harder = std::max(softness / kHarder, convex ? kLeastConvex : kLeastSigma);
      if (springs.rounded()) softness = std::min(kSofter * softness, std::max(softness, sigma));  // of which rounding makes less
      else if (noise(iteration, iteration.at(), harder * compliance) <= kNoisyStep * iteration.residual()) softness = harder;
      holding /= kHarder;
    } else {
      softness *= kSofter;
      holding = std::min(kSofter * holding, kHolding);
    }
    if (iteration.record()) break;
    if (softness > kGreatestSigma) {
      iteration.give_up("no springs are soft enough for Newton's method");
      break;
    }
  }
  iteration.remark(text(steps, " Newton steps"));
}

}  // namespace dotyk::solver
