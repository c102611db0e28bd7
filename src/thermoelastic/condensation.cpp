#include "thermoelastic/condensation.hpp"

#include <stdexcept>

namespace dotyk::thermoelastic {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

namespace {

/// The place of every unknown among the inner ones; −1 − its place in Γ for those.
std::vector<int> places(int n, const std::vector<int>& gamma) {
  std::vector<int> place(n, 0);
  for (std::size_t k = 0; k < gamma.size(); ++k) place[gamma[k]] = -1 - static_cast<int>(k);
  int next = 0;
  for (int& p : place)
    if (p >= 0) p = next++;
  return place;
}

}  // namespace

SparseMatrix Condensation::interior(const SparseMatrix& lower, const std::vector<int>& place) {
  std::vector<Eigen::Triplet<double>> entries;
  int n = 0;
  for (const int p : place) n += p >= 0;
  for (int j = 0; j < lower.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(lower, j); a; ++a)
      if (place[a.row()] >= 0 && place[j] >= 0) entries.emplace_back(place[a.row()], place[j], a.value());
  SparseMatrix out(n, n);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

Condensation::Condensation(const SparseMatrix& lower, std::vector<int> gamma)
    : gamma_(std::move(gamma)), factor_(interior(lower, places(static_cast<int>(lower.rows()), gamma_))) {
  const std::vector<int> place = places(static_cast<int>(lower.rows()), gamma_);
  for (std::size_t i = 0; i < place.size(); ++i)
    if (place[i] >= 0) inner_.push_back(static_cast<int>(i));
  const int count = static_cast<int>(gamma_.size());
  DenseMatrix across = DenseMatrix::Zero(static_cast<int>(inner_.size()), count);
  S_ = DenseMatrix::Zero(count, count);
  for (int j = 0; j < lower.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(lower, j); a; ++a) {
      const int p = place[a.row()], q = place[j];
      if (p < 0 && q < 0) S_(-1 - p, -1 - q) = S_(-1 - q, -1 - p) = a.value();
      else if (q < 0) across(p, -1 - q) = a.value();
      else if (p < 0) across(q, -1 - p) = a.value();
    }
  if (!factor_.factor(interior(lower, place)))
    throw std::runtime_error("its matrix cannot be factored; choose units in which its numbers are moderate");
  W_.resize(across.rows(), count);
  for (int k = 0; k < count; ++k) W_.col(k) = -factor_.solve(across.col(k));
  S_ += across.transpose() * W_;
  S_ = (0.5 * (S_ + S_.transpose())).eval();
}

Vector Condensation::condensed(const Vector& b) const { return b(gamma_) + W_.transpose() * b(inner_); }

Vector Condensation::recovered(const Vector& b, const Vector& on_gamma) const {
  Vector x(b.size());
  x(inner_) = factor_.solve(b(inner_)) + W_ * on_gamma;
  x(gamma_) = on_gamma;
  return x;
}

}  // namespace dotyk::thermoelastic
