#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <optional>

#include "scene/model/model.hpp"
#include "scenes.hpp"
#include "solver/bounded/dual_laws.hpp"
#include "solver/feti/coarse_space.hpp"
#include "solver/feti/feti_preconditioner.hpp"
#include "solver/rows/projection.hpp"
#include "solver/bounded/smalbe.hpp"

namespace dotyk::test {

/// The quadratic program that FETI makes of a scene, put together here once more: H = PFP, b = Pd, Q, and the set of
/// admissible x = λ/D − λ̄.
struct FetiProgram {
  FetiProgram(const scene::Scene& scene, const problem::Decomposition& decomposition)
      : model(scene::build(scene, clock, quiet, {}, decomposition)),
        dual(model.problem, algebra::Ordering::automatic, clock, quiet), coarse(dual.G(), dual.e()),
        shift(coarse.particular()),
        bounds(solver::friction_bounds(model.problem, algebra::Vector::Zero(model.problem.rows()))),
        set(solver::admissible(model.problem, dual.scale(), bounds, shift)), face(coarse),
        spectrum(solver::dual_spectrum(dual, coarse, algebra::Ends::both, quiet)) {
    program.H = [this](const algebra::Vector& v) { return coarse.P(dual.apply(coarse.P(v))); };
    program.Q = [this](const algebra::Vector& v) { return coarse.Q(v); };
    program.norm = spectrum.bound();
    program.complementary = true;
    program.b = coarse.P(dual.d() - dual.apply(shift));
    program.set = &set;
  }
  FetiProgram(const FetiProgram&) = delete;

  solver::Smalbe settings(solver::Smalbe::Update update) {
    solver::Smalbe s;
    s.rho = 10;
    s.update = update;
    s.preconditioner = [this](const algebra::Vector& v, const algebra::Vector& x, const solver::SeparableSet::Gradients& at,
                              double rho) -> algebra::Vector {
      face.move_to(set, x, at, program.norm / rho);
      return face.W(v) / program.norm;
    };
    return s;
  }

  /// x with no contact force anywhere.
  algebra::Vector open() const {
    algebra::Vector x = algebra::Vector::Zero(dual.rows());
    x.head(model.problem.rows()) = -shift.head(model.problem.rows());
    return x;
  }

  /// Of the problem's rows, in its units.
  algebra::Vector multipliers(const algebra::Vector& x) const {
    return (x + shift).head(model.problem.rows()).cwiseProduct(dual.scale());
  }
  /// Of the problem's unknowns.
  algebra::Vector displacement(const algebra::Vector& x, const algebra::Vector& nu) const {
    const algebra::Vector v = dual.elastic(x + shift);
    return solver::average(dual.torn(), dual.moved(v, coarse.amounts(-dual.jump(v) - nu)));
  }

  Monitor quiet;
  problem::Clock clock;
  scene::Model model;
  solver::DualProblem dual;
  solver::CoarseSpace coarse;
  algebra::Vector shift, bounds;
  solver::SeparableSet set;
  solver::FaceCoarse face;
  algebra::SpectrumEnds spectrum;
  solver::EqualityProgram program;
};

/// Follows Smalbe on a FETI program, with L, its gradient and the kind of each inner step found from x alone, and requires of
/// every inner step that
///   λ is admissible: pressure ≥ 0, friction within its bound;
///   L does not grow, but for rounding of its sum and on the discs' circles;
///   from a proportional x no active component of an interval is let go (no discs), from another one x moves
///   along −β (components of intervals).
/// Proportionality within a thousandth of its limit may be either's.
class Follower {
 public:
  explicit Follower(FetiProgram& feti) : feti_(feti) {}

  int faces = 0, flips = 0, proportionings = 0, outer = 0;
  int most_flips = 0;  ///< of one component
  double least_M = INFINITY;

  /// `start`: x to start at, but for its projection on the set.
  solver::SmalbeResult run(const solver::Smalbe& settings, double tol, const algebra::Vector& start) {
    const double small = tol * feti_.program.b.norm(), equality = tol * (feti_.shift.norm());
    x_ = feti_.set.project(start);
    nu_ = algebra::Vector::Zero(x_.size());
    penalty_ = settings.update == solver::Smalbe::Update::penalty;
    flips_of_.assign(x_.size(), 0);
    const solver::SmalbeCaller caller{.done = [=](double g, double e, const algebra::Vector&) { return g <= small && e <= equality; },
                                      .inner = [this](const solver::SmalbeState& s) { return inner(s), true; },
                                      .outer = [this](const solver::SmalbeState& s) { ended(s); }};
    return minimise(feti_.program, settings, caller, x_, nu_);
  }

 private:
  using Place = solver::SeparableSet::Place;

  algebra::Vector times(const algebra::Vector& x, double rho) const { return feti_.program.H(x) + rho * feti_.program.Q(x); }

  /// The outer step that ended before this one changed ν; but for Update::penalty where ρ was raised instead.
  void follow_update(double rho) {
    if (change_.size() > 0 && !(penalty_ && rho != rho_)) nu_ += change_;
    if (change_.size() > 0) greatest_ = 0;
    change_.resize(0);
  }

  void inner(const solver::SmalbeState& s) {
    follow_update(s.rho);
    const algebra::Vector &x = s.inner.x(), b = feti_.program.b - nu_, g = times(x_, s.rho) - b, Ax = times(x, s.rho);
    check_feasible(x);
    const double before = 0.5 * x_.dot(g - b), now = 0.5 * x.dot(Ax) - b.dot(x);
    const double size = x.norm() * (feti_.dual.apply(feti_.coarse.P(x)).norm() + s.rho * s.equality + b.norm());
    greatest_ = std::max({greatest_, size, std::abs(before)});
    REQUIRE(now <= before + 1e-15 * size + feti_.set.rounding(g));
    if (!feti_.set.has_discs()) REQUIRE(std::abs(now - s.lagrangian) <= 1e-13 * greatest_);
    const auto at = feti_.set.gradients(x_, g);
    check_kind(s.inner, at, x);
    count(at.face, s.inner);
    x_ = x;
  }

  void check_feasible(const algebra::Vector& x) const {
    REQUIRE(feti_.set.contains(x));
    const algebra::Vector lambda = feti_.multipliers(x);
    const double rounding = 1e-14 * (lambda.norm() + feti_.shift.norm() * feti_.dual.scale().maxCoeff());
    for (const auto& group : feti_.model.problem.groups)
      if (group.law->unilateral()) REQUIRE(lambda.segment(group.first, group.count).minCoeff() >= -rounding);
    Eigen::Index point = 0;
    for (const auto& group : feti_.model.problem.friction)
      for (int k = 0; k < group.points(); ++k, ++point)
        REQUIRE(lambda.segment(group.row(k), group.components).norm() <= feti_.bounds[point] + rounding);
  }

  void check_kind(const solver::Mprgp& method, const solver::SeparableSet::Gradients& at, const algebra::Vector& x) {
    const double chopped = at.chopped.squaredNorm(),
                 free = feti_.set.reduced_free(x_, at.free, method.fixed_step_length()).dot(at.free);
    if (std::abs(chopped - free) <= 1e-3 * free) return;
    const bool proportional = chopped < free;
    proportionings += !proportional;
    const algebra::Vector step = x - x_;
    const double alpha = -step.dot(at.chopped) / chopped;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      if (paired(i)) continue;
      if (!proportional) REQUIRE(std::abs(step[i] + alpha * at.chopped[i]) <= 1e-6 * step.norm());
      if (proportional && !feti_.set.has_discs() && at.face[i] == Place::active) REQUIRE(step[i] == 0);
    }
  }

  bool paired(Eigen::Index i) const {
    for (const auto& disc : feti_.set.discs())
      if (disc.first == i || disc.second == i) return true;
    return false;
  }

  void count(const std::vector<Place>& before, const solver::Mprgp& method) {
    int changed = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i] == method.face()[i]) continue;
      ++changed;
      most_flips = std::max(most_flips, ++flips_of_[i]);
    }
    flips += changed;
    faces += changed > 0;
  }

  void ended(const solver::SmalbeState& s) {
    if (s.inner.halt() == solver::Mprgp::Halt::none) REQUIRE(s.gradient <= s.M * s.equality * (1 + 1e-12));
    change_ = s.rho * feti_.program.Q(s.inner.x());
    rho_ = s.rho;
    least_M = std::min(least_M, s.M);
    ++outer;
  }

  FetiProgram& feti_;
  algebra::Vector x_, nu_, change_;
  bool penalty_ = false;
  double rho_ = 0, greatest_ = 0;
  std::vector<int> flips_of_;
};

}  // namespace dotyk::test
