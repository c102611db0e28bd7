#include "thermoelastic/condensation.hpp"

#include <stdexcept>

namespace dotyk::thermoelastic {

using algebra::DenseMatrix;
using algebra::SparseMatrix;
using algebra::Vector;

Condensation::Condensation(const SparseMatrix& lower, std::vector<int> gamma) : gamma_(std::move(gamma)) {
  std::vector<int> place(lower.rows(), 0);  // of an unknown among the inner ones; −1 − its place in Γ for those
  const int count = static_cast<int>(gamma_.size());
  for (int k = 0; k < count; ++k) place[gamma_[k]] = -1 - k;
  for (std::size_t i = 0; i < place.size(); ++i)
    if (place[i] >= 0) place[i] = static_cast<int>(inner_.size()), inner_.push_back(static_cast<int>(i));
  const int inner = static_cast<int>(inner_.size());
  std::vector<Eigen::Triplet<double>> entries;
  DenseMatrix across = DenseMatrix::Zero(inner, count);
  S_ = DenseMatrix::Zero(count, count);
  for (int j = 0; j < lower.outerSize(); ++j)
    for (SparseMatrix::InnerIterator a(lower, j); a; ++a) {
      const int p = place[a.row()], q = place[j];
      if (p >= 0 && q >= 0) entries.emplace_back(p, q, a.value());
      else if (p < 0 && q < 0) S_(-1 - p, -1 - q) = S_(-1 - q, -1 - p) = a.value();
      else if (q < 0) across(p, -1 - q) = a.value();
      else across(q, -1 - p) = a.value();
    }
  SparseMatrix interior(inner, inner);
  interior.setFromTriplets(entries.begin(), entries.end());
  factor_.emplace(interior);
  if (!factor_->factor(interior))
    throw std::runtime_error("its matrix cannot be factored; choose units in which its numbers are moderate");
  W_.resize(across.rows(), count);
  for (int k = 0; k < count; ++k) W_.col(k) = -factor_->solve(across.col(k));
  S_ += across.transpose() * W_;
  S_ = (0.5 * (S_ + S_.transpose())).eval();
}

Vector Condensation::condensed(const Vector& b) const { return b(gamma_) + W_.transpose() * b(inner_); }

Vector Condensation::recovered(const Vector& b, const Vector& on_gamma) const {
  Vector x(b.size());
  x(inner_) = factor_->solve(b(inner_)) + W_ * on_gamma;
  x(gamma_) = on_gamma;
  return x;
}

}  // namespace dotyk::thermoelastic
