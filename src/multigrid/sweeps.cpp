#include "multigrid/sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "multigrid/local_rows.hpp"

namespace dotyk::multigrid {

namespace {

/// The least power of two from 2 on that is not below `rows`.
constexpr int padded(int rows) { return rows <= 2 ? 2 : 2 * padded((rows + 1) / 2); }

struct Blocks {
  int nodes;
  const int *starts, *columns;
  const float *numbers, *diagonal, *inverse;
  double scale;  ///< of the numbers, over those of A
};

/// Vectors of the compiler's.
template <int width>
struct Wide;
template <>
struct Wide<2> {
  typedef double Lanes __attribute__((vector_size(16)));
  typedef float Floats __attribute__((vector_size(8)));
};
template <>
struct Wide<4> {
  typedef double Lanes __attribute__((vector_size(32)));
  typedef float Floats __attribute__((vector_size(16)));
};
template <>
struct Wide<8> {
  typedef double Lanes __attribute__((vector_size(64)));
  typedef float Floats __attribute__((vector_size(32)));
};

/// Numbers of one node.
template <int rows>
struct Node {
  static constexpr int kWidth = padded(rows);
  using Lanes = typename Wide<kWidth>::Lanes;
  using Floats = typename Wide<kWidth>::Floats;

  /// to += factor × a row of a block; lanes beyond `rows` have numbers of what follows.
  template <class Factor>
  [[gnu::always_inline]] static void add_row(const float* block, int r, const Factor& factor, Lanes& to) {
    Floats numbers;
    std::memcpy(&numbers, block + r * rows, sizeof numbers);
    to += __builtin_convertvector(numbers, Lanes) * factor;
  }
};

/// Σ A_ij x_j over a node's blocks left of the diagonal.
template <int rows>
[[gnu::always_inline]] inline void gather(const Blocks& m, int node, const double* x, double (&sum)[rows]) {
  using N = Node<rows>;
  typename N::Lanes products[rows] = {};
  for (int k = m.starts[node]; k < m.starts[node + 1]; ++k) {
    const float* block = m.numbers + static_cast<std::int64_t>(k) * (rows * rows);
    const auto& xj = *reinterpret_cast<const typename N::Lanes*>(x + static_cast<std::int64_t>(m.columns[k]) * N::kWidth);
    for (int r = 0; r < rows; ++r) N::add_row(block, r, xj, products[r]);
  }
  for (int r = 0; r < rows; ++r) {
    sum[r] = products[r][0];
    for (int c = 1; c < rows; ++c) sum[r] += products[r][c];
  }
}

/// left_j −= A_ijᵀ x_i over the same blocks.
template <int rows>
[[gnu::always_inline]] inline void spread(const Blocks& m, int node, const double (&xi)[rows], double* left) {
  using N = Node<rows>;
  for (int k = m.starts[node]; k < m.starts[node + 1]; ++k) {
    const float* block = m.numbers + static_cast<std::int64_t>(k) * (rows * rows);
    auto& to = *reinterpret_cast<typename N::Lanes*>(left + static_cast<std::int64_t>(m.columns[k]) * N::kWidth);
    typename N::Lanes sum = to;
    for (int r = 0; r < rows; ++r) N::add_row(block, r, -xi[r], sum);
    to = sum;
  }
}

template <int rows>
[[gnu::always_inline]] inline void sweep_forward(const Blocks& m, const double* b, double* x, double* left) {
  constexpr int kWidth = Node<rows>::kWidth;
  for (int i = 0; i < m.nodes; ++i) {
    double s[rows], xi[rows];
    gather<rows>(m, i, x, s);
    const float *d = m.diagonal + static_cast<std::int64_t>(i) * (rows * rows), *inverse = m.inverse + static_cast<std::int64_t>(i) * rows;
    double *own = x + static_cast<std::int64_t>(i) * kWidth, *own_left = left + static_cast<std::int64_t>(i) * kWidth;
    for (int r = 0; r < rows; ++r) {
      s[r] = m.scale * b[static_cast<std::int64_t>(i) * rows + r] - s[r];
      double sum = s[r];
      for (int c = 0; c < r; ++c) sum -= d[r * rows + c] * xi[c];
      own[r] = xi[r] = inverse[r] * sum;
    }
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < rows; ++c) s[r] -= d[r * rows + c] * xi[c];
      own_left[r] = s[r];
    }
    spread<rows>(m, i, xi, left);
  }
}

/// `left`: b less what other ranks' values take of it.
template <int rows>
[[gnu::always_inline]] inline void sweep_backward(const Blocks& m, double* left, double* x) {
  constexpr int kWidth = Node<rows>::kWidth;
  for (int i = m.nodes; i-- > 0;) {
    double s[rows], xi[rows], change[rows];
    gather<rows>(m, i, x, s);
    const float *d = m.diagonal + static_cast<std::int64_t>(i) * (rows * rows), *inverse = m.inverse + static_cast<std::int64_t>(i) * rows;
    double *own = x + static_cast<std::int64_t>(i) * kWidth, *own_left = left + static_cast<std::int64_t>(i) * kWidth;
    for (int r = 0; r < rows; ++r) {
      s[r] = own_left[r] - s[r];
      for (int c = 0; c < rows; ++c) s[r] -= d[r * rows + c] * own[c];
    }
    for (int r = rows; r-- > 0;) {
      for (int c = r + 1; c < rows; ++c) s[r] -= d[r * rows + c] * change[c];
      change[r] = inverse[r] * s[r];
    }
    for (int r = 0; r < rows; ++r) own[r] = xi[r] = own[r] + change[r];
    spread<rows>(m, i, xi, left);
  }
}

#ifdef __x86_64__
#define DOTYK_CLONES [[gnu::target_clones("arch=haswell", "default")]]
#else
#define DOTYK_CLONES
#endif

DOTYK_CLONES void forward_of_three(const Blocks& m, const double* b, double* x, double* left) { sweep_forward<3>(m, b, x, left); }
DOTYK_CLONES void backward_of_three(const Blocks& m, double* left, double* x) { sweep_backward<3>(m, left, x); }

void forward_of(int rows, const Blocks& m, const double* b, double* x, double* left) {
  switch (rows) {
    case 2: return sweep_forward<2>(m, b, x, left);
    case 3: return forward_of_three(m, b, x, left);
    case 6: return sweep_forward<6>(m, b, x, left);
    default: return sweep_forward<1>(m, b, x, left);
  }
}

void backward_of(int rows, const Blocks& m, double* left, double* x) {
  switch (rows) {
    case 2: return sweep_backward<2>(m, left, x);
    case 3: return backward_of_three(m, left, x);
    case 6: return sweep_backward<6>(m, left, x);
    default: return sweep_backward<1>(m, left, x);
  }
}

/// Copies a vector without padding to a padded one, or back.
void pad(int rows, double factor, const double* from, std::vector<double>& to) {
  const std::size_t width = static_cast<std::size_t>(padded(rows));
  for (std::size_t i = 0; i < to.size(); i += width, from += rows)
    for (int r = 0; r < rows; ++r) to[i + r] = factor * from[r];
}
void unpad(int rows, double factor, const std::vector<double>& from, double* to) {
  const std::size_t width = static_cast<std::size_t>(padded(rows));
  for (std::size_t i = 0; i < from.size(); i += width, to += rows)
    for (int r = 0; r < rows; ++r) to[r] = factor * from[i + r];
}

}  // namespace

Sweeps::Sweeps(Mat A) : block_(BlockSize(A).rows), border_(A) {
  if (block_ != 2 && block_ != 3 && block_ != 6) block_ = 1;
  const LocalRows view(A);
  const int nodes = view.count() / block_;
  starts_.assign(1, 0);
  std::vector<int> left;
  for (int i = 0; i < nodes; ++i) {
    left.clear();
    for (int row = i * block_; row < (i + 1) * block_; ++row)
      for (int k = view.own->starts[row]; k < view.own->starts[row + 1]; ++k)
        if (const int j = view.own->columns[k] / block_; j < i && (left.empty() || left.back() != j)) left.push_back(j);
    std::sort(left.begin(), left.end());
    columns_.insert(columns_.end(), left.begin(), std::unique(left.begin(), left.end()));
    starts_.push_back(static_cast<int>(columns_.size()));
  }
  x_.assign(static_cast<std::size_t>(nodes) * padded(block_), 0.0), left_ = x_;
}

void Sweeps::set(Mat A, double omega) {
  const LocalRows view(A);
  double greatest = 0;
  for (int row = 0; row < view.count(); ++row) greatest = std::max(greatest, *view.find(row, view.first_row + row));
  scale_ = std::exp2(-std::ilogb(greatest > 0 ? greatest : 1));
  const std::size_t square = static_cast<std::size_t>(block_ * block_), nodes = starts_.size() - 1;
  numbers_.assign(columns_.size() * square + static_cast<std::size_t>(padded(block_)), 0.0F);
  diagonal_.assign(nodes * square, 0.0F), inverse_.assign(nodes * block_, 0.0F);
  for (std::size_t i = 0; i < nodes; ++i)
    for (int r = 0; r < block_; ++r) {
      const int row = static_cast<int>(i) * block_ + r;
      std::size_t at = static_cast<std::size_t>(starts_[i]);
      for (int k = view.own->starts[row]; k < view.own->starts[row + 1]; ++k) {
        const int column = view.own->columns[k], j = column / block_, c = column % block_;
        const double number = scale_ * view.own->values[k];
        if (j > static_cast<int>(i)) break;
        if (j == static_cast<int>(i)) {
          diagonal_[i * square + r * block_ + c] = static_cast<float>(number);
          if (c == r) inverse_[row] = static_cast<float>(omega / number);
          continue;
        }
        while (columns_[at] < j) ++at;
        numbers_[at * square + r * block_ + c] = static_cast<float>(number);
      }
    }
  border_.fetch(A);
}

void Sweeps::forward(Vec b, Vec x, Vec left) {
  const Blocks m{static_cast<int>(starts_.size()) - 1, starts_.data(), columns_.data(), numbers_.data(), diagonal_.data(), inverse_.data(), scale_};
  const PetscScalar* given = nullptr;
  PetscScalar* to = nullptr;
  check(VecGetArrayRead(b, &given));
  forward_of(block_, m, given, x_.data(), left_.data());
  check(VecRestoreArrayRead(b, &given));
  check(VecGetArrayWrite(x, &to));
  unpad(block_, 1, x_, to);
  check(VecRestoreArrayWrite(x, &to));
  const std::vector<double>& others = border_.times(x);
  check(VecGetArrayWrite(left, &to));
  unpad(block_, 1 / scale_, left_, to);
  for (std::size_t k = 0; k < others.size(); ++k) to[border_.rows()[k]] -= others[k];
  check(VecRestoreArrayWrite(left, &to));
}

void Sweeps::backward(Vec b, Vec x) {
  const Blocks m{static_cast<int>(starts_.size()) - 1, starts_.data(), columns_.data(), numbers_.data(), diagonal_.data(), inverse_.data(), scale_};
  const PetscScalar* given = nullptr;
  PetscScalar* own = nullptr;
  const std::vector<double>& others = border_.times(x);
  check(VecGetArrayRead(b, &given));
  pad(block_, scale_, given, left_);
  check(VecRestoreArrayRead(b, &given));
  const int width = padded(block_);
  for (std::size_t k = 0; k < others.size(); ++k) left_[border_.rows()[k] / block_ * width + border_.rows()[k] % block_] -= scale_ * others[k];
  check(VecGetArray(x, &own));
  pad(block_, 1, own, x_);
  backward_of(block_, m, left_.data(), x_.data());
  unpad(block_, 1, x_, own);
  check(VecRestoreArray(x, &own));
}

double Sweeps::bytes() const {
  return 4.0 * static_cast<double>(numbers_.size() + diagonal_.size() + inverse_.size() + starts_.size() + columns_.size()) + 8.0 * static_cast<double>(x_.size() + left_.size());
}

}  // namespace dotyk::multigrid
