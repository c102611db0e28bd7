#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "problem/law_choice.hpp"

namespace dotyk::problem {
namespace {

class PowerLaw final : public Law {
 public:
  PowerLaw(std::vector<double> factors, std::vector<double> powers) : c_(std::move(factors)), m_(std::move(powers)) {}
  std::string name() const override { return "compliance"; }

  Projection project(int row, double y, double rho) const override {
    const double c = c_[row];
    if (c == 0 || !(y > 0)) return {0, 0};
    if (rho == 0) return {y, 1};
    const double x = penetration(row, y, rho), slope = stiffness(row, x);
    const double lambda = rho * x > 0.5 * y ? c * std::pow(x, m_[row]) : y - rho * x;  // the one with more digits
    return {std::max(0.0, lambda), slope / (slope + rho)};
  }

  double energy(int row, double x) const override { return x > 0 ? c_[row] * std::pow(x, m_[row] + 1) / (m_[row] + 1) : 0; }

  double conjugate(int row, double lambda) const override {
    return lambda > 0 && c_[row] > 0 ? m_[row] / (m_[row] + 1) * lambda * displacement(row, lambda) : 0;
  }

  Interval multipliers(int row) const override { return {0, c_[row] > 0 ? kUnbounded : 0}; }
  Response respond(int row, double x) const override {
    return x > 0 ? Response{c_[row] * std::pow(x, m_[row]), stiffness(row, x)} : Response{0, 0};
  }
  double displacement(int row, double lambda) const override { return std::pow(lambda / c_[row], 1 / m_[row]); }
  std::vector<double> kinks(int) const override { return {0}; }

 private:
  double stiffness(int row, double x) const { return c_[row] * m_[row] * std::pow(x, m_[row] - 1); }

  /// c x^m + ρx = y by Newton's method from above: the left side is convex and increasing, so that iterates fall to x.
  double penetration(int row, double y, double rho) const {
    double x = std::min(y / rho, displacement(row, y));
    for (int i = 0; i < 100; ++i) {
      const double next = x - (c_[row] * std::pow(x, m_[row]) + rho * x - y) / (stiffness(row, x) + rho);
      if (!(next < x)) break;
      x = std::max(0.0, next);
    }
    return x;
  }

  std::vector<double> c_, m_;
};

}  // namespace

std::shared_ptr<const Law> power_law(std::vector<double> factors, std::vector<double> powers) {
  for (const double power : powers)
    if (!(power >= 1) || !std::isfinite(power)) throw InputError(text("compliance law: the power is ", power, "; it must be one or more, and finite"));
  for (const double c : factors)
    if (!(c >= 0) || !std::isfinite(c)) throw InputError(text("compliance law: the factor is ", c, "; it must be zero or positive, and finite"));
  return std::make_shared<PowerLaw>(std::move(factors), std::move(powers));
}

const LawSpec laws::compliance{
    .name = "compliance", .words = "compliance", .help = "Asperities that are pressed flat: pushes with c (-v)^m against v < 0, and not at all otherwise.",
    .traits = {.pushes = true},
    .numbers = {{{.name = "c", .role = LawNumber::Role::factor, .help = "factor, not negative", .unit = "force/length^m; on a part per length or area as well", .example = "100"},
                 {.name = "m", .role = LawNumber::Role::power, .help = "power", .example = "2", .least = 1, .usual = 2, .before = "power "}}},
    .rows = [](std::span<const LawRow> rows, double unit) {
      std::vector<double> factors, powers;
      for (const auto& [law, share] : rows) {
        powers.push_back(law.numbers[1]);
        factors.push_back(law.numbers[0] / std::pow(unit, powers.back() + 1) * share);
      }
      return power_law(std::move(factors), std::move(powers));
    },
    .named = true};

}  // namespace dotyk::problem
