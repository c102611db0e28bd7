#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "algebra/types.hpp"

// Eigen's dense decompositions, compiled once: each file that instantiates one takes seconds longer to compile.

namespace dotyk::algebra {

/// A = V diag(values) Vᵀ of a symmetric A, whose lower triangle is read: eigenvalues ascending, eigenvectors as columns.
struct Eigenpairs {
  Vector values;
  DenseMatrix vectors;
};
Eigenpairs eigenpairs(const DenseMatrix& A);
Vector eigenvalues(const DenseMatrix& A);
/// Of the symmetric tridiagonal matrix, by QR steps; `off_diagonal` is shorter by one.
Eigenpairs tridiagonal_eigenpairs(const Vector& diagonal, const Vector& off_diagonal);
/// Its `count` least ones, all where there are fewer, by LAPACK's dstevr (multiple relatively robust representations).
Eigenpairs lowest_eigenpairs(Vector diagonal, Vector off_diagonal, int count);

/// The same of a 3×3 matrix.
struct Eigenpairs3 {
  Eigen::Vector3d values;
  Eigen::Matrix3d vectors;
};
Eigenpairs3 eigenpairs3(const Eigen::Matrix3d& A);
Eigen::Vector3d eigenvalues3(const Eigen::Matrix3d& A);

/// A = U diag(values) Vᵀ by Jacobi's rotations: U of A's size, V square. As many values as A has columns, descending.
struct SingularFactors {
  DenseMatrix U;
  Vector values;
  DenseMatrix V;
  /// How many values exceed `least`.
  Eigen::Index rank(double least) const { return (values.array() > least).count(); }
};
SingularFactors singular_factors(const DenseMatrix& A);

/// A P = Q R by reflections, the column with the greatest remainder first: R's diagonal, and the columns of A in the
/// order in which they were taken.
struct PivotedFactors {
  Vector diagonal;  ///< descending in magnitude
  std::vector<int> order;
};
PivotedFactors pivoted_factors(const DenseMatrix& A);

/// An orthonormal basis of the span of A's columns. Columns are taken by pivoting as above, until what is left of the others is below `threshold`
/// times the first.
DenseMatrix span(const DenseMatrix& A, double threshold);

/// An orthonormal basis of the vectors at right angles to e ≠ 0.
DenseMatrix complement(const Vector& e);

/// The X that makes each column of A X − B as short as possible, by reflections with pivoting. If columns of A depend on each other, rows of X
/// that are not needed are zero.
DenseMatrix least_squares(const DenseMatrix& A, const DenseMatrix& B);
Vector least_squares(const DenseMatrix& A, const Vector& b);

/// The shortest x of least ‖A x − b‖, by a complete orthogonal decomposition.
class MinimumNorm {
 public:
  /// Pivots below `threshold` of the greatest are taken for zero; without one, those that rounding makes.
  explicit MinimumNorm(const DenseMatrix& A, std::optional<double> threshold = {});
  Vector solve(const Vector& b) const;
  DenseMatrix solve(const DenseMatrix& B) const;
  Vector solve_transposed(const Vector& b) const;

 private:
  std::shared_ptr<const Eigen::CompleteOrthogonalDecomposition<DenseMatrix>> factor_;
};

/// A = Pᵀ L D Lᵀ P of a symmetric semidefinite A, whose lower triangle is read.
class Ldlt {
 public:
  explicit Ldlt(const DenseMatrix& A);
  /// An estimate of 1/(‖A‖₁‖A⁻¹‖₁).
  double rcond() const;
  Vector solve(const Vector& b) const;
  DenseMatrix solve(const DenseMatrix& B) const;

 private:
  std::shared_ptr<const Eigen::LDLT<DenseMatrix>> factor_;
};

/// P A Q = L U with rows and columns exchanged for the greatest pivot, which tells the rank.
class PivotedLu {
 public:
  /// Pivots below `threshold` of the greatest are taken for zero; without one, those that rounding makes.
  explicit PivotedLu(const DenseMatrix& A, std::optional<double> threshold = {});
  bool regular() const;
  int rank() const;
  /// A solution, if A x = b has one.
  Vector solve(const Vector& b) const;
  /// A basis of the null space, as columns; one column of zeros if there is none.
  DenseMatrix kernel() const;

 private:
  std::shared_ptr<const Eigen::FullPivLU<DenseMatrix>> factor_;
};

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
