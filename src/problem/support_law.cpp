#include "problem/support_law.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::problem {

using Kind = SupportLaw::Kind;

const char* support_name(Kind kind) {
  constexpr const char* kNames[] = {"free",        "prescribed",         "load",           "elastic",         "one-sided elastic", "Signorini", "friction",
                                    "one-sided friction", "capped elastic", "unequal elastic", "compliance", "Coulomb friction", "breaking"};
  static_assert(std::size(kNames) == static_cast<std::size_t>(Kind::breaking) + 1);
  return kNames[static_cast<std::size_t>(kind)];
}

std::string describe(const SupportLaw& law) {
  std::string out = support_name(law.kind);
  if (law.kind != Kind::free && law.kind != Kind::signorini) out += text(" ", law.value);
  if (law.kind == Kind::capped_elastic || law.kind == Kind::breaking) out += text(", at most ", law.limit);
  if (law.kind == Kind::compliance) out += text(", power ", law.power);
  if (law.kind == Kind::unequal_elastic) out += text(" pushed, ", law.pull, " pulled");
  return out;
}

bool one_sided(Kind kind) {
  return kind == Kind::one_sided_elastic || kind == Kind::signorini || kind == Kind::one_sided_friction ||
         kind == Kind::compliance || kind == Kind::breaking;
}

bool directed(Kind kind) { return one_sided(kind) || kind == Kind::unequal_elastic; }

bool rubs(Kind kind) { return kind == Kind::friction || kind == Kind::coulomb; }

Status status_of(Kind kind, bool follows, bool bears) {
  switch (kind) {
    case Kind::free: return Status::open;
    case Kind::load:
    case Kind::prescribed:
    case Kind::elastic: return Status::closed;
    case Kind::signorini:
    case Kind::one_sided_elastic:
    case Kind::compliance:
    case Kind::unequal_elastic:
    case Kind::breaking: return follows ? Status::closed : Status::open;
    case Kind::one_sided_friction: return follows ? Status::stick : bears ? Status::slip : Status::open;
    case Kind::friction:
    case Kind::coulomb:
    case Kind::capped_elastic: return follows ? Status::stick : Status::slip;
  }
  return Status::open;
}

namespace {

bool elastic(Kind kind) {
  return kind == Kind::compliance || kind == Kind::elastic || kind == Kind::one_sided_elastic || kind == Kind::capped_elastic || kind == Kind::unequal_elastic || kind == Kind::breaking;
}

/// Numbers so small have no inverse, or lose digits in a product with a length: what is made of them is 0 here and not there.
void require_told_from_none(const SupportLaw& law, double stiffness) {
  constexpr double kLeast = 1e-300;
  if (stiffness > 0 && stiffness < kLeast)
    throw InputError(text(support_name(law.kind), " law: the stiffness ", stiffness,
                          " is lost in rounding beside any body's; leave that away, or make it stiffer"));
}

}  // namespace

void require_valid(const SupportLaw& law) {
  const bool any_sign = law.kind == Kind::prescribed || law.kind == Kind::load;
  if (!std::isfinite(law.value) || (!any_sign && law.value < 0))
    throw InputError(text(support_name(law.kind), " law: the number is ", law.value, "; it must be ", any_sign ? "finite" : "zero or positive, and finite"));
  if (!(law.limit >= 0) || !std::isfinite(law.limit))
    throw InputError(text(support_name(law.kind), " law: the greatest force is ", law.limit, "; it must be zero or positive, and finite"));
  if (!(law.pull >= 0) || !std::isfinite(law.pull))
    throw InputError(text(support_name(law.kind), " law: the stiffness that pulls is ", law.pull, "; it must be zero or positive, and finite"));
  if (!(law.power >= 1) || !std::isfinite(law.power))
    throw InputError(text(support_name(law.kind), " law: the power is ", law.power, "; it must be one or more, and finite"));
  if (elastic(law.kind)) {
    require_told_from_none(law, law.value);
    require_told_from_none(law, law.pull);
  }
}

std::shared_ptr<const Law> row_law(const SupportLaw& law, double unit, const std::vector<double>& shares) {
  const double k = law.value / (unit * unit), bound = law.value / unit, limit = law.limit / unit;
  constexpr double rigid = Law::kUnbounded;
  const auto each = [&](const auto& of) {  // what it makes of every share
    std::vector<decltype(of(1.0))> rows;
    for (const double share : shares) rows.push_back(of(share));
    return rows;
  };
  const auto cut_off = [&](double stiffness, double low, double high) {
    const auto part = [](double number, double share) { return std::isfinite(number) ? number * share : number; };
    return limited(support_name(law.kind), each([&](double share) { return Limits{part(stiffness, share), part(low, share), part(high, share)}; }));
  };
  switch (law.kind) {
    case Kind::free:
    case Kind::load:
    case Kind::coulomb: return nullptr;
    case Kind::prescribed: return bilateral();
    case Kind::signorini: return unilateral();
    case Kind::breaking:
    case Kind::one_sided_elastic: return cut_off(k, 0, rigid);
    case Kind::compliance:
      return power_law(each([&](double share) { return law.value / std::pow(unit, law.power + 1) * share; }), law.power);
    case Kind::friction: return cut_off(rigid, -bound, bound);
    case Kind::one_sided_friction: return cut_off(rigid, 0, bound);
    case Kind::capped_elastic: return cut_off(k, -limit, limit);
    case Kind::unequal_elastic:
      return unequal_elastic(each([&](double share) { return Springs{law.pull / (unit * unit) * share, k * share}; }));
    case Kind::elastic: return elastic(each([&](double share) { return k * share; }));
  }
  return nullptr;
}

std::optional<double> sole_displacement(const SupportLaw& law, double r) {
  if (law.kind == Kind::prescribed) return law.value;
  const auto row = row_law(law);
  if (!row) return std::nullopt;
  const Interval bounds = row->multipliers(0);
  const double most = law.kind == Kind::breaking ? std::min(law.limit, bounds.high) : bounds.high;
  if (!(r > bounds.low && r < most)) return std::nullopt;
  if (law.kind == Kind::compliance) return -std::pow(r / law.value, 1 / law.power);
  return -r / (r > 0 ? row->springs(0)->above : row->springs(0)->below);
}

}  // namespace dotyk::problem
