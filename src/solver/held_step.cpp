#include <cmath>
#include <utility>

#include "solver/held_stiffness.hpp"
#include "solver/step.hpp"

namespace dotyk::solver {
namespace {

using algebra::SparseRows;
using algebra::Vector;
using problem::Problem;

/// Spring of a rigid row that holds no unknown, in units of the stiffness that it sees: most of its force then comes with the first solution, while rounding
/// of displacements, times the spring, stays small in it.
constexpr double kSpring = 100;
constexpr int kMostSteps = 60, kMostRounds = 3;
/// How far tied rows may be off, of the displacements that make them up, and what the steps of a round aim at.
constexpr double kOff = 1e-12, kAim = 1e-15;

class HeldStep final : public Step {
 public:
  HeldStep(const Problem& problem, HeldStiffness& stiffness, const Vector& rho) : problem_(problem), stiffness_(stiffness), rho_(rho), own_(problem.row_stiffness()), f_(problem.unknowns()), u_(Vector::Zero(problem.unknowns())) {
    for (const problem::Block& block : problem.blocks) f_.segment(block.first, block.size()) = block.f;
  }

  bool solve(const Linearisation& l, Vector& lambda, Vector& x) override {
    sort(l);
    if (!stiffness_.factor(spring_, held_)) return false;
    lambda_ = constant_;
    u_ += stiffness_.solve(residual());
    if (!u_.allFinite() || !tie()) return false;
    finish();
    if (!lambda_.allFinite()) return false;
    lambda = lambda_;
    x = problem_.B * u_ - problem_.c;
    return true;
  }

  Vector recover() override { return u_; }

 private:
  /// What each row does, and u where it is held.
  void sort(const Linearisation& l) {
    constant_ = spring_ = target_ = Vector::Zero(problem_.rows());
    held_.assign(problem_.unknowns(), 0);
    u_ = Vector::Zero(problem_.unknowns());
    holding_.clear(), tied_.clear();
    for (int r = 0; r < problem_.rows(); ++r) {
      if (!l.active[r]) {
        constant_[r] = l.value[r];
        continue;
      }
      target_[r] = problem_.c[r] + l.offset(r, rho_[r]);
      const double compliance = l.added_compliance(r, rho_[r]);
      if (compliance > 0) {
        spring_[r] = 1 / compliance;
        continue;
      }
      const SparseRows::InnerIterator only = sole(r);
      if (only && !held_[only.col()]) {
        held_[only.col()] = 1;
        u_[only.col()] = target_[r] / only.value();
        holding_.push_back({r, static_cast<int>(only.col()), only.value()});
      } else {
        tied_.push_back(r);
        spring_[r] = kSpring * own_[r];
      }
    }
  }

  /// The one entry of a row, else nothing.
  SparseRows::InnerIterator sole(int row) const {
    SparseRows::InnerIterator entry;
    for (SparseRows::InnerIterator it(problem_.B, row); it; ++it) {
      if (it.value() == 0) continue;
      if (entry) return {};
      entry = it;
    }
    return entry;
  }

  /// f − Ku − Bᵀλ with the springs' multipliers as they are, zero where u is held.
  Vector residual() { return without_held(forces()); }

  Vector forces() {
    return f_ - problem::stiffness_times(problem_, u_) - problem_.B.transpose() * (lambda_ + spring_.cwiseProduct(problem_.B * u_ - target_));
  }

  Vector without_held(Vector r) const {
    for (const Holding& h : holding_) r[h.unknown] = 0;
    return r;
  }

  /// λ of tied rows so that Bu = t there. False where they contradict each other.
  bool tie() {
    for (int round = 0; round < kMostRounds && off(tied_gap()) > kAim && u_.allFinite(); ++round) {
      approach();
      u_ += stiffness_.solve(residual());
    }
    return off(tied_gap()) <= kOff;
  }

  /// Conjugate gradients on B(K + sBᵀB)⁻¹Bᵀ δλ = Bu − t, preconditioned by s, which makes the first step one of the method of multipliers.
  void approach() {
    Vector gap = tied_gap(), z = spring_.cwiseProduct(gap), p = z;
    double energy = gap.dot(z);
    for (int k = 0; k < kMostSteps && off(gap) > kAim; ++k) {
      const Vector moved = stiffness_.solve(without_held(problem_.B.transpose() * p));
      const Vector q = on_tied(problem_.B * moved);
      const double curvature = p.dot(q);
      if (!(curvature > 0)) return;
      const double t = energy / curvature;
      lambda_ += t * p, u_ -= t * moved, gap -= t * q;
      z = spring_.cwiseProduct(gap);
      const double before = std::exchange(energy, gap.dot(z));
      p = z + energy / before * p;
    }
  }

  Vector tied_gap() const { return on_tied(problem_.B * u_ - target_); }

  Vector on_tied(const Vector& all) const {
    Vector out = Vector::Zero(problem_.rows());
    for (const int r : tied_) out[r] = all[r];
    return out;
  }

  /// The greatest gap of a tied row against the displacements in it.
  double off(const Vector& gap) const {
    if (!gap.allFinite()) return INFINITY;
    const double size = tied_.empty() ? 0 : u_.lpNorm<Eigen::Infinity>();
    double worst = 0;
    for (const int r : tied_)
      if (gap[r] != 0) worst = std::max(worst, std::abs(gap[r]) / (length(r) * size + std::abs(target_[r])));
    return worst;
  }

  double length(int row) const {
    double sum = 0;
    for (SparseRows::InnerIterator it(problem_.B, row); it; ++it) sum += std::abs(it.value());
    return sum;
  }

  /// Multipliers of springs, of rows that hold by equilibrium.
  void finish() {
    lambda_ += spring_.cwiseProduct(problem_.B * u_ - target_);
    spring_.setZero();
    const Vector left = forces();
    for (const Holding& h : holding_) lambda_[h.row] = left[h.unknown] / h.factor;
  }

  struct Holding {
    int row, unknown;
    double factor;
  };

  const Problem& problem_;
  HeldStiffness& stiffness_;
  const Vector& rho_;
  const Vector own_;
  Vector f_;
  Vector constant_, spring_, target_;  ///< rows: λ of those that are not active; s and t of λ = s(Bu − t), and Bu of rigid ones
  std::vector<char> held_;
  std::vector<Holding> holding_;
  std::vector<int> tied_;              ///< rigid rows that hold no unknown
  Vector u_, lambda_;
};

}  // namespace

std::unique_ptr<Step> held_step(const Problem& problem, HeldStiffness& stiffness, const Vector& rho) {
  return std::make_unique<HeldStep>(problem, stiffness, rho);
}

}  // namespace dotyk::solver
