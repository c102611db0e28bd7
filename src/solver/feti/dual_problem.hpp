#pragma once

#include <string>
#include <vector>

#include "algebra/dense/generalised_inverse.hpp"
#include "problem/condensed.hpp"
#include "solver/feti/piece_kinds.hpp"
#include "solver/feti/torn_problem.hpp"

namespace dotyk::solver {

/// The dual of a torn problem (P2 (2.6)–(3.1); rows, D and ĉ as in TornProblem): of all multipliers λ that its laws allow
/// and that balance the load on every rigid motion of every piece, the one that minimises
///   ½λᵀFλ − λᵀd̃     subject to  G̃λ = ẽ,
///   F = B̂ K⁺ B̂ᵀ + C,   d̃ = B̂ K⁺ f − ĉ,   G̃ = R̂ᵀB̂ᵀ,   ẽ = R̂ᵀf.
/// K⁺ is the generalised inverse of each piece with some of its unknowns fixed, R̂ an orthonormal basis of each piece's
/// kernel, C the compliance of rows with springs. F is symmetric; on the kernel of G̃ it is what B̂ K† B̂ᵀ + C is. Equal
/// pieces (equal_pieces) share one factor and R̂.
/// Every method gives the same bits on any number of threads.
class DualProblem {
 public:
  /// Tears the problem, orders and factors each kind of piece, in threads, and adds the times to `clock`. `problem` must
  /// outlive the object. Throws InputError naming the piece and a node where K's kernel is more than the one said,
  /// where the factors do not fit into memory, Interrupted where the monitor asks to stop.
  DualProblem(const problem::Problem& problem, algebra::Ordering ordering, problem::Clock& clock, Monitor& monitor);

  int rows() const { return torn_.rows(); }
  /// D, one a row of the problem: λ of the problem = D λ', its gap Dc, a bound on λ over D.
  const algebra::Vector& scale() const { return torn_.scale; }
  const TornProblem& torn() const { return torn_; }

  algebra::Vector apply(const algebra::Vector& lambda) const;        ///< F λ
  const algebra::Vector& d() const { return d_; }                    ///< d̃, a length a row
  const algebra::SparseMatrix& G() const { return G_; }              ///< G̃: modes × rows
  const algebra::Vector& e() const { return e_; }                    ///< ẽ, one a mode
  const algebra::Vector& load() const { return load_; }              ///< f, one a copy
  /// All copies but for their rigid motions, v = K⁺(I − R̂R̂ᵀ)(f − B̂ᵀλ): what λ leaves unbalanced is spread over the
  /// piece and not left to the unknowns that K⁺ fixes.
  algebra::Vector elastic(const algebra::Vector& lambda) const;
  /// v + R̂α; α: modes.
  algebra::Vector moved(algebra::Vector v, const algebra::Vector& alpha) const;
  /// B̂v − ĉ of all copies.
  algebra::Vector jump(const algebra::Vector& v) const;

  /// What loads on the pieces' modes are on those of the problem's blocks, the columns of their kernels block after block.
  algebra::Vector on_blocks(const problem::Problem& problem, const algebra::Vector& resultants) const;

  /// The pieces by kind; a kind's first stands for all of it.
  const std::vector<std::vector<int>>& kinds() const { return kinds_; }
  /// R̂ of a piece: own unknowns × modes.
  const algebra::DenseMatrix& basis(const Piece& piece) const { return inverses_[piece.kind].basis(); }
  double factor_bytes() const;          ///< of all kinds' factors
  const std::string& ordering() const;  ///< that of the greatest piece; empty without pieces

 private:
  void analyse(algebra::Ordering ordering, Monitor& monitor);
  void factor(Monitor& monitor);
  void add_modes();
  algebra::Vector inverse(const algebra::Vector& f) const;  ///< K⁺ f on all copies
  algebra::Vector force(const algebra::Vector& lambda) const;

  TornProblem torn_;
  std::vector<std::vector<int>> kinds_;
  std::vector<Batch> batches_;
  std::vector<algebra::GeneralisedInverse> inverses_;  ///< one a kind
  algebra::SparseMatrix G_;
  algebra::Vector d_, e_, load_;
};

}  // namespace dotyk::solver
