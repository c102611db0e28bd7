#include "solver/rows/uzawa_pdas.hpp"

#include <algorithm>
#include <deque>
#include <optional>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/lu.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "problem/uniqueness.hpp"
#include "solver/rows/projection.hpp"
#include "solver/rows/stationary_iteration.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using problem::FrictionGroup;
using problem::RowGroup;

/// Iterations without a fall of the residual, each of them two dense factorisations.
constexpr int kAlternationPatience = 200;
/// Cycles up to this length are recognised, by iterates that return: up to rounding, and much closer than the
/// residual, which slow convergence moves by as little.
constexpr std::size_t kPeriods = 16;
constexpr double kRounding = 1e-14, kReturned = 1e-3;

class Alternation {
 public:
  explicit Alternation(RowIteration& it) : it_(it), equilibrium_(equilibrium_of(it)) {}

  double step_bound(const Vector& stiffness) const { return equilibrium_.step_bound(stiffness); }

  void begin(Vector rho) {
    rho_ = std::move(rho);
    load();
    move_to(it_, equilibrium_, it_.lambda());
  }

  void step() {
    Vector lambda = it_.lambda();
    lambda = solve(contact_alone(lambda, it_.jump()));
    lambda = solve(friction_alone(lambda, rows_->jump(lambda, Vector())));
    move_to(it_, equilibrium_, std::move(lambda));
  }

  void settle() {
    if (!equilibrium_.settle(it_.law_residual(), it_.lambda())) return;
    load();
    move_to(it_, equilibrium_, it_.lambda());
    earlier_.clear();
  }

  /// After how many iterations the iterate returns; 0 where it does not.
  std::size_t period() {
    const double close = std::min(kRounding * it_.lambda().norm(), kReturned * it_.law_residual());
    std::size_t found = 0;
    for (std::size_t p = 1; p <= earlier_.size() && found == 0; ++p)
      if ((it_.lambda() - earlier_[p - 1]).norm() <= close) found = p;
    earlier_.push_front(it_.lambda());
    if (earlier_.size() > kPeriods) earlier_.pop_back();
    return found;
  }

 private:
  /// The rows without rigid motions, at the present α.
  void load() {
    rows_.emplace(equilibrium_.W(), equilibrium_.x0());
    map_.emplace(it_.problem, *rows_, rho_);
  }

  NaturalMap::Value at(const Vector& lambda, const Vector& x) const {
    NaturalMap::Value v;
    v.y = lambda + map_->rho().cwiseProduct(x);
    v.projected = Vector::Zero(lambda.size());
    return v;
  }

  /// Steps 1a and 1b.
  NaturalMap::Value contact_alone(const Vector& lambda, const Vector& x) const {
    NaturalMap::Value v = at(lambda, x);
    const Vector bounds = friction_bounds(it_.problem, lambda);
    v.projected = project(it_.problem, v.y, map_->rho(), &bounds);
    for (const RowGroup& group : it_.problem.groups)
      for (int r = group.first; r < group.first + group.count; ++r) {
        const double slope = group.law->project(r - group.first, v.y[r], map_->rho()[r]).slope;
        if (slope != 0) v.slope.emplace_back(r, r, slope);
      }
    return v;
  }

  /// Steps 2a and 2b.
  NaturalMap::Value friction_alone(const Vector& lambda, const Vector& x) const {
    NaturalMap::Value v = at(lambda, x);
    v.projected = project(it_.problem, v.y, map_->rho());
    for (const FrictionGroup& group : it_.problem.friction)
      for (int k = 0; k < group.points(); ++k) {
        const int first = group.row(k);
        if (!(v.y.segment(first, group.components).norm() < group.bound(k, v.projected))) continue;
        for (int i = 0; i < group.components; ++i) v.slope.emplace_back(first + i, first + i, 1.0);
      }
    return v;
  }

  /// Steps 1c and 2c: λ of the linear problem.
  Vector solve(const NaturalMap::Value& v) const {
    const NaturalMap::System system = map_->linearise(v);
    Vector solved(0), lambda, alpha;
    if (system.matrix.size() > 0) {
      const algebra::Lu lu(system.matrix);
      // Rows that depend on each other: their multipliers of least norm.
      solved = lu.rcond() > 1e-15 ? lu.solve(system.right_side) : algebra::MinimumNorm(system.matrix).solve(system.right_side);
    }
    map_->take(system, solved, lambda, alpha);
    return lambda;
  }

  RowIteration& it_;
  Equilibrium equilibrium_;
  Vector rho_;
  std::optional<problem::CondensedProblem> rows_;
  std::optional<NaturalMap> map_;
  std::deque<Vector> earlier_;
};

}  // namespace

void UzawaPdas::require_treatable(const problem::Problem& problem) const {
  if (unit == Unit::report && problem::has_coulomb(problem))
    throw InputError("unit = \"report\" goes with given friction: the report scales friction forces by their bound, which Coulomb's has not before the pressure is known");
}

namespace {

/// What ρ multiplies in each row.
Vector units(const RowIteration& it, UzawaPdas::Unit unit) {
  if (unit == UzawaPdas::Unit::bound) return it.map.rho();
  Vector D = Vector::Ones(it.map.rho().size());
  if (unit == UzawaPdas::Unit::stiffness) return D;
  const std::vector<double>& measure = it.problem.measure;
  for (std::size_t r = 0; r < measure.size(); ++r)
    if (measure[r] > 0) D[static_cast<Eigen::Index>(r)] = measure[r];
  const Vector g = friction_bounds(it.problem, Vector::Zero(D.size()));
  Eigen::Index point = 0;
  for (const FrictionGroup& group : it.problem.friction)
    for (int k = 0; k < group.points(); ++k, ++point) D.segment(group.row(k), group.components).setConstant(g[point] * g[point]);
  return D;
}

}  // namespace

void UzawaPdas::iterate(RowIteration& it) const {
  Alternation alternation(it);
  const Vector stiffness = units(it, unit);
  const double bound = alternation.step_bound(stiffness), length = unit == Unit::bound ? rho * bound : rho;
  it.remark(text("rho = ", length, " for Uzawa's bound 2/λ_max of ", bound,
                 unit == Unit::bound ? " (in units of 1/W_rr)" : unit == Unit::stiffness ? " (force per displacement)" : " (the report's units)",
                 length >= bound ? ", beyond which sets need not settle" : ""));
  alternation.begin(length * stiffness);
  while (it.next()) {
    alternation.step();
    if (it.record()) break;
    if (const std::size_t period = alternation.period()) {
      it.give_up(period == 1 ? text("the iteration repeats itself at a state that is no solution")
                             : text("the iterates return every ", period, " iterations: a cycle"));
      break;
    }
    alternation.settle();
    if (it.stalled(kAlternationPatience)) break;
  }
}

}  // namespace dotyk::solver
