#include "problem/law_choice.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::problem {

int LawSpec::count() const {
  return static_cast<int>(std::find_if(numbers.begin(), numbers.end(), [](const LawNumber& n) { return !n.name; }) - numbers.begin());
}

std::span<const LawSpec* const> law_table() {
  static constexpr const LawSpec* kTable[] = {
      &laws::free,     &laws::prescribed,         &laws::load,           &laws::elastic,         &laws::one_sided_elastic, &laws::signorini,
      &laws::friction, &laws::one_sided_friction, &laws::capped_elastic, &laws::unequal_elastic, &laws::compliance,        &laws::breaking,
      &laws::coulomb};
  return kTable;
}

double LawChoice::number(LawNumber::Role role, double otherwise) const {
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (spec->numbers[i].role == role) return numbers[i];
  return otherwise;
}

std::string describe(const LawChoice& law) {
  std::string out = law.spec->words;
  for (int i = 0; i < law.spec->count(); ++i)
    out += text(i == 0 ? " " : ", ", law.spec->numbers[i].before, std::isnan(law.numbers[i]) ? "a function" : text(law.numbers[i]), law.spec->numbers[i].after);
  return out;
}

std::string describe(const LawAlong& law) {
  return law.at.empty() ? describe(law.law) : text(law.law.spec->words, ", which varies");
}

void LawAlong::scale(double factor) {
  law.scale(factor);
  for (auto& numbers : at) {
    LawChoice here{law.spec, numbers};
    here.scale(factor);
    numbers = here.numbers;
  }
}

bool LawAlong::moves() const {
  if (!law->prescribes) return false;
  return at.empty() ? law.numbers[0] != 0 : std::any_of(at.begin(), at.end(), [](const auto& numbers) { return numbers[0] != 0; });
}

Status status_of(const LawTraits& law, bool follows, bool bears) {
  if (!law.acts()) return Status::open;
  if (law.yields()) return follows ? Status::stick : bears || law.pulls ? Status::slip : Status::open;
  return follows || law.load || !law.directed() ? Status::closed : Status::open;
}

void require_valid(const LawChoice& law, const std::string& where) {
  constexpr double kLeast = 1e-300;  // such numbers have no inverse, or lose digits in a product with a length: what is made of them is 0 here, not there
  for (int i = 0; i < law.spec->count(); ++i) {
    const LawNumber& n = law.spec->numbers[i];
    const double value = law.numbers[i];
    const bool no_slip = law->rubs() && n.role == LawNumber::Role::bound && value == Law::kUnbounded;
    if ((!std::isfinite(value) && !no_slip) || value < n.least)
      throw InputError(text(law.spec->words, " law: ", n.name, " is ", std::isnan(value) ? "not a number" : text(value), where, "; it must be ",
                            n.least == 0 ? "zero or positive, and " : n.least > 0 ? text(n.least, " or more, and ") : "", "finite"));
    if (law->elastic() && value > 0 && value < kLeast && n.role != LawNumber::Role::bound)
      throw InputError(text(law.spec->words, " law: the stiffness ", value, " is lost in rounding beside any body's; leave that away, or make it stiffer"));
  }
}

std::shared_ptr<const Law> row_law(std::span<const LawRow> rows, double unit) {
  return rows.empty() || !rows.front().law.spec->rows ? nullptr : rows.front().law.spec->rows(rows, unit);
}

std::shared_ptr<const Law> row_law(const LawChoice& law) { return row_law(std::array{LawRow{law}}); }

bool bears(const LawChoice& law) {
  const auto row = row_law(law);
  return row && row->multipliers(0).low < row->multipliers(0).high;
}

bool one_sided_spring(const LawChoice& law) {
  if (!law->elastic() || !bears(law)) return false;
  const Interval lambda = row_law(law)->multipliers(0);
  return lambda.low == 0 || lambda.high == 0;
}

std::optional<double> sole_displacement(const LawChoice& law, double r) {
  if (law->prescribes) return law.displacement();
  const auto row = row_law(law);
  if (!row) return std::nullopt;
  const Interval bounds = row->multipliers(0);
  if (!(r > bounds.low && r < (law->breaks ? std::min(law.bound(), bounds.high) : bounds.high))) return std::nullopt;
  return -row->displacement(0, r);
}

double yield_displacement(const LawChoice& law) {
  return law->elastic() && law->bounded && law.stiffness() > 0 ? law.bound() / law.stiffness() : Law::kUnbounded;
}

double breaking_energy(const LawChoice& law) {
  return law->breaks && law.stiffness() > 0 ? 0.5 * law.bound() * law.bound() / law.stiffness() : 0;
}

}  // namespace dotyk::problem
