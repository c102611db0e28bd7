#include "solver/feti/feti.hpp"

#include "base/stopwatch.hpp"
#include "problem/measure.hpp"
#include "problem/uniqueness.hpp"
#include "solver/feti/feti_preconditioner.hpp"
#include "solver/rows/projection.hpp"
#include "solver/core/require_solvable.hpp"
#include "solver/bounded/dual_laws.hpp"
#include "solver/core/treatable.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
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
/// Resultants that no multipliers balance, relative to all: above rounding in long sums.
constexpr double kImbalance = 1e-9;
/// The equilibrium of the displacements recovered may be worse than tol by what stiffnesses and sizes make of the copies'
/// disagreement; beyond this, or a tenth of the forces, it is no solution.
constexpr double kSpoilt = 1e4, kMostNoise = 0.1;
/// Below this part of what it is the difference of Pd may be rounding; it is taken for so many times what was seen of it.
constexpr double kSuspect = 1e-9, kSuspectRoundings = 10;

class FetiRun {
 public:
  /// `unnoticed`: the displacements that no row notices, as far as they are known; the solution's part in them is zero.
  FetiRun(const Problem& problem, const Feti& method, algebra::SparseMatrix unnoticed, Monitor& monitor)
      : problem_(problem), method_(method), unnoticed_(std::move(unnoticed)), monitor_(monitor), measure_(problem),
        dual_(problem, method.ordering, result_.clock, monitor), coarse_(dual_.G(), dual_.e()),
        preconditioner_(dual_, coarse_, method, monitor), outer_(method.outer) {
    if (coarse_.imbalance() > kImbalance)
      throw InputError(text("the load does work on a rigid motion that nothing holds: no contact forces balance ",
                            coarse_.imbalance(), " of its resultants", unbalanced(coarse_.particular())));
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
  /// Which body's motion multipliers leave the most of the load to.
  std::string unbalanced(const Vector& lambda) const {
    return unbalanced_motion(problem_, dual_.on_blocks(problem_, coarse_.unbalanced(lambda)));
  }

  void homogenise() {
    program_.H = [this](const Vector& v) { return coarse_.P(dual_.apply(v)); };
    program_.Q = [this](const Vector& v) { return coarse_.Q(v); };
    program_.complementary = true;
    const auto ends = dual_spectrum(dual_, coarse_, method_.spectrum ? algebra::Ends::both : algebra::Ends::greatest, monitor_);
    counts_.norm = program_.norm = ends.bound() > 0 ? ends.bound() : 1;
    if (method_.spectrum && ends.least > 0) counts_.condition = ends.greatest / ends.least;
    choose_unit();
    shift_ = coarse_.particular() / unit_;
    const Vector d = dual_.d() / unit_, Fshift = dual_.apply(shift_);
    program_.b = coarse_.P(d - Fshift);
    x_ = nu_ = Vector::Zero(dual_.rows());
    displacement_ = program_.b.norm(), noise_ = rounding(d, Fshift);
    if (method_.stop == Feti::Stop::d) displacement_ = d.norm();
  }

  /// What of Pd is rounding, where that may be all of it (λ̄ is the solution: of uniform stress it is), else zero.
  double rounding(const Vector& d, const Vector& Fshift) const {
    const double size = d.norm() + Fshift.norm(), last = std::numeric_limits<double>::epsilon() * size;
    if (!(displacement_ <= kSuspect * size)) return 0;
    return kSuspectRoundings * (last + algebra::rounding_seen([this](const Vector& v) { return dual_.apply(v); }, shift_, Fshift));
  }

  /// Forces are counted in a power of two of the greatest that the Measure has, so that squares of them neither vanish nor overflow; all that
  /// the dual problem has is linear in it.
  void choose_unit() {
    double size = 0;
    for (int p = 0; p < measure_.parts().count; ++p) size = std::max(size, measure_.force(p));
    if (size > 0 && std::isfinite(size)) unit_ = std::exp2(std::ilogb(size));
    scale_ = dual_.scale() * unit_;
  }

  Vector lambda() const { return (x_ + shift_) * unit_; }  ///< of all rows, in the user's units but for the rows' scale
  /// Of the problem's rows, in the user's units.
  Vector multipliers(const Vector& x) const { return (x + shift_).head(problem_.rows()).cwiseProduct(scale_); }

  /// G̃x are the forces left on the pieces' motions, of which R̂ is an orthonormal basis: their norm is measured as that of forces is.
  double unbalanced_share(const Vector& x) const {
    const Vector left = dual_.G() * x;
    const problem::Parts& parts = measure_.parts();
    const std::vector<double> borne = parts.norm(multipliers(x));
    std::vector<double> of_part(borne.size(), 0);
    for (std::size_t k = 0; k < dual_.torn().pieces.size(); ++k) {
      const int block = problem_.subdomains.empty() ? static_cast<int>(k) : problem_.subdomains[k].block;
      const Piece& piece = dual_.torn().pieces[k];
      problem::add(of_part[static_cast<std::size_t>(parts.of_block[block])], left.segment(piece.first_mode, dual_.basis(piece).cols()));
    }
    double most = 0;
    for (std::size_t p = 0; p < borne.size(); ++p)
      if (const double force = measure_.force(p, borne[p]); of_part[p] > 0) most = std::max(most, force > 0 ? unit_ * of_part[p] / force : of_part[p]);
    return most;
  }

  double relative(double gradient, const Vector& x) const {
    const double beyond = std::max(0.0, gradient - noise_);
    return std::max(displacement_ > 0 ? beyond / displacement_ : beyond, unbalanced_share(x));
  }

  void iterate() {
    bounds_ = SettlingBounds(no_slip_bounds(problem_));
    if (!problem::has_coulomb(problem_)) {
      solve_given(method_.tol);
      return;
    }
    for (bool moves = true; moves;) {
      if (result_.iterations >= method_.max_iterations || counts_.inner >= method_.max_inner) return give_up();
      const double precision = std::max(method_.tol, std::min(kFirst, kAhead * bounds_.change()));
      if (!solve_given(precision)) return;
      ++counts_.loops;
      moves = bounds_.follow(friction_bounds(problem_, multipliers(x_)));
      if (bounds_.change() <= method_.tol && precision <= method_.tol) return;
    }
    result_.converged = false;
    result_.reason = text("the bounds of Coulomb's friction have not settled: they still change by ", bounds_.change(), " a step");
  }

  void give_up() {
    result_.converged = false;
    result_.reason = text("no convergence within ", result_.iterations, " outer and ", counts_.inner, " inner steps");
  }

  /// With the bounds as they are, from the last solution on. False where it is not solved.
  bool solve_given(double precision) {
    const SeparableSet set = admissible(problem_, scale_, bounds_.now(), shift_);
    program_.set = &set;
    const SmalbeCaller caller{
        .done = [&](double gradient, double, const Vector& x) { return (residual_ = relative(gradient, x)) <= precision; },
        .inner = [&](const SmalbeState& state) {
          monitor_.phase(text("inner step ", counts_.inner + state.inner.steps(), ", residual ", residual_));
          return !monitor_.stop();
        },
        .outer = [&](const SmalbeState& state) {
          record(state.inner.face(), state.outer, state.inner.steps(), relative(state.gradient, state.inner.x()));
        }};
    SmalbeResult solved = minimise(program_, settings(set), caller, x_, nu_);
    x_ = std::move(solved.x);
    nu_ = std::move(solved.nu);
    // For the next bounds: learnt anew, wall.lua takes 1.16 to 2 times the steps.
    outer_.M = solved.M / program_.norm;
    outer_.rho = solved.rho / program_.norm;
    finish(solved);
    const auto face = set.gradients(x_, Vector::Zero(x_.size())).face;
    if (solved.end == End::done) record(face, 0, 0, residual_);
    else branches(face);
    return result_.converged;
  }

  Smalbe settings(const SeparableSet& set) {
    Smalbe settings = outer_;
    settings.inner.expansion = method_.expansion;
    settings.max_inner = method_.max_inner - counts_.inner;
    settings.max_outer = method_.max_iterations - result_.iterations;
    settings.preconditioner = preconditioner_.on(set, program_.norm);
    return settings;
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
    std::vector<char> active(problem_.rows(), 0), slipping(problem_.rows(), 0), limited(problem_.rows(), 0);  // limited: at a bound a row may bear
    for (const RowGroup& group : problem_.groups)
      for (int r = group.first; r < group.first + group.count; ++r)
        info.active += active[r] = face[r] == Place::free, limited[r] = std::isfinite(group.law->multipliers(r - group.first).high);
    Eigen::Index point = 0;
    for (const FrictionGroup& group : problem_.friction)
      for (int k = 0; k < group.points(); ++k, ++point) {
        if ((group.normal[k] >= 0 && face[group.normal[k]] != Place::free && !limited[group.normal[k]]) || bounds_.now()[point] == 0) continue;
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
    residual_ = relative(solved.gradient, x_);
    result_.converged = solved.end == End::done;
    switch (solved.end) {
      case End::done: result_.reason = "the residual fell below tol"; break;
      case End::stopped: result_.reason = "interrupted; this is the state so far"; break;
      case End::limit: give_up(); break;
      case End::rounding: result_.reason = text("rounding keeps the residual at ", residual_, ", above tol"); break;
      case End::infeasible:
        result_.reason = text("no multipliers that the laws allow balance the load", unbalanced(lambda()));
        break;
      case End::unbounded: result_.reason = "the dual energy falls for ever: the supports and gaps contradict each other"; break;
      case End::not_finite: result_.reason = "the iteration met numbers that are not finite"; break;
    }
  }

  void recover() {
    const Vector v = dual_.elastic(lambda());
    const Vector alpha = coarse_.amounts(dual_.torn().compliance.cwiseProduct(lambda()) - dual_.jump(v) - nu_ * unit_);
    result_.state.u = problem::least(unnoticed_, average(dual_.torn(), dual_.moved(v, alpha)));
    result_.state.lambda = multipliers(x_);
  }

  void report() {
    result_.method = "feti";
    result_.noise = std::max(result_.noise, std::min(kSpoilt * method_.tol, kMostNoise));
    result_.ordering = dual_.ordering();
    result_.factor_bytes = dual_.factor_bytes() + preconditioner_.factor_bytes();
    counts_.subdomains = static_cast<int>(dual_.torn().pieces.size());
    counts_.factors = static_cast<int>(dual_.kinds().size());
    counts_.rows = dual_.rows();
    counts_.kernel = coarse_.modes();
    counts_.rho = outer_.rho;
    result_.feti = counts_;
    result_.reason += text("; ", counts_.inner, " inner steps", counts_.loops ? text(", bounds updated ", counts_.loops, " times") : "");
  }

  const Problem& problem_;
  const Feti& method_;
  const algebra::SparseMatrix unnoticed_;
  Monitor& monitor_;
  const problem::Measure measure_;
  Result result_;
  DualProblem dual_;
  CoarseSpace coarse_;
  FetiPreconditioner preconditioner_;
  EqualityProgram program_;
  Smalbe outer_;  ///< M and ρ as the last bounds left them
  double unit_ = 1, displacement_ = 0, noise_ = 0, residual_ = 0;
  Vector scale_;  ///< D in that unit
  Vector shift_, x_, nu_;
  SettlingBounds bounds_;
  std::vector<char> active_;
  FetiCounts counts_;
  Stopwatch watch_;
};

}  // namespace

Result solve(const Problem& problem, const Feti& method, Monitor& monitor) {
  require_springs(problem, "feti");
  if (has_two_springs(problem)) {
    const OpposedSprings split = opposed_springs(problem);
    return joined(solve(split.problem, method, monitor), split.from, problem.rows());
  }
  problem::Clock clock;
  const auto [rigid, note] = require_solvable(problem, clock, monitor);
  Result result = FetiRun(problem, method, problem::unnoticed_displacements(problem, rigid), monitor)();
  result.clock.motions = clock.motions;
  if (!note.empty()) result.reason += "; " + note;
  return result;
}

}  // namespace dotyk::solver
