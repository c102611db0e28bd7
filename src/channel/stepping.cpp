#include "channel/stepping.hpp"

#include <Eigen/LU>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "algebra/dense/quadrature.hpp"
#include "base/error.hpp"

namespace dotyk::channel {
namespace {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;
using std::numbers::pi;

const double kRoot = std::sqrt(6.0);
const Eigen::Vector3d kNodes{(4 - kRoot) / 10, (4 + kRoot) / 10, 1};

/// The inverse of Radau IIA's matrix A.
Eigen::Matrix3d inverse_of_stages() {
  Eigen::Matrix3d a;
  a << (88 - 7 * kRoot) / 360, (296 - 169 * kRoot) / 1800, (-2 + 3 * kRoot) / 225,  //
      (296 + 169 * kRoot) / 1800, (88 + 7 * kRoot) / 360, (-2 - 3 * kRoot) / 225,   //
      (16 - kRoot) / 36, (16 + kRoot) / 36, 1.0 / 9;
  return a.inverse();
}
const Eigen::Matrix3d kInverse = inverse_of_stages();

}  // namespace

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

Stepping::Stepping(const Data& data, double step, int cells, int degree)
    : data_(data), step_(step), elements_((check(data), data.half_width), cells, degree) {
  if (!(step > 0 && std::isfinite(step))) throw InputError(text("step is ", step, "; it must be positive and finite"));
  u_ = Vector::Zero(elements_.size());
  if (data.initial_speed == 0) return;
  const algebra::SparseLu mass(elements_.mass());
  u_ = data.initial_speed * mass.solve(elements_.unit_load() - elements_.power_load(exponent(data)));
}

/// Of the stages U_i at t + c_i h, in U - u_n: (a/h) A^{-1} (x) M + diag(b K + c(t_i) M).
void Stepping::factor(double length) {
  const int n = elements_.size();
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](const SparseMatrix& m, double factor, int i, int j) {
    for (int column = 0; column < n; ++column)
      for (SparseMatrix::InnerIterator it(m, column); it; ++it)
        entries.emplace_back(i * n + static_cast<int>(it.row()), j * n + column, factor * it.value());
  };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) add(elements_.mass(), data_.a / length * kInverse(i, j), i, j);
    add(elements_.stiffness(), data_.b, i, i);
    add(elements_.mass(), resistance(data_, time_ + kNodes(i) * length), i, i);
  }
  SparseMatrix system(3 * n, 3 * n);
  system.setFromTriplets(entries.begin(), entries.end());
  factor_.reset(new Factor{.matrix = std::move(system)});
  factored_ = data_.oscillating == Oscillating::magnetic ? 0 : length;
}

void Stepping::step(double length) {
  if (factored_ != length) factor(length);
  const int n = elements_.size();
  const Vector diffusion = data_.b * (elements_.stiffness() * u_), mass = elements_.mass() * u_;
  Vector right(3 * n);
  for (int i = 0; i < 3; ++i) {
    const double t = time_ + kNodes(i) * length;
    right.segment(i * n, n) = force(data_, t) * elements_.unit_load() - diffusion - resistance(data_, t) * mass;
  }
  u_ += factor_->lu.solve(right).tail(n);
  time_ += length;
  ++steps_;
}

void Stepping::step() { step(step_); }

void Stepping::advance(double time, Monitor& monitor) {
  if (!(time >= time_ && std::isfinite(time)))
    throw InputError(text("cannot step to the time ", time, ": it is ", time_, " already; times must be finite and not before"));
  const double start = time_, count = std::ceil((time - start) / step_ * (1 - 1e-12));
  if (count > 1e7) throw InputError(text("to the time ", time, " it takes ", count, " steps, at most 1e7 are allowed"));
  for (double i = 0; i < count; ++i) {
    monitor.check();
    if (std::fmod(i, 100) == 0) monitor.phase(text("time ", time_, " of ", time));
    step((time - start) / count);
    time_ = start + (time - start) * ((i + 1) / count);
  }
}

double Stepping::velocity(double y) const {
  check_inside(data_, y);
  const double u = elements_.value(u_, std::abs(y));
  if (!std::isfinite(u)) throw InputError("the velocity is beyond the range of numbers: scale the data");
  return u;
}

}  // namespace dotyk::channel
