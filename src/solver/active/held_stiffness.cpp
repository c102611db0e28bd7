#include "solver/active/held_stiffness.hpp"

#include <algorithm>

#include "algebra/dense/generalised_inverse.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::solver {

using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;
using problem::Block;
using problem::Problem;
using problem::RigidMotions;

namespace {

std::vector<int> nodes(const Problem& problem) {
  std::vector<int> all;
  int first = 0;
  for (const Block& block : problem.blocks) {
    for (const int n : block.node) all.push_back(first + n);
    first = all.empty() ? 0 : all.back() + 1;
  }
  return all;
}

/// Of all blocks.
SparseMatrix lower_triangle(const Problem& problem) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Block& block : problem.blocks)
    for (int j = 0; j < block.size(); ++j)
      for (SparseMatrix::InnerIterator it(block.K, j); it; ++it) entries.emplace_back(block.first + static_cast<int>(it.row()), block.first + j, it.value());
  SparseMatrix K(problem.unknowns(), problem.unknowns());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

}  // namespace

HeldStiffness::HeldStiffness(const Problem& problem, const RigidMotions& rigid, const MakeSpdSolver& make, Monitor& monitor)
    : problem_(problem), basis_(problem::row_basis(problem)), unnoticed_(problem::unnoticed_displacements(problem, rigid)), rows_(problem.B * basis_.T) {
  rows_.prune([](auto, auto, double value) { return std::abs(value) > 1e-14; });
  assemble();
  place_rows();
  for (const int unknown : algebra::fixing_unknowns(unnoticed_)) lower_.coeffRef(unknown, unknown) *= 2;  // carries nothing
  stiffness_ = Eigen::Map<const Vector>(lower_.valuePtr(), lower_.nonZeros());
  if (rigid.noticed.cols() > 0) spring_rows(problem.row_stiffness());
  solver_ = make({lower_, nodes(problem), [this] { return rigid_motions(); }, monitor});
}

algebra::DenseMatrix HeldStiffness::rigid_motions() const {
  algebra::DenseMatrix all(problem_.unknowns(), 0);
  for (const Block& block : problem_.blocks) {
    if (!block.rigid) return algebra::DenseMatrix(problem_.unknowns(), 0);
    const algebra::DenseMatrix own = block.rigid();
    if (all.cols() == 0) all.setZero(problem_.unknowns(), own.cols());
    all.middleRows(block.first, block.size()) = own;
  }
  const algebra::DenseMatrix jumps = problem_.B * all;
  for (int r = 0; r < problem_.rows(); ++r)
    if (const int own = basis_.unknown[r]; own >= 0) all.row(own) = jumps.row(r);
  return all;
}

void HeldStiffness::assemble() {
  const SparseMatrix K = lower_triangle(problem_).selfadjointView<Eigen::Lower>();
  const SparseMatrix half = K * basis_.T, all = basis_.T.transpose() * half;
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < all.cols(); ++j)
    for (SparseMatrix::InnerIterator it(all, j); it; ++it)
      if (it.row() >= j) entries.emplace_back(static_cast<int>(it.row()), j, it.value());
  for (int r = 0; r < problem_.rows(); ++r)
    for (SparseRows::InnerIterator i(rows_, r); i; ++i)
      for (SparseRows::InnerIterator j(rows_, r); j && j.col() <= i.col(); ++j) entries.emplace_back(static_cast<int>(i.col()), static_cast<int>(j.col()), 0.0);
  for (int i = 0; i < problem_.unknowns(); ++i) entries.emplace_back(i, i, 0.0);
  lower_.resize(problem_.unknowns(), problem_.unknowns());
  lower_.setFromTriplets(entries.begin(), entries.end());
}

void HeldStiffness::place_rows() {
  const int *column = lower_.outerIndexPtr(), *row = lower_.innerIndexPtr();
  first_.assign(1, 0);
  for (int r = 0; r < problem_.rows(); ++r) {
    for (SparseRows::InnerIterator i(rows_, r); i; ++i)
      for (SparseRows::InnerIterator j(rows_, r); j && j.col() <= i.col(); ++j) {
        const int* at = std::lower_bound(row + column[j.col()], row + column[j.col() + 1], static_cast<int>(i.col()));
        place_.push_back(static_cast<int>(at - row));
        product_.push_back(i.value() * j.value());
      }
    first_.push_back(static_cast<std::ptrdiff_t>(place_.size()));
  }
}

void HeldStiffness::spring_rows(const Vector& spring) {
  double* value = lower_.valuePtr();
  for (int r = 0; r < problem_.rows(); ++r)
    if (spring[r] != 0)
      for (std::ptrdiff_t k = first_[r]; k < first_[r + 1]; ++k) value[place_[k]] += spring[r] * product_[k];
}

bool HeldStiffness::factor(const Vector& spring, const std::vector<char>& held) {
  held_ = held;
  double* value = lower_.valuePtr();
  std::copy(stiffness_.begin(), stiffness_.end(), value);
  spring_rows(spring);
  for (int j = 0; j < lower_.cols(); ++j)
    for (int k = lower_.outerIndexPtr()[j]; k < lower_.outerIndexPtr()[j + 1]; ++k) {
      const int i = lower_.innerIndexPtr()[k];
      if (held[i] || held[j]) value[k] = i == j ? (stiffness_[k] > 0 ? stiffness_[k] : 1) : 0;
    }
  return solver_->set(lower_, held_);
}

Vector HeldStiffness::solve_in_basis(Vector forces, double tolerance) const {
  for (Eigen::Index i = 0; i < forces.size(); ++i)
    if (held_[i]) forces[i] = 0;
  const Vector solution = solver_->solve(forces, tolerance);
  if (solver_->iterates() && forces.allFinite() && !solution.allFinite())
    throw InputError(text(solver_->method(), ": no solution of a linear system within the iterations allowed, as with a nearly incompressible material, "
                          "stretched cells or great contrasts of stiffness; linear = \"factor\" and the default method do without iterations"));
  return problem::least(unnoticed_, basis_.T * solution);
}

}  // namespace dotyk::solver
