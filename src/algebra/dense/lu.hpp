#pragma once

#include <utility>
#include <vector>

#include "algebra/types.hpp"

namespace dotyk::algebra {

/// A = P L U of a dense square matrix, rows exchanged for the greatest pivot, by LAPACK. Large ones are factored by
/// panels, between which Interrupted is thrown once the monitor asks to stop (stop_factoring.hpp).
class Lu {
 public:
  Lu() = default;
  explicit Lu(DenseMatrix a);

  /// Is no pivot zero or NaN? What solve returns means nothing otherwise.
  bool regular() const;
  /// An estimate of 1/(‖A‖₁‖A⁻¹‖₁); 1 of an empty matrix, 0 of a singular one.
  double rcond() const;
  /// The same of 1/‖A⁻¹‖₁, which bounds the least singular value to a factor of √n.
  double inverse_norm_reciprocal() const { return rcond() * norm_; }

  /// A⁻¹ b and A⁻ᵀ B; as many rows as A.
  Vector solve(Vector b) const { return swept("N", std::move(b)); }
  template <class Columns>
  Columns solve_transposed(Columns b) const { return swept("T", std::move(b)); }

 private:
  template <class Columns>
  Columns swept(const char* transposed, Columns b) const {
    sweep(transposed, b);
    return b;
  }
  void sweep(const char* transposed, Eigen::Ref<DenseMatrix> b) const;

  DenseMatrix lu_;
  std::vector<int> exchanged_;  ///< row k with row exchanged_[k] − 1, in order
  double norm_ = 0;             ///< ‖A‖₁
};

}  // namespace dotyk::algebra
