#include "figure/canvas/axes.hpp"

#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <tuple>

namespace dotyk::figure {
namespace {

Wide place(const Axis& axis, double value) { return axis.log ? Wide{std::log10(value)} : Wide{value}; }

Wide per_unit(const Axis& axis) { return (axis.to - axis.from) / (place(axis, axis.high) - place(axis, axis.low)); }

// The part of a broken axis on which the value lies.
Axis part_of(const Axis& axis, double value) {
  const AxisBreak& b = *axis.left_out;
  if (value < b.from) return {axis.log, axis.low, b.from, axis.from, b.low};
  if (value > b.to) return {axis.log, b.to, axis.high, b.high, axis.to};
  return {axis.log, b.from, b.to, b.low, b.high};
}

double hair(double em) { return std::max(1.0, em / 24); }

// Do all labels have room, `apart` em from each other at least?
bool fit(const Ticks& ticks, const Axis& axis, double em, double apart = 0.8) {
  double last = -1e9;
  for (const Tick& t : ticks.ticks) {
    if (t.label.empty()) continue;
    const double half = text_extent(t.label, em).x / 2;
    if (axis.pixel(t.value) - half - last < apart * em) return false;
    last = axis.pixel(t.value) + half;
  }
  return true;
}

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

bool Axis::shows(double value) const { return std::isfinite(value) && (!log || value > 0); }

double Axis::pixel(double value) const {
  if (left_out) return part_of(*this, value).pixel(value);
  const Wide a = place(*this, low), b = place(*this, high);
  const Wide at = from + (to - from) * ((place(*this, value) - a) / (b - a));
  return static_cast<double>(std::clamp<Wide>(at, -most_pixels, most_pixels));
}

double Axis::value(double pixel) const {
  const Wide a = place(*this, low), at = a + (pixel - from) / (to - from) * (place(*this, high) - a);
  return static_cast<double>(log ? std::pow(Wide{10}, at) : at);
}

double Axis::pixels_per_unit() const { return static_cast<double>(std::min<Wide>(per_unit(*this), most_pixels)); }

double steepness(const Axis& x, const Axis& y, double slope) {
  return static_cast<double>(std::clamp<Wide>(slope * per_unit(y) / per_unit(x), -most_pixels, most_pixels));
}

Point Axes::at(double x_value, double y_value) const {
  if (!pole) return {x.pixel(x_value), y.pixel(y_value)};
  const double angle = x_value * std::numbers::pi / 180;
  return *pole + y.pixel(y_value) * Point{std::cos(angle), std::sin(angle)};
}

std::vector<std::vector<Point>> pieces(std::size_t count, const std::function<std::optional<Point>(std::size_t)>& at) {
  std::vector<std::vector<Point>> out(1);
  for (std::size_t i = 0; i < count; ++i) {
    if (const std::optional<Point> point = at(i))
      out.back().push_back(*point);
    else if (!out.back().empty())
      out.emplace_back();
  }
  if (out.back().empty()) out.pop_back();
  return out;
}

void draw_grid(Canvas& canvas, const Axes& a) {
  canvas.box(a.room, {255, 255, 255});
  for (const double x : a.x_ticks.labelled()) canvas.line({a.x.pixel(x), a.room.bottom}, {a.x.pixel(x), a.room.top}, hair(a.em), axes_grid);
  for (const double y : a.y_ticks.labelled()) canvas.line({a.room.left, a.y.pixel(y)}, {a.room.right, a.y.pixel(y)}, hair(a.em), axes_grid);
}

void draw_ticks(Canvas& canvas, const Axes& a, Side side, bool labels, Colour colour) {
  const double tick = a.tick * a.em;
  const bool vertical = side != Side::below;
  const Point inwards = side == Side::left ? Point{1, 0} : side == Side::right ? Point{-1, 0} : Point{0, 1};
  double busy_until = -1e9;
  for (const Tick& t : (vertical ? a.y_ticks : a.x_ticks).ticks) {
    const double p = (vertical ? a.y : a.x).pixel(t.value), length = t.label.empty() ? 0.55 * tick : tick;
    const Point foot = vertical ? Point{side == Side::left ? a.room.left : a.room.right, p} : Point{p, a.room.bottom};
    canvas.line(foot, foot + length * inwards, 1.3 * hair(a.em), colour);
    if (t.label.empty() || !labels) continue;
    const double half = (vertical ? 0.9 * a.em : text_extent(t.label, a.em).x + 0.5 * a.em) / 2;
    if (p - half < busy_until) continue;
    busy_until = p + half;
    TextStyle style{.size = a.em, .across = side == Side::left ? Align::high : Align::low, .up = Align::middle};
    if (!vertical) style.across = Align::middle, style.up = Align::high;
    if (!(colour == axes_ink)) style.colour = colour;
    canvas.text(foot - (vertical ? 0.4 : 0.35) * a.em * inwards, t.label, style);
  }
}

void draw_frame(Canvas& canvas, const Axes& a) { canvas.outline(a.room, std::max(1.2, a.em / 18), axes_ink); }

double widest_label(const Ticks& ticks, double size) {
  double widest = 0;
  for (const Tick& t : ticks.ticks) widest = std::max(widest, text_extent(t.label, size).x);
  return widest;
}

Ticks few_ticks(double low, double high, double wanted, double plain) {
  const std::size_t least = wanted < 2.3 ? 2 : 4;
  Ticks out;
  for (int n = std::clamp(static_cast<int>(wanted), 2, 8); n <= 10 && out.labelled().size() < least; ++n) out = linear_ticks(low, high, n, plain);
  return out;
}

double share_below(const Axis& axis) {
  constexpr double kLeast = 0.2;
  const AxisBreak& b = *axis.left_out;
  return std::clamp((b.from - axis.low) / (b.from - axis.low + axis.high - b.to), kLeast, 1 - kLeast);
}

Ticks broken_ticks(const Axis& axis, double wanted) {
  constexpr double kMost = 20;
  const AxisBreak& b = *axis.left_out;
  const double below = b.from - axis.low, above = axis.high - b.to, share = share_below(axis);
  const bool one_scale = std::abs(share - below / (below + above)) < 1e-9;
  const auto part = [&](double low, double high, double labels, std::size_t least) {
    Ticks out;
    for (double n = std::max(1.0, labels); out.labelled().size() < least && n < kMost; n *= 1.3) out = linear_ticks(low, high, static_cast<int>(n));
    return out;
  };
  if (!one_scale) {
    Ticks out = part(axis.low, b.from, share * wanted, 2), upper = part(b.to, axis.high, (1 - share) * wanted, 1);
    const int exponent = std::max(out.exponent, upper.exponent);
    for (Ticks* own : {&out, &upper})
      for (Tick& t : own->ticks)
        if (own->exponent != exponent && !t.label.empty()) t.label = scaled_number(t.value, exponent);
    out.exponent = exponent;
    std::ranges::copy(upper.ticks, std::back_inserter(out.ticks));
    return out;
  }
  const double least = std::max(3.0, wanted) * (axis.high - axis.low) / (below + above);
  for (double n = least;; n *= 1.3) {
    Ticks out = linear_ticks(axis.low, axis.high, static_cast<int>(n));
    std::erase_if(out.ticks, [&](const Tick& t) { return t.value >= b.from && t.value <= b.to; });
    const std::vector<double> values = out.labelled();
    const auto over = std::count_if(values.begin(), values.end(), [&](double v) { return v > b.to; });
    if ((over > 0 && std::ssize(values) - over > 1) || n > kMost * least) return out;
  }
}

Ticks spaced_ticks(const Axis& axis, double em) {
  Ticks out;
  for (const auto& [apart, least] : {std::tuple{0.8, 4U}, {0.4, 4U}, {0.8, 3U}})
    for (int n = 8; n >= 2; --n)
      if (fit(out = few_ticks(axis.low, axis.high, n), axis, em, apart) && out.labelled().size() >= least) return out;
  for (const double plain : {1e-3, 1.0})
    for (int n = 6; n >= 2; --n)
      if (fit(out = linear_ticks(axis.low, axis.high, n, plain), axis, em) && out.labelled().size() > 2) return out;
  if (fit(out = few_ticks(axis.low, axis.high, 2), axis, em)) return out;
  // Every second label, counted from zero.
  const std::vector<double> labelled = out.labelled();
  const double step = labelled.size() > 1 ? labelled[1] - labelled[0] : 0;
  const auto even = [step](double value) { return step > 0 && std::lround(value / step) % 2 == 0; };
  const bool enough = std::count_if(labelled.begin(), labelled.end(), even) >= 2;
  for (Tick& t : out.ticks)
    if (even(t.value) != enough) t.label.clear();
  return out;
}

std::string axis_name(const std::string& label, const Ticks& ticks) {
  return ticks.exponent ? label + "  (× " + power_of_ten(ticks.exponent) + ")" : label;
}

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

std::string scaled_unit(const std::string& unit, int exponent) {
  if (exponent == 0) return unit;
  const bool takes = unit == "N" || unit.starts_with("Pa") || unit.starts_with("N/") || unit.starts_with("N·");
  return takes && exponent % 3 == 0 && exponent > 0 && exponent <= 9 ? " kMG"[exponent / 3] + unit : power_of_ten(exponent) + (unit.empty() ? "" : " " + unit);
}

std::string at_most(const std::string& what, double value, const std::string& unit) {
  const int exponent = value >= plain_below ? exponent_of(value) : 0;
  const std::string words = scaled_unit(unit, exponent);
  return what + ", at most " + scaled_number(value, exponent) + (words.empty() ? "" : (words.starts_with("10") ? " × " : " ") + words);
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
