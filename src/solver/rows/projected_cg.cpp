#include "solver/rows/projected_cg.hpp"

#include "problem/uniqueness.hpp"
#include "solver/bounded/dual_laws.hpp"
#include "solver/bounded/mprgp.hpp"
#include "solver/core/treatable.hpp"
#include "solver/rows/equilibrium.hpp"
#include "solver/rows/projection.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;

/// γ against λ_max(W): a few eigenvalues beyond the others cost conjugate gradients as many steps.
constexpr double kWeight = 10;
/// The inner problem's residual against the outer error at which bounds and equilibrium are updated.
constexpr double kInnerPrecision = 0.1;

/// The dual energy in x = λ/D: D makes its Hessian D(W + C)D about 1 on the diagonal, C the compliances of the laws.
class ProjectedCgRun {
 public:
  explicit ProjectedCgRun(RowIteration& it)
      : it_(it), equilibrium_(it, kWeight), split_(opposed_springs(laws_of(it.problem))), scale_(split_.from.size()) {
    const Vector compliance = law_compliance(split_.problem);
    scale_ = (it.map.rho()(split_.from).cwiseInverse() + compliance).cwiseSqrt().cwiseInverse();
    added_ = scale_.cwiseAbs2().cwiseProduct(compliance);
    const double largest = added_.size() > 0 ? added_.maxCoeff() : 0;
    norm_ = 2 / equilibrium_.step_bound(joined(scale_.cwiseAbs2())) + largest;
  }

  void iterate() {
    start();
    int updates = 0;
    while (it_.next()) {
      const bool made = inner_->step() != Mprgp::Step::none;
      it_.move_to(equilibrium_.at(joined(scale_.cwiseProduct(inner_->x()))));
      if (it_.record() || it_.stalled()) break;
      if (update_outer()) {
        ++updates;
      } else if (!made) {
        it_.give_up("rounding is all that is left of the gradient");
        break;
      }
    }
    if (problem::has_coulomb(it_.problem)) it_.remark(text("Coulomb's bounds were updated ", updates, " times"));
  }

 private:
  /// Of the problem's rows, the sum over those that each was split into.
  Vector joined(const Vector& v) const {
    Vector sum = Vector::Zero(it_.problem.rows());
    for (Eigen::Index r = 0; r < v.size(); ++r) sum[split_.from[r]] += v[r];
    return sum;
  }

  /// From the iterate, with the bounds and the equilibrium there.
  void start() {
    bounds_ = friction_bounds(it_.problem, it_.lambda());
    set_.emplace(admissible(split_.problem, scale_, bounds_, Vector::Zero(scale_.size())));
    const auto hessian = [this](const Vector& v) -> Vector {
      const Vector moved = equilibrium_.W() * joined(scale_.cwiseProduct(v));
      return scale_.cwiseProduct(moved(split_.from)) + added_.cwiseProduct(v);
    };
    const Vector load = scale_.cwiseProduct(equilibrium_.x0()(split_.from));
    inner_.emplace(hessian, norm_, load, *set_, it_.lambda()(split_.from).cwiseQuotient(scale_));
  }

  /// Where the inner problem is solved well enough; false where it is not, or where nothing is off.
  bool update_outer() {
    const Vector &lambda = it_.lambda(), &rho = it_.map.rho();
    const double off = (friction_bounds(it_.problem, lambda) - bounds_).norm() + equilibrium_.unbalanced(lambda);
    const Vector projected = project(it_.problem, lambda + rho.cwiseProduct(it_.jump()), rho, &bounds_);
    if (off == 0 || (lambda - projected).norm() > kInnerPrecision * off) return false;
    equilibrium_.update(lambda);
    start();
    return true;
  }

  RowIteration& it_;
  Equilibrium equilibrium_;
  const OpposedSprings split_;
  Vector scale_, added_;  ///< D and D C D
  double norm_;           ///< of the Hessian, from above
  Vector bounds_;
  std::optional<SeparableSet> set_;
  std::optional<Mprgp> inner_;
};

}  // namespace

void ProjectedCg::require_treatable(const problem::Problem& problem) const { require_springs(problem, name()); }

void ProjectedCg::iterate(RowIteration& iteration) const { ProjectedCgRun(iteration).iterate(); }

}  // namespace dotyk::solver
