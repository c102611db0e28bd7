#include "thermoelastic/elements.hpp"

#include <Eigen/LU>
#include <cmath>

#include "beam/element.hpp"

namespace dotyk::thermoelastic {

using algebra::DenseMatrix;
using algebra::Vector;

namespace {

const double kRoot3 = std::sqrt(3.0);

}  // namespace

Eigen::Vector3d quadratic(double s) { return {(1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)}; }

Effect::Effect(Kind kind, const std::vector<double>& nodes, Vector modulus, Vector beta)
    : kind_(kind), nodes_(nodes), modulus_(std::move(modulus)), beta_(std::move(beta)) {
  for (int cell = 0; cell < cells(); ++cell) {
    const CellStrain B = cell_strain(cell);
    const Eigen::Matrix2d first = h(cell) * B.leftCols<2>(), last = B.rightCols<2>();
    strain_.push_back(B);
    from_forces_.push_back(first.transpose().inverse());
    from_strain_.push_back(last.inverse());
  }
}

CellStrain Effect::cell_strain(int cell) const {
  const double length = h(cell), unit = nodes_.back();
  CellStrain B(2, cell_unknowns());
  if (kind_ == Kind::stretching)  // Du = (4s − 3) u₀ + (4 − 8s) u_m + (4s − 1) u₁, over h
    B << -1, 0, 1, 2 / kRoot3, -4 / kRoot3, 2 / kRoot3;
  else {  // u'' = u' differences over h, and (12 s − 6)/h² etc.
    const double turn = length / unit;
    B << 0, -turn, 0, turn, 6 / kRoot3, 3 * turn / kRoot3, -6 / kRoot3, 3 * turn / kRoot3;
    B /= length;
  }
  return B / length;
}

CellVector Effect::cell_load(int cell, const std::function<double(double)>& f) const {
  const double x0 = nodes_[cell], length = h(cell);
  if (kind_ == Kind::bending) {
    Eigen::Vector4d out = beam::load(f, x0, length);
    out[1] /= nodes_.back();
    out[3] /= nodes_.back();
    return out;
  }
  CellVector out = CellVector::Zero(3);
  for (int i = 0; i < beam::rule().points.size(); ++i) {
    const double s = beam::rule().points[i];
    out += length * beam::rule().weights[i] * f(x0 + s * length) * quadratic(s);
  }
  return out;
}

DenseMatrix Effect::kernel() const {
  DenseMatrix R = DenseMatrix::Ones(unknowns(), cell_unknowns() - 2);
  if (kind_ == Kind::bending)
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      R.block<2, 2>(2 * static_cast<int>(i), 0) << 1, nodes_[i] / nodes_.back() - 0.5, 0, 1;
  return R;
}

OnCells Effect::stress(const Vector& f) const {
  const int m = cell_unknowns();
  OnCells S(2, cells());
  Vector rest = f;
  for (int cell = 0; cell < cells(); ++cell) {
    S.col(cell) = from_forces_[cell] * rest.segment<2>(2 * cell);
    for (int i = 2; i < m; ++i) rest[2 * cell + i] -= h(cell) * strain_[cell].col(i).dot(S.col(cell));
  }
  return S;
}

Vector Effect::displacement(const OnCells& strain) const {
  const int m = cell_unknowns();
  Vector u = Vector::Zero(unknowns());
  for (int cell = 0; cell < cells(); ++cell) {
    Eigen::Vector2d rest = strain.col(cell);
    for (int i = 0; i < m - 2; ++i) rest -= u[2 * cell + i] * strain_[cell].col(i);
    u.segment<2>(2 * cell + m - 2) = from_strain_[cell] * rest;
  }
  return u;
}

HeatElements::HeatElements(std::vector<double> nodes) : nodes_(std::move(nodes)) {
  for (int cell = 0; cell < cells(); ++cell) {  // ∫ (2s − 1) of the four functions: ∓1/5 and −h/60
    const double l = h(cell);
    Eigen::Matrix<double, 2, 4> P;
    P << 0.5, l / 12, 0.5, -l / 12,  //
        -kRoot3 / 5, -kRoot3 * l / 60, kRoot3 / 5, -kRoot3 * l / 60;
    projection_.push_back(P * scale().asDiagonal());
  }
}

Eigen::Matrix4d HeatElements::mass(int cell) const {
  const double l = h(cell);
  Eigen::Matrix4d M;
  M << 156, 22 * l, 54, -13 * l,              //
      22 * l, 4 * l * l, 13 * l, -3 * l * l,  //
      54, 13 * l, 156, -22 * l,               //
      -13 * l, -3 * l * l, -22 * l, 4 * l * l;
  return l / 420 * scale().asDiagonal() * M * scale().asDiagonal();
}

Eigen::Matrix4d HeatElements::conduction(int cell) const {
  const double l = h(cell);
  Eigen::Matrix4d A;
  A << 36, 3 * l, -36, 3 * l,            //
      3 * l, 4 * l * l, -3 * l, -l * l,  //
      -36, -3 * l, 36, -3 * l,           //
      3 * l, -l * l, -3 * l, 4 * l * l;
  return 1 / (30 * l) * scale().asDiagonal() * A * scale().asDiagonal();
}

Vector HeatElements::load(const std::function<double(double)>& r) const {
  Vector out = Vector::Zero(unknowns());
  for (int cell = 0; cell < cells(); ++cell)
    out.segment<4>(2 * cell) += scale().cwiseProduct(beam::load(r, nodes_[cell], h(cell)));
  return out;
}

Vector HeatElements::product(const OnCells& on_cells) const {
  Vector out = Vector::Zero(unknowns());
  for (int cell = 0; cell < cells(); ++cell)
    out.segment<4>(2 * cell) += h(cell) * projection(cell).transpose() * on_cells.col(cell);
  return out;
}

OnCells HeatElements::projected(const Vector& theta) const {
  OnCells out(2, cells());
  for (int cell = 0; cell < cells(); ++cell) out.col(cell) = projection(cell) * theta.segment<4>(2 * cell);
  return out;
}

}  // namespace dotyk::thermoelastic
