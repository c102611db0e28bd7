#pragma once

#include "solver/bounded/smalbe.hpp"
#include "solver/core/solver.hpp"

namespace dotyk::solver {

/// FETI with projectors to the natural coarse space (P2: Dostál, Gomes, Santos), for contact of many bodies and of
/// bodies cut into many subdomains; with supports as dual rows total FETI (Dostál, Horák, Kučera 2006).
///
/// The problem is solved on the pieces of Problem::subdomains, each on its own copies of its unknowns, joined by
/// gluing rows. Its dual (DualProblem) is homogenised by λ = λ̄ + x with G̃λ̄ = ẽ and decomposed by the projectors
/// P = I − Q and Q onto im G̃ᵀ; with the gradients divided by an upper bound of ‖PFP‖ it is solved by augmented
/// Lagrangians (Smalbe) with Mprgp within.
/// It stops where
///   ‖g^P‖ ≤ tol ‖Pd‖,  d = d̃ − Fλ̄,  and  ‖Gλ − e‖ ≤ tol F  in every part of the problem
/// (P2, §5, but for ‖d̃‖ there, which depends on what the generalised inverse fixes: Stop::d). Rows are scaled by the stiffness of what
/// they join (TornProblem); Gλ − e are the forces left on the pieces' motions, and F, the paper's ‖f‖, is that of problem::Measure with
/// what the rows bear. Where λ̄ is the solution already, Pd is rounding: g^P is then zero as far as it is. Rows that
/// depend on each other make F singular, nothing else; of their multipliers one choice is returned. Coulomb
/// friction is an outer loop over given friction, b := μλ_n, ended where the bounds change by less than tol.
struct Feti : Settings {
  static constexpr bool begins_anew = true;
  Feti() { outer.rho = 30, outer.update = Smalbe::Update::both; }
  enum class Preconditioner {
    none,
    lumped,    ///< P B K Bᵀ P + Q/ρ
    dirichlet  ///< with the Schur complement on the unknowns that carry rows in place of K
  };
  enum class Stop {
    Pd,  ///< as above
    d    ///< ‖d̃‖ in place of ‖Pd‖
  };
  problem::Decomposition decomposition;
  Stop stop = Stop::Pd;
  Preconditioner preconditioner = Preconditioner::none;
  /// The coarse space of the face in its conjugate gradients (FaceCoarse); else only in the projectors (P2).
  bool face_coarse = true;
  Smalbe outer;  ///< its inner settings are those below
  MprgpSettings::Expansion expansion = MprgpSettings::Expansion::projected_cg_step;
  int max_inner = 100000;  ///< steps of Mprgp in all
  bool spectrum = false;   ///< estimate both ends of PFP's spectrum on im P
};

/// Throws InputError where there is no solution, and where a piece has motions that need no energy beside its kernel.
Result solve(const problem::Problem& problem, const Feti& method, Monitor& monitor);

}  // namespace dotyk::solver
