#include "solver/active/linearisation.hpp"

#include <string_view>

namespace dotyk::solver {

using algebra::Vector;
using problem::Nothing;
using problem::Problem;
using problem::Projection;

namespace {

constexpr Projection kOpen{0, 0};
Projection closed(double y) { return {y, 1}; }

/// Is a row whose λ followed x at the end of that, up to rounding, or one whose λ did not at its beginning?
/// Where one spring follows another, that end is 0.
bool at_kink(const problem::ScalarRow& row, double lambda, double x, const Nothing& rounding, const Linearisation& previous) {
  const auto& [law, k, r] = row;
  const auto [low, high] = law.multipliers(k);
  if (previous.active[r] && problem::kinked_at_zero(law, k)) return std::abs(lambda) <= rounding.force[r];
  if (previous.active[r]) return std::min(std::abs(lambda - low), std::abs(lambda - high)) <= rounding.force[r];
  const auto [from, to] = problem::following(law, k);
  return std::abs(x - (previous.value[r] >= high ? to : from)) <= rounding.gap[r];
}

/// The friction of one point, where the normal rows have their values already. A point that was to slip and moved against its force sticks first: were rho x
/// great beside the bound, it would slip the other way, move against that force too, and so on.
void take_friction(const problem::FrictionPoint& point, const Vector& lambda, const Vector& x, const Vector& rho, const Linearisation* previous,
                   Linearisation& l) {
  const auto& [group, k, first, n] = point;
  const double bound = group.bound(k, l.value), own = rho[group.scale_row(k)];
  if (bound == 0) return;
  const int d = group.components;
  const Vector y = lambda.segment(first, d) + own * x.segment(first, d);
  problem::DiscProjection p = problem::project_disc(y, bound);
  if (previous && previous->slipping[first] && x.segment(first, d).dot(previous->value.segment(first, d)) < 0) p.stick = true;
  for (int i = 0; i < d; ++i) l.set(first + i, y[i], p.stick ? closed(y[i]) : Projection{p.value[i], 0});
  if (p.stick) return;
  std::fill_n(l.slipping.begin() + first, d, char(1));
  const double by_normal = n < 0 || l.slope[n] == 0 ? 0 : group.law->bound_slope(k);
  l.slips.push_back({first, d, n, p.by_bound, by_normal, n < 0 ? 0 : l.value[n], own * bound / (y.norm() - bound)});
}

}  // namespace

bool may_open(const problem::Law& law, int row) { return law.unilateral() || law.multipliers(row).low == 0; }

std::vector<char> first_active(const Problem& problem, const std::vector<char>& flags) {
  const double touching = 1e-12 * (problem.rows() ? problem.c.lpNorm<Eigen::Infinity>() : 0);
  std::vector<char> active(problem.rows(), 0);
  for (const auto& [law, k, r] : problem.scalar_rows())
    active[r] = !may_open(law, k) || (flags.empty() ? !law.unilateral() || problem.c[r] <= touching : flags[r]);
  for (const auto& [group, k, first, n] : problem.friction_points())
    std::fill_n(active.begin() + first, group.components, n < 0 ? char(1) : active[n]);
  return active;
}

Vector Linearisation::Slip::beyond(const Vector& slip, double pressed_more) const {
  const Vector force = components > 1 ? Vector(across * (slip - along * along.dot(slip))) : Vector::Zero(1);
  return force + along * by_normal * pressed_more;
}

void Linearisation::Slip::add_stiffness(const std::vector<int>& unknown_of_row, algebra::Triplets& entries) const {
  for (int i = 0; i < components && components > 1; ++i)
    for (int j = 0; j <= i; ++j) {
      const auto [column, place] = std::minmax(unknown_of_row[row + i], unknown_of_row[row + j]);
      entries.emplace_back(place, column, across * ((i == j) - along[i] * along[j]));
    }
}

bool Linearisation::same_piece(const Linearisation& other, int row) const {
  if (slipping[row] || other.slipping[row]) return slipping[row] == other.slipping[row];
  return slope[row] == other.slope[row] && (slope[row] != 0 || value[row] == other.value[row]);
}

std::vector<int> Linearisation::changed(const Linearisation& other) const {
  std::vector<int> rows;
  for (int r = 0; r < static_cast<int>(active.size()); ++r)
    if (!same_piece(other, r)) rows.push_back(r);
  return rows;
}

std::size_t Linearisation::fingerprint() const {
  Vector pieces(2 * slope.size());
  pieces << slope, (slope.array() == 0).select(value, 0.0);
  pieces.array() += 0.0;  // −0 is 0
  return std::hash<std::string_view>{}({reinterpret_cast<const char*>(pieces.data()), sizeof(double) * static_cast<std::size_t>(pieces.size())});
}

int Linearisation::active_count() const { return std::accumulate(active.begin(), active.end(), 0); }

Linearisation linearise(const Problem& problem, const Vector& lambda, const Vector& x, const Vector& rho, const Linearisation* previous,
                        const Nothing& rounding) {
  Linearisation l(problem.rows());
  for (const problem::ScalarRow& row : problem.scalar_rows()) {
    const auto& [law, k, r] = row;
    double y = lambda[r] + rho[r] * x[r];
    if (previous && law.unilateral()) y = previous->active[r] ? lambda[r] : rho[r] * x[r];
    if (previous && at_kink(row, lambda[r], x[r], rounding, *previous))
      l.set(r, y, {previous->active[r] ? previous->slope[r] * y : previous->value[r], previous->slope[r]});
    else
      l.set(r, y, law.project(k, y, rho[r]));
  }
  for (const problem::FrictionPoint& point : problem.friction_points()) take_friction(point, lambda, x, rho, previous, l);
  return l;
}

Linearisation from_flags(const Problem& problem, const std::vector<char>& active, const Vector& rho) {
  Linearisation l(problem.rows());
  for (const auto& [law, k, r] : problem.scalar_rows())
    l.set(r, 0, may_open(law, k) && !active[r] ? kOpen : law.unilateral() ? closed(0) : law.project(k, 0, rho[r]));
  for (const auto& [group, k, first, n] : problem.friction_points())
    for (int r = first; r < first + group.components; ++r) l.set(r, 0, active[r] ? closed(0) : kOpen);
  return l;
}

}  // namespace dotyk::solver
