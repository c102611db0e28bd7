#include "solver/feti/lumped.hpp"

#include "solver/feti/equal_pieces.hpp"
#include "solver/feti/submatrix.hpp"

namespace dotyk::solver {

using algebra::DenseMatrix;
using algebra::Vector;

Lumped::Lumped(const DualProblem& dual) : dual_(dual) {
  const std::vector<Piece>& pieces = dual.torn().pieces;
  const auto alike = alike_pieces(dual.kinds(), pieces);
  batches_ = batches(alike, pieces);
  for (const auto& same : alike) stiffness_.push_back(principal(*pieces[same.front()].K, pieces[same.front()].touched));
}

Vector Lumped::apply(const Vector& lambda) const {
  return through_touched(dual_.torn(), batches_, lambda, [this](const Batch& batch, DenseMatrix& columns) {
    columns = DenseMatrix(stiffness_[batch.kind].selfadjointView<Eigen::Lower>() * columns);
  });
}

}  // namespace dotyk::solver
