#include "solver/active/pdas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

#include "base/stopwatch.hpp"
#include "base/text.hpp"
#include "problem/parts.hpp"
#include "problem/residual.hpp"
#include "solver/programs/active_set.hpp"
#include "solver/active/box_barrier.hpp"
#include "solver/active/descent.hpp"
#include "solver/active/held_stiffness.hpp"
#include "solver/active/hold.hpp"
#include "solver/active/interior_start.hpp"
#include "solver/active/linearisation.hpp"
#include "solver/active/nested_start.hpp"
#include "solver/rows/proximal.hpp"
#include "solver/active/refine.hpp"
#include "solver/core/require_solvable.hpp"
#include "solver/active/rest.hpp"
#include "solver/active/screws.hpp"
#include "solver/active/step.hpp"
#include "solver/core/treatable.hpp"
#include "solver/core/verdict.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;
using problem::CondensedProblem;
using problem::Problem;

/// Rows named in a message: the first few places.
std::string places(const Problem& problem, const std::vector<int>& rows) {
  std::string out;
  for (std::size_t k = 0; k < rows.size() && k < 4; ++k)
    out += (k ? ", " : "") + (problem.row_name ? problem.row_name(rows[k]) : text("row ", rows[k] + 1));
  if (rows.size() > 4) out += text(" and ", rows.size() - 4, " more");
  return out;
}

class Iteration {
 public:
  Iteration(const Problem& problem, const Pdas& settings, Monitor& monitor)
      : problem_(problem), settings_(settings), monitor_(monitor), solvable_(require_solvable(problem, result_.clock, monitor)),
        holder_(problem, rigid_),
        rho_(settings.rho * problem.row_stiffness()), compliance_(problem.row_compliance()), parts_(problem::parts(problem)) {
    // A row that no unknown moves has no stiffness; any ρ will do.
    const double largest = rho_.size() && rho_.maxCoeff() > 0 ? rho_.maxCoeff() : 1;
    for (int r = 0; r < rho_.size(); ++r)
      if (!(rho_[r] > 0)) rho_[r] = largest, compliance_[r] = settings.rho / largest;
    lambda_ = Vector::Zero(problem.rows());
    result_.method = settings.reduced ? "pdas" : settings.held ? "pdas (held)" : "pdas (full)";
  }

  Result run() {
    const std::string& note = solvable_.note;
    place_screws();
    Linearisation l = first();
    if (settings_.reduced) condense();
    else if (settings_.held) analyse();
    step_ = screws_             ? screw_step(*condensed_, rho_, *screws_)
            : settings_.reduced ? reduced_step(*condensed_, rho_)
            : settings_.held    ? held_step(problem_, *stiffness_, rho_)
            : settings_.step    ? settings_.step(problem_, rigid_, rho_)
                                : full_step(problem_, rigid_, rho_);
    Stopwatch iterating;
    begin_on_few(l);
    begin_inside(l);
    const End end = iterate_and_rescue(l);
    conclude(end);
    if (end == End::repeated && !screws_) come_to_rest(l);
    result_.reason += begun_;
    if (!note.empty()) result_.reason += "; " + note;
    result_.clock.iterate += iterating.lap();
    monitor_.phase("recovering the displacement");
    result_.state.u = settled_ ? *settled_ : left_alpha_ ? condensed_->recover(lambda_, *left_alpha_) : step_->recover();
    result_.state.lambda = lambda_;
    if (result_.converged && !screws_) confirm_laws();
    result_.clock.recover += iterating.lap();
    return std::move(result_);
  }

 private:
  void place_screws() {
    if (settings_.kernel != Pdas::Kernel::screws || rigid_.noticed.cols() == 0) return;
    if (!settings_.reduced) throw InputError("kernel = \"screws\" needs reduced = true");
    screws_.emplace(problem_, algebra::DenseMatrix(rigid_.noticed_N), rigid_.noticed_e, settings_.screws);
    result_.method = "pdas with screws";
    note_screws();
  }

  void note_screws() {
    result_.screws.push_back({screws_->rows(), screws_->regularity(), screws_->determinant()});
  }

  /// Where nothing is loaded λ itself is noise.
  double noise_of_screws() const { return std::max(1e-9 * lambda_.lpNorm<Eigen::Infinity>(), noise(lambda_, x_).force.maxCoeff()); }

  /// At the end: are there screws where nothing presses?
  bool pulling() const { return screws_ && screws_->pulls(lambda_, noise_of_screws()); }

  /// Then they move, and the iteration goes on.
  bool move_screws(Linearisation& l) {
    if (screws_->moves() >= settings_.max_moves || !screws_->move(lambda_, noise_of_screws())) return false;
    result_.screw_moves = screws_->moves();
    note_screws();
    l = held(std::move(l), x_);
    seen_.clear();
    return true;
  }

  void condense() {
    condensed_ = &(settings_.condenser ? *settings_.condenser : own_)
                      .condense(problem_, rigid_, settings_.ordering, result_.clock, monitor_);
    result_.factor_bytes = condensed_->factor_bytes();
    result_.ordering = condensed_->ordering();
  }

  void analyse() {
    Stopwatch watch;
    monitor_.phase("ordering");
    stiffness_.emplace(problem_, rigid_, settings_.ordering);
    result_.clock.ordering += watch.lap();
    result_.factor_bytes = stiffness_->cholesky().bytes();
    result_.ordering = stiffness_->cholesky().method();
  }

  Linearisation first() {
    const double touching = 1e-12 * (problem_.rows() ? problem_.c.lpNorm<Eigen::Infinity>() : 0);
    std::vector<char> active = settings_.start;
    if (active.empty()) {
      active.resize(problem_.rows());
      for (const problem::RowGroup& group : problem_.groups)
        for (int r = group.first; r < group.first + group.count; ++r) active[r] = !group.law->unilateral() || problem_.c[r] <= touching;
    }
    Linearisation l = from_flags(problem_, active, rho_);
    return held(std::move(l), -problem_.c);
  }

  /// Where rows follow one another along edges, on few of them first.
  void begin_on_few(Linearisation& l) {
    if (!settings_.reduced || screws_ || !settings_.start.empty()) return;
    NestedStart nested(problem_, *condensed_, rho_);
    if (!nested.worthwhile()) return;
    l = held(nested.run(*step_), -problem_.c);
    begun_ = text(", begun with ", nested.solves(), " solves on a part of the rows");
  }

  /// Where an interior point method ends.
  void begin_inside(Linearisation& l) {
    if (!stiffness_ || !settings_.start.empty()) return;
    const std::string how = by_interior_point(End::exhausted, l);
    if (!how.empty()) begun_ = ", begun with " + how;
  }

  /// The linearisation with rows added where a rigid motion would be free.
  Linearisation held(Linearisation l, const Vector& x) {
    std::vector<char> active = l.active;
    if (screws_)
      for (int r : screws_->rows()) active[r] = 1;
    holder_.hold(active, x, l.value);
    return active == l.active ? l : from_flags_keeping(l, active);
  }

  Linearisation from_flags_keeping(const Linearisation& l, const std::vector<char>& active) {
    Linearisation changed = from_flags(problem_, active, rho_);
    for (int r = 0; r < problem_.rows(); ++r)
      if (active[r] == l.active[r]) {
        changed.y[r] = l.y[r];
        changed.value[r] = l.value[r];
        changed.slope[r] = l.slope[r];
        changed.active[r] = l.active[r];
      }
    return changed;
  }

  /// How Newton steps ended; `misplaced`: a screw pulls and has nowhere to go.
  enum class End { repeated, misplaced, cycle, singular, exhausted, interrupted };

  /// Newton steps; where they do not come to rest, from where the rescues end, one after the other. A rescue begins while steps are left,
  /// and has steps of its own to be confirmed.
  End iterate_and_rescue(Linearisation& l) {
    constexpr std::array rescues{&Iteration::by_sweeps, &Iteration::by_barrier, &Iteration::by_interior_point};
    const auto left = [&] { return settings_.max_iterations - result_.iterations; };
    End end = iterate(l, left(), kPatience);
    for (const auto rescue : rescues) {
      if (left() <= 0 || !(end == End::cycle || end == End::singular || end == End::exhausted)) break;
      const std::string why = cause(end);
      const std::string how = (this->*rescue)(end, l);
      if (how.empty()) continue;
      rescued_ = "; before, " + why + ", left by " + how;
      end = iterate(l, kConfirmations, kConfirmations);
    }
    if (end == End::exhausted && left() > 0) end = iterate(l, left(), left());
    return end;
  }

  /// What made Newton steps end, as a rescue's reason begins.
  std::string cause(End end) const {
    if (end == End::cycle) return "active sets repeated at " + places(problem_, changed_);
    if (end == End::singular) return text("the linear problem of iteration ", result_.iterations, " was singular");
    return text("no confirmed active set in ", result_.iterations, " iterations");
  }

  void conclude(End end) {
    result_.converged = end == End::repeated;
    switch (end) {
      case End::repeated: result_.reason = "active set confirmed" + rescued_; break;
      case End::misplaced: result_.reason = text("a screw still pulls after ", screws_->moves(), " moves"); break;
      case End::interrupted: result_.reason = "interrupted; this is the state so far"; break;
      case End::singular:
        result_.reason = text("the linear problem of iteration ", result_.iterations,
                              " is singular: active rows contradict each other or do not hold a body", inside_ ? "; tried interior_point" : "");
        break;
      case End::cycle:
        by_active_set();
        if (!result_.converged) by_proximal("active sets repeated at " + places(problem_, changed_));
        break;
      case End::exhausted:
        result_.reason = text("no confirmed active set within ", settings_.max_iterations,
                              " iterations; rows that still change: ", places(problem_, changed_));
    }
  }

  /// At most so many Newton steps; fewer where they crawl after more than `patience`.
  End iterate(Linearisation& l, int most, int patience) {
    seen_.clear();
    for (int k = 0; k < most && (k < patience || !crawls()); ++k) {
      if (monitor_.stop()) return End::interrupted;
      if (const auto end = advance(l)) return *end;
    }
    return End::exhausted;
  }

  /// Do more than half as many rows change as a few steps ago?
  bool crawls() const {
    const auto& h = result_.history;
    return h.size() > kStretch && 2 * h.back().changed > h[h.size() - 1 - kStretch].changed;
  }

  /// One linear solve and the next linearisation in `l`; nothing where it is new.
  std::optional<End> advance(Linearisation& l) {
    ++result_.iterations;
    result_.active_sets.push_back(l.active);
    seen_.insert(l.fingerprint());
    Vector lambda, x;
    if (!step_->solve(l, lambda, x)) return End::singular;  // the state stays that of the last solve
    lambda_ = std::move(lambda);
    x_ = std::move(x);
    left_alpha_.reset();
    Linearisation next = held(linearise(problem_, lambda_, x_, rho_, noise(lambda_, x_), &l), x_);
    changed_.clear();
    for (int r = 0; r < problem_.rows(); ++r)
      if (!next.same_piece(l, r)) changed_.push_back(r);
    record(next);
    if (changed_.empty()) {
      if (!pulling()) return End::repeated;
      if (!move_screws(l)) return End::misplaced;
      return std::nullopt;
    }
    l = std::move(next);
    if (seen_.count(l.fingerprint())) return End::cycle;
    return std::nullopt;
  }

  bool same_pieces(const Linearisation& a, const Linearisation& b) const {
    for (int r = 0; r < problem_.rows(); ++r)
      if (!a.same_piece(b, r)) return false;
    return true;
  }

  /// What rounding leaves on rows that touch without force: a few digits of the greatest multiplier of
  /// their part, and of the displacements and the row's own gap that cancel in x, each turned into the other by the
  /// row's stiffness. A gap that says "never" (1e30) is no measure of the others' rounding.
  Noise noise(const Vector& lambda, const Vector& x) const {
    if (lambda.size() == 0) return {lambda, lambda};
    Vector jump = (x + problem_.c).cwiseAbs();
    for (Eigen::Index r = 0; r < x.size(); ++r)
      if (!(std::abs(problem_.c[r]) < 1e6 * jump[r])) jump[r] = 0;
    const std::vector<double> force = parts_.greatest(lambda), moved = parts_.greatest(jump);
    const Vector stiffness = compliance_.cwiseInverse();
    Vector most(x.size());
    for (Eigen::Index r = 0; r < x.size(); ++r) {
      const int part = parts_.of_row[r];
      most[r] = 1e-13 * (force[part] + stiffness[r] * std::max(std::abs(problem_.c[r]), moved[part]));
    }
    return {most, most.cwiseQuotient(stiffness)};
  }

  void record(const Linearisation& next) {
    IterationInfo info;
    info.iteration = result_.iterations;
    info.active = next.active_count();
    info.changed = static_cast<int>(changed_.size());
    info.residual = problem::natural_residual(problem_, x_, lambda_, rho_);
    info.seconds = watch_.seconds();
    result_.history.push_back(info);
    monitor_.iteration(info);
  }

  /// Descends the dual energy, trying a Newton step after every few sweeps, until the step confirms its own active set: settles small cycles.
  std::string by_sweeps(End end, Linearisation& l) {
    if (end != End::cycle || (!condensed_ && problem_.rows() > kMostDense)) return "";
    if (!condensed_) condense();
    DualDescent descent(problem_, *condensed_, lambda_);
    const auto newton = reduced_step(*condensed_, rho_);
    for (int round = 0; round < kSweepRounds && !monitor_.stop(); ++round) {
      for (int k = 0; k < kSweeps; ++k) descent.sweep();
      descent.update_equilibrium();
      l = linearise(problem_, descent.lambda(), descent.jump(), rho_, noise(descent.lambda(), descent.jump()), nullptr);
      Vector lambda, x;
      if (!newton->solve(l, lambda, x)) continue;
      const Linearisation next = linearise(problem_, lambda, x, rho_, noise(lambda, x), &l);
      if (same_pieces(l, next)) return "sweeps that decrease the dual energy";
      descent.take_if_lower(lambda);
    }
    lambda_ = descent.lambda();
    x_ = descent.jump();
    left_alpha_ = descent.alpha();
    return "";
  }

  /// A barrier method on the condensed rows.
  std::string by_barrier(End, Linearisation& l) {
    if (!condensed_ || problem_.rows() > kMostDense) return "";
    monitor_.phase("the active sets do not come to rest: a barrier method on the rows");
    std::vector<int> rows(problem_.rows());
    std::iota(rows.begin(), rows.end(), 0);
    const BoxSolution s = solve_by_barrier(box_program(problem_, *condensed_, rows, std::vector<double>(rows.size(), 1)), kBarrierTol);
    if (!s.converged) return "";
    Vector jump = condensed_->jump(s.lambda, s.alpha);
    for (int r = 0; r < jump.size(); ++r)
      if (s.side[r] == 0) jump[r] = 0;  // the barrier's error, which ρ can blow up until it leaves the bounds
    l = held(linearise(problem_, s.lambda, jump, rho_, noise(s.lambda, -problem_.c), nullptr), jump);
    return text(s.iterations, " steps of a barrier method");
  }

  /// An interior point method on the unknowns.
  std::string by_interior_point(End, Linearisation& l) {
    if (inside_) return "";
    inside_ = true;
    if (!stiffness_) analyse();
    monitor_.phase("an interior point method");
    const InteriorPointState s = interior_start(problem_, rigid_, *stiffness_, kBeginning, monitor_);
    if (s.iterations == 0) return "";
    l = held(linearise(problem_, s.lambda, s.x, rho_, noise(s.lambda, s.x), nullptr), s.x);
    return text(s.iterations, " steps of an interior point method");
  }

  /// The active-set method of programs, from rest, which ends where laws are unilateral or linear.
  void by_active_set() {
    result_.reason = "active sets repeat at " + places(problem_, changed_);
    if (!unilateral_or_linear(problem_) || problem_.rows() > kMostDense) return;
    ActiveSet method;
    method.tol = settings_.tol;
    method.ordering = settings_.ordering;
    method.max_iterations = kStepsPerRow * problem_.rows();
    monitor_.phase("active sets repeat: the active-set method of programs, from rest");
    InnerMonitor monitor(monitor_);
    Result settled = solve(problem_, method, monitor);
    result_.converged = settled.converged;
    result_.working_set = settled.working_set;
    result_.active_sets.push_back(settled.active_sets.back());
    result_.clock.factor += settled.clock.factor;
    result_.reason = settled.converged ? text("active set confirmed; before, active sets repeated at ", places(problem_, changed_), ", left by ",
                                              settled.iterations, " steps of active_set")
                                       : text(result_.reason, "; ", settled.iterations, " steps of active_set in vain: ", settled.reason);
    lambda_ = settled.state.lambda;
    settled_ = std::move(settled.state.u);
  }

  /// Where bodies have gone far for the sake of rows that bear nothing, rounding of the way may spoil the gaps of others.
  void confirm_laws() {
    if (problem::distance_from_laws(problem_, result_.state) <= result_.noise) return;
    problem::Residual r = problem::residual(problem_, result_.state);
    if (condensed_ && r.laws() > result_.noise) refine(problem_, *condensed_, result_.state, r);
    const double laws = r.laws();
    if (!(laws > result_.noise) || on_all_unknowns(laws)) return;
    by_proximal(text("rounding put the state off its laws by ", laws));
    result_.state.lambda = lambda_;
    if (settled_) result_.state.u = *settled_;
  }

  /// Where the condensed problem has lost too many digits: the same on all unknowns. True where that is nearer to the laws than `laws`.
  bool on_all_unknowns(double laws) {
    if (!condensed_) return false;
    Pdas whole = settings_;
    whole.reduced = false, whole.start = result_.active_sets.back();
    InnerMonitor monitor(monitor_);
    Result found = solve(problem_, whole, monitor);
    if (!found.converged || !(problem::residual(problem_, found.state).laws() < laws)) return false;
    result_.state = std::move(found.state);
    result_.active_sets.push_back(found.active_sets.back());
    result_.reason += text("; condensed, rounding put the state off its laws by ", laws, ": ", found.iterations, " iterations on all unknowns");
    return true;
  }

  /// The proximal point method, which converges from everywhere as the energy is convex, whatever the laws; `why` it is asked.
  void by_proximal(const std::string& why) {
    if (!condensed_ || problem_.rows() > kMostDense) return;
    Proximal method;
    method.tol = settings_.tol;
    monitor_.phase(why + ": the proximal point method");
    InnerMonitor monitor(monitor_);
    Result settled = solve(problem_, *condensed_, method, monitor);
    if (!settled.converged) {
      result_.reason += text("; ", settled.iterations, " iterations of proximal in vain: ", settled.reason);
      return;
    }
    result_.converged = true;
    result_.active_sets.push_back(settled.active_sets.back());
    result_.reason = text(settled.reason, "; before, ", why, ", left by ", settled.iterations, " iterations of proximal");
    lambda_ = settled.state.lambda;
    settled_ = std::move(settled.state.u);
  }

  /// Bodies that were moved for the sake of rows that bear nothing go back, where the laws allow it.
  void come_to_rest(const Linearisation& l) {
    const Noise before = noise(lambda_, x_);
    if (lambda_.size() == 0) return;
    if (!loaded(problem_) && (lambda_.cwiseAbs() - before.force).maxCoeff() <= 0) {  // there is no scale to rest by
      if ((problem_.c + before.gap).minCoeff() >= 0) lambda_.setZero(), x_ = -problem_.c, settled_ = Vector::Zero(problem_.unknowns());
      return;
    }
    const auto rest = held_at_rest(problem_, l, lambda_, rho_, before);
    if (!rest) return;
    Vector lambda, x;
    if (step_->solve(*rest, lambda, x)) {
      const Noise small = noise(lambda, x);
      if (obeys(linearise(problem_, lambda, x, rho_, small, &l), *rest, l, lambda, small)) {
        lambda_ = std::move(lambda);
        x_ = std::move(x);
        for (int r = 0; r < problem_.rows(); ++r)
          if (rest->y[r] != l.y[r]) lambda_[r] = 0, result_.active_sets.back()[r] = 0;
        return;
      }
    }
    if (!step_->solve(l, lambda_, x_)) throw std::logic_error("pdas: a linear problem that had a solution has none");
  }

  /// Newton steps before rescues are asked, and to confirm what one found.
  static constexpr int kPatience = 14, kConfirmations = 8;
  static constexpr std::size_t kStretch = 4;
  /// Sweeps between two Newton steps of the descent (and two updates of the free bodies' equilibrium), and how often.
  static constexpr int kSweeps = 3, kSweepRounds = 3;
  static constexpr int kMostDense = 3000, kStepsPerRow = 20;
  static constexpr double kBarrierTol = 1e-10, kBeginning = 1e-10;

  const Problem& problem_;
  const Pdas& settings_;
  Monitor& monitor_;
  Result result_;
  const Solvable solvable_;
  const problem::RigidMotions& rigid_ = solvable_.rigid;
  Holder holder_;
  Vector rho_, compliance_;  ///< of the rows
  problem::Parts parts_;
  problem::Condenser own_;
  const CondensedProblem* condensed_ = nullptr;
  std::optional<Screws> screws_;
  std::optional<HeldStiffness> stiffness_;  ///< of the held form, and of the interior point method
  std::unique_ptr<Step> step_;
  Vector lambda_, x_;
  std::vector<int> changed_;
  std::optional<Vector> left_alpha_;  ///< of the descent, where λ is the descent's and not the last step's
  std::optional<Vector> settled_;     ///< u of another method
  std::set<std::uint64_t> seen_;
  bool inside_ = false;         ///< the interior point method has been tried
  std::string begun_, rescued_; ///< what is said of starts, and of rescues
  Stopwatch watch_;
};

}  // namespace

Result solve(const Problem& problem, const Pdas& settings, Monitor& monitor) {
  require_frictionless(problem, "pdas");
  require_springs(problem, "pdas");
  return Iteration(problem, settings, monitor).run();
}

}  // namespace dotyk::solver
