#include "solver/newton.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;

/// Newton steps from one iterate to the next.
class Stepper {
 public:
  explicit Stepper(RowIteration& iteration) : it_(iteration) {}

  /// Moves to the (λ, α) that solve the problem linearised in `v`; false where that is singular.
  bool solve(const NaturalMap::Value& v) {
    NaturalMap::System system = it_.map.linearise(v);
    Vector solved(0);
    if (system.matrix.size() > 0) {  // else everything is open
      Eigen::PartialPivLU<DenseMatrix> lu(system.matrix);
      if (!(lu.rcond() > 1e-15)) {
        ++regularised_;
        system.matrix.diagonal().array() += 1e-9 * system.matrix.cwiseAbs().maxCoeff();
        lu.compute(system.matrix);
      }
      solved = lu.solve(system.right_side);
      if (!solved.allFinite()) {
        it_.give_up(text("the derivative of iteration ", it_.iterations(), " is singular"));
        return false;
      }
    }
    Vector lambda, alpha;
    it_.map.take(system, solved, lambda, alpha);
    it_.move_to(std::move(lambda), std::move(alpha));
    return true;
  }

  /// Whole steps change many pieces at once and may increase F on the way: they are damped only where F
  /// would exceed all of the last few values.
  bool step() {
    const Vector lambda = it_.lambda(), alpha = it_.alpha();
    norms_.push_back(it_.value().norm);
    if (norms_.size() > kMemory) norms_.erase(norms_.begin());
    const double allowed = 2 * *std::max_element(norms_.begin(), norms_.end());
    if (!solve(NaturalMap::Value(it_.value()))) return false;
    const Vector lambda_step = it_.lambda() - lambda, alpha_step = it_.alpha() - alpha;
    double length = 1;
    for (int halving = 0; halving < kHalvings && it_.value().norm > allowed; ++halving) {
      length /= 2;
      it_.move_to(lambda + length * lambda_step, alpha + length * alpha_step);
    }
    return true;
  }

  int regularised() const { return regularised_; }

 private:
  static constexpr int kHalvings = 10;
  static constexpr std::size_t kMemory = 5;
  RowIteration& it_;
  std::vector<double> norms_;  ///< of F, the last few
  int regularised_ = 0;
};

}  // namespace

void Newton::iterate(RowIteration& iteration) const {
  Stepper stepper(iteration);
  // Everything that touches at rest (or is told to) sticks: one linear problem.
  stepper.solve(iteration.map.sticking(start));
  // On the right pieces a step of given friction in the plane is exact; others converge quadratically.
  while (iteration.next())
    if (!stepper.step() || iteration.record()) break;
  if (stepper.regularised() > 0)
    iteration.remark(text(stepper.regularised(), " singular derivatives were regularised"));
}

}  // namespace dotyk::solver
