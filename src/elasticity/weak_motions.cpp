#include "elasticity/weak_motions.hpp"

#include <array>
#include <cmath>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/generalised_inverse.hpp"
#include "algebra/symmetric_product.hpp"
#include "base/parallel.hpp"
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

/// Volumes of the cells shared out to their nodes, in units of the whole; one entry an unknown. The last digit depends on the number of threads.
Vector lumped_volumes(const mesh::Mesh& mesh, const Numbering& numbering) {
  constexpr int kFew = 100'000;  // cells, for a thread
  const double size = mesh.size();
  const int threads = threads_for(mesh.cell_count(), kFew);
  std::vector<Vector> shares(threads);
  parallel_ranges(mesh.cell_count(), threads, [&](int k, int first, int end) {
    shares[k] = Vector::Zero(mesh.node_count());
    dispatch(mesh.element, [&]<class E>() {
      double x[E::nodes][E::dim], g[E::nodes][E::dim];
      for (int c = first; c < end; ++c) {
        cell_coordinates<E>(mesh, c, x);
        double middle[E::dim] = {};
        for (int i = 0; i < E::dim; ++i)
          for (int a = 0; a < E::nodes; ++a) middle[i] += x[a][i] / E::nodes;
        for (int a = 0; a < E::nodes; ++a)
          for (int i = 0; i < E::dim; ++i) x[a][i] = (x[a][i] - middle[i]) / size;
        const double volume = physical_gradient<E>(x, std::array<double, E::dim>{}, g);
        for (int a = 0; a < E::nodes; ++a) shares[k][mesh.cell(c)[a]] += volume;
      }
    });
  });
  for (int k = 1; k < threads; ++k) shares[0] += shares[k];
  shares[0] /= shares[0].sum();
  Vector w(numbering.count());
  for (int k = 0; k < numbering.count(); ++k) w[k] = shares[0][numbering.node[k]];
  return w;
}

/// The combinations of vectors, given by their Gram matrix, that are orthonormal; none of those whose square is less than `least`.
DenseMatrix orthonormal_combinations(const DenseMatrix& gram, double least) {
  const algebra::Eigenpairs pairs = algebra::eigenpairs(gram);
  const Eigen::Index count = gram.cols() - (pairs.values.array() < least).count();
  return pairs.vectors.rightCols(count) * pairs.values.tail(count).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// A basis of V's span, orthonormal in M = diag(w), without combinations that M gives less than `least`.
DenseMatrix orthonormal_in(const Vector& w, const DenseMatrix& V, double least) {
  return V * orthonormal_combinations(V.transpose() * w.asDiagonal() * V, least);
}

using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What the measure is made of, on the unknowns.
struct Motions {
  RigidFrame frame;
  Vector w;  ///< M
  ByRows F;  ///< rigid motions of the frame, 3 or 6, and a dilatation: its last column

  Motions(const mesh::Mesh& mesh, const Numbering& numbering) : frame(mesh), w(lumped_volumes(mesh, numbering)), F(numbering.count(), frame.count() + 1) {
    const int d = frame.dimension;
    for (std::size_t k = 0; k < numbering.unknown.size(); ++k) {
      if (numbering.unknown[k] < 0) continue;
      const int node = static_cast<int>(k) / d, i = static_cast<int>(k) % d;
      F.row(numbering.unknown[k]) << frame.row(mesh, k), (mesh.node(node)[i] - frame.centre[i]) / frame.size;
    }
  }

  auto rigid() const { return F.leftCols(frame.count()); }
  auto dilatation() const { return F.col(frame.count()); }

  /// The coefficients of the M-orthogonal projection of u onto the kernel.
  template <class Displacements>
  DenseMatrix in_kernel(const DenseMatrix& kernel, const Displacements& u) const {
    const DenseMatrix weighted = w.asDiagonal() * kernel;
    return algebra::Ldlt(weighted.transpose() * kernel).solve(DenseMatrix(weighted.transpose() * u));
  }
  /// u less that projection.
  DenseMatrix without(const DenseMatrix& kernel, const DenseMatrix& u) const {
    return kernel.cols() == 0 ? u : DenseMatrix(u - kernel * in_kernel(kernel, u));
  }

  /// The coefficients of rigid motions given on the unknowns.
  DenseMatrix coefficients(const DenseMatrix& motion) const {
    const Vector root = w.cwiseSqrt();
    return algebra::MinimumNorm(root.asDiagonal() * rigid()).solve(DenseMatrix(root.asDiagonal() * motion));
  }

  std::vector<Motion> named(const DenseMatrix& motion) const {
    std::vector<Motion> result;
    const DenseMatrix c = algebra::pure(coefficients(motion));
    for (Eigen::Index k = 0; k < c.cols(); ++k) result.push_back(frame.motion(c.col(k), kNoise));
    return result;
  }
};

/// FᵀKF, in one pass over K.
template <int Columns>
DenseMatrix energies(const SparseMatrix& lower, const ByRows& F) {
  using Numbers = Eigen::Matrix<double, Eigen::Dynamic, Columns, Eigen::RowMajor>;
  return F.transpose() * algebra::symmetric_product(lower, Eigen::Map<const Numbers>(F.data(), F.rows(), Columns));
}

/// The least Rayleigh quotient (K, M) on the span of V; infinite where V is nothing.
double least_quotient(const Motions& motions, const SparseMatrix& lower, DenseMatrix V) {
  const Vector norm = (V.cwiseAbs2().transpose() * motions.w).cwiseSqrt();
  for (Eigen::Index k = 0; k < V.cols(); ++k) V.col(k) *= norm[k] > 0 ? 1 / norm[k] : 0;
  const DenseMatrix Q = orthonormal_in(motions.w, V, 1e-8);
  if (Q.cols() == 0) return INFINITY;
  return algebra::eigenvalues(Q.transpose() * algebra::symmetric_product(lower, ByRows(Q)))[0];
}

/// Q: rigid motions without the kernel, M-orthonormal.
WeakMotions by_response(const Motions& motions, const DenseMatrix& Q, const Numbering& numbering, const SparseMatrix& lower, const DenseMatrix& kernel) {
  WeakMotions result;
  algebra::GeneralisedInverse inverse(lower, numbering.node, kernel);
  if (!inverse.factor(lower)) return result;  // singular for another reason, which the solver tells
  const auto response = [&](const DenseMatrix& u) {
    return motions.without(kernel, inverse.apply(motions.w.asDiagonal() * u));
  };
  const auto deformation = [&](const DenseMatrix& u) {
    return DenseMatrix(u - Q * (Q.transpose() * motions.w.asDiagonal() * u));
  };
  const DenseMatrix U = response(Q), compliance = Q.transpose() * motions.w.asDiagonal() * U;
  const algebra::Eigenpairs soft = algebra::eigenpairs((compliance + compliance.transpose()) / 2);
  DenseMatrix D(U.rows(), U.cols() + 1);
  D << deformation(U / U.lpNorm<Eigen::Infinity>()), deformation(motions.without(kernel, motions.dilatation()));
  const double own = least_quotient(motions, lower, deformation(response(D)));
  std::vector<Eigen::Index> weak;
  for (Eigen::Index k = 0; k < U.cols(); ++k)
    if (1 / soft.values[k] < kNearlyFree * own) weak.push_back(k);
  if (weak.empty()) return result;
  result.stiffness = 1 / (soft.values[weak.back()] * own);
  result.motions = motions.named(Q * soft.vectors(Eigen::all, weak));
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
  const Motions motions(mesh, numbering);
  const Vector& w = motions.w;
  DenseMatrix gram = motions.rigid().transpose() * w.asDiagonal() * motions.rigid();
  if (kernel.cols() > 0) gram -= DenseMatrix(motions.rigid().transpose() * w.asDiagonal() * kernel) * motions.in_kernel(kernel, motions.rigid());
  const DenseMatrix T = orthonormal_combinations(gram, 1e-12);  // less what is in the kernel, or nothing on these unknowns
  if (T.cols() == 0) return {};
  const DenseMatrix E = all == 3 ? energies<4>(lower, motions.F) : energies<7>(lower, motions.F);
  const algebra::Eigenpairs trial = algebra::eigenpairs(T.transpose() * E.topLeftCorner(all, all) * T);
  const double own = E(all, all) / motions.dilatation().cwiseAbs2().dot(w);
  if (!std::isfinite(own) || !(trial.values[0] < kSuspicious * own)) return {};
  const DenseMatrix Q = motions.without(kernel, motions.rigid() * T);
  const DenseMatrix lost = lost_in_rounding(motions, mesh, numbering, lower, Q * trial.vectors);
  if (lost.cols() > 0) return {0, motions.named(lost)};
  return by_response(motions, Q, numbering, lower, kernel);
}

}  // namespace dotyk::elasticity
