#pragma once

#include "solver/bounded/mprgp.hpp"

namespace dotyk::solver {

/// minimise ½xᵀHx − bᵀx over x ∈ Ω with Qx = 0, H symmetric positive semidefinite, Q an orthogonal projector.
struct EqualityProgram {
  LinearMap H;              ///< where `complementary`, only of v with Qv = 0
  double norm = 1;  ///< ≥ ‖H‖
  LinearMap Q;
  bool complementary = false;  ///< HQ = 0 is known, so that ‖H + ρQ‖ is max(‖H‖, ρ), not ‖H‖ + ρ
  algebra::Vector b;           ///< n
  const SeparableSet* set = nullptr;
};

/// A FaceMap that depends on ρ.
using PenaltyFaceMap = std::function<algebra::Vector(const algebra::Vector& v, const algebra::Vector& x,
                                                     const SeparableSet::Gradients& at, double rho)>;

/// Semimonotonic augmented Lagrangians (SMALBE): Mprgp minimises
///   L(x, ν, ρ) = ½xᵀHx − bᵀx + νᵀx + ½ρ‖Qx‖²   over Ω,
/// ν in the range of Q being Gᵀμ, μ the multiplier of Gx = 0, where Q = GᵀG with orthonormal rows of G. An
/// outer step ends the inner minimisation as soon as ‖g^P‖ ≤ M‖Qx‖, and then updates ν ← ν + ρQx or else M or ρ.
struct Smalbe {
  enum class Update {
    /// ρ is fixed. The inner minimisation ends at ‖g^P‖ ≤ min(M‖Qx‖, η‖b‖); M ← M/β after an outer step where L did
    /// not grow by ½ρ‖Qx‖² though the step before had the same M. While M ≤ √(λ_min ρ), λ_min(H) > 0, it always
    /// grows so: M never falls to √(λ_min ρ)/β (SMALBE-M; Dostál 2009, ch. 7).
    precision,
    /// M is fixed. ν is updated, and η ← αη, where ‖Qx‖ ≤ η; else ρ ← βρ. (Dostál, Gomes and Santos, ODAM 2001,
    /// algorithm 4.1.) `done` is asked about the gradient with ρ = 0, as in §5 there, and so about ν, not ν + ρQx.
    penalty,
    /// As `precision`, and where an outer step left more than half of ‖Qx‖: M ← M/β too, as long as M is above a
    /// fifth of ‖H‖ (steps so imprecise crawl), else ρ ← βρ (bounds may let the multiplier of Gx = 0 follow slowly).
    both
  } update = Update::precision;
  double rho = 1;  ///< ρ₀/‖H‖
  double M = 1;    ///< M₀/‖H‖
  /// η₀ in units of the greater of ‖b‖ and the gradient's norm at the start (of that over ‖H‖ for `penalty`, which
  /// compares it with ‖Qx‖). The paper's η₀ has the unit of x.
  double eta = 0.1;
  double alpha = 0.1;
  double beta = 10;
  int max_outer = 1000;
  int max_inner = 100000;  ///< inner steps, all outer ones together
  /// ≈ (H + ρQ)⁻¹ on a face, as MprgpSettings::preconditioner; or none.
  PenaltyFaceMap preconditioner = {};
  /// Of the inner minimisation; without the preconditioner.
  MprgpSettings inner;
};

struct SmalbeState {
  const Mprgp& inner;
  double gradient, equality;  ///< ‖g^P‖ of L, ‖Qx‖
  double lagrangian;          ///< L(x, ν, ρ)
  double rho, M;
  int outer;                  ///< outer steps done, the one that just ended included
};

/// Asked and told while it goes on. Each may be empty but `done`.
struct SmalbeCaller {
  std::function<bool(double gradient, double equality, const algebra::Vector& x)> done;
  std::function<bool(const SmalbeState&)> inner;  ///< after each inner step; false asks to stop
  std::function<void(const SmalbeState&)> outer;  ///< at the end of each outer step, before its update
};

struct SmalbeResult {
  enum class End {
    done,
    stopped,     ///< by the caller
    limit,       ///< on outer or inner steps, or on ρ
    rounding,
    infeasible,  ///< Qx proves that no y ∈ Ω has Qy = 0: (Qx)ᵀy > 0 for all of them
    unbounded,   ///< L is, on Ω
    not_finite   ///< H or Q gave a number that is not finite
  } end = End::limit;
  algebra::Vector x;   ///< n, in Ω
  algebra::Vector nu;  ///< n; g^P of Hx − b + ν on Ω is `gradient` long
  double gradient = 0, equality = 0;  ///< ‖g^P‖, ‖Qx‖
  double rho = 0, M = 0;              ///< the last ones
  int outer = 0, inner = 0, products = 0;  ///< outer steps, inner steps, products with H
};

/// Starts at the projection of x on Ω and ν, both n. Where done(‖g^P‖, ‖Qx‖, x) holds after an inner step, with g
/// computed anew, all ends: so where Ω = Rⁿ and HQ = 0 this is the method of conjugate gradients from any x
/// with Qx = 0. Ends with `rounding` where rounding keeps both norms from falling further.
SmalbeResult minimise(const EqualityProgram& program, const Smalbe& settings, const SmalbeCaller& caller,
                      algebra::Vector x, algebra::Vector nu);

}  // namespace dotyk::solver
