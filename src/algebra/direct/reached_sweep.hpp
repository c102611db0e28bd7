#pragma once

#include <vector>

#include "algebra/types.hpp"

struct cholmod_factor_struct;

namespace dotyk::algebra {

/// The forward sweep Y = L⁻¹ P Bᵀ with a supernodal factor A = Pᵀ L Lᵀ P, for sparse rows B (rows × unknowns). Y is zero but where the elimination tree
/// leads from an unknown of B up to the root (Davis 2006 §3.2): there alone it is made.
class ReachedSweep {
 public:
  /// `factor` and `rows` must outlive this object. `also`: further positions in the factor's order that count as reached.
  ReachedSweep(const cholmod_factor_struct& factor, const SparseRows& rows, const std::vector<int>& also);

  Eigen::Index rows() const { return rows_.rows(); }
  double flops() const { return 2.0 * entries_ * static_cast<double>(rows()); }
  double bytes() const { return 8.0 * static_cast<double>(positions_.size()) * static_cast<double>(rows()); }
  /// Where Y may differ from zero, ascending.
  const std::vector<int>& positions() const { return positions_; }
  /// Y there: positions × rows.
  DenseMatrix values() const;

 private:
  const cholmod_factor_struct& factor_;
  const SparseRows& rows_;
  std::vector<int> supernodes_, positions_;  ///< reached, ascending
  std::vector<int> place_;                   ///< of a position among positions_, or -1
  double entries_ = 0;                       ///< of L, in the columns that are reached
};

}  // namespace dotyk::algebra
