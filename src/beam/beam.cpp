#include "beam/beam.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"

namespace dotyk::beam {

namespace {

/// Nodes nearer to each other than this part of a cell are one.
constexpr double kSame = 1e-6;
constexpr int kMostCells = 1000;

void require_on_beam(const Beam& beam, double x, const std::string& what) {
  if (!(x >= 0 && x <= beam.length))
    throw InputError(text(what, " is at x = ", x, "; the beam goes from 0 to ", beam.length));
}

}  // namespace

void require_valid(const Beam& beam) {
  if (!(beam.length > 0) || !std::isfinite(beam.length)) throw InputError(text("beam: its length is ", beam.length, "; it must be positive"));
  if (beam.cells < 1) throw InputError(text("beam: it has ", beam.cells, " cells; at least one is needed"));
  if (beam.cells > kMostCells)
    throw InputError(text("beam: it has ", beam.cells, " cells; rounding grows as the fourth power of their number, and ", kMostCells, " leave it 1e-6"));
  if (!beam.EJ_of && (!(beam.EJ > 0) || !std::isfinite(beam.EJ))) throw InputError(text("beam: EJ is ", beam.EJ, "; it must be positive"));
  if (!beam.q_of && !std::isfinite(beam.q)) throw InputError(text("beam: its load is ", beam.q));
  for (const PointLoad& load : beam.loads) {
    require_on_beam(beam, load.x, "a load");
    if (!std::isfinite(load.force) || !std::isfinite(load.moment))
      throw InputError(text("beam: the load at x = ", load.x, " has the force ", load.force, " and the moment ", load.moment));
  }
  for (std::size_t i = 0; i < beam.supports.size(); ++i) {
    const Support& s = beam.supports[i];
    require_on_beam(beam, s.x, "the support " + s.name);
    require_valid(s.deflection);
    require_valid(s.rotation);
    if (i > 0 && !(s.x - beam.supports[i - 1].x > kSame * beam.length / beam.cells))
      throw InputError(text("beam: the supports ", beam.supports[i - 1].name, " and ", s.name, " are at one point"));
  }
}

std::vector<double> nodes(const Beam& beam) {
  const double h = beam.length / beam.cells;
  std::vector<double> x;
  for (int i = 0; i <= beam.cells; ++i) x.push_back(i < beam.cells ? i * h : beam.length);
  for (const Support& s : beam.supports) {
    const bool taken = std::any_of(x.begin(), x.end(), [&](double at) { return std::abs(s.x - at) <= kSame * h; });
    if (!taken) x.insert(std::upper_bound(x.begin(), x.end(), s.x), s.x);
  }
  return x;
}

int cell_of(const std::vector<double>& nodes, double x) {
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), x);
  return std::clamp(static_cast<int>(above - nodes.begin()) - 1, 0, static_cast<int>(nodes.size()) - 2);
}

int nearest(const std::vector<double>& nodes, double x) {
  const auto above = std::lower_bound(nodes.begin(), nodes.end(), x);
  if (above == nodes.begin()) return 0;
  const int i = static_cast<int>(above - nodes.begin());
  return above == nodes.end() || x - nodes[i - 1] < nodes[i] - x ? i - 1 : i;
}

}  // namespace dotyk::beam
