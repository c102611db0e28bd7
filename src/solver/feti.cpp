#include "solver/feti.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "problem/rigid_motions.hpp"
#include "solver/coarse_space.hpp"
#include "solver/dual_bounds.hpp"
#include "solver/dual_problem.hpp"
#include "solver/dual_spectrum.hpp"
#include "solver/feti_preconditioner.hpp"
#include "solver/projection.hpp"
#include "solver/require_solvable.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;
using problem::FrictionGroup;
using problem::Problem;
using problem::RowGroup;
using End = SmalbeResult::End;
using Place = SeparableSet::Place;

/// Coulomb's loop solves with given friction to this part of the bounds' last change.
constexpr double kAhead = 0.1;
/// First precision there.
constexpr double kFirst = 0.01;
/// Steps of the loop in which the bounds' change must fall by a tenth; else the bounds go half as far as they would,
/// down to the least step.
constexpr int kPatience = 8;
constexpr double kLeastStep = 1.0 / 32;
/// With more rigid motions than that the existence of a solution is left to the iteration itself, which proves that
/// there is none where it meets that: the linear program that would tell takes longer.
constexpr int kManyMotions = 200;
/// Resultants that no multipliers balance, relative to all: above rounding in long sums.
constexpr double kImbalance = 1e-9;
/// The equilibrium of the displacements recovered may be worse than tol by what stiffnesses and sizes make of the copies'
/// disagreement; beyond this it is no solution.
constexpr double kSpoilt = 1e4;

class Run {
 public:
  Run(const Problem& problem, const Feti& method, Monitor& monitor)
      : problem_(problem), method_(method), monitor_(monitor),
        dual_(problem, method.ordering, result_.clock, monitor), coarse_(dual_.G(), dual_.e()),
        preconditioner_(dual_, coarse_, method, monitor),
        compliance_(row_compliance(problem, dual_.scale(), dual_.rows(), "feti")) {
    if (coarse_.imbalance() > kImbalance)
      throw InputError(text("the load does work on a rigid motion that nothing holds: no contact forces balance it, ", coarse_.imbalance(),
                            " of its resultants is left; scene:balance() and scene:plan() tell which body moves and how"));
    for (const problem::Block& block : problem.blocks) force_ = std::hypot(force_, block.f.norm());
  }

  Result operator()() {
    Stopwatch watch;
    homogenise();
    iterate();
    result_.clock.iterate += watch.lap();
    recover();
    result_.clock.recover += watch.lap();
    report();
    return std::move(result_);
  }

 private:
  /// (F + compliance) v.
  Vector apply(const Vector& v) const { return dual_.apply(v) + compliance_.cwiseProduct(v); }
  /// PFPv of v with Qv = 0.
  Vector PFP(const Vector& v) const { return coarse_.P(apply(v)); }

  void homogenise() {
    shift_ = coarse_.particular();
    program_.H = [this](const Vector& v) { return PFP(v); };
    program_.Q = [this](const Vector& v) { return coarse_.Q(v); };
    program_.complementary = true;
    program_.b = coarse_.P(dual_.d() - apply(shift_));
    const auto ends = dual_spectrum(dual_, coarse_, method_.spectrum ? algebra::Ends::both : algebra::Ends::greatest, monitor_);
    const double stiffest = compliance_.size() ? compliance_.maxCoeff() : 0;
    counts_.norm = program_.norm = ends.bound() + stiffest > 0 ? ends.bound() + stiffest : 1;
    if (method_.spectrum && ends.least > 0) counts_.condition = ends.greatest / ends.least;
    x_ = nu_ = Vector::Zero(dual_.rows());
    displacement_ = program_.b.norm();
  }

  /// λ of the problem's rows, in the user's units.
  Vector multipliers(const Vector& x) const {
    const Eigen::Index m = problem_.rows();
    return (x + shift_).head(m).cwiseProduct(dual_.scale());
  }

  double relative(double gradient, double equality) const {
    const double force = force_ > 0 ? force_ : (x_ + shift_).norm();
    const double g = displacement_ > 0 ? gradient / displacement_ : gradient, e = force > 0 ? equality / force : equality;
    return std::max(g, e);
  }

  void iterate() {
    const bool coulomb = bounds_depend_on_normal(problem_);
    bounds_ = friction_bounds(problem_, Vector::Zero(problem_.rows()));
    if (!coulomb) {
      solve_given(method_.tol);
      return;
    }
    begin_unbounded();
    double change = 1, best = std::numeric_limits<double>::infinity(), step = 1;
    for (int since_best = 0;;) {
      const double precision = std::max(method_.tol, std::min(kFirst, kAhead * change));
      if (!solve_given(precision)) return;
      ++counts_.loops;
      const Vector next = friction_bounds(problem_, multipliers(x_));
      const double size = next.norm();
      const bool bounded = bounds_.allFinite();
      change = bounded ? (next - bounds_).norm() / (size > 0 ? size : 1) : 1;
      bounds_ = bounded ? Vector(bounds_ + step * (next - bounds_)) : next;
      since_best = change < 0.9 * best ? 0 : since_best + 1;
      best = std::min(best, change);
      if (change <= method_.tol && precision <= method_.tol) return;
      if (since_best > 0 && since_best % kPatience == 0) {
        if (step <= kLeastStep) return unsettled(change);
        step /= 2;
      }
    }
  }

  void unsettled(double change) {
    result_.converged = false;
    result_.reason = text("the bounds of Coulomb's friction have not settled: they still change by ", change, " a step");
  }

  /// Coulomb's points do not slip at first.
  void begin_unbounded() {
    Eigen::Index point = 0;
    for (const FrictionGroup& group : problem_.friction)
      for (int k = 0; k < group.points(); ++k, ++point)
        if (group.law->bound_slope(k) > 0) bounds_[point] = INFINITY;
  }

  /// With the bounds as they are, from the last solution on. False where it is not solved.
  bool solve_given(double precision) {
    const SeparableSet set = admissible(problem_, dual_.scale(), bounds_, shift_);
    program_.set = &set;
    const SmalbeCaller caller{
        .done = [&](double gradient, double equality) { return relative(gradient, equality) <= precision; },
        .inner = [&](const SmalbeState& state) { return watch_inner(state); },
        .outer = [&](const SmalbeState& state) {
          record(state.inner.face(), state.outer, state.inner.steps(), relative(state.gradient, state.equality));
        }};
    SmalbeResult solved = minimise(program_, settings(set), caller, x_, nu_);
    x_ = std::move(solved.x);
    nu_ = std::move(solved.nu);
    M_ = solved.M / program_.norm;
    finish(solved);
    const auto face = set.gradients(x_, Vector::Zero(x_.size())).face;
    if (solved.end == End::done) record(face, 0, 0, residual_);
    else branches(face);
    return result_.converged;
  }

  Smalbe settings(const SeparableSet& set) {
    Smalbe settings = method_.outer;
    settings.inner.expansion = method_.expansion;
    if (counts_.loops > 0) settings.M = M_;
    settings.max_inner = method_.max_inner - counts_.inner;
    settings.max_outer = method_.max_iterations - result_.iterations;
    settings.preconditioner = preconditioner_.on(set, program_.norm);
    return settings;
  }

  bool watch_inner(const SmalbeState& state) {
    monitor_.phase(text("inner step ", counts_.inner + state.inner.steps(), ", residual ", relative(state.gradient, state.equality)));
    return !monitor_.stop();
  }

  /// An outer step's end: `outer` and `inner` steps after those counted, at multipliers free as `face` says.
  void record(const std::vector<Place>& face, int outer, int inner, double residual) {
    IterationInfo info = branches(face);
    info.iteration = result_.iterations + outer;
    info.inner = counts_.inner + inner;
    info.residual = residual;
    info.seconds = watch_.seconds();
    result_.history.push_back(info);
    monitor_.iteration(info);
  }

  /// Takes the rows' branches into the result, and counts them. `face`: which multipliers are free.
  IterationInfo branches(const std::vector<Place>& face) {
    IterationInfo info;
    std::vector<char> active(problem_.rows(), 0), slipping(problem_.rows(), 0);
    for (const RowGroup& group : problem_.groups)
      for (int r = group.first; r < group.first + group.count; ++r)
        info.active += active[r] = !group.law->unilateral() || face[r] == Place::free;
    Eigen::Index point = 0;
    for (const FrictionGroup& group : problem_.friction)
      for (int k = 0; k < group.points(); ++k, ++point) {
        if (face[group.normal[k]] != Place::free || bounds_[point] == 0) continue;
        const bool slips = face[group.row(k)] != Place::free;
        for (int i = 0; i < group.components; ++i) slipping[group.row(k) + i] = slips;
        ++(slips ? info.slip : info.stick);
      }
    if (!active_.empty())
      for (int r = 0; r < problem_.rows(); ++r)
        info.changed += active[r] != active_[r] || slipping[r] != result_.slipping[r];
    active_ = std::move(active);
    result_.slipping = std::move(slipping);
    if (result_.active_sets.empty() || result_.active_sets.back() != active_) result_.active_sets.push_back(active_);
    return info;
  }

  void finish(const SmalbeResult& solved) {
    result_.iterations += solved.outer + (solved.end == End::done);
    counts_.inner += solved.inner;
    counts_.products += solved.products;
    residual_ = relative(solved.gradient, solved.equality);
    result_.converged = solved.end == End::done;
    switch (solved.end) {
      case End::done: result_.reason = "the residual fell below tol"; break;
      case End::stopped: result_.reason = "interrupted; this is the state so far"; break;
      case End::limit: result_.reason = text("no convergence within ", result_.iterations, " outer and ", counts_.inner, " inner steps"); break;
      case End::rounding: result_.reason = text("rounding keeps the residual at ", residual_, ", above tol"); break;
      case End::infeasible: result_.reason = "no multipliers that the laws allow balance the load"; break;
      case End::unbounded: result_.reason = "the dual energy falls for ever: the supports and gaps contradict each other"; break;
      case End::not_finite: result_.reason = "the iteration met numbers that are not finite"; break;
    }
  }

  void recover() {
    const Vector lambda = x_ + shift_, v = dual_.elastic(lambda);
    const Vector alpha = coarse_.amounts(compliance_.cwiseProduct(lambda) - dual_.jump(v) - nu_);
    result_.state.u = average(dual_.torn(), dual_.moved(v, alpha));
    result_.state.lambda = multipliers(x_);
  }

  void report() {
    result_.method = "feti";
    result_.noise = std::max(result_.noise, kSpoilt * method_.tol);
    result_.ordering = dual_.ordering();
    result_.factor_bytes = dual_.factor_bytes() + preconditioner_.factor_bytes();
    counts_.subdomains = static_cast<int>(dual_.torn().pieces.size());
    counts_.factors = static_cast<int>(dual_.kinds().size());
    counts_.rows = dual_.rows();
    counts_.kernel = coarse_.modes();
    result_.feti = counts_;
    result_.reason += text("; ", counts_.inner, " inner steps", counts_.loops ? text(", bounds updated ", counts_.loops, " times") : "");
  }

  const Problem& problem_;
  const Feti& method_;
  Monitor& monitor_;
  Result result_;
  DualProblem dual_;
  CoarseSpace coarse_;
  FetiPreconditioner preconditioner_;
  Vector compliance_;
  EqualityProgram program_;
  double force_ = 0, displacement_ = 0, residual_ = 0, M_ = 0;
  Vector shift_, x_, nu_, bounds_;
  std::vector<char> active_;
  FetiCounts counts_;
  Stopwatch watch_;
};

}  // namespace

Result solve(const Problem& problem, const Feti& method, Monitor& monitor) {
  int motions = 0;
  for (const problem::Block& block : problem.blocks) motions += static_cast<int>(block.kernel.cols());
  const std::string note = motions > kManyMotions ? "" : require_solvable(problem, problem::rigid_motions(problem));
  Result result = Run(problem, method, monitor)();
  if (!note.empty()) result.reason += "; " + note;
  return result;
}

}  // namespace dotyk::solver
