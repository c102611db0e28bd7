#include <nlopt.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <utility>

#include "base/text.hpp"
#include "shape/optimise/scaled_problem.hpp"

namespace dotyk::shape {
namespace {

constexpr double kFar = 1e3;  ///< objective, in scaled terms, by which a design that is not admissible is worse

nlopt_algorithm algorithm(Mma::Method method) {
  switch (method) {
    case Mma::Method::ccsaq: return NLOPT_LD_CCSAQ;
    case Mma::Method::slsqp: return NLOPT_LD_SLSQP;
    default: return NLOPT_LD_MMA;
  }
}

/// Answers NLopt, which asks for objective and constraints apart. It is C: what is thrown waits until it has returned.
class Answers {
 public:
  Answers(ScaledProblem& problem, nlopt_opt optimiser)
      : problem_(problem), optimiser_(optimiser), last_(problem.best()), greatest_(last_.value.objective) {
    settle();
  }

  static double objective(unsigned n, const double* x, double* gradient, void* self) {
    return static_cast<Answers*>(self)->guarded(n, x, [&](const Evaluation& v) {
      if (gradient) Eigen::Map<Vector>(gradient, n) = v.gradient;
      return v.objective;
    });
  }

  static void constraints(unsigned m, double* result, unsigned n, const double* x, double* gradient, void* self) {
    static_cast<Answers*>(self)->guarded(n, x, [&](const Evaluation& v) {
      Eigen::Map<Vector>(result, m) = v.constraints;
      if (gradient) Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(gradient, m, n) = v.jacobian;
      return 0.0;
    });
  }

  Optimum finish(nlopt_result code) {
    if (thrown_) std::rethrow_exception(thrown_);
    if (!problem_.ended() && (code == NLOPT_XTOL_REACHED || code == NLOPT_SUCCESS))
      problem_.end(!stepped_back_ && !refused_, stepped_back_ || refused_ ? "designs farther on are not admissible" : "the design changes by less than tol_design");
    if (!problem_.ended()) problem_.end(false, text("the method ended: ", nlopt_result_to_string(code)));
    return problem_.finish(0);
  }

 private:
  template <class Use>
  double guarded(unsigned n, const double* x, const Use& use) {
    try {
      const Eigen::Map<const Vector> asked(x, n);
      if (!problem_.ended() && asked != last_.x) take(asked);
      return use(last_.value);
    } catch (...) {  // also a script's own error, let go on in finish()
      thrown_ = std::current_exception();
      problem_.end(false, "thrown");
      nlopt_force_stop(optimiser_);
      return use(problem_.best().value);
    }
  }

  void take(const Vector& x) {
    auto design = problem_.evaluate(x);
    const bool better = design && is_better(*design);
    refused_ = refused_ || !design;
    if (better) stepped_back_ = std::exchange(refused_, false);
    if (design) greatest_ = std::max(greatest_, design->value.objective);
    if (!problem_.interrupted()) problem_.judge(better ? &*design : nullptr, 0);
    last_ = design ? std::move(*design) : far(x);
    settle();
  }

  bool is_better(const ScaledDesign& d) const {
    const ScaledDesign& best = problem_.best();
    if (!problem_.feasible(best)) return problem_.feasible(d) || d.violation < best.violation;
    return problem_.feasible(d) && d.value.objective < best.value.objective;
  }

  ScaledDesign far(const Vector& x) const {
    ScaledDesign d = problem_.best();
    d.x = x;
    d.value.objective = greatest_ + kFar;
    d.value.constraints = d.value.constraints.cwiseMax(0.0).array() + 1;
    return d;
  }

  void settle() {
    if (problem_.must_end()) nlopt_force_stop(optimiser_);
  }

  ScaledProblem& problem_;
  nlopt_opt optimiser_;
  ScaledDesign last_;
  double greatest_;
  bool refused_ = false;       ///< a design asked since the best one was not admissible
  bool stepped_back_ = false;  ///< one on the way to the best one was not: its short step is no convergence
  std::exception_ptr thrown_;
};

}  // namespace

Optimum minimise(const DesignProblem& problem, const Vector& start, const Mma& settings, Monitor& monitor) {
  ScaledProblem scaled(problem, start, settings, monitor);
  const auto n = static_cast<unsigned>(scaled.variables()), m = static_cast<unsigned>(scaled.constraints());
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(nlopt_create(algorithm(settings.method), n), nlopt_destroy);
  if (!optimiser) throw std::bad_alloc();
  Answers answers(scaled, optimiser.get());
  if (scaled.ended() || n == 0) return answers.finish(NLOPT_SUCCESS);
  Vector upper = Vector::Zero(n), x = scaled.best().x;
  for (unsigned i = 0; i < n; ++i) upper[i] = scaled.is_free(i) ? 1 : 0;
  const Vector lower = Vector::Zero(n), tolerance = Vector::Constant(m, settings.tol_violation / std::max(m, 1u));
  nlopt_set_lower_bounds(optimiser.get(), lower.data());
  nlopt_set_upper_bounds(optimiser.get(), upper.data());
  nlopt_set_min_objective(optimiser.get(), Answers::objective, &answers);
  if (m > 0) nlopt_add_inequality_mconstraint(optimiser.get(), m, Answers::constraints, &answers, tolerance.data());
  nlopt_set_xtol_abs1(optimiser.get(), settings.tol_design);
  double value = 0;
  return answers.finish(nlopt_optimize(optimiser.get(), x.data(), &value));
}

}  // namespace dotyk::shape
