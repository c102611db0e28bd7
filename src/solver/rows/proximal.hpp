#pragma once

#include "solver/rows/row_iteration.hpp"

namespace dotyk::solver {

/// The proximal point method (Rockafellar 1976) around Newton's: each iteration puts a spring into every row,
/// pressed by λ − λ_k,
///   x = x₀ − Wλ − σC(λ − λ_k) + Nα,     C diagonal: W_rr, for all rows of a friction point their mean,
/// and moves to the solution of that problem. Springs of stiffness δ hold α at α_k, so that Newton's step exists where everything
/// slips or opens. The problem is regular where W is not (hyperstatic systems: more
/// multipliers than motions, so that λ need not be unique), and a fixed point solves the problem itself. With
/// given friction it descends the dual energy for every σ; with Coulomb's nothing is proved, the residual decides.
///
/// With given friction the problem of an iteration is to minimise a convex energy without kinks: with w = P(y),
/// y = λ_k + (x₀ − Wλ + Nα)/σC, it is ½λᵀWλ − eᵀα + Σ(Moreau's envelope of φ_r), its derivatives are W(λ − w) and Nᵀw − e,
/// and Newton's step, which solves λ' = w + S(y' − y), Nᵀλ' = e, is one of Newton's on it. A line search on the energy's derivative along the step,
/// which grows with the length as the energy is convex, asks for no energies of laws; with it the method converges from
/// everywhere (Rockafellar's proximal method of multipliers).
///
/// Otherwise Newton's steps are damped until ‖F‖ decreases, and end where ‖F‖ is a tenth of ‖λ − λ_k‖. Where they get
/// there, σ is divided by ten, and iterations become Newton's own; where not, λ_k stays and σ grows a hundredfold. It grows so, too,
/// where rounding of x, which stiff springs turn into great forces, kept Newton's method from getting nearer.
/// W need not be symmetric.
struct Proximal : RowMethod {
  double sigma = 0.1;  ///< at the start: compliance of the springs against that of the rows themselves
  const char* name() const override { return "proximal"; }
  void iterate(RowIteration& iteration) const override;
};

}  // namespace dotyk::solver
