#include "solver/face_coarse.hpp"

#include <stdexcept>

namespace dotyk::solver {

using algebra::SparseMatrix;
using algebra::Vector;

void FaceCoarse::move_to(const SeparableSet& set, const Vector& x, const SeparableSet::Gradients& at, double ratio) {
  if (!at.slides && place_ == at.face && ratio_ == ratio) return;
  place_ = at.face;
  ratio_ = ratio;
  T_ = set.directions(x, at);
  if (coarse_.modes() == 0) return;
  const SparseMatrix GT = coarse_.scaled_G() * T_;
  SparseMatrix S = ratio * coarse_.C();
  S += SparseMatrix(SparseMatrix(GT * SparseMatrix(GT.transpose())).triangularView<Eigen::Lower>());
  if (!factor_) factor_.emplace(coarse_.C());
  if (!factor_->factor(S, coarse_.held()))
    throw std::runtime_error("the coarse space of a face: its matrix has no factor");
}

Vector FaceCoarse::W(const Vector& v) const {
  if (coarse_.modes() == 0) return v;
  return v - E(coarse_.scaled_G().transpose() * factor_->solve(coarse_.scaled_G() * v).col(0));
}

}  // namespace dotyk::solver
