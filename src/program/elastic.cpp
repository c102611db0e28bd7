#include "program/elastic.hpp"

#include <algorithm>
#include <cmath>

namespace dotyk::program {

constexpr double kSlow = 1e-11;  ///< speed of a row relative to its rounding terms

Elastic::Elastic(const QuadraticProgram& program, double tolerance)
    : side(program.rows(), Side::free), p_(program), tolerance_(tolerance) {}

int Elastic::violations() const {
  int count = 0;
  for (int r = 0; r < p_.rows(); ++r) count += violated(r);
  return count;
}

std::vector<char> Elastic::taken() const {
  std::vector<char> flags(side.size());
  for (int r = 0; r < p_.rows(); ++r) flags[r] = working(r);
  return flags;
}

double Elastic::limit(int row) const {
  return side[row] == Side::low || side[row] == Side::below ? p_.low[row] : p_.high[row];
}

Vector Elastic::missing(const Vector& activity) const {
  Vector h = Vector::Zero(p_.rows());
  for (int r = 0; r < p_.rows(); ++r)
    if (working(r)) h[r] = limit(r) - activity[r];
  return h;
}

Vector Elastic::charge() const {
  Vector weight = Vector::Zero(p_.rows());
  for (int r = 0; r < p_.rows(); ++r)
    weight[r] = side[r] == Side::above ? 1 : side[r] == Side::below ? -1 : 0;
  return weight;
}

double Elastic::slack_tolerance(double limit) const { return tolerance_ * (1 + std::abs(limit)); }

void Elastic::classify(const Vector& activity) {
  for (int r = 0; r < p_.rows(); ++r) {
    const double a = activity[r];
    if (working(r) && std::abs(limit(r) - a) <= slack_tolerance(limit(r))) continue;
    if (std::isfinite(p_.high[r]) && a > p_.high[r] + slack_tolerance(p_.high[r])) side[r] = Side::above;
    else if (std::isfinite(p_.low[r]) && a < p_.low[r] - slack_tolerance(p_.low[r])) side[r] = Side::below;
    else side[r] = p_.equality(r) ? Side::equal : Side::free;
  }
}

bool Elastic::arrived(const Vector& activity) const {
  for (int r = 0; r < p_.rows(); ++r)
    if (violated(r) && std::abs(activity[r] - limit(r)) > slack_tolerance(limit(r))) return false;
  return true;
}

std::size_t Elastic::hash() const {
  std::size_t h = 1469598103934665603ull;
  for (Side s : side) h = (h ^ static_cast<unsigned char>(s)) * 1099511628211ull;
  return h;
}

/// Way to go until the row meets a limit; infinite where it meets none.
double Elastic::room(int row, double activity, double speed) const {
  switch (side[row]) {
    case Side::free: return speed > 0 ? p_.high[row] - activity : activity - p_.low[row];
    case Side::above: return speed < 0 ? activity - p_.high[row] : INFINITY;
    case Side::below: return speed > 0 ? p_.low[row] - activity : INFINITY;
    default: return INFINITY;
  }
}

Elastic::Meeting Elastic::meeting(const Vector& activity, const Vector& speed, const Vector& terms, bool least_index,
                                  bool all) const {
  const auto slow = [&](int r) { return std::abs(speed[r]) <= kSlow * terms[r]; };
  Meeting out;
  double reach = INFINITY;
  for (int r = 0; r < p_.rows(); ++r) {
    if (working(r) || slow(r)) continue;
    const double room_left = room(r, activity[r], speed[r]);
    if (!std::isfinite(room_left)) continue;
    const double tolerance = least_index ? 0 : slack_tolerance(activity[r] + room_left);
    reach = std::min(reach, std::max(0.0, room_left + tolerance) / std::abs(speed[r]));
  }
  if (!std::isfinite(reach)) return out;
  int best = -1;
  for (int r = 0; r < p_.rows(); ++r) {
    if (working(r) || slow(r)) continue;
    const double room_left = room(r, activity[r], speed[r]);
    if (!(std::max(0.0, room_left) <= reach * std::abs(speed[r]) * (1 + 1e-12))) continue;
    if (all) out.rows.push_back(r);
    if (best < 0 || (!least_index && std::abs(speed[r]) > std::abs(speed[best]))) best = r;
  }
  if (best < 0) return out;
  out.step = std::max(0.0, room(best, activity[best], speed[best]) / std::abs(speed[best]));
  if (!all) out.rows = {best};
  return out;
}

void Elastic::engage(int row, double speed) {
  if (p_.equality(row)) side[row] = Side::equal;
  else if (side[row] == Side::above) side[row] = Side::high;
  else if (side[row] == Side::below) side[row] = Side::low;
  else side[row] = speed > 0 ? Side::high : Side::low;
}

}  // namespace dotyk::program
