#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algebra/direct/cholesky.hpp"
#include "algebra/krylov/recycling.hpp"

namespace dotyk::algebra {

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
