#include "problem/support_graph.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace dotyk::problem {

using Kind = SupportLaw::Kind;

namespace {

constexpr double kInfinite = Law::kUnbounded;
constexpr int kParabola = 48;  // points of φ between two kinks

enum class Side { left, right };

/// The limit of r at v from one side; within the displacements that the law admits.
double limit_of_reaction(const SupportLaw& law, double v, Side side) {
  const auto below = [&](double kink) { return v < kink || (v == kink && side == Side::left); };
  if (law.kind == Kind::load) return law.value;
  if (law.kind == Kind::compliance) return below(0) ? law.value * std::pow(-v, law.power) : 0;
  if (law.kind == Kind::breaking && below(-yield_displacement(law))) return 0;
  const auto row = row_law(law);
  if (!row || law.kind == Kind::prescribed) return 0;
  const Interval bounds = row->multipliers(0);
  const double k = below(0) ? row->springs(0)->above : row->springs(0)->below;
  if (!std::isfinite(k)) return below(0) ? bounds.high : bounds.low;
  return std::clamp(-k * v, bounds.low, bounds.high);
}

/// Displacements where r has a kink or many values.
std::set<double> kinks(const SupportLaw& law) {
  std::set<double> at;
  if (law.kind == Kind::compliance) return {0};
  if (law.kind == Kind::breaking) at.insert(-yield_displacement(law));
  const auto row = row_law(law);
  if (!row || row->multipliers(0).low == row->multipliers(0).high) return at;
  if (kinked_at_zero(*row, 0)) at.insert(0);
  const Interval x = following(*row, 0);
  for (const double end : {x.low, x.high})
    if (std::isfinite(end)) at.insert(-end);
  return at;
}

void add(Curve& curve, double x, double y) { curve.x.push_back(x), curve.y.push_back(y); }

void add_reaction(SupportGraph& g, const SupportLaw& law, const GraphWindow& w) {
  Curve piece;
  if (law.kind == Kind::prescribed) {
    g.reaction.push_back({{law.value, law.value}, {w.most, w.least}});
    return;
  }
  const double from = std::max(w.low, g.low);
  if (law.kind == Kind::signorini) add(piece, 0, w.most);
  add(piece, from, limit_of_reaction(law, from, Side::right));
  for (int k = 1; law.kind == Kind::compliance && k < kParabola; ++k) add(piece, from - from * k / kParabola, limit_of_reaction(law, from - from * k / kParabola, Side::right));
  for (const double v : kinks(law)) {
    if (!(v > from && v < w.high)) continue;
    const double left = limit_of_reaction(law, v, Side::left), right = limit_of_reaction(law, v, Side::right);
    add(piece, v, left);
    if (law.kind == Kind::breaking && left != right) {
      g.jumps.push_back({{v, v}, {left, right}});
      g.reaction.push_back(std::exchange(piece, {}));
    }
    if (left != right) add(piece, v, right);
  }
  add(piece, w.high, limit_of_reaction(law, w.high, Side::left));
  g.reaction.push_back(std::move(piece));
}

void add_energy(SupportGraph& g, const SupportLaw& law, const GraphWindow& w) {
  const double from = std::max(w.low, g.low), to = std::min(w.high, g.high);
  std::vector<double> ends{from};
  for (const double v : kinks(law))
    if (v > from && v < to) ends.push_back(v);
  if (to > from) ends.push_back(to);
  add(g.energy, from, energy(law, from));
  for (std::size_t i = 1; i < ends.size(); ++i)
    for (int k = 1; k <= kParabola; ++k) {
      const double v = k == kParabola ? ends[i] : ends[i - 1] + (ends[i] - ends[i - 1]) * k / kParabola;
      add(g.energy, v, energy(law, v));
    }
}

}  // namespace

double yield_displacement(const SupportLaw& law) {
  const bool yields = law.kind == Kind::capped_elastic || law.kind == Kind::breaking;
  return yields && law.value > 0 ? law.limit / law.value : kInfinite;
}

double energy(const SupportLaw& law, double v) {
  if (law.kind == Kind::load) return -law.value * v;
  if (law.kind == Kind::prescribed) return v == law.value ? 0 : kInfinite;
  if (law.kind == Kind::signorini) return v >= 0 ? 0 : kInfinite;
  const auto row = row_law(law);
  if (!row) return 0;
  return row->energy(0, law.kind == Kind::breaking ? std::min(-v, yield_displacement(law)) : -v);
}

SupportGraph graph(const SupportLaw& law, const GraphWindow& window) {
  SupportGraph g{{}, {}, {}, -kInfinite, kInfinite};
  if (law.kind == Kind::prescribed) g.low = g.high = law.value;
  if (law.kind == Kind::signorini) g.low = 0;
  add_reaction(g, law, window);
  add_energy(g, law, window);
  return g;
}

}  // namespace dotyk::problem
