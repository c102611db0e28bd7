#include "elasticity/weak_motions.hpp"

#include <array>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/generalised_inverse.hpp"
#include "algebra/symmetric_product.hpp"
#include "elasticity/kernel.hpp"
#include "algebra/dense/dense.hpp"
#include "elasticity/rigid_modes.hpp"

namespace dotyk::elasticity {
namespace {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

/// Below it a motion is named: see the header.
constexpr double kNearlyFree = 1e-6;
/// Of the screen. A patch of n cells across holds up to n times less than the cells around it, when
/// these alone deform; 1e-3 leaves room for n = 1000.
constexpr double kSuspicious = 1e-3;
/// Rounding of K r, row by row.
constexpr double kLost = 1e-15;
/// To which weak motions are rigid, and so known.
constexpr double kNoise = 1e-4;

/// Volumes of the cells shared out to their nodes, in units of the whole; one entry an unknown.
Vector lumped_volumes(const mesh::Mesh& mesh, const Numbering& numbering) {
  Vector node = Vector::Zero(mesh.node_count());
  const double size = mesh.size();
  dispatch(mesh.element, [&]<class E>() {
    double x[E::nodes][E::dim], g[E::nodes][E::dim];
    for (int c = 0; c < mesh.cell_count(); ++c) {
      cell_coordinates<E>(mesh, c, x);
      double middle[E::dim] = {};
      for (int i = 0; i < E::dim; ++i)
        for (int a = 0; a < E::nodes; ++a) middle[i] += x[a][i] / E::nodes;
      for (int a = 0; a < E::nodes; ++a)
        for (int i = 0; i < E::dim; ++i) x[a][i] = (x[a][i] - middle[i]) / size;
      const double volume = physical_gradient<E>(x, std::array<double, E::dim>{}, g);
      for (int a = 0; a < E::nodes; ++a) node[mesh.cell(c)[a]] += volume;
    }
  });
  node /= node.sum();
  Vector w(numbering.count());
  for (int k = 0; k < numbering.count(); ++k) w[k] = node[numbering.node[k]];
  return w;
}

/// A basis of V's span, orthonormal in M = diag(w), without combinations that M gives less than `least`.
DenseMatrix orthonormal_in(const Vector& w, const DenseMatrix& V, double least) {
  const algebra::Eigenpairs gram = algebra::eigenpairs(V.transpose() * w.asDiagonal() * V);
  const Eigen::Index count = V.cols() - (gram.values.array() < least).count();
  return V * gram.vectors.rightCols(count) * gram.values.tail(count).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// What the measure is made of, on the unknowns.
struct Motions {
  RigidFrame frame;
  Vector w;            ///< M
  DenseMatrix F;       ///< rigid motions of the frame: unknowns × 3 or 6
  DenseMatrix Q;       ///< M-orthonormal, without the kernel
  Vector dilatation;

  Motions(const mesh::Mesh& mesh, const Numbering& numbering, const DenseMatrix& kernel)
      : frame(mesh), w(lumped_volumes(mesh, numbering)), F(all_rigid_motions(mesh, numbering.unknown, numbering.count())),
        dilatation(numbering.count()) {
    for (std::size_t k = 0; k < numbering.unknown.size(); ++k) {
      const int i = static_cast<int>(k) % frame.dimension;
      if (numbering.unknown[k] >= 0)
        dilatation[numbering.unknown[k]] = (mesh.node(static_cast<int>(k) / frame.dimension)[i] - frame.centre[i]) / frame.size;
    }
    Q = orthonormal_in(w, without(kernel, F), 1e-12);  // less what is in the kernel, or nothing on these unknowns
  }

  /// u less its M-orthogonal projection onto the kernel.
  DenseMatrix without(const DenseMatrix& kernel, const DenseMatrix& u) const {
    if (kernel.cols() == 0) return u;
    const DenseMatrix weighted = w.asDiagonal() * kernel;
    return u - kernel * algebra::Ldlt(weighted.transpose() * kernel).solve(DenseMatrix(weighted.transpose() * u));
  }

  /// The coefficients of rigid motions given on the unknowns.
  DenseMatrix coefficients(const DenseMatrix& motion) const {
    const Vector root = w.cwiseSqrt();
    return algebra::MinimumNorm(root.asDiagonal() * F).solve(DenseMatrix(root.asDiagonal() * motion));
  }

  std::vector<Motion> named(const DenseMatrix& motion) const {
    std::vector<Motion> result;
    const DenseMatrix c = algebra::pure(coefficients(motion));
    for (Eigen::Index k = 0; k < c.cols(); ++k) result.push_back(frame.motion(c.col(k), kNoise));
    return result;
  }
};

using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The least Rayleigh quotient (K, M) on the span of V; infinite where V is nothing.
double least_quotient(const Motions& motions, const SparseMatrix& lower, DenseMatrix V) {
  const Vector norm = (V.cwiseAbs2().transpose() * motions.w).cwiseSqrt();
  for (Eigen::Index k = 0; k < V.cols(); ++k) V.col(k) *= norm[k] > 0 ? 1 / norm[k] : 0;
  const DenseMatrix Q = orthonormal_in(motions.w, V, 1e-8);
  if (Q.cols() == 0) return INFINITY;
  return algebra::eigenvalues(Q.transpose() * algebra::symmetric_product(lower, ByRows(Q)))[0];
}

WeakMotions by_response(const Motions& motions, const Numbering& numbering, const SparseMatrix& lower,
                        const DenseMatrix& kernel) {
  WeakMotions result;
  algebra::GeneralisedInverse inverse(lower, numbering.node, kernel);
  if (!inverse.factor(lower)) return result;  // singular for another reason, which the solver tells
  const auto response = [&](const DenseMatrix& u) {
    return motions.without(kernel, inverse.apply(motions.w.asDiagonal() * u));
  };
  const auto deformation = [&](const DenseMatrix& u) {
    return DenseMatrix(u - motions.Q * (motions.Q.transpose() * motions.w.asDiagonal() * u));
  };
  const DenseMatrix U = response(motions.Q), compliance = motions.Q.transpose() * motions.w.asDiagonal() * U;
  const algebra::Eigenpairs soft = algebra::eigenpairs((compliance + compliance.transpose()) / 2);
  DenseMatrix D(U.rows(), U.cols() + 1);
  D << deformation(U / U.lpNorm<Eigen::Infinity>()), deformation(motions.without(kernel, motions.dilatation));
  const double own = least_quotient(motions, lower, deformation(response(D)));
  std::vector<Eigen::Index> weak;
  for (Eigen::Index k = 0; k < U.cols(); ++k)
    if (1 / soft.values[k] < kNearlyFree * own) weak.push_back(k);
  if (weak.empty()) return result;
  result.stiffness = 1 / (soft.values[weak.back()] * own);
  result.motions = motions.named(motions.Q * soft.vectors(Eigen::all, weak));
  return result;
}

/// The motions (columns) that springs alone resist, by less than rounding.
DenseMatrix lost_in_rounding(const Motions& motions, const mesh::Mesh& mesh, const Numbering& numbering,
                             const SparseMatrix& lower, const DenseMatrix& tried) {
  const Vector residual = algebra::kernel_residual(lower, tried);
  std::vector<Eigen::Index> lost;
  for (Eigen::Index m = 0; m < residual.size(); ++m) {
    if (!(residual[m] < kLost)) continue;
    const Vector c = motions.coefficients(tried.col(m));
    double held = 0;  // what prescribed components stop
    for (std::size_t k = 0; k < numbering.unknown.size(); ++k)
      if (numbering.unknown[k] < 0)
        held = std::max(held, std::abs(motions.frame.row(mesh, k).dot(c)));
    if (held < 1e-6 * c.norm()) lost.push_back(m);
  }
  return tried(Eigen::all, lost);
}

}  // namespace

WeakMotions weak_motions(const mesh::Mesh& mesh, const Numbering& numbering, const SparseMatrix& lower,
                         const DenseMatrix& kernel) {
  const int all = mesh.dimension() == 2 ? 3 : 6;
  if (numbering.count() == 0 || kernel.cols() == all) return {};
  const Motions motions(mesh, numbering, kernel);
  if (motions.Q.cols() == 0) return {};
  const Eigen::Index rigid = motions.Q.cols();
  ByRows V(motions.Q.rows(), rigid + 1);
  V << motions.Q, motions.dilatation;
  const DenseMatrix energies = V.transpose() * algebra::symmetric_product(lower, V);
  const algebra::Eigenpairs trial = algebra::eigenpairs(energies.topLeftCorner(rigid, rigid));
  const double own = energies(rigid, rigid) / motions.dilatation.cwiseAbs2().dot(motions.w);
  if (!std::isfinite(own) || !(trial.values[0] < kSuspicious * own)) return {};
  const DenseMatrix lost = lost_in_rounding(motions, mesh, numbering, lower, motions.Q * trial.vectors);
  if (lost.cols() > 0) return {0, motions.named(lost)};
  return by_response(motions, numbering, lower, kernel);
}

}  // namespace dotyk::elasticity
