#include "thermoelastic/heat.hpp"

#include <cmath>

#include "algebra/dense/quadrature.hpp"
#include "beam/element.hpp"

namespace dotyk::thermoelastic {

using algebra::Vector;

HeatElements::HeatElements(std::vector<double> nodes) : nodes_(std::move(nodes)) {
  for (int cell = 0; cell < cells(); ++cell) {  // ∫ (2s − 1) of the four functions: ∓1/5 and −h/60
    const double l = h(cell), root = std::sqrt(3.0);
    Eigen::Matrix<double, 2, 4> P;
    P << 0.5, l / 12, 0.5, -l / 12,  //
        -root / 5, -root * l / 60, root / 5, -root * l / 60;
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
