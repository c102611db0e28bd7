#include "elasticity/rigid_modes.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

#include "base/text.hpp"
#include "elasticity/load.hpp"

namespace dotyk::elasticity {
namespace {

using algebra::DenseMatrix;
using algebra::Vector;
using mesh::Mesh;
using mesh::Point;

/// A rigid motion t + ω × (x − centre)/size, as coefficients: (tx, ty, ω) or (tx, ty, tz, ωx, ωy, ωz).
struct Frame {
  int dimension;
  Point centre{0, 0, 0};
  double size;

  explicit Frame(const Mesh& mesh) : dimension(mesh.dimension()), size(mesh.size()) {
    for (int n = 0; n < mesh.node_count(); ++n)
      for (int i = 0; i < dimension; ++i) centre[i] += mesh.node(n)[i] / mesh.node_count();
  }
  int count() const { return dimension == 2 ? 3 : 6; }

  /// Component i of every mode at x.
  Eigen::RowVectorXd row(const double* x, int i) const {
    Eigen::RowVectorXd r = Eigen::RowVectorXd::Zero(count());
    double d[3] = {0, 0, 0};
    for (int k = 0; k < dimension; ++k) d[k] = (x[k] - centre[k]) / size;
    r[i] = 1;
    if (dimension == 2) {
      r[2] = i == 0 ? -d[1] : d[0];
    } else {  // (ω × d)_i = ω_j d_k − ω_k d_j
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      r[3 + j] = d[k];
      r[3 + k] = -d[j];
    }
    return r;
  }
};

/// Basis of the null space of the stacked rows, reduced so that each vector is as pure as can be.
DenseMatrix null_space(const DenseMatrix& rows, int count) {
  DenseMatrix V = DenseMatrix::Identity(count, count);
  if (rows.rows() > 0) {
    const DenseMatrix square = Eigen::HouseholderQR<DenseMatrix>(rows.rows() < count ? DenseMatrix(
        (DenseMatrix(count, count) << rows, DenseMatrix::Zero(count - rows.rows(), count)).finished()) : rows)
        .matrixQR().topRows(count).triangularView<Eigen::Upper>();
    const Eigen::JacobiSVD<DenseMatrix> svd(square, Eigen::ComputeFullV);
    int rank = 0;
    while (rank < count && svd.singularValues()[rank] > 1e-9 * svd.singularValues()[0]) ++rank;
    V = svd.matrixV().rightCols(count - rank);
  }
  // Column echelon form with pivoting over the coefficients.
  int done = 0;
  for (int i = 0; i < count && done < V.cols(); ++i) {
    Eigen::Index pivot;
    const double largest = V.row(i).tail(V.cols() - done).cwiseAbs().maxCoeff(&pivot);
    if (largest < 1e-7) continue;
    V.col(done).swap(V.col(done + pivot));
    V.col(done) /= V(i, done);
    for (int k = 0; k < V.cols(); ++k)
      if (k != done) V.col(k) -= V(i, k) * V.col(done);
    ++done;
  }
  return V.unaryExpr([](double v) { return std::abs(v) < 1e-12 ? 0.0 : v; });
}

double rounded(double v, double scale) { return std::abs(v) < 1e-9 * scale ? 0 : v; }

std::string direction_text(const Vector& d) {
  static const char* axis[] = {"x", "y", "z"};
  Eigen::Index largest;
  d.cwiseAbs().maxCoeff(&largest);
  if (std::abs(std::abs(d[largest]) - d.norm()) < 1e-9 * d.norm()) return axis[largest];
  std::string out = "(";
  for (int i = 0; i < d.size(); ++i) out += (i ? ", " : "") + text(rounded(d[i] / d.norm(), 1));
  return out + ")";
}

std::string name_of(const Frame& frame, const Vector& c) {
  const int dim = frame.dimension;
  const Vector t = c.head(dim), omega = c.tail(c.size() - dim) / frame.size;
  if (omega.norm() * frame.size < 1e-9 * std::max(1.0, t.norm()))
    return "translation along " + direction_text(t);
  if (dim == 2)  // the point that stays: t + ω e_z × (x − centre) = 0
    return text("rotation about (", rounded(frame.centre[0] - t[1] / omega[0], frame.size), ", ",
                rounded(frame.centre[1] + t[0] / omega[0], frame.size), ")");
  const Eigen::Vector3d w = omega, v = t;
  const Eigen::Vector3d foot = w.cross(v) / w.squaredNorm();
  std::string out = text("rotation about the axis along ", direction_text(w), " through (");
  for (int i = 0; i < 3; ++i)
    out += (i ? ", " : "") + text(rounded(frame.centre[i] + foot[i], frame.size));
  out += ")";
  if (std::abs(w.dot(v)) > 1e-9 * w.norm() * std::max(1.0, v.norm())) out += " with a slide along it";
  return out;
}

}  // namespace

RigidModes rigid_modes(const Mesh& mesh, const Numbering& numbering,
                       const std::vector<FacetSpring>& springs) {
  const Frame frame(mesh);
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
  for (int m = 0; m < basis.cols(); ++m) result.names.push_back(name_of(frame, basis.col(m)));
  if (basis.cols() == 0) return result;
  for (std::size_t k = 0; k < numbering.unknown.size(); ++k)
    if (numbering.unknown[k] >= 0)
      result.modes.row(numbering.unknown[k]) =
          frame.row(mesh.node(static_cast<int>(k) / dim), static_cast<int>(k) % dim) * basis;
  for (int m = 0; m < basis.cols(); ++m)
    result.modes.col(m) /= result.modes.col(m).lpNorm<Eigen::Infinity>();
  return result;
}

}  // namespace dotyk::elasticity
