#include "elasticity/rigid_modes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "algebra/dense/decompositions.hpp"
#include "algebra/dense/dense.hpp"
#include "base/parallel.hpp"
#include "elasticity/refined.hpp"
#include "mesh/decomposition.hpp"

namespace dotyk::elasticity {

using algebra::DenseMatrix;
using algebra::Vector;
using mesh::Mesh;

RigidFrame::RigidFrame(const mesh::Mesh& mesh) : dimension(mesh.dimension()), size(mesh.size()) {
  for (int n = 0; n < mesh.node_count(); ++n)
    for (int i = 0; i < dimension; ++i) centre[i] += mesh.node(n)[i] / mesh.node_count();
}

namespace {

/// To the nearest multiple of 10^k ≤ noise · scale, so that no digit of noise is printed.
double rounded(double v, double scale, double noise) {
  if (std::abs(v) < noise * scale) return 0;
  const double step = std::pow(10, std::floor(std::log10(noise * scale)));
  return std::round(v / step) * step;
}

/// Unit, without noise; (0, 0, 1), not (0, 0, -1), where `sense` is of no matter.
std::vector<double> unit(const Vector& d, double noise, bool sense) {
  Eigen::Index largest;
  d.cwiseAbs().maxCoeff(&largest);
  Vector rest = d, only = Vector::Zero(d.size());
  rest[largest] = 0;
  only[largest] = sense && d[largest] < 0 ? -1 : 1;
  if (rest.norm() < noise * d.norm()) return {only.begin(), only.end()};
  std::vector<double> out;
  for (const double v : d) out.push_back(rounded(v / d.norm(), 1, noise));
  return out;
}

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

Motion RigidFrame::motion(const Vector& c, double noise, bool sense) const {
  const Vector t = c.head(dimension), omega = c.tail(c.size() - dimension) / size;
  if (omega.norm() * size < noise * std::max(1.0, t.norm()))
    return {Motion::Kind::translation, unit(t, noise, true), {}, false, t.norm()};
  if (dimension == 2)  // the point that stays: t + ω e_z × (x − centre) = 0
    return {Motion::Kind::rotation, {}, {rounded(centre[0] - t[1] / omega[0], size, noise), rounded(centre[1] + t[0] / omega[0], size, noise)},
            false, sense ? omega[0] : std::abs(omega[0])};
  const Eigen::Vector3d w = omega, v = t;
  const Eigen::Vector3d foot = w.cross(v) / w.squaredNorm();
  Motion motion{Motion::Kind::rotation, unit(w, noise, sense), {}, false, w.norm()};
  for (int i = 0; i < 3; ++i) motion.centre.push_back(rounded(centre[i] + foot[i], size, noise));
  motion.slides = std::abs(w.dot(v)) > noise * w.norm() * std::max(1.0, v.norm());
  return motion;
}

RigidModes rigid_modes(const Mesh& mesh, const Numbering& numbering, const std::vector<FacetSpring>& springs, const Mesh* sprung) {
  const RigidFrame frame(mesh);
  std::vector<RigidFrame::Row> held;
  for (std::size_t k = 0; k < numbering.unknown.size(); ++k)
    if (numbering.unknown[k] < 0)
      held.push_back(frame.row(mesh, k));
  for (const FacetSpring& spring : springs)
    for_each_facet_point(sprung ? *sprung : mesh, spring.facet, [&](const FacetPoint& p) {
      for (int i = 0; i < frame.dimension; ++i)
        if (spring.stiffness[p.index][i] > 0) held.push_back(frame.row(p.x.data(), i));
    });
  DenseMatrix rows(static_cast<Eigen::Index>(held.size()), frame.count());
  for (std::size_t k = 0; k < held.size(); ++k) rows.row(k) = held[k];
  RigidModes result{{}, {}, frame, null_space(rows, frame.count())};
  DenseMatrix& basis = result.coefficients;
  result.modes.resize(numbering.count(), basis.cols());
  for (int m = 0; m < basis.cols(); ++m) result.motions.push_back(frame.motion(basis.col(m)));
  if (basis.cols() == 0) return result;
  for (std::size_t k = 0; k < numbering.unknown.size(); ++k)
    if (numbering.unknown[k] >= 0) result.modes.row(numbering.unknown[k]) = frame.row(mesh, k) * basis;
  for (int m = 0; m < basis.cols(); ++m) {
    const double greatest = result.modes.col(m).lpNorm<Eigen::Infinity>();
    result.modes.col(m) /= greatest, basis.col(m) /= greatest;
  }
  return result;
}

Resultants resultants(const Mesh& mesh, int times, const LinearForce& force, const RigidModes& modes) {
  constexpr int kPieces = 20'000;  // that are made at a time
  if (mesh.element == mesh::Element::triangle_p1 || mesh.element == mesh::Element::tetrahedron_p1) times = 0;  // their rule is exact for a linear force on a rigid motion
  const int chunk = std::max(1, kPieces >> mesh.dimension() * times), chunks = (mesh.cell_count() + chunk - 1) / chunk;
  const DenseMatrix sums = parallel_sum(chunks, 1, [&](int first, int end) {
    DenseMatrix sum = DenseMatrix::Zero(modes.coefficients.cols(), 2);
    for (int k = first; k < end; ++k) {
      std::vector<int> cells(static_cast<std::size_t>(std::min(chunk, mesh.cell_count() - k * chunk)));
      std::iota(cells.begin(), cells.end(), k * chunk);
      LinearForce on = force.of(cells);
      Mesh part = mesh::submesh(mesh, std::move(cells)).mesh;
      for (int t = 0; t < times; ++t) {
        Mesh finer = refined(part);
        on = of_pieces(on, part, finer), part = std::move(finer);
      }
      std::vector<double> nodal(part.coordinates.size(), 0.0);
      add_body_force(part, [&](const CellPoint& p) { return on.at(p.cell, p.x); }, nodal);
      for (std::size_t i = 0; i < nodal.size(); ++i) {
        const RigidFrame::Row mode = modes.frame.row(part, i) * modes.coefficients;
        sum.col(0) += nodal[i] * mode.transpose(), sum.col(1) += std::abs(nodal[i]) * mode.cwiseAbs().transpose();
      }
    }
    return sum;
  });
  return {sums.col(0), sums.col(1)};
}

DenseMatrix all_rigid_motions(const Mesh& mesh, const std::vector<int>& unknown, int count) {
  const RigidFrame frame(mesh);
  DenseMatrix motions = DenseMatrix::Zero(count, frame.count());
  for (std::size_t k = 0; k < unknown.size(); ++k)
    if (unknown[k] >= 0) motions.row(unknown[k]) = frame.row(mesh, k);
  return motions;
}

}  // namespace dotyk::elasticity
