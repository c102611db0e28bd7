#include "algebra/krylov/conjugate_gradient.hpp"

#include <algorithm>
#include <cmath>

#include "base/memory.hpp"
#include "base/stopwatch.hpp"

namespace dotyk::algebra {
namespace {

/// Room for one more column than `count`, twice as much where there is none left. Throws InputError where memory does not suffice.
void grow(DenseMatrix& columns, Eigen::Index rows, Eigen::Index count) {
  if (count < columns.cols()) return;
  const Eigen::Index room = std::max<Eigen::Index>(16, 2 * count);
  require_memory(8.0 * static_cast<double>(rows) * static_cast<double>(room), "the directions kept for further systems");
  columns.conservativeResize(rows, room);
}

enum class End { met, most, stopped };

class Run {
 public:
  Run(const Preconditioner& C, const CgSettings& settings, Monitor& monitor, const CgMemory& memory)
      : C_(C), monitor_(monitor), memory_(memory), tolerance_(settings.tolerance), most_(settings.limit(C.size())) {}

  /// x̂ for the residual b of K x = b; a first run of a system is what a record is of. Ends at the tolerance, where rounding
  /// lets this run go no further (b by 32 ε), and where no direction is left.
  End solve(const Vector& b, Vector& x, bool first) {
    Vector r = C_.forward(b);
    x = memory_.basis ? memory_.basis->solve(r) : Vector::Zero(r.size());
    LanczosRecord* record = first ? memory_.record : nullptr;
    if (record) record->start(r);
    ratio_ = 0;
    goal_ = std::max(tolerance_, kCgRounding * b.norm());
    Vector p = r;
    double rho = r.squaredNorm();
    while (!near(r)) {
      if (iterations_ >= most_) return End::most;
      if (monitor_.stop()) return End::stopped;
      if (!conjugate(p)) return End::met;
      const double alpha = step(p, x, r);
      if (record) record->advance(alpha, r);
      const double next = r.squaredNorm();
      p = r + next / rho * p;
      rho = next;
    }
    return End::met;
  }

  int iterations() const { return iterations_; }

 private:
  /// False where p is in the basis's span.
  bool conjugate(Vector& p) const {
    return !memory_.basis || !(memory_.conjugate || memory_.store) || memory_.basis->conjugate(p);
  }

  double step(const Vector& p, Vector& x, Vector& r) {
    const Vector w = C_.apply(p);
    const double curvature = p.dot(w);
    if (!(curvature > 0) || !std::isfinite(curvature))
      throw InputError(text("conjugate gradients: the matrix is not positive definite (p'Kp = ", curvature, ")"));
    const double alpha = p.dot(r) / curvature;
    x += alpha * p;
    r -= alpha * w;
    if (memory_.store) memory_.basis->add(p, w);
    IterationInfo info;
    info.iteration = ++iterations_;
    info.residual = ratio_ * r.norm();
    info.seconds = watch_.seconds();
    monitor_.iteration(info);
    return alpha;
  }

  /// Is ‖C r̂‖ at the goal?
  bool near(const Vector& r) {
    const double norm = r.norm();
    if (norm == 0) return true;
    if (ratio_ > 0 && iterations_ % 8 != 0 && ratio_ * norm > 4 * goal_) return false;
    const double lifted = C_.lift(r).norm();
    ratio_ = lifted / norm;
    return lifted <= goal_;
  }

  const Preconditioner& C_;
  Monitor& monitor_;
  const CgMemory& memory_;
  Stopwatch watch_;
  double tolerance_, goal_ = 0;
  int most_, iterations_ = 0;
  double ratio_ = 0;  ///< ‖C r̂‖/‖r̂‖ where it was last formed; 0: not yet
};

std::string reason(End end, int iterations, double residual, double tolerance) {
  if (residual <= tolerance) return text("residual ", residual, " after ", iterations, " iterations");
  if (end == End::most) return text("the residual is ", residual, " after ", iterations, " iterations, the most allowed");
  if (end == End::stopped) return text("stopped after ", iterations, " iterations, residual ", residual);
  return text("rounding: the residual stays at ", residual);
}

}  // namespace

bool ConjugateBasis::conjugate(Vector& p) const {
  for (int twice = 0; twice < 2 && count_ > 0; ++twice) {
    const double before = p.norm();
    p -= directions() * (products().transpose() * p);
    if (p.norm() > before / 2) return true;
  }
  return count_ == 0;
}

Vector ConjugateBasis::solve(Vector& r) const {
  Vector x = Vector::Zero(r.size());
  for (int twice = 0; twice < 2 && count_ > 0; ++twice) {
    const Vector part = directions().transpose() * r;
    x += directions() * part;
    r -= products() * part;
  }
  return x;
}

void ConjugateBasis::add(const Vector& p, const Vector& w) {
  grow(p_, p.size(), count_);
  grow(w_, p.size(), count_);
  const double norm = std::sqrt(p.dot(w));
  p_.col(count_) = p / norm;
  w_.col(count_++) = w / norm;
}

void LanczosRecord::append(const Vector& r) {
  grow(q_, r.size(), steps_);
  norm_ = r.norm();
  if (norm_ > 0) q_.col(steps_) = r / norm_;
  else q_.col(steps_).setZero();
}

void LanczosRecord::start(const Vector& r) {
  *this = {};
  append(r);
}

void LanczosRecord::advance(double alpha, Vector& r) {
  if (diagonal_.size() <= steps_) {
    diagonal_.conservativeResize(2 * steps_ + 16);
    off_.conservativeResize(2 * steps_ + 16);
  }
  const auto known = q_.leftCols(steps_ + 1);
  const Vector part = known.transpose() * r;
  if (r.norm() > 0) loss_ = std::max(loss_, part.cwiseAbs().maxCoeff() / r.norm());
  r -= known * part;
  diagonal_[steps_] = 1 / alpha + (steps_ > 0 ? beta_ / alpha_ : 0);
  const double before = norm_;
  off_[steps_++] = -r.norm() / (alpha * before);
  append(r);
  alpha_ = alpha;
  beta_ = std::pow(norm_ / before, 2);
}

CgResult conjugate_gradient(const Preconditioner& C, const Vector& b, const CgSettings& settings, Monitor& monitor,
                            const CgMemory& memory) {
  const double size = b.stableNorm();
  if (!std::isfinite(size)) throw InputError("conjugate gradients: the right-hand side is not finite");
  CgResult result{.x = Vector::Zero(b.size()), .converged = true, .reason = "the right-hand side is zero"};
  if (size == 0) return result;
  Run run(C, settings, monitor, memory);
  const Vector unit = b / size;  // whose squares neither vanish nor overflow
  Vector r = unit, x;
  result.residual = 1;
  for (bool first = true;; first = false) {
    const End end = run.solve(r, x, first);
    const Vector corrected = result.x + Vector(C.backward(x));
    r = unit - Vector(C.times(corrected));
    const double residual = r.norm();
    const bool halved = residual <= result.residual / 2;
    if (residual < result.residual) result.x = corrected, result.residual = residual;
    result.converged = result.residual <= settings.tolerance;
    if (result.converged || end != End::met || !halved) {
      result.x *= size;
      result.iterations = run.iterations();
      result.reason = reason(end, result.iterations, result.residual, settings.tolerance);
      return result;
    }
  }
}

}  // namespace dotyk::algebra
