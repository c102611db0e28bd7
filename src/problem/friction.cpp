#include "problem/friction.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::problem {
namespace {

void require_bounds(const std::vector<double>& values, const char* what) {
  for (double v : values)
    if (!(v >= 0) || !std::isfinite(v))
      throw InputError(text(what, " is ", v, "; it must be zero or positive"));
}

class Tresca final : public Friction {
 public:
  explicit Tresca(std::vector<double> bounds) : bounds_(std::move(bounds)) {}
  std::string name() const override { return "given friction"; }
  double bound(int point, double) const override { return bounds_[point]; }
  double bound_slope(int) const override { return 0; }

 private:
  std::vector<double> bounds_;
};

class Coulomb final : public Friction {
 public:
  explicit Coulomb(std::vector<double> coefficients) : mu_(std::move(coefficients)) {}
  std::string name() const override { return "Coulomb friction"; }
  double bound(int point, double normal) const override { return mu_[point] * std::max(normal, 0.0); }
  double bound_slope(int point) const override { return mu_[point]; }

 private:
  std::vector<double> mu_;
};

}  // namespace

std::shared_ptr<const Friction> tresca(std::vector<double> bounds) {
  require_bounds(bounds, "the friction bound");
  return std::make_shared<Tresca>(std::move(bounds));
}

std::shared_ptr<const Friction> coulomb(std::vector<double> coefficients) {
  require_bounds(coefficients, "the friction coefficient");
  return std::make_shared<Coulomb>(std::move(coefficients));
}

DiscProjection project_disc(const Eigen::Ref<const Eigen::VectorXd>& y, double bound) {
  const Eigen::Index n = y.size();
  const double length = y.norm();
  if (length <= bound)
    return {y, Eigen::MatrixXd::Identity(n, n), Eigen::VectorXd::Zero(n), true};
  const Eigen::VectorXd along = y / length;
  return {bound * along, bound / length * (Eigen::MatrixXd::Identity(n, n) - along * along.transpose()), along, false};
}

}  // namespace dotyk::problem
