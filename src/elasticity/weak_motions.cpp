#include "elasticity/weak_motions.hpp"

#include <algorithm>
#include <cmath>

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
  Vector lumped;          ///< of the cells, shared out to their nodes, in units of the whole; one entry a node
  double dilated = 0;     ///< Σ volume c_iijj of the cells that are free
  std::vector<int> held;  ///< the other cells

  void operator+=(const Volumes& other) {
    lumped += other.lumped, dilated += other.dilated;
    held.insert(held.end(), other.held.begin(), other.held.end());
  }
};

Volumes volumes(const mesh::Mesh& mesh, const MaterialField& material, const Numbering& numbering) {
  constexpr int kFew = 100'000;  // cells, for a thread
  const double size = mesh.size();
  Volumes out = parallel_sum(mesh.cell_count(), kFew, [&](int first, int end) {
    Volumes part{Vector::Zero(mesh.node_count()), 0, {}};
    dispatch(mesh.element, [&]<class E>() {
      double x[E::nodes][E::dim], bulk = 0;
      for (int c = first; c < end; ++c) {
        const int* nodes = mesh.cell(c);
        for (int a = 0; a < E::nodes; ++a)
          for (int i = 0; i < E::dim; ++i) x[a][i] = (mesh.node(nodes[a])[i] - mesh.node(nodes[0])[i]) / size;
        const double volume = jacobian<E>(x, E::centre());
        for (int a = 0; a < E::nodes; ++a) part.lumped[nodes[a]] += volume;
        if (!is_free(mesh, numbering, c)) {
          part.held.push_back(c);
          continue;
        }
        if (material.varies() || !(bulk > 0)) {
          const Hooke hooke = material.at(c);
          bulk = 0;
          for (int i = 0; i < E::dim; ++i)
            for (int j = 0; j < E::dim; ++j) bulk += hooke.c[i][i][j][j];
        }
        for (int q = 0; q < E::points; ++q) part.dilated += E::weight(q) * volume * bulk;
      }
    });
    return part;
  });
  out.lumped /= out.lumped.sum();
  out.dilated *= std::pow(size, mesh.dimension());
  return out;
}

/// Component i at a point of the rigid motions of the frame, 3 or 6, and of a dilatation.
template <int d>
using Row = Eigen::Matrix<double, 1, (d == 2 ? 3 : 6) + 1>;
template <int d>
Row<d> row(const RigidFrame& frame, const double* x, int i) {
  Row<d> out;
  out << frame.row<d>(x, i), (x[i] - frame.centre[i]) / frame.size;
  return out;
}

/// UᵀMU of those motions and, after them, those in the kernel.
template <int d>
DenseMatrix gram(const mesh::Mesh& mesh, const Numbering& numbering, const RigidFrame& frame, const Vector& lumped, const DenseMatrix& kernel) {
  constexpr int count = Row<d>::ColsAtCompileTime;
  const Eigen::Index fixed = kernel.cols();
  return parallel_sum(mesh.node_count(), kFewNodes, [&](int first, int end) {
    Eigen::Matrix<double, count, count> own = Eigen::Matrix<double, count, count>::Zero();
    DenseMatrix sum = DenseMatrix::Zero(count + fixed, count + fixed);
    for (int node = first; node < end; ++node)
      for (int i = 0; i < d; ++i) {
        const int unknown = numbering.unknown[static_cast<std::size_t>(node) * d + i];
        if (unknown < 0) continue;
        const Row<d> moved = row<d>(frame, mesh.node(node), i);
        own += (lumped[node] * moved).transpose() * moved;
        if (fixed == 0) continue;
        sum.bottomLeftCorner(fixed, count) += lumped[node] * kernel.row(unknown).transpose() * moved;
        sum.bottomRightCorner(fixed, fixed) += lumped[node] * kernel.row(unknown).transpose() * kernel.row(unknown);
      }
    sum.topLeftCorner(count, count) = own;
    sum.topRightCorner(count, fixed) = sum.bottomLeftCorner(fixed, count).transpose();
    return sum;
  });
}

/// Of gram(): that of the first motions, without their part in the kernel.
DenseMatrix without_kernel(const DenseMatrix& gram, Eigen::Index count, Eigen::Index fixed) {
  const DenseMatrix all = gram.topLeftCorner(count, count);
  if (fixed == 0) return all;
  const DenseMatrix in_kernel = algebra::Ldlt(gram.bottomRightCorner(fixed, fixed)).solve(DenseMatrix(gram.bottomLeftCorner(fixed, count)));
  return all - algebra::product(gram.topRightCorner(count, fixed), in_kernel);
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
  const RigidFrame& frame;
  Vector w;  ///< M
  ByRows F;  ///< as row() says: its last column is the dilatation

  Motions(const mesh::Mesh& mesh, const Numbering& numbering, const RigidFrame& frame, const Vector& lumped)
      : frame(frame), w(lumped(numbering.node)), F(numbering.count(), frame.count() + 1) {
    const int d = frame.dimension;
    parallel_ranges(mesh.node_count(), threads_for(mesh.node_count(), kFewNodes), [&](int, int first, int end) {
      for (std::size_t k = static_cast<std::size_t>(first) * d; k < static_cast<std::size_t>(end) * d; ++k) {
        if (numbering.unknown[k] < 0) continue;
        const double* x = mesh.node(static_cast<int>(k) / d);
        const int i = static_cast<int>(k) % d;
        d == 2 ? F.row(numbering.unknown[k]) = row<2>(frame, x, i) : F.row(numbering.unknown[k]) = row<3>(frame, x, i);
      }
    });
  }

  auto rigid() const { return F.leftCols(frame.count()); }
  auto dilatation() const { return F.rightCols(1); }

  /// UᵀMV, some rows at a time, so that no other matrix of this size is needed.
  DenseMatrix inner(const Displacements& U, const Displacements& V) const {
    constexpr int kRows = 1000, kFew = 100'000;  // rows for a thread
    return parallel_sum(U.rows(), kFew, [&](int begin, int end) {
      DenseMatrix sum = DenseMatrix::Zero(U.cols(), V.cols());
      for (int first = begin; first < end; first += kRows) {
        const int count = std::min(kRows, end - first);
        const ByRows weighted = w.segment(first, count).asDiagonal() * V.middleRows(first, count);
        sum += U.middleRows(first, count).transpose() * weighted;
      }
      return sum;
    });
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

/// FᵀKF, where F has the motions of row(). Rigid motions do no work in a cell that is free, and a dilatation strains such a cell uniformly: Volumes::dilated is its energy. Only
/// cells with prescribed components, where F is zero, need their stiffness. Of curved or distorted cells the volume is approximate.
template <class E>
DenseMatrix energies(const mesh::Mesh& mesh, const MaterialField& material, const Springs& springs, const Numbering& numbering, const RigidFrame& frame,
                     const Volumes& volumes) {
  constexpr int d = E::dim, count = Row<d>::ColsAtCompileTime;
  const auto on = [&](const mesh::Mesh& mesh, const Numbering& numbering, int node, int i) -> Row<d> {
    return numbering.unknown[static_cast<std::size_t>(node) * d + i] < 0 ? Row<d>(Row<d>::Zero()) : row<d>(frame, mesh.node(node), i);
  };
  const auto at = [&](int node, int i) { return on(mesh, numbering, node, i); };
  using Square = Eigen::Matrix<double, count, count>;
  constexpr int kFewCells = 2'000;  // for a thread
  Square sum = parallel_sum(std::ssize(volumes.held), kFewCells, [&](int first, int end) {
    Square of_cells = Square::Zero();
    double x[E::nodes][d], k[E::nodes][E::nodes][d][d];
    Eigen::Matrix<double, d, count> F[E::nodes];
    for (int h = first; h < end; ++h) {
      const int* n = mesh.cell(volumes.held[h]);
      cell_coordinates<E>(mesh, volumes.held[h], x);
      stiffness<E>(x, material.at(volumes.held[h]), k);
      for (int a = 0; a < E::nodes; ++a)
        for (int i = 0; i < d; ++i) F[a].row(i) = at(n[a], i);
      for (int a = 0; a < E::nodes; ++a) {  // k has the pairs b ≤ a
        const auto times = [&](int b) -> Eigen::Matrix<double, d, count> { return Eigen::Map<const Eigen::Matrix<double, d, d, Eigen::RowMajor>>(k[a][b][0]) * F[b]; };
        Eigen::Matrix<double, d, count> forces = times(a) / 2;
        for (int b = 0; b < a; ++b) forces += times(b);
        of_cells += F[a].transpose() * forces;
      }
    }
    return Square(of_cells + of_cells.transpose());
  });
  sum(count - 1, count - 1) += volumes.dilated / (frame.size * frame.size);
  for (const FacetSpring& spring : springs.facets)
    for_each_facet_point(springs.mesh, spring.facet, [&](const FacetPoint& p) {
      for (int i = 0; i < d; ++i) {
        Row<d> moved = Row<d>::Zero();
        for (int a = 0; a < p.nodes; ++a) moved += p.shape[a] * on(springs.mesh, springs.numbering, springs.mesh.facet_node(spring.facet, a), i);
        sum += spring.stiffness[p.index][i] * p.measure * moved.transpose() * moved;
      }
    });
  return sum;
}

/// The least Rayleigh quotient (K, M) on the span of V; infinite where V is nothing.
double least_quotient(const Motions& motions, const SparseMatrix& lower, ByRows V) {
  const Vector square = motions.inner(V, V).diagonal();
  for (Eigen::Index k = 0; k < V.cols(); ++k) V.col(k) *= square[k] > 0 ? 1 / std::sqrt(square[k]) : 0;
  const ByRows Q = combined(V, orthonormal_combinations(motions.inner(V, V), 1e-8));
  if (Q.cols() == 0) return INFINITY;
  return algebra::eigenvalues(Q.transpose() * algebra::symmetric_product(lower, Q))[0];
}

/// Q: rigid motions without the kernel, M-orthonormal. `sprung`: those of them that springs hold, softly.
WeakMotions by_response(const Motions& motions, const ByRows& Q, const ByRows& sprung, const Numbering& numbering, const SparseMatrix& lower, const DenseMatrix& kernel) {
  WeakMotions result;
  algebra::GeneralisedInverse inverse(lower, numbering.node, kernel);
  if (!inverse.factor(lower)) return {0, motions.named(sprung)};  // where there are none it is singular for another reason, which the solver tells
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

WeakMotions weak_motions(const mesh::Mesh& mesh, const MaterialField& material, const Springs& springs, const Numbering& numbering,
                         const std::function<algebra::SymmetricMatrix()>& stiffness, const DenseMatrix& kernel) {
  const int all = mesh.dimension() == 2 ? 3 : 6;
  if (numbering.count() == 0 || kernel.cols() == all) return {};
  const RigidFrame frame(mesh);
  const Volumes volumes = elasticity::volumes(mesh, material, numbering);
  DenseMatrix G, E;
  dispatch(mesh.element, [&]<class Element>() {
    G = gram<Element::dim>(mesh, numbering, frame, volumes.lumped, kernel);
    E = energies<Element>(mesh, material, springs, numbering, frame, volumes);
  });
  const DenseMatrix T = orthonormal_combinations(without_kernel(G, all, kernel.cols()), 1e-12);  // less nothing on these unknowns
  if (T.cols() == 0) return {};
  const algebra::Eigenpairs trial = algebra::eigenpairs(algebra::product(T.transpose(), algebra::product(E.topLeftCorner(all, all), T)));
  const double own = E(all, all) / G(all, all);
  if (!std::isfinite(own) || !(trial.values[0] < kSuspicious * own)) return {};
  const Motions motions(mesh, numbering, frame, volumes.lumped);
  const ByRows Q = motions.without(kernel, combined(motions.rigid(), T));
  const algebra::SymmetricMatrix K = stiffness();
  const ByRows lost = lost_in_rounding(motions, mesh, numbering, K, combined(Q, trial.vectors));
  if (lost.cols() > 0) return {0, motions.named(lost)};
  const auto soft = static_cast<Eigen::Index>(springs.facets.empty() ? 0 : (trial.values.array() < kSuspicious * own).count());
  return by_response(motions, Q, combined(Q, trial.vectors.leftCols(soft)), numbering, K, kernel);
}

}  // namespace dotyk::elasticity
