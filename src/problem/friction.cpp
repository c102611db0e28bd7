#include "problem/friction.hpp"

#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "problem/law_table.hpp"

namespace dotyk::problem {
namespace {

/// b = g, or, where it `follows` the normal force, μ λ_n.
class Bounded final : public Friction {
 public:
  Bounded(std::string name, std::vector<double> values, bool follows) : name_(std::move(name)), values_(std::move(values)), follows_(follows) {
    for (double v : values_)
      if (!(v >= 0) || !std::isfinite(v))
        throw InputError(text("the friction ", follows_ ? "coefficient" : "bound", " is ", v, "; it must be zero or positive"));
  }
  std::string name() const override { return name_; }
  double bound(int point, double normal) const override { return follows_ ? values_[point] * std::max(normal, 0.0) : values_[point]; }
  double bound_slope(int point) const override { return follows_ ? values_[point] : 0; }

 private:
  std::string name_;
  std::vector<double> values_;
  bool follows_;
};

}  // namespace

std::shared_ptr<const Friction> tresca(std::vector<double> bounds) {
  return std::make_shared<Bounded>("given friction", std::move(bounds), false);
}

std::shared_ptr<const Friction> coulomb(std::vector<double> coefficients) {
  return std::make_shared<Bounded>("Coulomb friction", std::move(coefficients), true);
}

const LawSpec laws::coulomb{
    .name = "coulomb", .words = "Coulomb friction", .help = "Friction bounded by mu times the normal force.",
    .traits = {.rigid = true, .pushes = true, .pulls = true, .bounded = true, .follows = true},
    .numbers = {{{.name = "mu", .role = LawNumber::Role::coefficient, .help = "coefficient, not negative", .example = "0.3"}}}};

DiscProjection project_disc(const Eigen::Ref<const Eigen::VectorXd>& y, double bound) {
  const Eigen::Index n = y.size();
  const double length = y.norm();
  if (length <= bound)
    return {y, Eigen::MatrixXd::Identity(n, n), Eigen::VectorXd::Zero(n), true};
  const Eigen::VectorXd along = y / length;
  return {bound * along, bound / length * (Eigen::MatrixXd::Identity(n, n) - along * along.transpose()), along, false};
}

}  // namespace dotyk::problem
