#include "elasticity/weak_motions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/generalised_inverse.hpp"
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
/// Fewer nodes than this are not worth a thread.
constexpr int kFewNodes = 100'000;

/// Are all components of the cell's nodes unknown?
bool is_free(const mesh::Mesh& mesh, const Numbering& numbering, int cell) {
  const int *nodes = mesh.cell(cell), d = mesh.dimension();
  return std::all_of(nodes, nodes + mesh::nodes_of(mesh.element), [&](int node) {
    const int* unknown = &numbering.unknown[static_cast<std::size_t>(node) * d];
    return std::all_of(unknown, unknown + d, [](int u) { return u >= 0; });
  });
}

/// Volumes, each as the Jacobian in the middle of a cell says.
struct Volumes {
  Vector lumped;       ///< of the cells, shared out to their nodes, in units of the whole; one entry an unknown
  double dilated = 0;  ///< Σ volume c_iijj of the cells that are free
};

/// The last digit depends on the number of threads.
Volumes volumes(const mesh::Mesh& mesh, const MaterialField& material, const Numbering& numbering) {
  constexpr int kFew = 100'000;  // cells, for a thread
  const double size = mesh.size();
  const int threads = threads_for(mesh.cell_count(), kFew);
  std::vector<Vector> shares(threads);
  std::vector<double> dilated(static_cast<std::size_t>(threads), 0.0);
  parallel_ranges(mesh.cell_count(), threads, [&](int k, int first, int end) {
    shares[k] = Vector::Zero(mesh.node_count());
    dispatch(mesh.element, [&]<class E>() {
      double x[E::nodes][E::dim], g[E::nodes][E::dim], bulk = 0;
      for (int c = first; c < end; ++c) {
        cell_coordinates<E>(mesh, c, x);
        double middle[E::dim] = {};
        for (int i = 0; i < E::dim; ++i)
          for (int a = 0; a < E::nodes; ++a) middle[i] += x[a][i] / E::nodes;
        for (int a = 0; a < E::nodes; ++a)
          for (int i = 0; i < E::dim; ++i) x[a][i] = (x[a][i] - middle[i]) / size;
        const double volume = physical_gradient<E>(x, E::centre(), g);
        for (int a = 0; a < E::nodes; ++a) shares[k][mesh.cell(c)[a]] += volume;
        if (!is_free(mesh, numbering, c)) continue;
        if (material.varies() || !(bulk > 0)) {
          const Hooke hooke = material.at(c);
          bulk = 0;
          for (int i = 0; i < E::dim; ++i)
            for (int j = 0; j < E::dim; ++j) bulk += hooke.c[i][i][j][j];
        }
        for (int q = 0; q < E::points; ++q) dilated[k] += E::weight(q) * volume * bulk;
      }
    });
  });
  for (int k = 1; k < threads; ++k) shares[0] += shares[k];
  shares[0] /= shares[0].sum();
  Volumes out{Vector(numbering.count())};
  for (int k = 0; k < numbering.count(); ++k) out.lumped[k] = shares[0][numbering.node[k]];
  out.dilated = std::accumulate(dilated.begin(), dilated.end(), 0.0) * std::pow(size, mesh.dimension());
  return out;
}

/// The combinations of vectors, given by their Gram matrix, that are orthonormal; none of those whose square is less than `least`.
DenseMatrix orthonormal_combinations(const DenseMatrix& gram, double least) {
  const algebra::Eigenpairs pairs = algebra::eigenpairs(gram);
  const Eigen::Index count = gram.cols() - (pairs.values.array() < least).count();
  return pairs.vectors.rightCols(count) * pairs.values.tail(count).cwiseSqrt().cwiseInverse().asDiagonal();
}

using ByRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Displacements = Eigen::Ref<const ByRows, 0, Eigen::OuterStride<>>;  // a motion each column

ByRows combined(const Displacements& V, const DenseMatrix& coefficients) { return V * coefficients; }

/// What the measure is made of, on the unknowns.
struct Motions {
  RigidFrame frame;
  Volumes volumes;
  const Vector& w = volumes.lumped;  ///< M
  ByRows F;  ///< rigid motions of the frame, 3 or 6, and a dilatation: its last column

  Motions(const mesh::Mesh& mesh, const MaterialField& material, const Numbering& numbering)
      : frame(mesh), volumes(elasticity::volumes(mesh, material, numbering)), F(numbering.count(), frame.count() + 1) {
    const int d = frame.dimension;
    parallel_ranges(mesh.node_count(), threads_for(mesh.node_count(), kFewNodes), [&](int, int first, int end) {
      for (std::size_t k = static_cast<std::size_t>(first) * d; k < static_cast<std::size_t>(end) * d; ++k) {
        if (numbering.unknown[k] < 0) continue;
        const int node = static_cast<int>(k) / d, i = static_cast<int>(k) % d;
        F.row(numbering.unknown[k]) << frame.row(mesh, k), (mesh.node(node)[i] - frame.centre[i]) / frame.size;
      }
    });
  }

  auto rigid() const { return F.leftCols(frame.count()); }
  auto dilatation() const { return F.rightCols(1); }

  /// UᵀMV, some rows at a time, so that no other matrix of this size is needed. The last digit depends on the number of threads.
  DenseMatrix inner(const Displacements& U, const Displacements& V) const {
    constexpr int kRows = 1000, kFew = 100'000;  // rows for a thread
    const int rows = static_cast<int>(U.rows()), threads = threads_for(rows, kFew);
    std::vector<DenseMatrix> sums(static_cast<std::size_t>(threads), DenseMatrix::Zero(U.cols(), V.cols()));
    parallel_ranges(rows, threads, [&](int thread, int begin, int end) {
      for (int first = begin; first < end; first += kRows) {
        const int count = std::min(kRows, end - first);
        const ByRows weighted = w.segment(first, count).asDiagonal() * V.middleRows(first, count);
        sums[thread] += U.middleRows(first, count).transpose() * weighted;
      }
    });
    for (int k = 1; k < threads; ++k) sums[0] += sums[k];
    return sums[0];
  }
  /// The coefficients of the M-orthogonal projection of u onto the kernel.
  DenseMatrix in_kernel(const Displacements& kernel, const Displacements& u) const {
    return algebra::Ldlt(inner(kernel, kernel)).solve(inner(kernel, u));
  }
  /// u less that projection.
  ByRows without(const Displacements& kernel, ByRows u) const {
    if (kernel.cols() > 0) u -= combined(kernel, in_kernel(kernel, u));
    return u;
  }

  /// The coefficients of rigid motions given on the unknowns.
  DenseMatrix coefficients(const Displacements& motion) const {
    const Vector root = w.cwiseSqrt();
    return algebra::MinimumNorm(root.asDiagonal() * rigid()).solve(DenseMatrix(root.asDiagonal() * motion));
  }

  std::vector<Motion> named(const ByRows& motion) const {
    std::vector<Motion> result;
    const DenseMatrix c = algebra::pure(coefficients(motion));
    for (Eigen::Index k = 0; k < c.cols(); ++k) result.push_back(frame.motion(c.col(k), kNoise));
    return result;
  }
};

/// FᵀKF. Rigid motions do no work in a cell that is free, and a dilatation strains such a cell uniformly: Volumes::dilated is its energy. Only cells with
/// prescribed components, where F is zero, need their stiffness. Of curved or distorted cells the volume is approximate.
template <class E>
DenseMatrix energies(const mesh::Mesh& mesh, const MaterialField& material, const std::vector<FacetSpring>& springs, const Numbering& numbering, const Motions& motions) {
  constexpr int d = E::dim, count = (d == 2 ? 3 : 6) + 1;
  using Square = Eigen::Matrix<double, count, count>;
  using Row = Eigen::Matrix<double, 1, count>;
  const auto at = [&](int node, int i) -> Row {
    const int unknown = numbering.unknown[static_cast<std::size_t>(node) * d + i];
    return unknown < 0 ? Row(Row::Zero()) : Row(motions.F.row(unknown));
  };
  constexpr int kFew = 50'000;  // cells, for a thread
  const int threads = threads_for(mesh.cell_count(), kFew);
  std::vector<Square> sums(static_cast<std::size_t>(threads), Square::Zero());
  parallel_ranges(mesh.cell_count(), threads, [&](int thread, int first, int end) {
    double x[E::nodes][d], k[E::nodes][E::nodes][d][d];
    Hooke hooke = material.at(0);
    Square& sum = sums[thread];
    for (int c = first; c < end; ++c) {
      if (is_free(mesh, numbering, c)) continue;
      const int* n = mesh.cell(c);
      if (material.varies()) hooke = material.at(c);
      cell_coordinates<E>(mesh, c, x);
      stiffness<E>(x, hooke, k);
      Eigen::Matrix<double, E::nodes * d, E::nodes * d> whole;
      Eigen::Matrix<double, E::nodes * d, count> F;
      for (int a = 0; a < E::nodes; ++a)
        for (int i = 0; i < d; ++i) {
          F.row(a * d + i) = at(n[a], i);
          for (int b = 0; b <= a; ++b)
            for (int j = 0; j < d; ++j) whole(a * d + i, b * d + j) = whole(b * d + j, a * d + i) = k[a][b][i][j];
        }
      sum += F.transpose() * (whole * F);
    }
  });
  for (int k = 1; k < threads; ++k) sums[0] += sums[k];
  sums[0](count - 1, count - 1) += motions.volumes.dilated / (motions.frame.size * motions.frame.size);
  for (const FacetSpring& spring : springs)
    for_each_facet_point(mesh, spring.facet, [&](const FacetPoint& p) {
      for (int i = 0; i < d; ++i) {
        Row moved = Row::Zero();
        for (int a = 0; a < p.nodes; ++a) moved += p.shape[a] * at(mesh.facet_node(spring.facet, a), i);
        sums[0] += spring.stiffness[p.index][i] * p.measure * moved.transpose() * moved;
      }
    });
  return sums[0];
}

/// The least Rayleigh quotient (K, M) on the span of V; infinite where V is nothing.
double least_quotient(const Motions& motions, const SparseMatrix& lower, ByRows V) {
  const Vector square = motions.inner(V, V).diagonal();
  for (Eigen::Index k = 0; k < V.cols(); ++k) V.col(k) *= square[k] > 0 ? 1 / std::sqrt(square[k]) : 0;
  const ByRows Q = combined(V, orthonormal_combinations(motions.inner(V, V), 1e-8));
  if (Q.cols() == 0) return INFINITY;
  return algebra::eigenvalues(Q.transpose() * algebra::symmetric_product(lower, Q))[0];
}

/// Q: rigid motions without the kernel, M-orthonormal.
WeakMotions by_response(const Motions& motions, const ByRows& Q, const Numbering& numbering, const SparseMatrix& lower, const DenseMatrix& kernel) {
  WeakMotions result;
  algebra::GeneralisedInverse inverse(lower, numbering.node, kernel);
  if (!inverse.factor(lower)) return result;  // singular for another reason, which the solver tells
  const ByRows fixed = kernel;
  const auto response = [&](const ByRows& u) { return motions.without(fixed, inverse.apply(motions.w.asDiagonal() * u)); };
  const auto deformation = [&](const ByRows& u) { return ByRows(u - combined(Q, motions.inner(Q, u))); };
  const ByRows U = response(Q);
  const DenseMatrix compliance = motions.inner(Q, U);
  const algebra::Eigenpairs soft = algebra::eigenpairs((compliance + compliance.transpose()) / 2);
  ByRows D(U.rows(), U.cols() + 1);
  D << deformation(U / U.lpNorm<Eigen::Infinity>()), deformation(motions.without(fixed, motions.dilatation()));
  const double own = least_quotient(motions, lower, deformation(response(D)));
  std::vector<Eigen::Index> weak;
  for (Eigen::Index k = 0; k < U.cols(); ++k)
    if (1 / soft.values[k] < kNearlyFree * own) weak.push_back(k);
  if (weak.empty()) return result;
  result.stiffness = 1 / (soft.values[weak.back()] * own);
  result.motions = motions.named(combined(Q, soft.vectors(Eigen::all, weak)));
  return result;
}

/// The motions (columns) that springs alone resist, by less than rounding.
ByRows lost_in_rounding(const Motions& motions, const mesh::Mesh& mesh, const Numbering& numbering, const algebra::SymmetricMatrix& K, const ByRows& tried) {
  const Vector residual = algebra::kernel_residual(K, tried);
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

WeakMotions weak_motions(const mesh::Mesh& mesh, const MaterialField& material, const std::vector<FacetSpring>& springs, const Numbering& numbering,
                         const algebra::SymmetricMatrix& K, const DenseMatrix& kernel) {
  const int all = mesh.dimension() == 2 ? 3 : 6;
  if (numbering.count() == 0 || kernel.cols() == all) return {};
  const Motions motions(mesh, material, numbering);
  const ByRows fixed = kernel;
  DenseMatrix gram = motions.inner(motions.rigid(), motions.rigid());
  if (kernel.cols() > 0) gram -= algebra::product(motions.inner(motions.rigid(), fixed), motions.in_kernel(fixed, motions.rigid()));
  const DenseMatrix T = orthonormal_combinations(gram, 1e-12);  // less what is in the kernel, or nothing on these unknowns
  if (T.cols() == 0) return {};
  const DenseMatrix E = dispatch(mesh.element, [&]<class Element>() { return energies<Element>(mesh, material, springs, numbering, motions); });
  const algebra::Eigenpairs trial = algebra::eigenpairs(algebra::product(T.transpose(), algebra::product(E.topLeftCorner(all, all), T)));
  const double own = E(all, all) / motions.inner(motions.dilatation(), motions.dilatation())(0, 0);
  if (!std::isfinite(own) || !(trial.values[0] < kSuspicious * own)) return {};
  const ByRows Q = motions.without(fixed, combined(motions.rigid(), T));
  const ByRows lost = lost_in_rounding(motions, mesh, numbering, K, combined(Q, trial.vectors));
  if (lost.cols() > 0) return {0, motions.named(lost)};
  return by_response(motions, Q, numbering, K, kernel);
}

}  // namespace dotyk::elasticity
