#include "solver/rows/row_iteration.hpp"

#include "algebra/dense/decompositions.hpp"
#include "algebra/direct/stop_factoring.hpp"
#include "solver/active/refine.hpp"
#include "solver/core/require_solvable.hpp"
#include "solver/core/settle.hpp"

namespace dotyk::solver {

using algebra::Vector;
using problem::CondensedProblem;
using problem::Problem;

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kSumRoundings = 128;    // of the solve that made λ

RowMeasure::RowMeasure(const problem::Problem& problem, const problem::CondensedProblem& condensed)
    : c_(problem.c), measure_(problem, condensed) {}

Vector RowMeasure::forces(const Vector& lambda) const {
  std::vector<double> of_part = measure_.parts().norm(lambda);
  for (std::size_t p = 0; p < of_part.size(); ++p) of_part[p] = std::max(of_part[p], measure_.least_force(p));
  return by_row(of_part);
}

Vector RowMeasure::by_row(const std::vector<double>& of_part) const {
  return Eigen::Map<const Vector>(of_part.data(), static_cast<Eigen::Index>(of_part.size()))(measure_.parts().of_row);
}

RowMeasure::Rho RowMeasure::rho(const Vector& lambda, const Vector& x, Vector rounding) const {
  if (x.size() == 0) return {x, x};
  // Row by row: where one body goes far, others' gaps are known as before.
  const problem::Parts& parts = measure_.parts();
  const std::vector<double> force = parts.greatest(lambda), stiffest = parts.greatest(stiffness());
  std::vector<double> moved = parts.greatest(x + c_);
  for (std::size_t p = 0; p < moved.size(); ++p)
    if (stiffest[p] > 0) moved[p] = std::max(moved[p], force[p] / stiffest[p]);
  Vector rho = stiffness();
  for (Eigen::Index r = 0; r < x.size(); ++r) {
    const int part = parts.of_row[r];
    if (const double length = std::max(moved[part], std::abs(c_[r])); length > 0) rho[r] = std::max(rho[r], force[part] / length);
  }
  return {rho, std::move(rounding)};
}

RowIteration::RowIteration(const Problem& on, const CondensedProblem& rows, const Settings& settings, double rho,
                           Monitor& monitor)
    : RowIteration(on, RowMeasure(on, rows), rows, settings, rho, monitor) {}

RowIteration::RowIteration(const Problem& on, const RowIteration& outer, const Settings& settings, double rho, Monitor& monitor)
    : RowIteration(on, outer.measure_, outer.condensed, settings, rho, monitor) {
  if (!outer.centred_) return;
  centred_ = outer.centred_, centre_ = outer.centre_, u_ = outer.u_, lost_ = outer.lost_;
  map_ = NaturalMap(problem, *centred_, Vector(map_.rho()));
  move_to(at_);
  recorded_ = value_;
}

RowIteration::RowIteration(const Problem& on, RowMeasure measure, const CondensedProblem& rows, const Settings& settings, double rho,
                           Monitor& monitor)
    : problem(on), condensed(rows), measure_(std::move(measure)), map_(on, rows, rho * measure_.stiffness()), settings_(settings),
      monitor_(monitor), allowed_(settings.max_iterations) {
  move_to({Vector::Zero(rows.rows()), Vector::Zero(rows.kernel_size())});
  recorded_ = value_;
  first_ = at_;
}

double RowIteration::off_laws(bool beyond_rounding) const {
  const auto [rho, rounding] = this->rho();
  const Vector force = forces();
  const Vector off = problem::distances_from_laws(problem, value_.x, at_.lambda, rho, beyond_rounding ? rounding : Vector());
  const double all = std::hypot(off.cwiseQuotient(force).norm(), map_.balancing(value_.unbalanced).cwiseQuotient(force).norm());
  return beyond_rounding ? std::max(0.0, all - kSumRoundings * kEps) : all;
}

double RowIteration::residual() const { return off_laws(true); }
bool RowIteration::at_rounding() const { return off_laws(false) > settings_.tol; }

Vector RowIteration::forces() const {
  return measure_.forces(at_.lambda).unaryExpr([](double f) { return f > 0 ? f : 1; });
}

void RowIteration::move_to(Iterate iterate) {
  at_ = std::move(iterate);
  value_ = map.at(at_);
}

void RowIteration::begin_at(Iterate iterate) {
  move_to(std::move(iterate));
  recorded_ = value_;
  first_ = best_ = at_, best_u_.resize(0);
  best_residual_ = residual();
  begun_ = true;
}

bool RowIteration::next() {
  if (result_.iterations >= allowed_ || monitor_.stop()) return false;
  ++result_.iterations;
  return true;
}

Vector RowIteration::recovered(const Iterate& of) const {
  if (!centred_) return condensed.recover(of.lambda, of.alpha);
  return u_ + condensed.response(problem.B.transpose() * (centre_.lambda - of.lambda), of.alpha - centre_.alpha);
}

Vector RowIteration::displacements(const Iterate& of) const {
  Vector u = recovered(of);
  const Vector left = out_of_balance(problem, {u, of.lambda});
  Vector better = u + condensed.response(left, Vector::Zero(of.alpha.size()));
  return out_of_balance(problem, {better, of.lambda}).norm() < 0.1 * left.norm() ? better : u;  // else it is rounding
}

/// What rounding of the jump makes of the forces, relative.
double RowIteration::lost() const {
  const auto [rho, rounding] = this->rho();
  return rounding.cwiseProduct(rho).cwiseQuotient(forces()).norm();
}

/// Goes on about the iterate's displacements, where less is lost to rounding about them than about the last ones.
void RowIteration::centre() {
  if (problem.blocks.empty() || !at_.finite() || lost() <= std::max(settings_.tol, 2 * lost_)) return;
  if (Vector u = displacements(at_); u.allFinite()) centre(at_, std::move(u));
}

void RowIteration::centre(const Iterate& at, Vector u) {
  u_ = std::move(u), centre_ = at;
  centred_ = std::make_shared<problem::CondensedProblem>(condensed.centred(problem, at.lambda, at.alpha, u_));
  map_ = NaturalMap(problem, *centred_, Vector(map_.rho()));
  move_to(at);
  lost_ = lost();
}

void RowIteration::go_to_best() {
  if (best_u_.size() > 0) return centre(best_, best_u_);
  move_to(best_);
}

bool RowIteration::record(IterationInfo info) {
  centre();
  info.iteration = result_.iterations;
  info.active = value_.active;
  info.stick = value_.stick;
  info.slip = value_.slip;
  info.changed = value_.differences(recorded_);
  info.residual = residual();
  info.seconds = watch_.seconds();
  result_.history.push_back(info);
  record_active_set();
  monitor_.iteration(info);
  recorded_ = value_;
  if (info.residual < best_residual_) {
    best_ = at_, best_residual_ = info.residual;
    best_u_ = centred_ && !problem.blocks.empty() ? displacements(at_) : Vector();
  }
  if (info.residual < 0.99 * milestone_) milestone_ = info.residual, at_milestone_ = info.iteration;
  return result_.converged = info.residual <= settings_.tol;
}

void RowIteration::grant(int more) {
  allowed_ = result_.iterations + more;
  result_.converged = false;
  result_.reason.clear();
  milestone_ = std::numeric_limits<double>::infinity();
  map_ = NaturalMap(problem, rows(), measure_.stiffness());
  if (best_.lambda.size()) {
    go_to_best();
    best_residual_ = residual();
  }
  move_to(first_);
}

bool RowIteration::stalled(int patience) {
  // Forces of the size of what the free jump meets, or of the best state's, are the measure.
  const double measure = best_.lambda.norm() + map.rho().cwiseProduct(condensed.x0()).norm();
  if (!(at_.lambda.norm() <= 1e9 * measure)) {
    give_up(text("the iterates diverge: the multipliers have grown to ", at_.lambda.norm()));
    return true;
  }
  if (result_.iterations - at_milestone_ < patience) return false;
  give_up(text("the residual has not fallen for ", patience, " iterations"));
  return true;
}

void RowIteration::record_active_set() {
  if (result_.active_sets.empty() || result_.active_sets.back() != value_.closed)
    result_.active_sets.push_back(value_.closed);
}

Result RowIteration::finish() {
  if (result_.converged)
    result_.reason = accepted_ ? text("the state is off its laws by no more than ", *accepted_) : at_rounding() ? "the residual is no more than rounding" : "the residual fell below tol";
  else if (result_.reason.empty())
    result_.reason = monitor_.stop() ? "interrupted; this is the state so far"
                                     : text("no convergence within ", result_.iterations, " iterations");
  for (const std::string& remark : remarks_) result_.reason += "; " + remark;
  if (!result_.converged && best_.lambda.size() && !(residual() <= best_residual_)) go_to_best();
  record_active_set();
  result_.state.lambda = at_.lambda;
  result_.slipping = value_.slipping;
  return std::move(result_);
}

namespace {

/// The amounts of rigid motion that come nearest to the state's jumps.
Vector rigid_motion_of(const problem::State& state, const Problem& problem, const CondensedProblem& condensed) {
  if (condensed.kernel_size() == 0) return Vector(0);
  const Vector none = Vector::Zero(condensed.kernel_size());
  const Vector jump = problem::jumps(problem, state.u);
  return algebra::least_squares(condensed.N(), Vector(jump - condensed.jump(state.lambda, none)));
}

/// Have bodies moved so far that the rounding error of their gaps, times the stiffness of the rows, is comparable to the forces of the first
/// iterate? Relative to such displacements every gap is small, and residuals say nothing.
bool astray(const RowIteration& iteration) {
  constexpr double kMost = 1e-3;
  const Vector& rho = iteration.map.rho();
  if (rho.size() == 0) return false;
  const double met = rho.cwiseProduct(iteration.condensed.x0()).norm() + iteration.condensed.e().norm();
  return !(iteration.rounding().cwiseProduct(rho).maxCoeff() <= kMost * met);
}

/// Rounding of the condensed problem may leave the state further from its laws and from equilibrium than the method does: more than `allowed`.
void refine_rounded(const RowIteration& iteration, double allowed, Result& result) {
  const Problem& problem = iteration.problem;
  if (!result.converged || problem.blocks.empty()) return;
  problem::Residual r = problem::residual(problem, result.state);
  if (r.equilibrium > kRounded) result.state.u = iteration.displacements(iteration.at()), r = problem::residual(problem, result.state);
  if (std::max(r.laws(), r.equilibrium) > allowed && refine(problem, iteration.condensed, result, r)) result.reason += "; refined from the displacements";
}

}  // namespace

/// Forces that are small beside the loads, where bodies end up out of each other's way, are known to rounding of the loads alone, and those of thin
/// bodies to rounding of stiffness times displacement.
bool RowIteration::accept() {
  constexpr double kRoundings = 100;  // of a product K u
  if (!converged() && best_residual_ <= settings_.tol) go_to_best(), result_.converged = true;  // what a method after it was to do better
  if (converged() || problem.blocks.empty() || astray(*this)) return converged();
  if (best_.lambda.size() && !(residual() <= best_residual_)) go_to_best();
  problem::State state{displacements(at_), at_.lambda};
  settle_on_springs(problem, result_.noise, state);
  const problem::Residual r = problem::residual(problem, state);
  const double allowed = std::min(result_.noise, std::max(kRounded, kRoundings * problem::rounding_of_equilibrium(problem, state)));
  if (!(r.laws() <= allowed && r.equilibrium <= allowed)) return false;
  accepted_ = r.laws();
  return result_.converged = true;
}

bool RowIteration::stands() const {
  if (!converged() || problem.blocks.empty()) return converged();
  return problem::distance_from_laws(problem, {displacements(at_), at_.lambda}) <= std::max(result_.noise, settings_.tol);
}

Result solve(const Problem& problem, const CondensedProblem& condensed, const RowMethod& method, Monitor& monitor) {
  method.require_treatable(problem);
  Stopwatch watch;
  RowIteration iteration = [&] {
    const algebra::StopFactoring stop(monitor);
    return RowIteration(problem, condensed, method, method.map_weight(), monitor);
  }();
  if (method.from) iteration.begin_at({method.from->lambda, rigid_motion_of(*method.from, problem, condensed)});
  if (method.from && iteration.residual() <= method.tol && iteration.next())
    iteration.record();  // nothing is left to do: a method whose residual does not fall at every step would first go away from there
  else
    try {
      const algebra::StopFactoring stop(monitor);
      method.iterate(iteration);
    } catch (const Interrupted&) {  // the best of its iterates is kept
    }
  if (!monitor.stop()) iteration.accept();
  Result result = iteration.finish();
  result.method = method.name();
  result.clock.iterate = watch.lap();
  result.state.u = iteration.recovered(iteration.at());
  refine_rounded(iteration, std::max(kRounded, method.tol), result);
  result.clock.recover = watch.lap();
  result.factor_bytes = condensed.factor_bytes();
  result.ordering = condensed.ordering();
  return result;
}

Result solve(const Problem& problem, const RowMethod& method, Monitor& monitor) {
  method.require_treatable(problem);
  problem::Clock clock;
  const auto [rigid, note] = require_solvable(problem, clock, monitor);
  problem::Condenser own;
  Result result;
  try {
    const CondensedProblem& condensed = (method.condenser ? *method.condenser : own).condense(problem, rigid, method.ordering, clock, monitor);
    result = solve(problem, condensed, method, monitor);
    if (!result.converged && !monitor.stop()) require_bearable(problem, condensed, monitor);
    if (method.hands_over() && result.converged && problem::distance_from_laws(problem, result.state) > result.noise)
      go_on_on_all_unknowns(problem, method, result, monitor);
  } catch (const problem::SingularStiffness&) {
    std::optional<Result> found = method.hands_over() ? on_all_unknowns(problem, method, method.start, std::numeric_limits<double>::infinity(), monitor) : std::nullopt;
    if (!found) throw;
    result = std::move(*found);
    result.reason += "; on all unknowns, since without contact the stiffness is singular to rounding";
  }
  if (!note.empty()) result.reason += "; " + note;
  clock.add_solve(result.clock);
  result.clock = clock;
  return result;
}

}  // namespace dotyk::solver
