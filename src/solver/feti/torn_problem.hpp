#pragma once

#include <string>
#include <vector>

#include "problem/problem.hpp"

namespace dotyk::solver {

/// A piece of a torn problem: a problem::Subdomain, or a whole block where the problem is not cut. It refers to the
/// problem's own matrices and copies none.
struct Piece {
  std::string name;  ///< for messages: "'lid'", "piece 3 of 'lid'"
  const algebra::SparseMatrix* K = nullptr;
  const algebra::Vector* f = nullptr;
  const std::vector<int>* node = nullptr;
  const algebra::DenseMatrix* kernel = nullptr;
  int first = 0;             ///< of its unknowns among all copies
  std::vector<int> touched;  ///< its own unknowns that some row acts on, ascending
  int first_touched = 0;     ///< of them among all touched copies
  int kind = 0;              ///< one factor serves all pieces of a kind (DualProblem)
  int first_mode = 0;        ///< of its kernel's among all pieces'
  int size() const { return static_cast<int>(f->size()); }
};

/// A problem torn into pieces and joined again by rows (total FETI). Each piece moves on copies v of its own of the
/// unknowns; with as many pieces as there are,
///   minimise Σ ½vᵀKv − fᵀv + Σ_r φ_r((B̂v − ĉ)_r)
/// has the problem's solution.
///
/// Copies differ in stiffness: k > 0, K's diagonal there as a part of the greatest one. The force of a row moves a copy by
/// about 1/k of itself, so rows share themselves out among the copies as these are stiff, which moves all of them alike,
/// and are scaled to norm one in k⁻¹: B̂k⁻¹B̂ᵀ is what F = B̂K⁺B̂ᵀ is about, and has a unit diagonal whatever the pieces'
/// stiffnesses are (the stiffness scaling of Rixen and Farhat 1999, the ρ-scaling of Klawonn and Widlund 2001). The
/// least of the changes of multipliers that balance a piece, which projectors look for, is the softest in this measure.
/// The rows, in this order:
///  1. those of the problem, an entry at an unknown shared by its copies as k over their sum, and then the row
///     scaled, λ = Dλ', with the same factor for both rows of a friction point (the greater norm becomes one; a
///     row without entries stays as it is);
///  2. for an unknown with m copies m − 1 rows that are orthonormal in k⁻¹, and orthogonal to (k, …, k) and so to
///     those of the problem: row j is s k/S_j on the first j copies and −s on the next one, S_j the sum of k over the
///     first j, s² = S_j k_{j+1}/S_{j+1} (Helmert's matrix where all are as stiff as each other);
///  3. for every copy of an unknown that a support holds, √k v = √k times its value;
///  4. for every spring of a subdomain, of stiffness k_q, its displacement, which the multiplier λ lets be λ/k_q (a
///     spring is as a piece of one unknown between body and ground).
/// The norm of a row with a spring, of one of these or of the problem's law there, includes the spring's 1/k_q.
/// Only copies that rows touch have a column: "touched copies", piece after piece.
struct TornProblem {
  std::vector<Piece> pieces;
  algebra::SparseRows B;     ///< B̂: rows × touched copies
  algebra::SparseRows Bt;    ///< B̂ᵀ
  algebra::Vector c;         ///< ĉ = (Dc, 0, √k values, 0)
  algebra::Vector scale;     ///< D, one a row of the problem
  double stiffest = 1;             ///< the greatest diagonal entry of any K
  algebra::Vector stiffness;       ///< k, one a copy
  std::vector<int> touched;        ///< which copies are touched, ascending
  algebra::Vector touched_weight;  ///< 1/k of them
  int gluing_rows = 0, support_rows = 0;
  /// What ½λ²/k_q of springs adds to the dual problem's matrix, one a row: their squared scale over k_q; 0 of rows without
  /// springs, and of laws where k_q = 0, for such a row carries nothing. Of laws with one spring (see opposed_springs).
  algebra::Vector compliance;
  std::vector<int> unknown;  ///< of which unknown of the problem every copy is one; −1: of one held by a support
  algebra::Vector value;     ///< where the support holds it; 0 elsewhere
  int unknowns = 0;          ///< of the problem

  int rows() const { return static_cast<int>(c.size()); }
  int problem_rows() const { return static_cast<int>(scale.size()); }
  int copies() const { return static_cast<int>(unknown.size()); }
};

/// Tears a problem into its subdomains, or into its blocks where it has none. `problem` must outlive the result.
TornProblem tear(const problem::Problem& problem);

/// The mean of the copies of each unknown, weighted by their stiffness; v: copies, result: unknowns.
algebra::Vector average(const TornProblem& torn, const algebra::Vector& v);

}  // namespace dotyk::solver
