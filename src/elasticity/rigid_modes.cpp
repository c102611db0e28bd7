#include "elasticity/rigid_modes.hpp"

#include "algebra/dense/decompositions.hpp"
#include "elasticity/load.hpp"
#include "algebra/dense/dense.hpp"
#include "elasticity/rigid_frame.hpp"

namespace dotyk::elasticity {
namespace {

using algebra::DenseMatrix;
using mesh::Mesh;

/// Basis of the null space of the stacked rows, reduced so that each vector is as pure as can be.
DenseMatrix null_space(const DenseMatrix& rows, int count) {
  DenseMatrix V = DenseMatrix::Identity(count, count);
  if (rows.rows() > 0) {
    const algebra::SingularFactors svd = algebra::singular_factors(rows.rows() < count ? rows : algebra::orthogonal_factors(rows).R);
    V = svd.V.rightCols(count - svd.rank(1e-9 * svd.values[0]));
  }
  return algebra::pure(V);
}

}  // namespace

RigidModes rigid_modes(const Mesh& mesh, const Numbering& numbering,
                       const std::vector<FacetSpring>& springs) {
  const RigidFrame frame(mesh);
  const int dim = mesh.dimension();
  std::vector<Eigen::RowVectorXd> held;
  for (std::size_t k = 0; k < numbering.unknown.size(); ++k)
    if (numbering.unknown[k] < 0)
      held.push_back(frame.row(mesh.node(static_cast<int>(k) / dim), static_cast<int>(k) % dim));
  for (const FacetSpring& spring : springs)
    for_each_facet_point(mesh, spring.facet, [&](const FacetPoint& p) {
      for (int i = 0; i < dim; ++i)
        if (spring.stiffness[p.index][i] > 0) held.push_back(frame.row(p.x.data(), i));
    });
  DenseMatrix rows(static_cast<Eigen::Index>(held.size()), frame.count());
  for (std::size_t k = 0; k < held.size(); ++k) rows.row(k) = held[k];
  const DenseMatrix basis = null_space(rows, frame.count());

  RigidModes result;
  result.modes.resize(numbering.count(), basis.cols());
  for (int m = 0; m < basis.cols(); ++m) result.motions.push_back(frame.motion(basis.col(m)));
  if (basis.cols() == 0) return result;
  for (std::size_t k = 0; k < numbering.unknown.size(); ++k)
    if (numbering.unknown[k] >= 0)
      result.modes.row(numbering.unknown[k]) =
          frame.row(mesh.node(static_cast<int>(k) / dim), static_cast<int>(k) % dim) * basis;
  for (int m = 0; m < basis.cols(); ++m)
    result.modes.col(m) /= result.modes.col(m).lpNorm<Eigen::Infinity>();
  return result;
}

DenseMatrix all_rigid_motions(const Mesh& mesh, const std::vector<int>& unknown, int count) {
  const RigidFrame frame(mesh);
  const int dim = mesh.dimension();
  DenseMatrix motions(count, frame.count());
  for (std::size_t k = 0; k < unknown.size(); ++k)
    if (unknown[k] >= 0) motions.row(unknown[k]) = frame.row(mesh.node(static_cast<int>(k) / dim), static_cast<int>(k) % dim);
  return motions;
}

}  // namespace dotyk::elasticity
