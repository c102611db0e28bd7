#include "solver/rows/uzawa_pdas.hpp"

#include <deque>

#include "algebra/dense/decompositions.hpp"
#include "problem/uniqueness.hpp"
#include "solver/rows/equilibrium.hpp"
#include "solver/rows/projection.hpp"

namespace dotyk::solver {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;

/// Iterations without a fall of the residual, each of them two dense factorisations.
constexpr int kAlternationPatience = 200;
/// Cycles up to this length are recognised, by iterates that return: up to rounding, and much closer than the
/// residual, which slow convergence moves by as little.
constexpr std::size_t kPeriods = 16;
constexpr double kRounding = 1e-14, kReturned = 1e-3;

/// What ρ multiplies in each row.
Vector units(const RowIteration& it, UzawaPdas::Unit unit) {
  if (unit == UzawaPdas::Unit::bound) return it.map.rho();
  Vector D = Vector::Ones(it.map.rho().size());
  if (unit == UzawaPdas::Unit::stiffness) return D;
  const std::vector<double>& measure = it.problem.measure;
  for (std::size_t r = 0; r < measure.size(); ++r)
    if (measure[r] > 0) D[static_cast<Eigen::Index>(r)] = measure[r];
  for (const auto& [group, k, first, n] : it.problem.friction_points()) {
    const double g = group.law->bound(k, 0);
    D.segment(first, group.components).setConstant(g * g);
  }
  return D;
}

class Alternation {
 public:
  Alternation(RowIteration& it, Equilibrium& equilibrium, Vector rho) : it_(it), equilibrium_(equilibrium), rho_(std::move(rho)) {
    load();
    it_.move_to(equilibrium_.at(it_.lambda()));
  }

  void step() {
    const Vector lambda = solve(pieces(it_.lambda(), it_.jump(), true));
    it_.move_to(equilibrium_.at(solve(pieces(lambda, rows_->jump(lambda, Vector()), false))));
  }

  void settle() {
    if (!equilibrium_.settle(it_)) return;
    load();
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

  /// Steps 1a and 1b, of `contact` alone, or 2a and 2b, of friction alone.
  NaturalMap::Value pieces(const Vector& lambda, const Vector& x, bool contact) const {
    NaturalMap::Value v;
    v.y = lambda + map_->rho().cwiseProduct(x);
    const Vector bounds = friction_bounds(it_.problem, lambda);
    v.projected = project(it_.problem, v.y, map_->rho(), contact ? &bounds : nullptr);
    if (contact) {
      for (const auto& [law, k, r] : it_.problem.scalar_rows())
        if (const double slope = law.project(k, v.y[r], map_->rho()[r]).slope; slope != 0) v.slope.emplace_back(r, r, slope);
    } else {
      for (const auto& [group, k, first, n] : it_.problem.friction_points())
        if (v.y.segment(first, group.components).norm() < group.bound(k, v.projected))
          for (int i = first; i < first + group.components; ++i) v.slope.emplace_back(i, i, 1.0);
    }
    return v;
  }

  /// Steps 1c and 2c: λ of the linear problem.
  Vector solve(const NaturalMap::Value& v) const {
    const NaturalMap::System system = map_->linearise(v);
    const algebra::Lu lu(system.matrix);
    // Rows that depend on each other: their multipliers of least norm.
    return map_->take(system, lu.rcond() > 1e-15 ? lu.solve(system.right_side) : algebra::MinimumNorm(system.matrix).solve(system.right_side)).lambda;
  }

  RowIteration& it_;
  Equilibrium& equilibrium_;
  const Vector rho_;
  std::optional<problem::CondensedProblem> rows_;
  std::optional<NaturalMap> map_;
  std::deque<Vector> earlier_;
};

}  // namespace

void UzawaPdas::require_treatable(const problem::Problem& problem) const {
  if (unit == Unit::report && problem::has_coulomb(problem))
    throw InputError("unit = \"report\" goes with given friction: the report scales friction forces by their bound, which Coulomb's has not before the pressure is known");
}

void UzawaPdas::iterate(RowIteration& it) const {
  Equilibrium equilibrium(it);
  const Vector stiffness = units(it, unit);
  const double bound = equilibrium.step_bound(stiffness), length = unit == Unit::bound ? rho * bound : rho;
  it.remark(text("rho = ", length, " for Uzawa's bound 2/λ_max of ", bound,
                 unit == Unit::bound ? " (in units of 1/W_rr)" : unit == Unit::stiffness ? " (force per displacement)" : " (the report's units)",
                 length >= bound ? ", beyond which sets need not settle" : ""));
  Alternation alternation(it, equilibrium, length * stiffness);
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
