#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "problem/law.hpp"

namespace dotyk::problem {
namespace {

/// Also with one spring for both sides.
class Elastic final : public Law {
 public:
  Elastic(std::string name, std::vector<Springs> stiffness)
      : name_(std::move(name)), k_(std::move(stiffness)), linear_(std::all_of(k_.begin(), k_.end(), [](const Springs& k) { return k.below == k.above; })) {}
  std::string name() const override { return name_; }

  Projection project(int row, double y, double rho) const override {
    const double k = y == 0 ? std::max(k_[row].below, k_[row].above) : of_side(row, y);
    if (k == 0) return {0, 0};  // also at rho = 0
    const double slope = k / (k + rho);
    return {slope * y, slope};
  }

  double energy(int row, double x) const override { return 0.5 * of_side(row, x) * x * x; }

  double conjugate(int row, double lambda) const override {
    const double k = of_side(row, lambda);
    return k > 0 ? 0.5 * lambda * lambda / k : 0;
  }

  Interval multipliers(int row) const override {
    return {k_[row].below > 0 ? -kUnbounded : 0, k_[row].above > 0 ? kUnbounded : 0};
  }
  std::optional<Springs> springs(int row) const override { return k_[row]; }

  std::optional<double> linear_stiffness(int row) const override {
    return linear_ ? std::optional<double>(k_[row].above) : std::nullopt;
  }

 private:
  double of_side(int row, double at) const { return at < 0 ? k_[row].below : k_[row].above; }

  std::string name_;
  std::vector<Springs> k_;
  bool linear_;  ///< in every row, as those ask who ask of one
};

}  // namespace

std::shared_ptr<const Law> elastic(std::vector<double> stiffness) {
  std::vector<Springs> springs;
  for (double k : stiffness) {
    if (!(k >= 0) || !std::isfinite(k))
      throw InputError(text("elastic law: stiffness is ", k, "; it must be zero or positive"));
    springs.push_back({k, k});
  }
  return std::make_shared<Elastic>("elastic", std::move(springs));
}

std::shared_ptr<const Law> unequal_elastic(std::vector<Springs> stiffness) {
  for (const Springs& springs : stiffness)
    for (const double k : {springs.below, springs.above})
      if (!(k >= 0) || !std::isfinite(k))
        throw InputError(text("unequal elastic law: a stiffness is ", k, "; it must be zero or positive, and finite"));
  return std::make_shared<Elastic>("unequal elastic", std::move(stiffness));
}

}  // namespace dotyk::problem
