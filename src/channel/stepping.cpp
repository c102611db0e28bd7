#include "channel/stepping.hpp"

#include <Eigen/LU>
#include <cmath>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::channel {
namespace {

using algebra::SparseMatrix;
using algebra::Vector;

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
