#include "solver/bounded/smalbe.hpp"

#include <cmath>
#include <optional>

namespace dotyk::solver {

using algebra::Vector;

namespace {

using End = SmalbeResult::End;
using Halt = Mprgp::Halt;

/// L is known up to this part of itself.
constexpr double kLagrangianRounding = 1e-13;
/// Outer steps in succession that end in rounding, no norm much less.
constexpr int kRoundingSteps = 3;
/// ρ/‖H‖ beyond which Qx is not known any more.
constexpr double kGreatestPenalty = 1e10;
/// An outer step that leaves so much of ‖Qx‖ was too imprecise: ν must follow the solution for it, not the path to it.
constexpr double kCrawl = 0.5;
/// M/‖H‖ of an outer step so precise that it is ρ's fault.
constexpr double kPreciseInner = 0.2;

class SmalbeRun {
 public:
  SmalbeRun(const EqualityProgram& program, const Smalbe& settings, const SmalbeCaller& caller, Vector x, Vector nu)
      : program_(program), settings_(settings), caller_(caller), rho_(settings.rho * program.norm),
        M_(settings.M * program.norm), nu_(std::move(nu)),
        inner_(map(), norm(), program.b - nu_, *program.set, std::move(x), inner_settings()) {
    eta_ = settings.eta * std::max(program.b.norm(), inner_.g().norm());
    if (penalty()) eta_ /= program.norm;
    measure();
  }

  SmalbeResult operator()() {
    std::optional<End> end;
    while (!end) {
      end = minimise_inner();
      if (end) break;
      ++outer_;
      if (caller_.outer) caller_.outer(state());
      end = settled();
      if (!end) update();
    }
    return result(*end);
  }

 private:
  LinearMap map() {
    return [this](const Vector& v) -> Vector {
      const Vector Qv = program_.Q(v);
      return program_.H(program_.complementary ? Vector(v - Qv) : v) + rho_ * Qv;
    };
  }

  MprgpSettings inner_settings() {
    MprgpSettings out = settings_.inner;
    if (settings_.preconditioner)
      out.preconditioner = [this](const Vector& v, const Vector& x, const SeparableSet::Gradients& at) {
        return settings_.preconditioner(v, x, at, rho_);
      };
    return out;
  }

  double norm() const { return program_.complementary ? std::max(program_.norm, rho_) : program_.norm + rho_; }

  void measure() {
    Qx_ = program_.Q(inner_.x());
    equality_ = Qx_.norm();
    gradient_ = inner_.projected_gradient_norm();
  }

  bool penalty() const { return settings_.update == Smalbe::Update::penalty; }

  /// What `done` is asked about: algorithm 4.1's rule takes ν as it is, the others ν + ρQx, which is the next one.
  double final_gradient() const {
    if (!penalty()) return gradient_;
    const SeparableSet::Gradients at = program_.set->gradients(inner_.x(), inner_.g() - rho_ * Qx_);
    return std::hypot(at.free.norm(), at.chopped.norm());
  }

  SmalbeState state() const { return {inner_, gradient_, equality_, inner_.q(), rho_, M_, outer_}; }

  /// With g computed anew.
  bool done() {
    if (!caller_.done(final_gradient(), equality_, inner_.x())) return false;
    inner_.refresh();
    measure();
    return caller_.done(final_gradient(), equality_, inner_.x());
  }

  bool precise() const {
    const double bound = M_ * equality_;
    return gradient_ <= (penalty() ? bound : std::min(bound, eta_));
  }

  /// Until the outer step's precision, or rounding; or else the end of all.
  std::optional<End> minimise_inner() {
    for (;;) {
      if (done()) return End::done;
      if (precise()) {
        inner_.refresh_offset();
        gradient_ = inner_.projected_gradient_norm();
        if (precise()) return std::nullopt;
      }
      const bool made = inner_.step() != Mprgp::Step::none;
      measure();
      if (made && caller_.inner && !caller_.inner(state())) return End::stopped;
      if (inner_.halt() == Halt::unbounded) return End::unbounded;
      if (inner_.halt() == Halt::not_finite) return End::not_finite;
      if (inner_.halt() != Halt::none) {
        if (done()) return End::done;
        return std::nullopt;
      }
      if (inner_.steps() >= settings_.max_inner) return End::limit;
    }
  }

  /// Is there nothing more to win?
  std::optional<End> settled() {
    const bool halted = inner_.halt() != Halt::none;
    const double both = std::max(gradient_, M_ * equality_);
    idle_ = halted && outer_ > 1 && both > kCrawl * best_ ? idle_ + 1 : 0;
    best_ = outer_ > 1 ? std::min(best_, both) : both;
    if (halted && (equality_ == 0 || idle_ >= kRoundingSteps)) return End::rounding;
    // (Qx)ᵀy = 0 for every y with Qy = 0; the nearest points of Ω to them would give ‖Qx‖² at least.
    if (program_.set->infimum(Qx_) > 0.5 * equality_ * equality_) return End::infeasible;
    if (outer_ >= settings_.max_outer || rho_ > kGreatestPenalty * program_.norm) return End::limit;
    return std::nullopt;
  }

  void update() {
    Vector change = rho_ * Qx_;  // of g
    if (!penalty()) {
      nu_ += change;
      const double old = rho_;
      sharpen();
      change += (rho_ - old) * Qx_;
    } else if (equality_ <= eta_) {
      nu_ += change;
      eta_ *= settings_.alpha;
    } else {
      rho_ *= settings_.beta;
      change *= settings_.beta - 1;
    }
    inner_.restart(program_.b - nu_, std::max(norm(), inner_.norm()), inner_.g() + change);
    gradient_ = inner_.projected_gradient_norm();
  }

  /// M smaller, or ρ greater, where the outer step that ended asks for it (Update).
  void sharpen() {
    const bool compared = outer_ > 1 && last_M_ == M_;  // L can be told to grow by the precision of the last step
    const double L = inner_.q(), growth = 0.5 * rho_ * equality_ * equality_;
    const bool too_little = L + kLagrangianRounding * std::abs(L) < lagrangian_ + growth;
    const bool crawls = settings_.update == Smalbe::Update::both && equality_ > kCrawl * last_equality_;
    const bool precise = M_ <= kPreciseInner * program_.norm;
    last_M_ = M_;
    last_equality_ = equality_;
    lagrangian_ = L;
    if (compared && (too_little || (crawls && !precise))) {
      M_ /= settings_.beta;
    } else if (compared && crawls) {
      rho_ *= settings_.beta;
      last_M_ = 0;  // L of another ρ is not to be compared with
    }
  }

  SmalbeResult result(End end) {
    return {end, inner_.x(), penalty() ? nu_ : Vector(nu_ + rho_ * Qx_), final_gradient(), equality_, rho_, M_, outer_,
            inner_.steps(), inner_.products()};
  }

  const EqualityProgram& program_;
  const Smalbe& settings_;
  const SmalbeCaller& caller_;
  double rho_, M_, eta_ = 0;
  Vector nu_, Qx_;
  Mprgp inner_;
  double gradient_ = 0, equality_ = 0, lagrangian_ = 0, last_M_ = 0, best_ = 0, last_equality_ = 0;
  int outer_ = 0, idle_ = 0;
};

}  // namespace

SmalbeResult minimise(const EqualityProgram& program, const Smalbe& settings, const SmalbeCaller& caller, Vector x,
                      Vector nu) {
  return SmalbeRun(program, settings, caller, std::move(x), std::move(nu))();
}

}  // namespace dotyk::solver
