#include "solver/active/interior_start.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/dense/generalised_inverse.hpp"
#include "program/barrier.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::Problem;
using program::Side;

namespace {

constexpr int kMostInteriorSteps = 40;
constexpr double kBalancedResidual = 1e-6;  ///< enough of residuals, of which rounding leaves more than of the gap μ
constexpr double kUndecidedRow = 1e-12;  ///< of the gap asked for: rows that are undecided there touch without force
constexpr double kNever = 1e6;  ///< so many displacements away a row never closes
constexpr double kRigid = 1e-10;  ///< D of rigid rows, of the compliance that the body has there

/// Every row's law, and what counts as a force and as a displacement.
struct LawsInUnits {
  LawsInUnits(const Problem& problem, HeldStiffness& stiffness);

  Vector f, low, high;
  Vector below, above;  ///< 1/k where λ < 0 and where λ > 0
  double force = 0, length = 0;  ///< scales of a row's multiplier and of displacements; 0: neither loaded nor pressed

 private:
  void measure(const Problem& problem, HeldStiffness& stiffness);
};

LawsInUnits::LawsInUnits(const Problem& problem, HeldStiffness& stiffness) : f(problem.load()) {
  low = high = below = above = Vector::Zero(problem.rows());
  const auto compliance = [](double stiffness) { return stiffness > 0 ? 1 / stiffness : 0; };
  for (const auto& [law, k, r] : problem.scalar_rows()) {
    const problem::Interval bounds = law.multipliers(k);
    const problem::Springs springs = law.springs(k).value();
    low[r] = bounds.low, high[r] = bounds.high;
    below[r] = compliance(springs.below), above[r] = compliance(springs.above);
  }
  measure(problem, stiffness);
}

/// Of the body as it bends where as few unknowns hold it as can: under its load, and under a force on each row that would move it by what rows are off.
void LawsInUnits::measure(const Problem& problem, HeldStiffness& stiffness) {
  const int rows = problem.rows();
  std::vector<char> held(problem.unknowns(), 0);
  for (const int unknown : stiffness.fixing_noticed()) held[unknown] = 1;
  if (rows == 0 || !stiffness.factor(Vector::Zero(rows), held)) return;
  const auto moved = [&](const Vector& forces) { return (problem.B * stiffness.solve(forces)).lpNorm<Eigen::Infinity>(); };
  const double bent = moved(f), compliance = moved(problem.B.transpose() * Vector::Ones(rows));
  const double pressed = std::max(0.0, -problem.c.minCoeff());
  length = std::max(bent, pressed);
  for (int r = 0; r < rows; ++r) {
    if (problem.c[r] < kNever * length) length = std::max(length, problem.c[r]);
    else if (std::isfinite(low[r])) high[r] = low[r];
  }
  force = std::max(f.lpNorm<1>() / rows, compliance > 0 ? pressed / compliance : 0);
}

/// w is λ, x is u, y = z⁺ − z⁻.
class InteriorBarrier final : public program::Barrier {
 public:
  InteriorBarrier(const Problem& problem, const LawsInUnits& laws, HeldStiffness& stiffness)
      : Barrier(laws.low, laws.high), problem_(problem), laws_(laws), stiffness_(stiffness), own_(problem.row_stiffness()) {
    at_.x = Vector::Zero(problem.unknowns());
    place(Vector::Zero(rows()).cwiseMax(low_).cwiseMin(high_), laws.force, laws.force * laws.length);
  }

  void evaluate() override {
    Barrier::evaluate();
    equilibrium_ = laws_.f - problem::stiffness_times(problem_, at_.x) - problem_.B.transpose() * at_.w;
    compatibility_ = problem_.c + at_.y - problem_.B * at_.x;
    for (int r = 0; r < rows(); ++r) compatibility_[r] = fixed(r) ? 0 : compatibility_[r] + compliance(r) * at_.w[r];
  }

  bool done(double tol) const {
    const double left = gap() / (laws_.force * laws_.length);
    const double off = std::max(equilibrium_.lpNorm<1>() / (laws_.force * rows()), compatibility_.lpNorm<Eigen::Infinity>() / laws_.length);
    return left <= tol && (off <= kBalancedResidual || left <= kBalancedResidual * tol) && (decided() || left <= kUndecidedRow * tol);
  }

  /// Onto the laws: of λ − low and z⁻ (likewise above) the one that fell by more in the last step goes to zero.
  void round(InteriorPointState& out) const {
    out.lambda = at_.w;
    out.x = Vector::Zero(rows());
    const std::vector<End> all = ends();
    for (int r = 0; r < rows(); ++r) {
      if (all[r].side != Side::free) out.lambda[r] = all[r].side == Side::low ? low_[r] : high_[r];
      out.x[r] = compliance(r) * out.lambda[r] + all[r].y;
    }
  }

 private:
  bool fixed(int r) const { return low_[r] >= high_[r]; }
  double compliance(int r) const { return at_.w[r] < 0 ? laws_.below[r] : laws_.above[r]; }

  /// D = 1/k + θ
  bool factor(const Vector& theta) override {
    spring_ = Vector::Zero(rows());
    for (int r = 0; r < rows(); ++r)
      if (!fixed(r)) spring_[r] = 1 / std::max(compliance(r) + theta[r], own_[r] > 0 ? kRigid / own_[r] : 1e-300);
    return stiffness_.factor(spring_, std::vector<char>(problem_.unknowns(), 0));
  }

  void solve(const Vector& kappa, Point& d) override {
    const Vector q = compatibility_ + kappa;
    d.x = stiffness_.solve(equilibrium_ + problem_.B.transpose() * spring_.cwiseProduct(q));
    d.w = spring_.cwiseProduct(problem_.B * d.x - q);
  }

  const Problem& problem_;
  const LawsInUnits& laws_;
  HeldStiffness& stiffness_;
  const Vector own_;
  Vector equilibrium_, compatibility_, spring_;  ///< spring_: D⁻¹
};

}  // namespace

InteriorPointState interior_start(const Problem& problem, HeldStiffness& stiffness, double tol, Monitor& monitor) {
  InteriorPointState out;
  const LawsInUnits laws(problem, stiffness);
  if (!(laws.force > 0 && laws.length > 0)) return out;
  InteriorBarrier barrier(problem, laws, stiffness);
  for (barrier.evaluate(); out.iterations < kMostInteriorSteps && !barrier.done(tol) && !monitor.stop() && barrier.step(); barrier.evaluate()) ++out.iterations;
  barrier.round(out);
  return out;
}

}  // namespace dotyk::solver
