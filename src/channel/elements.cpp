#include "channel/elements.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "algebra/dense/quadrature.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::channel {

using algebra::DenseMatrix;
using algebra::Vector;
using std::numbers::pi;

Elements::Elements(double half_width, int cells, int degree) : half_width_(half_width), cells_(cells), degree_(degree) {
  if (cells < 1) throw InputError(text("cells is ", cells, "; at least 1 is needed"));
  if (degree < 1 || degree > 16) throw InputError(text("degree is ", degree, "; it must be 1 to 16"));
  nodes_.resize(degree + 1);
  for (int i = 0; i <= degree; ++i) nodes_(i) = (1 - std::cos(pi * i / degree)) / 2;
  assemble();
}

double Elements::cell_end(int i) const { return i == cells_ ? half_width_ : half_width_ * std::sin(pi * i / (2.0 * cells_)); }

Vector Elements::shapes(double s) const {
  Vector values = Vector::Ones(degree_ + 1);
  for (int j = 0; j <= degree_; ++j)
    for (int m = 0; m <= degree_; ++m)
      if (m != j) values(j) *= (s - nodes_(m)) / (nodes_(j) - nodes_(m));
  return values;
}

Vector Elements::derivatives(double s) const {
  Vector values = Vector::Zero(degree_ + 1);
  for (int j = 0; j <= degree_; ++j)
    for (int l = 0; l <= degree_; ++l) {
      if (l == j) continue;
      double product = 1 / (nodes_(j) - nodes_(l));
      for (int m = 0; m <= degree_; ++m)
        if (m != j && m != l) product *= (s - nodes_(m)) / (nodes_(j) - nodes_(m));
      values(j) += product;
    }
  return values;
}

void Elements::assemble() {
  const algebra::Quadrature rule = algebra::gauss(degree_ + 1);  // exact for the products
  DenseMatrix mass = DenseMatrix::Zero(degree_ + 1, degree_ + 1), stiffness = mass;
  Vector load = Vector::Zero(degree_ + 1);
  for (int q = 0; q < rule.points.size(); ++q) {
    const Vector values = shapes(rule.points(q)), slopes = derivatives(rule.points(q));
    mass += rule.weights(q) * values * values.transpose();
    stiffness += rule.weights(q) * slopes * slopes.transpose();
    load += rule.weights(q) * values;
  }
  std::vector<Eigen::Triplet<double>> m, k;
  unit_load_ = Vector::Zero(size());
  for (int cell = 0; cell < cells_; ++cell) {
    const double length = cell_end(cell + 1) - cell_end(cell);
    for (int i = 0; i <= degree_; ++i) {
      const int row = cell * degree_ + i;
      if (row == size()) continue;
      unit_load_(row) += length * load(i);
      for (int j = 0; j <= degree_; ++j) {
        const int column = cell * degree_ + j;
        if (column == size()) continue;
        m.emplace_back(row, column, length * mass(i, j));
        k.emplace_back(row, column, stiffness(i, j) / length);
      }
    }
  }
  mass_.resize(size(), size());
  stiffness_.resize(size(), size());
  mass_.setFromTriplets(m.begin(), m.end());
  stiffness_.setFromTriplets(k.begin(), k.end());
}

Vector Elements::power_load(double power) const {
  const algebra::Quadrature first = algebra::gauss(degree_ + 24, power), others = algebra::gauss(degree_ + 24);
  Vector load = Vector::Zero(size());
  for (int cell = 0; cell < cells_; ++cell) {
    const double start = cell_end(cell), length = cell_end(cell + 1) - start;
    const algebra::Quadrature& rule = cell == 0 ? first : others;
    for (int q = 0; q < rule.points.size(); ++q) {
      const double y = start + length * rule.points(q);
      const double factor = std::pow((cell == 0 ? length : y) / half_width_, power);
      const Vector values = shapes(rule.points(q)) * (rule.weights(q) * length * factor);
      for (int i = 0; i <= degree_ && cell * degree_ + i < size(); ++i) load(cell * degree_ + i) += values(i);
    }
  }
  return load;
}

double Elements::value(const Vector& u, double y) const {
  int cell = static_cast<int>(std::asin(y / half_width_) * 2 * cells_ / pi);
  cell = std::min(std::max(cell, 0), cells_ - 1);
  const double start = cell_end(cell);
  const Vector values = shapes((y - start) / (cell_end(cell + 1) - start));
  double sum = 0;
  for (int i = 0; i <= degree_ && cell * degree_ + i < size(); ++i) sum += values(i) * u(cell * degree_ + i);
  return sum;
}

}  // namespace dotyk::channel
