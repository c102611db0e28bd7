#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "problem/law.hpp"

namespace dotyk::problem {
namespace {

/// λ(x) of one row: a spring on each side, cut off at two limits.
struct Line {
  Springs springs;
  Interval limits;
};

class Elastic final : public Law {
 public:
  /// `linear`: no row has a kink or a limit.
  Elastic(std::string name, std::vector<Line> rows, bool linear) : name_(std::move(name)), rows_(std::move(rows)), linear_(linear) {}
  std::string name() const override { return name_; }

  Projection project(int row, double y, double rho) const override {
    const auto& [springs, limits] = rows_[row];
    const double k = y == 0 ? std::max(springs.below, springs.above) : of_side(row, y);
    if (k == 0) return {0, 0};  // also at rho = 0
    const double slope = std::isfinite(k) ? k / (k + rho) : 1, lambda = slope * y;
    if (lambda < limits.low) return {limits.low, 0};
    if (lambda > limits.high) return {limits.high, 0};
    return {lambda, limits.low < limits.high ? slope : 0};
  }

  double energy(int row, double x) const override {
    const double k = of_side(row, x);
    const auto [low, high] = rows_[row].limits;
    if (k == 0 || x == 0) return 0;
    if (!std::isfinite(k)) {
      const double end = x > 0 ? high : low;
      return std::isfinite(end) ? end * x : 0;
    }
    const double lambda = std::clamp(k * x, low, high);
    return lambda * (x - 0.5 * lambda / k);
  }

  double conjugate(int row, double lambda) const override {
    const double k = of_side(row, lambda);
    return k > 0 && std::isfinite(k) ? 0.5 * lambda * lambda / k : 0;
  }

  Interval multipliers(int row) const override {
    const auto& [springs, limits] = rows_[row];
    return {springs.below > 0 ? limits.low : 0, springs.above > 0 ? limits.high : 0};
  }
  std::optional<Springs> springs(int row) const override { return rows_[row].springs; }
  std::optional<double> linear_stiffness(int row) const override {
    return linear_ ? std::optional<double>(rows_[row].springs.above) : std::nullopt;
  }

 private:
  double of_side(int row, double at) const { return at < 0 ? rows_[row].springs.below : rows_[row].springs.above; }

  std::string name_;
  std::vector<Line> rows_;
  bool linear_;
};

}  // namespace

std::shared_ptr<const Law> elastic(std::vector<double> stiffness) {
  std::vector<Line> rows;
  for (double k : stiffness) {
    if (!(k >= 0) || !std::isfinite(k))
      throw InputError(text("elastic law: stiffness is ", k, "; it must be zero or positive"));
    rows.push_back({{k, k}, {-Law::kUnbounded, Law::kUnbounded}});
  }
  return std::make_shared<Elastic>("elastic", std::move(rows), true);
}

std::shared_ptr<const Law> unequal_elastic(std::vector<Springs> stiffness) {
  std::vector<Line> rows;
  bool linear = true;
  for (const Springs& springs : stiffness) {
    for (const double k : {springs.below, springs.above})
      if (!(k >= 0) || !std::isfinite(k))
        throw InputError(text("unequal elastic law: a stiffness is ", k, "; it must be zero or positive, and finite"));
    rows.push_back({springs, {-Law::kUnbounded, Law::kUnbounded}});
    linear = linear && springs.below == springs.above;
  }
  return std::make_shared<Elastic>("unequal elastic", std::move(rows), linear);
}

std::shared_ptr<const Law> limited(std::string name, std::vector<Limits> limits) {
  std::vector<Line> rows;
  for (const auto& [k, low, high] : limits) {
    if (!(k >= 0)) throw InputError(text(name, " law: stiffness is ", k, "; it must be zero or positive"));
    if (!(low <= 0 && high >= 0))
      throw InputError(text(name, " law: the force would lie between ", low, " and ", high, "; zero must be one of them or between"));
    rows.push_back({{k, k}, {low, high}});
  }
  return std::make_shared<Elastic>(std::move(name), std::move(rows), false);
}

}  // namespace dotyk::problem
