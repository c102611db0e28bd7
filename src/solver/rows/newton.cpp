#include "solver/rows/newton.hpp"

#include <random>

#include "algebra/dense/dense.hpp"
#include "problem/uniqueness.hpp"
#include "solver/core/require_solvable.hpp"
#include "solver/core/treatable.hpp"
#include "solver/pieces/piece_search.hpp"
#include "solver/rows/coulomb_loop.hpp"
#include "solver/rows/projected_cg.hpp"
#include "solver/rows/proximal.hpp"
#include "solver/rows/psor.hpp"

namespace dotyk::solver {
namespace {

using algebra::Lu;
using algebra::Vector;

/// Newton's method has lost its way after so many iterations, or rounds of the fixed point iteration in their place: where it
/// converges it takes some ten, and few of these.
constexpr int kNewtonPatience = 40, kMostStuck = 3;
constexpr double kHoldingSpring = 3e-3;  // δ, against compliances of size 1
constexpr int kFreeSteps = 5;  // damped little
constexpr std::size_t kMemory = 5;  // merits that those are compared with
constexpr int kStepHalvings = 15;
constexpr int kFixedPointSteps = 20;  // the first time; twice as many each further time
constexpr int kDoublings = 6;
constexpr int kSearchSteps = 12;  // from the point of a programme
constexpr int kFromNear = 60;  // iterations of proximal from a solution with polygons for discs of friction

/// Newton steps from one iterate to the next, kept from going astray. The merit of an iterate is the norm of
/// the natural map in scaled unknowns (natural_map.hpp).
///
/// Damping: whole steps change many pieces at once, and may well increase the merit on the way. The first
/// few are damped only where it would exceed all of its last values twice; later ones until it decreases.
///
/// Singular derivatives: where the pieces leave a rigid motion free (nothing closed, all slips), springs hold
/// the bodies where they are: Qᵀv = ê becomes Qᵀv + δ(a − a₀) = ê, a step of the proximal point method,
/// whose derivative is regular whatever the pieces. The springs are let go when its problem is nearly solved.
///
/// Where the derivative is singular for another reason (two contacts that stick at one node, Coulomb friction with a great
/// coefficient), the step is the least-squares solution of least norm. Where no damped step decreases the merit, steps of the fixed point iteration λ := λ + θ(P(λ + ρx) − λ) take over.
class NewtonStepper {
 public:
  NewtonStepper(RowIteration& iteration, bool watch) : it_(iteration), watch_(watch) {}

  /// Moves to the solution of the problem linearised in `v`, where it has one.
  void start(const NaturalMap::Value& v) {
    Iterate solution;
    if (linear_solve(v, solution)) it_.move_to(std::move(solution));
    anchor_.resize(0);
    held_ = 0;
  }

  void step() {
    if (held() && merit() < 0.1 * it_.value().unbalanced.norm()) let_go();
    Iterate solution;
    if (linear_solve(it_.value(), solution) && damped_step_to(solution)) return;
    ++stuck_;
    fixed_point_steps();
  }

  /// Of the last step's derivative G: exact when watched, else 1/‖G⁻¹‖₁ as estimated from its factors. 1, that
  /// of the identity, where everything is open.
  double singular_value() const { return singular_value_; }
  /// Rounds of the fixed point iteration.
  int stuck() const { return stuck_; }

  /// Remarks what had to be done beyond Newton steps.
  void remark() const {
    const auto say = [&](int count, const char* what) {
      if (count > 0) it_.remark(text(count, count == 1 ? " step " : " steps ", what));
    };
    say(held_, "held the bodies by springs, where slip or gaps left them free and the derivative singular");
    say(stuck_, "of the fixed point iteration where no Newton step came nearer");
  }

 private:
  bool held() const { return anchor_.size() > 0; }

  void let_go() {
    anchor_.resize(0);
    merits_.clear();
  }

  double merit() const {
    const NaturalMap::Value& v = it_.value();
    if (!held()) return std::hypot(v.scaled_norm, v.unbalanced.norm());
    return std::hypot(v.scaled_norm, (v.unbalanced - kHoldingSpring * (it_.map.scaled_alpha(it_.alpha()) - anchor_)).norm());
  }

  bool linear_solve(const NaturalMap::Value& v, Iterate& solution) {
    NaturalMap::System system = it_.map.linearise(v);
    singular_value_ = 1;
    Vector found(0);
    if (system.matrix.size() > 0) {
      Lu lu(system.matrix);
      double least = lu.inverse_norm_reciprocal();
      singular_value_ = watch_ ? algebra::smallest_singular_value(system.matrix) : least;
      if (NaturalMap::singular(least) && !held() && it_.alpha().size() > 0) {
        anchor_ = it_.map.scaled_alpha(it_.alpha());
        merits_.clear();
      }
      if (held()) {
        ++held_;
        system.hold(kHoldingSpring, anchor_);
        lu = Lu(system.matrix);
        least = lu.inverse_norm_reciprocal();
      }
      found = NaturalMap::solved(system, lu, least);
    }
    solution = it_.map.take(system, found);
    return solution.finite();
  }

  bool damped_step_to(const Iterate& solution) {
    const bool free = it_.iterations() <= kFreeSteps;
    merits_.push_back(merit());
    if (const std::size_t kept = free ? kMemory : 1; merits_.size() > kept)
      merits_.erase(merits_.begin(), merits_.end() - static_cast<std::ptrdiff_t>(kept));
    const double allowed = (free ? 2 : 1) * *std::max_element(merits_.begin(), merits_.end());
    const Iterate from = it_.at(), way = solution - from;
    double length = 1;
    for (int halving = 0; halving <= kStepHalvings; ++halving, length /= 2) {
      it_.move_to(from + length * way);
      if (merit() <= (1 - 1e-4 * length) * allowed) return true;
    }
    return merit() == 0;
  }

  void fixed_point_steps() {
    const int steps = kFixedPointSteps << std::min(stuck() - 1, kDoublings);
    const double theta = 1 / std::max(1.0, it_.map.greatest_compliance());
    const Vector a = it_.map.scaled_alpha(it_.alpha());
    const auto at = [&](const Vector& lambda) { return Iterate{lambda, it_.map.alpha(a + it_.map.unbalanced(lambda))}; };
    Vector lambda = it_.lambda();
    for (int k = 0; k < steps; ++k) lambda += theta * (it_.map.at(at(lambda)).projected - lambda);
    if (!lambda.allFinite()) return;
    it_.move_to(at(lambda));
    let_go();
  }

  RowIteration& it_;
  const bool watch_;
  double singular_value_ = 1;
  std::vector<double> merits_;  ///< the last few
  Vector anchor_;               ///< a₀ of the springs; empty: none
  int held_ = 0, stuck_ = 0;
};

/// Moves to random multipliers and rigid motions, in a box sized by those of the iterate.
void scatter(RowIteration& iteration, unsigned seed) {
  std::mt19937 engine(seed);
  const auto between = [&](double a, double b) { return a + (b - a) * (engine() >> 8) / 16777216.0; };
  Vector v = iteration.map.scaled_lambda(iteration.lambda()), a(iteration.alpha().size());
  const double greatest = v.size() ? v.lpNorm<Eigen::Infinity>() : 0;
  const double size = (greatest > 0 ? greatest : 1) * std::pow(10, between(-1, 2));
  for (double& value : v) value = size * between(-1, 1);
  for (double& value : a) value = size * between(-1, 1);
  iteration.move_to({iteration.map.lambda(v), iteration.map.alpha(a)});
}

struct Alternative {
  std::shared_ptr<const RowMethod> method;
  int iterations;
};

/// With given friction or none the energy is convex: proximal, which then converges from everywhere, and projected_cg.
/// With Coulomb friction nothing is proved.
std::vector<Alternative> alternatives(const problem::Problem& problem) {
  const auto proximal = std::make_shared<Proximal>();
  if (problem::has_coulomb(problem)) {
    const auto loop = std::make_shared<CoulombLoop>();
    loop->inner = std::make_shared<Newton>();
    return {{proximal, 60}, {loop, 100}, {std::make_shared<Psor>(), 5000}};
  }
  if (tells_springs(problem)) return {{proximal, 100}, {std::make_shared<ProjectedCg>(), 5000}};
  return {{proximal, 100}, {std::make_shared<Psor>(), 5000}};
}

/// The last one, of small problems: takes the solution on whatever pieces, by a few Newton steps from the points of the search, or refuses the
/// problem where all are excluded, naming the motion (InputError). Says what it did.
std::string search(RowIteration& iteration, double tol) {
  iteration.monitor().phase("searching the pieces of the laws");
  InnerMonitor monitor(iteration.monitor());
  Settings settings;
  settings.tol = tol, settings.max_iterations = kSearchSteps;
  const auto newton_from = [&](Vector& lambda, Vector& alpha) {
    RowIteration on(iteration.problem, iteration, settings, 1, monitor);
    on.begin_at({lambda, alpha});
    NewtonStepper stepper(on, false);
    while (!on.converged() && stepper.stuck() == 0 && on.next()) {
      stepper.step();
      on.record();
    }
    lambda = on.lambda(), alpha = on.alpha();
    return on.converged();
  };
  const PieceSearch found = search_pieces(iteration.problem, iteration.condensed, newton_from, iteration.monitor());
  const std::string programmes = text(found.programmes, found.programmes == 1 ? " linear programme" : " linear programmes");
  if (found.verdict == PieceSearch::Verdict::none) {
    if (const auto motion = stopped_by_friction_alone(iteration.problem))
      refuse_unbearable(*motion, programmes + " exclude all states of contact, stick and slip");
    return text("; ", programmes, " exclude all states of contact, stick and slip: there is no solution");
  }
  if (found.verdict == PieceSearch::Verdict::undecided) return found.programmes == 0 ? "" : text(found.given_up ? "; gave up a search of pieces after " : "; tried a search of pieces, ", programmes);
  const bool exact = found.verdict == PieceSearch::Verdict::found;
  iteration.grant(exact ? 1 : kFromNear);
  iteration.move_to({found.lambda, found.alpha});
  if (!exact) Proximal().iterate(iteration);
  else if (iteration.next()) iteration.record();
  return text(iteration.converged() ? "; solved by a search of pieces, " : "; tried a search of pieces, ", programmes, exact ? "" : ", and proximal from there");
}

/// Where Newton's method has lost its way, other methods begin where it began, each with iterations of its own. The reason says what was tried.
void hand_over(RowIteration& iteration, double tol) {
  const bool coulomb = problem::has_coulomb(iteration.problem);
  if (coulomb) require_bearable(iteration.problem, iteration.condensed, iteration.monitor());
  std::string tried = text("newton lost its way in ", iteration.iterations(), " iterations");
  for (const Alternative& next : alternatives(iteration.problem)) {
    if (iteration.monitor().stop()) break;
    const int before = iteration.iterations();
    iteration.grant(next.iterations);
    iteration.monitor().phase(tried + "; " + next.method->name());
    next.method->iterate(iteration);
    const bool ended = iteration.stands();
    tried += text(ended ? "; ended by " : "; tried ", next.method->name(), ", ", iteration.iterations() - before, " iterations");
    if (ended) break;
  }
  if (!iteration.stands() && !iteration.monitor().stop() && coulomb) tried += search(iteration, tol);
  iteration.remark(tried);
}

}  // namespace

void Newton::iterate(RowIteration& iteration) const {
  NewtonStepper stepper(iteration, watch);
  // Everything that touches at rest (or is told to) sticks: one linear problem.
  if (!iteration.begun()) stepper.start(iteration.map.sticking(start));
  if (seed) scatter(iteration, *seed);
  bool astray = false;
  // On the right pieces a step of given friction in the plane is exact; others converge quadratically.
  while (iteration.next()) {
    stepper.step();
    if (iteration.record({.singular_value = stepper.singular_value()})) break;
    astray = iteration.iterations() >= kNewtonPatience || stepper.stuck() >= kMostStuck;
    if (astray) break;
  }
  stepper.remark();
  if (astray) hand_over(iteration, tol);
}

}  // namespace dotyk::solver
