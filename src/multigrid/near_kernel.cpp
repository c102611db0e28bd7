#include "multigrid/near_kernel.hpp"

#include <vector>

namespace dotyk::multigrid {

namespace {

/// By Gram and Schmidt, twice: rotations about a distant point are almost translations.
std::vector<algebra::Vector> orthonormal(const algebra::DenseMatrix& modes) {
  constexpr double kDependent = 1e-10;
  std::vector<algebra::Vector> basis;
  for (Eigen::Index k = 0; k < modes.cols(); ++k) {
    algebra::Vector v = modes.col(k);
    const double before = v.norm();
    for (int pass = 0; pass < 2; ++pass)
      for (const algebra::Vector& q : basis) v -= q.dot(v) * q;
    if (v.norm() > kDependent * before) basis.push_back(v.normalized());
  }
  return basis;
}

OwnedVec embedded(Mat matrix, const Embedding& embedding, const algebra::Vector& mode) {
  OwnedVec vec;
  check(MatCreateVecs(matrix, vec.put(), nullptr));
  PetscScalar* values = nullptr;
  check(VecGetArrayWrite(vec, &values));
  std::fill(values, values + embedding.rows(), 0.0);
  for (std::size_t i = 0; i < embedding.slot().size(); ++i) values[embedding.slot()[i]] = mode[static_cast<Eigen::Index>(i)];
  check(VecRestoreArrayWrite(vec, &values));
  return vec;
}

}  // namespace

void attach_near_kernel(Mat matrix, const Embedding& embedding, const algebra::DenseMatrix& modes) {
  std::vector<OwnedVec> vecs;
  for (const algebra::Vector& mode : orthonormal(modes)) vecs.push_back(embedded(matrix, embedding, mode));
  if (vecs.empty()) return;
  const std::vector<Vec> plain(vecs.begin(), vecs.end());
  Owned<MatNullSpace, MatNullSpaceDestroy> space;
  check(MatNullSpaceCreate(PETSC_COMM_SELF, PETSC_FALSE, static_cast<PetscInt>(plain.size()), plain.data(), space.put()));
  check(MatSetNearNullSpace(matrix, space));
}

}  // namespace dotyk::multigrid
