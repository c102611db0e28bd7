#include "algebra/direct/reached_sweep.hpp"

#include <algorithm>
#include <cstddef>

#include "algebra/dense/dense.hpp"
#include "algebra/direct/cholmod_handle.hpp"
#include "algebra/direct/stop_factoring.hpp"

namespace dotyk::algebra {

ReachedSweep::ReachedSweep(const cholmod_factor& factor, const SparseRows& rows, const std::vector<int>& also)
    : factor_(factor), rows_(rows), place_(factor.n, -1) {
  std::vector<std::size_t> supernode(factor.n);  // of a position
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const Supernode node(factor, s);
    std::fill_n(supernode.begin() + node.first, node.width, s);
  }
  std::vector<int> position(factor.n);  // of an unknown
  for (std::size_t p = 0; p < factor.n; ++p) position[static_cast<int*>(factor.Perm)[p]] = static_cast<int>(p);
  std::vector<char> reached(factor.nsuper, 0);
  const auto climb = [&](int p) {
    for (std::size_t s = supernode[p]; !reached[s];) {
      reached[s] = 1;
      const Supernode node(factor, s);
      if (node.height > node.width) s = supernode[node.rows[node.width]];
    }
  };
  for (const int p : also) climb(p);
  for (int r = 0; r < rows.rows(); ++r)
    for (SparseRows::InnerIterator it(rows, r); it; ++it) climb(position[it.col()]);
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    if (!reached[s]) continue;
    const Supernode node(factor, s);
    supernodes_.push_back(static_cast<int>(s));
    entries_ += static_cast<double>(node.width) * node.height;
    for (int p = node.first; p < node.first + node.width; ++p) {
      place_[p] = static_cast<int>(positions_.size());
      positions_.push_back(p);
    }
  }
}

DenseMatrix ReachedSweep::values() const {
  DenseMatrix Y = DenseMatrix::Zero(static_cast<Eigen::Index>(positions_.size()), rows());
  std::vector<int> place_of_unknown(factor_.n);
  for (std::size_t p = 0; p < factor_.n; ++p) place_of_unknown[static_cast<int*>(factor_.Perm)[p]] = place_[p];
  for (int r = 0; r < rows(); ++r)
    for (SparseRows::InnerIterator it(rows_, r); it; ++it) Y(place_of_unknown[it.col()], r) += it.value();
  for (const int s : supernodes_) {
    ask_to_stop();
    const Supernode node(factor_, s);
    const Eigen::Map<const DenseMatrix, 0, Eigen::OuterStride<>> L(node.values, node.height, node.width, Eigen::OuterStride<>(node.height));
    const auto own = Y.middleRows(place_[node.first], node.width);
    solve_lower(L.topRows(node.width), own);
    const DenseMatrix update = product(L.bottomRows(node.height - node.width), own);
    for (Eigen::Index j = 0; j < update.cols(); ++j)
      for (Eigen::Index i = 0; i < update.rows(); ++i) Y(place_[node.rows[node.width + i]], j) -= update(i, j);
  }
  return Y;
}

}  // namespace dotyk::algebra
