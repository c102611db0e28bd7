#include "solver/proximal.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "base/text.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::CondensedProblem;

constexpr int kNewtonSteps = 12;      // of one iteration
constexpr int kHalvings = 10;         // of one step
constexpr double kPrecision = 0.1;    // ‖F‖ against ‖λ − λ_k‖ where an iteration ends
constexpr double kSofter = 100, kHarder = 10;
constexpr double kLeast = 1e-10, kGreatest = 1e6;  // of σ; beyond the latter nothing moves

struct Place {
  Vector lambda, alpha;
};

/// What each row yields to its own force; all rows of a friction point the mean of theirs.
Vector compliance_of_rows(const RowIteration& on) {
  Vector compliance = on.map.rho().cwiseInverse();
  for (const problem::FrictionGroup& group : on.problem.friction)
    for (int k = 0; k < group.points(); ++k) {
      const int n = group.normal[k];
      double sum = n < 0 ? 0 : compliance[n];
      for (int i = 0; i < group.components; ++i) sum += on.condensed.W()(group.row(k) + i, group.row(k) + i);
      const double mean = sum / ((n >= 0) + group.components);
      if (n >= 0) compliance[n] = mean;
      compliance.segment(group.row(k), group.components).setConstant(mean);
    }
  return compliance;
}

/// Newton's method on the problem with springs, from λ_k on.
class Springs {
 public:
  Springs(const RowIteration& on, const Vector& springs)
      : centre_(on.lambda()), softened_(on.condensed.softened(springs, centre_)),
        map_(on.problem, softened_, (on.map.rho().cwiseInverse() + springs).cwiseInverse()),
        place_{on.lambda(), on.alpha()}, value_(map_.at(place_.lambda, place_.alpha)) {}

  /// False where it did not come near a solution.
  bool solve(double tol) {
    for (; steps_ < kNewtonSteps; ++steps_) {
      if (value_.norm <= std::max(kPrecision * (place_.lambda - centre_).norm(), tol * place_.lambda.norm())) return true;
      if (!step()) return false;
    }
    return false;
  }

  Place& place() { return place_; }
  int steps() const { return steps_; }

 private:
  bool step() {
    const NaturalMap::System system = map_.linearise(value_);
    Vector solved(0);
    if (system.matrix.size() > 0) solved = Eigen::PartialPivLU<DenseMatrix>(system.matrix).solve(system.right_side);
    if (!solved.allFinite()) return false;
    Vector lambda, alpha;
    map_.take(system, solved, lambda, alpha);
    const Place from = place_;
    const double norm = value_.norm;
    double length = 1;
    for (int halving = 0; halving <= kHalvings; ++halving, length /= 2) {
      place_ = {from.lambda + length * (lambda - from.lambda), from.alpha + length * (alpha - from.alpha)};
      value_ = map_.at(place_.lambda, place_.alpha);
      if (value_.norm <= (1 - 1e-4 * length) * norm) break;
    }
    return true;  // a short step that increases ‖F‖ a little may lead out of a corner
  }

  const Vector centre_;
  const CondensedProblem softened_;
  const NaturalMap map_;
  Place place_;
  NaturalMap::Value value_;
  int steps_ = 0;
};

}  // namespace

void Proximal::iterate(RowIteration& iteration) const {
  const Vector compliance = compliance_of_rows(iteration);
  double softness = sigma;
  int steps = 0;
  while (iteration.next()) {
    Springs springs(iteration, softness * compliance);
    const bool solved = springs.solve(0.1 * tol);
    steps += springs.steps();
    if (solved) {
      iteration.move_to(std::move(springs.place().lambda), std::move(springs.place().alpha));
      softness = std::max(softness / kHarder, kLeast);
    } else {
      softness *= kSofter;
    }
    if (iteration.record()) break;
    if (softness > kGreatest) {
      iteration.give_up("no springs are soft enough for Newton's method");
      break;
    }
  }
  iteration.remark(text(steps, " Newton steps"));
}

}  // namespace dotyk::solver
