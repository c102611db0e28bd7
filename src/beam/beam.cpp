#include "beam/beam.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::beam {


namespace {

/// Supports nearer to each other than this part of the length are refused: what rounding leaves grows as the inverse cube.
constexpr double kNear = 1e-4;
constexpr int kMostCells = 1000;

void require_on_beam(const Beam& beam, double x, const std::string& what) {
  if (!(x >= 0 && x <= beam.length))
    throw InputError(text(what, " is at x = ", x, "; the beam goes from 0 to ", beam.length));
}

/// At a point that both hold rigidly.
void require_agreement(const Support& s, const Foundation& f, double length) {
  const std::string both = text("the support ", s.name, " (", problem::describe(s.deflection), ") and the foundation there (", problem::describe(f.law), ")");
  if (!s.deflection->prescribes)
    throw InputError(text(both, " both hold the deflection rigidly, and which of them bears what is not known; keep one of them"));
  const double u = s.deflection.displacement() + s.deflection_at, floor = f.at + f.law.displacement(), rounding = 1e-12 * length;
  if (f.law->stop() ? u < floor - rounding : f.law->prescribes && std::abs(u - floor) > rounding)
    throw InputError(text(both, " contradict each other: deflections ", u, " and ", floor));
}

void require_foundation(const Beam& beam) {
  const std::vector<double> x = nodes(beam);
  if (beam.foundation.size() != x.size()) throw InputError(text("its foundation has ", beam.foundation.size(), " laws for ", x.size(), " nodes"));
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Foundation& f = beam.foundation[i];
    if (f.law->load || f.law->breaks)
      throw InputError(text("the foundation's law at x = ", x[i], " is ", problem::describe(f.law),
                            f.law->load ? "; loads along the beam are its load" : "; of supports at points alone all branches are found. capped_elastic limits the pressure"));
    require_valid(f.law);
    if (!std::isfinite(f.at)) throw InputError(text("the foundation is at ", f.at, " where x = ", x[i]));
  }
  for (const Support& s : beam.supports)
    if (const Foundation& f = beam.foundation[nearest(x, s.x)]; s.deflection->rigid && f.law->rigid) require_agreement(s, f, beam.length);
}

}  // namespace

bool has_row(const Beam& beam, const std::vector<double>& nodes, int node) {
  if (!beam.foundation[node].law->rigid) return true;
  return std::none_of(beam.supports.begin(), beam.supports.end(),
                      [&](const Support& s) { return s.deflection->prescribes && nearest(nodes, s.x) == node; });
}

void require_valid(const Beam& beam) {
  if (!(beam.length > 0) || !std::isfinite(beam.length)) throw InputError(text("its length is ", beam.length, "; it must be positive"));
  if (beam.cells < 1) throw InputError(text("it has ", beam.cells, " cells; at least one is needed"));
  if (beam.cells > kMostCells)
    throw InputError(text("it has ", beam.cells, " cells; rounding grows as the fourth power of their number, and ", kMostCells, " leave it 1e-6"));
  if (!beam.EJ_of && (!(beam.EJ > 0) || !std::isfinite(beam.EJ))) throw InputError(text("EJ is ", beam.EJ, "; it must be positive"));
  if (!beam.q_of && !std::isfinite(beam.q)) throw InputError(text("its load is ", beam.q));
  for (const PointLoad& load : beam.loads) {
    require_on_beam(beam, load.x, "a load");
    if (!std::isfinite(load.force) || !std::isfinite(load.moment))
      throw InputError(text("the load at x = ", load.x, " has the force ", load.force, " and the moment ", load.moment));
  }
  for (std::size_t i = 0; i < beam.supports.size(); ++i) {
    const Support& s = beam.supports[i];
    require_on_beam(beam, s.x, "the support " + s.name);
    require_valid(s.deflection);
    require_valid(s.rotation);
    if (!std::isfinite(s.deflection_at) || !std::isfinite(s.rotation_at))
      throw InputError(text("the laws of the support ", s.name, " are about the deflection ", s.deflection_at, " and the rotation ", s.rotation_at));
    if (i == 0) continue;
    const Support& before = beam.supports[i - 1];
    if (s.x == before.x) throw InputError(text("the supports ", before.name, " and ", s.name, " are at one point"));
    if (!(s.x - before.x > kNear * beam.length))
      throw InputError(text("the supports ", before.name, " and ", s.name, " are ", s.x - before.x, " apart, too near for rounding to tell: at least ", kNear,
                            " of the length, or one support with laws for deflection and rotation"));
  }
  if (!beam.foundation.empty()) require_foundation(beam);
}

std::vector<double> nodes(const Beam& beam) {
  std::vector<double> x;
  for (int i = 0; i <= beam.cells; ++i) x.push_back(i < beam.cells ? i * beam.length / beam.cells : beam.length);
  std::vector<char> taken(x.size(), 0);
  taken.front() = taken.back() = 1;
  for (const Support& s : beam.supports) {
    std::size_t i = nearest(x, s.x);
    if (taken[i] && x[i] != s.x) {
      i = std::upper_bound(x.begin(), x.end(), s.x) - x.begin();
      x.insert(x.begin() + i, s.x);
      taken.insert(taken.begin() + i, 1);
    }
    x[i] = s.x;
    taken[i] = 1;
  }
  return x;
}

Place place(const std::vector<double>& nodes, double x) {
  if (!(x >= 0 && x <= nodes.back())) throw InputError(text("x = ", x, " is not on the beam, which goes from 0 to ", nodes.back()));
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), x);
  const int cell = std::clamp(static_cast<int>(above - nodes.begin()) - 1, 0, static_cast<int>(nodes.size()) - 2);
  return {cell, (x - nodes[cell]) / (nodes[cell + 1] - nodes[cell])};
}

int nearest(const std::vector<double>& nodes, double x) {
  const auto above = std::lower_bound(nodes.begin(), nodes.end(), x);
  if (above == nodes.begin()) return 0;
  const int i = static_cast<int>(above - nodes.begin());
  return above == nodes.end() || x - nodes[i - 1] < nodes[i] - x ? i - 1 : i;
}

}  // namespace dotyk::beam
