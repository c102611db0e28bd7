#include "solver/active/interior_start.hpp"

#include "problem/measure.hpp"
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

/// Every row's law.
struct RowLaws {
  Vector low, high;
  Vector below, above;  ///< 1/k where λ < 0 and where λ > 0
};

RowLaws row_laws(const Problem& problem) {
  const Vector none = Vector::Zero(problem.rows());
  RowLaws all{none, none, none, none};
  const auto compliance = [](double stiffness) { return stiffness > 0 ? 1 / stiffness : 0; };
  for (const auto& [law, k, r] : problem.scalar_rows()) {
    const problem::Interval bounds = law.multipliers(k);
    const problem::Springs springs = law.springs(k).value();
    all.low[r] = bounds.low, all.high[r] = bounds.high;
    all.below[r] = compliance(springs.below), all.above[r] = compliance(springs.above);
  }
  return all;
}

/// u under the load where as few unknowns hold the bodies as can; empty where that cannot be factored.
Vector bent(const Problem& problem, HeldStiffness& stiffness) {
  std::vector<char> held(problem.unknowns(), 0);
  for (const int unknown : stiffness.fixing_noticed()) held[unknown] = 1;
  return stiffness.factor(Vector::Zero(problem.rows()), held) ? stiffness.solve(problem.load()) : Vector();
}

/// What counts as a row's force in any part at rest, and as a displacement of bodies bent by their load. Rows out of reach of that never close.
std::pair<double, double> force_and_length(const Problem& problem, const problem::Measure& rest, const Vector& bent, RowLaws& laws) {
  const problem::Measure moved(problem, problem::State{bent, Vector::Zero(problem.rows())});
  double force = 0, length = 0;
  for (int p = 0; p < rest.parts().count; ++p) force = std::max(force, rest.force(p)), length = std::max(length, moved.length(p));
  force /= std::sqrt(problem.rows());
  const double reach = kNever * length;
  for (int r = 0; r < problem.rows(); ++r)
    if (problem.c[r] < reach) length = std::max(length, problem.c[r]);
    else if (std::isfinite(laws.low[r])) laws.high[r] = laws.low[r];
  return {force, length};
}

/// w is λ, x is u, y = z⁺ − z⁻.
class InteriorBarrier final : public program::Barrier {
 public:
  InteriorBarrier(const Problem& problem, const RowLaws& laws, const problem::Measure& rest, std::pair<double, double> scale, HeldStiffness& stiffness)
      : Barrier(laws.low, laws.high), problem_(problem), laws_(laws), force_(scale.first), length_(scale.second), stiffness_(stiffness), f_(problem.load()), own_(rest.stiffness()) {
    at_.x = Vector::Zero(problem.unknowns());
    place(Vector::Zero(rows()).cwiseMax(low_).cwiseMin(high_), force_, force_ * length_);
  }

  void evaluate() override {
    Barrier::evaluate();
    equilibrium_ = f_ - problem::stiffness_times(problem_, at_.x) - problem_.B.transpose() * at_.w;
    compatibility_ = problem_.c + at_.y - problem_.B * at_.x;
    for (int r = 0; r < rows(); ++r) compatibility_[r] = fixed(r) ? 0 : compatibility_[r] + compliance(r) * at_.w[r];
  }

  bool done(double tol) const {
    const double left = gap() / (force_ * length_);
    const double off = std::max(equilibrium_.lpNorm<1>() / (force_ * rows()), compatibility_.lpNorm<Eigen::Infinity>() / length_);
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
      if (!fixed(r)) spring_[r] = 1 / std::max(compliance(r) + theta[r], kRigid / own_[r]);
    return stiffness_.factor(spring_, std::vector<char>(problem_.unknowns(), 0));
  }

  void solve(const Vector& kappa, Point& d) override {
    const Vector q = compatibility_ + kappa;
    d.x = stiffness_.solve(equilibrium_ + problem_.B.transpose() * spring_.cwiseProduct(q));
    d.w = spring_.cwiseProduct(problem_.B * d.x - q);
  }

  const Problem& problem_;
  const RowLaws& laws_;
  const double force_, length_;
  HeldStiffness& stiffness_;
  const Vector f_;
  const Vector& own_;
  Vector equilibrium_, compatibility_, spring_;  ///< spring_: D⁻¹
};

}  // namespace

InteriorPointState interior_start(const Problem& problem, HeldStiffness& stiffness, double tol, Monitor& monitor) {
  InteriorPointState out;
  const Vector u = problem.rows() > 0 ? bent(problem, stiffness) : Vector();
  if (u.size() == 0) return out;
  RowLaws laws = row_laws(problem);
  const problem::Measure rest(problem);
  InteriorBarrier barrier(problem, laws, rest, force_and_length(problem, rest, u, laws), stiffness);
  for (barrier.evaluate(); out.iterations < kMostInteriorSteps && !barrier.done(tol) && !monitor.stop() && barrier.step(); barrier.evaluate()) ++out.iterations;
  barrier.round(out);
  return out;
}

}  // namespace dotyk::solver
