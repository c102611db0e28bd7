#include "multigrid/rows/kernels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

// Each block of L is read once. It serves its row, and by its transpose the rows above it. Sweeps over some nodes are given all blocks of these rows instead.
// Rows of blocks are read as vectors of the compiler's, with lanes beyond a node's numbers. The results in these lanes go into padding, which is never read.
namespace dotyk::multigrid {

namespace {

/// The least power of two from 2 on that is not below `rows`.
constexpr int padded(int rows) { return rows <= 2 ? 2 : 2 * padded((rows + 1) / 2); }

/// Vectors of `width` numbers; where they are made of a parameter, GCC 12 does not know them as vectors.
template <class Number, int width>
struct Wide;
#define DOTYK_WIDE(Number, width)                                          \
  template <>                                                              \
  struct Wide<Number, width> {                                             \
    typedef Number Type __attribute__((vector_size(sizeof(Number) * width))); \
  };
DOTYK_WIDE(double, 2)
DOTYK_WIDE(double, 4)
DOTYK_WIDE(double, 8)
DOTYK_WIDE(float, 2)
DOTYK_WIDE(float, 4)
DOTYK_WIDE(float, 8)
#undef DOTYK_WIDE

/// A loop over the `rows` of a block. Without the pragma GCC 12 does not unroll such loops. It then keeps sums in memory, and sweeps take twice the time.
#define DOTYK_EACH(row) _Pragma("GCC unroll 8") for (int row = 0; row < rows; ++row)

/// What the kernels know of blocks, nodes of `rows` rows.
template <int rows, class Number>
struct Kernel {
  static constexpr int kWidth = padded(rows);
  using Lanes = typename Wide<double, kWidth>::Type;
  using Numbers = typename Wide<Number, kWidth>::Type;

  const HalfBlocks<Number>& A;

  [[gnu::always_inline]] const Number* block(int k) const { return A.below + static_cast<std::int64_t>(k) * (rows * rows); }
  [[gnu::always_inline]] static const double* block(const double* blocks, int node) { return blocks + static_cast<std::int64_t>(node) * (rows * rows); }
  [[gnu::always_inline]] static double* at(double* v, int node) { return v + static_cast<std::int64_t>(node) * kWidth; }
  [[gnu::always_inline]] static void load(const double* from, Lanes& to) { std::memcpy(&to, from, sizeof to); }

  /// to += factor × a row of a block.
  template <class Factor>
  [[gnu::always_inline]] static void add_row(const Number* block, int r, const Factor& factor, Lanes& to) {
    Numbers numbers;
    std::memcpy(&numbers, block + r * rows, sizeof numbers);
    to += __builtin_convertvector(numbers, Lanes) * factor;
  }

  /// sum = (L x) at a node.
  [[gnu::always_inline]] void gather(int node, double* x, double (&sum)[rows]) const {
    Lanes products[rows] = {};
    for (int k = A.starts[node]; k < A.starts[node + 1]; ++k) {
      Lanes xj;
      load(at(x, A.columns[k]), xj);
      DOTYK_EACH(r) add_row(block(k), r, xj, products[r]);
    }
    DOTYK_EACH(r) {
      sum[r] = products[r][0];
      for (int c = 1; c < rows; ++c) sum[r] += products[r][c];
      sum[r] *= A.unit;
    }
  }

  /// y += factor Lᵀ x for an x that is zero but at a node.
  [[gnu::always_inline]] void spread(int node, double factor, const double (&x)[rows], double* y) const {
    double times[rows];
    DOTYK_EACH(r) times[r] = factor * A.unit * x[r];
    for (int k = A.starts[node]; k < A.starts[node + 1]; ++k) {
      double* to = at(y, A.columns[k]);
      Lanes sum;
      load(to, sum);
      DOTYK_EACH(r) add_row(block(k), r, times[r], sum);
      std::memcpy(to, &sum, sizeof sum);
    }
  }

  /// to += factor × a block times x.
  [[gnu::always_inline]] static void add_product(const double* block, double factor, const double (&x)[rows], double (&to)[rows]) {
    DOTYK_EACH(r)
      DOTYK_EACH(c) to[r] += factor * block[r * rows + c] * x[c];
  }
  [[gnu::always_inline]] static void copy(const double* from, double (&to)[rows]) { std::memcpy(to, from, sizeof to); }
  [[gnu::always_inline]] static void copy(const double (&from)[rows], double* to) { std::memcpy(to, from, sizeof from); }

  [[gnu::always_inline]] void multiply(double* x, double* y) const {
    for (int i = 0; i < A.nodes(); ++i) {
      double sum[rows], xi[rows];
      gather(i, x, sum);
      copy(at(x, i), xi);
      add_product(block(A.diagonal, i), 1, xi, sum);
      copy(sum, at(y, i));
      spread(i, 1, xi, y);
    }
  }

  [[gnu::always_inline]] void forward(const double* inverse, double* x, double* left) const {
    for (int i = 0; i < A.nodes(); ++i) {
      double sum[rows], own_left[rows], xi[rows] = {};
      gather(i, x, sum);
      copy(at(left, i), own_left);
      DOTYK_EACH(r) own_left[r] -= sum[r];
      add_product(block(inverse, i), 1, own_left, xi);
      add_product(block(A.diagonal, i), -1, xi, own_left);
      copy(xi, at(x, i)), copy(own_left, at(left, i));
      spread(i, -1, xi, left);
    }
  }

  [[gnu::always_inline]] void backward(const double* inverse, double* b, double* x) const {
    for (int i = A.nodes(); i-- > 0;) {
      double sum[rows], own_left[rows], xi[rows];
      gather(i, x, sum);
      copy(at(x, i), xi), copy(at(b, i), own_left);
      DOTYK_EACH(r) own_left[r] -= sum[r];
      add_product(block(A.diagonal, i), -1, xi, own_left);
      add_product(block(inverse, i), 1, own_left, xi);
      copy(xi, at(x, i));
      spread(i, -1, xi, b);
    }
  }

  [[gnu::always_inline]] void forward(std::span<const int> nodes, const double* inverse, double* x, double* left, double* moved) const {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const int i = nodes[k];
      double own_left[rows], xi[rows], by[rows] = {};
      copy(at(x, i), xi), copy(at(left, i), own_left);
      add_product(block(inverse, i), 1, own_left, by);
      DOTYK_EACH(r) xi[r] += by[r];
      add_product(block(A.diagonal, i), -1, by, own_left);
      copy(xi, at(x, i)), copy(own_left, at(left, i)), copy(by, at(moved, i));
      spread(static_cast<int>(k), -1, by, left);
    }
  }

  [[gnu::always_inline]] void backward(std::span<const int> nodes, const double* inverse, double* b, double* beyond, double* x) const {
    for (std::size_t k = nodes.size(); k-- > 0;) {
      const int i = nodes[k];
      double sum[rows], own_left[rows], xi[rows], from_beyond[rows];
      gather(static_cast<int>(k), x, sum);
      copy(at(x, i), xi), copy(at(b, i), own_left), copy(at(beyond, i), from_beyond);
      DOTYK_EACH(r) own_left[r] -= from_beyond[r] + sum[r];
      add_product(block(A.diagonal, i), -1, xi, own_left);
      add_product(block(inverse, i), 1, own_left, xi);
      copy(xi, at(x, i));
    }
  }
};

#undef DOTYK_EACH

#ifdef __x86_64__
#define DOTYK_CLONES [[gnu::target_clones("arch=x86-64-v3", "default")]]
#else
#define DOTYK_CLONES
#endif

// Nodes of solids in space: compiled for AVX2 as well.
DOTYK_CLONES void multiply_of_three(const HalfBlocks<double>& A, double* x, double* y) { Kernel<3, double>{A}.multiply(x, y); }
DOTYK_CLONES void forward_of_three(const HalfBlocks<float>& A, const double* inverse, double* x, double* left) { Kernel<3, float>{A}.forward(inverse, x, left); }
DOTYK_CLONES void backward_of_three(const HalfBlocks<float>& A, const double* inverse, double* b, double* x) { Kernel<3, float>{A}.backward(inverse, b, x); }
DOTYK_CLONES void some_forward_of_three(const HalfBlocks<float>& rows, std::span<const int> nodes, const double* inverse, double* x, double* left, double* moved) {
  Kernel<3, float>{rows}.forward(nodes, inverse, x, left, moved);
}
DOTYK_CLONES void some_backward_of_three(const HalfBlocks<float>& rows, std::span<const int> nodes, const double* inverse, double* b, double* beyond, double* x) {
  Kernel<3, float>{rows}.backward(nodes, inverse, b, beyond, x);
}

/// False where the block is not positive definite.
template <int rows>
[[gnu::always_inline]] inline bool inverted(const double* block, double* inverse) {
  double G[rows][rows] = {}, inverse_factor[rows][rows] = {};  // the block is G Gᵀ
  for (int j = 0; j < rows; ++j)
    for (int i = j; i < rows; ++i) {
      double sum = block[i * rows + j];
      for (int k = 0; k < j; ++k) sum -= G[i][k] * G[j][k];
      if (i == j && !(sum > 0)) return false;
      G[i][j] = i == j ? std::sqrt(sum) : sum / G[j][j];
    }
  for (int j = 0; j < rows; ++j)
    for (int i = j; i < rows; ++i) {
      double sum = i == j;
      for (int k = j; k < i; ++k) sum -= G[i][k] * inverse_factor[k][j];
      inverse_factor[i][j] = sum / G[i][i];
    }
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < rows; ++j) {
      double sum = 0;
      for (int k = std::max(i, j); k < rows; ++k) sum += inverse_factor[k][i] * inverse_factor[k][j];
      inverse[i * rows + j] = sum;
    }
  return true;
}

}  // namespace

PaddedVector::PaddedVector(int size, int nodes) : size_(size), width_(padded(size)), numbers_(static_cast<std::size_t>(nodes) * width_, 0.0) {
  if (size > kMostRows) throw std::runtime_error("multigrid: a node has more than six unknowns");
}

void PaddedVector::take(const double* from) {
  for (std::size_t i = 0; i < numbers_.size(); i += width_, from += size_)
    for (int r = 0; r < size_; ++r) numbers_[i + r] = from[r];
}

void PaddedVector::give(double* to) const {
  for (std::size_t i = 0; i < numbers_.size(); i += width_, to += size_)
    for (int r = 0; r < size_; ++r) to[r] = numbers_[i + r];
}

void invert(int rows, const double* block, double* inverse) {
  bool done = false;
  dispatch(rows, [&]<int constant>() { done = inverted<constant>(block, inverse); });
  if (done) return;
  for (int k = 0; k < rows * rows; ++k) inverse[k] = k % (rows + 1) == 0 ? 1 / (rows * block[k]) : 0;
}

void multiply(const HalfBlocks<double>& A, PaddedVector& x, PaddedVector& y) {
  if (A.size == 3) return multiply_of_three(A, x.data(), y.data());
  dispatch(A.size, [&]<int rows>() { Kernel<rows, double>{A}.multiply(x.data(), y.data()); });
}

void sweep_forward(const HalfBlocks<float>& A, const double* inverse, PaddedVector& x, PaddedVector& left) {
  if (A.size == 3) return forward_of_three(A, inverse, x.data(), left.data());
  dispatch(A.size, [&]<int rows>() { Kernel<rows, float>{A}.forward(inverse, x.data(), left.data()); });
}

void sweep_backward(const HalfBlocks<float>& A, const double* inverse, PaddedVector& b, PaddedVector& x) {
  if (A.size == 3) return backward_of_three(A, inverse, b.data(), x.data());
  dispatch(A.size, [&]<int rows>() { Kernel<rows, float>{A}.backward(inverse, b.data(), x.data()); });
}

void sweep_forward(const HalfBlocks<float>& rows, std::span<const int> nodes, const double* inverse, PaddedVector& x, PaddedVector& left, PaddedVector& moved) {
  if (rows.size == 3) return some_forward_of_three(rows, nodes, inverse, x.data(), left.data(), moved.data());
  dispatch(rows.size, [&]<int count>() { Kernel<count, float>{rows}.forward(nodes, inverse, x.data(), left.data(), moved.data()); });
}

void sweep_backward(const HalfBlocks<float>& rows, std::span<const int> nodes, const double* inverse, PaddedVector& b, PaddedVector& beyond, PaddedVector& x) {
  if (rows.size == 3) return some_backward_of_three(rows, nodes, inverse, b.data(), beyond.data(), x.data());
  dispatch(rows.size, [&]<int count>() { Kernel<count, float>{rows}.backward(nodes, inverse, b.data(), beyond.data(), x.data()); });
}

}  // namespace dotyk::multigrid
