// Sweeps of Gauss and Seidel.
#pragma once

#include <memory>
#include <vector>

#include "multigrid/border.hpp"

namespace dotyk::multigrid {

/// Relaxed sweeps over the rows of each rank, which take the values that other ranks had before. A = L + D + Lᵀ on the rank's own columns. They read half of the
/// matrix, in single precision, since what they do is memory traffic: a row's part left of the diagonal serves the rows above it as well. So forward() tells
/// the residual, too, and backward() needs each number once. The numbers are those of a symmetric matrix, which makes a cycle of one and the other symmetric.
/// All functions are collective.
class Sweeps {
 public:
  explicit Sweeps(Mat A);

  /// Takes the numbers of A, and the relaxation ω.
  void set(Mat A, double omega);
  /// x = (D/ω + L)⁻¹ b, and left = b − A x.
  void forward(Vec b, Vec x, Vec left);
  /// x += (D/ω + Lᵀ)⁻¹ (b − A x).
  void backward(Vec b, Vec x);
  double bytes() const;

 private:
  int block_ = 1;                        ///< rows of a node
  double scale_ = 1;                     ///< a power of two that brings the numbers to about 1, so that they are within the range of floats
  std::vector<int> starts_, columns_;    ///< of a node's blocks left of the diagonal, ascending; nodes of this rank
  std::vector<float> numbers_;           ///< of these blocks, row by row
  std::vector<float> diagonal_;          ///< blocks of the nodes
  std::vector<float> inverse_;           ///< ω / D, by rows
  std::vector<double> x_, left_;         ///< by nodes, each padded
  Border border_;
};

}  // namespace dotyk::multigrid
