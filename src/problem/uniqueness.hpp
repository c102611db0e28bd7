#pragma once

#include <optional>

#include "problem/condensed.hpp"
#include "problem/solvability.hpp"

namespace dotyk::problem {

/// Does friction depend on the pressure anywhere?
bool has_coulomb(const Problem& problem);

/// What theory says of the solutions before they are computed.
struct Uniqueness {
  bool coulomb = false;  ///< friction that depends on the pressure: the problem is no minimisation
  /// Proved; without Coulomb friction it is solvability(). With it, for any coefficients: B has full rank and without friction
  /// either nothing may move or the load works against every admissible motion (then multipliers are bounded
  /// whatever the bounds g of friction, they depend on g continuously, and Brouwer's theorem gives a fixed point of g := μλ_n;
  /// Haslinger, Hlaváček, Nečas, Handbook of Numerical Analysis IV, 1996, section 10).
  bool exists = true;
  /// Proved, given that there is one. Without Coulomb friction the stress is, always. The displacement is where no motion is free
  /// of rows that hold it both ways, or one, w, is with |S(w)| > j(w): TR965 theorem 3.3, (3.31), of the discrete problem. With two there
  /// is always one with S(w) = 0, and the criterion is void.
  bool unique = false;
  bool held = true;  ///< no motion is free of rows that hold it both ways
  /// The only motion that solutions can differ by, where there is one: amounts of the modes. Else empty.
  algebra::Vector motion;
};
Uniqueness uniqueness(const RigidMotions& rigid, const Problem& problem);

/// A factor: for Coulomb's coefficients times anything below it, the solution is unique under every load, and the loop g := μλ_n contracts.
/// 2/√(bound of the greatest eigenvalue of [s_i^½ μ_i (W⁻¹)_{n_i n_j} μ_j s_j^½] · that of [s_i^-½ W_{t_i t_j} s_j^-½]), s_i the mean of W_tt at
/// point i. For the difference z of two solutions' multipliers has zᵀWz ≤ Σ μ_i |z_n,i| |(Wz)_t,i|, as its other products z_r (Wz)_r are
/// not positive; with y = W^½z the right side is at most ‖Ay‖‖By‖, A = s^½ μ P_n W^-½ and B = s^-½ P_t W^½, and as
/// A Bᵀ = 0 that is at most ½‖A‖‖B‖‖y‖². Falls as the mesh is refined. Nothing where W is singular (dependent rows) or
/// bodies are free; infinite without Coulomb friction.
std::optional<double> uniqueness_factor(const Problem& problem, const CondensedProblem& condensed);

}  // namespace dotyk::problem
