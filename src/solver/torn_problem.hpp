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
  int size() const { return static_cast<int>(f->size()); }
};

/// A problem torn into pieces and joined again by rows (total FETI). Each piece moves on copies v of its own of the
/// unknowns; with as many pieces as there are,
///   minimise Σ ½vᵀKv − fᵀv + Σ_r φ_r((B̂v − ĉ)_r)
/// has the problem's solution. The rows of B̂, in this order, each of norm one:
///  1. those of the problem, an entry at an unknown with m copies spread evenly over them (1/m each) and then the
///     row scaled, λ = Dλ', with the same factor for both rows of a friction point (the greater norm becomes one; a
///     row without entries stays as it is);
///  2. for an unknown with m copies m − 1 orthonormal rows, orthogonal to (1, …, 1) and so to those of the problem:
///     row k has 1/√(k(k+1)) on the first k copies and −k/√(k(k+1)) on the next (Helmert's matrix);
///  3. for every copy of an unknown that a support holds, v = its value.
/// Only copies that rows touch have a column: "touched copies", piece after piece.
struct TornProblem {
  std::vector<Piece> pieces;
  algebra::SparseRows B;     ///< B̂: rows × touched copies
  algebra::SparseRows Bt;    ///< B̂ᵀ
  algebra::Vector c;         ///< ĉ = (Dc, 0, values)
  algebra::Vector scale;     ///< D, one a row of the problem
  int gluing_rows = 0, support_rows = 0;
  std::vector<int> unknown;  ///< of which unknown of the problem every copy is one; −1: of one held by a support
  algebra::Vector value;     ///< where the support holds it; 0 elsewhere
  int unknowns = 0;          ///< of the problem

  int rows() const { return static_cast<int>(c.size()); }
  int problem_rows() const { return static_cast<int>(scale.size()); }
  int copies() const { return static_cast<int>(unknown.size()); }
};

/// Tears a problem into its subdomains, or into its blocks where it has none. `problem` must outlive the result.
TornProblem tear(const problem::Problem& problem);

/// The mean of the copies of each unknown; v: copies, result: unknowns.
algebra::Vector average(const TornProblem& torn, const algebra::Vector& v);

}  // namespace dotyk::solver
