#include <cmath>

#include "program/active_set_iteration.hpp"

// Rounds in which the whole working set changes at once.

namespace dotyk::program {
namespace {

constexpr int kRounds = 50;  ///< at most

}  // namespace

bool ActiveSetIteration::whole_sets() {
  const auto side = rows_.side;
  const Vector x = x_, y = y_;
  std::unordered_set<std::size_t> seen;
  kkt_.set(rows_.taken());
  for (int round = 0; round < kRounds && seen.insert(rows_.hash()).second; ++round) {
    const auto s = solve_kkt(times(p_.P, x_) + p_.q, p_.A * x_);
    if (!s.consistent) {
      if (!fall(s.p)) break;
      continue;
    }
    x_ += s.p;
    y_ = s.y;
    int changed = 0;
    const Vector activity = p_.A * x_;
    for (int r = 0; r < p_.rows(); ++r) {
      const Side before = rows_.side[r];
      if (rows_.working(r)) {
        if (wrong(r) > 0 && !p_.equality(r)) rows_.side[r] = Side::free, ++result_.dropped;
      } else if (activity[r] > p_.high[r] + rows_.slack_tolerance(p_.high[r])) {
        rows_.side[r] = p_.equality(r) ? Side::equal : Side::high, ++result_.added;
      } else if (activity[r] < p_.low[r] - rows_.slack_tolerance(p_.low[r])) {
        rows_.side[r] = p_.equality(r) ? Side::equal : Side::low, ++result_.added;
      }
      changed += rows_.side[r] != before;
    }
    report(changed, s.p);
    if (changed == 0) {
      finish(Status::solved, "every row and every multiplier has its sign");
      return true;
    }
    kkt_.set(rows_.taken());
  }
  result_.repeats += seen.count(rows_.hash()) > 0;
  rows_.side = side;
  x_ = x, y_ = y;
  return false;
}

bool ActiveSetIteration::fall(const Vector& kernel) {
  const Vector p = kernel / peak(kernel), g = gradient(), speed = p_.A * p;
  const bool moves_rows = [&] {
    for (int r = 0; r < p_.rows(); ++r)
      if (rows_.working(r) && std::abs(speed[r]) > settings_.tol) return true;
    return false;
  }();
  if (!p.allFinite() || moves_rows || !(-g.dot(p) > settings_.tol * (1 + peak(g)))) return false;
  const auto meeting = rows_.meeting(p_.A * x_, speed, p_.A.cwiseAbs() * p.cwiseAbs(), false, true);
  if (!std::isfinite(meeting.step)) return false;
  x_ += meeting.step * p;
  for (int r : meeting.rows) rows_.engage(r, speed[r]), ++result_.added;
  report(static_cast<int>(meeting.rows.size()), meeting.step * p);
  kkt_.set(rows_.taken());
  return true;
}

}  // namespace dotyk::program
