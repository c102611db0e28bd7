#pragma once

#include <functional>

#include "algebra/krylov/lanczos.hpp"
#include "solver/bounded/separable_set.hpp"

namespace dotyk::solver {

using algebra::LinearMap;

/// What a linear map makes of v in the face of x.
using FaceMap = std::function<algebra::Vector(const algebra::Vector& v, const algebra::Vector& x, const SeparableSet::Gradients& at)>;

struct MprgpSettings {
  /// What follows a conjugate gradient step that would leave Ω.
  enum class Expansion {
    /// The part of the step up to the boundary, then a fixed step: MPRGP (Dostál 2009, ch. 5).
    fixed_step,
    /// x ← P(x − αp) where that lowers q more than the part up to the boundary, α = α_cg, halved up to three times;
    /// else as above: proportioning with projections (Dostál 1997, SIAM J. Optim. 7) with halvings.
    projected_cg_step
  } expansion = Expansion::projected_cg_step;
  double gamma = 1;  ///< Γ: conjugate gradients go on while ‖β‖² ≤ Γ² φ̃ᵀφ
  /// ≈ A⁻¹ on the face, symmetric positive definite, for conjugate gradients: applied to φ, its result made tangential to the
  /// face. Empty: none.
  FaceMap preconditioner = {};
};

/// Minimises q(x) = ½xᵀAx − bᵀx over Ω, A symmetric positive semidefinite, one step at a time. A step is one of
///   conjugate gradients in the face of x, while x is proportional, ‖β(x)‖² ≤ Γ² φ̃(x)ᵀφ(x): one product with A;
///   a second one where pairs slide along circles, whose curvature the step takes into account, so far that
///   their bends matter: while they add less than a twentieth to g^P and to the decrease of q, they are left out;
///   proportioning, x ← x − αβ with α the minimiser or the longest feasible step: one product;
///   expansion, where the conjugate gradient step would leave Ω: see Expansion. Two products, one more for each
///   projected step refused, or one along circles, for which then x ← P(x − ᾱg) is made (the step of
///   MPGP; Dostál and Kozubek 2012).
/// Every one lowers q and keeps x in Ω. A fixed step P(x − ᾱv), v = g on the face and 0 off it, or g, lowers q by at
/// least ᾱ(1 − ½ᾱ‖A‖)‖ṽ‖², ṽ = (x − P(x − ᾱv))/ᾱ, since vᵀṽ ≥ ‖ṽ‖² for every convex Ω: so for all ᾱ < 2/‖A‖. For
/// intervals q − q* falls in a step to at most 1 − α̂λ_min/(ϑ + ϑΓ̂²) of itself, α̂ = min(ᾱ, 2/‖A‖ − ᾱ), ϑ = 2 max(ᾱ‖A‖, 1),
/// Γ̂ = max(Γ, 1/Γ) (Dostál 2009, ch. 5). Here ᾱ = 1.9/‖A‖ for intervals, whose faces long steps find sooner, 1/‖A‖
/// where there are discs. A step that shows a greater ‖A‖ than given raises it.
///
/// The gradient follows from recurrences, is computed anew at each fixed or projected step and else after a
/// hundred products; where it then is of the size of the difference, time and again, it is rounding: the end.
class Mprgp {
 public:
  enum class Step { none, conjugate, proportioning, expansion, projection };
  enum class Halt {
    none,       ///< can go on
    solved,     ///< g^P = 0
    rounding,   ///< what is left of g^P is rounding
    unbounded,  ///< q falls for ever along direction()
    not_finite  ///< A gave a number that is not finite; x is the last one before it
  };

  /// Starts at the projection of x. `norm` ≥ ‖A‖, b: n. The set must outlive this.
  Mprgp(LinearMap A, double norm, algebra::Vector b, const SeparableSet& set, algebra::Vector x,
        MprgpSettings settings = {});

  /// Makes one step; `none` where halt() says why there is none.
  Step step();
  /// Computes g = Ax − b anew, unless it is.
  void refresh();
  /// The same where the bends of circles are left out of g and q so far (see above).
  void refresh_offset();
  /// Goes on from x with another b, ‖A‖ and gradient at x: A and b have changed so that Ax − b = g.
  void restart(algebra::Vector b, double norm, algebra::Vector g);

  const algebra::Vector& x() const { return x_; }
  const algebra::Vector& g() const { return g_; }
  const std::vector<SeparableSet::Place>& face() const { return gradients_.face; }
  double projected_gradient_norm() const;
  double q() const { return q_; }
  bool proportional() const;
  /// ᾱ.
  double fixed_step_length() const;
  double norm() const { return norm_; }
  Halt halt() const { return halt_; }
  const algebra::Vector& direction() const { return direction_; }
  int steps() const { return steps_; }
  int products() const { return products_; }

 private:
  algebra::Vector times(const algebra::Vector& v);
  algebra::Vector preconditioned() const;
  Step conjugate_step();
  Step proportioning_step();
  Step curved_step(double alpha_cg, double alpha_free, const algebra::Vector& Ap);
  bool straight_enough(double alpha, const algebra::Vector& Ap);
  algebra::Vector gradient_on_face() const;
  Step expand(double alpha_cg, double alpha_free, const algebra::Vector& Ap);
  bool projects_steps() const { return settings_.expansion == MprgpSettings::Expansion::projected_cg_step; }
  bool fixed_step(const algebra::Vector& v);
  bool lowers(const algebra::Vector& target, double to_beat);
  void advance(double alpha, const algebra::Vector& p, const algebra::Vector& Ap);
  void raise_norm(double quotient);
  void set_gradient(algebra::Vector g);
  void begin(algebra::Vector g);
  Step stop(Halt why);
  Step unbounded(algebra::Vector direction);
  bool at_rounding() const;
  void watch();
  void measure_noise(double difference);
  void count_noise();

  LinearMap A_;
  double norm_;
  algebra::Vector b_;
  const SeparableSet& set_;
  MprgpSettings settings_;
  algebra::Vector x_, g_, direction_;  ///< direction_ p: empty where conjugate gradients start anew
  SeparableSet::Gradients gradients_;
  double q_ = 0;
  double noise_ = 0;           ///< ‖·‖ of what a refresh changed g by
  bool noise_known_ = false;   ///< and it was near the solution
  double offset_ = 0;         ///< g = A(x + e) − b, ‖e‖ ≤ offset_: bends of circles not multiplied with A yet
  double least_ = 0;          ///< the least ‖g^P‖ so far
  int steps_ = 0, products_ = 0, recurrences_ = 0, noisy_ = 0, failed_ = 0, since_least_ = 0;
  Halt halt_ = Halt::none;
};

}  // namespace dotyk::solver
