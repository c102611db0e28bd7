// Sweeps of Gauss and Seidel.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "multigrid/rows/half_matrix.hpp"
#include "multigrid/rows/local_rows.hpp"

namespace dotyk::multigrid {

/// Sweeps over the nodes of each rank, block by block, with the values that other ranks had before the sweep. Nodes that are coupled to other ranks are swept once
/// more, with the new values: so iterations do not grow with the ranks. The time of a sweep is that of reading the matrix; so it reads the blocks beside
/// the diagonal in single precision. Rounded blocks stay those of a symmetric matrix. A forward sweep before the coarse correction and a backward
/// one after it make a symmetric cycle. Vectors: of own rows. All functions are collective, except bytes().
class Sweeps {
 public:
  /// `A` must outlive this.
  explicit Sweeps(HalfMatrix& A)
      : A_(A), below_(static_cast<std::size_t>(A.half().starts.back()) * A.block() * A.block() + kSpare), inverse_(static_cast<std::size_t>(A.nodes()) * A.block() * A.block()) {
    if (!A.ranks().alone()) moved_.emplace(A.block(), A.nodes());
  }

  /// Takes the numbers of A: all of them the first time, later those that have changed. `changed` flags own rows: a number (i, j) that has changed flags the rows
  /// i and j. `solved`: rows of this rank, counted from its first, ascending, that are solved exactly as well.
  void set(const std::vector<char>& changed, const std::vector<int>& solved);
  /// x = M⁻¹ b where M is a sweep, and left = b − A x, which the sweep computes on its way. `left` may be `b`.
  void forward(const double* b, double* x, double* left);
  /// x += M⁻ᵀ (b − A x).
  void backward(const double* b, double* x);
  double bytes() const { return 4.0 * static_cast<double>(below_.size() + border_.values.size()) + 8.0 * static_cast<double>(inverse_.size()) + (moved_ ? moved_->bytes() : 0); }

 private:
  HalfBlocks<float> half() const;
  HalfBlocks<float> border() const;  ///< rows of the border's nodes, in own columns
  void take(int node);  ///< the numbers of its blocks
  void take_border();
  /// residual −= A x in columns of other ranks.
  void take_off(PaddedVector& residual, const PaddedVector& x);

  HalfMatrix& A_;
  double unit_ = 0;  ///< of below_ and border_: a power of two that brings these numbers to about 1, within the range of floats; 0: no numbers are taken yet
  std::vector<float> below_;
  std::vector<double> inverse_;
  std::vector<int> solved_;
  std::optional<PaddedVector> moved_;  ///< zero but at the border; where there are several ranks
  struct {
    std::vector<int> starts, columns;
    std::vector<float> values;
  } border_;
};

using NodeBlock = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, kMostRows, kMostRows>;

/// The damped diagonal blocks E of the nodes that are coupled to other ranks, in the order of A.border(). A sweep solves with E in place of the diagonal block D there.
///
/// Let A = A_local + A_between, where A_between couples nodes of different ranks. The matrix M of a sweep satisfies M + Mᵀ − A = 2E − D − A_between, with E = D at
/// all other nodes. If this matrix is positive definite, the sweep converges, and a V-cycle of such sweeps is positive definite (Baker, Falgout, Kolev and Yang,
/// SIAM J. Sci. Comput. 33 (2011), §4). The second sweep of the border needs the same condition at the nodes of the border only.
///
/// We take E = (D + max(1, c) W D W)/2, where c is the greatest eigenvalue of A_between v = c W D W v, estimated by Lanczos. W is diagonal: √8 at the rows in
/// `solved`, which are also solved exactly, and 1 at all others. Without this weight a few such rows would make c large and slow down the sweep at all other
/// nodes. Without solved rows c is below 1 if pieces are large, and up to 3.3 if most nodes of a rank are coupled to others.
/// `solved`: rows counted from the rank's first, ascending. Collective.
std::vector<NodeBlock> damped_blocks(HalfMatrix& A, const std::vector<int>& solved);

/// Solves exactly, by CHOLMOD, at unknowns of a stiff and a soft body that a row couples. There sweeps alone would be as many times slower as the root of the
/// contrast (on elements of order 2, whose rows are means, seven times). Before the coarse correction it follows the sweep,
/// after it it comes first, so that the cycle is symmetric. All functions are collective, except any().
class SharedRows {
 public:
  /// Takes the numbers of `matrix` at rows of this rank, counted from its first, ascending; there may be none. False where they are not definite.
  bool set(const HalfMatrix& matrix, const std::vector<int>& shared);
  bool any() const { return any_; }  ///< on any rank
  /// Changes x at the shared unknowns so that b − A x is zero there.
  void solve(Vec b, Vec x);

 private:
  bool any_ = false;
  std::vector<int> shared_;
  OwnedMat rows_, block_;    ///< of the matrix, at the shared unknowns
  OwnedKsp exact_;
  OwnedVec left_, change_;
};

/// Makes `ksp` solve with a sparse matrix that is small enough for a factor, on every rank the same one. Collective.
void factor_on_each(KSP ksp, Mat matrix, MatFactorShiftType shift, MatSolverType library);

/// Makes the factors that `ksp` needs. False where a matrix is not positive definite. Collective; may be false on some ranks only.
bool set_up(KSP ksp);

}  // namespace dotyk::multigrid
