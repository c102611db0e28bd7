#include "problem/law/limited.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::problem {
namespace {

class Limited final : public Law {
 public:
  Limited(std::string name, std::vector<Limits> limits) : name_(std::move(name)), limits_(std::move(limits)) {}
  std::string name() const override { return name_; }

  Projection project(int row, double y, double rho) const override {
    const auto [k, low, high] = limits_[row];
    if (k == 0) return {0, 0};  // also at rho = 0
    const double slope = std::isfinite(k) ? k / (k + rho) : 1, lambda = slope * y;
    if (lambda < low) return {low, 0};
    if (lambda > high) return {high, 0};
    return {lambda, low < high ? slope : 0};
  }

  double energy(int row, double x) const override {
    const auto [k, low, high] = limits_[row];
    if (k == 0 || x == 0) return 0;
    if (!std::isfinite(k)) {
      const double end = x > 0 ? high : low;
      return std::isfinite(end) ? end * x : 0;
    }
    const double lambda = std::clamp(k * x, low, high);
    return lambda * (x - 0.5 * lambda / k);
  }

  double conjugate(int row, double lambda) const override {
    const double k = limits_[row].stiffness;
    return k > 0 && std::isfinite(k) ? 0.5 * lambda * lambda / k : 0;
  }

  Interval multipliers(int row) const override {
    const Limits& l = limits_[row];
    return l.stiffness > 0 ? Interval{l.low, l.high} : Interval{0, 0};
  }

  std::optional<Springs> springs(int row) const override { return Springs{limits_[row].stiffness, limits_[row].stiffness}; }

 private:
  std::string name_;
  std::vector<Limits> limits_;
};

}  // namespace

std::shared_ptr<const Law> limited(std::string name, std::vector<Limits> limits) {
  for (const Limits& l : limits) {
    if (!(l.stiffness >= 0)) throw InputError(text(name, " law: stiffness is ", l.stiffness, "; it must be zero or positive"));
    if (!(l.low <= 0 && l.high >= 0))
      throw InputError(text(name, " law: the force would lie between ", l.low, " and ", l.high, "; zero must be one of them or between"));
  }
  return std::make_shared<Limited>(std::move(name), std::move(limits));
}

}  // namespace dotyk::problem
