#include "problem/support_graph.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace dotyk::problem {

namespace {

constexpr double kInfinite = Law::kUnbounded;
constexpr int kParabola = 48;  // points of φ between two kinks

enum class Side { left, right };

/// The limit of r at v from one side; within the displacements that the law admits.
double limit_of_reaction(const LawChoice& law, double v, Side side) {
  const auto below = [&](double kink) { return v < kink || (v == kink && side == Side::left); };
  if (law->load) return law.force();
  if (law->breaks && below(-yield_displacement(law))) return 0;
  const auto row = row_law(law);
  if (!row || law->prescribes) return 0;
  if (v != 0 || !law->rigid) return row->respond(0, -v).force;
  const Interval bounds = row->multipliers(0);
  return below(0) ? bounds.high : bounds.low;
}

/// Displacements where r has a kink or many values.
std::set<double> kinks(const LawChoice& law) {
  std::set<double> at;
  if (law->breaks) at.insert(-yield_displacement(law));
  if (const auto row = row_law(law))
    for (const double x : row->kinks(0)) at.insert(-x);
  return at;
}

void add(Curve& curve, double x, double y) { curve.x.push_back(x), curve.y.push_back(y); }

/// Is r(v) no line, or not known to be one?
bool curved(const LawChoice& law) {
  const auto row = row_law(law);
  return row && !row->springs(0);
}

void add_reaction(SupportGraph& g, const LawChoice& law, const GraphWindow& w) {
  Curve piece;
  if (law->prescribes) {
    g.reaction.push_back({{law.displacement(), law.displacement()}, {w.most, w.least}});
    return;
  }
  const double from = std::max(w.low, g.low);
  if (law->stop()) add(piece, 0, w.most);
  add(piece, from, limit_of_reaction(law, from, Side::right));
  for (int k = 1; curved(law) && k < kParabola; ++k) add(piece, from - from * k / kParabola, limit_of_reaction(law, from - from * k / kParabola, Side::right));
  for (const double v : kinks(law)) {
    if (!(v > from && v < w.high)) continue;
    const double left = limit_of_reaction(law, v, Side::left), right = limit_of_reaction(law, v, Side::right);
    add(piece, v, left);
    if (law->breaks && left != right) {
      g.jumps.push_back({{v, v}, {left, right}});
      g.reaction.push_back(std::exchange(piece, {}));
    }
    if (left != right) add(piece, v, right);
  }
  add(piece, w.high, limit_of_reaction(law, w.high, Side::left));
  g.reaction.push_back(std::move(piece));
}

void add_energy(SupportGraph& g, const LawChoice& law, const GraphWindow& w) {
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

double energy(const LawChoice& law, double v) {
  if (law->load) return -law.force() * v;
  if (law->prescribes) return v == law.displacement() ? 0 : kInfinite;
  if (law->stop()) return v >= 0 ? 0 : kInfinite;
  const auto row = row_law(law);
  if (!row) return 0;
  return row->energy(0, law->breaks ? std::min(-v, yield_displacement(law)) : -v);
}

SupportGraph graph(const LawChoice& law, const GraphWindow& window) {
  SupportGraph g{{}, {}, {}, -kInfinite, kInfinite};
  if (law->prescribes) g.low = g.high = law.displacement();
  if (law->stop()) g.low = 0;
  add_reaction(g, law, window);
  add_energy(g, law, window);
  return g;
}

}  // namespace dotyk::problem
