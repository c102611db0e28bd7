#include "solver/bounded/mprgp.hpp"

#include <cmath>
#include <limits>

namespace dotyk::solver {

using algebra::Vector;

namespace {

constexpr double kUnboundedStep = std::numeric_limits<double>::infinity();
/// ᾱ‖A‖ for intervals alone and with discs.
constexpr double kIntervalStep = 1.9, kDiscStep = 1;
/// Recurrences of g after which it is computed anew: one product more in a hundred.
constexpr int kRefresh = 100;
/// pᵀAp below this part of ‖A‖‖p‖² is none.
constexpr double kNoCurvature = 1e-14;
/// g is never known better than this part of ‖A‖‖x‖ + ‖b‖.
constexpr double kGradientRounding = 1e-15;
/// Where g^P is no greater than this times the noise of g, it is noise.
constexpr double kNoisyGradient = 10;
/// Noticed so often in succession, rounding is all that is left.
constexpr int kNoisySteps = 3;
/// So many steps without a lesser ‖g^P‖, already below kSmall (‖A‖‖x‖ + ‖b‖), are steps in rounding, too.
constexpr int kIdle = 2000;
constexpr double kSmall = 1e-11;
/// Projected steps tried, each half of the last. Under a great penalty the whole one seldom lowers q.
constexpr int kTries = 4;
/// A part that does not matter.
constexpr double kHardly = 0.05;

}  // namespace

Mprgp::Mprgp(LinearMap A, double norm, Vector b, const SeparableSet& set, Vector x, MprgpSettings settings)
    : A_(std::move(A)), norm_(norm), b_(std::move(b)), set_(set), settings_(std::move(settings)),
      x_(set.project(std::move(x))) {
  begin(x_.isZero(0) ? Vector(-b_) : Vector(times(x_) - b_));
}

void Mprgp::begin(Vector g) {
  set_gradient(std::move(g));
  q_ = 0.5 * x_.dot(g_ - b_);
  least_ = projected_gradient_norm();
  halt_ = std::isfinite(q_) && g_.allFinite() ? Halt::none : Halt::not_finite;
}

Vector Mprgp::times(const Vector& v) {
  ++products_;
  return A_(v);
}

void Mprgp::set_gradient(Vector g) {
  g_ = std::move(g);
  gradients_ = set_.gradients(x_, g_);
}

double Mprgp::projected_gradient_norm() const { return std::hypot(gradients_.free.norm(), gradients_.chopped.norm()); }

double Mprgp::fixed_step_length() const { return norm_ > 0 ? (set_.has_discs() ? kDiscStep : kIntervalStep) / norm_ : 1; }

bool Mprgp::proportional() const {
  const Vector& phi = gradients_.free;
  return gradients_.chopped.squaredNorm() <=
         settings_.gamma * settings_.gamma * set_.reduced_free(x_, phi, fixed_step_length()).dot(phi);
}

/// A has a Rayleigh quotient that its norm must reach.
void Mprgp::raise_norm(double quotient) {
  if (quotient > 1.001 * norm_) norm_ = 1.1 * quotient;
}

Mprgp::Step Mprgp::stop(Halt why) {
  halt_ = why;
  return Step::none;
}

Mprgp::Step Mprgp::unbounded(Vector direction) {
  direction_ = std::move(direction);
  return stop(Halt::unbounded);
}

bool Mprgp::at_rounding() const {
  return projected_gradient_norm() <= std::max(kGradientRounding * (norm_ * x_.norm() + b_.norm()), kNoisyGradient * noise_);
}

void Mprgp::refresh() {
  if (recurrences_ == 0 || halt_ == Halt::not_finite) return;
  Vector g = times(x_) - b_;
  if (!g.allFinite()) return void(stop(Halt::not_finite));
  const double difference = (g - g_).norm(), bends = norm_ * offset_;
  offset_ = 0;
  recurrences_ = 0;
  set_gradient(std::move(g));
  q_ = 0.5 * x_.dot(g_ - b_);
  if (difference >= 2 * bends) measure_noise(difference);
  count_noise();
}

/// The difference is noise of products with the x of now where g^P is not much greater; far from the
/// solution it may be that of longer steps.
void Mprgp::measure_noise(double difference) {
  noise_ = noise_known_ ? std::max(difference, 0.5 * noise_) : difference;
  noise_known_ = projected_gradient_norm() <= 10 * kNoisyGradient * noise_;
}

void Mprgp::restart(Vector b, double norm, Vector g) {
  b_ = std::move(b);
  norm_ = norm;
  direction_.resize(0);
  noisy_ = failed_ = since_least_ = 0;
  ++recurrences_;
  begin(std::move(g));
}

Mprgp::Step Mprgp::step() {
  if (halt_ == Halt::none && projected_gradient_norm() == 0) refresh();
  if (halt_ != Halt::none) return Step::none;
  if (projected_gradient_norm() == 0) return stop(Halt::solved);
  const Step made = proportional() ? conjugate_step() : proportioning_step();
  if (made == Step::none) return made;
  ++steps_;
  watch();
  return made;
}

/// Keeps g true, and notices where there is nothing more to win.
void Mprgp::watch() {
  if (recurrences_ >= kRefresh || (recurrences_ > 0 && at_rounding()) || (offset_ > 0 && !proportional()))
    refresh();
  else if (recurrences_ == 0)
    count_noise();
  const double now = projected_gradient_norm();
  since_least_ = now < 0.99 * least_ ? 0 : since_least_ + 1;
  least_ = std::min(least_, now);
  const bool idle = since_least_ >= kIdle && now <= kSmall * (norm_ * x_.norm() + b_.norm());
  if (halt_ == Halt::none && (failed_ >= kNoisySteps || idle)) halt_ = Halt::rounding;
}

/// For a g that is computed anew.
void Mprgp::count_noise() {
  const double known = noise_known_ ? kNoisyGradient * noise_ : 0;
  noisy_ = projected_gradient_norm() <= std::max(kGradientRounding * (norm_ * x_.norm() + b_.norm()), known) ? noisy_ + 1 : 0;
  if (noisy_ >= kNoisySteps && halt_ == Halt::none) halt_ = Halt::rounding;
}

/// S M S φ in the face, M the preconditioner, and S² = 1/(1 + curvature/‖A‖) what the circles ask for.
Vector Mprgp::preconditioned() const {
  const Vector& phi = gradients_.free;
  if (!settings_.preconditioner && !gradients_.slides) return phi;
  Vector S = Vector::Ones(phi.size());
  if (gradients_.slides && norm_ > 0) S = (1 + gradients_.curvature.array() / norm_).rsqrt();
  const Vector scaled = S.cwiseProduct(phi), z = settings_.preconditioner ? settings_.preconditioner(scaled, x_, gradients_) : scaled;
  const Vector along = set_.tangential(x_, gradients_, S.cwiseProduct(z));
  return along.allFinite() && along.dot(phi) > 0 ? along : phi;
}

void Mprgp::advance(double alpha, const Vector& p, const Vector& Ap) {
  q_ += alpha * (0.5 * alpha * p.dot(Ap) - p.dot(g_));
  x_ = set_.along(x_, p, alpha);
  ++recurrences_;
  set_gradient(g_ - alpha * Ap);
}

Mprgp::Step Mprgp::conjugate_step() {
  if (direction_.size() == 0 || noisy_ > 0 || !(direction_.dot(gradients_.free) > 0)) direction_ = preconditioned();
  const Vector Ap = times(direction_);
  raise_norm(direction_.dot(Ap) / direction_.squaredNorm());
  const Vector Hp = gradients_.slides ? Vector(Ap + gradients_.curvature.cwiseProduct(direction_)) : Ap;
  const double slope = direction_.dot(gradients_.free), curvature = direction_.dot(Hp);
  if (!std::isfinite(curvature) || !Hp.allFinite()) return stop(Halt::not_finite);
  const bool curved = curvature > kNoCurvature * norm_ * direction_.squaredNorm();
  if (!curved && at_rounding()) return stop(Halt::rounding);
  const double alpha_cg = curved ? slope / curvature : kUnboundedStep, alpha_free = set_.longest_step(x_, direction_);
  if (!std::isfinite(std::min(alpha_cg, alpha_free))) return unbounded(-direction_);
  const std::vector<SeparableSet::Place> face = gradients_.face;
  const Step made = gradients_.slides        ? curved_step(alpha_cg, alpha_free, Ap)
                    : alpha_cg <= alpha_free ? advance(alpha_cg, direction_, Hp), Step::conjugate
                                             : expand(alpha_cg, alpha_free, Hp);
  if (made == Step::conjugate && gradients_.face == face) {
    const Vector z = preconditioned();
    direction_ = z - z.dot(Hp) / curvature * set_.tangential(x_, gradients_, direction_);
  } else if (halt_ != Halt::unbounded) {
    direction_.resize(0);
  }
  return made;
}

/// A conjugate gradient step whose sliding pairs go along their circles; or, where that does not lower q, a
/// fixed step of the whole gradient.
Mprgp::Step Mprgp::curved_step(double alpha_cg, double alpha_free, const Vector& Ap) {
  const bool within = alpha_cg <= alpha_free, projects = !within && projects_steps() && std::isfinite(alpha_cg);
  if (within && straight_enough(alpha_cg, Ap)) return Step::conjugate;
  refresh_offset();
  if (halt_ != Halt::none) return Step::none;
  const Vector target = projects ? set_.project(x_ - alpha_cg * direction_)
                                 : set_.along(x_, direction_, std::min(alpha_cg, alpha_free));
  if (lowers(target, 0)) {
    if (projects || within) return within ? Step::conjugate : Step::projection;
    fixed_step(gradient_on_face());
  } else if (halt_ == Halt::none) {
    failed_ = fixed_step(g_) ? 0 : failed_ + 1;
  }
  return halt_ == Halt::none ? Step::expansion : Step::none;
}

/// Makes the step along circles as if it were straight, which saves a product, if what A times its bending adds
/// to g, offset_ ‖A‖ at most, can hardly matter for the decrease of q; nor, afterwards, in g^P.
bool Mprgp::straight_enough(double alpha, const Vector& Ap) {
  const Vector target = set_.along(x_, direction_, alpha), d = target - x_;
  const double change = d.dot(g_ - 0.5 * alpha * Ap), offset = offset_ + (d + alpha * direction_).norm();
  if (!(change < 0) || norm_ * offset * d.norm() > -kHardly * change) return false;
  x_ = target;
  q_ += change;
  offset_ = offset;
  ++recurrences_;
  set_gradient(g_ - alpha * Ap);
  if (norm_ * offset_ > kHardly * projected_gradient_norm()) refresh_offset();
  return true;
}

void Mprgp::refresh_offset() {
  if (offset_ > 0) refresh();
}

/// g at free components and sliding pairs, else 0.
Vector Mprgp::gradient_on_face() const {
  Vector v = g_;
  for (Eigen::Index i = 0; i < v.size(); ++i)
    if (gradients_.face[i] == SeparableSet::Place::active) v[i] = 0;
  return v;
}

Mprgp::Step Mprgp::expand(double alpha_cg, double alpha_free, const Vector& Ap) {
  const double half = alpha_free * (0.5 * alpha_free * direction_.dot(Ap) - direction_.dot(g_));
  if (projects_steps() && std::isfinite(alpha_cg)) {
    double alpha = alpha_cg;
    for (int tried = 0; tried < kTries && alpha > alpha_free; ++tried, alpha /= 2) {
      if (lowers(set_.project(x_ - alpha * direction_), half)) return Step::projection;
      if (halt_ != Halt::none) return Step::none;
    }
  }
  advance(alpha_free, direction_, Ap);
  if (projects_steps()) refresh();  // refused so often, g may be noise
  if (halt_ != Halt::none) return Step::none;
  fixed_step(gradient_on_face());
  return halt_ == Halt::none ? Step::expansion : Step::none;
}

/// Moves to the target, if q changes by less than to_beat ≤ 0 there, as far as it is known; g is computed anew.
bool Mprgp::lowers(const Vector& target, double to_beat) {
  Vector g = times(target) - b_;
  if (!g.allFinite()) return stop(Halt::not_finite), false;
  const Vector d = target - x_;
  const double change = 0.5 * d.dot(g + g_), length = d.squaredNorm();
  if (!(change < to_beat + set_.rounding(g))) {
    if (std::sqrt(length) > 1e-7 * x_.norm()) raise_norm(d.dot(g - g_) / length);
    return false;
  }
  x_ = target;
  q_ += change;
  recurrences_ = 0;
  offset_ = 0;
  set_gradient(std::move(g));
  return true;
}

/// x ← P(x − ᾱv). False where that is x, or where rounding lets q not fall.
bool Mprgp::fixed_step(const Vector& v) {
  for (int attempt = 0; attempt < 50; ++attempt) {
    const double norm = norm_;
    const Vector target = set_.project(x_ - fixed_step_length() * v);
    if (target == x_) return false;
    if (lowers(target, 0)) return true;
    if (halt_ != Halt::none || !(norm_ > norm)) return false;
  }
  return false;
}

Mprgp::Step Mprgp::proportioning_step() {
  direction_.resize(0);
  const Vector beta = gradients_.chopped, Ab = times(beta);
  const double slope = beta.squaredNorm(), curvature = beta.dot(Ab);
  if (!Ab.allFinite() || !std::isfinite(curvature)) return stop(Halt::not_finite);
  raise_norm(curvature / slope);
  const bool curved = curvature > kNoCurvature * norm_ * slope;
  if (!curved && at_rounding()) return stop(Halt::rounding);
  const double alpha = std::min(curved ? slope / curvature : kUnboundedStep, set_.longest_step(x_, beta));
  if (!std::isfinite(alpha)) return unbounded(-beta);
  advance(alpha, beta, Ab);
  return Step::proportioning;
}

}  // namespace dotyk::solver
