#include "solver/active/linearisation.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace dotyk::solver {

using algebra::Vector;
using problem::Problem;
using problem::Projection;
using problem::RowGroup;

namespace {

void set(Linearisation& l, int row, double y, Projection p) {
  l.y[row] = y;
  l.value[row] = p.lambda;
  l.slope[row] = p.slope;
  l.active[row] = p.slope > 0;
}

/// Is a row whose λ followed x at the end of that, up to rounding, or one whose λ did not at its beginning?
/// Where one spring follows another, that end is 0.
bool at_kink(const problem::Law& law, int row, double lambda, double x, double force, double gap, const Linearisation& previous, int r) {
  const auto [low, high] = law.multipliers(row);
  if (previous.active[r] && problem::kinked_at_zero(law, row)) return std::abs(lambda) <= force;
  if (previous.active[r]) return std::min(std::abs(lambda - low), std::abs(lambda - high)) <= force;
  const auto [from, to] = problem::following(law, row);
  return std::abs(x - (previous.value[r] >= high ? to : from)) <= gap;
}

constexpr Projection kOpen{0, 0};
Projection closed(double y) { return {y, 1}; }

/// The friction of one point, where the normal rows have their values already.
void take_friction(const problem::FrictionGroup& group, int point, const Vector& lambda, const Vector& x, const Vector& rho, Linearisation& l) {
  const double bound = group.bound(point, l.value);
  if (bound == 0) return;
  const int first = group.row(point), d = group.components, n = group.normal[point];
  const double own = rho[group.scale_row(point)];
  const Vector y = lambda.segment(first, d) + own * x.segment(first, d);
  const problem::DiscProjection p = problem::project_disc(y, bound);
  for (int i = 0; i < d; ++i) set(l, first + i, y[i], p.stick ? closed(y[i]) : Projection{p.value[i], 0});
  if (p.stick) return;
  std::fill_n(l.slipping.begin() + first, d, char(1));
  const double by_normal = n < 0 || l.slope[n] == 0 ? 0 : group.law->bound_slope(point);
  l.slips.push_back({first, d, n, p.by_bound, by_normal, n < 0 ? 0 : l.value[n], own * bound / (y.norm() - bound)});
}

}  // namespace

bool may_open(const problem::Law& law, int row) { return law.unilateral() || law.multipliers(row).low == 0; }

std::vector<char> first_active(const Problem& problem, const std::vector<char>& flags) {
  const double touching = 1e-12 * (problem.rows() ? problem.c.lpNorm<Eigen::Infinity>() : 0);
  std::vector<char> active(problem.rows(), 0);
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      active[r] = !may_open(*group.law, r - group.first) || (flags.empty() ? !group.law->unilateral() || problem.c[r] <= touching : flags[r]);
  for (const problem::FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k)
      std::fill_n(active.begin() + group.row(k), group.components, group.normal[k] < 0 ? char(1) : active[group.normal[k]]);
  return active;
}

bool Linearisation::same_piece(const Linearisation& other, int row) const {
  if (slipping[row] || other.slipping[row]) return slipping[row] == other.slipping[row];
  return slope[row] == other.slope[row] && (slope[row] != 0 || value[row] == other.value[row]);
}

std::uint64_t Linearisation::fingerprint() const {
  std::uint64_t h = 1469598103934665603ull;  // FNV-1a
  const auto add = [&h](double number) { h = (h ^ std::bit_cast<std::uint64_t>(number + 0.0)) * 1099511628211ull; };  // −0 is 0
  for (Eigen::Index r = 0; r < slope.size(); ++r) add(slope[r]), add(slope[r] == 0 ? value[r] : 0);
  return h;
}

int Linearisation::active_count() const { return std::accumulate(active.begin(), active.end(), 0); }

Linearisation linearise(const Problem& problem, const Vector& lambda, const Vector& x,
                        const Vector& rho, const Noise& noise, const Linearisation* previous) {
  Linearisation l(problem.rows());
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r) {
      double y = lambda[r] + rho[r] * x[r];
      if (previous && group.law->unilateral()) {
        const bool was_closed = previous->active[r];
        y = was_closed ? lambda[r] : rho[r] * x[r];
        const bool nothing = was_closed ? std::abs(lambda[r]) <= noise.force[r] : std::abs(x[r]) <= noise.gap[r];
        if (nothing) {
          set(l, r, y, was_closed ? closed(y) : kOpen);
          continue;
        }
      }
      if (previous && !group.law->unilateral() && at_kink(*group.law, r - group.first, lambda[r], x[r], noise.force[r], noise.gap[r], *previous, r))
        set(l, r, y, {previous->active[r] ? previous->slope[r] * y : previous->value[r], previous->slope[r]});
      else
        set(l, r, y, group.law->project(r - group.first, y, rho[r]));
    }
  for (const problem::FrictionGroup& group : problem.friction)
    for (int k = 0; k < group.points(); ++k) take_friction(group, k, lambda, x, rho, l);
  return l;
}

Linearisation from_flags(const Problem& problem, const std::vector<char>& active, const Vector& rho) {
  Linearisation l(problem.rows());
  for (const RowGroup& group : problem.groups)
    for (int r = group.first; r < group.first + group.count; ++r)
      set(l, r, 0, may_open(*group.law, r - group.first) && !active[r] ? kOpen
                   : group.law->unilateral()                           ? closed(0)
                                                                       : group.law->project(r - group.first, 0, rho[r]));
  for (const problem::FrictionGroup& group : problem.friction)
    for (int r = group.first; r < group.row(group.points()); ++r) set(l, r, 0, active[r] ? closed(0) : kOpen);
  return l;
}

}  // namespace dotyk::solver
