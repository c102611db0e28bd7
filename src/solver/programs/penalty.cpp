#include "solver/programs/penalty.hpp"

#include "algebra/dense/generalised_inverse.hpp"
#include "problem/measure.hpp"
#include "problem/residual.hpp"
#include "solver/active/pdas.hpp"
#include "solver/core/treatable.hpp"

namespace dotyk::solver {
namespace {

using algebra::SparseMatrix;
using algebra::Vector;
using problem::Law;
using problem::Problem;
using problem::RowGroup;

/// Of the springs in series with the rows.
Vector spring_stiffness(const Problem& problem, double factor) {
  return factor * problem::Measure(problem).stiffness();
}

/// Is the law a spring itself? It then gets no other.
bool is_spring(const RowGroup& group) {
  const auto k = group.count > 0 ? group.law->linear_stiffness(0) : 0;
  return k && std::isfinite(*k);
}

/// The problem with the laws' Moreau envelopes, φ_p(x) = min over y of φ(y) + ½p(x − y)², of which φ_p* = φ* + λ²/2p.
Problem softened(const Problem& problem, const Vector& p) {
  Problem out = problem;
  for (RowGroup& group : out.groups) {
    if (is_spring(group)) continue;
    std::vector<problem::Limits> springs;
    for (int r = group.first; r < group.first + group.count; ++r)
      springs.push_back({p[r], group.law->unilateral() ? 0 : -Law::kUnbounded, Law::kUnbounded});
    group.law = problem::limited(group.law->name(), std::move(springs));
  }
  return out;
}

/// Of laws that are springs, the classical way, in u alone:
///   (K + Σ_A k_r B_rᵀB_r) u = f + Σ_A k_r c_r B_rᵀ,   λ_A = k (Bu − c)_A,
/// A the active rows; one sparse Cholesky factorisation each time.
class SpringStep final : public Step {
 public:
  SpringStep(const Problem& problem, const problem::RigidMotions& rigid, algebra::Ordering ordering)
      : problem_(problem), k_(problem.rows()), unnoticed_(problem::unnoticed_displacements(problem, rigid)), f_(problem.load()),
        cholesky_(matrix(Vector::Ones(problem.rows())), problem::nodes(problem), {}, ordering) {
    for (const RowGroup& group : problem.groups)
      for (int r = group.first; r < group.first + group.count; ++r) k_[r] = group.law->springs(r - group.first).value().above;
  }

  bool solve(const Linearisation& l, Vector& lambda, Vector& x) override {
    Vector k = k_;
    for (int r = 0; r < problem_.rows(); ++r)
      if (!l.active[r]) k[r] = 0;
    if (!cholesky_.factor(matrix(k))) return false;
    u_ = cholesky_.solve(f_ + problem_.B.transpose() * k.cwiseProduct(problem_.c));
    if (!u_.allFinite()) return false;
    u_ = problem::least(unnoticed_, std::move(u_));
    x = problem_.B * u_ - problem_.c;
    lambda = k.cwiseProduct(x);
    return true;
  }

  problem::Displacement recover() override { return u_; }

 private:
  SparseMatrix matrix(const Vector& k) const {
    const SparseMatrix springs = problem_.B.transpose() * SparseMatrix(k.asDiagonal() * problem_.B);
    SparseMatrix lower = problem::lower_stiffness(problem_) + SparseMatrix(springs.triangularView<Eigen::Lower>());
    // Motions that no row notices are held at as many unknowns: that carries nothing.
    for (int unknown : algebra::fixing_unknowns(unnoticed_)) lower.coeffRef(unknown, unknown) *= 2;
    return lower;
  }

  const Problem& problem_;
  Vector k_;
  const SparseMatrix unnoticed_;
  Vector f_;
  algebra::Cholesky cholesky_;
  Vector u_;
};

PenaltyError error_of(const Problem& problem, const problem::State& state, double factor) {
  PenaltyError error{factor, 0, 0};
  const Vector x = problem::jumps(problem, state.u);
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; !is_spring(group) && r < group.first + group.count; ++r) {
      error.penetration = std::max(error.penetration, group.law->unilateral() ? x[r] : std::abs(x[r]));
      error.energy += state.lambda[r] * x[r];
    }
  return error;
}

}  // namespace

Result solve(const Problem& problem, const Penalty& settings, Monitor& monitor) {
  require_unilateral_or_linear(problem, "penalty");
  Pdas pdas;
  static_cast<Settings&>(pdas) = settings;
  pdas.reduced = settings.reduced;
  pdas.start = first_active(problem, settings.start);
  if (!settings.reduced)
    pdas.step = [&](const Problem& soft, const problem::RigidMotions& rigid, const Vector&) -> std::unique_ptr<Step> {
      return std::make_unique<SpringStep>(soft, rigid, settings.ordering);
    };
  Result result = solve(softened(problem, spring_stiffness(problem, settings.factor)), pdas, monitor);
  result.method = "penalty";
  result.penalty = error_of(problem, result.state, settings.factor);
  const double energy = std::abs(problem::energy(problem, result.state));
  result.reason += text("; of the problem with springs in place of contact: penetration up to ",
                        result.penalty->penetration, ", energy too low by ", result.penalty->energy,
                        energy > 0 ? text(" (", 100 * result.penalty->energy / energy, " %)") : "");
  return result;
}

}  // namespace dotyk::solver
