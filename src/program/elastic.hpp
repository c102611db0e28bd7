#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "program/program.hpp"

namespace dotyk::program {

/// Where every row of a program stands at a point: in the working set at one of its limits, free between
/// them, or elastic: violated, and charged for.
class Elastic {
 public:
  Elastic(const QuadraticProgram& program, double tolerance)
      : side(program.rows(), Side::free), p_(program), tolerance_(tolerance) {}

  std::vector<Side> side;  ///< m

  bool working(int row) const { return side[row] == Side::low || side[row] == Side::high || side[row] == Side::equal; }
  bool violated(int row) const { return side[row] == Side::above || side[row] == Side::below; }
  bool any_violated() const {
    return std::any_of(side.begin(), side.end(), [](Side s) { return s == Side::above || s == Side::below; });
  }
  std::vector<char> taken() const {
    std::vector<char> flags(side.size());
    for (int r = 0; r < p_.rows(); ++r) flags[r] = working(r);
    return flags;
  }

  /// The limit at which a row stands or towards which an elastic one comes back.
  double limit(int row) const { return side[row] == Side::low || side[row] == Side::below ? p_.low[row] : p_.high[row]; }
  /// limit − activity of the rows at work, zero for others; activity = Ax (m).
  Vector missing(const Vector& activity) const {
    Vector h = Vector::Zero(p_.rows());
    for (int r = 0; r < p_.rows(); ++r)
      if (working(r)) h[r] = limit(r) - activity[r];
    return h;
  }
  /// Σ ± a_r over elastic rows: the gradient of the summed violation, as weights (m) of the rows of A.
  Vector charge() const {
    Vector weight(p_.rows());
    for (int r = 0; r < p_.rows(); ++r) weight[r] = side[r] == Side::above ? 1 : side[r] == Side::below ? -1 : 0;
    return weight;
  }

  /// Makes a row elastic where the activity violates it by more than the tolerance, else free.
  void let_go(int row, double activity) {
    if (activity > p_.high[row] + slack(p_.high[row])) side[row] = Side::above;
    else if (activity < p_.low[row] - slack(p_.low[row])) side[row] = Side::below;
    else side[row] = Side::free;
  }
  /// Rows at work that have left their limit become elastic or free; others are looked at anew; an equality
  /// that holds goes to work.
  void classify(const Vector& activity) {
    for (int r = 0; r < p_.rows(); ++r) {
      if (working(r) && std::abs(limit(r) - activity[r]) <= slack(limit(r))) continue;
      let_go(r, activity[r]);
      if (side[r] == Side::free && p_.equality(r)) side[r] = Side::equal;
    }
  }
  /// Do all elastic rows stand at their limit, up to the tolerance?
  bool arrived(const Vector& activity) const {
    for (int r = 0; r < p_.rows(); ++r)
      if (violated(r) && std::abs(activity[r] - limit(r)) > slack(limit(r))) return false;
    return true;
  }
  /// A number that tells this set from others.
  std::size_t hash() const {
    std::size_t h = 1469598103934665603ull;
    for (Side s : side) h = (h ^ static_cast<unsigned char>(s)) * 1099511628211ull;
    return h;
  }

  struct Meeting {
    double step = INFINITY;
    std::vector<int> rows;  ///< the row met first, or several met at once
    Vector speed;           ///< Ap, of all rows
  };
  /// The first limits met along p from x (n); elastic rows meet theirs coming back.
  /// Harris's test (1973): of the rows within the tolerance the one met most squarely; `least_index`: of the
  /// rows met first, within rounding, the first (Bland); `all`: all within the tolerance.
  /// A speed that is rounding beside its terms |A||p| is none.
  Meeting meeting(const Vector& x, const Vector& p, bool least_index, bool all) const {
    constexpr double kSlow = 1e-11;
    const Vector activity = p_.A * x, terms = p_.A.cwiseAbs() * p.cwiseAbs();
    Meeting out;
    const Vector& speed = out.speed = p_.A * p;
    const auto room = [&](int r) {
      return std::abs(speed[r]) <= kSlow * terms[r] ? INFINITY : this->room(r, activity[r], speed[r]);
    };
    double reach = INFINITY;
    for (int r = 0; r < p_.rows(); ++r)
      if (const double left = room(r); std::isfinite(left)) {
        const double tolerance = least_index ? 0 : slack(activity[r] + left);
        reach = std::min(reach, std::max(0.0, left + tolerance) / std::abs(speed[r]));
      }
    if (!std::isfinite(reach)) return out;
    int best = -1;
    for (int r = 0; r < p_.rows(); ++r) {
      if (!(std::max(0.0, room(r)) <= reach * std::abs(speed[r]) * (1 + 1e-12))) continue;
      if (all) out.rows.push_back(r);
      if (best < 0 || (!least_index && std::abs(speed[r]) > std::abs(speed[best]))) best = r;
    }
    if (best < 0) return out;
    out.step = std::max(0.0, room(best) / std::abs(speed[best]));
    if (!all) out.rows = {best};
    return out;
  }
  /// Puts a row to work at the limit it met at this speed.
  void engage(int row, double speed) {
    if (p_.equality(row)) side[row] = Side::equal;
    else if (side[row] == Side::above) side[row] = Side::high;
    else if (side[row] == Side::below) side[row] = Side::low;
    else side[row] = speed > 0 ? Side::high : Side::low;
  }

 private:
  double slack(double limit) const { return tolerance_ * (1 + std::abs(limit)); }
  /// Way to go until the row meets a limit; infinite where it meets none.
  double room(int row, double activity, double speed) const {
    switch (side[row]) {
      case Side::free: return speed > 0 ? p_.high[row] - activity : activity - p_.low[row];
      case Side::above: return speed < 0 ? activity - p_.high[row] : INFINITY;
      case Side::below: return speed > 0 ? p_.low[row] - activity : INFINITY;
      default: return INFINITY;
    }
  }

  const QuadraticProgram& p_;
  double tolerance_;
};

}  // namespace dotyk::program
