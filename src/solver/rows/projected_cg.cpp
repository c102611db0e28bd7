#include "solver/rows/projected_cg.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.hpp"
#include "solver/bounded/face.hpp"
#include "solver/rows/projection.hpp"
#include "solver/rows/stationary_iteration.hpp"
#include "solver/core/treatable.hpp"

namespace dotyk::solver {
namespace {

using algebra::Vector;

/// γ against λ_max(W): a few eigenvalues beyond the others cost conjugate gradients as many steps.
constexpr double kWeight = 10;
/// The inner problem's residual against the outer error at which bounds and equilibrium are updated.
constexpr double kInnerPrecision = 0.1;
/// Fixed steps, of the bound 2/λ_max.
constexpr double kStep = 0.95;

class ProjectedCgRun {
 public:
  explicit ProjectedCgRun(RowIteration& it)
      : it_(it), equilibrium_(equilibrium_of(it, kWeight)), coulomb_(bounds_depend_on_normal(it.problem)) {
    step_ = kStep * equilibrium_.step_bound(it.map.rho()) * it.map.rho();
    start(it.lambda());
  }

  void iterate() {
    face_.emplace(face());
    while (it_.next()) {
      if (!proportional() || !conjugate_step()) gradient_step();
      if (it_.record()) break;
      if (update_outer()) {
        ++updates_;
        direction_.resize(0);
      }
      if (it_.stalled()) break;
    }
    if (coulomb_) it_.remark(text("Coulomb's bounds were updated ", updates_, " times"));
  }

 private:
  /// Takes the bounds at λ, and λ into them.
  void start(const Vector& lambda) {
    bounds_ = friction_bounds(it_.problem, lambda);
    move_to(it_, equilibrium_, project(it_.problem, lambda, Vector::Zero(lambda.size()), &bounds_));
  }

  Face face() const { return Face(it_.problem, it_.lambda(), it_.jump(), it_.map.rho(), bounds_); }

  /// Where a fixed step goes from (λ, x).
  Vector projected(const Vector& lambda, const Vector& x, const Vector& step) const {
    return project(it_.problem, lambda + step.cwiseProduct(x), step, &bounds_);
  }

  /// Is the projected gradient off the face no greater than along it?
  bool proportional() const {
    const Vector moved = projected(it_.lambda(), it_.jump(), step_) - it_.lambda();
    double along = 0, off = 0;
    for (Eigen::Index r = 0; r < moved.size(); ++r)
      (face_->free()[r] ? along : off) += moved[r] * moved[r] / step_[r];
    return off <= along && along > 0;
  }

  void gradient_step() {
    move_to(it_, equilibrium_, projected(it_.lambda(), it_.jump(), step_));
    face_.emplace(face());
    direction_.resize(0);
  }

  /// False, where it was, if the step cannot be made or would raise the energy (on a circle it might).
  bool conjugate_step() {
    const Vector &gradient = face_->gradient(), scaled = face_->tangential(it_.map.rho().cwiseProduct(gradient));
    Vector p = scaled;
    if (direction_.size()) {
      const double beta = scaled.dot(gradient - gradient_) / product_;
      if (beta > 0) p += beta * face_->tangential(direction_);
    }
    double slope = gradient.dot(p);
    if (!(slope > 0)) slope = gradient.dot(p = scaled);
    const Vector Wp = equilibrium_.W() * p;
    const double curvature = p.dot(Wp) + face_->curvature(p);
    const double room = face_->room(p), length = curvature > 0 ? slope / curvature : room;
    if (!(slope > 0) || !std::isfinite(length)) return false;
    if (!descend(face_->along(std::min(length, room), p))) return false;
    if (length >= room) {  // at the end of the face: a gradient step from there
      gradient_step();
      return true;
    }
    product_ = scaled.dot(gradient);
    gradient_ = gradient;
    direction_ = p;
    Face next = face();
    if (!next.same(*face_)) direction_.resize(0);
    face_.emplace(std::move(next));
    return true;
  }

  /// Moves unless that would raise the energy.
  bool descend(Vector target) {
    const Vector lambda = it_.lambda(), alpha = it_.alpha();
    const double before = energy();
    move_to(it_, equilibrium_, std::move(target));
    if (energy() <= before + 1e-13 * std::abs(before)) return true;
    it_.move_to(lambda, alpha);
    return false;
  }

  /// q without its constant: −½λᵀ(x₀' + x) + Σφ*(λ).
  double energy() const {
    const Vector& lambda = it_.lambda();
    double q = -0.5 * lambda.dot(equilibrium_.x0() + it_.jump());
    for (const problem::RowGroup& group : it_.problem.groups)
      for (int r = group.first; r < group.first + group.count; ++r)
        q += group.law->conjugate(r - group.first, lambda[r]);
    return q;
  }

  bool update_outer() {
    const Vector& lambda = it_.lambda();
    const double off = (friction_bounds(it_.problem, lambda) - bounds_).norm() + equilibrium_.unbalanced(lambda);
    if (off == 0 || (lambda - projected(lambda, it_.jump(), it_.map.rho())).norm() > kInnerPrecision * off) return false;
    equilibrium_.update(lambda);
    start(lambda);
    face_.emplace(face());
    return true;
  }

  RowIteration& it_;
  Equilibrium equilibrium_;
  bool coulomb_;
  Vector step_, bounds_;
  std::optional<Face> face_;
  Vector direction_, gradient_;  ///< of the last conjugate step; empty: start anew
  double product_ = 0;           ///< its gradient's scaled square
  int updates_ = 0;
};

}  // namespace

void ProjectedCg::require_treatable(const problem::Problem& problem) const { require_springs(problem, name()); }

void ProjectedCg::iterate(RowIteration& iteration) const { ProjectedCgRun(iteration).iterate(); }

}  // namespace dotyk::solver
