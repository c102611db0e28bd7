#pragma once

#include <limits>
#include <string>

#include "algebra/krylov/kept_vectors.hpp"
#include "algebra/krylov/preconditioner.hpp"
#include "base/monitor.hpp"

namespace dotyk::algebra {

struct CgSettings {
  double tolerance = 1e-6;  ///< of ‖b − K x‖ / ‖b‖, formed anew from x before a run ends
  int most = 0;             ///< iterations; 0: ten times the unknowns and a hundred
  int limit(Eigen::Index unknowns) const { return most > 0 ? most : static_cast<int>(10 * unknowns + 100); }
};

struct CgResult {
  Vector x;
  int iterations = 0;
  double residual = 0;  ///< ‖b − K x‖ / ‖b‖; 0 for b = 0
  bool converged = false;
  std::string reason;
};

/// What earlier systems with K left, and what this one is to leave.
struct CgMemory {
  ConjugateBasis* basis = nullptr;  ///< where it starts: the solution in the span of it, of vectors of Â
  bool conjugate = false;           ///< also every direction is made conjugate to the basis: deflation
  bool store = false;               ///< the directions join the basis; implies `conjugate`
  LanczosRecord* record = nullptr;  ///< gets residuals and coefficients, and orthogonalises the residuals
};

/// No run lowers ‖b − K x‖ further than to this part of ‖b‖.
constexpr double kCgRounding = 32 * std::numeric_limits<double>::epsilon();

/// Preconditioned conjugate gradients for K x = b: on Â x̂ = b̂ (see Preconditioner), from x = 0 or from what the
/// basis gives. ‖r‖ = ‖C r̂‖, half a product with K, is formed in each eighth step and wherever its last ratio
/// to ‖r̂‖ says that the goal is within a factor 4. Where b − K x formed from x misses the goal that the recurrence
/// met, x is corrected by a further run; where that does not halve it the reason is rounding. No run goes further than by 32 ε,
/// nor on where the next direction is in the basis's span but for rounding. Nothing to do for b = 0.
/// After a stop (Monitor), or `most` iterations, the iterate reached is returned with converged = false. Throws
/// InputError where b is not finite and where a direction shows that K is not positive definite.
CgResult conjugate_gradient(const Preconditioner& preconditioner, const Vector& b, const CgSettings& settings,
                            Monitor& monitor, const CgMemory& memory = {});

}  // namespace dotyk::algebra
