#include "problem/problem.hpp"

namespace dotyk::problem {

using algebra::SparseMatrix;
using algebra::SparseRows;
using algebra::Vector;

std::vector<const RowGroup*> Problem::group_of_rows() const {
  std::vector<const RowGroup*> of(rows());
  for (const RowGroup& group : groups)
    for (int r = group.first; r < group.first + group.count; ++r) of[r] = &group;
  return of;
}

Vector Problem::row_stiffness() const {
  Vector diagonal(unknowns());
  for (const Block& block : blocks)
    for (int j = 0; j < block.size(); ++j)  // the first entry of a lower column is its diagonal
      diagonal[block.first + j] = block.K.valuePtr()[block.K.outerIndexPtr()[j]];
  Vector stiffness = Vector::Zero(rows());
  for (int r = 0; r < rows(); ++r)
    for (SparseRows::InnerIterator it(B, r); it; ++it)
      stiffness[r] += it.value() * it.value() * diagonal[it.col()];
  return stiffness;
}

SparseRows Problem::rows_of(const Block& block) const {
  SparseRows part(rows(), block.size());
  for (int r = 0; r < rows(); ++r) {
    part.startVec(r);
    for (SparseRows::InnerIterator it(B, r); it; ++it)
      if (it.col() >= block.first && it.col() < block.first + block.size())
        part.insertBack(r, it.col() - block.first) = it.value();
  }
  part.finalize();
  return part;
}

void add(Problem& problem, Block block) {
  block.first = problem.unknowns();
  problem.blocks.push_back(std::move(block));
}

Vector stiffness_times(const Problem& problem, const Vector& u) {
  Vector result(problem.unknowns());
  for (const Block& block : problem.blocks)
    result.segment(block.first, block.size()) =
        block.K.selfadjointView<Eigen::Lower>() * u.segment(block.first, block.size());
  return result;
}

}  // namespace dotyk::problem
