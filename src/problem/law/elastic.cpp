#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "problem/law_choice.hpp"

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

namespace {

using Role = LawNumber::Role;

constexpr LawNumber stiffness(const char* name = "k", const char* help = "stiffness, not negative") {
  return {.name = name, .role = Role::stiffness, .help = help, .unit = "force/length, or moment of a rotation; on a part per length or area as well", .example = "100"};
}

constexpr LawNumber bound(const char* before = "") {
  return {.name = "g", .role = Role::bound, .help = "greatest force, not negative", .unit = "force, or moment of a rotation; on a part per length or area", .example = "2", .before = before};
}

/// Rows whose force lies between −bound or 0 and the bound: springs, or rigid where the law is.
std::shared_ptr<const Law> cut_off_rows(std::span<const LawRow> rows, double unit) {
  const auto part = [](double number, double share) { return std::isfinite(number) ? number * share : number; };
  std::vector<Limits> limits;
  for (const auto& [law, share] : rows) {
    const double k = law->rigid ? Law::kUnbounded : law.stiffness() / (unit * unit), most = law->breaks ? Law::kUnbounded : law.bound() / unit;
    limits.push_back({part(k, share), law->pulls ? -part(most, share) : 0, part(most, share)});
  }
  return limited(rows.front().law.spec->words, std::move(limits));
}

}  // namespace

const LawSpec laws::elastic{
    .name = "elastic", .words = "elastic", .help = "A spring: the reaction is -k v.", .traits = {.pushes = true, .pulls = true}, .numbers = {{stiffness()}},
    .rows = [](std::span<const LawRow> rows, double unit) {
      std::vector<double> stiffness;
      for (const auto& [law, share] : rows) stiffness.push_back(law.stiffness() / (unit * unit) * share);
      return problem::elastic(std::move(stiffness));
    }};

const LawSpec laws::one_sided_elastic{
    .name = "one_sided_elastic", .words = "one-sided elastic",
    .help = "A spring that only pushes: up against deflections below zero, down against slopes above zero, off the support on a part.",
    .traits = {.pushes = true}, .numbers = {{stiffness()}}, .rows = cut_off_rows};

const LawSpec laws::friction{
    .name = "friction", .words = "friction", .help = "Rigid friction: holds up to a reaction of g, and slips against it.",
    .traits = {.rigid = true, .pushes = true, .pulls = true, .bounded = true}, .numbers = {{bound()}}, .rows = cut_off_rows};

const LawSpec laws::one_sided_friction{
    .name = "one_sided_friction", .words = "one-sided friction", .help = "Rigid friction on one side: holds up to g where a rigid stop would push, and else not at all.",
    .traits = {.rigid = true, .pushes = true, .bounded = true}, .numbers = {{bound()}}, .rows = cut_off_rows};

const LawSpec laws::capped_elastic{
    .name = "capped_elastic", .words = "capped elastic", .help = "A spring whose reaction is at most g, either way.",
    .traits = {.pushes = true, .pulls = true, .bounded = true}, .numbers = {{stiffness(), bound("at most ")}}, .rows = cut_off_rows};

const LawSpec laws::unequal_elastic{
    .name = "unequal_elastic", .words = "unequal elastic",
    .help = "A spring that pushes with one stiffness and pulls with another: the reaction is -k_push v or -k_pull v. It pushes where one_sided_elastic does: "
            "up against deflections below zero, down against slopes above zero, off the support on a part.",
    .traits = {.pushes = true, .pulls = true, .uneven = true},
    .numbers = {{{.name = "k_push", .role = Role::stiffness, .help = "stiffness where it pushes, not negative", .unit = stiffness().unit, .example = "100", .after = " pushed"},
                 {.name = "k_pull", .role = Role::pull, .help = "stiffness where it pulls, not negative", .unit = stiffness().unit, .example = "20", .after = " pulled"}}},
    .rows = [](std::span<const LawRow> rows, double unit) {
      std::vector<Springs> springs;
      for (const auto& [law, share] : rows) springs.push_back({law.numbers[1] / (unit * unit) * share, law.numbers[0] / (unit * unit) * share});
      return problem::unequal_elastic(std::move(springs));
    }};

const LawSpec laws::breaking{
    .name = "breaking", .words = "breaking",
    .help = "A spring that only pushes and breaks where its reaction would exceed g. Not monotone: a beam may have several solutions (s.branches), of a part one path is followed.",
    .traits = {.pushes = true, .bounded = true, .breaks = true}, .numbers = {{stiffness(), bound("at most ")}}, .rows = cut_off_rows};

}  // namespace dotyk::problem
