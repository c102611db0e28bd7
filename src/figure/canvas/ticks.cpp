// Ticks of axes, and numbers.
#include "figure/canvas/axes.hpp"

#include <cstdio>
#include <cstdlib>

namespace dotyk::figure {

namespace {

const char* const minus = "\u2212";

// Numbers next to nothing are so coarse that a tick may have to stand elsewhere: then it is none.
bool can_stand(Wide value, Wide low, Wide high) {
  const auto at = static_cast<double>(value);
  return std::isfinite(at) && std::abs(at - value) <= 0.01L * (high - low);
}

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", std::max(0, decimals), std::abs(value));
  const bool zero = std::string(text).find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !zero ? minus : "") + std::string(text);
}

std::string trimmed(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

constexpr double plain_below = 0.9e5;  // numbers below have no power of ten

// The exponent of a power of 1000 for numbers up to this one. 0.95e6 is already written with 10⁶.
int exponent_of(double greatest) { return 3 * static_cast<int>(std::floor((std::log10(greatest) + 0.05) / 3)); }

}  // namespace

std::vector<double> Ticks::labelled() const {
  std::vector<double> out;
  for (const Tick& tick : ticks)
    if (!tick.label.empty()) out.push_back(tick.value);
  return out;
}

std::string power_of_ten(int k) {
  static const char* const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = k < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(k))) text += raised[digit - '0'];
  return text;
}

std::string number(double value, int digits) {
  if (value == 0) return "0";
  if (!std::isfinite(value)) return std::isnan(value) ? "?" : value < 0 ? std::string(minus) + "∞" : "∞";
  // Round first: 9.996 has the exponent of 10.0.
  char text[64];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
  const int exponent = std::atoi(std::string(text).substr(std::string(text).find('e') + 1).c_str());
  if (exponent >= 5 || exponent < -3)
    return trimmed(fixed(static_cast<double>(value / std::pow(Wide{10}, exponent)), digits - 1)) + " × " + power_of_ten(exponent);
  return trimmed(fixed(value, digits - 1 - exponent));
}

std::string scaled_number(double value, int exponent, int digits) {
  if (exponent == 0 || value == 0 || !std::isfinite(value)) return number(value, digits);
  const double scaled = value / std::pow(10.0, exponent), size = std::abs(scaled);
  if (size < 1e-3) return value > 0 ? "< 0.001" : std::string("> ") + minus + "0.001";
  return size < 1e3 ? number(scaled, digits) : fixed(scaled, 0);
}

std::string at_most(const std::string& what, double value, const std::string& unit) {
  const int exponent = value >= plain_below ? exponent_of(value) : 0;
  return what + ", at most " + scaled_number(value, exponent) + (exponent ? " × " + power_of_ten(exponent) : "") + (unit.empty() ? "" : " " + unit);
}

Ticks linear_ticks(double low, double high, int wanted, double plain) {
  Ticks out;
  if (!std::isfinite(low) || !std::isfinite(high)) return out;
  if (!(high > low)) {
    out.ticks.push_back({low, number(low)});
    return out;
  }
  const Wide range = Wide{high} - low, raw = range / std::max(1, wanted);
  const Wide power = std::pow(Wide{10}, std::floor(std::log10(raw)));
  const Wide ratio = raw / power;
  const Wide unit = ratio <= 1.0000001 ? 1 : ratio <= 2.0000001 ? 2 : ratio <= 5.0000001 ? 5 : 10;
  const Wide step = unit * power;
  const int step_exponent = static_cast<int>(std::floor(std::log10(step) + 1e-9));
  const double greatest = std::max(std::abs(low), std::abs(high));
  if (greatest >= plain_below || greatest < plain) out.exponent = exponent_of(greatest);
  const int decimals = std::max(0, out.exponent - step_exponent);
  const Wide factor = std::pow(Wide{10}, out.exponent);
  const int parts = unit == 2 ? 4 : 5;
  const Wide slack = 1e-9 * range;
  const auto add = [&](Wide at, const std::string& label) {
    if (at >= low - slack && at <= high + slack && can_stand(at, low, high)) out.ticks.push_back({static_cast<double>(at), label});
  };
  const Wide first = std::ceil((low - slack) / step) - 1;
  // Bounded: far from zero next to nothing may not be told apart.
  for (int n = 0; n <= 4 * wanted + 10 && (first + n) * step <= high + slack; ++n) {
    const Wide k = first + n;
    add(k * step, fixed(static_cast<double>(k * step / factor), decimals));
    for (int i = 1; i < parts; ++i) add((k + Wide{1} * i / parts) * step, "");
  }
  return out;
}

Ticks log_ticks(double low, double high, int wanted) {
  Ticks out;
  if (!(low > 0 && high >= low && std::isfinite(high))) return out;
  const double from = std::log10(low), to = std::log10(high);
  const int first = static_cast<int>(std::floor(from)), last = static_cast<int>(std::ceil(to));
  const double decades = to - from;
  int every = std::max(1, static_cast<int>(std::ceil(decades / std::max(1, wanted))));
  // Of hundreds of decades, few have a tick at all.
  if (every > 10) every = (every + 4) / 5 * 5;
  const int step = every > 10 ? every / 5 : 1;
  const double slack = 1e-9;
  for (int k = first; k <= last; ++k) {
    if (k % step) continue;
    for (int m = 1; m < (every > 1 ? 2 : 10); ++m) {
      const Wide value = m * std::pow(Wide{10}, k);
      const auto at = static_cast<double>(std::log10(value));
      if (at < from - slack || at > to + slack || !can_stand(value, 0, value)) continue;
      std::string label;
      const bool between = decades < 0.7 || (decades < 2.3 && (m == 2 || m == 5));
      if (m == 1 && k % every == 0)
        label = decades < 2.3 && std::abs(k) <= 3 ? number(static_cast<double>(value)) : power_of_ten(k);
      else if (m > 1 && between)
        label = std::abs(k) <= 3 ? number(static_cast<double>(value)) : number(m, 1) + "·" + power_of_ten(k);
      out.ticks.push_back({static_cast<double>(value), label});
    }
  }
  // Next to no decade: as on a linear axis.
  const std::size_t few = decades < 0.5 ? 3 : 2;
  return out.labelled().size() < few && every == 1 ? linear_ticks(low, high, wanted) : out;
}

}  // namespace dotyk::figure
