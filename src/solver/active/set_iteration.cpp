#include "solver/active/set_iteration.hpp"

#include "algebra/dense/null_space.hpp"
#include "problem/residual.hpp"
#include "solver/active/relaxed.hpp"

namespace dotyk::solver {

using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;
using problem::Problem;
using End = SetIteration::End;

namespace {

/// Do Newton steps crawl when more than half as many rows change as so many steps ago?
constexpr std::size_t kStretch = 4;
/// With friction the first steps are not shortened; later ones are halved so many times at most.
constexpr int kUnguided = 4, kHalvings = 6;
/// With friction the iteration ends after so many steps in a row that come no nearer to the laws.
constexpr int kFrictionPatience = 15;
constexpr double kApproaches = 1e-9;  // of a unit motion; less is sliding along the row

/// Motions that the active rows leave free, as an orthonormal basis.
SparseMatrix free_motions(const SparseRows& N, const std::vector<char>& active) {
  SparseMatrix held = N;
  held.prune([&](int row, int, double) { return active[static_cast<std::size_t>(row)] != 0; });
  return algebra::range_and_null(held, problem::kNotAtAll).unseen;
}

/// Adds the points of friction that slip by `moved`, with the rows that press them; false where there are none.
bool stick(const Problem& problem, const Vector& moved, std::vector<char>& active) {
  bool any = false;
  for (const auto& [group, k, first, n] : problem.friction_points()) {
    if (active[first] || !(moved.segment(first, group.components).norm() > kApproaches)) continue;
    std::fill_n(active.begin() + first, group.components, char(1));
    if (n >= 0 && group.law->follows(k)) active[n] = 1;
    any = true;
  }
  return any;
}

/// Adds rows to `active` until the active rows hold every motion that rows notice: while one is
/// free, the bodies move along the load's part of it (or, without one, towards the nearest row)
/// until further rows close. `x` = Bu − c says where the rows are, λ what those bear that are not active: the least
/// or the greatest that their law allows. Throws InputError where nothing would ever stop the motion.
void hold(const Problem& problem, const problem::RigidMotions& rigid, std::vector<char>& active, const Vector& x, const Vector& lambda) {
  if (rigid.noticed_e.size() == 0) return;
  const SparseRows N = rigid.noticed_N;
  // How far each row, moving by `approach` per unit, has to go until its λ follows x; infinite where it is, or never does, and of friction.
  const auto distances = [&, rows = problem.scalar_rows()](const Vector& approach) {
    Vector far = Vector::Constant(problem.rows(), INFINITY);
    for (const auto& [law, k, r] : rows) {
      const auto [least, greatest] = law.multipliers(k);
      const auto [low, high] = problem::following(law, k);
      const bool above = lambda[r] >= greatest;
      const double end = above ? high : low;
      if (!active[r] && std::isfinite(end) && least != greatest && (above ? -approach[r] : approach[r]) > kApproaches) far[r] = (end - x[r]) / approach[r];
    }
    return far;
  };
  const auto nearest = [](const Vector& far) { return far.minCoeff<Eigen::PropagateNumbers>(); };
  for (;;) {
    const SparseMatrix free = free_motions(N, active);
    if (free.cols() == 0) return;
    Vector driving = rigid.noticed_e;
    for (int r = 0; r < problem.rows(); ++r)
      if (!active[r] && lambda[r] != 0) driving -= lambda[r] * Vector(N.row(r).transpose());
    Vector motion = free * Vector(free.transpose() * driving);
    if (!(motion.norm() > 1e-10 * rigid.e.norm())) {
      // No load drives it: towards the nearer side, for a state that multipliers can belong to.
      motion = free.col(0);
      if (nearest(distances(-(N * motion))) < nearest(distances(N * motion))) motion = -motion;
    }
    motion /= motion.lpNorm<Eigen::Infinity>();
    const Vector far = distances(N * motion);
    const double first = nearest(far);
    if (!std::isfinite(first) && stick(problem, N * motion, active)) continue;
    if (!std::isfinite(first))
      throw InputError(text("not held: nothing stops ", problem::describe(rigid.motions, rigid.noticed * motion),
                            "; fix, slide or spring a part, or add a contact in its way"));
    for (int r = 0; r < problem.rows(); ++r)
      if (far[r] <= first + 1e-9 * std::abs(first)) active[r] = 1;
  }
}

/// Of the rows: where their laws have branches to tell apart, law and bodies yield one after the other.
Vector with_laws(const Problem& problem) {
  Vector stiffness = problem.row_stiffness();
  for (const auto& [law, k, r] : problem.scalar_rows())
    if (const auto own = law.springs(k); own && !law.linear_stiffness(k) && std::max(own->below, own->above) > 0)
      stiffness[r] /= 1 + stiffness[r] / std::max(own->below, own->above);
  return stiffness;
}

}  // namespace

SetIteration::SetIteration(const Problem& problem, const Pdas& settings, Monitor& monitor)
    : problem(problem), settings(settings), monitor(monitor), solvable(require_solvable(problem, result.clock, monitor)),
      measure(problem, with_laws(problem)), rho(settings.rho * measure.stiffness()) {
  lambda = Vector::Zero(problem.rows());
  result.method = settings.reduced ? "pdas" : "pdas (held)";
  place_screws();
  l = held(from_flags(problem, first_active(problem, settings.start), rho), -problem.c);
  if (settings.reduced) condensed();
  step = screws             ? screw_step(*condensed_, rho, *screws)
         : settings.reduced ? reduced_step(*condensed_, rho)
         : settings.step    ? settings.step(problem, rigid, rho)
                            : held_step(problem, stiffness(), rho, settings.tol);
  if (settings.from && !settings.reduced) begin_from(*settings.from);
}

/// Goes on from `from`, relaxed near the rows that bear. Where relaxed() gives nothing, goes on from `from` itself: its unilateral rows are closed where they
/// bear and open elsewhere, whatever their gaps are.
void SetIteration::begin_from(const problem::State& from) {
  const HeldStiffness& held_by = stiffness();
  Stopwatch watch;
  const std::optional<problem::State> better = relaxed(problem, held_by, from);
  const problem::State& begun = better ? *better : from;
  Vector jump = problem::jumps(problem, begun.u);
  if (!better)
    for (const auto& [law, k, r] : problem.scalar_rows())
      if (law.unilateral()) jump[r] = begun.lambda[r] > 0 ? 0 : -1;  // only the sign counts
  step->begin(begun.u);
  l = held(linearise(problem, begun.lambda, jump, rho), -problem.c);
  result.clock.iterate += watch.lap();
}

void SetIteration::place_screws() {
  if (settings.kernel != Pdas::Kernel::screws || rigid.noticed.cols() == 0) return;
  if (!settings.reduced) throw InputError("kernel = \"screws\" needs reduced = true");
  screws.emplace(problem, algebra::DenseMatrix(rigid.noticed_N), rigid.noticed_e, settings.screws);
  result.method = "pdas with screws";
  note_screws();
}

/// Where nothing is loaded λ itself is rounding.
double SetIteration::rounding_of_screws() const { return std::max(1e-9 * lambda.lpNorm<Eigen::Infinity>(), rounding(lambda, x).force.maxCoeff()); }

/// Screws that pull move, and the iteration goes on.
bool SetIteration::move_screws() {
  if (screws->moves() >= settings.max_moves || !screws->move(lambda, rounding_of_screws())) return false;
  result.screw_moves = screws->moves();
  note_screws();
  l = held(std::move(l), x);
  seen_.clear();
  return true;
}

const problem::CondensedProblem& SetIteration::condensed() {
  if (condensed_) return *condensed_;
  condensed_ = &(settings.condenser ? *settings.condenser : own_).condense(problem, rigid, settings.ordering, result.clock, monitor);
  result.factor_bytes = condensed_->factor_bytes();
  result.ordering = condensed_->ordering();
  return *condensed_;
}

HeldStiffness& SetIteration::stiffness() {
  if (stiffness_) return *stiffness_;
  Stopwatch watch;
  stiffness_ = settings.stiffness;
  if (!stiffness_) {
    monitor.phase("ordering");
    stiffness_ = std::make_shared<HeldStiffness>(problem, rigid, settings.linear_or_factor(), monitor);
  }
  result.clock.ordering += watch.lap();
  iterations_before_ = stiffness_->solver().iterations();
  result.factor_bytes = stiffness_->solver().bytes();
  result.ordering = stiffness_->solver().method();
  return *stiffness_;
}

Linearisation SetIteration::held(Linearisation l, const Vector& x) const {
  std::vector<char> active = l.active;
  if (screws)
    for (int r : screws->rows()) active[r] = 1;
  for (Eigen::Index r = 0; r < x.size(); ++r) active[r] |= l.slipping[r];  // bounds hold as well, or the load could not be borne
  hold(problem, rigid, active, x, l.value);
  for (Eigen::Index r = 0; r < x.size(); ++r) active[r] &= !l.slipping[r];
  if (active == l.active) return l;
  const Linearisation flagged = from_flags(problem, active, rho);
  for (int r = 0; r < problem.rows(); ++r)
    if (active[r] != l.active[r]) l.set(r, flagged.y[r], {flagged.value[r], flagged.slope[r]});
  return l;
}

End SetIteration::iterate(int most, int patience) {
  seen_.clear();
  double nearest = INFINITY;
  int since = 0;
  for (int k = 0; k < most && (k < patience || !crawls()); ++k) {
    if (monitor.stop()) return End::interrupted;
    if (const auto end = advance()) return *end;
    if (problem.friction.empty()) continue;
    since = l.off < nearest ? 0 : since + 1, nearest = std::min(nearest, l.off);
    if (since >= kFrictionPatience) break;
  }
  return End::exhausted;
}

bool SetIteration::crawls() const {
  const auto& h = result.history;
  return h.size() > kStretch && 2 * h.back().changed > h[h.size() - 1 - kStretch].changed;
}

/// One linear solve and the next linearisation; nothing where it is new.
std::optional<End> SetIteration::advance() {
  ++result.iterations;
  result.active_sets.push_back(l.active);
  if (!problem.friction.empty()) result.slipping = l.slipping;
  seen_.insert(l.fingerprint());
  Vector next_lambda, next_x;
  std::optional<End> failed;
  try {
    if (!step->solve(l, next_lambda, next_x)) failed = End::singular;
  } catch (const Interrupted&) {
    failed = End::interrupted;
  }
  if (failed) {
    step->go_back(0);  // the state stays that of the last solve
    return failed;
  }
  std::swap(lambda, next_lambda);
  std::swap(x, next_x);
  alpha.reset();
  const bool whole = problem.friction.empty() || result.iterations <= kUnguided || !shorten(next_lambda, next_x);
  Linearisation next = follow();
  while (whole && (at_rest(next) || repeats(next)) && step->sharpen(lambda, x)) {
    next = follow();
    seen_.clear();  // rougher states may have had other branches
  }
  record(next);
  if (whole && at_rest(next)) {
    if (!problem.friction.empty()) result.active_sets.push_back(next.active), result.slipping = next.slipping;
    if (!screws || !screws->pulls(lambda, rounding_of_screws())) return End::confirmed;
    return move_screws() ? std::nullopt : std::optional(End::misplaced);
  }
  l = std::move(next);
  return repeats(l) ? std::optional(End::cycle) : std::nullopt;
}

/// ‖λ − P(λ + ρx)‖ beyond rounding, of ‖λ‖, or of the least that counts as a force: where a load ends λ may go to 0.
double SetIteration::off() const {
  double force = lambda.norm();
  for (std::size_t p = 0; p < static_cast<std::size_t>(measure.parts().count); ++p) force = std::max(force, measure.least_force(p));
  const Vector beyond = problem::distances_from_laws(problem, x, lambda, rho).cwiseAbs() - rounding(lambda, x).force;
  return beyond.cwiseMax(0).norm() / (force > 0 ? force : 1);
}

/// Halves the step from (λ, x) until the new state is nearer to its laws than (λ, x). False if the whole step is kept, because it
/// leads nearer, or because no shorter step does either.
bool SetIteration::shorten(const Vector& from_lambda, const Vector& from_x) {
  const auto off = [&] { return problem::distances_from_laws(problem, x, lambda, rho).norm(); };
  const Vector whole_lambda = lambda, whole_x = x, none = problem::distances_from_laws(problem, from_x, from_lambda, rho);
  double length = 1;
  for (int k = 0; k <= kHalvings; ++k, length /= 2) {
    lambda = from_lambda + length * (whole_lambda - from_lambda), x = from_x + length * (whole_x - from_x);
    if (off() > (1 - 1e-4 * length) * none.norm()) continue;
    if (length < 1) step->go_back(length);
    return length < 1;
  }
  lambda = whole_lambda, x = whole_x;
  return false;
}

/// Points that slip have a direction and a bound, which go on where pieces stay.
bool SetIteration::repeats(const Linearisation& next) const { return problem.friction.empty() && seen_.count(next.fingerprint()); }

/// With friction, whose steps converge but do not end.
bool SetIteration::at_rest(const Linearisation& next) const {
  return problem.friction.empty() ? changed_.empty() : next.off <= settings.tol;
}

/// What the state asks for, and which rows that changes.
Linearisation SetIteration::follow() {
  Linearisation next = held(linearise(problem, lambda, x, rho, &l, rounding(lambda, x)), x);
  if (!problem.friction.empty()) next.off = off();
  changed_ = next.changed(l);
  return next;
}

void SetIteration::record(const Linearisation& next) {
  IterationInfo info;
  info.iteration = result.iterations;
  info.active = next.active_count();
  for (const auto& [group, k, first, n] : problem.friction_points())
    info.stick += next.active[first] != 0, info.active -= group.components * next.active[first];
  info.slip = static_cast<int>(next.slips.size());
  info.changed = static_cast<int>(changed_.size());
  info.residual = problem::natural_residual(problem, x, lambda, rho);
  info.seconds = watch_.seconds();
  result.history.push_back(info);
  monitor.iteration(info);
}

std::string SetIteration::places() const {
  std::string out;
  for (std::size_t k = 0; k < changed_.size() && k < 4; ++k)
    out += (k ? ", " : "") + problem.name_of(changed_[k]);
  if (changed_.size() > 4) out += text(" and ", changed_.size() - 4, " more");
  return out;
}

problem::State SetIteration::state() {
  if (settled) return {*settled, lambda};
  return {alpha ? problem::Displacement(condensed_->recover(lambda, *alpha)) : step->recover(), lambda};
}

}  // namespace dotyk::solver
