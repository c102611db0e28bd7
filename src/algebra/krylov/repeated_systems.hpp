#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algebra/direct/cholesky.hpp"
#include "algebra/krylov/conjugate_gradient.hpp"

namespace dotyk::algebra {

/// Successive conjugate gradients for K x_i = b_i, one after the other (Suarjana and Law 1994). The first system with
/// b ≠ 0 is solved by conjugate gradients whose directions p_j are kept, with Â p_j; every further one starts from
/// the solution in their span, Σ p_j p_jᵀb̂, and is completed by conjugate gradients. Directions are kept conjugate by
/// full reorthogonalisation, each against all kept ones (4 n m operations for the m-th). A right-hand side in
/// K span p_j takes no iteration. Memory: 16 n bytes a direction.
class SuccessiveCg {
 public:
  /// `extend`: further systems, too, add their directions, which are then made conjugate to all before.
  SuccessiveCg(const Preconditioner& preconditioner, const CgSettings& settings, bool extend = false)
      : preconditioner_(preconditioner), settings_(settings), extend_(extend) {}

  CgResult solve(const Vector& b, Monitor& monitor) {
    const bool store = extend_ || basis_.count() == 0;
    return conjugate_gradient(preconditioner_, b, settings_, monitor, {.basis = &basis_, .store = store});
  }
  const ConjugateBasis& basis() const { return basis_; }

 private:
  const Preconditioner& preconditioner_;
  CgSettings settings_;
  bool extend_;
  ConjugateBasis basis_;
};

/// How many of the eigenvalues, ascending, lie before the largest gap: arg max l(i+1)/l(i), 10 ≤ i ≤ 30 (P7); of
/// fewer than 11 values over all i, and 1 of one.
int number_by_gap(const Vector& values);

/// CGLAN for K x_i = b_i, one after the other (P7, section 2). The first system with b ≠ 0 is solved by conjugate
/// gradients that leave the Lanczos vectors Q and T of Â (see LanczosRecord). Q times the lowest eigenvectors of T, as
/// many as number_by_gap says, are Ritz vectors of Â; made conjugate to one another they give every further system the
/// start in their span, which has nothing left along them. Q is then freed: 16 n bytes for each of these 10 to 30
/// vectors are kept.
class Cglan {
 public:
  /// `deflate`: the iterations, too, stay conjugate to these vectors: what rounding and their inexactness bring back
  /// is taken out. Else they serve the start alone, as in the paper.
  Cglan(const Preconditioner& preconditioner, const CgSettings& settings, bool deflate)
      : preconditioner_(preconditioner), settings_(settings), deflate_(deflate) {}

  CgResult solve(const Vector& b, Monitor& monitor);

  const ConjugateBasis& basis() const { return basis_; }
  const Vector& values() const { return values_; }  ///< the Ritz values chosen
  double loss() const { return loss_; }  ///< of orthogonality, see LanczosRecord
  double greatest_bytes() const { return bytes_; }  ///< while the Lanczos vectors were there, too

 private:
  void keep_lowest(const LanczosRecord& record);

  const Preconditioner& preconditioner_;
  CgSettings settings_;
  bool deflate_;
  ConjugateBasis basis_;
  Vector values_;
  double loss_ = 0, bytes_ = 0;
};

struct RepeatedSettings {
  enum class Method { cholesky, cg, scg, cglan, block_cg };
  Method method = Method::cholesky;
  Preconditioning preconditioning = Preconditioning::ssor;  ///< of the iterative methods
  double omega = 1;                                         ///< of SSOR
  CgSettings cg;
  bool extend = false;  ///< scg: see SuccessiveCg
  bool deflate = false; ///< cglan: see Cglan
};

/// How one system was solved.
struct SystemResult {
  int iterations = 0;    ///< of block CG: the step in which this right-hand side was done; of Cholesky 0
  double seconds = 0;    ///< of systems solved together (Cholesky, block CG): an equal share
  double residual = 0;   ///< ‖b − K x‖ / ‖b‖; 0 for b = 0
  bool converged = false;
  std::string reason;
};

/// K x_i = b_i for one sparse symmetric positive definite K and right-hand sides that come one after the other, or many
/// at once: what earlier systems have taught serves the later ones, as far as the method can.
class RepeatedSystems {
 public:
  /// Factors K, or makes the preconditioner. `lower`: K's lower triangle, which must live as long; `node[i]`: node of
  /// unknown i, ascending, for the elimination order. Throws InputError where K is seen not to be positive definite.
  RepeatedSystems(const SparseMatrix& lower, const std::vector<int>& node, const RepeatedSettings& settings);

  /// The solutions for the columns of B; each one's result is added to results(). A stop (Monitor) leaves the columns
  /// not reached at 0, not converged.
  DenseMatrix solve(const DenseMatrix& B, Monitor& monitor);

  const std::vector<SystemResult>& results() const { return results_; }
  double setup_seconds() const { return setup_; }  ///< of the factor or the preconditioner
  /// Memory beside K and the solutions: factor or preconditioner, and the vectors kept; at its greatest.
  double bytes() const;
  /// Vectors kept for the next system.
  int kept() const;

 private:
  DenseMatrix in_turn(const DenseMatrix& B, Monitor& monitor);
  DenseMatrix as_block(const DenseMatrix& B, Monitor& monitor);
  DenseMatrix directly(const DenseMatrix& B);

  const SparseMatrix& K_;
  RepeatedSettings settings_;
  std::optional<Cholesky> cholesky_;
  std::unique_ptr<Preconditioner> preconditioner_;
  std::optional<SuccessiveCg> scg_;
  std::optional<Cglan> cglan_;
  std::vector<SystemResult> results_;
  double setup_ = 0;
};

}  // namespace dotyk::algebra
