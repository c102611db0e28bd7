#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "problem/law.hpp"

namespace dotyk::problem {
namespace {

class Elastic final : public Law {
 public:
  explicit Elastic(std::vector<double> stiffness) : k_(std::move(stiffness)) {}
  std::string name() const override { return "elastic"; }
  Projection project(int row, double y, double rho) const override {
    if (k_[row] == 0) return {0, 0};  // also at rho = 0
    const double slope = k_[row] / (k_[row] + rho);
    return {slope * y, slope};
  }
  double energy(int row, double x) const override { return 0.5 * k_[row] * x * x; }
  double conjugate(int row, double lambda) const override {
    return k_[row] > 0 ? 0.5 * lambda * lambda / k_[row] : 0;
  }
  Interval multipliers(int row) const override {
    return k_[row] > 0 ? Interval{-kUnbounded, kUnbounded} : Interval{0, 0};
  }
  std::optional<Springs> springs(int row) const override { return Springs{k_[row], k_[row]}; }
  std::optional<double> linear_stiffness(int row) const override { return k_[row]; }

 private:
  std::vector<double> k_;
};

}  // namespace

std::shared_ptr<const Law> elastic(std::vector<double> stiffness) {
  for (double k : stiffness)
    if (!(k >= 0) || !std::isfinite(k))
      throw InputError(text("elastic law: stiffness is ", k, "; it must be zero or positive"));
  return std::make_shared<Elastic>(std::move(stiffness));
}

}  // namespace dotyk::problem
