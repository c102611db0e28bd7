// Sweeps and products with half of a symmetric matrix.
#pragma once

#include <span>
#include <stdexcept>
#include <vector>

namespace dotyk::multigrid {

/// A symmetric matrix A = L + D + Lᵀ of square blocks, a row and a column of them a node: the blocks of D and those of L, each row by row.
template <class Number>
struct HalfBlocks {
  int size;                     ///< rows of a node
  std::span<const int> starts;  ///< of the nodes' blocks in L, and the number of all
  const int* columns;           ///< nodes
  const Number* below;          ///< L in this unit; kSpare numbers more than the blocks have may be read
  double unit;
  const double* diagonal;       ///< D
  int nodes() const { return static_cast<int>(starts.size()) - 1; }
};

inline constexpr int kMostRows = 6, kSpare = 8;

/// A vector for these functions: the numbers of each node, and padding.
class PaddedVector {
 public:
  /// Throws std::runtime_error where a node has more than kMostRows rows.
  PaddedVector(int size, int nodes);
  double* data() { return numbers_.data(); }
  const double* data() const { return numbers_.data(); }
  int width() const { return width_; }  ///< numbers of a node with their padding
  double* of(int node) { return numbers_.data() + static_cast<std::size_t>(node) * width_; }
  void take(const double* from);
  void give(double* to) const;
  double bytes() const { return 8.0 * static_cast<double>(numbers_.size()); }

 private:
  int size_, width_;
  std::vector<double> numbers_;
};

/// Calls work.operator()<rows>() with the rows of a node as a constant.
template <class Work>
void dispatch(int rows, const Work& work) {
  switch (rows) {
    case 1: return work.template operator()<1>();
    case 2: return work.template operator()<2>();
    case 3: return work.template operator()<3>();
    case 4: return work.template operator()<4>();
    case 5: return work.template operator()<5>();
    case 6: return work.template operator()<6>();
    default: throw std::logic_error("multigrid: blocks of this size have no kernel");
  }
}

/// The inverse of a symmetric block, by its Cholesky factor, so that it is positive definite. Where the block is not: that of its diagonal times the rows, which
/// is no less than a semidefinite block. kMostRows rows at most.
void invert(int rows, const double* block, double* inverse);

/// y = A x.
void multiply(const HalfBlocks<double>& A, PaddedVector& x, PaddedVector& y);

/// x = (E + L)⁻¹ left, then left −= A x. `inverse`: the blocks of E⁻¹, where E is D, or damped.
void sweep_forward(const HalfBlocks<float>& A, const double* inverse, PaddedVector& x, PaddedVector& left);

/// x += (E + Lᵀ)⁻¹ (b − A x). `b` is changed.
void sweep_backward(const HalfBlocks<float>& A, const double* inverse, PaddedVector& b, PaddedVector& x);

/// Sweeps over some nodes alone. `rows`: of the k-th of them all blocks beside the diagonal; D and `inverse` have all nodes.
/// One after the other moves by `inverse` times what is left there. The movements are added to x and put into `moved`; left −= A moved.
void sweep_forward(const HalfBlocks<float>& rows, std::span<const int> nodes, const double* inverse, PaddedVector& x, PaddedVector& left, PaddedVector& moved);
/// The same from the last to the first, where b − beyond − A x is left.
void sweep_backward(const HalfBlocks<float>& rows, std::span<const int> nodes, const double* inverse, PaddedVector& b, PaddedVector& beyond, PaddedVector& x);

}  // namespace dotyk::multigrid
