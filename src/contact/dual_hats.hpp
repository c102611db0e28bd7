#pragma once

#include <Eigen/Core>
#include <map>

#include "algebra/dense/decompositions.hpp"

namespace dotyk::contact {

/// Moments of functions with the dual hats ψ of a facet's corners: those combinations of the corners' (bi)linear hats χ with
///   ∫ψ_k χ_l = δ_kl ∫χ_k     (ψ = D G⁻¹ χ, G_kl = ∫χ_kχ_l, D = diag ∫χ_k;  Σψ_k = 1, ∫ψ_k = ∫χ_k),
/// over what quadrature points cover of the facet.
class DualHats {
 public:
  explicit DualHats(int corners) : gram_(Eigen::MatrixXd::Zero(corners, corners)), at_(corners) {}

  /// The next point of the quadrature, and the hats there.
  void point(const double* hats, double measure) {
    at_ = measure * Eigen::Map<const Eigen::VectorXd>(hats, at_.size());
    gram_ += at_ * Eigen::Map<const Eigen::VectorXd>(hats, at_.size()).transpose();
  }
  /// The value there of the function with this number.
  void value(int function, double value) {
    moments_.try_emplace(function, Eigen::VectorXd::Zero(at_.size())).first->second += value * at_;
  }
  /// ∫ψ_k, corner by corner: Σχ = 1, so that rows of the Gram matrix sum to ∫χ.
  Eigen::VectorXd weights() const { return gram_.rowwise().sum(); }
  /// ∫ψ_k f, a function each. Scaled: a narrow strip along an edge has small hats.
  std::map<int, Eigen::VectorXd> moments() const {
    const Eigen::VectorXd weight = weights(), scale = gram_.diagonal().cwiseSqrt().cwiseInverse();
    const algebra::Ldlt factor(scale.asDiagonal() * gram_ * scale.asDiagonal());
    std::map<int, Eigen::VectorXd> dual;
    for (const auto& [function, moment] : moments_)
      dual[function] = weight.asDiagonal() * (scale.asDiagonal() * factor.solve(Eigen::VectorXd(scale.asDiagonal() * moment)));
    return dual;
  }

 private:
  Eigen::MatrixXd gram_;
  Eigen::VectorXd at_;
  std::map<int, Eigen::VectorXd> moments_;
};

}  // namespace dotyk::contact
