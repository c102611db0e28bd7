#include "solver/feti/held_factor.hpp"

#include <numeric>

#include "algebra/dense/generalised_inverse.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::SparseMatrix;

namespace {

algebra::Cholesky analysed(const SparseMatrix& lower) {
  std::vector<int> node(lower.rows());
  std::iota(node.begin(), node.end(), 0);
  return {lower, node, {}};
}

}  // namespace

HeldFactor::HeldFactor(const SparseMatrix& lower) : factor_(analysed(lower)) {}

bool HeldFactor::factor(const SparseMatrix& lower, const std::vector<int>& held) {
  held_ = held;
  return factor_.factor(algebra::hold(lower, held));
}

DenseMatrix HeldFactor::solve(DenseMatrix right) const {
  right(held_, Eigen::all).setZero();
  return factor_.solve(right);
}

}  // namespace dotyk::solver
