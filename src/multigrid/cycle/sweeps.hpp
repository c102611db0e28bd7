// Sweeps of Gauss and Seidel.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "multigrid/rows/half_matrix.hpp"

namespace dotyk::multigrid {

/// Sweeps over the nodes of each rank, block by block, with the values that other ranks had before the sweep. Nodes that are coupled to other ranks are swept once
/// more, with the new values: so iterations do not grow with the ranks. The time of a sweep is that of reading the matrix; so it reads the blocks beside
/// the diagonal in single precision. Rounded blocks stay those of a symmetric matrix. A forward sweep before the coarse correction and a backward
/// one after it make a symmetric cycle. Vectors: of own rows. All functions are collective, except bytes().
class Sweeps {
 public:
  /// `A` must outlive this.
  explicit Sweeps(HalfMatrix& A) : A_(A) {
    if (!A.ranks().alone()) moved_.emplace(A.block(), A.nodes());
  }

  /// Takes the numbers of A. `solved`: rows of this rank, counted from its first, ascending, that are solved exactly as well.
  void set(const std::vector<int>& solved = {});
  /// x = M⁻¹ b where M is a sweep, and left = b − A x, which the sweep computes on its way. `left` may be `b`.
  void forward(const double* b, double* x, double* left);
  /// x += M⁻ᵀ (b − A x).
  void backward(const double* b, double* x);
  double bytes() const { return 4.0 * static_cast<double>(below_.size() + border_.values.size()) + 8.0 * static_cast<double>(inverse_.size()) + (moved_ ? moved_->bytes() : 0); }

 private:
  HalfBlocks<float> half() const;
  HalfBlocks<float> border() const;  ///< rows of the border's nodes, in own columns
  void take_border();
  /// residual −= A x in columns of other ranks.
  void take_off(PaddedVector& residual, const PaddedVector& x);

  HalfMatrix& A_;
  double unit_ = 1;  ///< of below_ and border_: a power of two that brings these numbers to about 1, within the range of floats
  std::vector<float> below_;
  std::vector<double> inverse_;
  std::optional<PaddedVector> moved_;  ///< zero but at the border; where there are several ranks
  struct {
    std::vector<int> starts, columns;
    std::vector<float> values;
  } border_;
};

using NodeBlock = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, kMostRows, kMostRows>;

/// What such sweeps divide by at the nodes that are coupled to other ranks, in the order of A.border(). A = A_local + A_between, where A_between couples nodes of
/// different ranks, and D has the blocks of the diagonal. The matrix M of a sweep that divides by blocks E satisfies M + Mᵀ − A = 2E − D − A_between; E is D at all
/// other nodes. If this is positive definite, the sweep converges and a V-cycle of it is positive definite (Baker, Falgout, Kolev and Yang, SIAM J. Sci.
/// Comput. 33 (2011), §4). The second sweep of the border meets the same condition on these nodes alone. So E = (D + max(1, c) W D W)/2, where c is the
/// greatest eigenvalue of A_between v = c W D W v, as Lanczos estimates it. W is diagonal: √8 at rows that are `solved` exactly as well (counted from the
/// rank's first, ascending), 1 at all others. Few solved rows would else make c large, and the sweep of all others slow. Without them c is below 1 if pieces
/// are large, and up to 3.3 if most nodes of a rank are coupled to others. Collective.
std::vector<NodeBlock> damped_blocks(HalfMatrix& A, const std::vector<int>& solved);

}  // namespace dotyk::multigrid
