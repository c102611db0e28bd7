#pragma once

#include <vector>

#include "algebra/krylov/conjugate_gradient.hpp"

namespace dotyk::algebra {

struct BlockCgResult {
  DenseMatrix x;
  int iterations = 0;           ///< block steps
  std::vector<int> settled;     ///< of each column: the step in which its residual met the goal; -1 where it did not
  std::vector<double> residual; ///< of each column: ‖b − K x‖ / ‖b‖; 0 for b = 0
  long products = 0;            ///< directions that Â was applied to
  int least_rank = 0;           ///< the fewest directions of a step
  bool converged = false;
  std::string reason;
};

/// Block conjugate gradients for K X = B, all columns of B (n × k) at once (O'Leary 1980): in every step each column is
/// minimised over a block of directions P that all columns share,
///   X += P (PᵀÂP)⁻¹ PᵀR,   R −= Â P (PᵀÂP)⁻¹ PᵀR,   P := orth(R − P (PᵀÂP)⁻¹ (ÂP)ᵀR).
/// Dependent directions (equal or dependent right-hand sides, systems that are solved) would make PᵀÂP singular:
/// orth, a QR factorisation with column pivoting, leaves out those below 1e-10 of the greatest (Ji and Li 2017).
/// Residuals are those of K x = b, formed each step, and at the end from X; as in conjugate_gradient, X is corrected
/// by a further run where that misses the goal; no run goes further than by 32 ε.
BlockCgResult block_cg(const Preconditioner& preconditioner, const DenseMatrix& B, const CgSettings& settings,
                       Monitor& monitor);

}  // namespace dotyk::algebra
